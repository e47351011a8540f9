{ Offsets: Fig. 4b of Pasko, Adzhiev, Sourin and Savchenko (1995).

  Adding a constant to the function moves the boundary: outwards if the constant is positive, inwards if it is
  negative. How far depends on how steep the function is, so walls grow by different amounts and edges become round.

  Shows:    iso-valued offsetting; an operation of one's own; parts from a fold over an index.
  Run:      yont examples/14_offsets.geo -o offsets.png
            yont measure examples/14_offsets.geo --at x4=0
  Expected: a flange with six holes: shrunk until they break through its rim, as it is, and expanded until they are
            nearly closed; as it is, volume = 87.22 and Euler characteristic -12 }

{ Iso-valued offsetting [P95] 2.2.3: c > 0 expands, c < 0 shrinks }
tr_offset((gob/pob) g, (real) c) = g + c;

{ An upright cylinder about (a, b) between two heights; its function has the slope 1 at the boundary }
pob_cylinder(a, b, r, lo, hi) = (r**2 - (x1-a)**2 - (x2-b)**2)/(2*r) & (x3-lo & hi-x3);

gob_holes  = UNION(k = 1 TO 6, pob_cylinder(3.4*COS(PI*k/3), 3.4*SIN(PI*k/3), 0.7, -9, 9)) | pob_cylinder(0, 0, 1.3, -9, 9);
gob_flange = (pob_cylinder(0, 0, 4.8, -0.6, 0.6) | pob_cylinder(0, 0, 2.2, -0.6, 2.4)) \ gob_holes;

gob_fig4b = tr_offset(gob_flange, x4);

x1 : X;  x2 : Y;  x3 : Z;  x4 : V;

x1min = -6;    x1max = 6;    x2min = -6;  x2max = 6;  x3min = -1.5;  x3max = 3.2;
x4min = -0.2;  x4max = 0.2;  x4_delta = 0.2;
