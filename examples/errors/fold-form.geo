{ A fold over an index needs what it adds up. }
a = SUM(i = 1 TO 3);
