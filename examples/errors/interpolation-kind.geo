{ Whether the file is there or not. }
gob_a = INTERPOLATE("trilinaer", "nowhere.nrrd", x1) - 1;
