{ A face of fifteen convex polyhedra: in the manner of Fig. 5 and 6 of Akleman (1996).

  Each polyhedron is drawn as two convex polygons, one seen from the front and one from the side, and is the intersection
  of two prisms. All of them hold the origin, so each goes from the middle of the head outwards: to the brow, the tip of the
  nose, a lip. A global blending parameter joins them to flesh; the local ones say how round each of them is. From left to
  right the local parameter falls: a robot becomes a human being.

  Shows:    STAR, fn_crossed; a control shape by polygons whose vertices can be moved; a solid without a search.
  Run:      yont examples/35_star_face.geo -o face.png
            the same with -D side_nose[2]=[-1.3,-0.2] for a longer nose
            yont measure examples/35_star_face.geo --at x4=2
  Expected: three heads from sharp to soft; the middle one has the Euler characteristic 2; prints `15 polyhedra of 185 half-spaces` }

{ Polygons: [x1, x3] from the front, [x2, x3] from the side; the face looks along -x2 }
front_skull = [[0.55, -0.3], [0.74, 0.1], [0.76, 0.55], [0.6, 0.98], [0.28, 1.2], [-0.28, 1.2], [-0.6, 0.98], [-0.76, 0.55], [-0.74, 0.1], [-0.55, -0.3]];
side_skull  = [[-0.7, -0.25], [-0.74, 0.5], [-0.62, 0.95], [-0.25, 1.2], [0.35, 1.18], [0.8, 0.85], [0.95, 0.35], [0.8, -0.2], [0.4, -0.5]];

front_jaw   = [[0.2, -1.08], [0.5, -0.75], [0.66, -0.2], [0.66, 0.2], [-0.66, 0.2], [-0.66, -0.2], [-0.5, -0.75], [-0.2, -1.08]];
side_jaw    = [[-0.72, 0.25], [-0.76, -0.4], [-0.7, -0.98], [-0.52, -1.08], [0.1, -0.72], [0.35, 0]];

front_chin  = [[0.13, -1.15], [0.22, -0.95], [0.16, 0.1], [-0.16, 0.1], [-0.22, -0.95], [-0.13, -1.15]];
side_chin   = [[-0.2, 0.15], [-0.84, -0.85], [-0.86, -1.02], [-0.74, -1.14], [-0.4, -1.05], [0.12, 0]];

front_nose  = [[0.06, 0.42], [0.1, -0.05], [0.15, -0.24], [-0.15, -0.24], [-0.1, -0.05], [-0.06, 0.42]];
side_nose   = [[-0.78, 0.42], [-1.13, -0.14], [-1.08, -0.24], [-0.7, -0.26], [0.1, -0.1], [0.1, 0.15]];

front_wing  = [[0.2, -0.12], [0.23, -0.22], [0.15, -0.26], [-0.05, -0.02], [-0.02, 0.05]];
side_wing   = [[-0.93, -0.1], [-0.97, -0.2], [-0.88, -0.26], [0.08, -0.02], [0.05, 0.06]];

front_brow  = [[0.1, 0.52], [0.4, 0.57], [0.62, 0.44], [0.58, 0.34], [0.12, 0.36], [-0.05, -0.04], [-0.06, 0.02]];
side_brow   = [[-0.8, 0.52], [-0.86, 0.46], [-0.84, 0.38], [0.06, -0.04], [0.06, 0.06]];

front_eye   = [[0.2, 0.24], [0.3, 0.29], [0.41, 0.25], [0.42, 0.17], [0.31, 0.12], [0.2, 0.16], [-0.03, -0.05], [-0.05, 0.02]];
side_eye    = [[-0.76, 0.29], [-0.81, 0.2], [-0.76, 0.12], [0.06, -0.05], [0.06, 0.05]];

front_cheek = [[0.3, 0.05], [0.58, 0.08], [0.66, -0.05], [0.5, -0.24], [0.3, -0.2], [-0.05, 0], [-0.04, 0.05]];
side_cheek  = [[-0.72, 0.08], [-0.8, -0.04], [-0.76, -0.22], [0.06, -0.06], [0.06, 0.06]];

front_upper = [[0, -0.47], [0.08, -0.45], [0.25, -0.55], [0.1, -0.58], [0, 0.06], [-0.1, -0.58], [-0.25, -0.55], [-0.08, -0.45]];
