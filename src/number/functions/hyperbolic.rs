//! Hyperbolic sine, cosine and tangent, without branches.

use super::double::power_of_two;
use super::exponential::{beyond_linear, exp_of, kept, reduced};

/// `e^x - 1` for 0 <= x <= 45.
#[inline(always)]
fn less_one(x: f64) -> f64 {
    let (r, lost, k) = reduced(x, 0.0);
    let power = power_of_two(k);
    (power - 1.0) + power * (r + (beyond_linear(r) + lost))
}

/// The smaller of x and `most`; NaN stays.
#[inline(always)]
fn at_most(x: f64, most: f64) -> f64 {
    if x > most { most } else { x }
}

/// Half of `e^x` for x >= 0, infinite only where the half is.
#[inline(always)]
fn half_exp(x: f64) -> f64 {
    exp_of(kept(x), 0.0, 1u64.wrapping_neg())
}

/// The hyperbolic sine, within 2 units in the last place.
#[inline(always)]
#[must_use]
pub fn sinh(x: f64) -> f64 {
    let size = x.abs();
    let t = less_one(at_most(size, 30.0));
    let near = 0.5 * (t + t / (t + 1.0));
    // Both are computed: a branch would break up a loop's vector code.
    let far = half_exp(size);
    let value = if size > 25.0 { far } else { near };
    value.copysign(x)
}

/// The hyperbolic cosine, within 2 units in the last place; cosh(0) = 1.
#[inline(always)]
#[must_use]
pub fn cosh(x: f64) -> f64 {
    let half = half_exp(x.abs());
    half + 0.25 / half
}

/// The hyperbolic tangent, within 3 units in the last place.
#[inline(always)]
#[must_use]
pub fn tanh(x: f64) -> f64 {
    let t = less_one(at_most(2.0 * x.abs(), 45.0));
    (t / (t + 2.0)).copysign(x)
}
