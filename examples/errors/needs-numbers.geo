{ A group is of numbers. }
gob_a = x5 - x1**2;
x5 : G = [x1, 2];
