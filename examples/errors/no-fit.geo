{ The larger the parameter, the better: there is no best. }
falling(q, p) = EXP(-q[1]*p[1]);
q = FIT(falling, [1], [[1], [2]]);
