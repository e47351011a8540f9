{ The bracket is no reason to keep quiet about c1. }
e1 = -8.;
gob_a = (4 - (x1 - c1)**2;
