{ Lp solids: Fig. 10 and 11 of Hanson (1990).

  A pentagonal slab is the `and` of seven half-spaces. The conical indentation above it is one more term of that `and`: the
  `or` of four half-spaces that meet at small angles. Under it the exponents grow from left to right.

  Shows:    fn_face19 in space; `or` within `and`; one exponent for all blends.
  Run:      yont examples/31_lp_solids.geo -o slabs.png
            yont measure examples/31_lp_solids.geo --at x4=4,x5=1 --resolution 160
  Expected: the slab from a smooth blob to its edges, and below it the same with a pit; nearly sharp the slab is
            a prism of 5*0.8^2*TAN(PI/5) times 0.8, so volume = 1.857 }

exponents = [1, 2, 6, 40];
p = exponents[x4];

{ The half-space n.x <= c; n need not be a unit vector }
face(n, c) = fn_face19(n/NORM(n), c, [0, 0, 0], 0.01);

sides = ARRAY(k = 1 TO 5, face([COS(2*PI*k/5 + PI/2), SIN(2*PI*k/5 + PI/2), 0], 0.8));
caps  = [face([0, 0, 1], 0.4), face([0, 0, -1], 0.4)];
slab  = JOIN(sides, caps);

{ Four planes through one point above the middle }
cone = ARRAY(k = 1 TO 4, face([0.55*COS(PI*k/2), 0.55*SIN(PI*k/2), 1], 0.08));

gob_slab = pob_lp(fn_lp_and(slab, p), 1);
gob_pit  = pob_lp(fn_lp_and(JOIN(slab, [fn_lp_or(cone, p)]), p), 1);
gob_lp   = IF x5 < 1.5 THEN gob_slab ELSE gob_pit;

x1 : X;  x2 : Y;  x3 : Z;  x4 : V;  x5 : W;

x1min = -1.1;  x1max = 1.1;  x2min = -1.1;  x2max = 1.1;  x3min = -0.6;  x3max = 0.6;
x4min = 1;     x4max = 4;    x4_delta = 1;
x5min = 1;     x5max = 2;    x5_delta = 1;
camera = [25, 40];
