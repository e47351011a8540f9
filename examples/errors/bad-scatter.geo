{ Two of the points are one, with two values. }
hill = SCATTER([[0, 0], [1, 0], [0, 1], [1, 0]], [0, 1, 2, 3], 0, 10, 10, x1, x2);
