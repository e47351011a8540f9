//! A program seen as an object of a space: which inputs are axes, and what the others are fixed at. Computes nothing.

use std::sync::Arc;

use super::program::Program;
use crate::reuse::Digest;

/// What surfaces and pictures take: an object in a space of `dimension` axes.
#[derive(Clone, Debug)]
pub struct Shape {
    /// Its first `dimension` inputs are the axes of the space.
    pub program: Arc<Program>,
    /// Number of axes.
    pub dimension: usize,
    /// One value for each remaining input (time and so on).
    pub fixed: Vec<f64>,
    /// The numbers that its values at points are computed with.
    pub precision: Precision,
}

/// The numbers that values at points are computed with. Bounds of boxes and slopes are always doubles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Precision {
    /// Decides what a user sees.
    #[default]
    Double,
    /// For previews: about seven digits.
    Single,
}

impl Shape {
    /// An object of the space of the program's first `dimension` inputs, the rest fixed.
    #[must_use]
    pub fn new(program: Program, dimension: usize, fixed: Vec<f64>) -> Self {
        debug_assert_eq!(program.inputs().len(), dimension + fixed.len());
        Self { program: Arc::new(program), dimension, fixed, precision: Precision::Double }
    }

    /// Tells all that its values depend on.
    pub fn tell(&self, to: &mut Digest) {
        to.shown(&(self.dimension, self.precision));
        self.program.tell(&self.fixed, to);
    }
}
