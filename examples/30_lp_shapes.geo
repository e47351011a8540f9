{ Lp shapes of the plane: Fig. 2, 3, 5, 7, 8 and 9 of Hanson (1990).

  A generalised p-norm joins shapes to one function: `and` adds powers as resistors in series add, `or` as those in
  parallel. As p grows the blend tightens to the largest and the smallest of the values, and the shape to its polygon;
  exponents below 1 give cusps. Each row is one shape, each column one exponent p.

  Shows:    PNORM and fn_lp_and, fn_lp_or, nested; single-faced half-spaces without poles; a sheet of rows and columns.
  Run:      yont examples/30_lp_shapes.geo -o lp.png
            yont measure examples/30_lp_shapes.geo --at x3=5,x4=6
  Expected: from above: four strips that meet in a convex polygon (Fig. 2b), a polygon without parallel sides from strips
            whose other sides are hidden (2c; nothing is left of it for p <= 1), the union of two strips (3), two circles
            (5) and a ring cut by a strip (7), an asymptotic triangle (8), an indented quadrilateral (9); prints
            `squares without overflow: 1`; nearly sharp the triangle is one of the
            inner radius 0.6, so the area = 1.8706 }

exponents = [0.75, 1, 2, 10, 1000];
p = exponents[x3];

{ The values of the strips and half-spaces are 1 on their boundaries }
strips   = [fn_strip([0.8, 0], 0), fn_strip([0, 0.9], 0), fn_strip([0.5, 0.55], 0.1), fn_strip([0.55, -0.6], 0)];
one_side = ARRAY(k = 1 TO 3, fn_strip([1.1*COS(2*PI*k/3 + 0.3), 1.1*SIN(2*PI*k/3 + 0.3)], -0.35));
crossed  = [fn_strip([1.6, 1.2], 0), fn_strip([1.2, -1.7], 0)];
circles  = [HYPOT(x1 - 0.45, x2)/0.8, HYPOT(x1 + 0.45, x2)/0.8];
ring     = [fn_ring(1, 0.35), fn_strip([0, 1.3], 0)];

{ (19): a half-space to the side `angle` of the origin }
face(angle, c) = fn_face19([COS(angle), SIN(angle)], c, [0, 0], 0.01);

triangle = [face(PI/2, 0.6), face(7*PI/6, 0.6), face(11*PI/6, 0.6)];
outer    = [face(0.5, 0.75), face(PI - 0.5, 0.75)];
notch    = [face(-1.9, 0.25), face(-PI + 1.9, 0.25)];

F = IF x4 < 1.5 THEN fn_lp_and(strips, p) ELSE
    IF x4 < 2.5 THEN fn_lp_and(one_side, p) ELSE
    IF x4 < 3.5 THEN fn_lp_and([fn_lp_or(crossed, p), HYPOT(x1, x2)/1.35], p) ELSE
    IF x4 < 4.5 THEN fn_lp_or(circles, p) ELSE
    IF x4 < 5.5 THEN fn_lp_and(ring, p) ELSE
    IF x4 < 6.5 THEN fn_lp_and(triangle, p) ELSE
                     fn_lp_and(JOIN(outer, [fn_lp_or(notch, p)]), p);

gob_lp = pob_lp(F, 1);

{ 1000th powers of numbers far from 1 }
square = fn_lp_and([x1, x2], 1000);
PRINT "squares without overflow:", square(1e10, 1e9) == 1e10 AND square(1e-10, 0) == 1e-10;

x1 : X;  x2 : Y;  x3 : V;  x4 : W;

x1min = -1.6;  x1max = 1.6;  x2min = -1.6;  x2max = 1.6;
x3min = 1;     x3max = 5;    x3_delta = 1;
x4min = 1;     x4max = 7;    x4_delta = 1;
