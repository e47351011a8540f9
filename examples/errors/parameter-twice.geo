{ Which of the two? }
f(a, a) = 3;
