// Products, projections and sweeps

{ The plane figure g of x1 and x2 as the section of an upright solid from x3 = 0 to h.
  Example: tr_extrude(pob_star_polygon([0, 0], 5, 1, 0.4), 0.5) AT (0, 0, 0.5)   // 0
  Source: [P95] (13) }
tr_extrude((gob/pob) g, (real) h) = g @ (x3 & h - x3);

{ The plane figure g turned about the axis of x3: its x1 is the distance from the axis, its x2 the height.
  Example: tr_revolve(pob_circle([1, 0], 0.4)) AT (0, 1, 0.4)   // 0
  Source: [P95] 2.2.7 }
tr_revolve((gob/pob) g) = g AT (HYPOT(x1, x2), x3);

{ The plane figure g swept along an endless helix of radius R and pitch P about the axis of x3: its x1 points away from the axis, its x2 along it; it
  stands across the helix.
  Example: (tr_sweep_helix(pob_circle([0, 0], 0.3), 1, 1.2) & 1.44 - x3**2) AT (1, 0, 0) > 0   // 1 }
tr_sweep_helix((gob/pob) g, (real) R, (real) P) =
  MAXIMUM(j = -1 TO 1, g AT (HYPOT(x1, x2) - R, c*(x3 - P*(turn + k + j))))
  WHERE turn = ATAN2(x2, x1)/(2*PI), k = FLOOR(x3/P - turn + 1/2), c = 2*PI*R/HYPOT(2*PI*R, P);

{ The solid that becomes the plane figure g2 at x3 = h from the plane figure g1 at x3 = 0.
  Example: tr_loft(pob_rectangle([0, 0], [2, 2]), pob_circle([0, 0], 0.6), 1.4) AT (0.6, 0, 1.4)   // 0
  Source: [P95] 2.2.8 }
tr_loft((gob/pob) g1, (gob/pob) g2, (real) h) = tr_metamorphosis(g1, g2, x3/h) @ (x3 & h - x3);

{ The number of a coordinate that is given as itself or as that number: 3 for x3.
  Example: fn_axis(x3)   // 3 }
fn_axis((real) axis) = (axis + x16) AT (1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 0);

{ The point with another value of one coordinate, x3 or 3, say.
  Example: fn_with(x2, 7)[2]   // 7 }
fn_with((real) axis, (real) value) = ARRAY(i = 1 TO 15, IF i == fn_axis(axis) THEN value ELSE fn_point(15)[i]);

{ The projection of the object along a coordinate, x3 or 3, say: the union of its sections from lo to hi.
  Example: tr_project(pob_torus([0, 0, 0], 1, 0.4), x3, -1, 1) AT (1, 0)   // 0.16000000000000003
  Source: [P95] (12) }
tr_project((gob/pob) g, (real) axis, (real) lo, (real) hi) = PROJECT(g AT (fn_with(axis, x16)), x16, lo, hi);

{ The section of the object at one value of a coordinate, x3 or 3, say.
  Example: tr_section(pob_torus([0, 0, 0], 1, 0.4), x3, 0.2) AT (1, 0)   // 0.12000000000000002
  Source: [P95] 2.2.6 }
tr_section((gob/pob) g, (real) axis, (real) value) = g AT (fn_with(axis, value));

{ What the object sweeps while it is moved along the path from t0 to t1: path(t) is a point.
  Example: tr_sweep(pob_sphere_d([0, 0, 0], 0.3), fn_circle_path, 0, PI) AT (0, 1, 0) > 0.2999   // 1
  Source: [P95] 2.2.6, 4.3 }
tr_sweep((gob/pob) g, (function) path, (real) t0, (real) t1) = PROJECT(tr_move(g, path, x16), x16, t0, t1);

{ The circle of radius 1 in the plane of x1 and x2 as a path, for tries.
  Example: fn_circle_path(0)   // [1, 0, 0] }
fn_circle_path((real) t) = [COS(t), SIN(t), 0];
