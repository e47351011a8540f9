{ One `)` more than `(`. }
gob_cyl1 = (4 - x1**2 - x3**2) & 10.5-x2) & x2+10.5;
