{ `&` is for objects, AND for conditions. }
a = 1; b = 2;
c = a < 3 & b < 5;
