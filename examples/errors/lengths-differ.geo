{ By element needs equal lengths. }
a = [1, 2] + [1, 2, 3];
