{ The reader between sees the last definition. }
r = 1;
gob_a = r - x1;
r = 2;
