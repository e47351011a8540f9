{ There is no type Q. }
x4 : Q;
