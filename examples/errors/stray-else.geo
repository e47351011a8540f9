{ Two statements before ELSE need BEGIN and END. }
a = 1;
IF (a > 0) THEN b = 1; c = 2; ELSE b = 3;
