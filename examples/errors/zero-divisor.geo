{ A parameter that is still 0. }
scale = 0;
gob_a = 1 - (x1/scale)**2;
