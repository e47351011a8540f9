//! Stars: shapes that each ray from a centre leaves once, known by their gauge F, a function of the direction with the boundary at
//! `c + v / F(v)`. Proves that a gauge holds in every direction, makes meshes of guide shapes, and measures. Never looks for a boundary.

pub mod folded;
pub mod guide;
mod kept;
pub mod measure;
pub mod mesh;
pub mod prove;

use std::sync::Arc;

use crate::vm::Program;

pub use prove::{Doubt, Fault, Proof, prove};

/// A shape as a gauge about a centre. The programs' first inputs are the components of a direction, the others take the fixed values.
#[derive(Clone, Debug)]
pub struct Gauge {
    /// The centre: one number for each axis.
    pub centre: Vec<f64>,
    /// F, of degree 1 in the direction.
    pub gauge: Arc<Program>,
    /// What must be positive in every direction, if anything.
    pub positive: Option<Arc<Program>>,
    /// What must not be negative in any direction, if anything, for a ray to leave the shape only once.
    pub single: Option<Arc<Program>>,
    /// What must be finite in every direction, if anything.
    pub finite: Option<Arc<Program>>,
    /// One value for each input that is no component of the direction.
    pub fixed: Vec<f64>,
    /// The gauge as a fold of many operands, if it is one and results of earlier work are kept.
    pub parts: Option<Arc<folded::Parts>>,
}
