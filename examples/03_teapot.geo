{ A teapot, and how it becomes voxels: the same field, sampled on a grid.

  Shows:    operations as functions, CLAMP, WHERE, a volume as output.
  Run:      yont examples/03_teapot.geo -o teapot.stl
            yont examples/03_teapot.geo -o examples/data/teapot.nrrd --resolution 80
  Expected: Euler characteristic 0: one piece, and the hole of its handle }

{ Blending union [P95] (8) }
tr_bl_uni(g1, g2, a0, a1, a2) = g1 + g2 + SQRT(g1**2 + g2**2) + a0/(1 + (g1/a1)**2 + (g2/a2)**2);

{ A straight horn in the plane x2 = 0 from (px, pz) to (qx, qz), of radius r1 there and r2 here }
pob_horn(px, pz, qx, qz, r1, r2) = r1 + (r2-r1)*t - SQRT((x1 - px - t*dx)**2 + x2**2 + (x3 - pz - t*dz)**2)
  WHERE dx = qx - px, dz = qz - pz, t = CLAMP(((x1-px)*dx + (x3-pz)*dz)/(dx**2 + dz**2), 0, 1);

{ A ring about the x3 axis at height h }
pob_ring(h, major, minor) = minor - SQRT((SQRT(x1**2 + x2**2) - major)**2 + (x3-h)**2);

{ A disc about the x3 axis between two heights }
pob_disc(radius, lo, hi) = MIN(radius - SQRT(x1**2 + x2**2), x3 - lo, hi - x3);

gob_belly  = MIN(5*(1 - SQRT((x1**2 + x2**2)/36 + ((x3+0.6)/5)**2)), x3 + 4.6);
gob_spout  = MIN(MAX(pob_horn(4.2, -1.9, 7.4, 0.6, 1.7, 1), pob_horn(7.4, 0.6, 9.3, 3.6, 1, 0.7)), 3.6 - x3);
gob_handle = 0.75 - SQRT((SQRT(((x1+5.9)/1.15)**2 + (x3-0.4)**2) - 2.9)**2 + x2**2);
gob_lid    = 2*(1 - SQRT((x1**2 + x2**2)/3.4**2 + ((x3-3.3)/1.5)**2));
gob_knob   = 0.95 - SQRT(x1**2 + x2**2 + (x3-5.5)**2);

gob_pot    = tr_bl_uni(tr_bl_uni(gob_belly, gob_spout, 0.5, 0.6, 0.6), gob_handle, 0.25, 0.4, 0.4);
gob_lidded = tr_bl_uni(gob_pot | pob_ring(3.35, 3.6, 0.45) | gob_lid, gob_knob, 0.2, 0.4, 0.4);
gob_teapot = gob_lidded | pob_disc(3.6, -5.2, -4.2);

x1min = -11;  x1max = 11;
x2min = -7;   x2max = 7;
x3min = -6;   x3max = 7.5;
