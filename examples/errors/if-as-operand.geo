{ IF inside a sum needs parentheses. }
a = 1 + IF x1 > 0 THEN x1 ELSE 0;
