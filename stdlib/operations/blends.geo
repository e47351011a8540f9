// Blends and edges

{ What a blend adds to the set operation of g1 and g2: a0 where both vanish, less away from there; a1 and a2 say how far it reaches.
  Example: fn_blend_displacement(1, 0, 2, 1, 1)   // 1
  Source: [P95] (7) }
fn_blend_displacement((real) g1, (real) g2, (real) a0, (real) a1, (real) a2) = a0/(1 + (g1/a1)**2 + (g2/a2)**2);

{ Blending union: a0 > 0 adds material where both boundaries meet, a0 < 0 takes some away; the larger a1 and a2, the farther it reaches
  along g1 and g2.
  Example: tr_bl_uni(pob_sphere([-0.7, 0, 0], 0.8), pob_sphere([0.7, 0, 0], 0.8), 0.3, 1, 1) AT (0, 0, 0) > 0   // 1
  Source: [P95] (6), (7) }
tr_bl_uni((gob/pob) g1, (gob/pob) g2, (real) a0, (real) a1, (real) a2) = (g1 | g2) + fn_blend_displacement(g1, g2, a0, a1, a2);

{ Blending intersection: a0 < 0 rounds the edge where both boundaries meet, a0 > 0 adds material there.
  Example: tr_bl_int(3, 4, -26, 1, 1)   // 1
  Source: [P95] (8) }
tr_bl_int((gob/pob) g1, (gob/pob) g2, (real) a0, (real) a1, (real) a2) = (g1 & g2) + fn_blend_displacement(g1, g2, a0, a1, a2);

{ Blending subtraction of g2 from g1: a0 < 0 rounds the edge of the cut, a0 > 0 adds material there.
  Example: tr_bl_sub(3, -4, -26, 1, 1)   // 1
  Source: [P95] (6), (7) }
tr_bl_sub((gob/pob) g1, (gob/pob) g2, (real) a0, (real) a1, (real) a2) = (g1 \ g2) + fn_blend_displacement(g1, g2, a0, a1, a2);

{ What a bounded blend adds: nothing where g3 <= 0, and a0 where g1 and g2 vanish inside g3; a3 says how soon it ends towards the boundary of g3.
  Example: fn_bounded_displacement(0, 0, 2, 1, 1, 1, 1)   // 2
  Source: Pasko et al. 2005 }
fn_bounded_displacement((real) g1, (real) g2, (real) a0, (real) a1, (real) a2, (real) g3, (real) a3) =
  IF g3 > 0 THEN (a0*(1 - rho)**3/(1 + rho) WHERE s = (g1/a1)**2 + (g2/a2)**2, rho = s/(s + (g3/a3)**2)) ELSE 0;

{ Blending union that changes nothing outside of g3.
  Example: tr_bl_bounded(pob_sphere([-0.7, 0, 0], 0.8), pob_sphere([0.7, 0, 0], 0.8), 0.6, 1, 1, pob_sphere([0, 0, 0], 1), 1) AT (0, 0, 0) > 0   // 1
  Source: Pasko et al. 2005 }
tr_bl_bounded((gob/pob) g1, (gob/pob) g2, (real) a0, (real) a1, (real) a2, (gob/pob) g3, (real) a3) =
  (g1 | g2) + fn_bounded_displacement(g1, g2, a0, a1, a2, g3, a3);

{ Blending intersection that changes nothing outside of g3.
  Example: tr_bl_bounded_int(3, 4, -26, 1, 1, -1, 1)   // 2
  Source: Pasko et al. 2005 }
tr_bl_bounded_int((gob/pob) g1, (gob/pob) g2, (real) a0, (real) a1, (real) a2, (gob/pob) g3, (real) a3) =
  (g1 & g2) + fn_bounded_displacement(g1, g2, a0, a1, a2, g3, a3);

{ Blending subtraction of g2 from g1 that changes nothing outside of g3.
  Example: tr_bl_bounded_sub(3, -4, -26, 1, 1, -1, 1)   // 2
  Source: Pasko et al. 2005 }
