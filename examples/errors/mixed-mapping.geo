{ AT names all coordinates or none. }
gob_a = (x1 + x2) AT (3, x2 = 4);
