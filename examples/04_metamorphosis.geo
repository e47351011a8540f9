{ Metamorphosis: Fig. 6 of Pasko, Adzhiev, Sourin and Savchenko (1995), with its printing errors mended.

  Four objects of different origin turn into each other as time x4 goes from 0 to 4: a constructive solid, a swept solid,
  a teapot of voxels, a blobby object, and the first again.

  Shows:    a whole program: geometric model, geometric types, environment; x4 as time; a volume as an object.
  Run:      yont examples/04_metamorphosis.geo -o metamorphosis.gif
            the same with -o "frame-(n).stl" --resolution 128, n in braces, for the nine meshes
  Expected: nine frames, x4 = 0, 0.5 ... 4, each of them closed; the last is the first }

r_alpha = 1.;

{ Block with one corner at (a0,b0,c0) and the edges a, b, c }
pob_block_3D(a0,b0,c0,a,b,c) = (x1-a0 & a0+a-x1) & (x2-b0 & b0+b-x2) & (x3-c0 & c0+c-x3);

{ CSG object }
gob_bl1  = pob_block_3D(-9.,-8.,-9.,18.,16.,18.);
gob_cyl1 = ((r1**2-x1**2-x3**2) & 10.5-x2) & x2+10.5;
gob_cyl2 = r2**2-x1**2-x2**2;
gob_bl2  = (x2+d1 & d1-x2) & (x3+d1 & d1-x3);
gob_csg  = ((gob_bl1 | gob_cyl1) \ gob_cyl2) \ gob_bl2;

{ Swept object: Cartesian product of a moving disc and a segment }
gob_swept = (r3**2 - (x1-c1*SIN(-1+x2/c2))**2 - (x3-c1*COS(-1+x2/c2))**2) @ (x2+10. & 10.-x2);

{ Voxel object: the teapot of 03_teapot.geo, sampled }
gob_vox = INTERPOLATE("trilinear", "data/teapot.nrrd", x1, x2, x3);

{ Blobby object }
gob_bloby = b;
i = 1;
WHILE (i <= 8) DO BEGIN
  gob_bloby = gob_bloby + a[i]*EXP(-SQRT((x1-px[i])**2 + (x2-py[i])**2 + (x3-pz[i])**2));
  i = i + 1;
END;

{ Metamorphosis between all objects }
gob_metamorp = IF (0 <= x4 <= 1) THEN gob_csg*(1-x4)   + gob_swept*x4
          ELSE IF (1 <  x4 <= 2) THEN gob_swept*(2-x4) + gob_vox*(x4-1)
          ELSE IF (2 <  x4 <= 3) THEN gob_vox*(3-x4)   + gob_bloby*(x4-2)
          ELSE IF (3 <  x4 <= 4) THEN gob_bloby*(4-x4) + gob_csg*(x4-3);

x1 : X;  x2 : Y;  x3 : Z;  x4 : T;

x1min = -11.;  x1max = 11.;  x2min = -11.;  x2max = 11.;  x3min = -11.;  x3max = 11.;
x4min = 0.;    x4max = 4.;   x4_delta = 0.5;

r1 = 4.; r2 = 6.; d1 = 5.; r3 = 3.5; c1 = -8.; c2 = 2.5; b = -0.07;
a  = [1.5, 1., 1., 0.8, 0.5, 0.3, 0.4, 0.35];
px = [0., 6., -4., -5., 5., 6., 5., 8.];
py = [0., 6., -4., 3., -5., -7., -6., -9.];
pz = [0., 6., -4., 7., 5., 9., -3., -4.];
