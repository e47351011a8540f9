{ A bead in a large space. }
gob_a = 0.1**2 - (x1-2.51)**2 - (x2-0.37)**2 - (x3-0.23)**2;
x1min = -10; x1max = 10; x2min = -10; x2max = 10; x3min = -10; x3max = 10;
