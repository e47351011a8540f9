//! Functions of angles in radians. Never degrees: `RAD` and `DEG` convert.

use super::table::Meaning::{Binary as Two, Formula, Unary as One};
use super::table::Term::{self, Argument, Number};
use super::table::{Builtin, Subject};
use crate::number::{Binary, Unary};

const A: Term = Argument(0);

const fn entry(
    name: &'static str,
    parameters: &'static [&'static str],
    doc: &'static str,
    example: (&'static str, f64),
    meaning: super::table::Meaning,
) -> Builtin {
    Builtin { name, aliases: &[], subject: Subject::Trigonometry, parameters, doc, example, meaning }
}

/// Sine and its like.
pub(super) static TABLE: &[Builtin] = &[
    entry("SIN", &["a"], "The sine of an angle in radians.", ("SIN(PI/6)", 0.5), One(Unary::Sin)),
    entry("COS", &["a"], "The cosine of an angle in radians.", ("COS(PI/3)", 0.5), One(Unary::Cos)),
    entry("TAN", &["a"], "The tangent of an angle in radians.", ("TAN(PI/4)", 1.0), One(Unary::Tan)),
    entry(
        "SEC",
        &["a"],
        "The secant, 1/COS(a).",
        ("SEC(0)", 1.0),
        Formula(&Term::Two(Binary::Div, &Number(1.0), &Term::One(Unary::Cos, &A))),
    ),
    entry(
        "CSC",
        &["a"],
        "The cosecant, 1/SIN(a).",
        ("CSC(PI/2)", 1.0),
        Formula(&Term::Two(Binary::Div, &Number(1.0), &Term::One(Unary::Sin, &A))),
    ),
    entry(
        "COT",
        &["a"],
        "The cotangent, COS(a)/SIN(a).",
        ("COT(PI/4)", 1.0),
        Formula(&Term::Two(Binary::Div, &Term::One(Unary::Cos, &A), &Term::One(Unary::Sin, &A))),
    ),
    Builtin {
        aliases: &["ARCSIN"],
        ..entry(
            "ASIN",
            &["a"],
            "The angle from -PI/2 to PI/2 whose sine is a; undefined outside [-1, 1].",
            ("ASIN(1)", std::f64::consts::FRAC_PI_2),
            One(Unary::Asin),
        )
    },
    Builtin {
        aliases: &["ARCCOS"],
        ..entry(
            "ACOS",
            &["a"],
            "The angle from 0 to PI whose cosine is a; undefined outside [-1, 1].",
            ("ACOS(-1)", std::f64::consts::PI),
            One(Unary::Acos),
        )
    },
    Builtin {
        aliases: &["ARCTAN"],
        ..entry(
            "ATAN",
            &["a"],
            "The angle from -PI/2 to PI/2 whose tangent is a.",
            ("ATAN(1)", std::f64::consts::FRAC_PI_4),
            One(Unary::Atan),
        )
    },
    entry(
        "ATAN2",
        &["y", "x"],
        "The angle of the point (x, y) from the positive x axis, from -PI to PI.",
        ("ATAN2(1, -1)", 0.75 * std::f64::consts::PI),
        Two(Binary::Atan2),
    ),
];
