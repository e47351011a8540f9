{ Three letters in one solid: Fig. 2 of Pasko, Adzhiev, Sourin and Savchenko (1995).

  Each letter is a union of blocks as deep as it is wide: C is read from the front, S from the right and G from
  above. Their intersection, in the last column, shows each of them from its side: the letters are its shadows.

  Shows:    a constructive solid; union and intersection; a coordinate that shows as the columns of a sheet.
  Run:      yont examples/12_letters.geo -o letters.png
            yont measure examples/12_letters.geo --at x4=4
  Expected: C, S, G and their intersection beside each other; the intersection has the volume = 41 }

r_alpha = 1;

{ The block between the corners p and q }
pob_block(p, q) = (x1-p[1] & q[1]-x1) & (x2-p[2] & q[2]-x2) & (x3-p[3] & q[3]-x3);

{ Read from the front, the side of small x2: across goes x1, up goes x3 }
gob_C = pob_block([0,0,0], [1,5,5]) | pob_block([0,0,0], [5,5,1]) | pob_block([0,0,4], [5,5,5]);

{ Read from the right, the side of large x1: across goes x2, up goes x3 }
gob_S = pob_block([0,0,0], [5,5,1]) | pob_block([0,0,2], [5,5,3]) | pob_block([0,0,4], [5,5,5])
      | pob_block([0,4,0], [5,5,3]) | pob_block([0,0,2], [5,1,5]);

{ Read from above: across goes x1, up goes x2 }
gob_G = pob_block([0,0,0], [1,5,5]) | pob_block([0,0,0], [5,1,5]) | pob_block([0,4,0], [5,5,5])
      | pob_block([4,0,0], [5,3,5]) | pob_block([2,2,0], [5,3,5]);

gob_CSG = (gob_C & gob_S) & gob_G;

gob_fig2 = IF x4 < 1.5 THEN gob_C ELSE IF x4 < 2.5 THEN gob_S ELSE IF x4 < 3.5 THEN gob_G ELSE gob_CSG;

x1 : X;  x2 : Y;  x3 : Z;  x4 : V;

x1min = -0.5;  x1max = 5.5;  x2min = -0.5;  x2max = 5.5;  x3min = -0.5;  x3max = 5.5;
x4min = 1;     x4max = 4;    x4_delta = 1;
