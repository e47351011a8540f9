//! Numbers with their derivatives, forward: the value is always the bits that `Reals` computes.
//!
//! IF, MIN, MAX and ABS have the derivative of the taken branch (the first on a tie), steps and truths 0, R-functions where
//! both operands vanish that of their root counted as 0. A constant's slope stays 0 also where a function's slope is infinite.

use super::Algebra;
use super::float;
use super::functions;
use super::norm;
use super::op::{Binary, Ternary, Unary};
use super::real::is_true;
use super::rfunction;

/// A value and its derivatives by N variables.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual<const N: usize> {
    /// The value.
    pub value: f64,
    /// The derivative by each variable.
    pub slope: [f64; N],
}

impl<const N: usize> Dual<N> {
    /// A number that does not depend on anything.
    #[inline(always)]
    #[must_use]
    pub fn constant(value: f64) -> Self {
        Self { value, slope: [0.0; N] }
    }

    /// The variable number `index`, from 0.
    ///
    /// # Panics
    /// If `index` is not below N.
    #[must_use]
    pub fn variable(value: f64, index: usize) -> Self {
        let mut slope = [0.0; N];
        slope[index] = 1.0;
        Self { value, slope }
    }

    /// The chain rule for one operand.
    #[inline(always)]
    fn chain(self, value: f64, by: f64) -> Self {
        Self { value, slope: self.slope.map(|s| times(by, s)) }
    }

    /// The chain rule for two operands.
    #[inline(always)]
    fn chain2(self, other: Self, value: f64, by: (f64, f64)) -> Self {
        let slope = std::array::from_fn(|i| times(by.0, self.slope[i]) + times(by.1, other.slope[i]));
        Self { value, slope }
    }

    /// The slope of `self` with the value `value`.
    #[inline(always)]
    fn with(self, value: f64) -> Self {
        Self { value, slope: self.slope }
    }
}

/// A derivative times a slope; a slope of 0 stays 0, whatever the derivative is.
#[inline(always)]
pub fn times(by: f64, slope: f64) -> f64 {
    if slope == 0.0 { 0.0 } else { by * slope }
}

impl Unary {
    /// The derivative of the operation at `a`, where its value is `value`.
    #[inline(always)]
    #[must_use]
    pub fn slope(self, a: f64, value: f64) -> f64 {
        match self {
            Self::Neg => -1.0,
            Self::Abs => {
                if a < 0.0 {
                    -1.0
                } else {
                    1.0
                }
            }
            Self::Sqrt => 0.5 / value,
            Self::Cbrt => 1.0 / (3.0 * value * value),
            Self::Exp => value,
            Self::Log => 1.0 / a,
            Self::Log10 => std::f64::consts::LOG10_E / a,
            Self::Sin => functions::cos(a),
            Self::Cos => -functions::sin(a),
            Self::Tan => 1.0 + value * value,
            Self::Asin => 1.0 / ((1.0 - a) * (1.0 + a)).sqrt(),
            Self::Acos => -1.0 / ((1.0 - a) * (1.0 + a)).sqrt(),
            Self::Atan => 1.0 / (1.0 + a * a),
            Self::Sinh => functions::cosh(a),
            Self::Cosh => functions::sinh(a),
            // 1 - tanh^2 would cancel far from 0.
            Self::Tanh => {
                let cosh = functions::cosh(a);
                1.0 / cosh / cosh
            }
            Self::Asinh => 1.0 / float::hypot(a, 1.0),
            Self::Acosh => 1.0 / ((a - 1.0).sqrt() * (a + 1.0).sqrt()),
            Self::Atanh => 1.0 / ((1.0 - a) * (1.0 + a)),
            Self::Floor | Self::Ceil | Self::Round | Self::Sign | Self::Not | Self::Powi(0) => 0.0,
            Self::Powi(n) => f64::from(n) * float::powi(a, n.saturating_sub(1)),
        }
    }

    /// [`Unary::slope`] for every number of a block, by their values; the same bits. With a constant `self` it is vector code.
    #[inline(always)]
    pub fn slopes_map(self, a: &[f64], values: &[f64], out: &mut [f64]) {
        match self {
            // Rare angles are looked for by the block, not by the number.
            Self::Sin => Self::Cos.map(a, out),
            Self::Cos => {
                Self::Sin.map(a, out);
                out.iter_mut().for_each(|slope| *slope = -*slope);
            }
            _ => a.iter().zip(values).zip(out).for_each(|((&a, &value), out)| *out = self.slope(a, value)),
        }
    }

    /// The operation with derivatives.
    #[inline(always)]
    #[must_use]
    pub fn dual<const N: usize>(self, a: Dual<N>) -> Dual<N> {
        let value = self.real(a.value);
        a.chain(value, self.slope(a.value, value))
    }
}

impl Binary {
    /// The derivatives of the operation by its operands, where its value is `value`.
    #[inline(always)]
    #[must_use]
    pub fn slopes(self, a: f64, b: f64, value: f64) -> (f64, f64) {
        match self {
            Self::Add => (1.0, 1.0),
            Self::Sub => (1.0, -1.0),
            Self::Mul => (b, a),
            Self::Div => (1.0 / b, -value / b),
            Self::Min => {
                if (a <= b) | a.is_nan() {
                    (1.0, 0.0)
                } else {
                    (0.0, 1.0)
                }
            }
            Self::Max => {
                if (a >= b) | b.is_nan() {
                    (1.0, 0.0)
                } else {
                    (0.0, 1.0)
                }
            }
            Self::Pow => power_slopes(a, b, value),
            Self::Atan2 => {
                let square = float::hypot(a, b);
                (b / square / square, -a / square / square)
            }
            Self::Hypot => (a / value, b / value),
            Self::Mod => (1.0, -(a / b).floor()),
            Self::Less | Self::LessEqual | Self::Equal | Self::NotEqual | Self::And | Self::Or => (0.0, 0.0),
        }
    }

