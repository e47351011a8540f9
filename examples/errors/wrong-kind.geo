{ A number is expected, an array given. }
pob_ball((real) r) = r**2 - x1**2;
gob_a = pob_ball([1, 2]);
