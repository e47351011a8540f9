//! The messages of this room: what was found in the user's words, and what to do. Computes nothing.

mod names;
mod star;
mod values;

pub use names::*;
pub use star::*;
pub use values::*;

/// `n things`, `1 thing`.
fn count(n: usize, thing: &str) -> String {
    if n == 1 { format!("1 {thing}") } else { format!("{n} {thing}s") }
}
