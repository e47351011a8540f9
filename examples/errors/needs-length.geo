{ A product of vectors in space. }
a = CROSS([1, 2], [3, 4]);
