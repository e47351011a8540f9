// Carving and chasing

{ The object turned and moved so that its axis of x3 points along n and its origin lies at p; its axis of x1 stays level, and is turned about n by
  the angle a.
  Example: tr_place(pob_tool_cone(0.4, 1.6), [0, 0, 0.5], [0, -1, 0], 0) AT (0, 0.8, 0.5)   // 0
  Source: [P95] (11) }
tr_place((gob/pob) g, (array) p, (array) n, (real) a) =
  g AT (DOT(q, u*COS(a) + w*SIN(a)), DOT(q, w*COS(a) - u*SIN(a)), DOT(q, e))
  WHERE q = fn_from(p), e = n/NORM(n), h = HYPOT(e[1], e[2]), u = IF h > 1e-9 THEN [-e[2]/h, e[1]/h, 0] ELSE [1, 0, 0], w = CROSS(e, u);

{ The object carved with a cutter: what the cutter holds is taken away. With b > 0 the edge of the cut is rounded, as with sand paper, and nothing
  changes farther than b from the cutter; for cutters whose values are lengths.
  Example: tr_carve(pob_sphere_d([0, 0, 0], 1), pob_sphere_d([0, 0, 1], 0.4), 1) AT (0, 0, 0.6)   // -0.09
  Source: Pasko and Savchenko 1998 }
tr_carve((gob/pob) g, (gob/pob) cutter, (real) b) =
  IF b > 0 THEN MIN(g, -cutter) - MAX(b - ABS(g + cutter), 0)**2/(4*b) ELSE MIN(g, -cutter);

{ The object chased with a die: what the die holds is added, as when metal is raised from behind. With b > 0 the die goes over into the object
  smoothly, and nothing changes farther than b from it; for dies whose values are lengths.
  Example: tr_chase(pob_sphere_d([0, 0, 0], 1), pob_sphere_d([0, 0, 1], 0.5), 0) AT (0, 0, 1.5)   // 0
  Source: Pasko and Savchenko 1998 }
tr_chase((gob/pob) g, (gob/pob) die, (real) b) =
  IF b > 0 THEN MAX(g, die) + MAX(b - ABS(g - die), 0)**2/(4*b) ELSE MAX(g, die);

{ A cutter about the origin: the ellipsoid with the half axes a, b along the surface and e into it. Its values are no longer than distances.
  Example: pob_tool_ellipsoid(0.4, 0.2, 0.1) AT (0.4, 0, 0)   // 0
  Source: Pasko and Savchenko 1998 }
pob_tool_ellipsoid((real) a, (real) b, (real) e) = (1 - NORM([x1/a, x2/b, x3/e]))*MIN(a, b, e);

{ A cutter about the origin: the drill of radius r and height h along x3.
  Example: pob_tool_drill(0.1, 1) AT (0.1, 0, 0)   // 0 }
pob_tool_drill((real) r, (real) h) = MIN(r - HYPOT(x1, x2), h/2 - ABS(x3));

{ A cutter about the origin: the cone of height h with its tip at x3 = -h/2 and the radius r at x3 = h/2.
  Example: pob_tool_cone(0.2, 0.4) AT (0, 0, -0.2)   // 0 }
pob_tool_cone((real) r, (real) h) = MIN((r*(x3/h + 1/2) - HYPOT(x1, x2))*h/HYPOT(h, r), h/2 - x3);

{ A cutter about the origin: the wedge of length l along x1, with its edge at x3 = -h/2 and the width w at x3 = h/2.
  Example: pob_tool_chisel(1, 0.2, 0.4) AT (0, 0.1, 0.2)   // 0 }
pob_tool_chisel((real) l, (real) w, (real) h) = MIN((w/2*(x3/h + 1/2) - ABS(x2))*h/HYPOT(h, w/2), h/2 - x3, l/2 - ABS(x1));
