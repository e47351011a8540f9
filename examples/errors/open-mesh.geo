{ One side of the box is missing. }
gob_box = MESH("../data/open.obj");
