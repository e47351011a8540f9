{ Twisting: Fig. 5a of Pasko, Adzhiev, Sourin and Savchenko (1995).

  A bijective mapping is applied by asking for the object at the inversely mapped point: each level x3 is turned back by
  an angle that grows with x3. A twist moves nothing from level to level and keeps all areas within one, so that the
  twisted solid has the volume of the straight one, which is that of a few blocks.

  Shows:    bijective mapping (9) of a constructive solid; AT with WHERE; the same object under two mappings.
  Run:      yont examples/15_twist.geo -o twist.png
            yont measure examples/15_twist.geo
            the same with -D turn=0 for the straight one
  Expected: a tower with three storeys of windows on a foot and under a slab, twisted by 120 degrees; volume = 12.56;
            Euler characteristic -20 }

r_alpha = 1;

{ The block with the half edges a, b, c about the height h of the x3 axis }
pob_block(h, a, b, c) = (a + x1 & a - x1) & (b + x2 & b - x2) & (c + x3-h & c - x3+h);

{ A twist about the x3 axis: by the angle t1 at the level u1, by t2 at u2, in proportion between them }
tr_twist_z((gob/pob) g, (real) t1, (real) t2, (real) u1, (real) u2) =
  g AT (x1*COS(q) + x2*SIN(q), x2*COS(q) - x1*SIN(q))
  WHERE q = t1 + (t2 - t1)*(x3 - u1)/(u2 - u1);

{ Windows through the tower both ways, and a shaft down to its foot }
gob_windows = UNION(h = -1 TO 1, pob_block(1.6*h, 2, 0.5, 0.6) | pob_block(1.6*h, 0.5, 2, 0.6));
gob_shaft   = pob_block(0, 0.7, 0.7, 2.6);

gob_tower   = ((pob_block(0, 1, 1, 3) \ gob_windows) \ gob_shaft) | pob_block(-2.8, 1.4, 1.4, 0.2) | pob_block(2.8, 1.4, 1.4, 0.2);
gob_twisted = tr_twist_z(gob_tower, 0, RAD(turn), -3, 3);

turn = 120;

x1min = -2.2;  x1max = 2.2;
x2min = -2.2;  x2max = 2.2;
x3min = -3.2;  x3max = 3.2;
