{ Sharp: a drilled, rounded part whose creases and corners are in its mesh.

  A base plate with a boss and a rib, drilled and slotted; only its upright edges are rounded. All other edges are creases: straight
  ones and circles, convex and hollow ones, and corners in which three surfaces meet. Cubes would bevel each of them.

  Shows:    --sharp and `sharp = 1;`: a mesh with the creases that &, | and \ make.
  Run:      yont examples/40_sharp.geo -o sharp.stl
            the same with --sharp=off for the bevels
            yont measure examples/40_sharp.geo --resolution 64
  Expected: Euler characteristic -2: the hole through the boss and the slot }

r_alpha = 1;

{ The base: a plate with rounded corners }
gob_base = (corner - SQRT(MAX(ABS(x1) - (2 - corner), 0)**2 + MAX(ABS(x2) - (1.2 - corner), 0)**2)) & (x3 & 0.5 - x3);

{ The boss, and the rib that holds it }
gob_boss = (0.8**2 - (x1 - 0.8)**2 - x2**2) & (x3 & 1.4 - x3);
gob_rib  = (0.15 - ABS(x2)) & (x1 + 1.7) & (0.8 - x1) & (x3 & 1.55 + 0.6*(x1 - 1) - x3);

{ What is drilled and milled away }
gob_hole = hole**2 - (x1 - 0.8)**2 - x2**2;
gob_slot = (0.25 - ABS(x2 - 0.7)) & (0.5 - ABS(x1 + 1.1));

gob_part = ((gob_base | gob_boss | gob_rib) \ gob_hole) \ gob_slot;
gob_part : COLOR = [0.75, 0.78, 0.82];

corner = 0.4;
hole   = 0.45;

sharp = 1;

x1min = -2.15;  x1max = 2.2;
x2min = -1.35;  x2max = 1.4;
x3min = -0.15;  x3max = 1.55;
