{ AT gives each coordinate one expression. }
gob_a = x1 AT (x1 = 2, x1 = 3);
