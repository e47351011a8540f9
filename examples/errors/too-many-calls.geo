{ The recursion has no end. }
f(p) = p * f(p - 1);
a = f(3);
