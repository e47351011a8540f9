{ A candle with its tears: the candle of "Geometric Mentality" (Fig. 5) of Pasko, Savchenko and Sourin (1998).

  A cylinder whose top was split off along a wavy surface, united by blending with drops of wax that ran down: each a body about a medial axis
  of points with radii. The flame is one, too.

  Shows:    MEDIAL; a half-space with a wavy boundary; blending union; several objects with colours of their own.
  Run:      yont examples/55_candle.geo -o candle.png --object gob_candle,gob_wick,gob_flame
            yont measure examples/55_candle.geo --object gob_candle
  Expected: a candle with tears that hang together with it: Euler characteristic 2 }

{ A point on the side of the candle, and a tear that runs from the height a to b and ends in a drop }
side(t, h) = [0.53*COS(t), 0.53*SIN(t), h];
pob_tear(t, a, b) = MEDIAL([side(t, a), side(t + 0.1, (a + b)/2), side(t + 0.06, b)], [0.12, 0.075, 0.13], [[1, 2], [2, 3]]);

{ The wax melted away from the top, towards the wick and to one side }
melted = x3 - 2.55 + 0.12*SIN(3*x1 + 1)*COS(4*x2) - 0.55*(x1**2 + x2**2) - 0.12*x1;

gob_cylinder = (0.25 - x1**2 - x2**2 & x3 & 2.9 - x3) \ melted;
gob_tears    = pob_tear(4.0, 2.6, 1.2) | pob_tear(5.1, 2.65, 1.75) | pob_tear(5.7, 2.6, 0.6) | pob_tear(0.6, 2.6, 1.5) | pob_tear(2.4, 2.5, 1);
gob_candle   = tr_bl_uni(gob_cylinder, gob_tears, 0.02, 0.05, 0.05);

gob_wick  = MEDIAL([[0, 0, 2.3], [0, 0, 2.75], [0.05, 0, 2.9]], [0.035, 0.03, 0.025], [[1, 2], [2, 3]]);
gob_flame = MEDIAL([[0.03, 0, 2.98], [0.03, 0, 3.1], [0.02, 0, 3.6]], [0.07, 0.13, 0.005], [[1, 2], [2, 3]]);

gob_candle : COLOR = [0.96, 0.92, 0.82];
gob_wick   : COLOR = [0.15, 0.12, 0.1];
gob_flame  : COLOR = [1, 0.62 + 0.35*CLAMP(3.5 - x3, 0, 1), 0.15];

x1min = -0.8;  x1max = 0.8;  x2min = -0.8;  x2max = 0.8;  x3min = -0.1;  x3max = 3.7;
