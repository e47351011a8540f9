//! Linear equations over a grid in which each unknown knows its neighbours up to two steps away: the sparse method of Cholesky with nested
//! dissection, which on a grid is plain to see, and fronts that are dense. Knows nothing of what the equations mean.

use rayon::join;

use super::front::Front;
use crate::interrupt::{Cancelled, Interrupt};

/// How far the neighbours of an unknown reach along each axis.
pub(super) const REACH: usize = 2;
/// Neighbours along an axis, the unknown itself included.
const AROUND: usize = 2 * REACH + 1;
/// Parts of the grid that are no larger are eliminated whole.
const SMALL: usize = 4;
/// Parts with more unknowns are worked on by two threads.
const SHARED: usize = 2_000;

/// A symmetric positive definite matrix over a grid, and a right side.
#[derive(Debug)]
pub(super) struct Equations {
    pub(super) size: [usize; 2],
    /// For each unknown, x fastest, the coefficients of its neighbours.
    matrix: Vec<f64>,
    pub(super) right: Vec<f64>,
}

/// Why there is no solution.
#[derive(Debug)]
pub(super) enum Unsolved {
    Singular,
    Cancelled,
}

impl From<Cancelled> for Unsolved {
    fn from(_: Cancelled) -> Self {
        Self::Cancelled
    }
}

/// Unknowns from `lo` to before `hi`.
#[derive(Clone, Copy)]
struct Part {
    lo: [usize; 2],
    hi: [usize; 2],
}

/// What is kept of a front: the rows of the unknowns that it eliminated, then those of the rest, and what the right side became.
struct Factor {
    own: Vec<u32>,
    rest: Vec<u32>,
    rows: Vec<f64>,
    right: Vec<f64>,
}

/// What a front leaves to others: its rest, the triangle over it, and the right side as the last row.
struct Left {
    rest: Vec<u32>,
    front: Front,
    from: usize,
}

impl Equations {
    pub(super) fn new(size: [usize; 2]) -> Self {
        let count = size[0] * size[1];
        Self { size, matrix: vec![0.0; count * AROUND * AROUND], right: vec![0.0; count] }
    }

    /// Bytes that equations over so many unknowns take, with their solution: the factor has about 8 numbers for each unknown and each
    /// halving of the grid.
    pub(super) fn bytes(size: [usize; 2]) -> usize {
        let count = size[0].saturating_mul(size[1]);
        let halvings = count.max(2).ilog2() as usize;
        count.saturating_mul(8 * (AROUND * AROUND + 2 + 16 * halvings))
    }

    /// Adds to the coefficient of an unknown and a neighbour, once for each order of the two.
    #[inline]
    pub(super) fn add(&mut self, [i, j]: [usize; 2], [k, l]: [usize; 2], value: f64) {
        let place = (l + REACH - j) * AROUND + (k + REACH - i);
        self.matrix[(i + self.size[0] * j) * AROUND * AROUND + place] += value;
    }

    /// The solution.
    pub(super) fn solve(&self, interrupt: &Interrupt) -> Result<Vec<f64>, Unsolved> {
        let whole = Part { lo: [0, 0], hi: self.size };
        let mut factors = Vec::new();
        self.part(whole, &mut factors, interrupt)?;
        let mut x = vec![0.0; self.right.len()];
        for factor in factors.iter().rev() {
            interrupt.tick()?;
            factor.back(&mut x);
        }
        Ok(x)
    }

    fn part(&self, part: Part, factors: &mut Vec<Factor>, interrupt: &Interrupt) -> Result<Left, Unsolved> {
        interrupt.tick()?;
        let sides = [0, 1].map(|k| part.hi[k] - part.lo[k]);
        let axis = usize::from(sides[1] > sides[0]);
        if sides[axis] <= SMALL {
            return self.front(part, part, &[], factors);
        }
        // Neighbours reach as far as the middle is wide, so that the halves know nothing of each other.
        let at = part.lo[axis] + (sides[axis] - REACH) / 2;
        let [mut low, mut high, mut middle] = [part; 3];
        low.hi[axis] = at;
        (middle.lo[axis], middle.hi[axis]) = (at, at + REACH);
        high.lo[axis] = at + REACH;
        let mut others = Vec::new();
        let (a, b) = if sides[0] * sides[1] > SHARED {
            join(|| self.part(low, factors, interrupt), || self.part(high, &mut others, interrupt))
        } else {
            (self.part(low, factors, interrupt), self.part(high, &mut others, interrupt))
        };
        let (a, b) = (a?, b?);
        factors.append(&mut others);
        self.front(part, middle, &[a, b], factors)
    }

