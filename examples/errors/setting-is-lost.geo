{ A branch ends, and with it what it sets. }
sharp = 1;
IF (sharp > 0) THEN r_alpha = 1 ELSE r_alpha = 0;
gob_a = x1 | x2;
