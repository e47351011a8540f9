{ Several levels of a function of three variables at once, the inner ones seen through the outer ones.

  Shows:    isosurfaces; a field of the kind that blobby objects are made of.
  Run:      yont examples/11_isosurfaces.geo -o field.png
            the same with -o field.glb for a model in which one can go around
  Expected: at the lowest level one body of four lobes, at the highest four balls within it }

px = [1, -1, 0, 0];
py = [0.6, 0.6, -1, 0.2];
pz = [-0.6, -0.6, -0.6, 1];

gob_field = SUM(i = 1 TO 4, EXP(-2*((x1 - px[i])**2 + (x2 - py[i])**2 + (x3 - pz[i])**2)));

gob_field : G = [0.25, 0.5, 0.8];

x1min = -2.2;  x1max = 2.2;
x2min = -2.2;  x2max = 2;
x3min = -1.9;  x3max = 2.2;
