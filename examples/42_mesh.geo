{ A mesh from a file as an object like others.

  The bird is a closed mesh of triangles. MESH makes a function of it, the distance to the nearest triangle, and so it can be hollowed,
  bored through and set on a ring as any object.

  Shows:    MESH; a shell of a mesh; set operations and colours with it.
  Run:      yont examples/42_mesh.geo -o mesh.png
            yont measure examples/42_mesh.geo
  Expected: a bird with a hole through it, on a ring, volume = 0.84 }

gob_bird = MESH("data/bird.obj");
gob_hollow = tr_shell(gob_bird, 0.08);
gob_bored = gob_hollow \ pob_cylinder_y([-0.1, 0, 0.05], 0.22);
gob_all = gob_bored | pob_torus_z([0, 0, -0.35], 0.85, 0.12);
gob_all : COLOR = IF gob_bird < -0.002 THEN [0.85, 0.6, 0.3] ELSE [0.55, 0.7, 0.85];
camera = [-35, 22];
