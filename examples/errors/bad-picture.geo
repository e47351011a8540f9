{ A file that is no picture. }
gob_relief = HEIGHT("bad-picture.geo", x1, x2) - x3;
