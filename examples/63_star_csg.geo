{ Star solids among all others: drilled, set into a block, melted with balls.

  A star solid is an object like any other, so set operations, blends and mappings take it as it is. This one is a cut stone, two
  polygons on perpendicular planes, a front and a side; its lower tip is a vertex of both that a parameter moves.

  Shows:    STAR and fn_crossed in set operations and in a sum of blobs; a vertex that is moved.
  Run:      yont examples/63_star_csg.geo -o csg.png
            the same with -D tip=-0.8 for a flat stone
            yont measure examples/63_star_csg.geo --at x4=2
  Expected: a stone; drilled along three axes; in a block with a bore through both; melted with four balls. Drilled it has the
            Euler characteristic -8 }

tip = -1.3;

{ [x1, x3] and [x2, x3] }
front = [[0, tip], [0.95, 0], [0.9, 0.2], [0.6, 0.6], [-0.6, 0.6], [-0.9, 0.2], [-0.95, 0]];
side  = [[0, tip], [0.95, 0], [0.9, 0.2], [0.6, 0.6], [-0.6, 0.6], [-0.9, 0.2], [-0.95, 0]];

gob_stone = STAR([fn_crossed(front, side)], 40, 1);

{ Drilled by three cylinders }
bore(a, b) = 0.25 - HYPOT(a, b);
gob_drilled = gob_stone \ bore(x1, x2) \ bore(x2, x3) \ bore(x1, x3);

{ In a block, with a bore through both }
gob_set = (gob_stone | MIN(1 - ABS(x1), MIN(1 - ABS(x2), 0.35 - ABS(x3 + 0.9)))) \ bore(x1, x2);

{ A sum of blobs: what is inside of one is inside of the sum, and what is near to several melts }
ball(a, b, c) = 1 - HYPOT(HYPOT(x1 - a, x2 - b), x3 - c)/0.4;
gob_melted = EXP(6*gob_stone) + EXP(6*ball(1, 0, 0.1)) + EXP(6*ball(-1, 0, 0.1)) + EXP(6*ball(0, -1, 0.1)) + EXP(6*ball(0, 1, 0.1)) - 1;

gob_csg = [gob_stone, gob_drilled, gob_set, gob_melted][x4];

x1 : X;  x2 : Y;  x3 : Z;  x4 : V;

x1min = -1.6;  x1max = 1.6;  x2min = -1.6;  x2max = 1.6;  x3min = -1.5;  x3max = 0.9;
x4min = 1;     x4max = 4;    x4_delta = 1;
