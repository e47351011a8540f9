{ The sum has no beginning. }
s = s + 1;
