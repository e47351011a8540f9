{ WHERE in a list needs parentheses. }
a = [q WHERE q = 2, 3];
