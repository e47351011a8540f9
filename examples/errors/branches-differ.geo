{ Both branches must be of a kind. }
a = IF x1 > 0 THEN 1 ELSE [1, 2];
