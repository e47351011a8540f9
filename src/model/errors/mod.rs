//! The messages of this room: what was found in the user's words, and what to do. Computes nothing.

mod names;
mod questions;
mod star;
mod values;

pub use names::*;
pub use questions::*;
pub use star::*;
pub use values::*;

/// `n things`, `1 thing`.
fn count(n: usize, thing: &str) -> String {
    if n == 1 { format!("1 {thing}") } else { format!("{n} {thing}s") }
}
