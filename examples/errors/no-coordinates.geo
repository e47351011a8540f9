{ The gradient of what depends on no coordinate. }
a = GRAD(3);
