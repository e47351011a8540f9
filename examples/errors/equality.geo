{ One `=` defines, the others compare. }
b = 3;
a = b = 3;
