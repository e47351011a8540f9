{ There is no array yet. }
a[2] = 5;
