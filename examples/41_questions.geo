{ Questions: a ring and a bar, asked where they meet, what is nearest and how large they are.

  A bar goes through a ring. CURVE gives the seams in which the surfaces meet, as polylines; MEDIAL makes beads of them. CLOSEST gives the points of the ring
  and of the bar that are nearest to a lamp, and rods lead there. The block below stands as far down as it must to be free of the ring, which INTERSECTS
  decides, and the bar's end knobs are of the size that makes both together as heavy as the block. Change a number, and all of it follows.

  Shows:    CURVE, CLOSEST, DISTANCE, INTERSECTS, VOLUME and BOUNDS within definitions.
  Run:      yont examples/41_questions.geo -o questions.png --object gob_seams,gob_lamp,gob_rods,gob_ring,gob_bar,gob_block
            yont measure examples/41_questions.geo --object gob_ring
  Expected: the ring has the volume = 14.2122; it prints `2 seams, a gap of 0.1 below the ring` }

gob_ring = pob_torus_y([0, 0, 0], 2, 0.6);
gob_bar  = (0.4**2 - (x2 + 0.25*x1)**2 - (x3 - 0.2)**2) & 3.6 - ABS(x1) | pob_sphere([3.6, -0.9, 0.2], knob) | pob_sphere([-3.6, 0.9, 0.2], knob);

{ Beads on the seams: every tenth point of each polyline }
seams = CURVE(gob_ring, gob_bar);
bead(line, k) = line[MIN(10*k - 9, LEN(line))];
pob_string(line) = MEDIAL(ARRAY(k = 1 TO n, bead(line, k)), ARRAY(k = 1 TO n, 0.07), ARRAY(k = 1 TO n - 1, [k, k + 1]))
  WHERE n = CEIL(LEN(line)/10) + 1;
gob_seams = UNION(i = 1 TO LEN(seams), pob_string(seams[i]));

{ The lamp, and rods to what is nearest }
lamp = [1.2, -2.6, 2.6];
gob_lamp = pob_sphere(lamp, 0.28);
gob_rods = pob_capsule(lamp, CLOSEST(gob_ring, lamp), 0.05) | pob_capsule(lamp, CLOSEST(gob_bar, lamp), 0.05);

{ The block comes up in steps of a tenth as long as it does not touch the ring }
size = [3, 1.6, 0.8];
pob_stone(z) = pob_box([0, 0, z], size);
top = -4;
WHILE (NOT INTERSECTS(gob_ring, pob_stone(top + 0.1))) DO top = top + 0.1;
gob_block = pob_stone(top);

{ Two knobs are to weigh as much as the block }
knob = (VOLUME(gob_block)*3/8/PI)**(1/3);

gap = BOUNDS(gob_ring)[3, 1] - BOUNDS(gob_block)[3, 2];
PRINT LEN(seams), "seams, a gap of", ROUND(1000*gap)/1000, "below the ring";

gob_ring  : COLOR = [0.75, 0.8, 0.86];
gob_bar   : COLOR = [0.9, 0.75, 0.45];
gob_seams : COLOR = [0.75, 0.1, 0.1];
gob_lamp  : COLOR = [1, 0.9, 0.3];
gob_rods  : COLOR = [0.95, 0.55, 0.1];
gob_block : COLOR = [0.45, 0.5, 0.55];

x1min = -5;  x1max = 5;
x2min = -3.1;  x2max = 2.3;
x3min = -4.5;  x3max = 3.1;
camera = [-60, 18];
