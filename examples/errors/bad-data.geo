{ A file that is no volume. }
gob_a = INTERPOLATE("nearest", "bad-data.geo", x1);
