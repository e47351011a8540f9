// Deformations

{ From s1 at the place u1 to s2 at u2, at the place u.
  Example: fn_between(5, 4, 6, 10, 20)   // 15 }
fn_between((real) u, (real) u1, (real) u2, (real) s1, (real) s2) = s1 + (s2 - s1)*(u - u1)/(u2 - u1);

{ The object twisted about the axis of x1: turned by the angle t1 at x1 = u1, by t2 at x1 = u2, and on beyond them.
  Example: tr_twist_x(pob_box([0, 0, 0], [2.4, 1, 0.4]), -1, 1, 0, PI/2) AT (1, 0, 0.5)   // 0
  Source: Barr 1984 }
tr_twist_x((gob/pob) g, (real) u1, (real) u2, (real) t1, (real) t2) = tr_rotate_x(g, fn_between(x1, u1, u2, t1, t2));

{ The object twisted about the axis of x2: turned by the angle t1 at x2 = u1, by t2 at x2 = u2, and on beyond them.
  Example: tr_twist_y(pob_box([0, 0, 0], [0.4, 2.4, 1]), -1, 1, 0, PI/2) AT (0.5, 1, 0)   // 0
  Source: Barr 1984 }
tr_twist_y((gob/pob) g, (real) u1, (real) u2, (real) t1, (real) t2) = tr_rotate_y(g, fn_between(x2, u1, u2, t1, t2));

{ The object twisted about the axis of x3: turned by the angle t1 at x3 = u1, by t2 at x3 = u2, and on beyond them.
  Example: tr_twist_z(pob_box([0, 0, 0], [1, 0.4, 2.4]), -1, 1, 0, PI/2) AT (0, 0.5, 1)   // 0
  Source: Barr 1984 }
tr_twist_z((gob/pob) g, (real) u1, (real) u2, (real) t1, (real) t2) = tr_rotate_z(g, fn_between(x3, u1, u2, t1, t2));

{ The object tapered along x1: s1 times as wide up to x1 = u1, s2 times from u2 on; both factors are positive.
  Example: tr_taper_x(pob_box([0, 0, 0], [2, 1, 1]), -1, 1, 1, 0.3) AT (0.9, 0, 0) > 0   // 1
  Source: Barr 1984 }
tr_taper_x((gob/pob) g, (real) u1, (real) u2, (real) s1, (real) s2) = g AT (x2 = x2/s, x3 = x3/s)
  WHERE s = fn_between(CLAMP(x1, MIN(u1, u2), MAX(u1, u2)), u1, u2, s1, s2);

{ The object tapered along x2: s1 times as wide up to x2 = u1, s2 times from u2 on; both factors are positive.
  Example: tr_taper_y(pob_box([0, 0, 0], [1, 2, 1]), -1, 1, 1, 0.3) AT (0, 0.9, 0) > 0   // 1
  Source: Barr 1984 }
tr_taper_y((gob/pob) g, (real) u1, (real) u2, (real) s1, (real) s2) = g AT (x3 = x3/s, x1 = x1/s)
  WHERE s = fn_between(CLAMP(x2, MIN(u1, u2), MAX(u1, u2)), u1, u2, s1, s2);

{ The object tapered along x3: s1 times as wide up to x3 = u1, s2 times from u2 on; both factors are positive.
  Example: tr_taper_z(pob_box([0, 0, 0], [1, 1, 2]), -1, 1, 1, 0.3) AT (0, 0, 0.9) > 0   // 1
  Source: Barr 1984 }
tr_taper_z((gob/pob) g, (real) u1, (real) u2, (real) s1, (real) s2) = g AT (x1 = x1/s, x2 = x2/s)
  WHERE s = fn_between(CLAMP(x3, MIN(u1, u2), MAX(u1, u2)), u1, u2, s1, s2);

{ Where the point (y, z) was before a rod along y was bent towards z with the curvature k, between y1 and y2 and about y0.
  Example: fn_bent(0, 0, 1, 0, -1, 1)   // [0, 0]
  Source: Barr 1984 }
fn_bent((real) y, (real) z, (real) k, (real) y0, (real) y1, (real) y2) = IF k == 0 THEN [y, z] ELSE
  ([t/k + y0 + (y - y0)*COS(t) + (z - q)*SIN(t), q - (y - y0)*SIN(t) + (z - q)*COS(t)]
   WHERE q = 1/k, t = CLAMP(ATAN2(SIGN(k)*(y - y0), SIGN(k)*(q - z)), MIN(k*(y1 - y0), k*(y2 - y0)), MAX(k*(y1 - y0), k*(y2 - y0))));

{ The object bent about an axis along x1: what lies along x2 from y1 to y2 becomes an arc of the curvature k that rises towards x3; x2 = y0 stays.
  Example: tr_bend_x(pob_box([0, 0, 0], [0.6, 2.4, 0.3]), 1, 0, -1, 1) AT (0, 0, 0) > 0   // 1
  Source: Barr 1984 }
tr_bend_x((gob/pob) g, (real) k, (real) y0, (real) y1, (real) y2) = g AT (x2 = q[1], x3 = q[2]) WHERE q = fn_bent(x2, x3, k, y0, y1, y2);

{ The object bent about an axis along x2: what lies along x3 from y1 to y2 becomes an arc of the curvature k that rises towards x1; x3 = y0 stays.
  Example: tr_bend_y(pob_box([0, 0, 0], [0.3, 0.6, 2.4]), 1, 0, -1, 1) AT (0, 0, 0) > 0   // 1
  Source: Barr 1984 }
tr_bend_y((gob/pob) g, (real) k, (real) y0, (real) y1, (real) y2) = g AT (x3 = q[1], x1 = q[2]) WHERE q = fn_bent(x3, x1, k, y0, y1, y2);

{ The object bent about an axis along x3: what lies along x1 from y1 to y2 becomes an arc of the curvature k that rises towards x2; x1 = y0 stays.
  Example: tr_bend_z(pob_box([0, 0, 0], [2.4, 0.3, 0.6]), 1, 0, -1, 1) AT (0, 0, 0) > 0   // 1
  Source: Barr 1984 }
tr_bend_z((gob/pob) g, (real) k, (real) y0, (real) y1, (real) y2) = g AT (x1 = q[1], x2 = q[2]) WHERE q = fn_bent(x1, x2, k, y0, y1, y2);

{ How much of a control point is felt at the place e, in parts of its reach: 1 at 0, nothing beyond 1.
  Example: fn_reach(0)   // 1 }
fn_reach((real) e) = IF e < 1 THEN (1 - e)**3/(1 + e) ELSE 0;

{ Space deformed so that each point from[k] comes to the place goal[k], and what is far away stays; the larger b, a number or one for each coordinate,
  the farther it is felt. from and goal are arrays of points.
  Example: tr_space_map(pob_sphere([0, 0, 0], 1), [[0, 0, 1]], [[0, 0, 1.6]], 0.8) AT (0, 0, 1.6)   // 0
  Source: Schmitt, Kazakov, Pasko, Savchenko 2000 }
tr_space_map((gob/pob) g, (array) from, (array) goal, b) =
  g AT (fn_point(LEN(goal[1])) - SUM(k = 1 TO LEN(goal), fn_reach(NORM(fn_from(goal[k])/(b*(1 + ABS(goal[k] - from[k])))))*(goal[k] - from[k])));

{ The bell curve at the place e: 1 at the origin.
  Example: fn_spread([0, 0])   // 1 }
fn_spread((array) e) = EXP(-DOT(e, e));

{ The same with an exponential reach, which never quite ends.
  Example: tr_space_map_exp(pob_sphere([0, 0, 0], 1), [[0, 0, 1]], [[0, 0, 1.6]], 0.4) AT (0, 0, 1.6)   // 0
  Source: Schmitt, Kazakov, Pasko, Savchenko 2000 }
tr_space_map_exp((gob/pob) g, (array) from, (array) goal, b) =
  g AT (fn_point(LEN(goal[1])) - SUM(k = 1 TO LEN(goal), fn_spread(fn_from(goal[k])/(b*(1 + ABS(goal[k] - from[k]))))*(goal[k] - from[k])));
