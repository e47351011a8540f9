{ PRINT stands above the definition. }
PRINT r;
r = 2;
