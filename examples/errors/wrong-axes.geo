{ The teapot has three axes. }
gob_a = INTERPOLATE("nearest", "../data/teapot.nrrd", x1, x2);
