//! Elementary functions of intervals: the bounds of the exact range, widened by twice the stated error of the function,
//! since neighbours of the end may be computed wrong in the other direction. Never leaves the range of the exact function.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::super::functions;
use super::super::op::{Binary, Unary};
use super::Interval;
use super::rounding::{down, least, most, up};

const INF: f64 = f64::INFINITY;

#[inline(always)]
pub(super) fn unary(op: Unary, a: Interval) -> Interval {
    match op {
        Unary::Exp => rising(op, a).clip(0.0, INF),
        Unary::Cosh => even(op, a).clip(1.0, INF),
        Unary::Tanh => rising(op, a).clip(-1.0, 1.0),
        Unary::Atan => rising(op, a).clip(-FRAC_PI_2, FRAC_PI_2),
        Unary::Asin => within(op, a, -1.0, 1.0).clip(-FRAC_PI_2, FRAC_PI_2),
        Unary::Acos => falling(op, a).clip(0.0, PI),
        Unary::Atanh => within(op, a, -1.0, 1.0),
        Unary::Acosh => within(op, a, 1.0, INF).clip(0.0, INF),
        Unary::Log | Unary::Log10 => within(op, a, 0.0, INF),
        Unary::Sin => wave(op, a, FRAC_PI_2),
        Unary::Cos => wave(op, a, 0.0),
        Unary::Tan => tangent(a),
        _ => rising(op, a),
    }
}

/// A bound `value` of the function `op`, lowered (raised) by its error.
#[inline(always)]
fn below(op: Unary, value: f64) -> f64 {
    let exact = (value == 0.0) | (value == -INF);
    if exact { value } else { down(value, 2.0 * functions::error(op) + 1.0) }
}
#[inline(always)]
fn above(op: Unary, value: f64) -> f64 {
    let exact = (value == 0.0) | (value == INF);
    if exact { value } else { up(value, 2.0 * functions::error(op) + 1.0) }
}

#[inline(always)]
fn rising(op: Unary, a: Interval) -> Interval {
    Interval::new(below(op, op.real(a.lo)), above(op, op.real(a.hi)))
}

/// A rising function that is defined from `lo` to `hi` only.
#[inline(always)]
fn within(op: Unary, a: Interval, lo: f64, hi: f64) -> Interval {
    let part = a.clip(lo, hi);
    if part.is_empty() {
        return Interval::EMPTY;
    }
    rising(op, part).or_undefined((a.lo < lo) | (a.hi > hi))
}

/// The inverse cosine.
#[inline(always)]
fn falling(op: Unary, a: Interval) -> Interval {
    let part = a.clip(-1.0, 1.0);
    if part.is_empty() {
        return Interval::EMPTY;
    }
    let range = Interval::new(below(op, op.real(part.hi)), above(op, op.real(part.lo)));
    range.or_undefined((a.lo < -1.0) | (a.hi > 1.0))
}

/// A function of the magnitude, rising in it.
#[inline(always)]
fn even(op: Unary, a: Interval) -> Interval {
    Interval::new(below(op, op.real(a.smallest())), above(op, op.real(a.largest())))
}

/// Whether some `first + k period` lies in `a`, in doubt yes: the slack is wider than the rounding of all that is computed here.
#[inline(always)]
fn meets(a: Interval, first: f64, period: f64) -> bool {
    let slack = 4e-15 * (a.largest() + 10.0);
    let k = ((a.lo - slack - first) / period).ceil();
    first + k * period <= a.hi + slack
}

/// Sine and cosine: `crest` is where one of the maxima lies.
#[inline(always)]
fn wave(op: Unary, a: Interval, crest: f64) -> Interval {
    let (p, q) = (functions::near(op, a.lo), functions::near(op, a.hi));
    let wide = (a.hi - a.lo >= TAU) | (a.largest() >= functions::NEAR);
    let lo = below(op, least(p, q));
    let hi = above(op, most(p, q));
    let lo = if wide | (lo < -1.0) | meets(a, crest - PI, TAU) { -1.0 } else { lo };
    let hi = if wide | (hi > 1.0) | meets(a, crest, TAU) { 1.0 } else { hi };
    Interval { lo, hi, undefined: (a.lo == -INF) | (a.hi == INF) }
}

