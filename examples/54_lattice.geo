{ A candle holder as a patterned lattice: the holder of "Geometric Mentality" (Fig. 5) of Pasko, Savchenko and Sourin (1998).

  Rods that wind both ways around a bowl of revolution: bands of the angle and of the height, swept and crossed, cut out of a shell. Base,
  rims and socket are solids of revolution.

  Shows:    a pattern in cylindrical coordinates; solids of revolution; blending union.
  Run:      yont examples/54_lattice.geo -o holder.png
            yont measure examples/54_lattice.geo --resolution 128
  Expected: a bowl of crossing rods on a foot, in one piece; Euler characteristic -94 }

r_alpha = 1;

{ Distance from the axis, and the angle about it }
rho = HYPOT(x1, x2);
phi = ATAN2(x2, x1);

{ How wide the bowl is at a height }
width = 0.75 + 0.75*SIN(1.25*x3 - 0.15)**2;

{ Two families of rods that wind about the bowl: where a wave of angle and height is near its crest }
rods(turn)  = 0.13 - 0.5*ABS(SIN(4*phi + turn*x3));
gob_shell   = 0.07 - ABS(rho - width);
gob_lattice = (rods(2.4) | rods(-2.4)) & gob_shell & (x3 - 0.2 & 2.2 - x3);

pob_ring(h, r, a) = a - HYPOT(rho - r, x3 - h);
gob_rims   = pob_ring(0.2, 0.76, 0.1) | pob_ring(2.2, 0.95, 0.1);
gob_foot   = 0.95 - rho & (x3 & 0.14 - x3);
gob_socket = (0.32 - rho & (x3 & 0.45 - x3)) \ (0.24 - rho & x3 - 0.2);
gob_holder = gob_lattice | gob_rims | gob_foot | gob_socket;

gob_holder : COLOR = [0.8, 0.62, 0.28];
x1min = -1.7;  x1max = 1.7;  x2min = -1.7;  x2max = 1.7;  x3min = -0.1;  x3max = 2.4;
