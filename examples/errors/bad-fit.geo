{ The second parameter is never used. }
above(q, p) = p[2] - q[1]*p[1];
q = FIT(above, [1, 0], [[1, 2], [2, 4.1], [3, 5.9]]);
