{ The Empty Case: a small system of one's own, from nothing.

  Pasko, Adzhiev, Sourin and Savchenko (1995) imagine an "absolutely first user", who has no library and makes a modelling system of primitives
  and operations alone. Here it is one for lamps: what is turned, what is arranged around an axis, how parts grow together.
  With --no-prelude every name is still free; without it the program means the same, since a user's own names win.

  Shows:    primitives, operations and a relation of one's own, that stand on each other; --no-prelude.
  Run:      yont examples/25_empty_case.geo --no-prelude -o lamp.png
            yont examples/25_empty_case.geo --no-prelude -o lamp.stl --resolution 200
  Expected: a lamp with a foot, a stem, a ring of seven knobs and a shade that is open below; `below 0 beside 1`: what is
            dark }

{ Primitives: a ball, a slab, and what lies within r of the axis }
pob_ball(c, r)     = r - SQRT((x1-c[1])**2 + (x2-c[2])**2 + (x3-c[3])**2);
pob_slab(lo, hi)   = MIN(x3 - lo, hi - x3);
pob_rod((real) r)  = r - SQRT(x1**2 + x2**2);

{ Operations: parts that flow into each other, a wall under the surface, copies around the axis }
tr_melt((gob/pob) g1, (gob/pob) g2, (real) r) = (g1 + g2 + SQRT((g1 - g2)**2 + r**2))/2;
tr_wall((gob/pob) g, (real) t)                = MIN(g, t - g);
tr_around((gob/pob) g, (real) n) =
  UNION(k = 1 TO n, g AT (x1*COS(2*PI*k/n) + x2*SIN(2*PI*k/n), x2*COS(2*PI*k/n) - x1*SIN(2*PI*k/n)));

{ A relation: whether the light at the middle of the shade does not shine straight on the point }
rel_dark((array) p) = MAXIMUM(k = 0 TO 50, gob_shade AT (bulb + (p - bulb)*k/50)) >= 0;

bulb = [0, 0, 2.2];

gob_foot  = MIN(pob_slab(0, 0.25), pob_rod(0.9));
gob_stem  = MIN(pob_slab(0, 1.9), pob_rod(0.12 + 0.04*COS(6*x3)));
gob_knobs = MIN(pob_ball([0.62, 0, 0.3], 0.15), 1);
gob_shade = MIN(tr_wall(pob_rod(1.5 - 0.45*x3 + 0.03*COS(24*ATAN2(x2, x1))), 0.07), pob_slab(1.6, 2.8));

gob_lamp = tr_melt(tr_melt(gob_foot, gob_stem, 0.2), tr_around(gob_knobs, 7), 0.1) | gob_shade
         | MIN(pob_slab(1.75, 1.85), MIN(pob_rod(0.66), 0.05 - MIN(ABS(x1), ABS(x2))));

PRINT "below", rel_dark([0.5, 0.5, 0.5]), "beside", rel_dark([3, 0, 2.2]);

x1min = -1.2;  x1max = 1.2;  x2min = -1.2;  x2max = 1.2;  x3min = -0.2;  x3max = 2.9;
