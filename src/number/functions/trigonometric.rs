//! Sine, cosine and tangent. Angles up to [`NEAR`] are reduced here by a three-part multiple of pi/2, without branches; beyond
//! it the `libm` crate does it.

use super::double::{nearest, quick_sum};

/// Up to this magnitude angles are reduced without branches: 2^20.
pub const NEAR: f64 = 1_048_576.0;

/// pi/2 in three parts of 33 bits, whose multiples by 20 bits are exact, and the rest.
const PART: [f64; 4] = [
    f64::from_bits(0x3ff9_21fb_5440_0000),
    f64::from_bits(0x3dd0_b461_1a60_0000),
    f64::from_bits(0x3ba3_198a_2e00_0000),
    f64::from_bits(0x397b_839a_2520_49c1),
];

/// `angle - n pi/2` as a sum of two numbers, and n.
#[inline(always)]
fn reduced(angle: f64) -> (f64, f64, u64) {
    let (n, quadrant) = nearest(angle * std::f64::consts::FRAC_2_PI);
    let first = angle - n * PART[0];
    // Where the second term is the larger one the first has so few digits left that the difference is exact.
    let (second, lost) = quick_sum(first, -n * PART[1]);
    let (high, low) = quick_sum(second, -n * PART[2]);
    (high, low + (lost - n * PART[3]), quadrant)
}

/// The sine of x + y, |x| <= pi/4.
#[inline(always)]
fn sine(x: f64, y: f64) -> f64 {
    let z = x * x;
    let w = z * z;
    let r = 8.333_333_333_322_49e-3
        + z * (-1.984_126_982_985_795e-4 + z * 2.755_731_370_707_006_8e-6)
        + z * w * (-2.505_076_025_340_686_3e-8 + z * 1.589_690_995_211_55e-10);
    let v = z * x;
    x - ((z * (0.5 * y - v * r) - y) - v * -1.666_666_666_666_663_2e-1)
}

/// The cosine of x + y, |x| <= pi/4.
#[inline(always)]
fn cosine(x: f64, y: f64) -> f64 {
    let z = x * x;
    let w = z * z;
    let r = z * (4.166_666_666_666_66e-2 + z * (-1.388_888_888_887_411e-3 + z * 2.480_158_728_947_673e-5))
        + w * w * (-2.755_731_435_139_066_3e-7 + z * (2.087_572_321_298_175e-9 + z * -1.135_964_755_778_819_5e-11));
    let half = 0.5 * z;
    let most = 1.0 - half;
    most + (((1.0 - most) - half) + (z * r - x * y))
}

/// The sign bit where bit 1 of `quadrant` is set.
#[inline(always)]
pub(super) fn turned(value: f64, quadrant: u64) -> f64 {
    f64::from_bits(value.to_bits() ^ ((quadrant & 2) << 62))
}

/// The sine of an angle up to [`NEAR`], within 1 unit in the last place.
#[inline(always)]
#[must_use]
pub fn sin_near(angle: f64) -> f64 {
    let (x, y, quadrant) = reduced(angle);
    let (s, c) = (sine(x, y), cosine(x, y));
    turned(if quadrant & 1 == 0 { s } else { c }, quadrant)
}

/// The cosine of an angle up to [`NEAR`], within 1 unit in the last place.
#[inline(always)]
#[must_use]
pub fn cos_near(angle: f64) -> f64 {
    let (x, y, quadrant) = reduced(angle);
    let (s, c) = (sine(x, y), cosine(x, y));
    // Cosine is negative in the quadrants 1 and 2: there adding 1 sets bit 1.
    turned(if quadrant & 1 == 0 { c } else { s }, quadrant.wrapping_add(1))
}

/// The tangent of an angle up to [`NEAR`], within 2 units in the last place.
#[inline(always)]
#[must_use]
pub fn tan_near(angle: f64) -> f64 {
    let (x, y, quadrant) = reduced(angle);
    let (s, c) = (sine(x, y), cosine(x, y));
    let odd = quadrant & 1 == 1;
    let (over, under) = if odd { (-c, s) } else { (s, c) };
    over / under
}

/// The sine of any angle in radians, within 1 unit in the last place.
#[inline(always)]
#[must_use]
pub fn sin(angle: f64) -> f64 {
    if angle.abs() > NEAR { libm::sin(angle) } else { sin_near(angle) }
}

/// The cosine of any angle in radians, within 1 unit in the last place.
#[inline(always)]
#[must_use]
pub fn cos(angle: f64) -> f64 {
    if angle.abs() > NEAR { libm::cos(angle) } else { cos_near(angle) }
}

/// The tangent of any angle in radians, within 2 units in the last place.
#[inline(always)]
#[must_use]
pub fn tan(angle: f64) -> f64 {
    if angle.abs() > NEAR { libm::tan(angle) } else { tan_near(angle) }
}
