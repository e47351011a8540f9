//! Questions about objects that are answered by search: is there a point that meets some conditions, which point of an object is nearest,
//! where do two boundaries meet. Knows no language; measures are elsewhere ([`super::measure()`]).
//!
//! [`decide`] splits space by branch and bound, best box first. A box goes when intervals show that one condition fails all over it, or that
//! two of them cannot hold together: `a f + b g < 0` over the box for some weights a, b >= 0. Such sums are bounded by the values at the middle and
//! the ranges of the derivatives, whose errors fall with the square of the box: surfaces that nearly touch take few boxes then, where
//! plain intervals would have to fill the gap between them.

mod climb;
mod conditions;
mod crossing;
mod decide;
mod linear;
mod nearest;

pub use conditions::Conditions;
pub use crossing::{CurveError, crossings, curves};
pub use decide::decide;
pub use nearest::{Nearest, NearestError, farthest, nearest};

/// What became of the question whether some point meets all conditions.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// None does, as far as the space goes.
    Never,
    /// This one does.
    At(Vec<f64>),
    /// It could not be decided.
    Open(Near),
}

/// How near an undecided question came.
#[derive(Clone, Debug, PartialEq)]
pub struct Near {
    /// The point that comes nearest to meeting all conditions.
    pub place: Vec<f64>,
    /// By how much it fails them at most, in lengths: the value over the slope.
    pub distance: f64,
    /// Whether all boxes that were allowed are used up; else the boxes left are as small as numbers allow.
    pub is_spent: bool,
}
