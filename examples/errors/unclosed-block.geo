{ BEGIN without END. }
i = 1;
WHILE (i <= 8) DO BEGIN
  i = i + 1;
