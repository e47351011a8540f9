{ The ball lies beside the modelling space. }
gob_a = 1 - (x1-10)**2 - x2**2 - x3**2;
x1min = -2; x1max = 2; x2min = -2; x2max = 2; x3min = -2; x3max = 2;
