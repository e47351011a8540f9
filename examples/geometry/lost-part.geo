{ A bead beside a ball, smaller than a cell. }
r_alpha = 1;
gob_a = 1 - x1**2 - x2**2 - x3**2 | 0.02**2 - (x1-2.51)**2 - (x2-0.37)**2 - (x3-0.23)**2;
