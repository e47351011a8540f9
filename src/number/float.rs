//! The two machine numbers, single and double, behind one trait, so that what an operation means is written once for both.
//! Never fuses a multiplication with an addition, never calls the system's mathematical library.

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::functions;
use super::op::Unary;

/// `f64` or `f32`. Everything here is branch-free where it matters, so that a loop over a block becomes vector code.
///
/// The elementary functions of `f32` are within 0.52 units in the last place, `exp` and `log` within 1.
pub trait Float:
    Copy
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + Default
    + std::fmt::Debug
    + Send
    + Sync
    + 'static
{
    /// 0
    const ZERO: Self;
    /// 1
    const ONE: Self;
    /// 2
    const TWO: Self;
    /// 1/2
    const HALF: Self;
    /// The smallest positive number.
    const TINY: Self;
    /// Undefined.
    const NAN: Self;
    /// Infinity.
    const INFINITY: Self;

    /// The nearest number to `value`.
    fn of(value: f64) -> Self;
    /// The same number as a double.
    fn double(self) -> f64;
    /// Square root, correctly rounded.
    fn root(self) -> Self;
    /// Magnitude.
    fn magnitude(self) -> Self;
    /// Largest whole number not above.
    fn down(self) -> Self;
    /// Smallest whole number not below.
    fn up(self) -> Self;
    /// Nearest whole number, halves away from zero.
    fn nearest(self) -> Self;
    /// For a magnitude: `(1/p, p)` with p the power of two at or below it, kept away from the ends of the range, so that
    /// a number of at most that magnitude times `1/p` squares without overflow.
    fn scale(self) -> (Self, Self);
    /// An elementary function; angles up to [`functions::NEAR`].
    fn elementary(self, op: Unary) -> Self;

    /// Whether it is undefined.
    #[inline(always)]
    fn undefined(self) -> bool {
        self.partial_cmp(&self).is_none()
    }

    /// `self` where `condition` holds, else `other`.
    #[inline(always)]
    fn when(self, condition: bool, other: Self) -> Self {
        if condition { self } else { other }
    }

    /// 1 for true, 0 for false.
    #[inline(always)]
    fn truth(condition: bool) -> Self {
        Self::ONE.when(condition, Self::ZERO)
    }
}

impl Float for f64 {
    const ZERO: Self = 0.0;
    const ONE: Self = 1.0;
    const TWO: Self = 2.0;
    const HALF: Self = 0.5;
    const TINY: Self = f64::from_bits(1);
    const NAN: Self = f64::NAN;
    const INFINITY: Self = f64::INFINITY;

    #[inline(always)]
    fn of(value: f64) -> Self {
        value
    }
    #[inline(always)]
    fn double(self) -> f64 {
        self
    }
    #[inline(always)]
    fn root(self) -> Self {
        self.sqrt()
    }
    #[inline(always)]
    fn magnitude(self) -> Self {
        self.abs()
    }
    #[inline(always)]
    fn down(self) -> Self {
        self.floor()
    }
    #[inline(always)]
    fn up(self) -> Self {
        self.ceil()
    }
    #[inline(always)]
    fn nearest(self) -> Self {
        self.round()
    }
    #[inline(always)]
    fn scale(self) -> (Self, Self) {
        const LO: f64 = f64::from_bits(1 << 52);
        const HI: f64 = f64::from_bits(2045 << 52);
        let kept = if self > LO { self } else { LO };
        let kept = if kept < HI { kept } else { HI };
        let power = kept.to_bits() & (0x7ff << 52);
        (f64::from_bits((2046 << 52) - power), f64::from_bits(power))
    }
    #[inline(always)]
    fn elementary(self, op: Unary) -> Self {
        functions::near(op, self)
    }
    #[inline(always)]
    fn undefined(self) -> bool {
        self.is_nan()
    }
}

impl Float for f32 {
    const ZERO: Self = 0.0;
    const ONE: Self = 1.0;
    const TWO: Self = 2.0;
    const HALF: Self = 0.5;
    const TINY: Self = f32::from_bits(1);
    const NAN: Self = f32::NAN;
    const INFINITY: Self = f32::INFINITY;

