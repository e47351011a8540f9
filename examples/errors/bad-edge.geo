{ There is no third point. }
gob_bone = MEDIAL([[0, 0, 0], [4, 0, 0]], [1, 0.5], [[2, 3]]);
