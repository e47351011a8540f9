{ Three arguments for two parameters. }
pob_ball(r, c) = r**2 - (x1 - c)**2;
gob_a = pob_ball(1, 2, 3);
