{ The greatest of none. }
a = MAXIMUM(i = 1 TO 0, i);
