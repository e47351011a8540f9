{ A product needs its `*`. }
a = 2 x1;
