//! Steps to neighbouring numbers, without branches. Never moves a zero or an infinity that is already outermost.

/// The unit of widening: the distance from 1 to the next number.
const UNIT: f64 = f64::EPSILON;

/// The smaller of two bounds, neither of them NaN.
#[inline(always)]
pub(super) fn least(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

/// The larger of two bounds, neither of them NaN.
#[inline(always)]
pub(super) fn most(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// The next number above; 0 and infinity stay.
#[inline(always)]
#[must_use]
pub fn next_up(x: f64) -> f64 {
    let bits = x.to_bits().cast_signed();
    let next = f64::from_bits(bits.wrapping_add(1 | (bits >> 63)).cast_unsigned());
    if (x == 0.0) | (x == f64::INFINITY) { x } else { next }
}

/// The next number below; 0 and -infinity stay.
#[inline(always)]
#[must_use]
pub fn next_down(x: f64) -> f64 {
    -next_up(-x)
}

/// At least `ulps` units in the last place above; a finite number if x is -infinity.
#[inline(always)]
pub(super) fn up(x: f64, ulps: f64) -> f64 {
    let x = most(x, f64::MIN);
    x + (x.abs() * (ulps * UNIT) + (ulps + 1.0) * f64::from_bits(1))
}

/// At least `ulps` units in the last place below; a finite number if x is infinity.
#[inline(always)]
pub(super) fn down(x: f64, ulps: f64) -> f64 {
    -up(-x, ulps)
}
