// Points and half-spaces

{ The first n coordinates of the point, as an array.
  Example: DOT(fn_point(3), [1, 10, 100]) AT (1, 2, 3)   // 321 }
fn_point((real) n) = ARRAY(i = 1 TO n, [x1, x2, x3, x4, x5, x6, x7, x8, x9, x10, x11, x12, x13, x14, x15, x16][i]);

{ The point as seen from c: the differences of the coordinates and those of c.
  Example: fn_from([1, 2, 3]) AT (4, 4, 4)   // [3, 2, 1] }
fn_from((array) c) = fn_point(LEN(c)) - c;

{ The half-space n.x <= d; with n of length 1 the value is the distance from the plane. In the plane n has two elements.
  Example: pob_halfspace([0, 0, 1], 2) AT (5, 5, 1)   // 1
  Source: [P95] 2.1 }
pob_halfspace((array) n, (real) d) = d - DOT(n, fn_point(LEN(n)));

{ The intersection of the half-spaces N[i].x <= D[i]: N is an array of normals, D one of as many numbers.
  Example: pob_halfspaces([[1, 1, 1], [-1, 0, 0], [0, -1, 0], [0, 0, -1]], [2, 0, 0, 0]) AT (0, 0, 0)   // 0
  Source: [P95] 2.1 }
pob_halfspaces((array) N, (array) D) = INTERSECTION(i = 1 TO LEN(D), pob_halfspace(N[i], D[i]));
