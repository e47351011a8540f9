{ A part: set-theoretic operations by R-functions, a primitive and an operation of one's own.

  Shows:    |, & and \, pob_ and tr_ definitions, parameters given below their use.
  Run:      yont examples/02_part.geo -o part.stl
            yont measure examples/02_part.geo -D r_hole=0.4
  Expected: Euler characteristic -2: one piece with two tunnels through it }

{ A ball about the point [a, b, c] }
pob_sphere(a, b, c, r) = r**2 - (x1-a)**2 - (x2-b)**2 - (x3-c)**2;

{ A bar along the x1 axis, half as long as `len`, of square section }
pob_bar(len, w) = (len**2 - x1**2) & (w**2 - x2**2) & (w**2 - x3**2);

{ Blending union [P95] (8): a0 > 0 adds material, a1 and a2 say how far the blend reaches }
tr_bl_uni((gob/pob) g1, (gob/pob) g2, (real) a0, (real) a1, (real) a2) =
  g1 + g2 + SQRT(g1**2 + g2**2) + a0/(1 + (g1/a1)**2 + (g2/a2)**2);

gob_body  = tr_bl_uni(pob_sphere(0, 0, 0, 2), pob_bar(4, 0.9), 0.6, 1, 1);
gob_holes = (r_hole**2 - (x1-3)**2 - x2**2) | (r_hole**2 - (x1+3)**2 - x2**2);
gob_part  = gob_body \ gob_holes;

r_hole = 0.5;

x1min = -4.5;  x1max = 4.5;
x2min = -2.5;  x2max = 2.5;
x3min = -2.5;  x3max = 2.5;
