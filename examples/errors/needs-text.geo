{ The kind of interpolation is a text. }
gob_a = INTERPOLATE(1, "a.nrrd", x1);
