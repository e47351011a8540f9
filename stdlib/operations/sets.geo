// Set operations

{ Union by the R-function with that alpha, whatever system is in force: 1 is the maximum, 0 smooth away from the common edges.
  Example: tr_union(3, 4, 0)   // 12
  Source: [P95] (2) }
tr_union((gob/pob) g1, (gob/pob) g2, (real) alpha) = BEGIN r_alpha = alpha; tr_union = g1 | g2; END;

{ Intersection by the R-function with that alpha, whatever system is in force.
  Example: tr_intersection(3, 4, 1)   // 3
  Source: [P95] (2) }
tr_intersection((gob/pob) g1, (gob/pob) g2, (real) alpha) = BEGIN r_alpha = alpha; tr_intersection = g1 & g2; END;

{ Subtraction of g2 from g1 by the R-function with that alpha, whatever system is in force.
  Example: tr_subtraction(3, -4, 0)   // 2
  Source: [P95] (2) }
tr_subtraction((gob/pob) g1, (gob/pob) g2, (real) alpha) = BEGIN r_alpha = alpha; tr_subtraction = g1 \ g2; END;

{ Union by the R-function with m continuous derivatives where both objects vanish.
  Example: tr_union_m(3, 4, 1)   // 60
  Source: [P95] (5) }
tr_union_m((gob/pob) g1, (gob/pob) g2, (real) m) = BEGIN r_m = m; tr_union_m = g1 | g2; END;

{ Intersection by the R-function with m continuous derivatives where both objects vanish.
  Example: tr_intersection_m(3, 4, 1)   // 10
  Source: [P95] (5) }
tr_intersection_m((gob/pob) g1, (gob/pob) g2, (real) m) = BEGIN r_m = m; tr_intersection_m = g1 & g2; END;

{ Subtraction of g2 from g1 by the R-function with m continuous derivatives where both objects vanish.
  Example: tr_subtraction_m(3, -4, 1)   // 10
  Source: [P95] (5) }
tr_subtraction_m((gob/pob) g1, (gob/pob) g2, (real) m) = BEGIN r_m = m; tr_subtraction_m = g1 \ g2; END;

{ The object divided by the length of itself and its gradient: near the boundary its values are distances, so that blends, offsets and
  edge treatments get lengths.
  Example: tr_normalize(pob_sphere([0, 0, 0], 2)) AT (2, 0, 0)   // 0
  Source: Rvachev 1982 }
tr_normalize((gob/pob) g) = g/HYPOT(g, NORM(GRAD(g)));
