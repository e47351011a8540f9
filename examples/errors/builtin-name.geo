{ SIN with a parameter is the sine, in any case. }
sin(a) = a;
