//! Proves by intervals, over all directions, that a gauge is positive, finite and defined, and that the centre lies inside; or finds a
//! direction in which it is not so. Says yes only with a proof.

use super::Gauge;
use crate::interrupt::{Cancelled, Interrupt};
use crate::number::Interval;
use crate::vm::interval::LANES;
use crate::vm::{Boxes, Points, Program};

/// Operations on boxes that a proof may take.
const OPERATIONS: usize = 40_000_000;
/// Boxes of directions that a proof may look at, however short the programs.
const BOXES: usize = 400_000;
/// Halvings of a side of the square of directions.
const DEPTH: u32 = 14;

/// What the gauge is, over all directions on the surface of the cube from -1 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Proof {
    /// Not above the smallest value.
    pub least: f64,
    /// Not below the largest.
    pub largest: f64,
}

/// Why a gauge holds not.
#[derive(Clone, Debug, PartialEq)]
pub struct Doubt {
    /// What is wrong.
    pub fault: Fault,
    /// A direction in which it is.
    pub direction: Vec<f64>,
}

/// What may be wrong with a gauge in a direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// The ray never leaves the shape.
    Endless,
    /// The centre lies outside, or on the boundary.
    Outside,
    /// The ray may leave the shape more than once.
    Several,
    /// A part is undefined or infinite.
    Undefined,
    /// Intervals cannot decide near that direction.
    Undecided,
}

/// Proves that the gauge holds in every direction of the plane or of space.
///
/// # Errors
/// The outer one if the work was stopped; the inner one is a direction in which it does not hold, or where intervals cannot tell.
pub fn prove(gauge: &Gauge, interrupt: &Interrupt) -> Result<Result<Proof, Doubt>, Cancelled> {
    let n = gauge.centre.len();
    let mut prover = Prover { gauge, boxes: Boxes::new(), points: Points::new() };
    let mut open: Vec<Patch> = Vec::new();
    for axis in (0..n).rev() {
        for side in [-1.0, 1.0] {
            let mut ranges = vec![Interval::new(-1.0, 1.0); n];
            ranges[axis] = Interval::point(side);
            open.push(Patch { ranges, axis, depth: 0 });
        }
    }
    let mut proof = Proof { least: f64::INFINITY, largest: 0.0 };
    let cost = [Some(&gauge.gauge), gauge.positive.as_ref(), gauge.single.as_ref(), gauge.finite.as_ref()];
    let cost: usize = cost.into_iter().flatten().map(|program| program.len().max(1)).sum();
    let mut left = (OPERATIONS / cost).min(BOXES);
    while !open.is_empty() {
        interrupt.tick()?;
        let batch: Vec<Patch> = open.split_off(open.len().saturating_sub(LANES));
        if left < batch.len() {
            return Ok(Err(Doubt { fault: Fault::Undecided, direction: batch[0].middle() }));
        }
        left -= batch.len();
        if let Some(doubt) = prover.doubt(&batch) {
            return Ok(Err(doubt));
        }
        for (patch, bounds) in batch.iter().zip(prover.bounds(&batch)) {
            match bounds {
                Some(bounds) => {
                    proof.least = proof.least.min(bounds.lo);
                    proof.largest = proof.largest.max(bounds.hi);
                }
                None if patch.depth >= DEPTH => {
                    return Ok(Err(Doubt { fault: Fault::Undecided, direction: patch.middle() }));
                }
                None => patch.split(&mut open),
            }
        }
    }
    Ok(Ok(proof))
}

/// A box of directions: one component is 1 or -1.
#[derive(Clone, Debug)]
struct Patch {
    ranges: Vec<Interval>,
    axis: usize,
    depth: u32,
}

impl Patch {
    fn middle(&self) -> Vec<f64> {
        self.ranges.iter().map(|r| 0.5 * (r.lo + r.hi)).collect()
    }

    fn split(&self, open: &mut Vec<Self>) {
        let mut parts = vec![Self { depth: self.depth + 1, ..self.clone() }];
        for axis in (0..self.ranges.len()).filter(|axis| *axis != self.axis) {
            let Interval { lo, hi, .. } = self.ranges[axis];
            let middle = 0.5 * (lo + hi);
            let halves = |part: Self| {
                [(lo, middle), (middle, hi)].map(|(lo, hi)| {
                    let mut half = part.clone();
                    half.ranges[axis] = Interval::new(lo, hi);
                    half
                })
            };
            parts = parts.into_iter().flat_map(halves).collect();
        }
        open.append(&mut parts);
    }
}

