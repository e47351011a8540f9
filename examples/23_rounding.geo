{ Rounding by offsets: Fig. 4c of Pasko, Adzhiev, Sourin and Savchenko (1995).

  A figure that is shrunk by a radius, and then expanded by as much, has lost no size, but its outer edges are round: no disk of that
  radius reaches into them. The left figure is the original, the middle one shrunk, the right one expanded again.

  Shows:    constant-radius offsetting by tr_offset_radius; sections side by side; values that are lengths, so that adding a constant
            shrinks by exactly that length; r_alpha = 1.
  Run:      yont examples/23_rounding.geo -o rounding.png
            yont measure examples/23_rounding.geo --at x3=2 --resolution 64
  Expected: the inner edges stay sharp; the area falls from 7.864 to 7.783, by (1 - PI/4) r**2 at each of six corners }

r_alpha = 1;

{ A plate with a notch and a hole, of half-planes and disks by their distances }
gob_plate = (x1 + 2 & 2 - x1 & x2 + 1.2 & 1.2 - x2) \ (x1 + 0.4 & 1 - x1 & x2 - 0.1) \ (0.25 - HYPOT(x1 + 1.2, x2 + 0.1));

r = 0.25;

gob_shrunk = tr_offset(gob_plate, -r);

gob_fig4c = IF x3 < 0.5 THEN gob_plate ELSE IF x3 < 1.5 THEN gob_shrunk ELSE tr_offset_radius(gob_shrunk, r);

x1 : X;  x2 : Y;  x3 : V;

x1min = -2.5;  x1max = 2.5;  x2min = -1.7;  x2max = 1.7;
x3min = 0;     x3max = 2;    x3_delta = 1;
