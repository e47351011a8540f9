a = 3;
{ This comment has no end.
b = 4;
