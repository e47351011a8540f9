{ A ball: the set of points where the defining function is not negative.

  Shows:    one definition, the modelling space, a mesh.
  Run:      yont examples/01_ball.geo -o ball.stl
  Expected: volume 4/3 pi 2^3 = 33.5103, Euler characteristic 2 }

gob_ball = r**2 - x1**2 - x2**2 - x3**2;

r = 2;

x1min = -2.5;  x1max = 2.5;
x2min = -2.5;  x2max = 2.5;
x3min = -2.5;  x3max = 2.5;
