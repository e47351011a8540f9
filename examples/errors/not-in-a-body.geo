{ PRINT stands at the top only. }
FOR i = 1 TO 3 DO PRINT i;
