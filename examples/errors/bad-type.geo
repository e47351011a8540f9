{ Only a coordinate can be the time. }
gob_a = x1;
gob_a : T;
