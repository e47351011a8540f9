{ A face of 15 convex polyhedra: in the manner of Fig. 5 and 6 of Akleman (1996).

  Each polyhedron is drawn as two convex polygons, one seen from the front and one from the side (two of them as three), and
  is the intersection of the prisms. All of them hold the origin, so each goes from the middle of the head outwards: to a
  brow, the tip of the nose, a lip. A global blending parameter joins them to flesh; the local one says how round each of
  them is. From left to right it falls: a robot becomes a human being.

  Shows:    STAR and fn_crossed; a control shape of polygons whose vertices can be moved; a solid inside a choice.
  Run:      yont examples/35_star_face.geo -o face.png
            the same with -D soft=4 for a rounder face
            yont measure examples/35_star_face.geo --at x4=2
  Expected: three heads from sharp to soft, each with the Euler characteristic 2; prints `15 polyhedra, 208 half-spaces` }

soft = 6;
joint = 16;

{ The skull, with a third polygon from above, [x1, x2] }
skull_front = [[-0.72, 0.4], [-0.66, -0.05], [-0.5, -0.45], [0.5, -0.45], [0.66, -0.05], [0.72, 0.4], [0.66, 0.8], [0.46, 1.1], [0.15, 1.25], [-0.15, 1.25], [-0.46, 1.1], [-0.66, 0.8]];
skull_side  = [[-0.73, 0.3], [-0.68, -0.3], [0.35, -0.55], [0.75, -0.25], [0.95, 0.25], [0.92, 0.7], [0.6, 1.1], [0.1, 1.27], [-0.4, 1.15], [-0.68, 0.8]];
skull_top   = [[-0.72, -0.05], [-0.58, -0.52], [-0.34, -0.74], [0.34, -0.74], [0.58, -0.52], [0.72, -0.05], [0.72, 0.4], [0.5, 0.85], [0.2, 0.97], [-0.2, 0.97], [-0.5, 0.85], [-0.72, 0.4]];

{ The jaw, likewise }
jaw_front = [[-0.62, 0.15], [-0.6, -0.3], [-0.44, -0.84], [-0.2, -1.08], [0.2, -1.08], [0.44, -0.84], [0.6, -0.3], [0.62, 0.15]];
jaw_side  = [[-0.77, -0.35], [-0.75, -0.9], [-0.62, -1.08], [-0.3, -1], [0.15, -0.65], [0.3, 0.1], [-0.72, 0.2]];
jaw_top   = [[-0.6, -0.2], [-0.44, -0.62], [-0.22, -0.8], [0.22, -0.8], [0.44, -0.62], [0.6, -0.2], [0.6, 0.3], [-0.6, 0.3]];

{ The chin }
chin_front = [[-0.19, -1], [-0.1, -1.13], [0.1, -1.13], [0.19, -1], [0.06, 0.1], [-0.06, 0.1]];
chin_side  = [[-0.8, -1], [-0.7, -1.12], [-0.4, -1.05], [0.08, 0.05], [-0.08, 0.1], [-0.77, -0.88]];

{ The nose: bridge, tip and nostrils }
nose_front = [[-0.115, -0.2], [0.115, -0.2], [0.055, 0.36], [-0.055, 0.36]];
nose_side  = [[-1.07, -0.1], [-1.05, -0.19], [-0.7, -0.22], [0.08, -0.08], [0.08, 0.1], [-0.7, 0.42], [-0.78, 0.33]];

{ A wing of the nose }
wing_front = [[-0.03, -0.03], [0.12, -0.22], [0.2, -0.19], [0.185, -0.12], [-0.03, 0.04]];
wing_side  = [[-0.93, -0.15], [-0.88, -0.22], [0.05, -0.03], [0.05, 0.04], [-0.88, -0.08]];

{ A brow }
brow_front = [[-0.05, 0.02], [-0.03, -0.04], [0.45, 0.34], [0.46, 0.4], [0.34, 0.475], [0.2, 0.465], [0.06, 0.4]];
brow_side  = [[-0.79, 0.37], [0.05, -0.04], [0.05, 0.05], [-0.7, 0.54], [-0.79, 0.45]];

{ An eye below its lid }
eye_front = [[-0.05, 0.02], [-0.03, -0.04], [0.32, 0.12], [0.41, 0.2], [0.35, 0.25], [0.28, 0.265], [0.21, 0.245]];
eye_side  = [[-0.765, 0.2], [-0.72, 0.12], [0.05, -0.04], [0.05, 0.05], [-0.72, 0.28]];

{ A cheekbone }
cheek_front = [[-0.05, -0.02], [0.2, -0.22], [0.32, -0.26], [0.46, -0.16], [0.5, -0.02], [0.4, 0.04], [-0.04, 0.05]];
cheek_side  = [[-0.77, -0.14], [-0.68, -0.28], [0.05, -0.05], [0.05, 0.05], [-0.66, 0.06], [-0.76, -0.04]];

{ The lips }
upper_lip_front = [[-0.25, -0.525], [-0.16, -0.55], [0.16, -0.55], [0.25, -0.525], [0.04, 0.05], [-0.04, 0.05]];
upper_lip_side  = [[-0.9, -0.52], [-0.84, -0.56], [0.05, -0.04], [0.05, 0.05], [-0.8, -0.43]];
lower_lip_front = [[-0.21, -0.555], [-0.12, -0.67], [0.12, -0.67], [0.21, -0.555], [0.03, 0.05], [-0.03, 0.05]];
lower_lip_side  = [[-0.885, -0.6], [-0.78, -0.69], [0.05, -0.04], [0.05, 0.05], [-0.83, -0.555]];

{ The neck }
neck_front = [[-0.38, -0.3], [-0.36, -1.6], [0.36, -1.6], [0.38, -0.3], [0.3, 0.2], [-0.3, 0.2]];
neck_side  = [[-0.3, -1.6], [0.5, -1.6], [0.6, -0.5], [0.5, 0.2], [-0.2, 0.2], [-0.25, -0.4]];

{ The same on the other side of the face }
other((array) polygon) = ARRAY(k = 1 TO LEN(polygon), [-polygon[k][1], polygon[k][2]]);

head = [JOIN(fn_crossed(skull_front, skull_side), fn_prism(skull_top, 1, 2)),
        JOIN(fn_crossed(jaw_front, jaw_side), fn_prism(jaw_top, 1, 2)),
        fn_crossed(chin_front, chin_side),
        fn_crossed(nose_front, nose_side),
        fn_crossed(wing_front, wing_side),
        fn_crossed(other(wing_front), wing_side),
        fn_crossed(brow_front, brow_side),
        fn_crossed(other(brow_front), brow_side),
        fn_crossed(eye_front, eye_side),
        fn_crossed(other(eye_front), eye_side),
        fn_crossed(cheek_front, cheek_side),
        fn_crossed(other(cheek_front), cheek_side),
        fn_crossed(upper_lip_front, upper_lip_side),
        fn_crossed(lower_lip_front, lower_lip_side),
        fn_crossed(neck_front, neck_side)];
PRINT LEN(head), "polyhedra,", SUM(k = 1 TO LEN(head), LEN(head[k])), "half-spaces";

gob_face = [STAR(head, 60, 40), STAR(head, 12, 20), STAR(head, soft, joint)][x4];

x1 : X;  x2 : Y;  x3 : Z;  x4 : V;

x1min = -1.2;  x1max = 1.2;  x2min = -1.25;  x2max = 1.25;  x3min = -1.75;  x3max = 1.45;
x4min = 1;     x4max = 3;    x4_delta = 1;
camera = [28, 8];
