{ A slider is for a number. }
a = [1, 2] IN [0, 3];
