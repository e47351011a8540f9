{ There are sixteen coordinates. }
gob_a = x17;
