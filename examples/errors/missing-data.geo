{ There is no such file. }
gob_vox = INTERPOLATE("trilinear", "kettle.nrrd", x1, x2, x3);
