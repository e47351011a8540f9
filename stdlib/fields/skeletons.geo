// Fields of skeletons

{ Squares of the distances from the points of an array, one for each.
  Example: fn_squares([[0, 0, 0], [3, 0, 0]]) AT (0, 4, 0)   // [16, 25] }
fn_squares((array) P) = ARRAY(i = 1 TO LEN(P), DOT(fn_from(P[i]), fn_from(P[i])));

{ A number for each of n parts: a itself where it is an array, else n times a.
  Example: fn_each(2, 3)   // [2, 2, 2] }
fn_each(a, (real) n) = a + ARRAY(i = 1 TO n, 0);

{ Blinn's blobby object: a sum of exponential fields of strength b and narrowness a about the points P, where it exceeds T. a and b are numbers,
  or arrays with one for each point.
  Example: pob_blobby([[-0.6, 0, 0], [0.6, 0, 0]], 2, 1, 0.5) AT (0, 0, 0) > 0   // 1
  Source: Blinn 1982 }
pob_blobby((array) P, a, b, (real) T) = SUM(fn_each(b, LEN(P))*EXP(-a*fn_squares(P))) - T;

{ Metaballs: a sum of fields of strength b about the points P that end at the distance d, where it exceeds T. b and d are numbers, or arrays with
  one for each point.
  Example: pob_metaball([[-0.6, 0, 0], [0.6, 0, 0]], 1, 1.5, 0.4) AT (0, 0, 0) > 0   // 1
  Source: Nishimura 1985 }
pob_metaball((array) P, b, d, (real) T) = SUM(i = 1 TO LEN(P), fn_metaball(SQRT(s[i])/r[i])*h[i]) - T
  WHERE s = fn_squares(P), r = fn_each(d, LEN(P)), h = fn_each(b, LEN(P));

{ The field of a metaball of strength 1 at the distance u, in parts of the distance at which it ends.
  Example: fn_metaball(1/3)   // 0.6666666666666667
  Source: Nishimura 1985 }
fn_metaball((real) u) = IF u <= 1/3 THEN 1 - 3*u**2 ELSE IF u < 1 THEN 1.5*(1 - u)**2 ELSE 0;

{ Wyvill's soft object: a sum of fields about the points P that end at the distance d, where it exceeds T. d is a number, or an array with one for
  each point.
  Example: pob_soft([[-0.6, 0, 0], [0.6, 0, 0]], 1.5, 0.4) AT (-0.6, 0, 0) > 0   // 1
  Source: Wyvill 1986 }
pob_soft((array) P, d, (real) T) = SUM(fn_soft(fn_squares(P)/(d*d), LEN(P))) - T;

{ Wyvill's fields for an array of n squares of distances, in parts of the squares at which they end.
  Example: fn_soft([0, 1/4, 2], 3)   // [1, 0.5, 0]
  Source: Wyvill 1986 }
fn_soft((array) u, (real) n) = ARRAY(i = 1 TO n, IF u[i] < 1 THEN (1 - u[i])**2*(1 - 4*u[i]/9) ELSE 0);

{ The field 1/(1 + S**2 r**2)**2 of a point a at the distance r: Cauchy's kernel of width 1/S.
  Example: fn_cauchy_point([0, 0, 0], 1) AT (1, 0, 0)   // 0.25
  Source: McCormack, Sherstyuk 1998 }
fn_cauchy_point((array) a, (real) S) = 1/(1 + S**2*DOT(fn_from(a), fn_from(a)))**2;

{ Cauchy's kernel of width 1/S summed along the segment from a to b.
  Example: fn_cauchy_line([-1, 0, 0], [1, 0, 0], 1) AT (0, 0, 0)   // 1.2853981633974483
  Source: McCormack, Sherstyuk 1998 }
fn_cauchy_line((array) a, (array) b, (real) S) =
  xi/(2*P**2*(P**2 + S**2*xi**2)) + (l - xi)/(2*P**2*(P**2 + S**2*(l - xi)**2)) + (ATAN(S*xi/P) + ATAN(S*(l - xi)/P))/(2*S*P**3)
  WHERE l = NORM(b - a), u = (b - a)/l, xi = DOT(fn_from(a), u), y = fn_from(a) - xi*u, P = SQRT(1 + S**2*DOT(y, y));

{ Cauchy's kernel of width 1/S summed along the arc from a angle 0 to the angle t of the circle of radius R about c in the plane of x1 and x2.
  Example: fn_cauchy_arc([0, 0, 0], 1, PI, 1) AT (0, 0, 0)   // 0.7853981633974483
  Source: McCormack, Sherstyuk 1998 }
fn_cauchy_arc((array) c, (real) R, (real) t, (real) S) =
  R/D**2*(B*(SIN(t - f)/(A - B*COS(t - f)) + SIN(f)/(A - B*COS(f)))
          + A/D*(t + 2*ATAN(k*SIN(t - f)/(1 - k*COS(t - f))) + 2*ATAN(k*SIN(f)/(1 - k*COS(f)))))
  WHERE q = fn_from(c), A = 1 + S**2*(DOT(q, q) + R**2), B = 2*R*S**2*HYPOT(q[1], q[2]), f = ATAN2(q[2], q[1]),
        D = SQRT((A - B)*(A + B)), k = B/(A + D);

{ Cauchy's kernel of width 1/S summed over the triangle with the corners a, b, c.
  Example: fn_cauchy_triangle([0, 0, 0], [1, 0, 0], [0, 1, 0], 1) AT (0, 0, 0) < 0.5   // 1
  Source: McCormack, Sherstyuk 1998 }
fn_cauchy_triangle((array) a, (array) b, (array) c, (real) S) =
  fn_cauchy_edge(a, b, n, S) + fn_cauchy_edge(b, c, n, S) + fn_cauchy_edge(c, a, n, S)
  WHERE m = CROSS(b - a, c - a), n = m/NORM(m);

{ What the edge from a to b of a triangle with the normal n of length 1 contributes to the sum of Cauchy's kernel over it.
  Example: fn_cauchy_edge([1, -1, 0], [1, 1, 0], [0, 0, 1], 1) AT (0, 0, 0) > 0   // 1 }
fn_cauchy_edge((array) a, (array) b, (array) n, (real) S) =
  DOT(q, CROSS(u, n))*-1*(ATAN(S*s/w) + ATAN(S*(l - s)/w))/(2*S*C*w)
  WHERE l = NORM(b - a), u = (b - a)/l, q = fn_from(a), s = DOT(q, u), C = 1 + S**2*DOT(q, n)**2,
        w = SQRT(C + S**2*DOT(q, CROSS(u, n))**2);

{ The convolution surface of the points P: where the sum of their fields, by Cauchy's kernel of width 1/S, exceeds T.
  Example: pob_convolution_point([[-0.6, 0, 0], [0.6, 0, 0]], 2, 0.3) AT (-0.6, 0, 0) > 0   // 1
  Source: McCormack, Sherstyuk 1998 }
pob_convolution_point((array) P, (real) S, (real) T) = SUM(i = 1 TO LEN(P), fn_cauchy_point(P[i], S)) - T;

{ The convolution surface of the segments from P[i] to Q[i]: where the sum of their fields, by Cauchy's kernel of width 1/S, exceeds T.
  Example: pob_convolution_line([[-1, 0, 0]], [[1, 0, 0]], 2, 0.3) AT (0, 0, 0) > 0   // 1
  Source: McCormack, Sherstyuk 1998 }
pob_convolution_line((array) P, (array) Q, (real) S, (real) T) = SUM(i = 1 TO LEN(P), fn_cauchy_line(P[i], Q[i], S)) - T;

{ The convolution surface of the line through the points P in their order: where its field, by Cauchy's kernel of width 1/S, exceeds T.
  Example: pob_convolution_polyline([[-1, 0, 0], [0, 1, 0], [1, 0, 0], [1, -1, 0]], 3, 0.2) AT (0, 1, 0) > 0   // 1
  Source: McCormack, Sherstyuk 1998 }
pob_convolution_polyline((array) P, (real) S, (real) T) = SUM(i = 1 TO LEN(P) - 1, fn_cauchy_line(P[i], P[i + 1], S)) - T;

{ The convolution surface of the arc from the angle 0 to t of the circle of radius R about c in the plane of x1 and x2: where its field, by
  Cauchy's kernel of width 1/S, exceeds T. tr_rotate turns it elsewhere.
  Example: pob_convolution_arc([0, 0, 0], 1, 4, 3, 0.2) AT (1, 0, 0) > 0   // 1
  Source: McCormack, Sherstyuk 1998 }
pob_convolution_arc((array) c, (real) R, (real) t, (real) S, (real) T) = fn_cauchy_arc(c, R, t, S) - T;

{ The convolution surface of the triangle with the corners a, b, c: where its field, by Cauchy's kernel of width 1/S, exceeds T.
  Example: pob_convolution_triangle([-1, -1, 0], [1, -1, 0], [0, 1, 0], 3, 0.1) AT (0, 0, 0) > 0   // 1
  Source: McCormack, Sherstyuk 1998 }
pob_convolution_triangle((array) a, (array) b, (array) c, (real) S, (real) T) = fn_cauchy_triangle(a, b, c, S) - T;
