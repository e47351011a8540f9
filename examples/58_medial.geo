{ A reptile on a medial axis: Fig. 2c of Pasko, Savchenko and Sourin (1998).

  The lizard of the example before, now on a body that is reconstructed from its medial axis: points with the radii of the largest
  balls that fit, joined by edges. Both are functions, so nothing changes but the name of the body.

  Shows:    MEDIAL; tr_relief on it; an affine mapping of the drawing.
  Run:      yont examples/58_medial.geo -o branch.png --camera 215,50
            yont measure examples/58_medial.geo --object gob_branch
  Expected: a lizard on a forked branch; the branch is one piece: Euler characteristic 2 }

r_alpha = 1;

{ The right half of a lizard from the snout to the hip, and its tail to the tip and back; the left half is the mirror image of the right one }
right = [[0.16, 2.2], [0.32, 1.95], [0.34, 1.65], [0.22, 1.42], [0.38, 1.2], [0.78, 1.32], [1, 1.62], [0.95, 1.9], [1.07, 1.74], [1.2, 1.9], [1.2, 1.68],
         [1.42, 1.66], [1.22, 1.52], [0.98, 1.06], [0.44, 0.86], [0.5, 0.4], [0.42, 0.05], [0.98, 0], [1.2, -0.5], [1.42, -0.62], [1.24, -0.7], [1.22, -0.94],
         [1.1, -0.78], [0.93, -0.92], [1, -0.6], [0.8, -0.26], [0.34, -0.4]];
tail  = [[0.3, -0.9], [0.42, -1.4], [0.4, -1.9], [0.15, -2.35], [-0.3, -2.6], [0, -2.2], [0.12, -1.85], [0.1, -1.45], [-0.12, -0.95]];
left  = ARRAY(k = 1 TO LEN(right), [-right[LEN(right) + 1 - k][1], right[LEN(right) + 1 - k][2]]);

outline = JOIN(JOIN(right, tail), left);

gob_lizard = POLYGON(ARRAY(k = 1 TO LEN(outline), outline[k][1]), ARRAY(k = 1 TO LEN(outline), outline[k][2]));

{ The medial axis: points, their radii, and the edges between them }
points     = [[-0.3, -3, -0.4], [0.1, -1.6, 0], [0, 0.6, 0.1], [-0.8, 2.3, -0.2], [-1.3, 3.4, -0.1], [1.4, 2.4, 0.4], [2.2, 3.4, 0.9], [-1.8, -2.2, 0.6]];
radii      = [1.05, 1.2, 1.3, 0.9, 0.6, 0.6, 0.35, 0.3];
edges      = [[1, 2], [2, 3], [3, 4], [4, 5], [3, 6], [6, 7], [2, 8]];
gob_branch = MEDIAL(points, radii, edges);

{ The drawing, smaller and turned, on the upper side alone }
gob_drawing = 0.9*(tr_rotate_z(gob_lizard, 0.15) AT (x1/0.9, (x2 + 0.3)/0.9));
depth       = IF x3 > 0 THEN 0.35*SQRT(MAX(gob_drawing, 0)) ELSE 0;

gob_reptile = tr_relief(gob_branch, depth);
gob_reptile : COLOR = IF gob_drawing > 0 AND x3 > 0 THEN [0.85, 0.55, 0.2] ELSE [0.5, 0.4, 0.33];

x1min = -2.4;  x1max = 3.2;  x2min = -4.2;  x2max = 4.2;  x3min = -1.6;  x3max = 2;
