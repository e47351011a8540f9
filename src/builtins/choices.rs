//! Steps, choices, remainders and interpolation between numbers.

use super::table::Meaning::{self, Binary as Two, Fold, Formula, Unary as One};
use super::table::Term::{self, Argument, Number};
use super::table::{Builtin, Subject};
use crate::number::{Binary, Ternary, Unary};

const A: Term = Argument(0);
const B: Term = Argument(1);
const C: Term = Argument(2);

const MINUS_A: Term = Term::One(Unary::Neg, &A);
const MINUS_LO: Term = Term::One(Unary::Neg, &B);

/// Where c lies from a to b, as a number from 0 to 1. The maximum with 0 is written as a minimum, which stays undefined where
/// `c` is: MAX would take the 0.
const PART: Term = Term::Two(
    Binary::Min,
    &Term::One(
        Unary::Neg,
        &Term::Two(
            Binary::Min,
            &Term::Two(Binary::Div, &Term::Two(Binary::Sub, &A, &C), &Term::Two(Binary::Sub, &B, &A)),
            &Number(0.0),
        ),
    ),
    &Number(1.0),
);

const fn entry(
    name: &'static str,
    parameters: &'static [&'static str],
    doc: &'static str,
    example: (&'static str, f64),
    meaning: Meaning,
) -> Builtin {
    Builtin { name, aliases: &[], subject: Subject::Choices, parameters, doc, example, meaning }
}

/// Steps and choices.
pub(super) static TABLE: &[Builtin] = &[
    entry("ABS", &["a"], "The magnitude.", ("ABS(-2.5)", 2.5), One(Unary::Abs)),
    Builtin {
        aliases: &["SGN"],
        ..entry("SIGN", &["a"], "-1, 0 or 1 for a < 0, a = 0, a > 0.", ("SIGN(-7)", -1.0), One(Unary::Sign))
    },
    entry(
        "MIN",
        &["a", "b", "..."],
        "The smallest of its arguments, or of the elements of one array; undefined if one is.",
        ("MIN(3, 1, 2)", 1.0),
        Fold(Binary::Min),
    ),
    entry(
        "MAX",
        &["a", "b", "..."],
        "The largest of its arguments, or of the elements of one array; undefined ones do not count.",
        ("MAX(3, 1, 2)", 3.0),
        Fold(Binary::Max),
    ),
    entry("FLOOR", &["a"], "The largest whole number not above a.", ("FLOOR(-1.5)", -2.0), One(Unary::Floor)),
    entry("CEIL", &["a"], "The smallest whole number not below a.", ("CEIL(-1.5)", -1.0), One(Unary::Ceil)),
    entry("ROUND", &["a"], "The nearest whole number, halves away from zero.", ("ROUND(2.5)", 3.0), One(Unary::Round)),
    Builtin {
        aliases: &["INT"],
        ..entry(
            "TRUNC",
            &["a"],
            "The whole part, towards zero.",
            ("TRUNC(-1.5)", -1.0),
            Formula(&Term::Three(
                Ternary::Select,
                &Term::Two(Binary::Less, &A, &Number(0.0)),
                &Term::One(Unary::Ceil, &A),
                &Term::One(Unary::Floor, &A),
            )),
        )
    },
    entry(
        "FRAC",
        &["a"],
        "The fractional part, a - FLOOR(a).",
        ("FRAC(-1.25)", 0.75),
        Formula(&Term::Two(Binary::Mod, &A, &Number(1.0))),
    ),
    entry(
        "MOD",
        &["a", "b"],
        "The remainder a - b*FLOOR(a/b), with the sign of b.",
        ("MOD(-1, 3)", 2.0),
        Two(Binary::Mod),
    ),
    entry(
        "CLAMP",
        &["a", "lo", "hi"],
        "a, but not below lo and not above hi.",
        ("CLAMP(5, 0, 1)", 1.0),
        // Two minima, so that an undefined `a` stays undefined.
        Formula(&Term::Two(Binary::Min, &Term::One(Unary::Neg, &Term::Two(Binary::Min, &MINUS_A, &MINUS_LO)), &C)),
    ),
    Builtin {
        aliases: &["MIX"],
        ..entry(
            "LERP",
            &["a", "b", "t"],
            "From a (t = 0) to b (t = 1) along a line, a + (b - a)*t.",
            ("LERP(10, 20, 0.25)", 12.5),
            Formula(&Term::Two(Binary::Add, &A, &Term::Two(Binary::Mul, &Term::Two(Binary::Sub, &B, &A), &C))),
        )
    },
    entry(
        "HEAVISIDE",
        &["edge", "a"],
        "The step function: 0 for a < edge, 1 from there on.",
        ("HEAVISIDE(2, 3)", 1.0),
        Formula(&Term::Two(Binary::LessEqual, &A, &B)),
    ),
    entry(
        "SMOOTHSTEP",
        &["lo", "hi", "a"],
        "0 up to lo, 1 from hi on, and the cubic t**2*(3 - 2*t) between them.",
        ("SMOOTHSTEP(0, 2, 1)", 0.5),
        Formula(&Term::Two(
            Binary::Mul,
            &Term::One(Unary::Powi(2), &PART),
            &Term::Two(Binary::Sub, &Number(3.0), &Term::Two(Binary::Mul, &Number(2.0), &PART)),
        )),
    ),
];
