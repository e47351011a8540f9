// Patterns

{ The object repeated without end: period has a number for each coordinate, 0 where there is no repetition. What is not within half a period of the
  origin is cut off.
  Example: tr_repeat(pob_sphere([0, 0, 0], 0.4), [1, 1, 0]) AT (17, 4, 0.4)   // 0 }
tr_repeat((gob/pob) g, (array) period) =
  g AT (ARRAY(i = 1 TO LEN(period), IF period[i] == 0 THEN q[i] ELSE q[i] - period[i]*FLOOR(q[i]/period[i] + 1/2)))
  WHERE q = fn_point(LEN(period));

{ The object repeated n[i] times along each coordinate, by period[i], onwards from the origin. What is not within half a period of a copy's centre is
  cut off between the copies.
  Example: tr_repeat_n(pob_sphere([0, 0, 0], 0.4), [1, 1, 1], [3, 2, 1]) AT (2, 1, 0.4)   // 0 }
tr_repeat_n((gob/pob) g, (array) period, (array) n) =
  g AT (ARRAY(i = 1 TO LEN(period),
    IF n[i] <= 1 THEN q[i] ELSE q[i] - period[i]*CLAMP(FLOOR(q[i]/period[i] + 1/2), 0, n[i] - 1)))
  WHERE q = fn_point(LEN(period));

{ The union of n copies of the object, turned about the axis of x3 by equal angles.
  Example: tr_polar_array(pob_sphere([1, 0, 0], 0.4), 6) AT (0.5, SQRT(3)/2, 0) > 0   // 1 }
tr_polar_array((gob/pob) g, (real) n) = UNION(k = 0 TO n - 1, tr_rotate_z(g, 2*PI*k/n));

{ The union of n copies of the object, each moved by the vector v from the one before.
  Example: tr_linear_array(pob_sphere([-1, 0, 0], 0.4), [0.7, 0, 0.2], 4) AT (1.1, 0, 0.6) > 0   // 1 }
tr_linear_array((gob/pob) g, (array) v, (real) n) = UNION(k = 0 TO n - 1, tr_shift(g, k*v));
