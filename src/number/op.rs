//! The primitive operations of the expression graph. Each number type of this room gives each of them its meaning; every other
//! built-in function is written over these (`builtins`).

/// A double that can be hashed and compared by its bits, so that it may stand in a hash-consed node. All NaNs are one.
#[derive(Clone, Copy, Debug)]
pub struct Real(f64);

impl Real {
    /// The number; every NaN becomes the same one, and -0 stays apart from 0.
    #[must_use]
    pub fn new(value: f64) -> Self {
        Self(if value.is_nan() { f64::NAN } else { value })
    }

    /// The number as a double.
    #[must_use]
    pub fn get(self) -> f64 {
        self.0
    }
}

impl PartialEq for Real {
    fn eq(&self, other: &Self) -> bool {
        self.0.to_bits() == other.0.to_bits()
    }
}
impl Eq for Real {}
impl std::hash::Hash for Real {
    fn hash<H: std::hash::Hasher>(&self, state: &mut H) {
        self.0.to_bits().hash(state);
    }
}

/// Operations on one number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Unary {
    /// `-a`; also the complement of an object
    Neg,
    /// `|a|`
    Abs,
    /// Square root; undefined for a < 0
    Sqrt,
    /// Cube root, of negative numbers too
    Cbrt,
    /// e^a
    Exp,
    /// Natural logarithm
    Log,
    /// Logarithm to base 10
    Log10,
    /// Sine of radians
    Sin,
    /// Cosine of radians
    Cos,
    /// Tangent of radians
    Tan,
    /// Inverse sine
    Asin,
    /// Inverse cosine
    Acos,
    /// Inverse tangent
    Atan,
    /// Hyperbolic sine
    Sinh,
    /// Hyperbolic cosine
    Cosh,
    /// Hyperbolic tangent
    Tanh,
    /// Inverse hyperbolic sine
    Asinh,
    /// Inverse hyperbolic cosine
    Acosh,
    /// Inverse hyperbolic tangent
    Atanh,
    /// Largest whole number not above a
    Floor,
    /// Smallest whole number not below a
    Ceil,
    /// Nearest whole number, halves away from zero
    Round,
    /// -1, 0 or 1
    Sign,
    /// Truth: 1 where a = 0, 0 elsewhere; undefined counts as false, so its NOT is 1
    Not,
    /// a to a whole constant power, by repeated squaring of a (of 1/a for a negative one)
    Powi(i32),
}

/// Operations on two numbers. Comparisons and truths are 1 or 0; a comparison with an undefined operand is 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Binary {
    /// a + b
    Add,
    /// a - b
    Sub,
    /// a * b
    Mul,
    /// a / b
    Div,
    /// The smaller; undefined if one is
    Min,
    /// The larger; an undefined operand leaves the other one
    Max,
    /// a to the power b
    Pow,
    /// Angle of the point (x = b, y = a)
    Atan2,
    /// sqrt(a^2 + b^2) without overflow
    Hypot,
    /// a - b floor(a / b)
    Mod,
    /// a < b
    Less,
    /// a <= b
    LessEqual,
    /// a = b
    Equal,
    /// a <> b
    NotEqual,
    /// Both are true (not 0 and defined)
    And,
    /// One is true
    Or,
}

/// Operations on three numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Ternary {
    /// `IF a THEN b ELSE c`: b where a is true (not 0, defined), else c
    Select,
    /// R-union of a and b with `r_alpha` = c: \[P95\] eq. (2), computed as `mathematics.md` 1 says; an undefined operand leaves the other
    Union,
    /// R-intersection of a and b with `r_alpha` = c: -((-a) | (-b)); undefined if one is
    Intersection,
    /// R-union of a and b with alpha = 0 and the factor (a^2+b^2)^(m/2), m = c: \[P95\] eq. (5)
    UnionSmooth,
    /// R-intersection with that factor
    IntersectionSmooth,
    /// The p-norm `(|a|^c + |b|^c)^(1/c)`: \[H90\] eq. (1) and, for c < 0, (10); undefined if an operand is, or for c = 0
    Norm,
}

impl Unary {
    /// Every one, but for whole powers, of which there is one for each number.
    pub const ALL: &[Self] = &[
        Self::Neg,
        Self::Abs,
        Self::Sqrt,
        Self::Cbrt,
        Self::Exp,
        Self::Log,
        Self::Log10,
        Self::Sin,
        Self::Cos,
        Self::Tan,
        Self::Asin,
        Self::Acos,
        Self::Atan,
        Self::Sinh,
        Self::Cosh,
        Self::Tanh,
        Self::Asinh,
        Self::Acosh,
        Self::Atanh,
        Self::Floor,
        Self::Ceil,
        Self::Round,
        Self::Sign,
        Self::Not,
    ];
}

impl Binary {
    /// Every one.
    pub const ALL: &[Self] = &[
        Self::Add,
        Self::Sub,
        Self::Mul,
        Self::Div,
        Self::Min,
        Self::Max,
        Self::Pow,
        Self::Atan2,
        Self::Hypot,
        Self::Mod,
        Self::Less,
        Self::LessEqual,
        Self::Equal,
        Self::NotEqual,
        Self::And,
        Self::Or,
    ];
}

impl Ternary {
    /// Every one.
    pub const ALL: &[Self] =
        &[Self::Select, Self::Union, Self::Intersection, Self::UnionSmooth, Self::IntersectionSmooth, Self::Norm];
}
