//! The elementary functions of doubles: ours, so that every evaluator and every machine gives the same bits.
//!
//! Never fuses a multiplication with an addition and never calls the system's mathematical library. Each function states
//! its error bound in units in the last place; [`error`] gives the same bounds to the intervals.

use super::op::{Binary, Unary};

pub use libm::{acos, acosh, asin, asinh, atan, atan2, atanh, cbrt, cos, cosh, exp, log, log10, sin, sinh, tan, tanh};

/// a to the power b as IEEE has it, but undefined if an operand is.
#[inline(always)]
pub fn pow(a: f64, b: f64) -> f64 {
    let value = libm::pow(a, b);
    if a.is_nan() | b.is_nan() { f64::NAN } else { value }
}

/// The error bound of a function of one number, in units in the last place of the result.
#[must_use]
pub const fn error(op: Unary) -> f64 {
    match op {
        Unary::Neg | Unary::Abs | Unary::Floor | Unary::Ceil | Unary::Round | Unary::Sign | Unary::Not => 0.0,
        Unary::Sqrt => 0.5,
        Unary::Powi(n) => n.unsigned_abs() as f64,
        _ => 2.0,
    }
}

/// The error bound of an elementary function of two numbers, in units in the last place of the result.
#[must_use]
pub const fn error2(op: Binary) -> f64 {
    match op {
        Binary::Pow => 3.0,
        Binary::Atan2 => 2.0,
        Binary::Hypot => 1.3,
        _ => 0.5,
    }
}
