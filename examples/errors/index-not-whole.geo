{ Half an element. }
a = [1, 2, 3];
b = a[1.5];
