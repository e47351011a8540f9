{ Primitives as landscapes: Fig. 6 and 7 of Hanson (1990).

  The value w of a primitive over the plane. The single-faced (19) is a ratio of two circles with a zero on one side and a
  pole on the other, both tamed; cut at the height 1 it shows the straight line that bounds its half-plane. The ring is a
  moat; cut at a height it is a ring of the plane.

  Shows:    fn_face19, fn_ring; a graph over the plane as a solid; sections as columns of a sheet.
  Run:      yont examples/33_lp_fields.geo -o fields.png
            yont measure examples/33_lp_fields.geo --at x4=2
  Expected: the ratio with its peak, the ratio cut above 1, so that a plateau ends in a straight edge, and the moat; the
            second has the Euler characteristic 2 }

ratio = fn_face19([1, 0], 0.5, [-0.25, 0], 0.28);
moat  = (fn_ring(1, 1))**2;

w = IF x4 < 1.5 THEN MIN(ratio, 4)/2 ELSE IF x4 < 2.5 THEN MIN(ratio, 1) ELSE MIN(moat, 1.2);

gob_field = w - x3;

x1 : X;  x2 : Y;  x3 : Z;  x4 : V;

x1min = -1.5;  x1max = 1.5;  x2min = -1.5;  x2max = 1.5;  x3min = -0.1;  x3max = 2.1;
x4min = 1;     x4max = 3;    x4_delta = 1;
camera = [30, 42];
