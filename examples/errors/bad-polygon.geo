{ The vertices are in a wrong order: the outline is a bow. }
gob_bow = POLYGON([0, 2, 2, 0], [0, 2, 0, 2]);
