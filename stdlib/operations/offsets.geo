// Offsets

{ The object expanded by a constant that is added to its function, or shrunk by a negative one: by the length d where the values are lengths.
  Example: tr_offset(pob_sphere_d([0, 0, 0], 0.8), 0.2) AT (0, 0, 0)   // 1
  Source: [P95] 2.2.3 }
tr_offset((gob/pob) g, (real) d) = g + d;

{ The object expanded by the length d along its normals, or shrunk for d < 0; right as long as d is at most the distance from the boundary to the
  medial axis. d may differ from point to point.
  Example: tr_offset_normal(pob_ellipsoid([0, 0, 0], 0.8, 0.6, 0.5), 0.2) AT (1, 0, 0)   // 0
  Source: [P95] 2.2.3 }
tr_offset_normal((gob/pob) g, (real) d) = g AT (ARRAY(i = 1 TO LEN(G), fn_point(LEN(G))[i] + (IF s > 0 THEN d*G[i]/s ELSE 0)))
  WHERE G = GRAD(g), s = NORM(G);

{ The object expanded by balls of the radius d, so that its edges become round, or shrunk for d < 0: the highest, or lowest, value in the ball.
  Example: tr_offset_radius(pob_rectangle([0, 0], [2, 1]), 0.5) AT (1.3, 0.85) > 0   // 1
  Source: [P95] 2.2.3 }
tr_offset_radius((gob/pob) g, (real) d) = OFFSET_BALL(g, d);

{ The edges rounded by the radius r: shrunk by balls, then expanded by them. A search within a search, which takes
  long; where tr_offset shrinks exactly, as objects of distances and minima, tr_offset_radius(tr_offset(g, -r), r) is much faster.
  Example: tr_round_edges(pob_rectangle([0, 0], [2, 1]), 0.2) AT (0.97, 0.47) < 0   // 1
  Source: [P95] 2.2.3 }
tr_round_edges((gob/pob) g, (real) r) = OFFSET_BALL(OFFSET_BALL(g, -r), r);

{ A shell of thickness t under the boundary; for an object whose values are lengths.
  Example: tr_shell(pob_sphere_d([0, 0, 0], 1), 0.2) AT (0.9, 0, 0)   // 0.09999999999999998 }
tr_shell((gob/pob) g, (real) t) = MIN(g, t - g);

{ A shell of thickness t, half of it on each side of the boundary; for an object whose values are lengths.
  Example: tr_shell_centred(pob_sphere_d([0, 0, 0], 1), 0.5) AT (1, 0, 0)   // 0.25 }
tr_shell_centred((gob/pob) g, (real) t) = t/2 - ABS(g);

{ A relief: the boundary raised along its normals by the depth, a function of the coordinates, or carved in where that is negative.
  Example: tr_relief(pob_sphere([0, 0, 0], 1), 0.1*MAX(COS(8*x1)*COS(8*x2), 0)) AT (0, 0, 1.1)   // 0
  Source: [P98] }
tr_relief((gob/pob) g, (real) depth) = tr_offset_normal(g, depth);
