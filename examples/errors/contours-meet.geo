{ Two squares that overlap are no outline with a hole. }
gob_two = CONTOURS([[[0, 2, 2, 0], [0, 0, 2, 2]], [[1, 3, 3, 1], [1, 1, 3, 3]]]);
