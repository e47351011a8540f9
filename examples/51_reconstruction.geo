{ Reconstruction from cross-sections: Fig. 11 of Pasko, Adzhiev, Sourin and Savchenko (1995).

  A molar from the contours of eight sections, as a scanner would see them. Each section becomes a function of the plane, the solid between
  two of them is their metamorphosis along the height. Nobody says which contour becomes which: three roots grow together, and
  four cusps branch off above, by themselves.

  Shows:    tr_reconstruct; CONTOURS of traced points; branching; a second object from the same sections.
  Run:      yont examples/51_reconstruction.geo -o molar.png --object gob_molar,gob_sections
            yont measure examples/51_reconstruction.geo --object gob_molar
  Expected: a tooth with three roots and four cusps, in one piece: Euler characteristic 2 }

r_alpha = 1;

{ A contour as points: an oval with the half axes a and b about (u, v), which waves n times by w }
angles = ARRAY(k = 1 TO 40, PI*k/20);
ring(u, v, a, b, n, w) = [u + a*q*COS(angles), v + b*q*SIN(angles)] WHERE q = 1 + w*COS(n*angles);

one(a, b, n, w) = CONTOURS([ring(0, 0, a, b, n, w)]);
three(d, r)     = CONTOURS([ring(-d, -0.6*d, r, r, 2, 0.1), ring(d, -0.6*d, r, r, 2, 0.1), ring(0, d, r, r, 2, 0.1)]);
four(d, r)      = CONTOURS([ring(d, d, r, r, 0, 0), ring(-d, d, r, r, 0, 0), ring(d, -d, r, r, 0, 0), ring(-d, -d, r, r, 0, 0)]);

z        = [0, 0.5, 1.1, 1.65, 2.3, 2.8, 3.1, 3.3];
sections = [three(0.72, 0.14), three(0.7, 0.27), three(0.6, 0.4), one(0.95, 0.9, 3, -0.07), one(1.12, 1.02, 4, -0.06),
            one(1.1, 1, 4, -0.07), four(0.46, 0.3), four(0.47, 0.12)];

gob_molar = tr_reconstruct(sections, z);

{ The contours, a little larger, as thin plates }
gob_sections = UNION(k = 1 TO LEN(z), sections[k] + 0.04 & 0.012 - ABS(x3 - z[k]));

gob_molar    : COLOR = [0.97, 0.94, 0.86];
gob_sections : COLOR = [0.86, 0.32, 0.28];

x1min = -1.3;  x1max = 1.3;  x2min = -1.3;  x2max = 1.3;  x3min = -0.05;  x3max = 3.35;
