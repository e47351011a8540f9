{ Carving and chasing: a copper dish that is chased from behind, and a head that is carved from wood.

  Each stroke continues the workpiece, as :carve, :cut and :raise do at the prompt. The dish: hemispheres and ellipsoids are raised with blends, as metal is lifted
  from behind, and thin cutters engrave it. The head: an egg on a neck is carved with elliptical cutters of many sizes, and sanded where a stroke has
  a blend. The loops stand for strokes that follow each other; the prompt writes them one by one.

  Shows:    tr_carve, tr_chase and tr_place with tools of the set, with and without blends; extensions in loops.
  Run:      yont examples/46_carving.geo -o carving.png --object gob_dish,gob_head
  Expected: a dish with a flower of twelve petals, and beside it a head with carved hair; it prints `the dish has 147 strokes` }

{ A tool on the front of the dish, at a radius and an angle from above; it lies along the radius }
tr_dish((gob/pob) tool, (real) r, (real) a, (real) out) =
  tr_place(tool, [r*SIN(a), out, r*COS(a)], [0, -1, 0], PI/2 - a);

gob_dish = tr_round_int(pob_cylinder([0, 0.1, 0], [0, -0.1, 0], 1.5), 1.6 - NORM([x1, x2, x3]), 0.05);
strokes = 0;

{ The dish is sunk a little, and its rim stays }
gob_dish = tr_carve(gob_dish, tr_dish(pob_tool_ellipsoid(1.32, 1.32, 0.12), 0, 0, -0.16), 0.08);
{ The heart, in one blow }
gob_dish = tr_chase(gob_dish, tr_dish(pob_sphere_d([0, 0, 0], 0.3), 0, 0, 0), 0.12);
strokes = strokes + 2;
{ Twelve petals, each with a vein }
FOR k = 0 TO 11 DO BEGIN
  gob_dish = tr_chase(gob_dish, tr_dish(pob_tool_ellipsoid(0.3, 0.125, 0.13), 0.7, k*PI/6, -0.06), 0.07);
  gob_dish = tr_carve(gob_dish, tr_dish(pob_tool_ellipsoid(0.2, 0.018, 0.03), 0.72, k*PI/6, -0.19), 0.015);
  gob_dish = tr_chase(gob_dish, tr_dish(pob_sphere_d([0, 0, 0], 0.07), 1.02, (k + 0.5)*PI/6, -0.08), 0.04);
  strokes = strokes + 3;
END;
{ Seeds on the heart }
FOR k = 0 TO 6 DO BEGIN
  gob_dish = tr_carve(gob_dish, tr_dish(pob_sphere_d([0, 0, 0], 0.045), 0.14, k*2*PI/7, -0.28), 0.02);
  strokes = strokes + 1;
END;
gob_dish = tr_carve(gob_dish, tr_dish(pob_sphere_d([0, 0, 0], 0.045), 0, 0, -0.31), 0.02);
gob_dish = tr_carve(gob_dish, tr_dish(pob_torus_d([0, 0, 0], 0.36, 0.02), 0, 0, -0.07), 0.01);
strokes = strokes + 2;
{ The rim is notched and beaded }
FOR k = 0 TO 49 DO BEGIN
  gob_dish = tr_carve(gob_dish, tr_dish(pob_tool_ellipsoid(0.09, 0.03, 0.04), 1.41, k*PI/25, -0.1), 0.01);
  gob_dish = tr_chase(gob_dish, tr_dish(pob_sphere_d([0, 0, 0], 0.025), 1.27, (k + 0.5)*PI/25, -0.075), 0.01);
  strokes = strokes + 2;
END;
PRINT "the dish has", strokes, "strokes";
gob_dish : COLOR = [0.86, 0.5, 0.33];

