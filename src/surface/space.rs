//! Finds where an object lies when nobody said: a box of any dimension that holds all of it, proved by intervals as far as they reach and
//! guessed from samples where they do not. Makes no mesh and knows no names of coordinates.
//!
//! Each end of the box is a search of its own: of the boxes that may hold some of the object the one that reaches farthest is split, until
//! none reaches farther than a point that is known to be inside. Intervals take infinite ends, so that the first box is the whole space.
//! Where they say nothing about infinity (a turned bar: both products of a large number and a sine of unknown sign), the search begins
//! at a huge bound.

mod samples;
mod search;

use std::sync::Arc;

use super::sampler::Sampler;
use crate::interrupt::{Cancelled, Interrupt};
use crate::vm::{Program, Shape};

use search::{Climb, Ends, Search, Stop, width};
pub(super) use search::{middle, squeezed};

/// Where "far away" begins: an object with a point beyond it is taken for one without end.
pub(super) const FAR: f64 = (1_u64 << 40) as f64;
/// Part of an axis to which an end is known when it is first narrowed, and at last.
const ROUGH: f64 = 1.0 / 8.0;
const FINE: f64 = 1.0 / 256.0;
/// Rounds of narrowing; each but the last takes at least a seventh off one axis.
const ROUNDS: usize = 400;
/// Work that a box costs besides its operations.
const OVERHEAD: u64 = 64;
/// What an operation on one box costs, in operations at points: those come in blocks.
const BOX: u64 = 8;
/// Points at a time where intervals fail.
const SAMPLES: usize = 2048;

/// What is known of an input of the program.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Known {
    /// Its range, or its value twice.
    Range(f64, f64),
    /// Its range is sought; one end may be given.
    Sought(Option<f64>, Option<f64>),
}

/// How sure it is that nothing lies outside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Proof {
    /// Intervals show it for the whole space.
    Everywhere,
    /// Intervals show it as far as this coordinate.
    UpTo(f64),
    /// Samples found nothing outside; intervals could not decide.
    Samples,
}

/// What was found.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// The object lies in these ranges, one for each input; the sought ones are padded and rounded to short numbers.
    Within(Vec<[f64; 2]>, Proof),
    /// It has no end along these inputs: the input, and whether upwards.
    Endless(Vec<(usize, bool)>),
    /// It holds nothing but perhaps this point.
    Point(Vec<f64>),
    /// No point of it was found; whether intervals prove that there is none; where the function was largest.
    Empty(bool, Option<(f64, Vec<f64>)>),
}

/// Looks for the object of a program that asks for signs; `known` has an entry for each of its inputs. At most `work` operations are
/// spent (roughly), after which what is known by then is the answer.
///
/// # Errors
/// [`Cancelled`] soon after the interrupt was set.
pub fn find(program: Arc<Program>, known: &[Known], work: usize, interrupt: &Interrupt) -> Result<Outcome, Cancelled> {
    interrupt.begin(0);
    let outcome = sought(Search::new(program, known, work as u64, interrupt));
    // What was evaluated after the interrupt was set means nothing.
    interrupt.tick()?;
    outcome
}

fn sought(mut search: Search) -> Result<Outcome, Cancelled> {
    if search.sought.is_empty() {
        return Ok(Outcome::Within(search.outer, Proof::Everywhere));
    }
    let endless = match search.hem_in()? {
        Ends::Nothing => return Ok(Outcome::Empty(true, search.best)),
        Ends::Endless(all) => return Ok(Outcome::Endless(all)),
        Ends::Open => true,
        Ends::Closed => false,
    };
    let narrowed = search.narrow()?;
    let mut proof = if endless { Proof::UpTo(FAR) } else { Proof::Everywhere };
    if !narrowed {
        return Ok(Outcome::Empty(true, search.best));
    }
    if search.is_point() {
        return Ok(Outcome::Point(search.outer.iter().map(|range| 0.5 * range[0] + 0.5 * range[1]).collect()));
    }
    let far = search.far_ends();
    if !far.is_empty() || search.inner.is_none() {
        if let Some(ends) = search.guess()? {
            return Ok(Outcome::Endless(ends));
        }
        proof = Proof::Samples;
    }
    if search.inner.is_none() {
        return Ok(Outcome::Empty(false, search.best));
    }
    Ok(Outcome::Within(rounded(&search), proof))
}

/// The farthest reach of an object within ranges, one for each input of its program: for each input the bounds between which its lowest
/// and its highest coordinate lie. `None` if there is no point in it. `work` as for [`find`].
///
/// # Errors
/// [`Cancelled`] soon after the interrupt was set.
#[allow(clippy::type_complexity)]
pub fn reach(
    program: Arc<Program>,
    ranges: &[(f64, f64)],
    part: f64,
    work: usize,
    interrupt: &Interrupt,
) -> Result<Option<Vec<[[f64; 2]; 2]>>, Cancelled> {
    let known: Vec<Known> = ranges.iter().map(|&(lo, hi)| Known::Sought(Some(lo), Some(hi))).collect();
    let mut search = Search::new(program, &known, work as u64, interrupt);
    let moves = (0..ranges.len()).filter(|&axis| ranges[axis].0 < ranges[axis].1);
    let ends: Vec<(usize, bool)> = moves.flat_map(|axis| [(axis, false), (axis, true)]).collect();
    let longest = ranges.iter().map(|(lo, hi)| hi - lo).fold(0.0, f64::max);
    let share = search.left() / ends.len().max(1) as u64;
    for &(axis, up) in &ends {
        match search.climb(axis, up, Stop::Within(part * longest), share)? {
            Climb::Reach(at) => search.outer[axis][usize::from(up)] = at,
            Climb::Nothing if search.inner.is_none() => {
                interrupt.tick()?;
                return Ok(None);
            }
            Climb::Nothing | Climb::Open | Climb::Endless => {}
        }
    }
    interrupt.tick()?;
    let outer = search.outer;
    Ok(search.inner.map(|inner| {
        inner.iter().zip(&outer).map(|(inner, outer)| [[outer[0], inner[0]], [inner[1], outer[1]]]).collect()
    }))
}

