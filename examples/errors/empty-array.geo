{ Nothing can be chosen from an array without elements. }
a = [];
b = a[1];
c = [][ROUND(x1)];
