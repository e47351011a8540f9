//! How steep a function is where it is near zero: a bound of the length of its gradient over a box, by intervals over ever smaller
//! boxes. What is far from zero counts only as far as that costs nothing.

use std::collections::BinaryHeap;

use super::graph::{Graph, NodeId};
use super::slopes::Slopes;
use crate::interrupt::{Cancelled, Interrupt};
use crate::number::Interval;
use crate::number::rank::Ranked;

/// What is known of a function over a box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Steepness {
    /// The gradient is nowhere longer than this where the function lies between `-within` and `within`.
    pub most: f64,
    /// Infinite if the bound holds all over the box.
    pub within: f64,
}

/// Why there is no bound.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Steep {
    /// The function may be undefined somewhere.
    Undefined,
    /// No bound was found near the boundary.
    Unbounded,
    /// The work was stopped.
    Cancelled,
}

impl From<Cancelled> for Steep {
    fn from(_: Cancelled) -> Self {
        Self::Cancelled
    }
}

/// Operations that the search may take, over boxes.
const WORK: usize = 10_000_000;
/// Boxes at least and at most.
const BOXES: (usize, usize) = (512, 20_000);
/// How much steeper than near the boundary a function may be elsewhere without being left aside there.
const ELSEWHERE: f64 = 1.5;

/// A box with what is known of the function in it.
struct Piece {
    space: [Interval; 3],
    /// The smallest magnitude of the function.
    least: f64,
    steepest: f64,
    undefined: bool,
}

impl Piece {
    fn of(slopes: &mut Slopes<'_>, space: [Interval; 3]) -> Self {
        let found = slopes.over(&space);
        let undefined = found.value.undefined;
        Self { space, least: found.value.smallest(), steepest: found.steepest(), undefined }
    }

    /// The halves of the longest side.
    fn halves(&self) -> [[Interval; 3]; 2] {
        let side = |k: usize| self.space[k].hi - self.space[k].lo;
        let longest = (1..3).fold(0, |most, k| if side(k) > side(most) { k } else { most });
        let Interval { lo, hi, .. } = self.space[longest];
        let middle = lo + 0.5 * (hi - lo);
        [Interval::new(lo, middle), Interval::new(middle, hi)].map(|half| {
            let mut space = self.space;
            space[longest] = half;
            space
        })
    }
}

/// Bounds the gradient of the value at `root`, a function of x1, x2 and x3 alone, over a box.
///
/// # Errors
/// [`Steep`]: there is no bound, or the work was stopped.
pub fn steepness(graph: &Graph, root: NodeId, space: [Interval; 3], interrupt: &Interrupt) -> Result<Steepness, Steep> {
    let mut slopes = Slopes::new(graph, root);
    let boxes = (WORK / slopes.len().max(1)).clamp(BOXES.0, BOXES.1);
    let mut pieces = vec![Piece::of(&mut slopes, space)];
    // First where the function may be undefined or zero, the steepest first; then where it is too steep, the nearest to zero first.
    refine(&mut pieces, boxes / 2, &mut slopes, interrupt, |piece| {
        let is_near = piece.undefined || piece.least == 0.0;
        is_near.then(|| [if piece.undefined { 1.0 } else { 0.0 }, piece.steepest, size(piece)])
    })?;
    let most = near_boundary(&pieces);
    let allowed = ELSEWHERE * most;
    if most.is_finite() {
        refine(&mut pieces, boxes, &mut slopes, interrupt, |piece| {
            let is_steeper = piece.least > 0.0 && piece.steepest > allowed;
            is_steeper.then(|| [-piece.least, size(piece), 0.0])
        })?;
    }
    if pieces.iter().any(|piece| piece.undefined) {
        return Err(Steep::Undefined);
    }
    if !most.is_finite() {
        return Err(Steep::Unbounded);
    }
    let within = pieces.iter().filter(|piece| piece.steepest > allowed).map(|piece| piece.least);
    // A little less than where the first steeper box begins.
    let within = within.fold(f64::INFINITY, f64::min) * (1.0 - 1e-9);
    let steepest = pieces.iter().filter(|piece| piece.least <= within).map(|piece| piece.steepest);
    Ok(Steepness { most: steepest.fold(0.0, f64::max), within })
}

/// Halves the most urgent box, again and again, until there are so many or none is urgent.
fn refine(
    pieces: &mut Vec<Piece>,
    until: usize,
    slopes: &mut Slopes<'_>,
    interrupt: &Interrupt,
    urgency: impl Fn(&Piece) -> Option<[f64; 3]>,
) -> Result<(), Cancelled> {
    let waiting = |at: usize, piece: &Piece| urgency(piece).map(|rank| Ranked { rank, number: at, item: () });
    let mut open: BinaryHeap<Ranked<3, ()>> =
        pieces.iter().enumerate().filter_map(|(at, piece)| waiting(at, piece)).collect();
    while pieces.len() < until {
        let Some(Ranked { number: at, .. }) = open.pop() else { break };
        interrupt.tick()?;
        let halves = pieces[at].halves().map(|half| Piece::of(slopes, half));
        let [first, second] = halves;
        open.extend(waiting(at, &first));
        open.extend(waiting(pieces.len(), &second));
        pieces[at] = first;
        pieces.push(second);
    }
    Ok(())
}

/// The steepest slope of the boxes that the boundary may cross; of all if it crosses none.
fn near_boundary(pieces: &[Piece]) -> f64 {
    let most = |near: bool| {
        let counted = pieces.iter().filter(|piece| !near || piece.least == 0.0);
        counted.map(|piece| piece.steepest).fold(f64::NEG_INFINITY, f64::max)
    };
    let found = most(true);
    if found >= 0.0 { found } else { most(false).max(0.0) }
}

fn size(piece: &Piece) -> f64 {
    piece.space.iter().map(|side| side.hi - side.lo).product()
}
