{ An array is no object. }
gob_a = [1, 2] & x1;
