{ The bounds of a slider go upwards. }
r = 3 IN [5, 1];
