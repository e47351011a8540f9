{ Known when the program is read. }
a = SQRT(-1);
