// Solids

r_alpha = 1;

{ The block with one corner at (a0, b0, c0) and the edges a, b, c, by minima as in the figure of the paper.
  Example: pob_block_3D(0, 0, 0, 2, 1.5, 1) AT (1, 1, 0.9)   // 0.09999999999999998
  Source: [P95] Fig. 6 }
pob_block_3D((real) a0, (real) b0, (real) c0, (real) a, (real) b, (real) c) =
  (x1 - a0 & a0 + a - x1) & (x2 - b0 & b0 + b - x2) & (x3 - c0 & c0 + c - x3);

r_alpha = 0;

{ The box about c with the edges size[1], size[2], size[3]; smooth away from its edges.
  Example: pob_box([0, 0, 0], [2, 1.5, 1]) AT (1, 0, 0)   // 0
  Source: [P95] Fig. 6 }
pob_box((array) c, (array) size) = INTERSECTION(i = 1 TO LEN(size), (size[i]/2 - q[i]) & (size[i]/2 + q[i]))
  WHERE q = fn_from(c);

{ The same box by its exact distance, positive inside.
  Example: pob_box_d([0, 0, 0], [2, 1.5, 1]) AT (4, 4.75, 0)   // -5 }
pob_box_d((array) c, (array) size) = IF MAXIMUM(e) > 0 THEN -NORM(MAX(e, 0)) ELSE -MAXIMUM(e)
  WHERE e = ABS(fn_from(c)) - size/2;

{ The box about c with the edges size[1], size[2], size[3], rounded by the radius r; an exact distance.
  Example: pob_box_round([0, 0, 0], [2, 1.5, 1], 0.25) AT (1.25, 0, 0)   // -0.25 }
pob_box_round((array) c, (array) size, (real) r) = r + pob_box_d(c, size - 2*r);

{ The ball of radius r about c; its values are squares of lengths.
  Example: pob_sphere([0, 0, 0], 1) AT (0, 0, 0.5)   // 0.75
  Source: [P95] 3.2 }
pob_sphere((array) c, (real) r) = r**2 - q[1]**2 - q[2]**2 - q[3]**2 WHERE q = fn_from(c);

{ The same ball by its exact distance.
  Example: pob_sphere_d([0, 0, 0], 1) AT (0, 0, 3)   // -2 }
pob_sphere_d((array) c, (real) r) = r - NORM(fn_from(c));

{ The ellipsoid about c with the half axes a, b, e.
  Example: pob_ellipsoid([0, 0, 0], 1, 0.7, 0.4) AT (0, 0, 0.4)   // 0
  Source: [P95] 4.2 }
pob_ellipsoid((array) c, (real) a, (real) b, (real) e) = 1 - (q[1]/a)**2 - (q[2]/b)**2 - (q[3]/e)**2
  WHERE q = fn_from(c);

{ The infinite cylinder of radius r about the line through c along x1.
  Example: pob_cylinder_x([0, 0, 0], 0.5) AT (7, 0.5, 0)   // 0
  Source: [P95] Fig. 6 }
pob_cylinder_x((array) c, (real) r) = r**2 - q[2]**2 - q[3]**2 WHERE q = fn_from(c);

{ The infinite cylinder of radius r about the line through c along x2.
  Example: pob_cylinder_y([0, 0, 0], 0.5) AT (0.5, 7, 0)   // 0
  Source: [P95] Fig. 6 }
pob_cylinder_y((array) c, (real) r) = r**2 - q[3]**2 - q[1]**2 WHERE q = fn_from(c);

{ The infinite cylinder of radius r about the line through c along x3.
  Example: pob_cylinder_z([0, 0, 0], 0.5) AT (0.5, 0, 7)   // 0
  Source: [P95] Fig. 6 }
pob_cylinder_z((array) c, (real) r) = r**2 - q[1]**2 - q[2]**2 WHERE q = fn_from(c);

{ The infinite elliptic cylinder through c along x1, with the half axes a along x2 and b along x3.
  Example: pob_ell_cylinder_x([0, 0, 0], 0.8, 0.4) AT (7, 0.8, 0)   // 0 }
pob_ell_cylinder_x((array) c, (real) a, (real) b) = 1 - (q[2]/a)**2 - (q[3]/b)**2 WHERE q = fn_from(c);

{ The infinite elliptic cylinder through c along x2, with the half axes a along x3 and b along x1.
  Example: pob_ell_cylinder_y([0, 0, 0], 0.8, 0.4) AT (0.4, 7, 0)   // 0 }
pob_ell_cylinder_y((array) c, (real) a, (real) b) = 1 - (q[3]/a)**2 - (q[1]/b)**2 WHERE q = fn_from(c);

{ The infinite elliptic cylinder through c along x3, with the half axes a along x1 and b along x2.
  Example: pob_ell_cylinder_z([0, 0, 0], 0.8, 0.4) AT (0.8, 0, 7)   // 0 }
pob_ell_cylinder_z((array) c, (real) a, (real) b) = 1 - (q[1]/a)**2 - (q[2]/b)**2 WHERE q = fn_from(c);

{ The cylinder of radius r between the points p and q, with flat ends.
  Example: pob_cylinder([-1, 0, 0], [1, 0, 0.5], 0.5) AT (-1, 0, 0)   // 0 }
pob_cylinder((array) p, (array) q, (real) r) = (r**2 - DOT(y, y))/(2*r) & (t & length - t)
  WHERE length = NORM(q - p), axis = (q - p)/length, t = DOT(fn_from(p), axis), y = fn_from(p) - t*axis;

{ The capsule of radius r about the segment from p to q, by its exact distance; a ball where p and q are the same. In the
  plane p and q have two elements.
  Example: pob_capsule([-1, 0, 0], [1, 0, 0.5], 0.5) AT (-2, 0, 0)   // -0.5 }
pob_capsule((array) p, (array) q, (real) r) = r - NORM(y - t*(q - p))
  WHERE y = fn_from(p), square = DOT(q - p, q - p), t = IF square > 0 THEN CLAMP(DOT(y, q - p)/square, 0, 1) ELSE 0;

{ The infinite double cone about the line through c along x1: its radius is r at the distance 1 from c.
  Example: pob_cone_x([0, 0, 0], 0.5) AT (2, 1, 0)   // 0 }
pob_cone_x((array) c, (real) r) = q[1]**2 - (q[2]/r)**2 - (q[3]/r)**2 WHERE q = fn_from(c);

{ The infinite double cone about the line through c along x2: its radius is r at the distance 1 from c.
  Example: pob_cone_y([0, 0, 0], 0.5) AT (1, 2, 0)   // 0 }
pob_cone_y((array) c, (real) r) = q[2]**2 - (q[3]/r)**2 - (q[1]/r)**2 WHERE q = fn_from(c);

{ The infinite double cone about the line through c along x3: its radius is r at the distance 1 from c.
  Example: pob_cone_z([0, 0, 0], 0.5) AT (1, 0, 2)   // 0 }
pob_cone_z((array) c, (real) r) = q[3]**2 - (q[1]/r)**2 - (q[2]/r)**2 WHERE q = fn_from(c);

{ The infinite elliptic double cone through c along x1: at the distance 1 its half axes are a along x2 and b along x3.
  Example: pob_ell_cone_x([0, 0, 0], 0.8, 0.4) AT (2, 1.6, 0)   // 0 }
pob_ell_cone_x((array) c, (real) a, (real) b) = q[1]**2 - (q[2]/a)**2 - (q[3]/b)**2 WHERE q = fn_from(c);

{ The infinite elliptic double cone through c along x2: at the distance 1 its half axes are a along x3 and b along x1.
  Example: pob_ell_cone_y([0, 0, 0], 0.8, 0.4) AT (0.8, 2, 0)   // 0 }
pob_ell_cone_y((array) c, (real) a, (real) b) = q[2]**2 - (q[3]/a)**2 - (q[1]/b)**2 WHERE q = fn_from(c);

{ The infinite elliptic double cone through c along x3: at the distance 1 its half axes are a along x1 and b along x2.
  Example: pob_ell_cone_z([0, 0, 0], 0.8, 0.4) AT (1.6, 0, 2)   // 0 }
pob_ell_cone_z((array) c, (real) a, (real) b) = q[3]**2 - (q[1]/a)**2 - (q[2]/b)**2 WHERE q = fn_from(c);

{ The cone between the points p and q with the radius r1 at p and r2 at q, one of which may be 0, with flat ends.
  Example: pob_cone([0, 0, -1], [0, 0, 1], 1, 0.25) AT (0.625, 0, 0)   // 0 }
pob_cone((array) p, (array) q, (real) r1, (real) r2) = (r1 + (r2 - r1)*t/length - NORM(y))*slope & (t & length - t)
  WHERE length = NORM(q - p), axis = (q - p)/length, t = DOT(fn_from(p), axis), y = fn_from(p) - t*axis,
        slope = length/HYPOT(length, r2 - r1);

{ The torus about the line through c along x1: R is the radius of its circle, r0 that of its tube.
  Example: pob_torus_x([0, 0, 0], 1, 0.4) AT (0.4, 1, 0)   // 0
  Source: [P95] 4.2 }
pob_torus_x((array) c, (real) R, (real) r0) = r0**2 - (HYPOT(q[2], q[3]) - R)**2 - q[1]**2 WHERE q = fn_from(c);

{ The torus about the line through c along x2: R is the radius of its circle, r0 that of its tube.
  Example: pob_torus_y([0, 0, 0], 1, 0.4) AT (1, 0.4, 0)   // 0
  Source: [P95] 4.2 }
pob_torus_y((array) c, (real) R, (real) r0) = r0**2 - (HYPOT(q[3], q[1]) - R)**2 - q[2]**2 WHERE q = fn_from(c);

{ The torus about the line through c along x3: R is the radius of its circle, r0 that of its tube.
  Example: pob_torus_z([0, 0, 0], 1, 0.4) AT (1, 0, 0.4)   // 0
  Source: [P95] 4.2 }
pob_torus_z((array) c, (real) R, (real) r0) = r0**2 - (HYPOT(q[1], q[2]) - R)**2 - q[3]**2 WHERE q = fn_from(c);

{ The torus about the line through c along x3, as pob_torus_z.
  Example: pob_torus([0, 0, 0], 1, 0.4) AT (1, 0, 0)   // 0.16000000000000003
  Source: [P95] 4.2 }
pob_torus((array) c, (real) R, (real) r0) = pob_torus_z(c, R, r0);

{ The torus about the line through c along x3 by its exact distance.
  Example: pob_torus_d([0, 0, 0], 1, 0.4) AT (1, 0, 0)   // 0.4 }
pob_torus_d((array) c, (real) R, (real) r0) = r0 - HYPOT(HYPOT(q[1], q[2]) - R, q[3]) WHERE q = fn_from(c);

{ The superellipsoid about c with the half axes a, b, e: s1 rounds it between the poles and the equator, s2 around the axis of x3. 1 is
  round, towards 0 square, 2 an octahedron.
  Example: pob_superellipsoid([0, 0, 0], 1, 1, 0.8, 0.4, 0.4) AT (0, 0, 0.8)   // 0
  Source: Barr 1981 }
pob_superellipsoid((array) c, (real) a, (real) b, (real) e, (real) s1, (real) s2) =
  1 - (ABS(q[1]/a)**(2/s2) + ABS(q[2]/b)**(2/s2))**(s2/s1) - ABS(q[3]/e)**(2/s1) WHERE q = fn_from(c);

{ The superquadric torus about c: a, b, e are the half axes of its tube, d, at least 1, how many of them its circle is wide; s1 rounds the tube,
  s2 the circle.
  Example: pob_superquadric_torus([0, 0, 0], 0.4, 0.4, 0.4, 2.5, 0.5, 0.5) AT (1, 0, 0.4)   // 0
  Source: Barr 1981 }
pob_superquadric_torus((array) c, (real) a, (real) b, (real) e, (real) d, (real) s1, (real) s2) =
  1 - ABS((ABS(q[1]/a)**(2/s2) + ABS(q[2]/b)**(2/s2))**(s2/2) - d)**(2/s1) - ABS(q[3]/e)**(2/s1) WHERE q = fn_from(c);
