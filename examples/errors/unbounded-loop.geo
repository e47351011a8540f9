{ At x1 = 0 the loop would never end. }
z = 0;
WHILE (z < 4) DO z = z + x1**2;
gob_a = z;
