{ Two toothed wheels that miss each other by a hair. ATAN2 jumps behind a wheel, so that plain intervals have to fill the gap. }
gob_wheel = (1 + 0.1*COS(5*ATAN2(x2, x1)) - SQRT(x1**2 + x2**2)) & 1 - x3**2;
a = INTERSECTS(gob_wheel, gob_wheel AT (x1 = 2.2 + 1e-9 - x1));
