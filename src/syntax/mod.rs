//! From text to tree and back. The only room that knows the grammar; it does not know what a name means.

mod explain;
mod parse;
pub mod print;
pub mod scan;
mod split;
pub mod tree;

pub use parse::{Mode, Parsed, parse};
