{ Whether the loop ends is decided point by point: intervals over large boxes say nothing. }
gob_a = 1 - MOD(x1**2 + x2**2 + x3**2, 1e9) - SIN(x1*x2*x3)*SIN(1/(x1*x1 - x1*x1 + 1e-9))*0;
