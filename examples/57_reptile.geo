{ A reptile carved on a stone: Fig. 2a and 2b of Pasko, Savchenko and Sourin (1998).

  A lizard was drawn as a polygon. Its function, positive inside, is the depth by which a stone is offset along its normals, so that the
  lizard lies on the stone wherever that bends.

  Shows:    POLYGON of one's own drawing; tr_relief; noise; a colour that follows the carving.
  Run:      yont examples/57_reptile.geo -o reptile.png --camera 160,45
            yont measure examples/57_reptile.geo --object gob_lizard --at x3=0
  Expected: a lizard on a pebble; the drawing has the area = 4.21 }

r_alpha = 1;

{ The right half of a lizard from the snout to the hip, and its tail to the tip and back; the left half is the mirror image of the right one }
right = [[0.16, 2.2], [0.32, 1.95], [0.34, 1.65], [0.22, 1.42], [0.38, 1.2], [0.78, 1.32], [1, 1.62], [0.95, 1.9], [1.07, 1.74], [1.2, 1.9], [1.2, 1.68],
         [1.42, 1.66], [1.22, 1.52], [0.98, 1.06], [0.44, 0.86], [0.5, 0.4], [0.42, 0.05], [0.98, 0], [1.2, -0.5], [1.42, -0.62], [1.24, -0.7], [1.22, -0.94],
         [1.1, -0.78], [0.93, -0.92], [1, -0.6], [0.8, -0.26], [0.34, -0.4]];
tail  = [[0.3, -0.9], [0.42, -1.4], [0.4, -1.9], [0.15, -2.35], [-0.3, -2.6], [0, -2.2], [0.12, -1.85], [0.1, -1.45], [-0.12, -0.95]];
left  = ARRAY(k = 1 TO LEN(right), [-right[LEN(right) + 1 - k][1], right[LEN(right) + 1 - k][2]]);

outline = JOIN(JOIN(right, tail), left);

gob_lizard = POLYGON(ARRAY(k = 1 TO LEN(outline), outline[k][1]), ARRAY(k = 1 TO LEN(outline), outline[k][2]));

{ A pebble, a little uneven, with values that are about lengths }
gob_pebble = 1.1*(1 - SQRT((x1/2.3)**2 + ((x2 + 0.2)/3.1)**2 + (x3/1.1)**2)) + 0.02*pob_noise(1, 2.2, 1.4);

{ Rounded, highest along the middle of the body, and on the upper side alone }
depth = IF x3 > 0 THEN 0.42*SQRT(MAX(gob_lizard, 0)) ELSE 0;

gob_reptile = tr_relief(gob_pebble, depth);
gob_reptile : COLOR = IF gob_lizard > 0 AND x3 > 0 THEN [0.45, 0.58, 0.34] ELSE [0.66, 0.64, 0.62];

x1min = -2.6;  x1max = 2.6;  x2min = -3.5;  x2max = 3.1;  x3min = -1.4;  x3max = 1.8;