    /// Eliminates `own`, the last unknowns of `part`.
    fn front(&self, part: Part, own: Part, children: &[Left], factors: &mut Vec<Factor>) -> Result<Left, Unsolved> {
        let near = Part {
            lo: part.lo.map(|c| c.saturating_sub(REACH)),
            hi: [0, 1].map(|k| (part.hi[k] + REACH).min(self.size[k])),
        };
        let number = |[i, j]: [usize; 2]| (i + self.size[0] * j) as u32;
        let own_nodes: Vec<u32> = own.places().map(number).collect();
        let rest: Vec<u32> = near.places().filter(|p| !part.holds(*p)).map(number).collect();
        let (k, n) = (own_nodes.len(), own_nodes.len() + rest.len());
        // The place of each unknown in the front, found by its place in the rectangle around.
        let wide = near.hi[0] - near.lo[0];
        let mut places = vec![u32::MAX; wide * (near.hi[1] - near.lo[1])];
        let place = |v: u32| {
            let (i, j) = (v as usize % self.size[0], v as usize / self.size[0]);
            (i - near.lo[0]) + wide * (j - near.lo[1])
        };
        (0u32..).zip(own_nodes.iter().chain(&rest)).for_each(|(local, &v)| places[place(v)] = local);
        let mut front = Front::new(n + 1);
        for (a, [i, j]) in own.places().enumerate() {
            front.add(n, a, self.right[i + self.size[0] * j]);
            let stencil = &self.matrix[(i + self.size[0] * j) * AROUND * AROUND..][..AROUND * AROUND];
            for l in j.saturating_sub(REACH).max(near.lo[1])..(j + REACH + 1).min(near.hi[1]) {
                for m in i.saturating_sub(REACH).max(near.lo[0])..(i + REACH + 1).min(near.hi[0]) {
                    let other = places[(m - near.lo[0]) + wide * (l - near.lo[1])];
                    // Both orders of two unknowns that are eliminated here would count twice.
                    if other != u32::MAX && other as usize >= a {
                        let value = stencil[(l + REACH - j) * AROUND + (m + REACH - i)];
                        front.add(other as usize, a, value);
                    }
                }
            }
        }
        for child in children {
            let to: Vec<usize> = child.rest.iter().map(|&v| places[place(v)] as usize).chain([n]).collect();
            for (r, &i) in to.iter().enumerate() {
                let row = &child.front.rows[(child.from + r) * child.front.n + child.from..][..=r];
                row.iter().zip(&to).for_each(|(value, &j)| front.add(i, j, *value));
            }
        }
        if !front.eliminate(k) {
            return Err(Unsolved::Singular);
        }
        let rows = (0..n).flat_map(|i| front.rows[i * (n + 1)..][..k].iter().copied()).collect();
        let right = front.rows[n * (n + 1)..][..k].to_vec();
        factors.push(Factor { own: own_nodes, rest: rest.clone(), rows, right });
        Ok(Left { rest, front, from: k })
    }
}

impl Part {
    fn places(self) -> impl Iterator<Item = [usize; 2]> {
        (self.lo[1]..self.hi[1]).flat_map(move |j| (self.lo[0]..self.hi[0]).map(move |i| [i, j]))
    }

    fn holds(&self, [i, j]: [usize; 2]) -> bool {
        (self.lo[0]..self.hi[0]).contains(&i) && (self.lo[1]..self.hi[1]).contains(&j)
    }
}

impl Factor {
    /// The unknowns of the front, where those of its rest are known.
    fn back(&self, x: &mut [f64]) {
        let k = self.own.len();
        let mut right = self.right.clone();
        for (row, &v) in self.rows.chunks(k).skip(k).zip(&self.rest) {
            let value = x[v as usize];
            right.iter_mut().zip(row).for_each(|(r, a)| *r -= a * value);
        }
        for j in (0..k).rev() {
            let row = &self.rows[j * k..][..=j];
            let value = right[j] / row[j];
            x[self.own[j] as usize] = value;
            right.iter_mut().zip(&row[..j]).for_each(|(r, a)| *r -= a * value);
        }
    }
}
