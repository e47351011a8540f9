//! Intervals rounded outward, with "may be undefined".
//!
//! An interval holds the exact values over a box and those that [`super::Reals`] computes there. It never turns to NaN; where
//! a product or quotient underflows to zero, the bound is that zero, as the points compute it.

use super::Algebra;
use super::norm;
use super::op::{Binary, Ternary, Unary};

mod arithmetic;
mod elementary;
mod rounding;
mod sets;

pub use rounding::{next_down, next_up};

/// All values of an expression over a box: those in `lo..=hi`, and perhaps undefined ones.
///
/// `lo > hi` (namely `+inf > -inf`) holds no defined value: undefined everywhere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// Lower bound, never NaN.
    pub lo: f64,
    /// Upper bound, never NaN.
    pub hi: f64,
    /// Whether the value may be undefined (NaN) somewhere in the box.
    pub undefined: bool,
}

impl Interval {
    /// No defined value at all.
    pub const EMPTY: Self = Self { lo: f64::INFINITY, hi: f64::NEG_INFINITY, undefined: true };
    /// Any number, infinite ones included, all of them defined.
    pub const WHOLE: Self = Self { lo: f64::NEG_INFINITY, hi: f64::INFINITY, undefined: false };
    /// Truth that is not known: 0 or 1.
    pub const MAYBE: Self = Self { lo: 0.0, hi: 1.0, undefined: false };

    /// `lo..=hi`, defined everywhere.
    #[inline(always)]
    #[must_use]
    pub fn new(lo: f64, hi: f64) -> Self {
        Self { lo, hi, undefined: false }
    }

    /// The one number `value`; NaN is [`Interval::EMPTY`].
    #[inline(always)]
    #[must_use]
    pub fn point(value: f64) -> Self {
        if value.is_nan() { Self::EMPTY } else { Self::new(value, value) }
    }

    /// 1 for true, 0 for false.
    #[inline(always)]
    #[must_use]
    pub fn truth(known: bool) -> Self {
        let value = if known { 1.0 } else { 0.0 };
        Self::new(value, value)
    }

    /// The same numbers, and perhaps undefined values if `undefined`.
    #[inline(always)]
    #[must_use]
    pub fn or_undefined(self, undefined: bool) -> Self {
        Self { undefined: self.undefined | undefined, ..self }
    }

    /// Whether it holds no defined value.
    #[inline(always)]
    #[must_use]
    pub fn is_empty(self) -> bool {
        self.lo > self.hi
    }

    /// Whether it is one defined number.
    #[inline(always)]
    #[must_use]
    pub fn is_point(self) -> bool {
        (self.lo == self.hi) & !self.undefined
    }

    /// Whether `value` may occur; for NaN: whether undefined values may.
    #[inline(always)]
    #[must_use]
    pub fn contains(self, value: f64) -> bool {
        if value.is_nan() { self.undefined } else { (self.lo <= value) & (value <= self.hi) }
    }

    /// Whether every value is defined and inside an object: `f >= 0` all over the box.
    #[inline(always)]
    #[must_use]
    pub fn is_positive(self) -> bool {
        (self.lo >= 0.0) & !self.undefined
    }

    /// Whether every value is outside an object: negative or undefined all over the box.
    #[inline(always)]
    #[must_use]
    pub fn is_negative(self) -> bool {
        self.hi < 0.0
    }

    /// The smallest interval that holds both.
    #[inline(always)]
    #[must_use]
    pub fn hull(self, other: Self) -> Self {
        Self {
            lo: rounding::least(self.lo, other.lo),
            hi: rounding::most(self.hi, other.hi),
            undefined: self.undefined | other.undefined,
        }
    }

    /// The part in `lo..=hi`; what falls away does so silently.
    #[inline(always)]
    #[must_use]
    pub fn clip(self, lo: f64, hi: f64) -> Self {
        let (l, h) = (rounding::most(self.lo, lo), rounding::least(self.hi, hi));
        if l > h { Self { undefined: self.undefined, ..Self::EMPTY } } else { Self { lo: l, hi: h, ..self } }
    }

    /// Largest magnitude.
    #[inline(always)]
    #[must_use]
    pub fn largest(self) -> f64 {
        rounding::most(self.lo.abs(), self.hi.abs())
    }

    /// Smallest magnitude.
    #[inline(always)]
    #[must_use]
    pub fn smallest(self) -> f64 {
        rounding::most(rounding::most(self.lo, -self.hi), 0.0)
    }

