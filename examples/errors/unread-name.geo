{ Of the names near c1, the one that nothing reads is meant: e1. }
r1 = 4; d1 = 5; e1 = -8.;
gob_a = r1**2 - (x1 - c1)**2 - d1*x2**2;
