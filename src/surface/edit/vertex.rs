//! What one vertex of the guide keeps, and what an edit does to it. Every value is a norm, never a sum of powers.

use super::{BLOCKS, point};
use crate::number::star::{Exponent, Norm, Polyhedron, Row, StarSolid, sum_error};

/// The relative error of a norm up to which its running bound may grow before it is evaluated anew.
const WORST: f64 = 1e-10;

/// A vertex of the guide shape.
#[derive(Clone, Debug)]
pub(super) struct Vertex {
    pub(super) direction: [f64; 3],
    /// How far the boundary is in that direction: the norm of `rest` and the lifted part.
    pub(super) reach: f64,
    /// The norm of each block's parts, the lifted one left out.
    blocks: [f64; BLOCKS],
    /// A bound of the relative error of each block's sum of powers.
    errors: [f32; BLOCKS],
    /// The norm of all blocks.
    rest: f64,
    /// F of the lifted part; infinite if there is none.
    own: f64,
    /// A bound of the relative error of its sum of powers.
    own_error: f32,
}

/// Where a part is taken from.
pub(super) struct Place<'a> {
    pub(super) solid: &'a StarSolid,
    pub(super) part: usize,
    /// The parts of its block, itself among them.
    pub(super) members: &'a [u32],
    pub(super) block: usize,
}

/// What happens to the lifted part.
pub(super) enum Change {
    /// A half-space goes, comes or is replaced.
    Swap { row: usize, old: Option<Row>, new: Option<Row> },
    /// It becomes another one.
    Become(Polyhedron),
    /// It was not there before.
    Appear(Polyhedron),
    /// It will not be there.
    Vanish,
}

impl Change {
    /// The part afterwards.
    pub(super) fn applied(&self, before: &Polyhedron) -> Option<Polyhedron> {
        match self {
            Self::Vanish => None,
            Self::Become(after) | Self::Appear(after) => Some(after.clone()),
            Self::Swap { row, old, new } => {
                let mut after = before.clone();
                match (old, new) {
                    (Some(_), Some(new)) => after.rows[*row] = *new,
                    (Some(_), None) => drop(after.rows.remove(*row)),
                    (None, Some(new)) => after.rows.push(*new),
                    (None, None) => {}
                }
                Some(after)
            }
        }
    }
}

/// The norm of two terms.
fn join(a: f64, b: f64, p: Exponent) -> f64 {
    let mut norm = Norm::ZERO;
    norm.add(a, p);
    norm.add(b, p);
    norm.value(p)
}

/// The largest bound of the error of a sum of powers that its norm may have.
fn worst(p: Exponent) -> f64 {
    WORST * p.get().min(1e3)
}

/// The bound for a sum of that many terms that was just formed.
#[allow(clippy::cast_possible_truncation, clippy::cast_precision_loss)]
fn fresh_error(terms: usize, p: Exponent) -> f32 {
    (sum_error(p) + terms as f64 * f64::EPSILON) as f32
}

/// A norm with the bound of its error after `old`, one of its terms, was replaced by `new`, each of them 0 where there is none;
/// nothing if too few digits are left. `added` bounds the errors of the terms.
#[allow(clippy::cast_possible_truncation)]
fn swapped(norm: f64, error: f32, (old, new): (f64, f64), p: Exponent, added: f64) -> Option<(f64, f32)> {
    if p.is_infinite() {
        // Not the winner: it stays, or the new term beats it. The winner leaves the runner-up, which is not known here, unless it only
        // grows.
        return (old < norm || new >= norm).then_some((norm.max(new), 0.0));
    }
    if norm == 0.0 || (norm == f64::INFINITY && old < norm) {
        return Some((norm.max(new), error.max(fresh_error(1, p))));
    }
    if norm == f64::INFINITY || new >= 1e3 * norm {
        return None;
    }
    let out = if old > 0.0 { p.power(old / norm) } else { 0.0 };
    let into = if new > 0.0 { p.power(new / norm) } else { 0.0 };
    let left = (1.0 - out) + into;
    let grown = (f64::from(error) + added * (out + into) + sum_error(p)) / left;
    let good = left > 0.0 && left < 1e30 && grown <= worst(p);
    good.then(|| (norm * p.root(left), grown as f32))
}

