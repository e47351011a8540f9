{ The first statement has no `;`. }
r_alpha = 1.
pob_slab(a) = x1+a & a-x1;
