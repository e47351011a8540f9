//! Shorter kernels for single precision. Those of angles and of base 10 are computed in doubles and rounded once, within 0.52 units in the
//! last place of a single; the others in singles throughout, within 1.

use super::double::nearest;
use super::exponential::{at_the_ends, split_normal};

/// pi/2 in two parts, the first of 33 bits.
const HALF_PI: (f64, f64) = (f64::from_bits(0x3ff9_21fb_5440_0000), 6.077_100_506_506_192e-11);

/// Sine and cosine of the angle less its quarters of a turn, and the quarters.
#[inline(always)]
fn parts(angle: f32) -> (f64, f64, u64) {
    let angle = f64::from(angle);
    let (n, quadrant) = nearest(angle * std::f64::consts::FRAC_2_PI);
    let x = (angle - n * HALF_PI.0) - n * HALF_PI.1;
    let z = x * x;
    let w = z * z;
    let s = x * z;
    let sine = (x + s * (-1.666_666_664_162_652_4e-1 + z * 8.333_329_385_889_463e-3))
        + s * w * (-1.983_933_483_609_663_2e-4 + z * 2.718_311_493_989_822e-6);
    let cosine = ((1.0 + z * -4.999_999_972_510_31e-1) + w * 4.166_662_332_373_906e-2)
        + (w * z) * (-1.388_676_377_460_993e-3 + z * 2.439_044_879_627_741e-5);
    (sine, cosine, quadrant)
}

#[inline(always)]
#[allow(clippy::cast_possible_truncation)]
fn rounded(value: f64) -> f32 {
    value as f32
}

/// The sine of an angle up to 2^20.
#[inline(always)]
pub fn sin(angle: f32) -> f32 {
    let (s, c, quadrant) = parts(angle);
    let value = if quadrant & 1 == 0 { s } else { c };
    // The kernel adds to -0 a 0, which would lose its sign.
    let value = if angle == 0.0 { f64::from(angle) } else { value };
    rounded(super::trigonometric::turned(value, quadrant))
}

/// The cosine of an angle up to 2^20.
#[inline(always)]
pub fn cos(angle: f32) -> f32 {
    let (s, c, quadrant) = parts(angle);
    rounded(super::trigonometric::turned(if quadrant & 1 == 0 { c } else { s }, quadrant.wrapping_add(1)))
}

/// The tangent of an angle up to 2^20.
#[inline(always)]
pub fn tan(angle: f32) -> f32 {
    let (s, c, quadrant) = parts(angle);
    let (over, under) = if quadrant & 1 == 1 { (-c, s) } else { (s, c) };
    let value = over / under;
    rounded(if angle == 0.0 { f64::from(angle) } else { value })
}

/// 1.5 * 2^23: adding it rounds to a whole number, which then stands in the lowest bits.
const WHOLE: f32 = 12_582_912.0;

/// ln 2 in two parts, the first of 10 bits, so that its multiples by exponents are exact.
const LN2: (f32, f32) = (0.693_359_4, -2.121_944_4e-4);

/// `2^k` for |k| <= 126.
#[inline(always)]
fn power_of_two_single(k: u32) -> f32 {
    f32::from_bits(k.wrapping_add(127) << 23)
}

/// e^x in singles throughout, within 1 unit in the last place; exp(0) = 1. The coefficients are those of the Cephes library.
#[inline(always)]
pub fn exp(x: f32) -> f32 {
    let x = if x > 90.0 { 90.0 } else { x };
    let x = if x < -110.0 { -110.0 } else { x };
    let shifted = x * std::f32::consts::LOG2_E + WHOLE;
    let (n, k) = (shifted - WHOLE, shifted.to_bits().wrapping_sub(WHOLE.to_bits()));
    let r = (x - n * LN2.0) - n * LN2.1;
    let p = 8.333_452e-3 + r * (1.398_199_9e-3 + r * 1.987_569_1e-4);
    let p = 0.5 + r * (1.666_666_5e-1 + r * (4.166_579_6e-2 + r * p));
    let y = 1.0 + (r + r * r * p);
    // In two steps, so that it is rounded once also among the subnormal numbers.
    let half = (k.wrapping_add(512) >> 1).wrapping_sub(256);
    y * power_of_two_single(half) * power_of_two_single(k.wrapping_sub(half))
}

/// The natural logarithm in singles throughout, within 0.9 units in the last place; log(1) = 0. Computed as FDLIBM does.
#[inline(always)]
pub fn log(x: f32) -> f32 {
    /// The bits of sqrt(1/2): mantissas are taken from there to sqrt 2.
    const LEAST: u32 = 0x3f35_04f3;
    let small = x < f32::MIN_POSITIVE;
    let shifted = (if small { x * 16_777_216.0 } else { x }).to_bits().wrapping_add(0x3f80_0000 - LEAST);
    let f = f32::from_bits((shifted & 0x007f_ffff).wrapping_add(LEAST)) - 1.0;
    // The exponent's bits below those of 2^23 make it a single without a conversion.
    let k = f32::from_bits((shifted >> 23) | 0x4b00_0000) - (8_388_608.0 + 127.0);
    let k = k - if small { 24.0 } else { 0.0 };
    let s = f / (2.0 + f);
    let z = s * s;
    let w = z * z;
    let rest = z * (0.666_666_6 + w * 0.284_987_87) + w * (0.400_009_72 + w * 0.242_790_79);
    let half = 0.5 * f * f;
    let value = s * (half + rest) + k * 9.058_001e-6 - half + f + k * 0.693_138_1;
    let value = if x > 0.0 { value } else { f32::NAN };
    let value = if x == 0.0 { f32::NEG_INFINITY } else { value };
    if x == f32::INFINITY { x } else { value }
}

/// The logarithm to base 10.
#[inline(always)]
pub fn log10(x: f32) -> f32 {
    rounded(log_double(x) * std::f64::consts::LOG10_E)
}

#[inline(always)]
fn log_double(x: f32) -> f64 {
    let x = f64::from(x);
    let (f, k) = split_normal(x);
    let s = f / (2.0 + f);
    let z = s * s;
    let p = 2.0 / 7.0 + z * (2.0 / 9.0 + z * (2.0 / 11.0));
    let p = 2.0 + z * (2.0 / 3.0 + z * (2.0 / 5.0 + z * p));
    at_the_ends(x, k * std::f64::consts::LN_2 + s * p)
}
