{ Ray-constants: Fig. 15 of Akleman (1992).

  A function that is constant along each ray, such as the angle between the ray and a fixed direction, and any function of
  such, may multiply a star solid: waves, spikes and bumps over it, and still each ray meets the boundary once.

  Shows:    functions of the direction alone; EXP and SIN over a ball; p itself as such a function.
  Run:      yont examples/38_ray_constants.geo -o directions.png
            yont measure examples/38_ray_constants.geo --at x4=1 --resolution 96
  Expected: a ball with waves, a sea urchin, a shell with a spiral, and a solid that is a ball above and a cube below;
            the first has the Euler characteristic 2 }

r = PNORM(x1, x2, x3, 2);

{ The angle between the ray and the direction d }
angle(d) = ATAN2(NORM(CROSS([x1, x2, x3], d)), DOT([x1, x2, x3], d));

turn  = ATAN2(x2, x1);
polar = angle([0, 0, 1]);

waves  = 1 - r/(0.95 + 0.1*SIN(9*polar) + 0.06*SIN(9*angle([1, 1, 0])));
spikes = [[1,1,1], [1,1,-1], [1,-1,1], [1,-1,-1], [-1,1,1], [-1,1,-1], [-1,-1,1], [-1,-1,-1], [1,0,0], [-1,0,0], [0,1,0], [0,-1,0], [0,0,1], [0,0,-1]];
urchin = 1 - r/(0.6 + 0.6*SUM(k = 1 TO LEN(spikes), EXP(-25*angle(spikes[k])**2)));
shell  = 1 - r/(0.9 + 0.12*SIN(3*turn + 6*polar)*SIN(polar));
{ From 2 above to 12 below }
both   = 1 - PNORM(x1, x2, x3, 7 - 5*TANH(4*COS(polar)))/0.9;

gob_direction = [waves, urchin, shell, both][x4];

x1 : X;  x2 : Y;  x3 : Z;  x4 : V;

x1min = -1.25;  x1max = 1.25;  x2min = -1.25;  x2max = 1.25;  x3min = -1.25;  x3max = 1.25;
x4min = 1;      x4max = 4;     x4_delta = 1;
