//! The function itself as values at given points.

use crate::diagnostic::Diagnostic;
use crate::field::{Coordinate, Graph};
use crate::interrupt::{Cancelled, Interrupt};
use crate::limits::Limits;
use crate::vm::block::Points;
use crate::vm::gradient::Gradients;
use crate::vm::{Demand, Program};

use super::subject::Subject;

/// Points evaluated together.
const BATCH: usize = 4096;

/// A value at a point.
#[derive(Clone, Debug, PartialEq)]
pub struct Sampled {
    /// The value; NaN where the function is undefined.
    pub value: f64,
    /// Its derivative by each coordinate, if it was asked for.
    pub slope: Vec<f64>,
}

/// The values of a subject's function at points given as x1, x2, ...; coordinates that a point leaves out take the subject's fixed values.
///
/// # Errors
/// [`Cancelled`] inside the outer result; a diagnostic if the program is too large.
pub fn at_points(
    subject: &Subject,
    graph: &Graph,
    points: &[Vec<f64>],
    gradient: bool,
    limits: &Limits,
    interrupt: &Interrupt,
) -> Result<Result<Vec<Sampled>, Cancelled>, Diagnostic> {
    let used: Vec<Coordinate> = graph.coordinates(subject.node).iter().collect();
    let width = points.first().map_or(0, Vec::len);
    let program = Program::compile(graph, subject.node, &used, Demand::Value, limits)
        .map_err(|e| Diagnostic::error("too-large", e.to_string()))?;
    let mut work = Sampling::new(&program, &used, width.max(used.last().map_or(0, |c| usize::from(c.0))));
    let mut all = Vec::with_capacity(points.len());
    for batch in points.chunks(BATCH) {
        if interrupt.tick().is_err() {
            return Ok(Err(Cancelled));
        }
        work.batch(subject, batch, gradient, &mut all);
    }
    Ok(Ok(all))
}

struct Sampling<'a> {
    program: &'a Program,
    used: &'a [Coordinate],
    dimension: usize,
    points: Points<f64>,
    gradients: Gradients,
    columns: Vec<Vec<f64>>,
}

impl<'a> Sampling<'a> {
    fn new(program: &'a Program, used: &'a [Coordinate], dimension: usize) -> Self {
        let columns = vec![Vec::new(); used.len()];
        Self { program, used, dimension, points: Points::new(), gradients: Gradients::new(), columns }
    }

    fn batch(&mut self, subject: &Subject, batch: &[Vec<f64>], gradient: bool, all: &mut Vec<Sampled>) {
        for (column, c) in self.columns.iter_mut().zip(self.used) {
            let fixed = subject.fixed.iter().find(|f| f.0 == *c).map_or(f64::NAN, |f| f.1);
            column.clear();
            column.extend(batch.iter().map(|p| p.get(usize::from(c.0) - 1).copied().unwrap_or(fixed)));
        }
        let columns: Vec<&[f64]> = self.columns.iter().map(Vec::as_slice).collect();
        let mut values = vec![0.0; batch.len()];
        self.points.eval(self.program, &columns, &mut values);
        let first = all.len();
        all.extend(values.iter().map(|&value| Sampled { value, slope: Vec::new() }));
        if gradient {
            let dimension = self.dimension;
            all[first..].iter_mut().for_each(|sampled| sampled.slope = vec![0.0; dimension]);
            for inputs in (0..self.used.len()).collect::<Vec<_>>().chunks(3) {
                let mut slopes = vec![vec![0.0; batch.len()]; inputs.len()];
                let mut targets: Vec<&mut [f64]> = slopes.iter_mut().map(Vec::as_mut_slice).collect();
                self.gradients.eval(self.program, &columns, inputs, &mut values, &mut targets);
                for (&input, slope) in inputs.iter().zip(&slopes) {
                    let place = usize::from(self.used[input].0) - 1;
                    for (sampled, s) in all[first..].iter_mut().zip(slope) {
                        sampled.slope[place] = *s;
                    }
                }
            }
        }
    }
}
