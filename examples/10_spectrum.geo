{ A coordinate as colour: the sections of a turning and shrinking square, told apart by the colours of the spectrum.

  Shows:    the type C with its legend; AT as a rotation that depends on a coordinate.
  Run:      yont examples/10_spectrum.geo -o spectrum.png
            the same with -o spectrum.svg for the outlines as curves
  Expected: squares in each other, from violet without to red within, each turned a little further }

r_alpha = 1;

pob_square(a)   = (a - x1 & a + x1) & (a - x2 & a + x2);
tr_turn(g, phi) = g AT (x1*COS(phi) + x2*SIN(phi), x2*COS(phi) - x1*SIN(phi));

gob_spectrum = tr_turn(pob_square(1 - 0.7*x3), PI/4*x3);

x1 : X;  x2 : Y;  x3 : C;

x1min = -1.1;  x1max = 1.1;
x2min = -1.1;  x2max = 1.1;
x3min = 0;     x3max = 1;    x3_delta = 0.1;
