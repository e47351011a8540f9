{ A number is no parameter. }
f(1) = 3;