#[inline(always)]
fn tangent(a: Interval) -> Interval {
    let (p, q) = (functions::tan_near(a.lo), functions::tan_near(a.hi));
    let wild = (a.hi - a.lo >= PI) | (a.largest() >= functions::NEAR) | meets(a, FRAC_PI_2, PI);
    let (lo, hi) = (below(Unary::Tan, p), above(Unary::Tan, q));
    Interval {
        lo: if wild { -INF } else { lo },
        hi: if wild { INF } else { hi },
        undefined: (a.lo == -INF) | (a.hi == INF),
    }
}

/// Where the plane is cut (x < 0, y = 0) and at the origin the angle may be any.
#[inline(always)]
pub(super) fn atan2(y: Interval, x: Interval) -> Interval {
    if (y.lo <= 0.0) & (y.hi >= 0.0) & (x.lo <= 0.0) {
        return Interval::new(-PI, PI);
    }
    let angle = |y: f64, x: f64| functions::atan2(y, x);
    let (p, q, r, s) = (angle(y.lo, x.lo), angle(y.lo, x.hi), angle(y.hi, x.lo), angle(y.hi, x.hi));
    let room = 2.0 * functions::error2(Binary::Atan2) + 1.0;
    let lo = least(least(p, q), least(r, s));
    let hi = most(most(p, q), most(r, s));
    let lo = if lo == 0.0 { lo } else { down(lo, room) };
    let hi = if hi == 0.0 { hi } else { up(hi, room) };
    Interval::new(lo, hi).clip(-PI, PI)
}

/// Powers: of the part of `a` that is not negative by its corners; of the negative part where `b` holds whole numbers.
#[inline(always)]
pub(super) fn pow(a: Interval, b: Interval) -> Interval {
    let whole = (b.lo == b.hi) & (b.lo == b.lo.floor());
    let mut range = Interval { undefined: false, ..Interval::EMPTY };
    if a.hi >= 0.0 {
        range = corners(most(a.lo, 0.0), a.hi, b);
        // The power of -0 to an odd negative number is negative.
        if (a.lo <= 0.0) & (b.lo < 0.0) {
            range.lo = -INF;
        }
    }
    if a.lo < 0.0 {
        range = range.hull(negative(a, b, whole));
    }
    // IEEE gives infinity a power that is not whole, whatever its sign.
    if (a.lo == -INF) & !whole {
        range = range.hull(corners(INF, INF, b));
    }
    range.or_undefined((a.lo < 0.0) & !whole)
}

/// `a.lo <= base <= a.hi`, base >= 0: monotone in either operand while the other one stays.
#[inline(always)]
fn corners(lo: f64, hi: f64, b: Interval) -> Interval {
    let (p, q) = (functions::pow(lo, b.lo), functions::pow(lo, b.hi));
    let (r, s) = (functions::pow(hi, b.lo), functions::pow(hi, b.hi));
    let room = 2.0 * functions::error2(Binary::Pow) + 1.0;
    let (mut least, mut most) = (least(least(p, q), least(r, s)), most(most(p, q), most(r, s)));
    // Exponent 0 inside, or base 1 inside, gives 1; the corners already lie on both sides of it.
    least = if least == 0.0 { 0.0 } else { down(least, room) };
    most = if most == 0.0 { 0.0 } else { up(most, room) };
    Interval::new(least, most)
}

/// The negative bases of `a`: only whole exponents give values.
#[inline(always)]
fn negative(a: Interval, b: Interval, whole: bool) -> Interval {
    if b.lo.ceil() > b.hi.floor() {
        return Interval { undefined: false, ..Interval::EMPTY };
    }
    let size = corners(most(-a.hi, 0.0), -a.lo, b);
    let odd = (b.lo % 2.0).abs() == 1.0;
    match (whole, odd) {
        (true, true) => Interval::new(-size.hi, -size.lo),
        (true, false) => size,
        _ => Interval::new(-size.hi, size.hi),
    }
}
