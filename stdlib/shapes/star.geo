// Star solids

{ The union of two star solids of one centre, blended by p > 0: 1 - (F1^-p + F2^-p)^(-1/p) with F = 1 - g. Where g > 1 a solid is
  not of this kind, and the result is undefined.
  Example: tr_ricci_union(1 - ABS(x1), 1 - ABS(x2), 1) AT (4, 4)   // -1
  Source: [A96] 3 }
tr_ricci_union(g1, g2, p) = 1 - PNORM(SQRT(1 - g1)**2, SQRT(1 - g2)**2, -p);

{ The intersection of two star solids of one centre, blended by p > 0: 1 - (F1^p + F2^p)^(1/p) with F = 1 - g. Where g > 1 a solid is
  not of this kind, and the result is undefined.
  Example: tr_ricci_intersection(1 - ABS(x1), 1 - ABS(x2), 2) AT (3, 4)   // -4
  Source: [A96] 3 }
tr_ricci_intersection(g1, g2, p) = 1 - PNORM(SQRT(1 - g1)**2, SQRT(1 - g2)**2, p);

{ From the star solid g2 (m = 0) to g1 (m = 1): 1 - F1^m F2^(1-m) with F = 1 - g.
  Example: tr_morph_star(1 - ABS(x1), 1 - ABS(x2), 0.5) AT (4, 16)   // -7
  Source: [A92] 7.4 }
tr_morph_star(g1, g2, m) = 1 - (1 - g1)**m*(1 - g2)**(1 - m);

{ The half-spaces of a prism for STAR: one row for each edge of a convex polygon about the origin, an array of points [u, v] in order,
  drawn on the plane of the coordinates number i and j of three; its edges go along the third.
  Example: fn_prism([[2, 1], [-2, 1], [0, -4]], 1, 3)[1][3]   // 1
  Source: [A96] 5.1 }
fn_prism((array) polygon, i, j) = ARRAY(k = 1 TO LEN(polygon), (ARRAY(m = 1 TO 3, (m == i)*(b[2] - a[2])/d + (m == j)*(a[1] - b[1])/d)
  WHERE a = polygon[k], b = polygon[MOD(k, LEN(polygon)) + 1], d = a[1]*b[2] - a[2]*b[1]));

{ A convex polyhedron for STAR from two convex polygons about the origin on perpendicular planes: `front` of points [x1, x3],
  `side` of points [x2, x3]. Moving a vertex moves two half-spaces.
  Example: LEN(fn_crossed([[1, 1], [-1, 1], [-1, -1], [1, -1]], [[1, 1], [-1, 1], [0, -1]]))   // 7
  Source: [A96] 5.1 }
fn_crossed((array) front, (array) side) = JOIN(fn_prism(front, 1, 3), fn_prism(side, 2, 3));
