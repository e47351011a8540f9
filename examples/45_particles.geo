{ Sticking particles: bodies that collide, and stay together where they touch.

  A noisy block tumbles among 35 small spheres, a torus and a noisy ellipsoid, which fly about in a box and turn as well. In each step bodies whose
  bounding spheres meet are asked whether they intersect, and INTERSECTS gives the exact answer: a sphere that touches the block is stuck to it by the blending
  union, where it touches; the torus and the ellipsoid bounce, and spheres bounce off them. A sphere that does not even meet the clump when it is larger is
  left alone for as many steps as it needs to come nearer. The 1,320 steps of [P95] 4.2, Fig. 9, are -D steps=1320, and take most of a minute.

  Shows:    a simulation as a loop of definitions, in which an object grows; INTERSECTS with all kinds of bodies.
  Run:      yont examples/45_particles.geo -o particles.png --object gob_clump_there,gob_torus,gob_egg,gob_free
  Expected: a clump of the block and ten spheres, the torus, the ellipsoid and the other spheres; it prints `10 spheres are stuck, 12 collisions with the clump` }

steps = 400 IN [0, 1320];
n = 35;  r = 0.32;  wall = 4;

{ The point p turned about an axis of length 1 }
turned((array) p, (array) axis, (real) a) = COS(a)*p + SIN(a)*CROSS(axis, p) + (1 - COS(a))*DOT(axis, p)*axis;
{ The object at a place, turned }
tr_placed((gob/pob) g, (array) p, (array) axis, (real) a) = g AT (turned([x1, x2, x3] - p, axis, -a));
{ Union with a blend that keeps lengths }
tr_stuck((gob/pob) g, (gob/pob) h) = MAX(g, h) + 0.12/(1 + (g/0.25)**2 + (h/0.25)**2);
{ A new velocity after a push along d }
pushed((array) v, (array) d) = v + (MAX(0, -2*DOT(v, u))*u WHERE u = d/NORM(d));
{ The velocity turned back where a place is at the walls }
bounced((array) p, (array) v, (real) room) = ARRAY(k = 1 TO 3, IF ABS(p[k]) > room THEN -SIGN(p[k])*ABS(v[k]) ELSE v[k]);

gob_block   = tr_noisy(pob_box_d([0, 0, 0], [2, 1.4, 1.2]), 0.36, 7, 1.4);
gob_ring    = pob_torus_d([0, 0, 0], 1, 0.3);
gob_potato  = tr_noisy(pob_ellipsoid([0, 0, 0], 1.1, 0.7, 0.6), 0.4, 6, 1.4);

axis1 = [2, 1, 2]/3;  axis2 = [1, 2, -2]/3;  axis3 = [2, -2, 1]/3;
x = ARRAY(i = 1 TO n, 3.6*[2*RANDOM(1, i) - 1, 2*RANDOM(2, i) - 1, IF RANDOM(3, i) > 0.5 THEN 0.6 + 0.4*RANDOM(4, i) ELSE -0.6 - 0.4*RANDOM(4, i)]);
v = ARRAY(i = 1 TO n, 0.06*[RANDOM(5, i) - 0.5, RANDOM(6, i) - 0.5, RANDOM(7, i) - 0.5]);
free = ARRAY(i = 1 TO n, 1);
{ Up to which step a sphere certainly meets nothing: it was far enough away }
safe = ARRAY(i = 1 TO n, 0);
gob_clump = gob_block;  reach = 1.6;
p2 = [2.6, 0.5, 1];      v2 = [-0.012, -0.004, -0.002];
p3 = [-2.7, -1, -1.5];  v3 = [0.013, 0.003, 0.006];
hits = 0;

FOR s = 1 TO steps DO BEGIN
  p2 = p2 + v2;  v2 = bounced(p2, v2, wall - 1.3);
  p3 = p3 + v3;  v3 = bounced(p3, v3, wall - 1.2);
  gob_ring_here   = tr_placed(tr_placed(gob_ring, p2, axis2, 0.013*s), [0, 0, 0], axis1, -0.004*s);
  gob_potato_here = tr_placed(tr_placed(gob_potato, p3, axis3, 0.011*s), [0, 0, 0], axis1, -0.004*s);
  IF (NORM(p2) < reach + 1.3) THEN IF (INTERSECTS(gob_clump, gob_ring_here)) THEN BEGIN v2 = pushed(v2, p2);  hits = hits + 1; END;
  IF (NORM(p3) < reach + 1.2) THEN IF (INTERSECTS(gob_clump, gob_potato_here)) THEN BEGIN v3 = pushed(v3, p3);  hits = hits + 1; END;
  IF (NORM(p2 - p3) < 2.5) THEN IF (INTERSECTS(gob_ring_here, gob_potato_here)) THEN BEGIN
    v2 = pushed(v2, p2 - p3);  v3 = pushed(v3, p3 - p2);
  END;
  FOR i = 1 TO n DO IF (free[i]) THEN BEGIN
    x[i] = x[i] + v[i];
    v[i] = bounced(x[i], v[i], wall - r);
    here = turned(x[i], axis1, -0.004*s);
    gob_ball = pob_sphere_d(here, r);
    IF (s >= safe[i] AND NORM(here) < reach + r + 0.4) THEN
      IF (NOT INTERSECTS(gob_clump, pob_sphere_d(here, r + 0.4))) THEN safe[i] = s + FLOOR(0.4/(NORM(v[i]) + 0.004*(reach + 1)))
      ELSE IF (INTERSECTS(gob_clump, gob_ball)) THEN BEGIN
        gob_clump = tr_stuck(gob_clump, gob_ball);
        reach = MAX(reach, NORM(here) + r);
        free[i] = 0;
        safe = ARRAY(k = 1 TO n, 0);
      END;
    IF (NORM(x[i] - p2) < 1.3 + r) THEN IF (INTERSECTS(gob_ring_here, gob_ball)) THEN v[i] = pushed(v[i], x[i] - p2);
    IF (NORM(x[i] - p3) < 1.2 + r) THEN IF (INTERSECTS(gob_potato_here, gob_ball)) THEN v[i] = pushed(v[i], x[i] - p3);
  END;
END;

PRINT n - SUM(free), "spheres are stuck,", hits, "collisions with the clump";

gob_clump_there = tr_placed(gob_clump, [0, 0, 0], axis1, 0.004*steps);
gob_torus = tr_placed(gob_ring, p2, axis2, 0.013*steps);
gob_egg   = tr_placed(gob_potato, p3, axis3, 0.011*steps);
gob_free  = UNION(i = 1 TO n, IF free[i] THEN pob_sphere_d(x[i], r) ELSE -1);

gob_clump_there : COLOR = [0.8, 0.55, 0.35];
gob_torus : COLOR = [0.35, 0.55, 0.75];
gob_egg   : COLOR = [0.6, 0.7, 0.4];
gob_free  : COLOR = [0.85, 0.8, 0.75];
x1min = -wall;  x1max = wall;  x2min = -wall;  x2max = wall;  x3min = -wall;  x3max = wall;
camera = [-55, 22];
