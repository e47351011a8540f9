// Plane figures

{ The disk of radius r about c.
  Example: pob_circle([0, 0], 1) AT (0.5, 0)   // 0.75 }
pob_circle((array) c, (real) r) = r**2 - (x1 - c[1])**2 - (x2 - c[2])**2;

{ The ellipse about c with the half axes a and b.
  Example: pob_ellipse([0, 0], 1.2, 0.7) AT (0, 0.7)   // 0 }
pob_ellipse((array) c, (real) a, (real) b) = 1 - ((x1 - c[1])/a)**2 - ((x2 - c[2])/b)**2;

{ The rectangle about c with the edges size[1] and size[2].
  Example: pob_rectangle([0, 0], [2, 1]) AT (0, 0.5)   // 0 }
pob_rectangle((array) c, (array) size) = pob_box([c[1], c[2]], [size[1], size[2]]);

{ The rectangle about c with the edges size[1] and size[2], its corners rounded by the radius r; an exact distance.
  Example: pob_rectangle_round([0, 0], [2, 1], 0.3) AT (0, 1)   // -0.5 }
pob_rectangle_round((array) c, (array) size, (real) r) = pob_box_round([c[1], c[2]], [size[1], size[2]], r);

{ The regular polygon of n sides about c with the inner radius r; one side lies below.
  Example: pob_regular_polygon([0, 0], 5, 0.8) AT (0, -0.8)   // 0 }
pob_regular_polygon((array) c, (real) n, (real) r) =
  INTERSECTION(k = 1 TO n, r - (x1 - c[1])*COS(2*PI*k/n - PI/2) - (x2 - c[2])*SIN(2*PI*k/n - PI/2));

{ The star of n points about c: its points have the distance r1 from c, one of them upwards, the corners between them r2.
  Example: pob_star_polygon([0, 0], 5, 1, 0.4) AT (0, 1)   // 0 }
pob_star_polygon((array) c, (real) n, (real) r1, (real) r2) =
  (r1*b - rho*COS(phi)*b - rho*ABS(SIN(phi))*(r1 - a))/HYPOT(b, r1 - a)
  WHERE a = r2*COS(PI/n), b = r2*SIN(PI/n), rho = HYPOT(x1 - c[1], x2 - c[2]),
        phi = MOD(ATAN2(x1 - c[1], x2 - c[2]) + PI/n, 2*PI/n) - PI/n;

{ What lies within r of the segment from p to q, by its exact distance.
  Example: pob_segment([-1, 0], [1, 0.5], 0.2) AT (-1, 0)   // 0.2 }
pob_segment((array) p, (array) q, (real) r) = pob_capsule([p[1], p[2]], [q[1], q[2]], r);

{ What lies within r of the arc of radius R about c from the angle a1 to a2, by its exact distance.
  Example: pob_arc([0, 0], 1, 0.2, 0, 4) AT (1, 0)   // 0.2 }
pob_arc((array) c, (real) R, (real) r, (real) a1, (real) a2) =
  r - (IF v*COS(half) > u*SIN(half) THEN HYPOT(u - R*COS(half), v - R*SIN(half)) ELSE ABS(HYPOT(u, v) - R))
  WHERE half = MIN(ABS(a2 - a1)/2, PI), middle = (a1 + a2)/2, u = (x1 - c[1])*COS(middle) + (x2 - c[2])*SIN(middle),
        v = ABS((x2 - c[2])*COS(middle) - (x1 - c[1])*SIN(middle));

{ The ring about c: what lies within r of the circle of radius R, by its exact distance.
  Example: pob_ring([0, 0], 1, 0.25) AT (0, 1)   // 0.25 }
pob_ring((array) c, (real) R, (real) r) = r - ABS(HYPOT(x1 - c[1], x2 - c[2]) - R);

{ The superellipse about c with the half axes a and b: p = 2 is an ellipse, larger ones are squarer, 1 a rhomb.
  Example: pob_superellipse([0, 0], 1.2, 0.8, 4) AT (1.2, 0)   // 0
  Source: Barr 1981 }
pob_superellipse((array) c, (real) a, (real) b, (real) p) = 1 - ABS((x1 - c[1])/a)**p - ABS((x2 - c[2])/b)**p;
