{ Only some functions take settings. }
a = SIN(y = 2);
