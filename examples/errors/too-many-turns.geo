{ i grows and never gets negative. }
i = 0;
WHILE (i >= 0) DO i = i + 1;
