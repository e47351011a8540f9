//! Questions about objects, whose answers are numbers and arrays: do they meet, how large are they, what is nearest. The interpreter asks
//! them; here they are only described.

use super::table::{Arity, Builtin, Meaning, Special, Subject};

/// What is asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Question {
    /// `INTERSECTS(g1, g2)`
    Intersects,
    /// `INCLUDES(g1, g2)`
    Includes,
    /// `WITNESS(g1, g2)`
    Witness,
}

impl Question {
    /// How many arguments it takes.
    #[must_use]
    pub fn arity(self) -> Arity {
        match self {
            Self::Intersects | Self::Includes => Arity::Exactly(2),
            Self::Witness => Arity::Between(1, 2),
        }
    }
}

const fn entry(
    question: Question,
    name: &'static str,
    parameters: &'static [&'static str],
    doc: &'static str,
    example: (&'static str, f64),
) -> Builtin {
    let meaning = Meaning::Special(Special::Question(question));
    Builtin { name, aliases: &[], subject: Subject::Questions, parameters, doc, example, meaning }
}

/// The questions.
pub(super) static TABLE: &[Builtin] = &[
    entry(
        Question::Intersects,
        "INTERSECTS",
        &["g1", "g2"],
        "1 if some point belongs to both objects, 0 if it is proved that none does. Boundaries belong to objects. An error says if it cannot be \
         decided: of objects that only touch, mostly.",
        ("INTERSECTS(1 - x1**2 - x2**2, 1 - (x1 - 2.000001)**2 - x2**2)", 0.0),
    ),
    entry(
        Question::Includes,
        "INCLUDES",
        &["g1", "g2"],
        "1 if it is proved that every point of g2 belongs to g1, 0 if some point does not. An error says if it cannot be decided.",
        ("INCLUDES(4 - x1**2 - x2**2, 1 - (x1 - 0.9)**2 - x2**2)", 1.0),
    ),
    entry(
        Question::Witness,
        "WITNESS",
        &["g1", "g2"],
        "A point that belongs to both objects, or to the one object: the array of its coordinates, up to the highest that is used. An error if \
         there is none: INTERSECTS says so without one. WITNESS(g2, ~g1) shows where g1 does not include g2.",
        ("(1 - x1**2 - x2**2) AT (WITNESS(1 - x1**2 - x2**2, x1 - 0.9)) >= 0", 1.0),
    ),
];
