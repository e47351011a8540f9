{ Hair: the strands of "Geometric Mentality" (Fig. 5) of Pasko, Savchenko and Sourin (1998).

  A strand is a generalised cylinder: at each height a figure about the point where its path passes. Here the figure is a circle of
  hairs; the three paths are one, a third of a turn apart, and what they make is a plait, which is laid down, tapered and bent as a whole.

  Shows:    generalised cylinders; a non-linear mapping after set operations; several objects under one mapping.
  Run:      yont examples/56_hair.geo -o plait.png --object gob_plait,gob_ribbon,gob_tuft
            yont measure examples/56_hair.geo --object gob_ribbon --resolution 128
  Expected: a plait of three strands that ends in a tuft; the ribbon has two loops: Euler characteristic -2 }

r_alpha = 1;

{ A cylinder of the radius r about the path (u, v) of x3, with hairs that wind around it }
pob_strand((real) u, (real) v, (real) r) = r*(1 + 0.1*ABS(SIN(9*ATAN2(x2 - v, x1 - u) + 5*x3))) - HYPOT(x1 - u, x2 - v);

{ The path of a plait: to and fro once while it goes back and forth twice }
u(t) = 0.42*SIN(t);
v(t) = 0.2*SIN(2*t);

gob_strands = UNION(k = 1 TO 3, pob_strand(u(2*x3 + 2*PI*k/3), v(2*x3 + 2*PI*k/3), 0.3)) & (x3 + 3.2 & 4 - x3);
gob_end     = 0.34 + 0.3*SIN(-x3 - 3.2) + 0.05*ABS(SIN(12*ATAN2(x2, x1) + x3)) - HYPOT(x1, x2) & (-3.2 - x3 & x3 + 5);

{ A ribbon around it all, with two loops }
pob_loop(a) = 0.1 - HYPOT(HYPOT(x1 - a, x3 + 3.2) - 0.45, x2 + 0.62);
gob_band = (0.66 - HYPOT(x1, x2) & 0.14 - ABS(x3 + 3.2)) | pob_loop(0.5) | pob_loop(-0.5);

{ Along x1 instead of x3, narrower towards the tuft, and bent }
lie((gob/pob) g) = s*(g AT ((x3 + 1.2 - 0.11*x1**2)/s, x2/s, x1)) WHERE s = 1 + 0.07*x1;

gob_plait  = lie(gob_strands);
gob_tuft   = lie(gob_end);
gob_ribbon = lie(gob_band);

gob_plait  : COLOR = [0.62, 0.38, 0.16];
gob_tuft   : COLOR = [0.62, 0.38, 0.16];
gob_ribbon : COLOR = [0.8, 0.15, 0.22];

x1min = -5.1;  x1max = 4.1;  x2min = -1.2;  x2max = 1.2;  x3min = -2.2;  x3max = 2.4;
