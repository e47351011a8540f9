// Polyhedra

{ The upright prism over a regular polygon of n sides with the inner radius r, from x3 = 0 to h.
  Example: pob_prism(6, 0.8, 1) AT (0, 0, 0)   // 0 }
pob_prism((real) n, (real) r, (real) h) = pob_regular_polygon([0, 0], n, r) @ (x3 & h - x3);

{ The pyramid over a regular polygon of n sides with the inner radius r at x3 = 0, its tip at x3 = h.
  Example: pob_pyramid(4, 0.8, 1.2) AT (0, 0, 1.2)   // 0 }
pob_pyramid((real) n, (real) r, (real) h) =
  INTERSECTION(k = 1 TO n, (r*(1 - x3/h) - x1*COS(2*PI*k/n - PI/2) - x2*SIN(2*PI*k/n - PI/2))*h/HYPOT(r, h)) & x3;

{ The regular tetrahedron about c with the inner radius r.
  Example: pob_tetrahedron([0, 0, 0], 0.5) AT (0, 0, 0) > 0   // 1 }
pob_tetrahedron((array) c, (real) r) =
  pob_halfspaces([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]]/SQRT(3), ARRAY(i = 1 TO 4, r)) AT (fn_from(c));

{ The cube about c with the inner radius r, which is half its edge.
  Example: pob_cube([0, 0, 0], 0.75) AT (0, 0.75, 0)   // 0 }
pob_cube((array) c, (real) r) = pob_box(c, [2*r, 2*r, 2*r]);

{ The regular octahedron about c with the inner radius r.
  Example: pob_octahedron([0, 0, 0], 0.6) AT (0, 0, 0) > 0   // 1 }
pob_octahedron((array) c, (real) r) =
  pob_halfspaces([[1, 1, 1], [1, 1, -1], [1, -1, 1], [1, -1, -1], [-1, 1, 1], [-1, 1, -1], [-1, -1, 1], [-1, -1, -1]]/SQRT(3),
                 ARRAY(i = 1 TO 8, r)) AT (fn_from(c));

{ The regular dodecahedron about c with the inner radius r.
  Example: pob_dodecahedron([0, 0, 0], 1) AT (0, 0, 0) > 0   // 1 }
pob_dodecahedron((array) c, (real) r) =
  pob_halfspaces([[0, 1, p], [0, 1, -p], [0, -1, p], [0, -1, -p], [p, 0, 1], [-p, 0, 1], [p, 0, -1], [-p, 0, -1],
                  [1, p, 0], [1, -p, 0], [-1, p, 0], [-1, -p, 0]]/HYPOT(1, p), ARRAY(i = 1 TO 12, r)) AT (fn_from(c))
  WHERE p = (1 + SQRT(5))/2;

{ The regular icosahedron about c with the inner radius r.
  Example: pob_icosahedron([0, 0, 0], 1) AT (0, 0, 0) > 0   // 1 }
pob_icosahedron((array) c, (real) r) =
  pob_halfspaces(JOIN([[1, 1, 1], [1, 1, -1], [1, -1, 1], [1, -1, -1], [-1, 1, 1], [-1, 1, -1], [-1, -1, 1], [-1, -1, -1]],
                      [[0, 1/p, p], [0, 1/p, -p], [0, -1/p, p], [0, -1/p, -p], [p, 0, 1/p], [-p, 0, 1/p], [p, 0, -1/p], [-p, 0, -1/p],
                       [1/p, p, 0], [1/p, -p, 0], [-1/p, p, 0], [-1/p, -p, 0]])/SQRT(3), ARRAY(i = 1 TO 20, r)) AT (fn_from(c))
  WHERE p = (1 + SQRT(5))/2;

{ A wedge: the block from the origin to size, cut off by the slope that falls from the edge x1 = 0, x3 = size[3] to x1 = size[1], x3 = 0.
  Example: pob_wedge([1.5, 1, 1]) AT (0.75, 0.5, 0.5)   // 0 }
pob_wedge((array) size) =
  ((1 - x1/size[1] - x3/size[3])*size[1]*size[3]/HYPOT(size[1], size[3]) & x1) & x3 & (x2 & size[2] - x2);
