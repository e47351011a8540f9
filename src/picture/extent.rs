//! The part of a space that an object can be in, by intervals: what a camera should frame. Evaluates no points.

use crate::interrupt::{Cancelled, Interrupt};
use crate::number::Interval;
use crate::surface::boxes::{Block, Lattice, Visitor, walk};
use crate::surface::sampler::Sampler;
use crate::vm::{Program, Shape};

use super::raycast::Space;

/// Cells along each axis in which the object is looked for.
const CELLS: usize = 64;

/// The smallest box of cells, 64 along each axis of the space, that holds the object; `None` if the object is certainly empty. It never
/// cuts the object, and may be larger than needed where intervals are loose.
///
/// # Errors
/// [`Cancelled`] soon after the interrupt was set.
pub fn extent(shape: &Shape, space: Space, interrupt: &Interrupt) -> Result<Option<Space>, Cancelled> {
    let cells = Cells { space, dimension: shape.dimension };
    let done = walk(&cells, shape, |_| Found { from: [CELLS; 3], to: [0; 3] }, interrupt)?;
    let join = |all: Found, one: Found| Found {
        from: std::array::from_fn(|k| all.from[k].min(one.from[k])),
        to: std::array::from_fn(|k| all.to[k].max(one.to[k])),
    };
    let all = done.visitors.into_iter().fold(Found { from: [CELLS; 3], to: [0; 3] }, join);
    let bound = |index: [usize; 3]| std::array::from_fn(|k| cells.plane(k, index[k]));
    let empty = (0..shape.dimension).any(|k| all.from[k] >= all.to[k]);
    Ok((!empty).then(|| Space { lo: bound(all.from), hi: bound(all.to) }))
}

struct Cells {
    space: Space,
    dimension: usize,
}

impl Cells {
    /// The plane before cell `index`.
    fn plane(&self, axis: usize, index: usize) -> f64 {
        let (lo, hi) = (self.space.lo[axis], self.space.hi[axis]);
        if axis >= self.dimension {
            return if index == 0 { lo } else { hi };
        }
        if index == CELLS { hi } else { lo + (hi - lo) * (index as f64 / CELLS as f64) }
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

    fn bounds(&self, block: &Block, out: &mut [Interval]) {
        for (k, out) in out.iter_mut().enumerate() {
            *out = Interval::new(self.plane(k, block.from[k]), self.plane(k, block.to[k]));
        }
    }
}

/// The hull of the cells that are not certainly outside.
struct Found {
    from: [usize; 3],
    to: [usize; 3],
}

impl Found {
    fn add(&mut self, block: &Block) {
        for k in 0..3 {
            self.from[k] = self.from[k].min(block.from[k]);
            self.to[k] = self.to[k].max(block.to[k]);
        }
    }
}

impl Visitor for Found {
    /// What lies within the hull already cannot widen it.
    fn wants(&mut self, block: &Block) -> bool {
        (0..3).any(|k| block.from[k] < self.from[k] || block.to[k] > self.to[k])
    }

    fn uniform(&mut self, block: &Block, inside: bool) {
        if inside {
            self.add(block);
        }
    }

    fn leaf(&mut self, block: &Block, _program: &Program, _sampler: &mut Sampler) {
        self.add(block);
    }
}
