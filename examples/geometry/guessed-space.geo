{ Intervals say nothing of a function that leaps so. }
gob_a = 1 - x1**2 - x2**2 - x3**2 + 0.3*SIN(1/(0.01 + ABS(x1*x2 - x2*x1 + x3 - x3)));
