//! From text to tree and back. The only room that knows the grammar; it does not know what a name means.

pub mod tree;
