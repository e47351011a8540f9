//! Where in a space an object can be, by intervals: what a camera should frame. Evaluates no points.

use std::sync::Arc;

use crate::interrupt::{Cancelled, Interrupt};
use crate::number::Interval;
use crate::reuse::Digest;
use crate::surface::boxes::{Block, Lattice, Visitor, walk};
use crate::surface::memory::Left;
use crate::surface::sampler::Sampler;
use crate::vm::{Program, Shape};

use super::raycast::Space;

/// Cells along each axis in which the object is looked for.
const CELLS: usize = 64;

/// A hull of an object: for each column of cells along axis 2, the first cell and one past the last that may hold some of it. It never
/// cuts the object, and may be larger where intervals are loose.
#[derive(Clone, Debug, PartialEq)]
pub struct Extent {
    space: Space,
    dimension: usize,
    columns: Vec<(u8, u8)>,
}

impl Extent {
    /// Looks for the object in the space.
    ///
    /// # Errors
    /// [`Cancelled`] soon after the interrupt was set.
    pub fn of(shape: &Shape, space: Space, interrupt: &Interrupt) -> Result<Self, Cancelled> {
        let mut extent = Self::nothing(space, shape.dimension);
        let done = walk(&Cells { space, dimension: shape.dimension }, shape, |_| Found::default(), interrupt)?;
        done.visitors.iter().flat_map(|found| &*found.0).for_each(|block| extent.add(block));
        Ok(extent)
    }

    /// Nothing in that space.
    #[must_use]
    pub fn nothing(space: Space, dimension: usize) -> Self {
        Self { space, dimension, columns: vec![(CELLS as u8, 0); CELLS * CELLS] }
    }

    /// Whether the object is certainly empty.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.columns.iter().all(|(from, to)| from >= to)
    }

    /// The hull of both, of the same space.
    #[must_use]
    pub fn join(mut self, other: &Self) -> Self {
        for (column, more) in self.columns.iter_mut().zip(&other.columns) {
            *column = (column.0.min(more.0), column.1.max(more.1));
        }
        self
    }

    /// Points whose convex hull holds the object: the corners of the columns, or those of the space if the object is empty.
    #[must_use]
    pub fn points(&self) -> Vec<[f64; 3]> {
        let cells = Cells { space: self.space, dimension: self.dimension };
        let mut points = Vec::new();
        for (at, &(from, to)) in self.columns.iter().enumerate().filter(|(_, (from, to))| from < to) {
            for corner in 0..8_usize {
                let k = if corner & 4 == 0 { from } else { to };
                let index = [at % CELLS + (corner & 1), at / CELLS + (corner >> 1 & 1), k.into()];
                points.push(std::array::from_fn(|axis| cells.plane(axis, index[axis])));
            }
        }
        if points.is_empty() {
            return Self::whole(self.space);
        }
        points
    }

    /// The corners of a space.
    #[must_use]
    pub fn whole(space: Space) -> Vec<[f64; 3]> {
        let corner = |n: usize| std::array::from_fn(|k| if n >> k & 1 == 1 { space.hi[k] } else { space.lo[k] });
        (0..8).map(corner).collect()
    }

    /// The smallest box of cells that holds the object; `None` if it is empty.
    #[must_use]
    pub fn bounds(&self) -> Option<Space> {
        let nothing = Space { lo: [f64::INFINITY; 3], hi: [f64::NEG_INFINITY; 3] };
        let join = |all: Space, p: [f64; 3]| Space {
            lo: std::array::from_fn(|k| all.lo[k].min(p[k])),
            hi: std::array::from_fn(|k| all.hi[k].max(p[k])),
        };
        (!self.is_empty()).then(|| self.points().into_iter().fold(nothing, join))
    }

    fn add(&mut self, block: &Block) {
        for j in block.from[1]..block.to[1] {
            for column in &mut self.columns[j * CELLS..][block.from[0]..block.to[0]] {
                *column = (column.0.min(block.from[2] as u8), column.1.max(block.to[2] as u8));
            }
        }
    }
}

/// Cells of the space; one along the axes that it does not have.
struct Cells {
    space: Space,
    dimension: usize,
}

impl Cells {
    /// The plane before cell `index`.
    fn plane(&self, axis: usize, index: usize) -> f64 {
        let (lo, hi) = (self.space.lo[axis], self.space.hi[axis]);
        let count = self.counts()[axis];
        if index >= count { hi } else { lo + (hi - lo) * (index as f64 / count as f64) }
    }
}

impl Lattice for Cells {
    fn counts(&self) -> [usize; 3] {
        std::array::from_fn(|k| if k < self.dimension { CELLS } else { 1 })
    }

    fn leaf(&self) -> [usize; 3] {
        [1; 3]
    }

    fn task(&self) -> [usize; 3] {
        std::array::from_fn(|k| if k < self.dimension { 16 } else { 1 })
    }

    fn tell(&self, to: &mut Digest) -> bool {
        to.shown(&("extent", self.space, self.dimension));
        true
    }

    fn bounds(&self, block: &Block, out: &mut [Interval]) {
        for (k, out) in out.iter_mut().enumerate() {
            *out = Interval::new(self.plane(k, block.from[k]), self.plane(k, block.to[k]));
        }
    }
}

/// The blocks that are not certainly outside.
#[derive(Default)]
struct Found(Arc<Vec<Block>>);

impl Visitor for Found {
    fn uniform(&mut self, block: &Block, inside: bool) {
        if inside {
            Arc::make_mut(&mut self.0).push(*block);
        }
    }

    fn leaf(&mut self, block: &Block, _program: &Program, _sampler: &mut Sampler) {
        Arc::make_mut(&mut self.0).push(*block);
    }

    fn keep(&mut self) -> Option<Left> {
        Some(Left { what: self.0.clone(), bytes: self.0.capacity() * size_of::<Block>() })
    }

    fn recall(&mut self, left: &Left) -> bool {
        let Ok(blocks) = left.what.clone().downcast() else { return false };
        self.0 = blocks;
        true
    }
}
