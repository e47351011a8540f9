// Textures

{ The object with a surface that Gardner's noise moves in and out.
  Example: tr_noisy(pob_sphere([0, 0, 0], 1), 0.6, 6, 1.4) AT (0, 0, 0)   // 1
  Source: [P95] 4.5 }
tr_noisy((gob/pob) g, (real) amplitude, (real) frequency, (real) phase) = g + pob_noise(amplitude, frequency, phase);

{ The foot of the point on the surface of g, to first order: where the straight line along the gradient meets it.
  Example: fn_foot(1 - x1) AT (5)   // [1] }
fn_foot((gob/pob) g) = fn_point(LEN(G)) - g/DOT(G, G)*G WHERE G = GRAD(g);

{ The object with hairs of that length that stand on its surface along the normals, where Gardner's noise of that frequency is at least t, from 0
  (dense) to 6 (none). They taper to their tips.
  Example: tr_fur(pob_sphere_d([0, 0, 0], 0.9), 0.3, 25, 0.3) AT (0, 0, 0) > 0   // 1
  Source: [P95] 4.5 }
tr_fur((gob/pob) g, (real) length, (real) frequency, (real) t) =
  MAX(g, MIN(g + length, (pob_noise(1, frequency, 1.4) AT (fn_foot(g))) - t + 2*g/length));

{ The object with cracks of that depth and half width: along the zeros of random noise of that frequency.
  Example: tr_crackle(pob_sphere_d([0, 0, 0], 1), 3, 0.08, 0.03) AT (0, 0, 0.5) > 0   // 1
  Source: [P95] 4.5 }
tr_crackle((gob/pob) g, (real) frequency, (real) depth, (real) width) =
  tr_groove(g, fn_noise(frequency*[x1, x2, x3])/frequency, depth, width);
