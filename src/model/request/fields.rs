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

/// A function that is asked for its values, batch by batch.
pub struct Sampling {
    program: Program,
    /// The coordinates that the function uses, and the value of each that points leave out.
    used: Vec<(Coordinate, f64)>,
    /// Derivatives of each value, 0 if none are wanted.
    slopes: usize,
    points: Points<f64>,
    singles: Option<Points<f32>>,
    gradients: Gradients,
    columns: Vec<Vec<f64>>,
}

impl Sampling {
    /// Of a subject's function, at points given as x1, x2, ... of that many numbers; coordinates that a point leaves out take the
    /// subject's fixed values. With derivatives if wanted, by each number of a point and each coordinate that is used; the values in
    /// single precision if wanted.
    ///
    /// # Errors
    /// If the program is too large.
    pub(super) fn new(
        subject: &Subject,
        graph: &Graph,
        (width, gradient, single): (usize, bool, bool),
        (limits, interrupt): (&Limits, &Interrupt),
    ) -> Result<Self, Diagnostic> {
        let used: Vec<Coordinate> = graph.coordinates(subject.node).iter().collect();
        let program = Program::compile(graph, subject.node, &used, Demand::Value, limits)
            .map_err(|e| Diagnostic::error("too-large", e.to_string()))?;
        let fixed = |c: Coordinate| subject.fixed.iter().find(|f| f.0 == c).map_or(f64::NAN, |f| f.1);
        let most = used.last().map_or(0, |c| usize::from(c.0)).max(width);
        Ok(Self {
            program,
            slopes: if gradient { most } else { 0 },
            columns: vec![Vec::new(); used.len()],
            used: used.into_iter().map(|c| (c, fixed(c))).collect(),
            points: Points::heeding(interrupt),
            singles: single.then(|| Points::heeding(interrupt)),
            gradients: Gradients::heeding(interrupt),
        })
    }

    /// The values at points.
    ///
    /// # Errors
    /// [`Cancelled`] soon after the interrupt was set.
    pub fn values(&mut self, points: &[Vec<f64>], interrupt: &Interrupt) -> Result<Vec<Sampled>, Cancelled> {
        let mut all = Vec::with_capacity(points.len());
        for batch in points.chunks(BATCH) {
            interrupt.tick()?;
            self.batch(batch, &mut all);
        }
        interrupt.tick()?;
        Ok(all)
    }

    fn batch(&mut self, batch: &[Vec<f64>], all: &mut Vec<Sampled>) {
        for (column, (c, fixed)) in self.columns.iter_mut().zip(&self.used) {
            column.clear();
            column.extend(batch.iter().map(|p| p.get(usize::from(c.0) - 1).copied().unwrap_or(*fixed)));
        }
        let columns: Vec<&[f64]> = self.columns.iter().map(Vec::as_slice).collect();
        let mut values = vec![0.0; batch.len()];
        match &mut self.singles {
            Some(points) => {
                let singles: Vec<Vec<f32>> =
                    columns.iter().map(|column| column.iter().map(|&c| c as f32).collect()).collect();
                let slices: Vec<&[f32]> = singles.iter().map(Vec::as_slice).collect();
                let mut rough = vec![0.0; batch.len()];
                points.eval(&self.program, &slices, &mut rough);
                values.iter_mut().zip(rough).for_each(|(value, rough)| *value = f64::from(rough));
            }
            None => self.points.eval(&self.program, &columns, &mut values),
        }
        let first = all.len();
        all.extend(values.iter().map(|&value| Sampled { value, slope: vec![0.0; self.slopes] }));
        if self.slopes == 0 {
            return;
        }
        for inputs in (0..self.used.len()).collect::<Vec<_>>().chunks(3) {
            let mut slopes = vec![vec![0.0; batch.len()]; inputs.len()];
            let mut targets: Vec<&mut [f64]> = slopes.iter_mut().map(Vec::as_mut_slice).collect();
            self.gradients.eval(&self.program, &columns, inputs, &mut values, &mut targets);
            for (&input, slope) in inputs.iter().zip(&slopes) {
                let place = usize::from(self.used[input].0.0) - 1;
                for (sampled, s) in all[first..].iter_mut().zip(slope) {
                    sampled.slope[place] = *s;
                }
            }
        }
    }
}
