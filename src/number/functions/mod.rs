//! The elementary functions of doubles: ours, so that every evaluator and every machine gives the same bits.
//!
//! Branch-free, so that a loop over a block becomes vector code; never fuses a multiplication with an addition and never calls
//! the system's mathematical library. The kernels' coefficients are those of FDLIBM (Sun Microsystems 1993, freely granted).
//! Sines of huge angles and the functions that few models use come from the `libm` crate, which is portable too.
//! Each function states its error bound in units in the last place; [`error`] gives the same bounds to the intervals.

use super::op::{Binary, Unary};

mod double;
mod exponential;
mod hyperbolic;
mod inverse;
mod single;
mod trigonometric;

pub use exponential::{exp, log, log10, pow};
pub use hyperbolic::{cosh, sinh, tanh};
pub use inverse::{acos, asin, atan, atan2};
pub use libm::{asinh, atanh, cbrt};
pub use trigonometric::{NEAR, cos, cos_near, sin, sin_near, tan, tan_near};

/// The inverse hyperbolic cosine, within 3 units in the last place; undefined below 1.
#[inline(always)]
#[must_use]
pub fn acosh(x: f64) -> f64 {
    // The library gives a number there.
    if x < 1.0 { f64::NAN } else { libm::acosh(x) }
}

/// An elementary function of a double; angles up to [`NEAR`].
#[inline(always)]
pub(super) fn near(op: Unary, x: f64) -> f64 {
    match op {
        Unary::Cbrt => cbrt(x),
        Unary::Exp => exp(x),
        Unary::Log => log(x),
        Unary::Log10 => log10(x),
        Unary::Sin => sin_near(x),
        Unary::Cos => cos_near(x),
        Unary::Tan => tan_near(x),
        Unary::Asin => asin(x),
        Unary::Acos => acos(x),
        Unary::Atan => atan(x),
        Unary::Sinh => sinh(x),
        Unary::Cosh => cosh(x),
        Unary::Tanh => tanh(x),
        Unary::Asinh => asinh(x),
        Unary::Acosh => acosh(x),
        Unary::Atanh => atanh(x),
        _ => f64::NAN,
    }
}

/// An elementary function of a single; angles up to [`NEAR`]. Those without a kernel of their own are rounded from doubles.
#[inline(always)]
#[allow(clippy::cast_possible_truncation)]
pub(super) fn near_single(op: Unary, x: f32) -> f32 {
    match op {
        Unary::Exp => single::exp(x),
        Unary::Log => single::log(x),
        Unary::Log10 => single::log10(x),
        Unary::Sin => single::sin(x),
        Unary::Cos => single::cos(x),
        Unary::Tan => single::tan(x),
        _ => near(op, f64::from(x)) as f32,
    }
}

/// The error bound of a function of one number, in units in the last place of the result.
#[must_use]
pub const fn error(op: Unary) -> f64 {
    match op {
        Unary::Neg | Unary::Abs | Unary::Floor | Unary::Ceil | Unary::Round | Unary::Sign | Unary::Not => 0.0,
        Unary::Sqrt => 0.5,
        // The reciprocal's error counts in every factor.
        Unary::Powi(n) => n.unsigned_abs() as f64 * if n < 0 { 2.0 } else { 1.0 },
        Unary::Exp | Unary::Log | Unary::Log10 | Unary::Sin | Unary::Cos | Unary::Asin | Unary::Acos | Unary::Cbrt => {
            1.0
        }
        Unary::Tan | Unary::Atan | Unary::Sinh | Unary::Cosh | Unary::Asinh | Unary::Atanh => 2.0,
        Unary::Tanh | Unary::Acosh => 3.0,
    }
}

/// The error bound of an elementary function of two numbers, in units in the last place of the result.
#[must_use]
pub const fn error2(op: Binary) -> f64 {
    match op {
        Binary::Pow => 1.0,
        Binary::Atan2 => 2.0,
        Binary::Hypot => 1.3,
        _ => 0.5,
    }
}
