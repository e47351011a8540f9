{ Two balls apart have no point in common. }
gob_ball = 1 - x1**2 - x2**2 - x3**2;
p = WITNESS(gob_ball, gob_ball AT (x1 = x1 - 2.000001));