impl Vertex {
    pub(super) fn new(direction: [f64; 3]) -> Self {
        Self {
            direction,
            reach: 0.0,
            blocks: [0.0; BLOCKS],
            errors: [0.0; BLOCKS],
            rest: 0.0,
            own: f64::INFINITY,
            own_error: 0.0,
        }
    }

    /// Everything anew, with no part lifted.
    pub(super) fn evaluate(&mut self, solid: &StarSolid, blocks: &[Vec<u32>; BLOCKS]) {
        let at = point(&self.direction);
        for (b, members) in blocks.iter().enumerate() {
            let mut norm = Norm::ZERO;
            members.iter().for_each(|part| norm.add(solid.parts[*part as usize].reach(&at), solid.p));
            self.blocks[b] = norm.value(solid.p);
            self.errors[b] = fresh_error(members.len(), solid.p);
        }
        self.own = f64::INFINITY;
        self.join_blocks(solid.p);
        self.reach = self.rest;
    }

    fn join_blocks(&mut self, p: Exponent) {
        let mut norm = Norm::ZERO;
        self.blocks.iter().for_each(|b| norm.add(*b, p));
        self.rest = norm.value(p);
    }

    /// The lifted part, whose own parameter is `p_own`, goes back into its block.
    #[allow(clippy::cast_possible_truncation)]
    pub(super) fn put_back(&mut self, block: usize, p_own: Exponent, p: Exponent) {
        self.blocks[block] = join(self.blocks[block], 1.0 / self.own, p);
        let own = f64::from(self.own_error) * ratio(p, p_own);
        self.errors[block] = (f64::from(self.errors[block]).max(own) + sum_error(p)) as f32;
    }

    /// A part that is not there yet.
    pub(super) fn lift_nothing(&mut self, p: Exponent) -> u64 {
        self.join_blocks(p);
        self.own = f64::INFINITY;
        0
    }

    /// Takes a part out of its block. The number of half-spaces that were evaluated.
    pub(super) fn lift(&mut self, place: &Place<'_>, part: &Polyhedron) -> u64 {
        let at = point(&self.direction);
        let p = place.solid.p;
        self.own = part.value(&at);
        self.own_error = fresh_error(part.rows.len(), part.p);
        let mut evaluated = part.rows.len();
        let added = f64::from(self.own_error) * ratio(p, part.p);
        let b = place.block;
        match swapped(self.blocks[b], self.errors[b], (1.0 / self.own, 0.0), p, added) {
            Some((norm, error)) => (self.blocks[b], self.errors[b]) = (norm, error),
            None => {
                let mut norm = Norm::ZERO;
                for other in place.members.iter().map(|m| *m as usize).filter(|m| *m != place.part) {
                    let other = &place.solid.parts[other];
                    norm.add(other.reach(&at), p);
                    evaluated += other.rows.len();
                }
                self.blocks[b] = norm.value(p);
                self.errors[b] = fresh_error(place.members.len(), p);
            }
        }
        self.join_blocks(p);
        evaluated as u64
    }

    /// Changes the lifted part, and finds the new reach.
    pub(super) fn change(&mut self, p_own: Exponent, change: &Change, after: Option<&Polyhedron>, p: Exponent) -> u64 {
        let mut evaluated = 0;
        match (change, after) {
            (Change::Swap { old, new, .. }, Some(after)) => {
                let at = point(&self.direction);
                let half = |row: &Option<Row>| row.map_or(0.0, |row| crate::number::star::linear(&row, &at).max(0.0));
                match swapped(self.own, self.own_error, (half(old), half(new)), p_own, 0.0) {
                    Some((own, error)) => {
                        (self.own, self.own_error) = (own, error);
                        evaluated = 2;
                    }
                    None => evaluated = self.become_part(after),
                }
            }
            (_, Some(after)) => evaluated = self.become_part(after),
            (_, None) => self.own = f64::INFINITY,
        }
        self.reach = join(self.rest, 1.0 / self.own, p);
        evaluated
    }

    fn become_part(&mut self, part: &Polyhedron) -> u64 {
        self.own = part.value(&point(&self.direction));
        self.own_error = fresh_error(part.rows.len(), part.p);
        part.rows.len() as u64
    }
}

/// By how much an error of a sum with the parameter `q` counts in one with `p`.
fn ratio(p: Exponent, q: Exponent) -> f64 {
    if p.is_infinite() || q.is_infinite() { 0.0 } else { p.get() / q.get() }
}
