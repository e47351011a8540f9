{ Conics: one definition for ellipse, parabola and hyperbola.

  A point belongs to a conic if its distance from the focus is e times its distance from the directrix; within, it is
  less. So e*d - r is a defining function, and with e as a coordinate each conic is a section of one object. The exact
  gradient tells a theorem: above the focus the tangent climbs as steeply as the eccentricity says.

  Shows:    a plane problem; sections of a coordinate (type G) in one plot; GRAD, a relation and a body with PRINT.
  Run:      yont examples/21_conics.geo -o conics.png --size 600x600
            the same with -o conics.svg for the outlines
  Expected: prints `[0, 1] is on the ellipse: 1` and `slopes [0.5, 0.75, 1, 1.5]`;
            two ellipses, a parabola, and both branches of a hyperbola }

e         = [0.5, 0.75, 1, 1.5];
focus     = [0, 0];
directrix = -2;

distance  = HYPOT(x1 - focus[1], x2 - focus[2]);
gob_conic = x3*ABS(x1 - directrix) - distance;

{ Whether the point p is on the boundary of the conic of eccentricity e, but for rounding }
rel_on(p, e) = ABS(gob_conic AT (p[1], p[2], e)) < 1e-12;

{ The point of the conic above the focus, and the slope of the tangent there: across the gradient }
above(e) = [focus[1], focus[2] + e*(focus[1] - directrix)];
slope(e) = -g[1]/g[2] WHERE p = above(e), g = GRAD(gob_conic) AT (p[1], p[2], e);

PRINT above(e[1]), "is on the ellipse:", rel_on(above(e[1]), e[1]);
PRINT "slopes", ARRAY(i = 1 TO LEN(e), slope(e[i]));

x1 : X;  x2 : Y;  x3 : G = e;

x1min = -7;  x1max = 7;
x2min = -7;  x2max = 7;
