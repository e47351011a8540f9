//! Degrees to radians and back, and hyperbolic functions with their inverses.

use super::table::Meaning::{self, Formula, Unary as One};
use super::table::Term::{self, Argument, Number};
use super::table::{Builtin, Subject};
use crate::number::{Binary, Unary};

const A: Term = Argument(0);

const fn hyperbolic(
    name: &'static str,
    aliases: &'static [&'static str],
    doc: &'static str,
    example: (&'static str, f64),
    op: Unary,
) -> Builtin {
    let meaning: Meaning = One(op);
    Builtin { name, aliases, subject: Subject::Hyperbolic, parameters: &["a"], doc, example, meaning }
}

const fn conversion(
    name: &'static str,
    doc: &'static str,
    example: (&'static str, f64),
    term: &'static Term,
) -> Builtin {
    let subject = Subject::Trigonometry;
    Builtin { name, aliases: &[], subject, parameters: &["a"], doc, example, meaning: Formula(term) }
}

/// Conversions and hyperbolic functions.
pub(super) static TABLE: &[Builtin] = &[
    conversion(
        "RAD",
        "Degrees as radians, a*PI/180.",
        ("RAD(180)", std::f64::consts::PI),
        &Term::Two(Binary::Mul, &A, &Number(std::f64::consts::PI / 180.0)),
    ),
    conversion(
        "DEG",
        "Radians as degrees, a*180/PI.",
        ("DEG(PI/2)", 90.0),
        &Term::Two(Binary::Mul, &A, &Number(180.0 / std::f64::consts::PI)),
    ),
    hyperbolic(
        "SINH",
        &[],
        "The hyperbolic sine, (EXP(a) - EXP(-a))/2.",
        ("SINH(1)", 1.175_201_193_643_801_4),
        Unary::Sinh,
    ),
    hyperbolic(
        "COSH",
        &[],
        "The hyperbolic cosine, (EXP(a) + EXP(-a))/2.",
        ("COSH(1)", 1.543_080_634_815_243_7),
        Unary::Cosh,
    ),
    hyperbolic(
        "TANH",
        &[],
        "The hyperbolic tangent, SINH(a)/COSH(a).",
        ("TANH(1)", 0.761_594_155_955_764_9),
        Unary::Tanh,
    ),
    hyperbolic(
        "ASINH",
        &["ARSINH"],
        "The inverse hyperbolic sine, LOG(a + SQRT(a**2 + 1)).",
        ("ASINH(1)", 0.881_373_587_019_543),
        Unary::Asinh,
    ),
    hyperbolic(
        "ACOSH",
        &["ARCOSH"],
        "The inverse hyperbolic cosine, from 0 on; undefined for a < 1.",
        ("ACOSH(2)", 1.316_957_896_924_816_6),
        Unary::Acosh,
    ),
    hyperbolic(
        "ATANH",
        &["ARTANH"],
        "The inverse hyperbolic tangent; undefined outside [-1, 1].",
        ("ATANH(0.5)", 0.549_306_144_334_054_8),
        Unary::Atanh,
    ),
];