tr_bl_bounded_sub((gob/pob) g1, (gob/pob) g2, (real) a0, (real) a1, (real) a2, (gob/pob) g3, (real) a3) =
  (g1 \ g2) + fn_bounded_displacement(g1, g2, a0, a1, a2, g3, a3);

{ Union with a chamfer of the legs r in the inner edge; for objects whose values are lengths, as of tr_normalize.
  Example: tr_chamfer_uni(pob_box_d([0, 0, -0.4], [2, 2, 0.8]), pob_box_d([0, 0, 0.5], [0.8, 0.8, 1]), 0.3) AT (0.5, 0, 0.05) > 0   // 1 }
tr_chamfer_uni((gob/pob) g1, (gob/pob) g2, (real) r) = MAX(g1, g2, (g1 + g2 + r)/SQRT(2));

{ Intersection with a chamfer of the legs r on the edge; for objects whose values are lengths.
  Example: tr_chamfer_int(pob_sphere_d([0, 0, -0.5], 1), pob_sphere_d([0, 0, 0.5], 1), 0.2) AT (0.85, 0, 0) < 0   // 1 }
tr_chamfer_int((gob/pob) g1, (gob/pob) g2, (real) r) = MIN(g1, g2, (g1 + g2 - r)/SQRT(2));

{ Subtraction of g2 from g1 with a chamfer of the legs r on the edge; for objects whose values are lengths.
  Example: tr_chamfer_sub(pob_box_d([0, 0, -0.4], [2, 2, 0.8]), pob_sphere_d([0, 0, 0], 0.6), 0.2) AT (0.65, 0, -0.05) < 0   // 1 }
tr_chamfer_sub((gob/pob) g1, (gob/pob) g2, (real) r) = tr_chamfer_int(g1, -g2, r);

{ Union with the inner edge rounded by the radius r, exactly so at right angles; for objects whose values are lengths.
  Example: tr_round_uni(pob_box_d([0, 0, -0.4], [2, 2, 0.8]), pob_box_d([0, 0, 0.5], [0.8, 0.8, 1]), 0.3) AT (0.45, 0, 0.05) > 0   // 1 }
tr_round_uni((gob/pob) g1, (gob/pob) g2, (real) r) =
  IF ABS(g1 - g2) < r THEN (g1 + g2 + 2*r - SQRT(2*r**2 - (g1 - g2)**2))/2 ELSE MAX(g1, g2);

{ Intersection with the edge rounded by the radius r, exactly so at right angles; for objects whose values are lengths.
  Example: tr_round_int(pob_sphere_d([0, 0, -0.5], 1), pob_sphere_d([0, 0, 0.5], 1), 0.2) AT (0.85, 0, 0) < 0   // 1 }
tr_round_int((gob/pob) g1, (gob/pob) g2, (real) r) =
  IF ABS(g1 - g2) < r THEN (g1 + g2 - 2*r + SQRT(2*r**2 - (g1 - g2)**2))/2 ELSE MIN(g1, g2);

{ Subtraction of g2 from g1 with the edge rounded by the radius r; for objects whose values are lengths.
  Example: tr_round_sub(pob_box_d([0, 0, -0.4], [2, 2, 0.8]), pob_sphere_d([0, 0, 0], 0.6), 0.2) AT (0.61, 0, -0.01) < 0   // 1 }
tr_round_sub((gob/pob) g1, (gob/pob) g2, (real) r) = tr_round_int(g1, -g2, r);

{ A groove of depth d and width 2 w in g1, along its meeting with the boundary of g2; for objects whose values are lengths.
  Example: tr_groove(pob_sphere_d([0, 0, 0], 1), x3, 0.1, 0.1) AT (0.95, 0, 0) < 0   // 1 }
tr_groove((gob/pob) g1, (gob/pob) g2, (real) d, (real) w) = MIN(g1, MAX(g1 - d, ABS(g2) - w));

{ A pipe of radius r along the curve in which the boundaries of g1 and g2 meet; for objects whose values are lengths.
  Example: tr_pipe(pob_sphere_d([0, 0, 0], 1), x3 - x1/2, 0.15) AT (0, 1, 0)   // 0.15 }
tr_pipe((gob/pob) g1, (gob/pob) g2, (real) r) = r - HYPOT(g1, g2);
