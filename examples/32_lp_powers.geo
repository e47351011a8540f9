{ Powers as insides and outsides: Fig. 4 of Hanson (1990).

  The set |x|^p <= 1 is the interval from -1 to 1 for every positive p, and what is outside it for every negative one. As p
  grows its graph turns into a square well, or a square pillar.

  Shows:    graphs; curves for several values of a coordinate in one frame; rows of a sheet.
  Run:      yont examples/32_lp_powers.geo -o powers.png
  Expected: above a well for the exponents 1, 2, 4 and 16, below a pillar for -1, -2, -4 and -16; all go through 1 at -1 and 1 }

gob_power = MIN(PNORM([x1], 1)**(x2*x3), 4);

x1 : X;  x2 : G = [1, 2, 4, 16];  x3 : W;

x1min = -2.2;  x1max = 2.2;
x3min = -1;    x3max = 1;  x3_delta = 2;
