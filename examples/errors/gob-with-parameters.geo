{ An object has no parameters. }
gob_ball(r) = r**2 - x1**2;