struct Prover<'a> {
    gauge: &'a Gauge,
    boxes: Boxes,
    points: Points<f64>,
}

impl Prover<'_> {
    /// What is wrong in the middle of one of these patches.
    fn doubt(&mut self, batch: &[Patch]) -> Option<Doubt> {
        let middles: Vec<Vec<f64>> = batch.iter().map(Patch::middle).collect();
        let gauges = self.values(&self.gauge.gauge, &middles);
        let of = |found: Option<(usize, Fault)>| found.map(|(k, fault)| Doubt { fault, direction: middles[k].clone() });
        if let Some(program) = &self.gauge.positive {
            let values = self.values(program, &middles);
            let bad = values.iter().position(|v| v.is_nan() || *v <= 0.0);
            if let Some(k) = bad {
                return of(Some((k, if values[k].is_nan() { Fault::Undefined } else { Fault::Outside })));
            }
        }
        if let Some(program) = &self.gauge.single {
            let values = self.values(program, &middles);
            let bad = values.iter().position(|v| v.is_nan() || *v < 0.0);
            if let Some(k) = bad {
                return of(Some((k, if values[k].is_nan() { Fault::Undefined } else { Fault::Several })));
            }
        }
        if let Some(program) = &self.gauge.finite
            && let Some(k) = self.values(program, &middles).iter().position(|v| !v.is_finite())
        {
            return of(Some((k, Fault::Undefined)));
        }
        let bad = gauges.iter().position(|g| g.is_nan() || *g <= 0.0 || g.is_infinite())?;
        let fault = if gauges[bad] <= 0.0 { Fault::Endless } else { Fault::Undefined };
        of(Some((bad, fault)))
    }

    fn values(&mut self, program: &Program, at: &[Vec<f64>]) -> Vec<f64> {
        let mut columns: Vec<Vec<f64>> =
            (0..self.gauge.centre.len()).map(|d| at.iter().map(|p| p[d]).collect()).collect();
        columns.extend(self.gauge.fixed.iter().map(|&value| vec![value; at.len()]));
        let slices: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
        let mut out = vec![0.0; at.len()];
        self.points.eval(program, &slices, &mut out);
        out
    }

    /// The bounds of the gauge over each patch, where it is proved to hold all over it.
    fn bounds(&mut self, batch: &[Patch]) -> Vec<Option<Interval>> {
        let gauges = self.ranges(&self.gauge.gauge, batch);
        let good = |r: Interval| !r.undefined && r.lo > 0.0 && r.hi < f64::INFINITY;
        let mut all: Vec<Option<Interval>> = gauges.into_iter().map(|r| Some(r).filter(|r| good(*r))).collect();
        if let Some(program) = &self.gauge.positive {
            let positive = |r: &Interval| !r.undefined && r.lo > 0.0 && r.hi < f64::INFINITY;
            keep(&mut all, &self.ranges(program, batch), positive);
        }
        if let Some(program) = &self.gauge.single {
            let fits = |r: &Interval| !r.undefined && r.lo >= 0.0 && r.hi < f64::INFINITY;
            keep(&mut all, &self.ranges(program, batch), fits);
        }
        if let Some(program) = &self.gauge.finite {
            let finite = |r: &Interval| !r.undefined && r.largest() < f64::INFINITY;
            keep(&mut all, &self.ranges(program, batch), finite);
        }
        all
    }

    fn ranges(&mut self, program: &Program, batch: &[Patch]) -> Vec<Interval> {
        let mut columns: Vec<Vec<Interval>> =
            (0..self.gauge.centre.len()).map(|d| batch.iter().map(|p| p.ranges[d]).collect()).collect();
        columns.extend(self.gauge.fixed.iter().map(|&value| vec![Interval::point(value); batch.len()]));
        let slices: Vec<&[Interval]> = columns.iter().map(Vec::as_slice).collect();
        let mut out = vec![Interval::WHOLE; batch.len()];
        self.boxes.eval(program, &slices, &mut out);
        out
    }
}

fn keep(all: &mut [Option<Interval>], ranges: &[Interval], holds: impl Fn(&Interval) -> bool) {
    for (kept, range) in all.iter_mut().zip(ranges) {
        if !holds(range) {
            *kept = None;
        }
    }
}
