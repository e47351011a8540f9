{ A bound of FOR is a number. }
s = 0;
FOR i = 1 TO x1 DO s = s + i;
