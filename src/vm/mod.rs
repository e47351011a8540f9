//! Expressions compiled to flat programs, and what evaluates them: blocks of points, gradients, intervals of boxes. Knows neither
//! language nor files.

pub mod along;
pub mod block;
mod choice;
pub mod compile;
mod fingerprint;
pub mod gradient;
pub mod interval;
mod kernels;
mod lattice;
pub mod pieces;
pub mod program;
pub mod reference;
pub mod region;
pub mod shape;
mod slots;
pub mod specialise;

pub use block::Points;
pub use compile::CompileError;
pub use gradient::Gradients;
pub use interval::Boxes;
pub use pieces::Pieces;
pub use program::{Demand, Program};
pub use shape::{Precision, Shape};
