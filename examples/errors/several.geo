{ Several errors are told together, and none because of another. }
r = 3 +* 2;
gob_a = r - x1 - foo;
gob_b = gob_a | (x1 - 2;
a = [1, 2, 3];
b = a[4];
