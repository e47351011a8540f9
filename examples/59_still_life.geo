{ A still life, after "Geometric Mentality" (Fig. 5) of Pasko, Savchenko and Sourin (1998).

  The candle with its tears in the lattice holder, the noisy vase and the reptile on its stone, on a turned table. The objects are those of
  the examples before: each is a function, and stands here under a mapping.

  Shows:    INCLUDE; objects under mappings, with their colours; many objects in one picture.
  Run:      yont examples/59_still_life.geo -o still.png --object gob_table,gob_stand,gob_wax,gob_thread,gob_fire,gob_stone,gob_pot --camera 25,22
            yont measure examples/59_still_life.geo --object gob_wax
  Expected: a scene of seven objects; the candle is one piece: Euler characteristic 2 }

INCLUDE "52_noisy_vase.geo";
INCLUDE "54_lattice.geo";
INCLUDE "55_candle.geo";
INCLUDE "57_reptile.geo";

{ An object s times as large, turned about the upright axis by the angle a, with its origin at c; its colour goes along without the s }
place((real) g, (array) c, (real) s, (real) a) = tr_rotate_z(g, a) AT ((x1 - c[1])/s, (x2 - c[2])/s, (x3 - c[3])/s);

at_stone(g) = place(g, [1.75, -1.5, 0.45], 0.42, -2.6);
at_wax(g)   = tr_rotate_z(g, 0.6) AT (x1/0.46, x2/0.46, (x3 - 0.2)/0.75);

gob_stand  = gob_holder;
gob_pot    = place(gob_noisy, [-1.9, 0.9, 0], 0.75, 0);
gob_wax    = at_wax(gob_candle);
gob_thread = at_wax(gob_wick);
gob_fire   = at_wax(gob_flame);
gob_stone  = at_stone(gob_reptile);
gob_table  = tr_round_int(3.3 - rho, 0.001 - x3, 0.12) & x3 + 0.35;

gob_stand  : COLOR = [0.8, 0.62, 0.28];
gob_pot    : COLOR = [0.75, 0.46, 0.33];
gob_wax    : COLOR = [0.96, 0.92, 0.82];
gob_thread : COLOR = [0.15, 0.12, 0.1];
gob_fire   : COLOR = [1, 0.75, 0.2];
gob_stone  : COLOR = IF at_stone(gob_lizard) > 0 AND x3 > 0.45 THEN [0.45, 0.58, 0.34] ELSE [0.66, 0.64, 0.62];
gob_table  : COLOR = ARRAY(k = 1 TO 3, [0.5, 0.3, 0.17][k]*(1 + 0.15*SIN(14*x1 + 2*fn_noise([2*x1, x2, x3]))));

x1min = -3.5;  x1max = 3.5;  x2min = -3.5;  x2max = 3.5;  x3min = -0.4;  x3max = 3.1;
