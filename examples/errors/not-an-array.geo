{ A number has no elements. }
a = 3;
b = a[1];
