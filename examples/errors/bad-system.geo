{ r_alpha is greater than -1. }
r_alpha = -1;
gob_a = x1 | x2;
