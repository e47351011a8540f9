//! Shorter kernels for single precision, computed in doubles and rounded once: within 0.52 units in the last place of a single.

use super::double::{nearest, power_of_two};
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

/// e^x.
#[inline(always)]
pub fn exp(x: f32) -> f32 {
    let x = f64::from(x);
    let x = if x > 200.0 { 200.0 } else { x };
    let x = if x < -200.0 { -200.0 } else { x };
    let (n, k) = nearest(x * std::f64::consts::LOG2_E);
    let r = x - n * std::f64::consts::LN_2;
    let p = 1.0 / 720.0 + r * (1.0 / 5040.0 + r * (1.0 / 40320.0));
    let p = 1.0 / 6.0 + r * (1.0 / 24.0 + r * (1.0 / 120.0 + r * p));
    let value = 1.0 + r * (1.0 + r * (0.5 + r * p));
    rounded(value * power_of_two(k))
}

/// The natural logarithm.
#[inline(always)]
pub fn log(x: f32) -> f32 {
    rounded(log_double(x))
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
