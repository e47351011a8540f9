{ WHILE without DO. }
i = 1;
WHILE (i <= 8) BEGIN i = i + 1; END;
