{ Machining: Fig. 10 of Pasko, Adzhiev, Sourin and Savchenko (1995).

  A cutter moves straight down while the workpiece turns. Seen from the workpiece it is the cutter that goes round, along a helix; what
  it has swept until now is taken away, and the workpiece is turned back by the angle of the moment, so that it stands before the cutter as in
  the machine. A ball sweeps what is nearer to its path than its radius: for each turn of the path the nearest moment is found from the angle
  of the point, by a step of Newton's method with the exact derivative of the path.

  Shows:    set operations between moving solids; the swept volume of a moving tool; DIFF of a path by its parameter; a sheet of moments by
            the type V; several objects in one picture.
  Run:      yont examples/50_machining.geo -o machining.png --object gob_machined,gob_cutter
            yont measure examples/50_machining.geo --object gob_machined --at x4=-1
  Expected: a thread is cut into a cylinder, which is whole before, with volume = 9.425 and Euler characteristic 2 }

r_alpha = 1;

{ The middle of the cutter after t turns of the workpiece, seen from the workpiece }
path(t) = [1.18*COS(2*PI*t), 1.18*SIN(2*PI*t), 1.35 - 0.62*t];

{ The moment near t at which the cutter is nearest, of those from -0.6 until now }
nearest((real) t) = CLAMP(t + DOT([x1, x2, x3] - path(t), v)/DOT(v, v), -0.6, MAX(x4, -0.6)) WHERE v = DIFF(path(t), t);

pob_ball((array) c, (real) r) = r - NORM([x1, x2, x3] - c);

gob_swept     = MAXIMUM(k = -1 TO 5, pob_ball(path(nearest(ATAN2(x2, x1)/(2*PI) + k)), 0.3));
gob_workpiece = 1 - HYPOT(x1, x2) & (x3 + 1.5 & 1.5 - x3);

gob_machined = tr_rotate_z(gob_workpiece \ (gob_swept & x4 + 0.6), -2*PI*x4);
gob_cutter   = pob_ball([1.18, 0, 1.35 - 0.62*x4], 0.3) | (0.07 - HYPOT(x2, x3 - 1.35 + 0.62*x4) & x1 - 1.18);

gob_machined : COLOR = [0.62, 0.66, 0.72];
gob_cutter   : COLOR = [0.93, 0.62, 0.2];

x1 : X;  x2 : Y;  x3 : Z;  x4 : V;
x4min = 0;  x4max = 4;  x4_delta = 2;

x1min = -1.1;  x1max = 2;  x2min = -1.1;  x2max = 1.1;  x3min = -1.6;  x3max = 1.7;
