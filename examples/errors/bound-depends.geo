{ What is projected away bounds nothing. }
gob_a = PROJECT(1 - x1**2 - x4**2, x4, 0, x4);
