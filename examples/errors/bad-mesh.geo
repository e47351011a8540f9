{ A file that is no mesh. }
gob_a = MESH("bad-mesh.geo");
