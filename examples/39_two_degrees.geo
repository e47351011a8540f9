{ Surfaces of two degrees: Steiner's Roman surface, a superquadric, a monoid, y + x^3 (Akleman 1992, 5; 1996, 2).

  What consists of two homogeneous parts meets each ray from the origin once, like a ray-linear function: Steiner's surface of
  degrees 4 and 3, a monoid likewise, y + x^3 of degrees 1 and 3. A superquadric is a p-norm of a p-norm.

  Shows:    polynomials as solids; PNORM within PNORM; sections as columns of a sheet.
  Run:      yont examples/39_two_degrees.geo -o degrees.png
            yont measure examples/39_two_degrees.geo --at x4=2
  Expected: the Roman surface but for the lines on its axes, which have no thickness, a rounded box, a drop that hangs at the origin, and a curved
            wall; the superquadric has the Euler characteristic 2 }

steiner      = -(x1**2*x2**2 + x2**2*x3**2 + x3**2*x1**2) - 1.9*x1*x2*x3;
superquadric = 1 - PNORM(PNORM(x1, x2, 5)/0.8, x3/0.8, 3);
monoid       = 1.6*x3**3 - (x1**2 + x2**2 + x3**2)**2;
cubic        = -(x2 + 1.5*x1**3);

gob_two = [steiner, superquadric, monoid, cubic][x4];

x1 : X;  x2 : Y;  x3 : Z;  x4 : V;

x1min = -1;  x1max = 1;  x2min = -1;  x2max = 1;  x3min = -1;  x3max = 1.7;
x4min = 1;   x4max = 4;  x4_delta = 1;
