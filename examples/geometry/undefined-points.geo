{ The root is negative in a part of the modelling space. }
gob_a = SQRT(x1) - x2**2 - x3**2 & 1 - x1;
x1min = -1; x1max = 2; x2min = -2; x2max = 2; x3min = -2; x3max = 2;
