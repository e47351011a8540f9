{ Guide shapes: Fig. 10 of Akleman (1992).

  A boundary that each ray meets once is made of triangles by those of a guide shape, whose vertices are moved along their rays. Here a ball
  by a tetrahedron, an octahedron, a cube and an icosahedron, the triangles of which are divided in four up to three
  times. The rounder the guide, the more even are the triangles.

  Shows:    recursion over the triangles of a mesh; points as arrays; functions as the elements of a sheet of the types V and W.
  Run:      yont examples/62_guides.geo -o guides.png
            yont measure examples/62_guides.geo --object gob_octahedron
  Expected: from above: the guides, and divided once, twice and three times; the octahedron has volume = 1.3333 and
            Euler characteristic 2 }

p = [x1, x2, x3];
on((array) a) = a/NORM(a);

{ Whether the point is on the side of c of the plane through the origin, a and b }
beside((array) a, (array) b, (array) c) = DOT(m, p)*DOT(m, c) >= 0 WHERE m = CROSS(a, b);

{ A triangle of the sphere that is divided k times: below the one of its triangles that the ray through the point meets }
pob_divided((array) a, (array) b, (array) c, (real) k) =
  IF k = 0 THEN 1 - DOT(m, p)/DOT(m, a)
  ELSE IF beside(ab, ca, a) THEN pob_divided(a, ab, ca, k - 1) ELSE IF beside(ab, bc, b) THEN pob_divided(b, bc, ab, k - 1)
  ELSE IF beside(bc, ca, c) THEN pob_divided(c, ca, bc, k - 1) ELSE pob_divided(ab, bc, ca, k - 1)
  WHERE m = CROSS(b - a, c - a), ab = on(a + b), bc = on(b + c), ca = on(c + a);

{ A side of a guide, which counts in its own cone alone }
pob_side((array) a, (array) b, (array) c, (real) k) =
  IF beside(a, b, c) AND beside(b, c, a) AND beside(c, a, b) THEN pob_divided(on(a), on(b), on(c), k) ELSE -1;

{ The guides, by the signs of coordinates and by turns of the axes }
sign = [1, -1];
g    = (1 + SQRT(5))/2;
turn((array) a, (real) n) = [a[MOD(3 - n, 3) + 1], a[MOD(4 - n, 3) + 1], a[MOD(5 - n, 3) + 1]];

four = [[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]];
tetrahedron(k) = MAXIMUM(i = 0 TO 3, pob_side(four[i + 1], four[MOD(i + 1, 4) + 1], four[MOD(i + 2, 4) + 1], k));

octahedron(k) = MAXIMUM(i = 1 TO 2, MAXIMUM(j = 1 TO 2, MAXIMUM(l = 1 TO 2,
  pob_side([sign[i], 0, 0], [0, sign[j], 0], [0, 0, sign[l]], k))));

cube(k) = MAXIMUM(n = 0 TO 2, MAXIMUM(i = 1 TO 2, MAXIMUM(j = 1 TO 2,
  pob_side(turn([sign[i], 1, 1], n), turn([sign[i], -1, -1], n), turn([sign[i], sign[j], -sign[j]], n), k))));

{ Its 8 sides within an octant, and its 12 others }
icosahedron(k) = MAX(
  MAXIMUM(i = 1 TO 2, MAXIMUM(j = 1 TO 2, MAXIMUM(l = 1 TO 2,
    pob_side([0, sign[j], g*sign[l]], [sign[i], g*sign[j], 0], [g*sign[i], 0, sign[l]], k)))),
  MAXIMUM(n = 0 TO 2, MAXIMUM(i = 1 TO 2, MAXIMUM(j = 1 TO 2,
    pob_side(turn([0, 1, g*sign[i]], n), turn([0, -1, g*sign[i]], n), turn([g*sign[j], 0, sign[i]], n), k)))));

gob_octahedron = octahedron(0);

guides(k) = [tetrahedron(k), octahedron(k), cube(k), icosahedron(k)];
gob_guides = [guides(0), guides(1), guides(2), guides(3)][x5 + 1][x4];

x1 : X;  x2 : Y;  x3 : Z;  x4 : V;  x5 : W;
x1min = -1.1;  x1max = 1.1;  x2min = -1.1;  x2max = 1.1;  x3min = -1.1;  x3max = 1.1;
x4min = 1;  x4max = 4;  x4_delta = 1;  x5min = 0;  x5max = 3;  x5_delta = 1;
