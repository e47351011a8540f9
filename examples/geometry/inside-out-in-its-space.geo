{ Negative inside, as other tools have it, in a space that holds it. }
gob_a = x1**2 + x2**2 + x3**2 - 1;
x1min = -2; x1max = 2; x2min = -2; x2max = 2; x3min = -2; x3max = 2;
