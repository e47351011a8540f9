// Classical surfaces

{ The four lobes of Steiner's Roman surface, within about 0.6 of the origin, where they meet; lines that dangle outside it are no solid.
  Example: pob_steiner AT (-0.2, -0.2, -0.2)   // 0.0031999999999999997
  Source: [A96] 2 }
pob_steiner = -(x1**2*x2**2 + x2**2*x3**2 + x3**2*x1**2 + x1*x2*x3);

{ A heart, about 2.3 wide, its tip down.
  Example: pob_heart AT (0, 0, 0)   // 1
  Source: Taubin 1994 }
pob_heart = x1**2*x3**3 + 9/80*x2**2*x3**3 - (x1**2 + 9/4*x2**2 + x3**2 - 1)**3;

{ The tanglecube: eight corners of a rounded cube, twelve edges between them and holes in all six sides, about 4.6 wide.
  Example: pob_tanglecube AT (1.5, 1.5, 1.5) > 0   // 1
  Source: Knapp 1998 }
pob_tanglecube = 5*(x1**2 + x2**2 + x3**2) - x1**4 - x2**4 - x3**4 - 11.8;

{ Barth's sextic with its 65 double points, in the ball of radius 2 w: the larger side of it. The other one, which the points hold
  together, is -pob_barth_sextic(w) & 3.9*w**2 - x1**2 - x2**2 - x3**2.
  Example: pob_barth_sextic(1) AT (0, 0, 0) > 0   // 1
  Source: Barth 1996 }
pob_barth_sextic((real) w) =
  ((1 + 2*p)*(q - w**2)**2*w**2 - 4*(p**2*x1**2 - x2**2)*(p**2*x2**2 - x3**2)*(p**2*x3**2 - x1**2) & 4*w**2 - q)
  WHERE p = (1 + SQRT(5))/2, q = x1**2 + x2**2 + x3**2;

{ What Klein's bottle, as a surface that meets itself, encloses: in -2.9 to 2.9, -2.5 to 3.1, -3.7 to 3.7.
  Example: pob_klein AT (0, 0, 0)   // 1
  Source: Lawson 1970 }
pob_klein = -((q + 2*x2 - 1)*((q - 2*x2 - 1)**2 - 8*x3**2) + 16*x1*x3*(q - 2*x2 - 1))
  WHERE q = x1**2 + x2**2 + x3**2;
