{ A coordinate is projected away, not a number. }
gob_a = PROJECT(1 - x1**2, 4, 0, 1);