    /// The operation with derivatives.
    #[inline(always)]
    #[must_use]
    pub fn dual<const N: usize>(self, a: Dual<N>, b: Dual<N>) -> Dual<N> {
        let value = self.real(a.value, b.value);
        a.chain2(b, value, self.slopes(a.value, b.value, value))
    }
}

/// By the base: `b a^(b-1)`, 0 for the exponent 0. By the exponent: `a^b log a`, 0 where the power vanishes at the base 0.
#[inline(always)]
fn power_slopes(a: f64, b: f64, value: f64) -> (f64, f64) {
    let by_base = b * functions::pow(a, b - 1.0);
    let by_exponent = value * functions::log(a);
    (if b == 0.0 { 0.0 } else { by_base }, if (a == 0.0) & (b > 0.0) { 0.0 } else { by_exponent })
}

impl Ternary {
    /// The operation with derivatives.
    #[inline(always)]
    #[must_use]
    pub fn dual<const N: usize>(self, a: Dual<N>, b: Dual<N>, c: Dual<N>) -> Dual<N> {
        match self {
            Self::Select => {
                if is_true(a.value) {
                    b
                } else {
                    c
                }
            }
            Self::Union => union(a, b, c),
            Self::UnionSmooth => smooth(a, b, c),
            Self::Intersection => intersection(a, b, c, union),
            Self::IntersectionSmooth => intersection(a, b, c, smooth),
            Self::Norm => {
                let value = self.real(a.value, b.value, c.value);
                let by = norm::norm_slopes(a.value, b.value, c.value, value);
                let sides = a.chain2(b, value, (by.0, by.1));
                sides.chain2(c, value, (1.0, by.2))
            }
        }
    }
}

/// An intersection by its union: -((-a) | (-b)), undefined if an operand is.
#[inline(always)]
fn intersection<const N: usize>(
    a: Dual<N>,
    b: Dual<N>,
    c: Dual<N>,
    union: impl Fn(Dual<N>, Dual<N>, Dual<N>) -> Dual<N>,
) -> Dual<N> {
    if a.value.is_nan() | b.value.is_nan() {
        return Binary::Add.dual(a, b);
    }
    let negative = |d: Dual<N>| Unary::Neg.dual(d);
    negative(union(negative(a), negative(b), c))
}

/// The derivatives of the R-union of eq. (2) by its operands and by alpha: `(1 + (f - alpha g)/root)/(1 + alpha)`, its mirror
/// image and `-R^2/(2 root)`.
#[inline(always)]
#[must_use]
pub fn union_slopes(a: f64, b: f64, alpha: f64, value: f64) -> (f64, f64, f64) {
    let infinite = a.is_infinite() | b.is_infinite();
    if (alpha == 1.0) | infinite | a.is_nan() | b.is_nan() {
        let (by_a, by_b) = Binary::Max.slopes(a, b, value);
        return (by_a, by_b, 0.0);
    }
    let (down, _) = float::Float::scale(a.abs().max(b.abs()));
    let (f, g) = (a * down, b * down);
    let root = rfunction::root(f, g, alpha);
    let over = |x: f64| if root == 0.0 { 0.0 } else { x / root };
    let plus = 1.0 + alpha;
    ((1.0 + over(f - alpha * g)) / plus, (1.0 + over(g - alpha * f)) / plus, -0.5 * over(value * down) * value)
}

#[inline(always)]
fn union<const N: usize>(a: Dual<N>, b: Dual<N>, alpha: Dual<N>) -> Dual<N> {
    let value = Ternary::Union.real(a.value, b.value, alpha.value);
    if value.is_nan() {
        return Binary::Add.dual(a, b).with(f64::NAN);
    }
    let by = union_slopes(a.value, b.value, alpha.value, value);
    let sides = a.chain2(b, value, (by.0, by.1));
    sides.chain2(alpha, value, (1.0, by.2))
}

/// The R-union of eq. (5): the product rule over the union with alpha = 0 and the factor.
#[inline(always)]
fn smooth<const N: usize>(a: Dual<N>, b: Dual<N>, m: Dual<N>) -> Dual<N> {
    let value = Ternary::UnionSmooth.real(a.value, b.value, m.value);
    if a.value.is_nan() | b.value.is_nan() {
        let (by_a, by_b) = Binary::Max.slopes(a.value, b.value, value);
        return a.chain2(b, value, (by_a, by_b));
    }
    let plain = union(a, b, Dual::constant(0.0));
    let radius = Binary::Hypot.real(a.value, b.value);
    if radius == 0.0 {
        let slope = if m.value > 0.0 { [0.0; N] } else { plain.slope };
        return Dual { value, slope };
    }
    let size = a.chain2(b, radius, (a.value / radius, b.value / radius));
    let factor = Binary::Pow.dual(size, m);
    Binary::Mul.dual(plain, factor).with(value)
}

/// The algebra of duals.
#[derive(Clone, Copy, Debug, Default)]
pub struct Duals<const N: usize>;

impl<const N: usize> Algebra for Duals<N> {
    type Number = Dual<N>;

    fn constant(&mut self, value: f64) -> Dual<N> {
        Dual::constant(value)
    }
    fn unary(&mut self, op: Unary, a: Dual<N>) -> Dual<N> {
        op.dual(a)
    }
    fn binary(&mut self, op: Binary, a: Dual<N>, b: Dual<N>) -> Dual<N> {
        op.dual(a, b)
    }
    fn ternary(&mut self, op: Ternary, a: Dual<N>, b: Dual<N>, c: Dual<N>) -> Dual<N> {
        op.dual(a, b, c)
    }
}
