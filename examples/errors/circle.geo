{ Each needs the other. }
a = b + 1;
b = c * 2;
c = a;
