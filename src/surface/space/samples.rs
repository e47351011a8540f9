//! Where intervals fail: the ends of an object guessed from points.

use std::sync::Arc;

use super::SAMPLES;
use super::search::{Search, width};
use crate::interrupt::Cancelled;

impl Search<'_> {
    /// Where intervals fail: points at all scales, then about what they found. Gives the directions in which it goes on, if it does.
    pub(super) fn guess(&mut self) -> Result<Option<Vec<(usize, bool)>>, Cancelled> {
        let ends = self.ends();
        let whole = self.outer.clone();
        let sought: Vec<usize> = self.sought.iter().map(|s| s.0).collect();
        for power in -8..=20 {
            let size = f64::from(power).exp2();
            let scaled: Vec<[f64; 2]> = (0..whole.len())
                .map(|axis| match sought.contains(&axis) {
                    true => [(-size).clamp(whole[axis][0], whole[axis][1]), size.clamp(whole[axis][0], whole[axis][1])],
                    false => whole[axis],
                })
                .collect();
            self.scatter(&scaled, SAMPLES)?;
        }
        let far = f64::from(1 << 18);
        let inner = self.inner.clone();
        let goes_on: Vec<(usize, bool)> = ends
            .iter()
            .copied()
            .filter(|&(axis, up)| inner.as_ref().is_some_and(|inner| inner[axis][usize::from(up)].abs() > far))
            .collect();
        if !goes_on.is_empty() {
            return Ok(Some(goes_on));
        }
        for _ in 0..3 {
            let Some(inner) = self.inner.clone() else { return Ok(None) };
            let wider = |axis: usize| {
                let room = 0.5 * width(inner[axis]);
                [(inner[axis][0] - room).max(whole[axis][0]), (inner[axis][1] + room).min(whole[axis][1])]
            };
            let around: Vec<[f64; 2]> = (0..whole.len()).map(wider).collect();
            self.scatter(&around, 8 * SAMPLES)?;
        }
        let Some(inner) = &self.inner else { return Ok(None) };
        // What lies between the outermost points and the end of the object is not known: room for some of it.
        for (axis, up) in ends {
            let room = width(inner[axis]) / 8.0;
            let side = &mut self.outer[axis][usize::from(up)];
            *side = if up { side.min(inner[axis][1] + room) } else { side.max(inner[axis][0] - room) };
        }
        Ok(None)
    }

    /// Evaluates points spread evenly over a box, always the same ones.
    pub(super) fn scatter(&mut self, sides: &[[f64; 2]], count: usize) -> Result<(), Cancelled> {
        self.interrupt.tick()?;
        // Steps of the golden ratio's relatives fill a box of any dimension evenly (Roberts 2018).
        let root = (0..64).fold(2.0, |root: f64, _| (1.0 + root).powf(1.0 / (sides.len() as f64 + 1.0)));
        let columns: Vec<Vec<f64>> = sides
            .iter()
            .zip(1..)
            .map(|([lo, hi], power)| {
                let step = root.powi(-power);
                (0..count).map(|i| lo + (hi - lo) * (0.5 + step * (i + 1) as f64).fract()).collect()
            })
            .collect();
        let slices: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
        let mut values = vec![0.0; count];
        let program = Arc::clone(&self.program);
        self.points.eval(&program, &slices, &mut values);
        self.interrupt.tick()?;
        self.spent += count as u64 * program.len() as u64;
        for (i, &value) in values.iter().enumerate() {
            if value >= 0.0 || self.best.as_ref().is_none_or(|(best, _)| value > *best) {
                let point: Vec<f64> = columns.iter().map(|column| column[i]).collect();
                self.learn(value, &point);
            }
        }
        Ok(())
    }
}
