// Lp shapes

{ The half of L that is not negative, (L + |L|)/2: a half-space L <= 1 as a value that can be joined.
  Example: fn_H(-3)   // 0
  Source: [A96] (2) }
fn_H(L) = (L + ABS(L))/2;

{ The strip between two parallel planes, |n.x + d|, in as many coordinates as n has.
  Example: fn_strip([1, 2], 1) AT (-4, 1)   // 1
  Source: [H90] (11) }
fn_strip((array) n, d) = ABS(DOT(n, ARRAY(i = 1 TO LEN(n), [x1, x2, x3, x4, x5, x6, x7, x8][i])) + d);

{ The intersection of the values in the array H, blended by p > 0: (sum |H|^p)^(1/p). With p = INFINITY the sharp one; exponents
  below 1 give cusps.
  Example: fn_lp_and([3, 4], 2)   // 5
  Source: [H90] (6) }
fn_lp_and((array) H, p) = PNORM(H, p);

{ The union of the values in the array H, blended by p > 0: (sum |1/H|^p)^(-1/p).
  Example: fn_lp_or([6, 12], 1)   // 4
  Source: [H90] (10) }
fn_lp_or((array) H, p) = PNORM(H, -p);

{ The intersection of the values in the array H, each with an exponent of its own, sum |H[i]|^p[i], as the power 1/q of that sum, q
  the largest magnitude of an exponent; inside it is the same set. A negative exponent takes the outside of its value.
  Example: fn_lp_each([16, 3], [1, 2])   // 5
  Source: [H90] (2) }
fn_lp_each((array) H, (array) p) = PNORM(ARRAY(i = 1 TO LEN(H), ABS(H[i])**(p[i]/q)), q) WHERE q = MAXIMUM(i = 1 TO LEN(p), ABS(p[i]));

{ The solid where the value F is at most w.
  Example: pob_lp(fn_lp_and([x1, x2], 4), 2) AT (1, 0)   // 1
  Source: [H90] (2) }
pob_lp(F, w) = w - F;

{ The half-space n.x <= c by an exponential: values from 0 to 2, smooth.
  Example: fn_face17([1, 0, 0], 2) AT (2, 5, 5)   // 1
  Source: [H90] (17) }
fn_face17((array) n, c) = 2/(1 + EXP(1 - h)) WHERE h = DOT(n, ARRAY(i = 1 TO LEN(n), [x1, x2, x3, x4, x5, x6, x7, x8][i]))/c;

{ The half-space n.x <= c by magnitudes: h where h = n.x/c is positive, below 1/2 elsewhere.
  Example: fn_face18([1, 0, 0], 2) AT (-2, 5, 5)   // 0.3333333333333333
  Source: [H90] (18) }
fn_face18((array) n, c) = ABS(h)/(1 - h + ABS(h)) WHERE h = DOT(n, ARRAY(i = 1 TO LEN(n), [x1, x2, x3, x4, x5, x6, x7, x8][i]))/c;

{ The half-space n.(x - a) <= c by a ratio of squares, |n| = 1, the point a inside the shape: smooth, 1 at infinity. Its zero at a and
  its pole are tamed by eps^2 above and below, which leaves the plane where it is.
  Example: fn_face19([1, 0], 2, [0, 0], 0.01) AT (2, 7)   // 1
  Source: [H90] (19) }
fn_face19((array) n, c, (array) a, eps) = (SUM(i = 1 TO LEN(n), u[i]**2) + eps**2)/(SUM(i = 1 TO LEN(n), (u[i] - n[i])**2) + eps**2)
  WHERE u = ARRAY(i = 1 TO LEN(n), ([x1, x2, x3, x4, x5, x6, x7, x8][i] - a[i])/(2*c));

{ The ring |x1^2 + x2^2 - r^2| <= R: from the radius SQRT(r^2 - R) to SQRT(r^2 + R).
  Example: fn_ring(2, 1) AT (1, 0)   // 3
  Source: [H90] Fig. 7 }
fn_ring(r, R) = ABS(x1**2 + x2**2 - r**2)/R;
