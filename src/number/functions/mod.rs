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
mod trigonometric;

pub use exponential::{exp, log, log10, pow};
pub use hyperbolic::{cosh, sinh, tanh};
pub use inverse::{acos, asin, atan, atan2};
pub use libm::{asinh, atanh, cbrt};
pub use trigonometric::{NEAR, cos, cos_near, sin, sin_near, tan, tan_near};

/// The inverse hyperbolic cosine, within 2 units in the last place; undefined below 1.
#[inline(always)]
#[must_use]
pub fn acosh(x: f64) -> f64 {
    // The library gives a number there.
    if x < 1.0 { f64::NAN } else { libm::acosh(x) }
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
        Unary::Tan | Unary::Atan | Unary::Sinh | Unary::Cosh | Unary::Asinh | Unary::Acosh | Unary::Atanh => 2.0,
        Unary::Tanh => 3.0,
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
