{ There is no norm with this parameter. }
gob_a = 1 - PNORM(x1, x2, 0);
