{ Blends and morphs of star solids: Fig. 12 to 14 of Akleman (1992).

  The parts need not be half-spaces: a cylinder is the distance from its axis, which grows in proportion along each ray as
  well. Intersections and unions are blended by p; a morph is the geometric mean of two functions.

  Shows:    tr_ricci_union, tr_ricci_intersection, tr_morph_star; the library's solids beside STAR.
  Run:      yont examples/37_star_blends.geo -o blends.png
            yont measure examples/37_star_blends.geo --at x4=5,x5=3
  Expected: from above: a cylinder between two planes for p = 2, 4, 8, 16, infinity; the union of three such for the same p; a
            tetrahedron that turns into a ball of radius 0.8, volume = 2.1447; Euler characteristic 2 }

p = [2, 4, 8, 16, INFINITY];

{ Beams along each axis, without and with their ends }
beam(a, b)    = 1 - HYPOT(a, b)/0.4;
rod(a, b, c, p) = tr_ricci_intersection(beam(a, b), 1 - ABS(c)/0.95, p);

{ Fig. 12 and 13 }
cylinders = ARRAY(k = 1 TO 5, tr_ricci_intersection(1 - HYPOT(x1, x2)/0.8, 1 - ABS(x3)/0.8, p[k]));
jacks = ARRAY(k = 1 TO 5, tr_ricci_union(tr_ricci_union(rod(x1, x2, x3, 16), rod(x2, x3, x1, 16), p[k]), rod(x3, x1, x2, 16), p[k]));

{ Fig. 14 }
gob_tetrahedron = STAR([[[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]]], 24, 1);
gob_ball        = 1 - PNORM(x1, x2, x3, 2)/0.8;
morphs = ARRAY(k = 1 TO 5, tr_morph_star(gob_ball, gob_tetrahedron, (k - 1)/4));

gob_blend = [cylinders, jacks, morphs][x5, x4];

x1 : X;  x2 : Y;  x3 : Z;  x4 : V;  x5 : W;

x1min = -1.2;  x1max = 1.2;  x2min = -1.2;  x2max = 1.2;  x3min = -1.2;  x3max = 1.2;
x4min = 1;     x4max = 5;    x4_delta = 1;
x5min = 1;     x5max = 3;    x5_delta = 1;
