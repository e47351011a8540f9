{ The body does not say what f is. }
f(p) = BEGIN q = p; END;
a = f(1);
