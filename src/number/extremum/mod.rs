//! Where a function is highest: over a section by branch and bound with intervals and the roots of its derivative, over a ball by a
//! pattern search from many starts. The one meaning that every evaluator gives to PROJECT and OFFSET_BALL. Knows no expressions: it asks for
//! values, derivatives and ranges through a trait, many at a time.

pub mod ball;
pub mod section;

/// Questions asked at once, at most.
pub const AT_ONCE: usize = 64;
