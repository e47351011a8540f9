{ Star shapes of the plane: Fig. 1 to 5 of Akleman (1996), Fig. 1 to 4 and 6 of Akleman (1992).

  A function F that grows in proportion along each ray from the origin, and is never negative, meets each ray once where
  F = 1. Such functions stay such under smooth unions and intersections, under morphing, and times any function of the
  direction alone.

  Shows:    STAR in the plane; tr_ricci_union, tr_morph_star; parameters INFINITY among others; a sheet.
  Run:      yont examples/34_star_shapes.geo -o stars.png
            yont measure examples/34_star_shapes.geo --at x3=5,x4=3
  Expected: from above: five star curves; two convex shapes, their union and two smooth approximations; the square by
            p = 1, 2, 4, 8, infinity; a control shape of three triangles by its global, and by its local parameter; a
            triangle that turns into a square; the last square is its control shape, so the area = 2.56 }

p = [1, 2, 4, 8, INFINITY];

{ Fig. 1 [A96], Fig. 4 [A92]: the distance times a function of the direction }
r   = HYPOT(x1, x2);
phi = ATAN2(x2, x1);
curves = [1 - r/(0.8 + 0.4*COS(5*phi)), 1 - r/(0.9 + 0.3*SIN(3*phi)), 1 - r/(0.3 + 0.9*ABS(COS(phi))), 1 - r*EXP(0.5*COS(4*phi)),
          1 - PNORM(x1, x2, 0.6)/1.3];

{ The half-planes of a regular polygon with its sides at the distance d from the origin }
sides(n, turn, d) = ARRAY(k = 1 TO n, [COS(2*PI*k/n + turn)/d, SIN(2*PI*k/n + turn)/d]);

{ Fig. 2: a triangle and a square }
gob_tri = STAR([sides(3, 0.4, 0.6)], INFINITY, INFINITY);
gob_box = STAR([sides(4, 0, 0.75)], INFINITY, INFINITY);
unions  = [gob_tri, gob_box, tr_ricci_union(gob_tri, gob_box, INFINITY), tr_ricci_union(gob_tri, gob_box, 8), tr_ricci_union(gob_tri, gob_box, 3)];

{ Fig. 3 }
squares = ARRAY(k = 1 TO 5, 1 - PNORM(x1, x2, p[k])/0.8);

{ Fig. 4 and 5: three triangles }
control = [sides(3, 0, 0.36), sides(3, 0.7, 0.42), sides(3, 1.4, 0.3)];
global  = ARRAY(k = 1 TO 5, STAR(control, 12, p[k]));
local   = ARRAY(k = 1 TO 5, STAR(control, p[k], 12));

{ Fig. 3 [A92] }
morphs = ARRAY(k = 1 TO 5, tr_morph_star(gob_box, gob_tri, (k - 1)/4));

gob_star = [curves, unions, squares, global, local, morphs][x4, x3];

x1 : X;  x2 : Y;  x3 : V;  x4 : W;

x1min = -1.3;  x1max = 1.3;  x2min = -1.3;  x2max = 1.3;
x3min = 1;     x3max = 5;    x3_delta = 1;
x4min = 1;     x4max = 6;    x4_delta = 1;
