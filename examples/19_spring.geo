{ A spring on its seat: a modelling task from a path and a fillet.

  The wire follows a path p(t). Any path will do: it is an argument of the operation, which halves it until short
  straight rods are left. Plate and post meet in a fillet of an exact radius; for that their functions must measure
  lengths, which dividing by the gradient's length gives them. Parameters have ranges; each can be set with -D.

  Shows:    functions as arguments, recursion, a body with local names, arrays, JOIN, DIFF and GRAD, ranges, PRINT.
  Run:      yont examples/19_spring.geo -o spring.png
            yont measure examples/19_spring.geo --resolution 160
            the same with -D turns=6 -D wire=0.15
  Expected: prints `wire 60.55 long, climbs at 5.68 degrees`; one piece with a hole for a pin and
            four for screws; Euler characteristic -8 }

turns  = 4    IN [2, 12]    STEP 1;
radius = 2.4  IN [1.5, 3]   STEP 0.1;
pitch  = 1.5  IN [0.6, 2]   STEP 0.1;
wire   = 0.3  IN [0.1, 0.5] STEP 0.05;
fillet = 1.2  IN [0.1, 2];

{ The axis of the wire, once around while t grows by 1 }
helix(t) = [radius*COS(2*PI*t), radius*SIN(2*PI*t), pitch*t];

{ The length of a path from t = a to b, as that of n chords }
path_length((function) p, (real) a, (real) b, (real) n) = BEGIN
  path_length = 0;
  FOR k = 1 TO n DO BEGIN
    chord = p(a + (b-a)*k/n) - p(a + (b-a)*(k-1)/n);
    path_length = path_length + NORM(chord);
  END;
END;

{ How steep a path climbs, in degrees: from its exact derivative }
slope((function) p, (real) t) = DEG(ATAN2(v[3], HYPOT(v[1], v[2]))) WHERE v = DIFF(p(t), t);

round2(a) = ROUND(100*a)/100;
PRINT "wire", round2(path_length(helix, 0, turns, 40*turns)), "long, climbs at", round2(slope(helix, 0)), "degrees";

{ A rod from a to b with round ends }
pob_rod((array) a, (array) b, (real) r) = r - NORM(q - s*(b-a))
  WHERE q = [x1, x2, x3] - a, s = CLAMP(DOT(q, b-a)/DOT(b-a, b-a), 0, 1);

{ A wire along a path: the union of its two halves, down to 2**depth rods }
tr_wire((function) p, (real) a, (real) b, (real) r, (real) depth) =
  IF depth = 0 THEN pob_rod(p(a), p(b), r)
  ELSE MAX(tr_wire(p, a, (a+b)/2, r, depth-1), tr_wire(p, (a+b)/2, b, r, depth-1));

{ The same object by a function that is nearly the distance beside the boundary }
tr_normalize((gob/pob) g) = g/NORM(GRAD(g));

{ Union with a round fillet of radius r, exact where the faces are at right angles }
tr_fillet_uni((gob/pob) g, (gob/pob) h, (real) r) =
  IF ABS(g - h) <= r THEN (g + h + 2*r - SQRT(2*r**2 - (g - h)**2))/2 ELSE MAX(g, h);

{ Upright cylinder of infinite height }
pob_pillar((array) c, (real) r) = tr_normalize(r**2 - (x1-c[1])**2 - (x2-c[2])**2);

gob_post  = MIN(pob_pillar([0, 0], 1.1), 6.6 - x3);
gob_plate = MIN(pob_pillar([0, 0], 4), 0 - x3);
gob_seat  = MIN(tr_fillet_uni(gob_post, gob_plate, fillet), x3 + 0.6);

{ Where the screws go: two along x1, two along x2; and the pin }
along_x1  = [[3.3, 0], [-3.3, 0]];
screws    = JOIN(along_x1, [[0, 3.3], [0, -3.3]]);
gob_bores = MAXIMUM(i = 1 TO LEN(screws), pob_pillar(screws[i], 0.3));
gob_pin   = pob_pillar([0, 0], 0.35) AT (x1 = x3 - 5.9);

gob_coil   = tr_wire(helix, 0, turns, wire, 8);
gob_spring = MAX(MIN(gob_seat, -gob_bores, -gob_pin), gob_coil);

x1min = -4.2;  x1max = 4.2;
x2min = -4.2;  x2max = 4.2;
x3min = -0.8;  x3max = turns*pitch + 0.7;
