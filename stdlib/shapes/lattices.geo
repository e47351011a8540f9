// Lattices

{ The sheet of the thickness that follows the zeros of F, to first order: what lies within thickness/2 of them.
  Example: fn_sheet(SIN(x1), 0.5) AT (0)   // 0.25
  Source: [P98] }
fn_sheet((gob/pob) F, (real) thickness) = thickness/2 - ABS(F)/NORM(GRAD(F));

{ The function of the gyroid with that period: positive on one side of the surface.
  Example: fn_gyroid(4) AT (1, 0, 0)   // 1
  Source: Schoen 1970 }
fn_gyroid((real) period) = SIN(x)*COS(y) + SIN(y)*COS(z) + SIN(z)*COS(x)
  WHERE x = 2*PI*x1/period, y = 2*PI*x2/period, z = 2*PI*x3/period;

{ The function of the surface P of Schwarz with that period.
  Example: fn_schwarz_p(4) AT (0, 0, 0)   // 3
  Source: Schwarz 1890 }
fn_schwarz_p((real) period) = COS(2*PI*x1/period) + COS(2*PI*x2/period) + COS(2*PI*x3/period);

{ The function of the surface D of Schwarz with that period.
  Example: fn_schwarz_d(4) AT (1, 0, 0)   // 1
  Source: Schwarz 1890 }
fn_schwarz_d((real) period) = SIN(x)*SIN(y)*SIN(z) + SIN(x)*COS(y)*COS(z) + COS(x)*SIN(y)*COS(z) + COS(x)*COS(y)*SIN(z)
  WHERE x = 2*PI*x1/period, y = 2*PI*x2/period, z = 2*PI*x3/period;

{ The function of the lidinoid with that period.
  Example: fn_lidinoid(4) AT (0, 0, 0)   // -1.35
  Source: Lidin 1990 }
fn_lidinoid((real) period) =
  (SIN(2*x)*COS(y)*SIN(z) + SIN(2*y)*COS(z)*SIN(x) + SIN(2*z)*COS(x)*SIN(y))/2
  - (COS(2*x)*COS(2*y) + COS(2*y)*COS(2*z) + COS(2*z)*COS(2*x))/2 + 0.15
  WHERE x = 2*PI*x1/period, y = 2*PI*x2/period, z = 2*PI*x3/period;

{ The function of the surface of Neovius with that period.
  Example: fn_neovius(4) AT (0, 0, 0)   // 13
  Source: Neovius 1883 }
fn_neovius((real) period) = 3*(COS(x) + COS(y) + COS(z)) + 4*COS(x)*COS(y)*COS(z)
  WHERE x = 2*PI*x1/period, y = 2*PI*x2/period, z = 2*PI*x3/period;

{ The gyroid with that period as a sheet of that thickness.
  Example: pob_gyroid(3, 0.3) AT (0, 0, 0)   // 0.15
  Source: Schoen 1970 }
pob_gyroid((real) period, (real) thickness) = fn_sheet(fn_gyroid(period), thickness);

{ The surface P of Schwarz with that period as a sheet of that thickness.
  Example: pob_schwarz_p(3, 0.3) AT (0.75, 0.75, 0.75) > 0.1   // 1
  Source: Schwarz 1890 }
pob_schwarz_p((real) period, (real) thickness) = fn_sheet(fn_schwarz_p(period), thickness);

{ The surface D of Schwarz with that period as a sheet of that thickness.
  Example: pob_schwarz_d(3, 0.3) AT (0, 0, 0)   // 0.15
  Source: Schwarz 1890 }
pob_schwarz_d((real) period, (real) thickness) = fn_sheet(fn_schwarz_d(period), thickness);

{ The lidinoid with that period as a sheet of that thickness.
  Example: pob_lidinoid(3, 0.2) AT (1.2, 0.3, 0) < 0.1   // 1
  Source: Lidin 1990 }
pob_lidinoid((real) period, (real) thickness) = fn_sheet(fn_lidinoid(period), thickness);

{ The surface of Neovius with that period as a sheet of that thickness.
  Example: pob_neovius(3, 0.2) AT (0.75, 0.75, 0.75) > 0   // 1
  Source: Neovius 1883 }
pob_neovius((real) period, (real) thickness) = fn_sheet(fn_neovius(period), thickness);

{ The side of the gyroid on which its function is at least the level, from -1.5 (all) to 1.5 (nothing); 0 is half of space.
  Example: pob_gyroid_solid(4, 0.25) AT (1, 0, 0)   // 0.75
  Source: Schoen 1970 }
pob_gyroid_solid((real) period, (real) level) = fn_gyroid(period) - level;

{ The side of the surface P of Schwarz on which its function is at least the level, from -3 (all) to 3 (nothing).
  Example: pob_schwarz_p_solid(4, 0.5) AT (0, 0, 0)   // 2.5
  Source: Schwarz 1890 }
pob_schwarz_p_solid((real) period, (real) level) = fn_schwarz_p(period) - level;

{ The side of the surface D of Schwarz on which its function is at least the level, from -1.42 (all) to 1.42 (nothing).
  Example: pob_schwarz_d_solid(4, 0.25) AT (1, 0, 0)   // 0.75
  Source: Schwarz 1890 }
pob_schwarz_d_solid((real) period, (real) level) = fn_schwarz_d(period) - level;

{ The side of the lidinoid on which its function is at least the level.
  Example: pob_lidinoid_solid(4, 0) AT (0, 0, 0)   // -1.35
  Source: Lidin 1990 }
pob_lidinoid_solid((real) period, (real) level) = fn_lidinoid(period) - level;

{ The side of the surface of Neovius on which its function is at least the level, from -13 (all) to 13 (nothing).
  Example: pob_neovius_solid(4, 3) AT (0, 0, 0)   // 10
  Source: Neovius 1883 }
pob_neovius_solid((real) period, (real) level) = fn_neovius(period) - level;
