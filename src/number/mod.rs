//! Numbers of all kinds: reals, intervals rounded outward, duals, blocks of points. One meaning, many numbers.

pub mod dual;
pub mod extremum;
pub mod fit;
pub mod float;
pub mod functions;
pub mod interval;
pub mod leaf;
pub mod norm;
pub mod op;
pub mod polynomial;
pub mod rank;
pub mod real;
pub mod rfunction;
pub mod star;
pub mod turns;

pub use dual::{Dual, Duals};
pub use float::Float;
pub use interval::{Interval, Intervals};
pub use leaf::Leaf;
pub use op::{Binary, Real, Ternary, Unary};
pub use real::Reals;

/// What a kind of number (or a builder of expressions) must be able to do for a built-in to be written once over it.
///
/// `self` is the context: nothing for plain numbers, the graph for symbolic ones.
pub trait Algebra {
    /// One number of this kind.
    type Number: Clone;

    /// The number `value`.
    fn constant(&mut self, value: f64) -> Self::Number;
    /// A primitive of one operand.
    fn unary(&mut self, op: Unary, a: Self::Number) -> Self::Number;
    /// A primitive of two operands.
    fn binary(&mut self, op: Binary, a: Self::Number, b: Self::Number) -> Self::Number;
    /// A primitive of three operands.
    fn ternary(&mut self, op: Ternary, a: Self::Number, b: Self::Number, c: Self::Number) -> Self::Number;
}
