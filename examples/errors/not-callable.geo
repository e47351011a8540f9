{ A product needs its `*`. }
a = 3;
b = a(x1 + 1);
