{ Blending: Fig. 4a of Pasko, Adzhiev, Sourin and Savchenko (1995).

  The block is not a primitive: it is the intersection of six half-spaces, so that each edge can have a blend of its own.
  Where a1 < 0 the blending intersection takes material from an edge, where a1 > 0 it adds some; a2 and a3 say how far the
  blend reaches on either face. Blends of different edges meet in the corners. The hole is drilled after all of them: a
  blended object is an object like any other.

  Shows:    blending intersection (8); parameters with their kinds; half-spaces as objects.
  Run:      yont examples/13_blended_block.geo -o blended.png
            the same with -D bead=0 for a front edge that is as sharp as any
  Expected: a block with rounded edges, a bead along the front edge at the right, and a hole; Euler characteristic 0 }

{ Blending intersection [P95] (8), with the sign of its root mended }
tr_bl_int((gob/pob) g1, (gob/pob) g2, (real) a1, (real) a2, (real) a3) =
  g1 + g2 - SQRT(g1**2 + g2**2) + a1/(1 + (g1/a2)**2 + (g2/a3)**2);

left  = x1 + 5;   right = 5 - x1;
front = x2 + 4;   back  = 4 - x2;
below = x3 + 3;   above = 3 - x3;

{ The four upright edges: a bead at the front right one, roundings at the others }
gob_front = tr_bl_int(tr_bl_int(front, right, bead, 0.35, 0.35), left, -0.5, 0.6, 0.6);
gob_sides = tr_bl_int(gob_front, back, -0.5, 0.6, 0.6);

{ The edges around the top and, less, around the bottom }
gob_block = tr_bl_int(tr_bl_int(gob_sides, above, -0.35, 0.7, 0.7), below, -0.1, 0.4, 0.4);

gob_hole    = r_hole**2 - (x1 - 1.5)**2 - (x2 - 0.5)**2;
gob_blended = gob_block \ gob_hole;

bead   = 3;
r_hole = 1.2;

x1min = -5.6;  x1max = 5.6;
x2min = -4.6;  x2max = 4.6;
x3min = -3.2;  x3max = 3.2;
