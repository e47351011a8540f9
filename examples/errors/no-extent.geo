{ The space ends before it begins. }
x1min = 5; x1max = -5;
gob_a = x1;
