{ A polyhedron is an array of half-spaces, also if there is one only. }
gob_a = STAR([[1, 0, 0], [-1, 0, 0]], 8, 8);
