{ AT moves nothing that has no coordinates. }
a = 3;
b = a AT (x1 = 2);
