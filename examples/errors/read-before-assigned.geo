{ q comes too late. }
f(p) = BEGIN f = q + p; q = 2; END;
a = f(1);
