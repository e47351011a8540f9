// Relations

{ S2: 1 where the point p belongs to the object, else 0.
  Example: rel_inside(pob_sphere([0, 0, 0], 1), [1, 0, 0])   // 1
  Source: [P95] (16) }
rel_inside((gob/pob) g, (array) p) = (g AT (p)) >= 0;

{ S3: 2 where the point p is inside of the object, 1 on its boundary, 0 outside. The boundary is where the point would be inside and outside if its
  place were changed by a part in 10**12; objects that vanish inside are not told from their boundary.
  Example: rel_membership(pob_sphere([0, 0, 0], 1), [0.6, 0.8, 0])   // 1
  Source: [P95] (17) }
rel_membership((gob/pob) g, (array) p) =
  IF ABS(value) <= 1e-12*(1 + NORM(p))*NORM(GRAD(g) AT (p)) THEN 1 ELSE IF value > 0 THEN 2 ELSE 0
  WHERE value = g AT (p);

{ How far the line q[1] + q[2]*x passes above the point p = [x, y]: a residual for FIT, and a pattern for others.
  Example: fn_line_residual([1, 2], [3, 4])   // 3
  Source: least squares }
fn_line_residual((array) q, (array) p) = q[1] + q[2]*p[1] - p[2];
