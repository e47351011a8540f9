{ RANDOM needs numbers, so the turns are taken one by one; at x1 = 0 they would never end. }
z = 0; i = 0;
WHILE (z < 4) DO BEGIN
  z = z + x1**2*RANDOM(1, i);
  i = i + 1;
END;
gob_a = z;
