{ A coordinate is no name. }
x1 = 3;