    /// With room for values computed in single precision: `steps` single-precision roundings of the bounds, and the range of
    /// singles below which they underflow.
    #[inline(always)]
    #[must_use]
    pub fn widen_single(self, steps: f64) -> Self {
        let room = |bound: f64| bound.abs() * (steps * f64::from(f32::EPSILON)) + steps * f64::from(f32::from_bits(1));
        let lo = self.lo - room(self.lo);
        let hi = self.hi + room(self.hi);
        // Infinity less infinity is no number: such a lower bound is the largest single; likewise above.
        let lo = if lo.is_nan() { f64::from(f32::MAX) } else { lo };
        let hi = if hi.is_nan() { f64::from(f32::MIN) } else { hi };
        if self.is_empty() { self } else { Self { lo, hi, ..self } }
    }
}

/// The result of an operation that is undefined where an operand is: `value`, empty if an operand is.
#[inline(always)]
fn strict(value: Interval, a: Interval, b: Interval) -> Interval {
    let undefined = value.undefined | a.undefined | b.undefined;
    let none = a.is_empty() | b.is_empty();
    Interval {
        lo: if none { f64::INFINITY } else { value.lo },
        hi: if none { f64::NEG_INFINITY } else { value.hi },
        undefined,
    }
}

impl Unary {
    /// The operation on an interval.
    #[inline(always)]
    #[must_use]
    pub fn interval(self, a: Interval) -> Interval {
        let value = match self {
            Self::Neg => Interval { lo: -a.hi, hi: -a.lo, ..a },
            Self::Abs => Interval { lo: a.smallest(), hi: a.largest(), ..a },
            Self::Sqrt => arithmetic::root(a),
            Self::Floor | Self::Ceil | Self::Round | Self::Sign => {
                Interval { lo: self.real(a.lo), hi: self.real(a.hi), ..a }
            }
            Self::Not => return sets::not(a),
            Self::Powi(n) => arithmetic::powi(a, n),
            elementary => elementary::unary(elementary, a),
        };
        strict(value, a, a)
    }
}

impl Binary {
    /// The operation on intervals.
    #[inline(always)]
    #[must_use]
    pub fn interval(self, a: Interval, b: Interval) -> Interval {
        let value = match self {
            Self::Add => arithmetic::add(a, b),
            Self::Sub => arithmetic::add(a, Interval { lo: -b.hi, hi: -b.lo, ..b }),
            Self::Mul => arithmetic::multiply(a, b),
            Self::Div => arithmetic::divide(a, b),
            Self::Min => Interval::new(rounding::least(a.lo, b.lo), rounding::least(a.hi, b.hi)),
            Self::Max => return sets::max(a, b),
            Self::Pow => elementary::pow(a, b),
            Self::Atan2 => elementary::atan2(a, b),
            Self::Hypot => arithmetic::hypot(a, b),
            Self::Mod => arithmetic::modulo(a, b),
            Self::Less | Self::LessEqual | Self::Equal | Self::NotEqual => return sets::compare(self, a, b),
            Self::And => return sets::and(a, b),
            Self::Or => return sets::or(a, b),
        };
        strict(value, a, b)
    }
}

impl Ternary {
    /// The operation on intervals.
    #[inline(always)]
    #[must_use]
    pub fn interval(self, a: Interval, b: Interval, c: Interval) -> Interval {
        match self {
            Self::Select => sets::select(a, b, c),
            Self::Union => sets::union(a, b, c),
            Self::Intersection => sets::intersection(a, b, c),
            Self::UnionSmooth => sets::union_smooth(a, b, c),
            Self::IntersectionSmooth => sets::intersection_smooth(a, b, c),
            Self::Norm => {
                let (a, b) = (Unary::Abs.interval(a), Unary::Abs.interval(b));
                strict(strict(norm::range(a, b, c), a, b), c, c)
            }
        }
    }
}

/// The algebra of intervals.
#[derive(Clone, Copy, Debug, Default)]
pub struct Intervals;

impl Algebra for Intervals {
    type Number = Interval;

    fn constant(&mut self, value: f64) -> Interval {
        Interval::point(value)
    }
    fn unary(&mut self, op: Unary, a: Interval) -> Interval {
        op.interval(a)
    }
    fn binary(&mut self, op: Binary, a: Interval, b: Interval) -> Interval {
        op.interval(a, b)
    }
    fn ternary(&mut self, op: Ternary, a: Interval, b: Interval, c: Interval) -> Interval {
        op.interval(a, b, c)
    }
}
