//! Inverse sine, cosine and tangent, and the angle of a point, without branches.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use super::super::float::Float;

/// What pi/2 lacks to the exact number.
const LACK: f64 = 6.123_233_995_736_766e-17;

/// `t - atan t` for |t| <= 0.4375.
#[inline(always)]
fn short_of(t: f64) -> f64 {
    let z = t * t;
    let w = z * z;
    let even = 4.976_877_994_615_932_4e-2 + w * 1.628_582_011_536_578_2e-2;
    let even = 9.090_887_133_436_507e-2 + w * (6.661_073_137_387_531e-2 + w * even);
    let even = z * (3.333_333_333_333_293e-1 + w * (1.428_571_427_250_346_6e-1 + w * even));
    let odd = -5.833_570_133_790_573_5e-2 + w * -3.653_157_274_421_691_6e-2;
    let odd = -1.111_111_040_546_235_6e-1 + w * (-7.691_876_205_044_83e-2 + w * odd);
    let odd = w * (-1.999_999_999_987_648_3e-1 + w * odd);
    t * (even + odd)
}

/// The angle of the point (x, y), x and y not negative, not both infinite; mirrored to the left if `left`.
#[inline(always)]
fn angle(y: f64, x: f64, left: bool) -> f64 {
    // Within pi/8 of an axis or of the diagonal the quotient is at most tan(pi/8).
    let low = y <= 0.414_213_562_373_095_03 * x;
    let middle = y <= 2.414_213_562_373_095 * x;
    let over = if low {
        y
    } else if middle {
        y - x
    } else {
        -x
    };
    let under = if low {
        x
    } else if middle {
        y + x
    } else {
        y
    };
    // At the origin the quotient is no number.
    let t = if (over == 0.0) & (under == 0.0) { 0.0 } else { over / under };
    // The number of eighths of a turn from the positive axis, towards the other axis.
    let base = if low {
        0.0
    } else if middle {
        FRAC_PI_4
    } else {
        FRAC_PI_2
    };
    let lack = if low {
        0.0
    } else if middle {
        0.5 * LACK
    } else {
        LACK
    };
    let base = if left { PI - base } else { base };
    let lack = if left { 2.0 * LACK - lack } else { lack };
    let t = if left { -t } else { t };
    base - ((short_of(t) - lack) - t)
}

/// The inverse tangent, within 2 units in the last place.
#[inline(always)]
#[must_use]
pub fn atan(x: f64) -> f64 {
    angle(x.abs(), 1.0, false).copysign(x)
}

/// The angle of the point (x, y), from -pi to pi, within 2 units in the last place; signed zeros as IEEE has them.
#[inline(always)]
#[must_use]
pub fn atan2(y: f64, x: f64) -> f64 {
    let (a, b) = (y.abs(), x.abs());
    let both = (a == f64::INFINITY) & (b == f64::INFINITY);
    let (a, b) = if both { (1.0, 1.0) } else { (a, b) };
    let (down, _) = (if a > b { a } else { b }).scale();
    angle(a * down, b * down, x.is_sign_negative()).copysign(y)
}

/// `asin(sqrt z)/sqrt z - 1` for 0 <= z <= 1/4.
#[inline(always)]
fn excess(z: f64) -> f64 {
    let p = -4.005_553_450_067_941e-2 + z * (7.915_349_942_898_145e-4 + z * 3.479_331_075_960_212e-5);
    let p =
        z * (1.666_666_666_666_666_6e-1 + z * (-3.255_658_186_224_009e-1 + z * (2.012_125_321_348_629_3e-1 + z * p)));
    let q = -6.882_839_716_054_533e-1 + z * 7.703_815_055_590_194e-2;
    p / (1.0 + z * (-2.403_394_911_734_414 + z * (2.020_945_760_233_505_7 + z * q)))
}

/// For 1/2 <= |x| <= 1: the square root of (1 - |x|)/2, its upper half of digits and the rest of them.
#[inline(always)]
fn half_angle(z: f64) -> (f64, f64, f64) {
    let s = z.sqrt();
    let high = f64::from_bits(s.to_bits() & 0xffff_ffff_0000_0000);
    let rest = if s == 0.0 { 0.0 } else { (z - high * high) / (s + high) };
    (s, high, rest)
}

/// The inverse sine, within 1 unit in the last place; undefined outside [-1, 1].
#[inline(always)]
#[must_use]
pub fn asin(x: f64) -> f64 {
    let size = x.abs();
    let small = size < 0.5;
    let z = if small { x * x } else { 0.5 * (1.0 - size) };
    let r = excess(z);
    let (s, high, rest) = half_angle(z);
    let near = size + size * r;
    let far = FRAC_PI_4 - ((2.0 * s * r - (LACK - 2.0 * rest)) - (FRAC_PI_4 - 2.0 * high));
    (if small { near } else { far }).copysign(x)
}

/// The inverse cosine, within 1 unit in the last place; undefined outside [-1, 1].
#[inline(always)]
#[must_use]
pub fn acos(x: f64) -> f64 {
    let size = x.abs();
    let small = size < 0.5;
    let z = if small { x * x } else { 0.5 * (1.0 - size) };
    let r = excess(z);
    let (s, high, rest) = half_angle(z);
    let middle = FRAC_PI_2 - (x - (LACK - x * r));
    let right = 2.0 * (high + (r * s + rest));
    let left = 2.0 * (FRAC_PI_2 - (s + (r * s - LACK)));
    let far = if x < 0.0 { left } else { right };
    if small { middle } else { far }
}
