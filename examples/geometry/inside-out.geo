{ Negative inside, as other tools have it. }
gob_a = x1**2 + x2**2 + x3**2 - 1;
