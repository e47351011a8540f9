{ A ball without a radius. }
gob_a = -(x1-0.3)**2 - x2**2 - (x3+0.1)**2;
