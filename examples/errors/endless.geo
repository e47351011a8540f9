{ A step of 0 leads nowhere. }
s = 0;
FOR i = 1 TO 3 STEP 0 DO s = s + i;
