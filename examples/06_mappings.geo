{ Bijective mappings [P95] (9): the object at the inversely mapped point.

  Shows:    AT, positional and by name; a twist, a shift, a section of time.
  Run:      yont examples/06_mappings.geo -o mapped.stl
  Expected: a bar twisted by 1.5 pi with a ball on each end; Euler characteristic 2 }

{ A twist about the x3 axis: from the angle 0 at x3 = -h to the angle t at x3 = h }
tr_twist(g, h, t) = g AT (x1*COS(q) + x2*SIN(q), -x1*SIN(q) + x2*COS(q)) WHERE q = t*(x3 + h)/(2*h);

{ Moved along x3 }
tr_up(g, d) = g AT (x3 = x3 - d);

gob_bar  = (1 - x1**2) & (0.25 - x2**2) & (9 - x3**2);
gob_ball = 1.2**2 - x1**2 - x2**2 - x3**2;
gob_mapped = tr_twist(gob_bar, 3, 1.5*PI) | tr_up(gob_ball, 3.4) | tr_up(gob_ball, -3.4);

x1min = -2;  x1max = 2;
x2min = -2;  x2max = 2;
x3min = -5;  x3max = 5;
