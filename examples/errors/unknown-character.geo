{ There is no `%`. }
a = 5 % 3;
