{ One variable: the three graphs of Fig. 1 of Pasko, Adzhiev, Sourin and Savchenko (1995), below each other.

  The segment from 1 to 3 is the intersection of two rays, by three systems of R-functions: equation (3), which is the
  minimum, (4), and (5) with m = 1. They agree in sign everywhere; only the first has a corner inside the segment.

  Shows:    graphs; R-functions of different continuity side by side; a coordinate that shows as the rows of a sheet.
  Run:      yont examples/07_graphs.geo -o graphs.png
  Expected: three graphs, each of them >= 0 from 1 to 3; the first with a corner at 2 }

left  = x1 - 1;
right = 3 - x1;

r_alpha = 1;  gob_a = left & right;
r_alpha = 0;  gob_b = left & right;
r_m = 1;      gob_c = left & right;

{ Fig. 1 a, b, c for x2 = 1, 2, 3 }
gob_fig1 = IF x2 < 1.5 THEN gob_a ELSE IF x2 < 2.5 THEN gob_b ELSE gob_c;

x1 : X;  x2 : W;

x1min = 0;  x1max = 4;
x2min = 1;  x2max = 3;  x2_delta = 1;
