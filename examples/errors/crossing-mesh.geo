{ Two boxes in one file that go through each other. }
gob_boxes = MESH("../data/crossing.obj");
