{ A tree that is made of smaller trees.

  A tree is a twig, and at its tip three trees, each of them smaller, tilted and turned about the twig. A definition
  that calls itself says just that; where it stops there are leaves. Position and direction go from call to call as a
  point and a matrix: mappings within mappings (AT) would do as well, but a single step tells more about far boxes.

  Shows:    recursion of a primitive; matrices and their product; arrays as arguments; RANDOM; a body with local names.
  Run:      yont examples/20_tree.geo -o tree.png
            the same with -D seed=7 for another tree, with -D depth=3 for a young one
  Expected: prints `121 twigs, 243 leaves`; a small tree with its leaves }

seed  = 3 IN [1, 99] STEP 1;
depth = 5 IN [0, 6]  STEP 1;

{ How many trees begin at a level, by counting those below }
twigs(n) = IF n = 0 THEN 0 ELSE 1 + 3*twigs(n-1);
PRINT twigs(depth), "twigs,", 3**depth, "leaves";

{ The product of two matrices, and of a matrix and a vector }
compose(a, b) = ARRAY(i = 1 TO LEN(a), ARRAY(j = 1 TO LEN(b[1]), SUM(k = 1 TO LEN(b), a[i][k]*b[k][j])));
applied(a, v) = ARRAY(i = 1 TO LEN(a), DOT(a[i], v));

{ Turned about the third axis, and tilted towards the first, by an angle. The rows are the axes of what is turned }
turned(phi) = [[COS(phi), SIN(phi), 0], [-SIN(phi), COS(phi), 0], [0, 0, 1]];
tilted(phi) = [[COS(phi), 0, -SIN(phi)], [0, 1, 0], [SIN(phi), 0, COS(phi)]];

{ A twig of length 1 from the origin upwards; it ends as thick as the next ones begin }
gob_twig = 0.12 - 0.04*t - SQRT(x1**2 + x2**2 + (x3 - t)**2) WHERE t = CLAMP(x3, 0, 1);
gob_leaf = 0.3 - SQRT((2*x1)**2 + (1.2*x2)**2 + (0.8*(x3 - 0.4))**2);

{ The object g, s times as large, with its origin at p and its axes along the rows of m }
tr_placed((gob/pob) g, (array) p, (array) m, (real) s) = s*(g AT (applied(m, [x1, x2, x3] - p)/s));

{ A tree of n levels; i tells its random numbers from those of any other }
pob_tree((real) n, (real) i, (array) p, (array) m, (real) s) = BEGIN
  IF (n = 0) THEN pob_tree = tr_placed(gob_leaf, p, m, s)
  ELSE BEGIN
    pob_tree = tr_placed(gob_twig, p, m, s);
    FOR k = 1 TO 3 DO BEGIN
      b    = 3*i + k;
      turn = 2*PI*(k + 0.6*RANDOM(seed + 1, b))/3;
      tilt = 0.45 + 0.35*RANDOM(seed + 2, b);
      size = s*(0.62 + 0.16*RANDOM(seed, b));
      pob_tree = MAX(pob_tree, pob_tree(n - 1, b, p + s*m[3], compose(compose(tilted(tilt), turned(turn)), m), size));
    END;
  END;
END;

gob_tree = pob_tree(depth, 0, [0, 0, 0], [[1,0,0], [0,1,0], [0,0,1]], 1);

x1min = -1.6;  x1max = 1.6;
x2min = -1.6;  x2max = 1.6;
x3min = -0.2;  x3max = 3.2;
