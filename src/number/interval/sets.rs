//! Set operations, truths and choices over intervals, with their own rules for undefined operands.

use super::super::op::{Binary, Ternary};
use super::Interval;
use super::rounding::{down, least, most, up};

const INF: f64 = f64::INFINITY;

/// Room for the error of an R-function at either end.
const ULPS: f64 = 10.0;

#[inline(always)]
fn below(value: f64) -> f64 {
    if value == 0.0 { value } else { down(value, ULPS) }
}
#[inline(always)]
fn above(value: f64) -> f64 {
    if value == 0.0 { value } else { up(value, ULPS) }
}

/// `both` where both operands are defined, else the other one.
#[inline(always)]
fn or_other(both: Interval, a: Interval, b: Interval) -> Interval {
    let mut lo = if a.is_empty() | b.is_empty() { INF } else { both.lo };
    let mut hi = if a.is_empty() | b.is_empty() { -INF } else { both.hi };
    lo = if b.undefined { least(lo, a.lo) } else { lo };
    hi = if b.undefined { most(hi, a.hi) } else { hi };
    lo = if a.undefined { least(lo, b.lo) } else { lo };
    hi = if a.undefined { most(hi, b.hi) } else { hi };
    Interval { lo, hi, undefined: both.undefined | (a.undefined & b.undefined) }
}

#[inline(always)]
fn negate(a: Interval) -> Interval {
    Interval { lo: -a.hi, hi: -a.lo, ..a }
}

/// `value`, undefined where a or b is.
#[inline(always)]
fn strict(value: Interval, a: Interval, b: Interval) -> Interval {
    super::strict(value, a, b)
}

#[inline(always)]
pub(super) fn max(a: Interval, b: Interval) -> Interval {
    or_other(Interval::new(most(a.lo, b.lo), most(a.hi, b.hi)), a, b)
}

#[inline(always)]
pub(super) fn union(a: Interval, b: Interval, alpha: Interval) -> Interval {
    or_other(union_of_defined(a, b, alpha), a, b).or_no_parameter(alpha)
}

#[inline(always)]
pub(super) fn intersection(a: Interval, b: Interval, alpha: Interval) -> Interval {
    let value = negate(union_of_defined(negate(a), negate(b), alpha));
    strict(value, a, b).or_no_parameter(alpha)
}

/// Rising in both operands, falling in alpha: dR/dalpha = -R^2 / 2 root.
#[inline(always)]
fn union_of_defined(a: Interval, b: Interval, alpha: Interval) -> Interval {
    let undefined = !((alpha.lo > -1.0) & (alpha.hi <= 1.0));
    let least_alpha = if alpha.lo > -1.0 { alpha.lo } else { -1.0f64.next_down() };
    let first = Ternary::Union.real(a.lo, b.lo, least(alpha.hi, 1.0));
    let last = Ternary::Union.real(a.hi, b.hi, least_alpha);
    let plain = alpha.lo == 1.0;
    let (lo, hi) = if plain { (first, last) } else { (below(first), above(last)) };
    // Towards alpha = -1 the union of positive numbers grows without bound.
    let hi = if (alpha.lo <= -1.0) & (most(a.hi, b.hi) > 0.0) { INF } else { hi };
    Interval { lo: if lo.is_nan() { -INF } else { lo }, hi: if hi.is_nan() { INF } else { hi }, undefined }
}

#[inline(always)]
pub(super) fn union_smooth(a: Interval, b: Interval, m: Interval) -> Interval {
    or_other(smooth_of_defined(a, b, m), a, b).or_no_parameter(m)
}

#[inline(always)]
pub(super) fn intersection_smooth(a: Interval, b: Interval, m: Interval) -> Interval {
    let value = negate(smooth_of_defined(negate(a), negate(b), m));
    strict(value, a, b).or_no_parameter(m)
}

/// Bounds of eq. (5): exact for one whole or larger `m`, else the product of the ranges of the two factors.
#[inline(always)]
fn smooth_of_defined(a: Interval, b: Interval, m: Interval) -> Interval {
    let undefined = m.lo < 0.0;
    if a.is_empty() | b.is_empty() {
        return Interval { undefined, ..Interval::EMPTY };
    }
    let value = if m.is_point() & (m.lo >= 1.0) & (m.lo <= 64.0) { extremes(a, b, m.lo) } else { product(a, b, m) };
    // The sign is that of the larger operand, also where the product underflows: such bounds are the least numbers.
    let (least_of_max, most_of_max) = (most(a.lo, b.lo), most(a.hi, b.hi));
    let tiny = f64::from_bits(1);
    let lo = if least_of_max > 0.0 { most(value.lo, tiny) } else { value.lo };
    let lo = if least_of_max < 0.0 { least(lo, -tiny) } else { lo };
    let hi = if most_of_max < 0.0 { least(value.hi, -tiny) } else { value.hi };
    let hi = if most_of_max > 0.0 { most(hi, tiny) } else { hi };
    Interval { lo, hi, undefined }
}

