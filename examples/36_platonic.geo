{ Platonic solids by their blending parameter: Fig. 11 of Akleman (1992).

  Each is the smooth intersection of half-spaces, (sum H(n.x)^p)^(1/p) <= 1 over the normals n of its faces. With p = 2 each
  of them but the tetrahedron is a ball; with p = 16 nearly the solid itself.

  Shows:    STAR with one polyhedron; arrays of arrays of objects, chosen by two coordinates.
  Run:      yont examples/36_platonic.geo -o platonic.png
            yont measure examples/36_platonic.geo --at x4=1,x5=3
  Expected: tetrahedron, cube, octahedron, dodecahedron and icosahedron, each for p = 2, 4, 8, 16; the octahedron's ball has
            the radius 0.7*SQRT(3/4), so volume = 0.9332; Euler characteristic 2 }

signs = [1, -1];
g     = (1 + SQRT(5))/2;

corners = ARRAY(k = 0 TO 7, [signs[k - 2*FLOOR(k/2) + 1], signs[FLOOR(k/2) - 2*FLOOR(k/4) + 1], signs[FLOOR(k/4) + 1]]/SQRT(3));
{ The twelve permutations of [0, a, b] in cyclic order with all signs }
cyclic(a, b) = JOIN(ARRAY(k = 0 TO 3, [0, s(k)*a, t(k)*b]), ARRAY(k = 0 TO 3, [t(k)*b, 0, s(k)*a]), ARRAY(k = 0 TO 3, [s(k)*a, t(k)*b, 0]));
s(k) = signs[MOD(k, 2) + 1];
t(k) = signs[FLOOR(k/2) + 1];

cube = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]];
tetrahedron  = [corners[1], corners[4], corners[6], corners[7]];
dodecahedron = cyclic(1, g)/HYPOT(1, g);
icosahedron  = JOIN(corners, cyclic(1/g, g)/SQRT(3));

normals = [tetrahedron, cube, corners, dodecahedron, icosahedron];
solids  = ARRAY(k = 1 TO 5, ARRAY(i = 1 TO 4, STAR([normals[k]/size[k]], 2**i, INFINITY)));
size    = [0.6, 0.8, 0.7, 1, 1];

gob_platonic = solids[x5, x4];

x1 : X;  x2 : Y;  x3 : Z;  x4 : V;  x5 : W;

x1min = -1.3;  x1max = 1.3;  x2min = -1.3;  x2max = 1.3;  x3min = -1.3;  x3max = 1.3;
x4min = 1;     x4max = 4;    x4_delta = 1;
x5min = 1;     x5max = 5;    x5_delta = 1;
