{ One `(` more than `)`. }
gob_a = (4 - (x1 - 2)**2;
