{ Known when the program is read. }
a = 1/0;
