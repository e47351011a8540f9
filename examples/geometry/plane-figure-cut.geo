{ A disc that does not fit into its space. }
gob_a = 4 - x1**2 - x2**2;
x1min = -1; x1max = 3; x2min = -3; x2max = 3;
