{ The sign is the wrong way round: nothing is inside. }
gob_a = -1 - x1**2 - x2**2 - x3**2;
