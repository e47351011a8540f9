//! Looks for a point that meets conditions by going uphill from a point nearby: in each step the linear forms of all conditions say where, within a
//! radius, the least of them is highest. Proves nothing.

use super::Conditions;
use crate::interrupt::{Cancelled, Interrupt};
use crate::vm::Gradients;

/// Steps of a climb.
const STEPS: usize = 80;
/// A climb ends where what is missing is so many times what the radius may bring.
const HOPELESS: f64 = 20.0;
/// Turns in which the weights of the conditions are found; the direction need not be the best.
const TURNS: usize = 30;

/// The conditions at a point: values that must not be negative, and their slopes.
pub(super) struct Tangents {
    pub(super) values: Vec<f64>,
    pub(super) slopes: Vec<Vec<f64>>,
    /// Whether all conditions are met there.
    pub(super) met: bool,
}

impl Tangents {
    /// The least value; a part of a huge negative number if a function is undefined.
    fn least(&self) -> f64 {
        self.values.iter().copied().fold(f64::INFINITY, f64::min)
    }

    /// By how much the conditions fail at most, in lengths.
    pub(super) fn distance(&self) -> f64 {
        let each = self.values.iter().zip(&self.slopes).filter(|(value, _)| **value <= 0.0);
        each.map(|(value, slope)| -value / norm(slope)).fold(0.0, f64::max)
    }
}

pub(super) fn norm(v: &[f64]) -> f64 {
    v.iter().map(|c| c * c).sum::<f64>().sqrt()
}

/// The conditions at a point.
pub(super) fn tangents(conditions: &Conditions, point: &[f64], gradients: &mut Gradients) -> Tangents {
    let columns: Vec<[f64; 1]> = point.iter().map(|&c| [c]).collect();
    let slices: Vec<&[f64]> = columns.iter().map(<[f64; 1]>::as_slice).collect();
    let by: Vec<usize> = (0..point.len()).collect();
    let mut tangents = Tangents { values: Vec::new(), slopes: Vec::new(), met: true };
    for condition in &conditions.all {
        let mut value = [0.0];
        let mut store = vec![[0.0]; point.len()];
        let mut slopes: Vec<&mut [f64]> = store.iter_mut().map(<[f64; 1]>::as_mut_slice).collect();
        gradients.eval(&condition.value, &slices, &by, &mut value, &mut slopes);
        let [value] = value;
        let sign = if condition.outside { -1.0 } else { 1.0 };
        let inside = value >= 0.0;
        tangents.met &= inside != condition.outside;
        tangents.values.push(match value.is_nan() {
            false => sign * value,
            true if condition.outside => f64::INFINITY,
            true => f64::NEG_INFINITY,
        });
        let finite = |s: f64| if s.is_finite() { sign * s } else { 0.0 };
        tangents.slopes.push(store.iter().map(|[s]| finite(*s)).collect());
    }
    tangents
}

/// Goes uphill from a point within a space. The best point, and how the conditions stand there.
pub(super) fn climb(
    conditions: &Conditions,
    from: &[f64],
    radius: f64,
    space: &[[f64; 2]],
    (gradients, interrupt): (&mut Gradients, &Interrupt),
) -> Result<(Vec<f64>, Tangents), Cancelled> {
    let mut point = from.to_vec();
    let mut here = tangents(conditions, &point, gradients);
    let mut radius = radius;
    let size = point.iter().fold(radius, |most, c| most.max(c.abs()));
    for _ in 0..STEPS {
        interrupt.tick()?;
        if here.met || radius < 1e-17 * size || here.least() == f64::NEG_INFINITY {
            break;
        }
        // Within the radius the linear forms come nowhere near: this is a summit below the water.
        let steepest = here.slopes.iter().map(|slope| norm(slope)).fold(0.0, f64::max);
        if -here.least() > HOPELESS * radius * steepest {
            break;
        }
        let Some(way) = uphill(&here, radius) else { break };
        let step = |((c, d), [lo, hi]): ((&f64, &f64), &[f64; 2])| (c + radius * d).clamp(*lo, *hi);
        let next: Vec<f64> = point.iter().zip(&way).zip(space).map(step).collect();
        let there = tangents(conditions, &next, gradients);
        if there.met || there.least() > here.least() {
            (point, here) = (next, there);
            radius *= 1.5;
        } else {
            radius *= 0.4;
        }
    }
    Ok((point, here))
}

/// The direction in which, within a radius, the least of the linear forms is highest: that of the sum of the slopes by the weights for which
/// `sum of w f + radius |sum of w g|` is least (Frank and Wolfe's method).
fn uphill(here: &Tangents, radius: f64) -> Option<Vec<f64>> {
    let lowest = |score: &dyn Fn(usize) -> f64| (0..here.values.len()).min_by(|&a, &b| score(a).total_cmp(&score(b)));
    let first = lowest(&|i| here.values[i])?;
    let mut sum = here.slopes[first].clone();
    for turn in 0..TURNS {
        let length = norm(&sum);
        if length == 0.0 {
            return None;
        }
        let along = |i: usize| here.slopes[i].iter().zip(&sum).map(|(g, s)| g * s).sum::<f64>() / length;
        let next = lowest(&|i| here.values[i] + radius * along(i))?;
        let share = 2.0 / (turn as f64 + 2.0);
        // The first turn would forget where it began.
        let share = if turn == 0 { 0.5 } else { share };
        for (s, g) in sum.iter_mut().zip(&here.slopes[next]) {
            *s += share * (g - *s);
        }
    }
    let length = norm(&sum);
    (length > 0.0 && length.is_finite()).then(|| sum.iter().map(|s| s / length).collect())
}