    #[inline(always)]
    #[allow(clippy::cast_possible_truncation)]
    fn of(value: f64) -> Self {
        value as f32
    }
    #[inline(always)]
    fn double(self) -> f64 {
        f64::from(self)
    }
    #[inline(always)]
    fn root(self) -> Self {
        self.sqrt()
    }
    #[inline(always)]
    fn magnitude(self) -> Self {
        self.abs()
    }
    #[inline(always)]
    fn down(self) -> Self {
        self.floor()
    }
    #[inline(always)]
    fn up(self) -> Self {
        self.ceil()
    }
    #[inline(always)]
    fn nearest(self) -> Self {
        self.round()
    }
    #[inline(always)]
    fn scale(self) -> (Self, Self) {
        const LO: f32 = f32::from_bits(1 << 23);
        const HI: f32 = f32::from_bits(253 << 23);
        let kept = if self > LO { self } else { LO };
        let kept = if kept < HI { kept } else { HI };
        let power = kept.to_bits() & (0xff << 23);
        (f32::from_bits((254 << 23) - power), f32::from_bits(power))
    }
    #[inline(always)]
    fn elementary(self, op: Unary) -> Self {
        functions::near_single(op, self)
    }
    #[inline(always)]
    fn undefined(self) -> bool {
        self.is_nan()
    }
}

/// The larger; an undefined operand leaves the other one; the first on a tie.
#[inline(always)]
pub fn max<T: Float>(a: T, b: T) -> T {
    a.when((a >= b) | b.undefined(), b)
}

/// The smaller; undefined if one is; the first on a tie.
#[inline(always)]
pub fn min<T: Float>(a: T, b: T) -> T {
    a.when((a <= b) | a.undefined(), b)
}

/// sqrt(a^2 + b^2) without overflow, within 1.3 units in the last place.
#[inline(always)]
pub fn hypot<T: Float>(a: T, b: T) -> T {
    let (x, y) = (a.magnitude(), b.magnitude());
    let (down, up) = x.when(x > y, y).scale();
    let (x, y) = (x * down, y * down);
    (x * x + y * y).root() * up
}

/// a to a whole power by repeated squaring, of 1/a for a negative one: within n units in the last place, for a
/// negative one twice as many.
#[inline(always)]
pub fn powi<T: Float>(a: T, n: i32) -> T {
    let mut square = if n < 0 { T::ONE / a } else { a };
    let mut rest = n.unsigned_abs();
    // An undefined base leaves an undefined power, also to the power 0.
    let mut result = T::ONE.when(!a.undefined(), a);
    while rest != 0 {
        if rest & 1 == 1 {
            result = result * square;
        }
        rest >>= 1;
        if rest != 0 {
            square = square * square;
        }
    }
    result
}

/// [`powi`] of every number of a block: loops over lanes within the loop over the exponent's bits, which are not known when it is
/// compiled.
#[inline(always)]
pub fn powi_map<T: Float>(a: &[T], out: &mut [T], n: i32) {
    const LANES: usize = 64;
    for (a, out) in a.chunks(LANES).zip(out.chunks_mut(LANES)) {
        let mut square = [T::ONE; LANES];
        let square = &mut square[..a.len()];
        for ((&a, square), out) in a.iter().zip(&mut *square).zip(&mut *out) {
            *square = if n < 0 { T::ONE / a } else { a };
            *out = T::ONE.when(!a.undefined(), a);
        }
        let mut rest = n.unsigned_abs();
        while rest != 0 {
            if rest & 1 == 1 {
                out.iter_mut().zip(&*square).for_each(|(out, &square)| *out = *out * square);
            }
            rest >>= 1;
            if rest != 0 {
                square.iter_mut().for_each(|square| *square = *square * *square);
            }
        }
    }
}

/// a - b floor(a / b), as it stands.
#[inline(always)]
pub fn modulo<T: Float>(a: T, b: T) -> T {
    a - b * (a / b).down()
}

/// Angle of the point (x = b, y = a).
#[inline(always)]
pub fn atan2<T: Float>(a: T, b: T) -> T {
    T::of(functions::atan2(a.double(), b.double()))
}

/// a to the power b; undefined if one is.
#[inline(always)]
pub fn pow<T: Float>(a: T, b: T) -> T {
    T::of(functions::pow(a.double(), b.double()))
}
