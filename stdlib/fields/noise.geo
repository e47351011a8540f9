// Noise

{ Gardner's solid noise: a product of waves along x1, x2 and x3, each shifted by the one before; bounded by 6.38 amplitude**3. Good values
  are 2.5, 0.7, 1.4.
  Example: pob_noise(2.5, 0.7, 1.4) AT (0, 0, 0)   // 0
  Source: [P95] 4.5, Gardner 1984 }
pob_noise((real) amplitude, (real) frequency, (real) phase) =
  fn_wave(x1, x3, amplitude, frequency, phase)*fn_wave(x2, x1, amplitude, frequency, phase)*fn_wave(x3, x2, amplitude, frequency, phase);

{ A factor of Gardner's noise: two waves along u, one of which is shifted by a wave along v.
  Example: fn_wave(PI/2, 0, 1, 1, 0) > 1   // 1
  Source: Gardner 1984 }
fn_wave((real) u, (real) v, (real) amplitude, (real) frequency, (real) phase) =
  amplitude*SIN(frequency*u) + amplitude/1.17*SIN(frequency*u/1.35 + phase*SIN(frequency*v));

{ A number from 0 to 288 that looks random, for whole numbers i, j, k; it repeats after 289 in each of them.
  Example: fn_hash(1, 2, 3) == fn_hash(290, 2, 3)   // 1 }
fn_hash((real) i, (real) j, (real) k) = fn_mix(fn_mix(fn_mix(i) + j) + k);

{ A rearrangement of the numbers from 0 to 288.
  Example: fn_mix(1)   // 52 }
fn_mix((real) i) = MOD((34*m + 18)*m, 289) WHERE m = MOD(i, 289);

{ Smooth random noise at the point p, from -1 to 1: gradients of length 1 at whole points, which a hash chooses, joined with two continuous
  derivatives. It is 0 at whole points, and repeats after 289.
  Example: fn_noise([1, 2, 3])   // 0
  Source: Perlin 2002 }
fn_noise((array) p) = CLAMP(
  fn_blend(fn_blend(fn_blend(fn_slope(i, f, 0, 0, 0), fn_slope(i, f, 1, 0, 0), f[1]),
                    fn_blend(fn_slope(i, f, 0, 1, 0), fn_slope(i, f, 1, 1, 0), f[1]), f[2]),
           fn_blend(fn_blend(fn_slope(i, f, 0, 0, 1), fn_slope(i, f, 1, 0, 1), f[1]),
                    fn_blend(fn_slope(i, f, 0, 1, 1), fn_slope(i, f, 1, 1, 1), f[1]), f[2]), f[3]), -1, 1)
  WHERE i = FLOOR(p), f = p - i;

{ From a to b while t goes from 0 to 1, with two continuous derivatives at the ends.
  Example: fn_blend(2, 4, 0.5)   // 3
  Source: Perlin 2002 }
fn_blend((real) a, (real) b, (real) t) = a + (b - a)*t**3*(10 + t*(6*t - 15));

{ The slope of noise that belongs to the corner (a, b, c) of the cell i, at the place f in it.
  Example: fn_slope([0, 0, 0], [0, 0, 0], 0, 0, 0)   // 0 }
fn_slope((array) i, (array) f, (real) a, (real) b, (real) c) =
  s*(COS(t)*(f[1] - a) + SIN(t)*(f[2] - b)) + z*(f[3] - c)
  WHERE h = fn_hash(i[1] + a, i[2] + b, i[3] + c), z = (2*h + 1)/289 - 1, s = SQRT(1 - z**2), t = h*2.399963229728653;

{ Turbulence at the point p: n octaves of noise, each half as strong and twice as fine as the one before, all taken without their sign.
  Example: fn_turbulence([0, 0, 0], 4)   // 0
  Source: Perlin 1985 }
fn_turbulence((array) p, (real) n) = SUM(k = 1 TO n, ABS(fn_noise(2**(k - 1)*p + 17*(k - 1)))/2**(k - 1));

{ n octaves of noise at the point p, each half as strong and twice as fine as the one before: hills instead of the creases of fn_turbulence.
  Example: fn_fractal_noise([0, 0, 0], 4)   // 0
  Source: Perlin 1985 }
fn_fractal_noise((array) p, (real) n) = SUM(k = 1 TO n, fn_noise(2**(k - 1)*p + 17*(k - 1))/2**(k - 1));
