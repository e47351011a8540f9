//! The one table of built-in functions: name, signature, doc, example and meaning of each. Completion, help, arity errors and the
//! manual are derived from it. Never computes by itself: a meaning is written over the primitives of `number`, once for all
//! kinds of number. Operators (`+`, `|`, `**` ...) are no entries.

mod angles;
mod choices;
mod forms;
mod powers;
mod questions;
mod table;
mod waves;

pub use forms::FILES;
pub use questions::{Measure, Question};
pub use table::{Arity, Builtin, Special, Subject, Term};
pub use table::{Meaning, WrongCount};

/// All built-ins, by subject and within it in reading order.
pub static TABLE: &[&[Builtin]] =
    &[waves::TABLE, angles::TABLE, powers::TABLE, choices::TABLE, forms::TABLE, questions::TABLE];

/// All built-ins in the table's order.
pub fn all() -> impl Iterator<Item = &'static Builtin> {
    TABLE.iter().copied().flatten()
}

/// The built-in of that name or alias, in any case.
#[must_use]
pub fn find(name: &str) -> Option<&'static Builtin> {
    all().find(|entry| entry.names().any(|known| known.eq_ignore_ascii_case(name)))
}
