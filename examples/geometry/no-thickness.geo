{ A ball with a disc that has no thickness. }
r_alpha = 1;
gob_a = 1 - x1**2 - x2**2 - x3**2 | (-ABS(x3) & 4 - x1**2 - x2**2);
x1min = -2.5; x1max = 2.5; x2min = -2.5; x2max = 2.5; x3min = -2.5; x3max = 2.5;
