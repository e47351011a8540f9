{ TO stands behind the index of a fold. }
a = SIN(1 TO 3);
b = x1 AT (x1 = 1 TO 2);
c = SUM(i = 1 TO 3, i TO 4);
d = SUM(1 TO 3, 2);
