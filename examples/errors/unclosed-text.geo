{ The text has no second quote. }
PRINT "radius;
