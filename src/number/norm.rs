//! The p-norm of two numbers, in a form that neither overflows nor loses digits: points, slopes and ranges (`mathematics.md` 2 and 3).
//!
//! For p > 0 the larger magnitude is factored out, for p < 0 the smaller, so that every power is of a number from 0 to 1. Never
//! undefined for defined operands but for p = 0.

use super::float::Float;
use super::functions::{log, pow};
use super::interval::Interval;
use super::op::Binary;

/// `(|a|^p + |b|^p)^(1/p)`: \[H90\] eq. (1), for p < 0 its eq. (10). With infinite p the larger or the smaller magnitude; undefined if
/// an operand is, or for p = 0. Within `3 + 2/|p|` units in the last place.
#[inline(always)]
pub fn norm<T: Float>(a: T, b: T, p: T) -> T {
    T::of(norm_of_doubles(a.double(), b.double(), p.double()))
}

#[inline(always)]
fn norm_of_doubles(a: f64, b: f64, p: f64) -> f64 {
    let (x, y) = (a.abs(), b.abs());
    let first = x >= y;
    let (hi, lo) = (if first { x } else { y }, if first { y } else { x });
    let base = if p > 0.0 { hi } else { lo };
    let value = base * factor(lo / hi, p);
    // Where a base is 0 or infinite the quotient may be undefined, and the factor is 1 or does not matter.
    let value = if (base == 0.0) | (base == f64::INFINITY) { base } else { value };
    if a.is_nan() | b.is_nan() | p.is_nan() | (p == 0.0) { f64::NAN } else { value }
}

/// `(1 + r^|p|)^(1/p)` for a quotient r from 0 to 1.
#[inline(always)]
fn factor(r: f64, p: f64) -> f64 {
    pow(1.0 + pow(r, p.abs()), 1.0 / p)
}

/// The derivatives of the p-norm by its operands and by p, where its value is `value`: `(|a|/v)^(p-1)` with the sign of a, and so
/// for b; by p `v/p (A log(|a|/v) + B log(|b|/v))` with `A = (|a|/v)^p`. All are 0 where the value is 0.
#[inline(always)]
#[must_use]
pub fn norm_slopes(a: f64, b: f64, p: f64, value: f64) -> (f64, f64, f64) {
    let (x, y) = (a.abs(), b.abs());
    if value == 0.0 {
        return (0.0, 0.0, 0.0);
    }
    if p.is_infinite() | value.is_infinite() | value.is_nan() {
        let op = if p > 0.0 { Binary::Max } else { Binary::Min };
        let by = op.slopes(x, y, value);
        return (signed(by.0, a), signed(by.1, b), 0.0);
    }
    let (r, s) = (x / value, y / value);
    let part = |r: f64| {
        let power = pow(r, p);
        if (power == 0.0) | (r == 1.0) { 0.0 } else { power * log(r) }
    };
    (signed(pow(r, p - 1.0), a), signed(pow(s, p - 1.0), b), value / p * (part(r) + part(s)))
}

#[inline(always)]
fn signed(by: f64, a: f64) -> f64 {
    if a < 0.0 { -by } else { by }
}

/// The range of the p-norm over magnitudes `a`, `b` that are defined: it rises with both, and falls with p on either side of 0.
pub(super) fn range(a: Interval, b: Interval, p: Interval) -> Interval {
    let undefined = (p.lo <= 0.0) & (p.hi >= 0.0);
    let mut range = Interval { undefined, ..Interval::EMPTY };
    // Where a quotient of operands underflows, so does its power, however small p is: then the norm is its base.
    let tiny = 1e-307 * a.hi.max(b.hi);
    let underflows = a.lo.min(b.lo) <= tiny;
    if p.hi > 0.0 {
        let lo = if underflows { a.lo.max(b.lo) } else { below(a.lo, b.lo, p.hi) };
        // Towards p = 0 the norm of two numbers above 0 grows without bound.
        let unbounded = (p.lo <= 0.0) & (a.hi > 0.0) & (b.hi > 0.0);
        let hi = if unbounded { f64::INFINITY } else { above(a.hi, b.hi, p.lo.max(0.0)) };
        range = range.hull(Interval::new(lo, hi));
    }
    if p.lo < 0.0 {
        let lo = if (p.hi >= 0.0) | underflows { 0.0 } else { below(a.lo, b.lo, p.hi) };
        let hi = above(a.hi, b.hi, p.lo);
        let hi = if underflows { hi.max(a.hi.min(b.hi).min(tiny)) } else { hi };
        range = range.hull(Interval::new(lo, hi));
    }
    Interval { undefined: undefined | p.undefined, ..range }
}

/// Room for the error of a norm, in units in the last place.
#[inline(always)]
fn room(p: f64) -> f64 {
    8.0 + 8.0 / p.abs()
}

fn below(a: f64, b: f64, p: f64) -> f64 {
    let value = norm_of_doubles(a, b, p);
    if value == 0.0 {
        0.0
    } else {
        (value - value.min(f64::MAX) * (room(p) * f64::EPSILON).min(1.0)).min(f64::MAX).next_down().max(0.0)
    }
}

fn above(a: f64, b: f64, p: f64) -> f64 {
    let (lo, hi) = (a.min(b), a.max(b));
    // With p = 0 as a limit from above, one operand at least is 0.
    if (p == 0.0) | (p > 0.0) & ((lo == 0.0) | (hi == f64::INFINITY)) {
        return hi;
    }
    // A quotient that underflows for these operands may not do so for lesser ones.
    let value = if p > 0.0 { hi * factor((lo / hi).max(f64::MIN_POSITIVE), p) } else { norm_of_doubles(a, b, p) };
    if value == 0.0 { 0.0 } else { (value + value * (room(p) * f64::EPSILON)).next_up() }
}
