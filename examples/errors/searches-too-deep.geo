{ Five searches within each other. }
gob_a = PROJECT(PROJECT(PROJECT(PROJECT(PROJECT(x1*x2*x3*x4*x5*x6, x6, 0, 1), x5, 0, 1), x4, 0, 1), x3, 0, 1), x2, 0, 1);
