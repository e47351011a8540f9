{ A bar without ends. }
gob_a = 1 - x1**2 - x2**2 @ x3 + 2;
