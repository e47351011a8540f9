{ Steps of a metamorphosis: Fig. 5d of Pasko, Adzhiev, Sourin and Savchenko (1995).

  Between two objects of space lies one object of four dimensions: f1*(1 - g(x4)) + f2*g(x4), for any continuous g with
  g(0) = 0 and g(1) = 1. Its sections are the steps. Nothing is matched with anything: tunnels open by themselves.

  Shows:    metamorphosis (15); a function as the argument of an operation; sections as columns of a sheet.
  Run:      yont examples/17_metamorphosis_steps.geo -o steps.png
            yont measure examples/17_metamorphosis_steps.geo --at x4=1
  Expected: a jack of three crossing bars and balls turns into a ring in five steps;
            the last of them with the volume of a torus, 2 pi^2 2 0.7^2, so volume = 19.342; Euler characteristic 0 }

{ Metamorphosis [P95] (15) }
tr_meta((gob/pob) f1, (gob/pob) f2, (real) g) = f1*(1 - g) + f2*g;

{ Slow at both ends }
gentle(t) = SIN(PI/2*t)**2;

{ A ball about (a, b, c), and a torus about the x3 axis }
pob_ball(a, b, c, r) = (r**2 - (x1-a)**2 - (x2-b)**2 - (x3-c)**2)/(2*r);
pob_torus(major, minor) = (minor**2 - (HYPOT(x1, x2) - major)**2 - x3**2)/(2*minor);

gob_bars = (0.5**2 - x1**2 - x2**2 & 4 - x3**2) | (0.5**2 - x2**2 - x3**2 & 4 - x1**2) | (0.5**2 - x3**2 - x1**2 & 4 - x2**2);
gob_jack = gob_bars | pob_ball(2,0,0,0.8) | pob_ball(-2,0,0,0.8) | pob_ball(0,2,0,0.8) | pob_ball(0,-2,0,0.8)
         | pob_ball(0,0,2,0.8) | pob_ball(0,0,-2,0.8);
gob_ring = pob_torus(2, 0.7);

gob_fig5d = tr_meta(gob_jack, gob_ring, gentle(x4));

x1 : X;  x2 : Y;  x3 : Z;  x4 : V;

x1min = -3;  x1max = 3;  x2min = -3;  x2max = 3;  x3min = -3;  x3max = 3;
x4min = 0;   x4max = 1;  x4_delta = 0.25;
