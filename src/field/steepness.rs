//! How steep a function is where it is near zero: a bound of the length of its gradient over a box, by intervals over ever smaller
//! boxes. What is far from zero counts only as far as that costs nothing.

use super::graph::{Graph, NodeId};
use super::slopes::Slopes;
use crate::interrupt::{Cancelled, Interrupt};
use crate::number::Interval;

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
const BOXES: (usize, usize) = (512, 8_192);
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
    let mut until = boxes / 2;
    let mut near = true;
    while pieces.len() < boxes {
        interrupt.tick()?;
        let next = if near { worst_near(&pieces) } else { first_steeper(&pieces) };
        match next {
            Some(worst) if pieces.len() < until || !near => {
                let halves = pieces[worst].halves();
                pieces[worst] = Piece::of(&mut slopes, halves[0]);
                pieces.push(Piece::of(&mut slopes, halves[1]));
            }
            _ if near => (near, until) = (false, boxes),
            _ => break,
        }
    }
    if pieces.iter().any(|piece| piece.undefined) {
        return Err(Steep::Undefined);
    }
    let most = near_boundary(&pieces);
    if !most.is_finite() {
        return Err(Steep::Unbounded);
    }
    let allowed = ELSEWHERE * most;
    let within = pieces.iter().filter(|piece| piece.steepest > allowed).map(|piece| piece.least);
    // A little less than where the first steeper box begins.
    let within = within.fold(f64::INFINITY, f64::min) * (1.0 - 1e-9);
    let steepest = pieces.iter().filter(|piece| piece.least <= within).map(|piece| piece.steepest);
    Ok(Steepness { most: steepest.fold(0.0, f64::max), within })
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

/// The box to look into next: one where the function may be undefined, else the steepest that the boundary may cross; of equals the
/// largest, and the first of those.
fn worst_near(pieces: &[Piece]) -> Option<usize> {
    let key = |piece: &Piece| (piece.undefined, piece.steepest, size(piece));
    let mut worst: Option<usize> = None;
    for (at, piece) in pieces.iter().enumerate().filter(|(_, piece)| piece.undefined || piece.least == 0.0) {
        if worst.is_none_or(|known| key(piece) > key(&pieces[known])) {
            worst = Some(at);
        }
    }
    worst
}

/// The box nearest to zero in which the function is steeper than it should be.
fn first_steeper(pieces: &[Piece]) -> Option<usize> {
    let allowed = ELSEWHERE * near_boundary(pieces);
    let steeper = pieces.iter().enumerate().filter(|(_, piece)| piece.least > 0.0 && piece.steepest > allowed);
    steeper.min_by(|a, b| a.1.least.total_cmp(&b.1.least).then(size(b.1).total_cmp(&size(a.1)))).map(|found| found.0)
}
