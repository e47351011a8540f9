{ A relief from a line drawing, after "Geometric Mentality" of Pasko, Savchenko and Sourin (1998).

  A fish is drawn by strokes. SCATTER makes a smooth height of points along them (1) and of a grid of points around (falling to 0), and
  tr_relief raises the front of an ellipsoid by it.

  Shows:    SCATTER; tr_relief; arrays made by functions.
  Run:      yont examples/43_relief.geo -o relief.png
            yont measure examples/43_relief.geo
  Expected: a fish on a stone, volume = 1.306 }

{ The strokes: the body, the tail, the eye, three scales }
fn_body(t) = [0.48*COS(t) + 0.12, 0.26*SIN(t)];
fn_eye(t) = [0.36 + 0.045*COS(t), 0.07 + 0.045*SIN(t)];
fn_arc(c, t) = [c + 0.09*COS(t), 0.16*SIN(t)];
strokes = JOIN(
  ARRAY(i = 1 TO 90, fn_body(2*PI*i/90)),
  ARRAY(i = 0 TO 25, [-0.35 - 0.3*i/25, 0.24*i/25]),
  ARRAY(i = 0 TO 25, [-0.35 - 0.3*i/25, -0.24*i/25]),
  ARRAY(i = 0 TO 25, [-0.65 + 0.06*SIN(PI*i/25), 0.24 - 0.48*i/25]),
  ARRAY(i = 1 TO 12, fn_eye(2*PI*i/12)),
  ARRAY(i = -8 TO 8, fn_arc(0.18, i*0.15)),
  ARRAY(i = -8 TO 8, fn_arc(0.02, i*0.15)),
  ARRAY(i = -8 TO 8, fn_arc(-0.14, i*0.15)));
fn_away(p) = MINIMUM(k = 1 TO LEN(strokes), NORM(strokes[k] - p));
grid = ARRAY(i = 0 TO 40*28, [-0.82 + 1.6*MOD(i, 41)/40, -0.42 + 0.84*FLOOR(i/41)/27]);
heights = JOIN(ARRAY(i = 1 TO LEN(strokes), 1), ARRAY(i = 1 TO LEN(grid), CLAMP(1 - fn_away(grid[i])/0.045, 0, 1)));
drawing = SCATTER(JOIN(strokes, grid), heights, 1e-9, 80, 42, x1, x3);
gob_stone = pob_ellipsoid([0, 0, 0], 1, 0.5, 0.62);
gob_carved = tr_relief(gob_stone, IF x2 < 0 THEN 0.035*drawing ELSE 0);
gob_carved : COLOR = [0.86, 0.8, 0.7];
camera = [0, 14];
light = [-55, 35];
