{ A walk through an object of five dimensions.

  Three coordinates are space, x4 is time and x5 goes from column to column: a body |x1|**p + |x2|**p + |x3|**p <= 1
  with p = 2**x5 and a hole of radius x4 through it. What shows as what is said in the types alone: x4 : V; x5 : T;
  walks the other way.

  Shows:    geometric types; an object of five coordinates; a sheet of pictures that moves.
  Run:      yont examples/09_five_dimensions.geo -o walk.apng
            the same with -o walk-(n).png, n in braces, for the sheets of each moment
  Expected: an octahedron, a ball and two cubes ever less rounded beside each other, whose hole grows }

p = 2**x5;

gob_body = 1 - ABS(x1)**p - ABS(x2)**p - ABS(x3)**p;
gob_hole = x4**2 - x1**2 - x2**2;
gob_walk = gob_body \ gob_hole;

x1 : X;  x2 : Y;  x3 : Z;  x4 : T;  x5 : V;

x1min = -1.1;  x1max = 1.1;  x2min = -1.1;  x2max = 1.1;  x3min = -1.1;  x3max = 1.1;
x4min = 0;     x4max = 0.6;  x4_delta = 0.15;
x5min = 0;     x5max = 3;    x5_delta = 1;
