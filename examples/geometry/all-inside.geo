{ The ball is larger than the modelling space. }
gob_a = 100 - x1**2 - x2**2 - x3**2;
x1min = -2; x1max = 2; x2min = -2; x2max = 2; x3min = -2; x3max = 2;
