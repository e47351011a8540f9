{ The primitive is called pob_block_3D. }
pob_block_3D(a0, b0, c0, a, b, c) = (x1-a0 & a0+a-x1) & (x2-b0 & b0+b-x2) & (x3-c0 & c0+c-x3);
gob_a = p_block_3D(0, 0, 0, 1, 1, 1);
