{ A value beyond all numbers. }
a = EXP(1000);
