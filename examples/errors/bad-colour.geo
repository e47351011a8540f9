{ Red, green and blue, and a fourth number. }
gob_a = 1 - x1**2 - x2**2 - x3**2;
gob_a : COLOR = [1, 0.5, 0, 1];
