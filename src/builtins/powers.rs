//! Exponentials, logarithms, powers and roots.

use super::table::Meaning::{self, Binary as Two, Fold, Formula, Unary as One};
use super::table::Term::{self, Argument, Number};
use super::table::{Builtin, Subject};
use crate::number::{Binary, Unary};

const A: Term = Argument(0);

const fn entry(
    name: &'static str,
    parameters: &'static [&'static str],
    doc: &'static str,
    example: (&'static str, f64),
    meaning: Meaning,
) -> Builtin {
    Builtin { name, aliases: &[], subject: Subject::Powers, parameters, doc, example, meaning }
}

/// Powers and logarithms.
pub(super) static TABLE: &[Builtin] = &[
    entry("EXP", &["a"], "e to the power a.", ("EXP(1)", std::f64::consts::E), One(Unary::Exp)),
    Builtin {
        aliases: &["LN"],
        ..entry(
            "LOG",
            &["a"],
            "The natural logarithm; undefined for a < 0, -infinity at 0.",
            ("LOG(2)", std::f64::consts::LN_2),
            One(Unary::Log),
        )
    },
    entry("LOG10", &["a"], "The logarithm to base 10.", ("LOG10(1000)", 3.0), One(Unary::Log10)),
    entry(
        "LOG2",
        &["a"],
        "The logarithm to base 2.",
        ("LOG2(8)", 3.0),
        Formula(&Term::Two(Binary::Div, &Term::One(Unary::Log, &A), &Number(std::f64::consts::LN_2))),
    ),
    entry(
        "POW",
        &["a", "b"],
        "a to the power b, as a**b; undefined for a < 0 where b is not whole.",
        ("POW(2, 0.5)", std::f64::consts::SQRT_2),
        Two(Binary::Pow),
    ),
    entry("SQRT", &["a"], "The square root; undefined for a < 0.", ("SQRT(9)", 3.0), One(Unary::Sqrt)),
    entry("CBRT", &["a"], "The cube root, of negative numbers too.", ("CBRT(-27)", -3.0), One(Unary::Cbrt)),
    entry("SQR", &["a"], "The square, a**2.", ("SQR(-3)", 9.0), Formula(&Term::One(Unary::Powi(2), &A))),
    entry(
        "HYPOT",
        &["a", "b", "..."],
        "The square root of the sum of squares, without overflow.",
        ("HYPOT(2, 3, 6)", 7.0),
        Fold(Binary::Hypot),
    ),
];
