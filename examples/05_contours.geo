{ A plane figure: two coordinates make a picture instead of a solid.

  Shows:    an object of two coordinates, a fold over an index, a filled picture.
  Run:      yont examples/05_contours.geo -o flower.png --size 600x600
  Expected: a disc with twelve petals about it and a hole in its middle }

{ A disc about the point (a, b) }
pob_disc(a, b, r) = r**2 - (x1-a)**2 - (x2-b)**2;

gob_petals = UNION(k = 1 TO n, pob_disc(2*COS(2*PI*k/n), 2*SIN(2*PI*k/n), 0.6));
gob_flower = (gob_petals | pob_disc(0, 0, 1.8)) \ pob_disc(0, 0, 0.5);

n = 12;

x1min = -3;  x1max = 3;
x2min = -3;  x2max = 3;