/// The union with alpha = 0 times the factor, each by its range.
fn product(a: Interval, b: Interval, m: Interval) -> Interval {
    let plain = union_of_defined(a, b, Interval::new(0.0, 0.0));
    let factor = Binary::Pow.interval(Binary::Hypot.interval(a, b), m.clip(0.0, INF));
    let value = Binary::Mul.interval(plain, factor);
    Interval::new(below(value.lo), above(value.hi))
}

/// Eq. (5) is not monotone: besides the corners it has an extremum on each edge whose fixed operand c is positive, where the
/// other operand is k c.
fn extremes(a: Interval, b: Interval, m: f64) -> Interval {
    let k = turning(m);
    let mut range = Interval { undefined: false, ..Interval::EMPTY };
    let mut take = |f: f64, g: f64| range = range.hull(Interval::point(Ternary::UnionSmooth.real(f, g, m)));
    for c in [a.lo, a.hi] {
        take(c, b.lo);
        take(c, b.hi);
        if (c > 0.0) & b.contains(k * c) {
            take(c, k * c);
        }
    }
    for c in [b.lo, b.hi] {
        if (c > 0.0) & a.contains(k * c) {
            take(k * c, c);
        }
    }
    let room = ULPS + 4.0 * m;
    let lo = if range.lo == 0.0 { 0.0 } else { down(range.lo, room) };
    let hi = if range.hi == 0.0 { 0.0 } else { up(range.hi, room) };
    Interval { lo, hi, undefined: false }
}

/// The real root of `2m(m+1) u^3 + u^2 + 2m u + 1`, m >= 1: between -1/(2m) and 0, from where Newton's steps go up to it.
fn turning(m: f64) -> f64 {
    let cube = 2.0 * m * (m + 1.0);
    (0..12).fold(-0.5 / m, |u, _| {
        let value = ((cube * u + 1.0) * u + 2.0 * m) * u + 1.0;
        u - value / ((3.0 * cube * u + 2.0) * u + 2.0 * m)
    })
}

impl Interval {
    /// Undefined where a parameter is; empty if it has no value.
    #[inline(always)]
    fn or_no_parameter(self, parameter: Interval) -> Self {
        super::strict(self, parameter, parameter)
    }

    /// Whether it may be true: not 0 and not undefined.
    #[inline(always)]
    fn may_hold(self) -> bool {
        !self.is_empty() & ((self.lo != 0.0) | (self.hi != 0.0))
    }

    /// Whether it may be false: 0 or undefined.
    #[inline(always)]
    fn may_fail(self) -> bool {
        self.undefined | ((self.lo <= 0.0) & (self.hi >= 0.0))
    }
}

/// The truth that may be true and may be false.
#[inline(always)]
fn truth(may_hold: bool, may_fail: bool) -> Interval {
    Interval::new(if may_fail { 0.0 } else { 1.0 }, if may_hold { 1.0 } else { 0.0 })
}

#[inline(always)]
pub(super) fn not(a: Interval) -> Interval {
    truth(a.may_fail(), a.may_hold())
}

#[inline(always)]
pub(super) fn and(a: Interval, b: Interval) -> Interval {
    truth(a.may_hold() & b.may_hold(), a.may_fail() | b.may_fail())
}

#[inline(always)]
pub(super) fn or(a: Interval, b: Interval) -> Interval {
    truth(a.may_hold() | b.may_hold(), a.may_fail() & b.may_fail())
}

#[inline(always)]
pub(super) fn compare(op: Binary, a: Interval, b: Interval) -> Interval {
    let none = a.is_empty() | b.is_empty();
    let undefined = a.undefined | b.undefined;
    let apart = (a.hi < b.lo) | (b.hi < a.lo);
    let same = (a.lo == a.hi) & (b.lo == b.hi) & (a.lo == b.lo);
    let (holds, fails) = match op {
        Binary::Less => (a.lo < b.hi, a.hi >= b.lo),
        Binary::LessEqual => (a.lo <= b.hi, a.hi > b.lo),
        Binary::Equal => (!apart, !same),
        _ => (!same, !apart),
    };
    truth(holds & !none, fails | undefined | none)
}

#[inline(always)]
pub(super) fn select(condition: Interval, then: Interval, otherwise: Interval) -> Interval {
    let (holds, fails) = (condition.may_hold(), condition.may_fail());
    match (holds, fails) {
        (true, false) => then,
        (false, true) => otherwise,
        _ => then.hull(otherwise),
    }
}
