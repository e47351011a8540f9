{ The ball does not fit into the modelling space. }
gob_a = 4 - x1**2 - x2**2 - x3**2;
x1min = -1; x1max = 3; x2min = -3; x2max = 3; x3min = -3; x3max = 1;
