{ A gob_ is a function of the coordinates. }
gob_a = [1, 2];
