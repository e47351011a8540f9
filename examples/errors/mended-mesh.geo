{ One side of the box was turned round. }
gob_box = MESH("../data/turned.obj");
