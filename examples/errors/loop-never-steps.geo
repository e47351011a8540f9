{ Nothing changes i. }
i = 1; s = 0;
WHILE (i <= 8) DO s = s + i;
