{ Aesthetic blending: Fig. 8 of Pasko, Adzhiev, Sourin and Savchenko (1995).

  The user draws a stroke, and FIT finds the parameters of the blending union of two blocks whose boundary follows it best. The picture
  shows the blocks, what the blend adds to them, and the points of the stroke.

  Shows:    FIT; tr_bl_uni; a colour for each part.
  Run:      yont examples/44_fit.geo -o fit.png
            yont measure examples/44_fit.geo
  Expected: the fillet follows the stroke, the area = 8.69 }

gob_low = pob_rectangle([0, -1], [4, 1.2]);
gob_high = pob_rectangle([-1, 0.2], [1.2, 2.4]);
{ The stroke: from the side of the upper block down to the top of the lower one }
stroke = [[-0.38, 1.1], [-0.3, 0.72], [-0.17, 0.4], [0.02, 0.13], [0.27, -0.09], [0.58, -0.24], [0.95, -0.33], [1.35, -0.38]];
fn_residual(q, p) = tr_bl_uni(gob_low, gob_high, q[1], q[2], q[3]) AT (p);
q = FIT(fn_residual, [0.5, 1, 1], stroke);
gob_blocks = MAX(gob_low, gob_high);
gob_stroke = MAXIMUM(i = 1 TO LEN(stroke), pob_circle(stroke[i], 0.05));
gob_blend = tr_bl_uni(gob_low, gob_high, q[1], q[2], q[3]);
gob_blend : COLOR = IF gob_stroke >= 0 THEN [0.8, 0.2, 0.1] ELSE IF gob_blocks >= 0 THEN [0.45, 0.55, 0.7] ELSE [0.75, 0.82, 0.9];
x1min = -2.4; x1max = 2.4; x2min = -2; x2max = 1.8;