/// The part of a space that may hold some of an object, as far as it takes to bring ends that are infinite to somewhere finite; at most so
/// many boxes, roughly, are looked at. An end that intervals leave open stays infinite. `None` if it is proved that nothing is anywhere.
///
/// # Errors
/// [`Cancelled`] soon after the interrupt was set.
pub fn enclose(
    program: Arc<Program>,
    space: &[[f64; 2]],
    boxes: usize,
    interrupt: &Interrupt,
) -> Result<Option<Vec<[f64; 2]>>, Cancelled> {
    let end = |end: f64| end.is_finite().then_some(end);
    let known: Vec<Known> = space.iter().map(|[lo, hi]| Known::Sought(end(*lo), end(*hi))).collect();
    let box_ = BOX * (program.len() as u64 + OVERHEAD);
    let mut search = Search::new(program, &known, box_.saturating_mul(boxes as u64), interrupt);
    let is_found = search.bring_in()?;
    interrupt.tick()?;
    Ok(is_found.then_some(search.outer))
}

/// The faces of a space beyond which a 3-D shape goes on, as far as some points of each face tell: lower and upper for each axis.
#[must_use]
pub fn cut(shape: &Shape, bounds: &[[f64; 2]], interrupt: &Interrupt) -> [[bool; 2]; 3] {
    const SIDE: usize = 48;
    let mut sampler = Sampler::new(shape).heeding(interrupt);
    let mut is_cut = |axis: usize, at: f64| {
        let place = |k: usize, d: usize| match d {
            _ if d == axis => at,
            _ => {
                let step = if d == (axis + 1) % 3 { k % SIDE } else { k / SIDE };
                bounds[d][0] + (bounds[d][1] - bounds[d][0]) * (step as f64 + 0.5) / SIDE as f64
            }
        };
        let columns = [0, 1, 2].map(|d| (0..SIDE * SIDE).map(|k| place(k, d)).collect::<Vec<f64>>());
        let mut values = vec![0.0; SIDE * SIDE];
        sampler.values(&shape.program, &columns.each_ref().map(Vec::as_slice), &mut values);
        values.iter().any(|&value| value > 0.0)
    };
    let mut cut = [[false; 2]; 3];
    for (axis, (cut, bounds)) in cut.iter_mut().zip(bounds).enumerate() {
        *cut = [is_cut(axis, bounds[0]), is_cut(axis, bounds[1])];
    }
    cut
}

/// The outer box with some room, its sought ends rounded outward to short numbers.
fn rounded(search: &Search) -> Vec<[f64; 2]> {
    let longest = search.sought.iter().map(|&(axis, _)| width(search.outer[axis])).fold(0.0, f64::max);
    let mut ranges = search.outer.clone();
    for &(axis, [lower, upper]) in &search.sought {
        let [lo, hi] = search.outer[axis];
        // A sheet without thickness still gets some room.
        let unit = Unit::of((hi - lo).max(longest / 100.0) / 50.0);
        if lower {
            ranges[axis][0] = -unit.above(-lo);
        }
        if upper {
            ranges[axis][1] = unit.above(hi);
        }
    }
    ranges
}

/// A short step: 1, 2 or 5 times a power of ten.
struct Unit {
    mantissa: f64,
    power: i32,
}

impl Unit {
    /// The shortest that is not smaller than `size`.
    fn of(size: f64) -> Self {
        let power = size.log10().floor();
        let rest = size / 10_f64.powf(power);
        let mantissa = [1.0, 2.0, 5.0].into_iter().find(|m| rest <= m * (1.0 + 1e-9)).unwrap_or(10.0);
        Self { mantissa, power: power as i32 }
    }

    /// The first multiple that leaves some room above `value`.
    fn above(&self, value: f64) -> f64 {
        let step = self.mantissa * 10_f64.powi(self.power);
        let count = (value / step + 0.2).ceil();
        // Whole numbers and quotients by powers of ten are as short as they look.
        let digits = count * self.mantissa;
        if self.power >= 0 { digits * 10_f64.powi(self.power) } else { digits / 10_f64.powi(-self.power) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_are_short_numbers_with_room() {
        for (size, value, end) in
            [(4.0, 2.0, 2.1), (4.0, 2.01, 2.1), (2.0, 1.0, 1.05), (0.02, -0.37, -0.3695), (1e6, 5e5, 520_000.0)]
        {
            assert_eq!(Unit::of(size / 50.0).above(value), end, "{value} of {size}");
        }
    }
}
