//! A function sampled on a grid, as volume files hold it: samples at the corners of the space and at equal steps between. Writes no files.

use rayon::prelude::*;

use crate::interrupt::{Cancelled, Interrupt};
use crate::surface::sampler::{Counters, Sampler};
use crate::vm::Shape;

/// Samples of a function of one to three coordinates, x1 fastest.
#[derive(Clone, Debug)]
pub struct Field {
    /// Samples along each axis.
    pub size: Vec<usize>,
    /// The coordinates of the first sample.
    pub origin: Vec<f64>,
    /// The distance of neighbours along each axis.
    pub spacing: Vec<f64>,
    /// The samples, rounded to single precision.
    pub samples: Vec<f32>,
    /// What it cost.
    pub counters: Counters,
}

/// Samples a shape (of [`crate::vm::Demand::Value`]) over `space`, one pair of bounds for each axis: `cells` steps along the longest side,
/// and the nearest number of equally long steps, at least one, along the others.
///
/// # Errors
/// [`Cancelled`] soon after the interrupt was set.
///
/// # Panics
/// If the shape has no axis, more than three, or another number of them than `space`.
pub fn sample(shape: &Shape, space: &[(f64, f64)], cells: usize, interrupt: &Interrupt) -> Result<Field, Cancelled> {
    assert!(space.len() == shape.dimension && (1..=3).contains(&space.len()), "one pair of bounds for each axis");
    let (size, spacing) = steps(space, cells);
    let along = |axis: usize| -> Vec<f64> {
        let Some(&(lo, hi)) = space.get(axis) else { return vec![0.0] };
        let at = |i: usize| if i + 1 == size[axis] { hi } else { lo + spacing[axis] * i as f64 };
        (0..size[axis]).map(at).collect()
    };
    let [xs, ys, zs] = [along(0), along(1), along(2)];
    let mut samples = vec![0.0; xs.len() * ys.len() * zs.len()];
    interrupt.begin(samples.len() as u64);
    let rows: Vec<Counters> = samples
        .par_chunks_mut(xs.len())
        .enumerate()
        .map_init(
            || {
                (
                    Sampler::new(shape).heeding(interrupt),
                    [vec![0.0; xs.len()], vec![0.0; xs.len()]],
                    vec![0.0; xs.len()],
                )
            },
            |(sampler, [y, z], values), (row, out)| {
                interrupt.tick()?;
                y.fill(ys[row % ys.len()]);
                z.fill(zs[row / ys.len()]);
                sampler.values(&shape.program, &[&xs[..], y, z][..space.len()], values);
                out.iter_mut().zip(values).for_each(|(out, value)| *out = *value as f32);
                interrupt.advance(out.len() as u64);
                Ok(sampler.take_counters())
            },
        )
        .collect::<Result<_, Cancelled>>()?;
    interrupt.tick()?;
    let mut counters = Counters::default();
    rows.into_iter().for_each(|row| counters.add(row));
    Ok(Field { size, origin: space.iter().map(|&(lo, _)| lo).collect(), spacing, samples, counters })
}

/// Samples and their distance along each axis.
#[must_use]
pub fn steps(space: &[(f64, f64)], cells: usize) -> (Vec<usize>, Vec<f64>) {
    let longest = space.iter().fold(0.0_f64, |longest, (lo, hi)| longest.max(hi - lo));
    let count = |&(lo, hi): &(f64, f64)| ((hi - lo) / longest * cells.max(1) as f64).round().max(1.0) as usize;
    let counts: Vec<usize> = space.iter().map(count).collect();
    let spacing = space.iter().zip(&counts).map(|((lo, hi), &n)| (hi - lo) / n as f64).collect();
    (counts.iter().map(|n| n + 1).collect(), spacing)
}
