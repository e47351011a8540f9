//! What every primitive operation means for machine numbers: the one meaning that blocks, scalars and folded constants share.
//!
//! Called with a constant operation in a loop, each becomes vector code: the choice of the operation falls away.

use super::Algebra;
use super::float::{self, Float};
use super::functions;
use super::norm;
use super::op::{Binary, Ternary, Unary};
use super::rfunction;

impl Unary {
    /// The operation on a machine number.
    #[inline(always)]
    pub fn of<T: Float>(self, a: T) -> T {
        if self.is_rare(a) { self.rare(a) } else { self.common(a) }
    }

    /// Whether [`Unary::common`] is not for this number: huge angles, which would break up a loop's vector code.
    #[inline(always)]
    pub fn is_rare<T: Float>(self, a: T) -> bool {
        matches!(self, Self::Sin | Self::Cos | Self::Tan) && a.magnitude() > T::of(functions::NEAR)
    }

    /// The operation where it is rare: through the slow exact reduction.
    #[cold]
    fn rare<T: Float>(self, a: T) -> T {
        match self {
            Self::Sin => T::of(functions::sin(a.double())),
            Self::Cos => T::of(functions::cos(a.double())),
            Self::Tan => T::of(functions::tan(a.double())),
            other => other.common(a),
        }
    }

    /// The operation on every number of a block, the same bits as [`Unary::of`]; with a constant `self` it is vector code.
    /// What the longer slice has beyond the shorter stays.
    #[inline(always)]
    pub fn map<T: Float>(self, a: &[T], out: &mut [T]) {
        let length = a.len().min(out.len());
        let (a, out) = (&a[..length], &mut out[..length]);
        match self {
            // With the usual exponents as constants the loop over their bits falls away.
            Self::Powi(-2..=4) => {}
            Self::Powi(n) => return float::powi_map(a, out, n),
            _ => {}
        }
        let mut rare = false;
        for (&a, out) in a.iter().zip(&mut *out) {
            *out = self.common(a);
            rare |= self.is_rare(a);
        }
        if rare {
            for (&a, out) in a.iter().zip(out) {
                *out = self.of(a);
            }
        }
    }

    /// The operation without branches, for numbers that are not rare.
    #[inline(always)]
    pub fn common<T: Float>(self, a: T) -> T {
        match self {
            Self::Neg => -a,
            Self::Abs => a.magnitude(),
            Self::Sqrt => a.root(),
            Self::Floor => a.down(),
            Self::Ceil => a.up(),
            Self::Round => a.nearest(),
            // The product keeps an undefined operand undefined.
            Self::Sign => T::ONE.when(a > T::ZERO, (-T::ONE).when(a < T::ZERO, a * T::ZERO)),
            Self::Not => T::truth(!is_true(a)),
            Self::Powi(n) => float::powi(a, n),
            elementary => a.elementary(elementary),
        }
    }

    /// The operation on a double.
    #[inline(always)]
    #[must_use]
    pub fn real(self, a: f64) -> f64 {
        self.of(a)
    }

    /// The operation on a single.
    #[inline(always)]
    #[must_use]
    pub fn single(self, a: f32) -> f32 {
        self.of(a)
    }
}

impl Binary {
    /// The operation on machine numbers.
    #[inline(always)]
    pub fn of<T: Float>(self, a: T, b: T) -> T {
        match self {
            Self::Add => a + b,
            Self::Sub => a - b,
            Self::Mul => a * b,
            Self::Div => a / b,
            Self::Min => float::min(a, b),
            Self::Max => float::max(a, b),
            Self::Pow => float::pow(a, b),
            Self::Atan2 => float::atan2(a, b),
            Self::Hypot => float::hypot(a, b),
            Self::Mod => float::modulo(a, b),
            Self::Less => T::truth(a < b),
            Self::LessEqual => T::truth(a <= b),
            Self::Equal => T::truth(a == b),
            // With an undefined operand neither holds: not the negation of equality.
            Self::NotEqual => T::truth((a < b) | (a > b)),
            Self::And => T::truth(is_true(a) & is_true(b)),
            Self::Or => T::truth(is_true(a) | is_true(b)),
        }
    }

    /// The operation on doubles.
    #[inline(always)]
    #[must_use]
    pub fn real(self, a: f64, b: f64) -> f64 {
        self.of(a, b)
    }

    /// The operation on singles.
    #[inline(always)]
    #[must_use]
    pub fn single(self, a: f32, b: f32) -> f32 {
        self.of(a, b)
    }
}

impl Ternary {
    /// The operation on machine numbers.
    #[inline(always)]
    pub fn of<T: Float>(self, a: T, b: T, c: T) -> T {
        match self {
            Self::Select => b.when(is_true(a), c),
            Self::Union => rfunction::union(a, b, c),
            Self::Intersection => rfunction::intersection(a, b, c),
            Self::UnionSmooth => rfunction::union_smooth(a, b, c),
            Self::IntersectionSmooth => rfunction::intersection_smooth(a, b, c),
            Self::Norm => norm::norm(a, b, c),
        }
    }

    /// The operation on doubles.
    #[inline(always)]
    #[must_use]
    pub fn real(self, a: f64, b: f64, c: f64) -> f64 {
        self.of(a, b, c)
    }

    /// The operation on singles.
    #[inline(always)]
    #[must_use]
    pub fn single(self, a: f32, b: f32, c: f32) -> f32 {
        self.of(a, b, c)
    }
}

/// Whether a number counts as true: not 0 and not undefined.
#[inline(always)]
pub fn is_true<T: Float>(a: T) -> bool {
    (a < T::ZERO) | (a > T::ZERO)
}

/// The algebra of doubles.
#[derive(Clone, Copy, Debug, Default)]
pub struct Reals;

impl Algebra for Reals {
    type Number = f64;

    fn constant(&mut self, value: f64) -> f64 {
        value
    }
    fn unary(&mut self, op: Unary, a: f64) -> f64 {
        op.real(a)
    }
    fn binary(&mut self, op: Binary, a: f64, b: f64) -> f64 {
        op.real(a, b)
    }
    fn ternary(&mut self, op: Ternary, a: f64, b: f64, c: f64) -> f64 {
        op.real(a, b, c)
    }
}
