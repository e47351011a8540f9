// Mappings

{ The object moved by the vector v, along as many coordinates as that has elements.
  Example: tr_shift(pob_sphere([0, 0, 0], 1), [0.5, 0, 0.5]) AT (1.5, 0, 0.5)   // 0
  Source: [P95] (11) }
tr_shift((gob/pob) g, (array) v) = g AT (fn_from(v));

{ The object s times as large along x1, x2 and x3, seen from the origin.
  Example: tr_scale(pob_sphere([0, 0, 0], 1), 1.5) AT (1.5, 0, 0)   // 0
  Source: [P95] (11) }
tr_scale((gob/pob) g, (real) s) = g AT (x1/s, x2/s, x3/s);

{ The object stretched from the point c by a factor for each coordinate: s has as many elements as c.
  Example: tr_stretch(pob_sphere([0, 0, 0], 1), [0, 0, 0], [1.5, 1, 0.5]) AT (1.5, 0, 0)   // 0
  Source: [P95] (11) }
tr_stretch((gob/pob) g, (array) c, (array) s) = g AT (c + fn_from(c)/s);

{ The object turned about the axis of x1 by the angle a, from x2 towards x3.
  Example: tr_rotate_x(pob_box([0, 0, 0], [2, 2, 0.5]), PI/2) AT (0, 0, 1)   // 0
  Source: [P95] (11) }
tr_rotate_x((gob/pob) g, (real) a) = g AT (x2 = x2*COS(a) + x3*SIN(a), x3 = x3*COS(a) - x2*SIN(a));

{ The object turned about the axis of x2 by the angle a, from x3 towards x1.
  Example: tr_rotate_y(pob_box([0, 0, 0], [2, 2, 0.5]), PI/2) AT (0, 0, 1)   // 0
  Source: [P95] (11) }
tr_rotate_y((gob/pob) g, (real) a) = g AT (x3 = x3*COS(a) + x1*SIN(a), x1 = x1*COS(a) - x3*SIN(a));

{ The object turned about the axis of x3 by the angle a, from x1 towards x2.
  Example: tr_rotate_z(pob_box([0, 0, 0], [2, 0.5, 0.5]), PI/2) AT (0, 1, 0)   // 0
  Source: [P95] (11) }
tr_rotate_z((gob/pob) g, (real) a) = g AT (x1 = x1*COS(a) + x2*SIN(a), x2 = x2*COS(a) - x1*SIN(a));

{ The object turned by the angle a about the axis through the origin in the direction of the vector axis, against the clock as seen from its tip.
  Example: tr_rotate(pob_box([0, 0, 0], [2, 0.5, 0.5]), [1, 1, 1], 2*PI/3) AT (0, 0.9, 0) > 0   // 1
  Source: [P95] (11) }
tr_rotate((gob/pob) g, (array) axis, (real) a) = g AT (q*COS(a) + CROSS(q, u)*SIN(a) + u*DOT(u, q)*(1 - COS(a)))
  WHERE u = axis/NORM(axis), q = [x1, x2, x3];

{ The mirror image of the object at the plane n.x = d.
  Example: tr_mirror(pob_sphere([1, 0, 0], 0.5), [1, 0, 0], 0) AT (-1, 0, 0)   // 0.25
  Source: [P95] (11) }
tr_mirror((gob/pob) g, (array) n, (real) d) = g AT (q - 2*(DOT(n, q) - d)/DOT(n, n)*n) WHERE q = fn_point(LEN(n));

{ The determinant of a square matrix, an array of rows.
  Example: fn_det([[2, 1], [1, 3]])   // 5 }
fn_det((array) A) = IF LEN(A) <= 1 THEN A[1][1] ELSE SUM(j = 1 TO LEN(A), A[1][j]*fn_cofactor(A, 1, j));

{ The determinant of a matrix without its row i and its column j, with the sign of their place.
  Example: fn_cofactor([[2, 1], [1, 3]], 1, 2)   // -1 }
fn_cofactor((array) A, (real) i, (real) j) = IF LEN(A) <= 1 THEN 1 ELSE
  (1 - 2*MOD(i + j, 2))*fn_det(ARRAY(r = 1 TO LEN(A) - 1, ARRAY(s = 1 TO LEN(A) - 1,
    A[r + (IF r < i THEN 0 ELSE 1)][s + (IF s < j THEN 0 ELSE 1)])));

{ The object under the affine mapping that takes each point X to A X + C; A is an array of rows whose determinant is not 0, and may depend on time.
  Example: tr_affine(pob_circle([0, 0], 0.5), [[2, 1], [0, 1]], [0.1, 0]) AT (1.1, 0)   // 0
  Source: [P95] (11) }
tr_affine((gob/pob) g, (array) A, (array) C) =
  g AT (ARRAY(i = 1 TO LEN(C), SUM(j = 1 TO LEN(C), fn_cofactor(A, j, i)*q[j])/d)) WHERE q = fn_from(C), d = fn_det(A);

{ The object g of cylindrical coordinates (radius, angle, height) as one of space; angles go from -PI to PI.
  Example: tr_cylindrical((1 - x1) & (0.25 - x2**2) & (1 - x3**2)) AT (0.5, 0, 0) > 0   // 1
  Source: [P95] (10) }
tr_cylindrical((gob/pob) g) = g AT (HYPOT(x1, x2), ATAN2(x2, x1), x3);

{ The object g of spherical coordinates (radius, angle around the axis of x3 from -PI to PI, angle from that axis from 0 to PI) as one of space.
  Example: tr_spherical(1 + 0.3*COS(6*x2)*SIN(x3)**3 - x1) AT (1.3, 0, 0)   // 0
  Source: [P95] 2.2.4 }
tr_spherical((gob/pob) g) = g AT (NORM([x1, x2, x3]), ATAN2(x2, x1), ATAN2(HYPOT(x1, x2), x3));
