{ A fractal: the quaternions whose orbit under z -> z^2 + c stays near 0, cut at x4 = 0.

  Shows:    WHILE with a condition that differs from point to point: the loop runs at each point, and over whole boxes where all of
            a box goes the same way; a section of a four-dimensional object.
  Run:      yont examples/18_escape.geo -o escape.png
            yont examples/18_escape.geo -o escape.stl --resolution 128 -v
  Expected: a curled solid with holes; -v tells how many turns the loop took }

{ The real part and the three imaginary parts of c }
c = [-0.213, -0.0410, -0.563, -0.560];

{ The orbit of the point, for ten steps or until it is far away }
z = [x1, x2, x3, x4];
r = 0;
n = 0;
WHILE (n < 10 AND r <= 16) DO BEGIN
  z = [z[1]**2 - z[2]**2 - z[3]**2 - z[4]**2, 2*z[1]*z[2], 2*z[1]*z[3], 2*z[1]*z[4]] + c;
  r = DOT(z, z);
  n = n + 1;
END;

gob_escape = 16 - r;

x4 : CONSTANT = 0;
x1min = -1.1;  x1max = 1.1;  x2min = -1.1;  x2max = 1.1;  x3min = -1.1;  x3max = 1.1;