{ The head: an egg on a neck, to begin with }
c = [2.9, 0, 0];
tr_head((gob/pob) tool, (array) p, (array) n, (real) a) = tr_place(tool, c + p, n, a);
face = [0, -1, 0];
gob_head = tr_shift(pob_tool_ellipsoid(0.66, 0.78, 0.95), c + [0, 0, 0.4]);
gob_head = tr_chase(gob_head, tr_head(pob_tool_drill(0.33, 1.4), [0, 0.1, -0.7], [0, 0.1, 1], 0), 0.3);
gob_head = tr_chase(gob_head, tr_head(pob_tool_ellipsoid(0.8, 0.5, 0.38), [0, 0.12, -1.3], [0, 0, 1], 0), 0.3);
gob_head = tr_carve(gob_head, tr_head(pob_box_d([0, 0, 0], [3, 3, 1]), [0, 0, -1.9], [0, 0, 1], 0), 0.03);
{ Both sides of the face alike: hollows, sockets, eyes, lids, brows, cheeks, ears, nostrils }
FOR side = -1 TO 1 STEP 2 DO BEGIN
  gob_head = tr_carve(gob_head, tr_head(pob_tool_ellipsoid(0.4, 0.16, 0.06), [side*0.6, -0.5, 0.1], [side, -0.7, -0.2], PI/2), 0.2);
  gob_head = tr_carve(gob_head, tr_head(pob_tool_ellipsoid(0.17, 0.12, 0.14), [side*0.24, -0.74, 0.45], [side*0.2, -1, 0], 0), 0.1);
  gob_head = tr_chase(gob_head, tr_head(pob_tool_ellipsoid(0.11, 0.085, 0.1), [side*0.235, -0.6, 0.44], face, 0), 0.02);
  gob_head = tr_carve(gob_head, tr_head(pob_tool_ellipsoid(0.13, 0.016, 0.05), [side*0.24, -0.71, 0.5], [side*0.15, -1, 0.3], side*0.1), 0.015);
  gob_head = tr_carve(gob_head, tr_head(pob_tool_ellipsoid(0.12, 0.014, 0.05), [side*0.24, -0.71, 0.385], [side*0.15, -1, -0.2], -side*0.08), 0.015);
  gob_head = tr_carve(gob_head, tr_head(pob_sphere_d([0, 0, 0], 0.028), [side*0.23, -0.71, 0.445], face, 0), 0.01);
  gob_head = tr_chase(gob_head, tr_head(pob_tool_ellipsoid(0.15, 0.035, 0.05), [side*0.25, -0.72, 0.62], [side*0.35, -1, 0.2], side*0.08), 0.05);
  gob_head = tr_chase(gob_head, tr_head(pob_sphere_d([0, 0, 0], 0.13), [side*0.33, -0.54, 0.2], face, 0), 0.14);
  gob_head = tr_chase(gob_head, tr_head(pob_tool_ellipsoid(0.2, 0.11, 0.06), [side*0.66, 0.05, 0.36], [side, -0.35, 0], PI/2), 0.04);
  gob_head = tr_carve(gob_head, tr_head(pob_tool_ellipsoid(0.12, 0.055, 0.06), [side*0.72, 0.02, 0.37], [side, -0.35, 0], PI/2), 0.03);
END;
{ The nose in three blows, the mouth, the lips, the chin }
gob_head = tr_chase(gob_head, tr_head(pob_tool_ellipsoid(0.27, 0.07, 0.12), [0, -0.78, 0.32], [0, -1, 0.28], PI/2), 0.06);
gob_head = tr_chase(gob_head, tr_head(pob_sphere_d([0, 0, 0], 0.085), [0, -0.86, 0.17], face, 0), 0.05);
FOR side = -1 TO 1 STEP 2 DO BEGIN
  gob_head = tr_chase(gob_head, tr_head(pob_sphere_d([0, 0, 0], 0.055), [side*0.08, -0.8, 0.155], face, 0), 0.03);
  gob_head = tr_carve(gob_head, tr_head(pob_sphere_d([0, 0, 0], 0.024), [side*0.05, -0.86, 0.1], face, 0), 0.015);
END;
gob_head = tr_chase(gob_head, tr_head(pob_tool_ellipsoid(0.19, 0.06, 0.09), [0, -0.68, -0.06], face, 0), 0.06);
gob_head = tr_carve(gob_head, tr_head(pob_tool_ellipsoid(0.19, 0.016, 0.08), [0, -0.77, -0.06], face, 0), 0.02);
gob_head = tr_carve(gob_head, tr_head(pob_tool_ellipsoid(0.06, 0.02, 0.04), [0, -0.79, 0.04], face, PI/2), 0.03);
gob_head = tr_chase(gob_head, tr_head(pob_sphere_d([0, 0, 0], 0.13), [0, -0.53, -0.32], face, 0), 0.14);
{ The hair: rows of long cuts, down from the crown; the face stays free }
FOR row = 0 TO 6 DO FOR k = 0 TO 17 DO BEGIN
  h = PI/2 - 0.18 - 0.23*row;  a = (k + MOD(row, 2)/2)*PI/9;
  n = [COS(h)*SIN(a)/0.66, -COS(h)*COS(a)/0.78, SIN(h)/0.95];
  p = [0.66*COS(h)*SIN(a), -0.78*COS(h)*COS(a), 0.4 + 0.95*SIN(h)];
  IF (p[2] > -0.62 + 0.75*MAX(0, 0.95 - p[3])) THEN
    gob_head = tr_carve(gob_head, tr_head(pob_tool_ellipsoid(0.19, 0.05, 0.05), p + 0.02*n/NORM(n), n, PI/2), 0.015);
END;
gob_head : COLOR = [0.78, 0.6, 0.4];
x1min = -1.6;  x1max = 4.1;  x2min = -1.1;  x2max = 0.9;  x3min = -1.6;  x3max = 1.6;
camera = [14, 10];
