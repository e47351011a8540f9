//! Sums, products, quotients, roots and powers of intervals. Knows no elementary function.

use super::super::float;
use super::Interval;
use super::rounding::{down, least, most, next_down, next_up, up};

const INF: f64 = f64::INFINITY;

/// a + b and what the rounding lost: exact for finite sums.
#[inline(always)]
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let of_b = sum - a;
    (sum, (a - (sum - of_b)) + (b - of_b))
}

/// Sums are widened only where they are not exact.
#[inline(always)]
pub(super) fn add(a: Interval, b: Interval) -> Interval {
    let (lo, below) = two_sum(a.lo, b.lo);
    let (hi, above) = two_sum(a.hi, b.hi);
    // What an infinite sum lost is no number and compares false; an overflowing one stays infinite.
    let lo = if (below < 0.0) | (lo == INF) { next_down(lo) } else { lo };
    let hi = if (above > 0.0) | (hi == -INF) { next_up(hi) } else { hi };
    let opposite = ((a.lo == -INF) & (b.hi == INF)) | ((a.hi == INF) & (b.lo == -INF));
    Interval { lo: if lo.is_nan() { -INF } else { lo }, hi: if hi.is_nan() { INF } else { hi }, undefined: opposite }
}

/// The product, 0 where it is no number: the neighbours of such a corner tell the bounds.
#[inline(always)]
fn times(a: f64, b: f64) -> f64 {
    let product = a * b;
    if product.is_nan() { 0.0 } else { product }
}

#[inline(always)]
pub(super) fn multiply(a: Interval, b: Interval) -> Interval {
    let (p, q, r, s) = (times(a.lo, b.lo), times(a.lo, b.hi), times(a.hi, b.lo), times(a.hi, b.hi));
    let lo = next_down(least(least(p, q), least(r, s)));
    let hi = next_up(most(most(p, q), most(r, s)));
    let undefined = (holds_zero(a) & holds_infinity(b)) | (holds_zero(b) & holds_infinity(a));
    Interval { lo, hi, undefined }
}

#[inline(always)]
fn holds_zero(a: Interval) -> bool {
    (a.lo <= 0.0) & (a.hi >= 0.0)
}

#[inline(always)]
fn holds_infinity(a: Interval) -> bool {
    (a.lo == -INF) | (a.hi == INF)
}

/// The least and largest quotient of the corners, as computed; 0 stands for what is no number.
#[inline(always)]
fn quotients(a: Interval, b: Interval) -> (f64, f64) {
    let by = |x: f64, y: f64| {
        let quotient = x / y;
        if quotient.is_nan() { 0.0 } else { quotient }
    };
    let (p, q, r, s) = (by(a.lo, b.lo), by(a.lo, b.hi), by(a.hi, b.lo), by(a.hi, b.hi));
    (least(least(p, q), least(r, s)), most(most(p, q), most(r, s)))
}

/// A divisor that holds zero, at an end too, gives any number: the sign of that zero is not known.
#[inline(always)]
pub(super) fn divide(a: Interval, b: Interval) -> Interval {
    let (lo, hi) = quotients(a, b);
    let through = holds_zero(b);
    let infinite = holds_infinity(a) & holds_infinity(b);
    // Infinity over infinity is no number, but its neighbours reach both 0 and infinity.
    let wild = through | infinite;
    Interval {
        lo: if wild { -INF } else { next_down(lo) },
        hi: if wild { INF } else { next_up(hi) },
        undefined: (through & holds_zero(a)) | infinite,
    }
}

#[inline(always)]
pub(super) fn root(a: Interval) -> Interval {
    let undefined = a.lo < 0.0;
    if a.hi < 0.0 {
        return Interval::EMPTY;
    }
    let lo = next_down(most(a.lo, 0.0).sqrt());
    Interval { lo: if lo == INF { f64::MAX } else { lo }, hi: next_up(a.hi.sqrt()), undefined }
}

/// Powers of magnitudes are monotone, computed ones too; the room is for the exact ones.
#[inline(always)]
pub(super) fn powi(a: Interval, n: i32) -> Interval {
    if n == 0 {
        return Interval::new(1.0, 1.0);
    }
    let ulps = f64::from(n.unsigned_abs());
    let below = |x: f64| if x == 0.0 { 0.0 } else { down(x, ulps) };
    let above = |x: f64| if x == 0.0 { 0.0 } else { up(x, ulps) };
    if n % 2 == 0 {
        let (near, far) = (float::powi(a.smallest(), n), float::powi(a.largest(), n));
        return Interval::new(most(below(least(near, far)), 0.0), above(most(near, far)));
    }
    let (p, q) = (float::powi(a.lo, n), float::powi(a.hi, n));
    if (n < 0) & holds_zero(a) {
        return Interval::WHOLE;
    }
    Interval::new(below(least(p, q)), above(most(p, q)))
}

#[inline(always)]
pub(super) fn hypot(a: Interval, b: Interval) -> Interval {
    let near = float::hypot(a.smallest(), b.smallest());
    let far = float::hypot(a.largest(), b.largest());
    Interval::new(most(if near == 0.0 { 0.0 } else { down(near, 4.0) }, 0.0), up(far, 4.0))
}

/// a - b floor(a / b): exact where the quotient keeps its whole part, else between 0 and b with room for rounding.
#[inline(always)]
pub(super) fn modulo(a: Interval, b: Interval) -> Interval {
    let undefined = holds_zero(b) | holds_infinity(b) | holds_infinity(a);
    let (least_quotient, largest_quotient) = quotients(a, b);
    let (first, last) = (least_quotient.floor(), largest_quotient.floor());
    // Near the end of the range the product overflows.
    if undefined | (first == -INF) | (last == INF) | (a.largest() > 1e300) {
        return Interval { undefined: true, ..Interval::WHOLE };
    }
    if first == last {
        let whole = Interval::new(first, first);
        let taken = multiply(b, whole);
        return add(a, Interval::new(-taken.hi, -taken.lo));
    }
    let room = (a.largest() + b.largest()) * (8.0 * f64::EPSILON) + f64::MIN_POSITIVE;
    Interval::new(least(b.lo, 0.0) - room, most(b.hi, 0.0) + room)
}
