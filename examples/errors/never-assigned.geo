{ The branch that is taken leaves q alone. }
p = -1;
IF (p > 0) THEN q = 1;
a = q + 1;
