{ Arrays within arrays, as deep as they go: here each turn is one deeper. }
a = 1;
FOR i = 1 TO 70000 DO a = [a];
