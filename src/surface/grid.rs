//! The modelling space cut into cells: where the sample points of a mesh or a contour lie. Never evaluates anything.

use std::fmt;

use super::boxes::{Block, Lattice};
use super::sampler::span;
use crate::number::Interval;
use crate::reuse::Digest;

/// Sample points along each axis of a leaf (a brick).
pub const LEAF: usize = 8;

/// Most cells along one side: vertices and leaves are numbered in 32 bits.
pub const MOST_CELLS: usize = 1 << 14;

/// Bytes that a mesh takes per vertex while it is made and checked: about twice what it takes when it is done.
pub const BYTES_PER_VERTEX: usize = 256;

/// An axis-aligned box of a 3-D or 2-D space, cut into equal cells along each axis.
///
/// The sample points are the corners of the cells: `cells + 1` along each axis, the first and the last exactly on the faces of the box. A
/// plane has `cells[2] == 0` and lies at 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    /// Lower bounds of the space.
    pub lo: [f64; 3],
    /// Upper bounds of the space.
    pub hi: [f64; 3],
    /// Cells along each axis.
    pub cells: [usize; 3],
}

/// Why a space cannot be cut into cells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum GridError {
    /// It has neither two nor three coordinates.
    Dimension(usize),
    /// The bounds of the coordinate with this index (from 0) are not finite or hold no length.
    Bounds(usize),
    /// The cells along the coordinate with this index are too small for doubles of its size.
    TooFine(usize),
    /// No cells, or more than [`MOST_CELLS`] along a side.
    Resolution(usize),
}

impl fmt::Display for GridError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Dimension(n) => write!(f, "a boundary is found in 2 or 3 coordinates, not in {n}"),
            Self::Bounds(axis) => write!(f, "the modelling space has no extent along x{}", axis + 1),
            Self::TooFine(axis) => write!(f, "the cells along x{} are too small to be told apart", axis + 1),
            Self::Resolution(n) => write!(f, "{n} cells along a side: between 1 and {MOST_CELLS} are possible"),
        }
    }
}

impl std::error::Error for GridError {}

impl Grid {
    /// Cuts a space, given as `[lo, hi]` for each of its two or three coordinates, into `resolution` cells along its longest side and as
    /// many along the others as keeps a cell from being longer there.
    ///
    /// # Errors
    /// If the space has no extent, or the number of cells is out of bounds.
    pub fn new(bounds: &[[f64; 2]], resolution: usize) -> Result<Self, GridError> {
        if !(2..=3).contains(&bounds.len()) {
            return Err(GridError::Dimension(bounds.len()));
        }
        if resolution == 0 || resolution > MOST_CELLS {
            return Err(GridError::Resolution(resolution));
        }
        let mut grid = Self { lo: [0.0; 3], hi: [0.0; 3], cells: [0; 3] };
        for (axis, &[lo, hi]) in bounds.iter().enumerate() {
            if !(lo < hi && (hi - lo).is_finite() && lo.is_finite() && hi.is_finite()) {
                return Err(GridError::Bounds(axis));
            }
            (grid.lo[axis], grid.hi[axis]) = (lo, hi);
        }
        let longest = bounds.iter().map(|[lo, hi]| hi - lo).fold(0.0, f64::max);
        for (axis, [lo, hi]) in bounds.iter().enumerate() {
            // A side that is a whole number of cells but for rounding must not get one more.
            let cells = ((hi - lo) / longest * resolution as f64 - 1e-9).ceil();
            grid.cells[axis] = (cells as usize).clamp(1, resolution);
            let unit = f64::EPSILON * lo.abs().max(hi.abs()) + f64::MIN_POSITIVE;
            if grid.cell()[axis] < 1024.0 * unit {
                return Err(GridError::TooFine(axis));
            }
        }
        Ok(grid)
    }

    /// 3, or 2 for a plane.
    #[must_use]
    pub fn dimension(&self) -> usize {
        if self.cells[2] == 0 { 2 } else { 3 }
    }

    /// The same space with twice as large cells (rounded up in number).
    #[must_use]
    pub fn halved(&self) -> Self {
        Self { cells: self.cells.map(|n| n.div_ceil(2)), ..*self }
    }

    /// This grid, and those with twice and four times as large cells as far as there are still some cells: for estimates of errors.
    #[must_use]
    pub fn coarser(&self) -> Vec<Self> {
        let longest = self.cells.into_iter().max().unwrap_or_default();
        let mut all = vec![*self];
        if longest >= 2 {
            all.push(self.halved());
        }
        if longest >= 16 {
            all.push(self.halved().halved());
        }
        all
    }

    /// Length of a cell along each axis.
    #[must_use]
    pub fn cell(&self) -> [f64; 3] {
        std::array::from_fn(|d| if self.cells[d] == 0 { 0.0 } else { (self.hi[d] - self.lo[d]) / self.cells[d] as f64 })
    }

    /// The coordinate of the sample points with index `index` along `axis`: ascending, exactly `lo` and `hi` at the ends.
    #[must_use]
    pub fn coordinate(&self, axis: usize, index: usize) -> f64 {
        let (lo, hi) = (self.lo[axis], self.hi[axis]);
        if index >= self.cells[axis] {
            return hi;
        }
        (lo + (hi - lo) * (index as f64 / self.cells[axis] as f64)).min(hi)
    }

    /// The coordinates of a sample point.
    #[must_use]
    pub fn point(&self, index: [usize; 3]) -> [f64; 3] {
        std::array::from_fn(|d| self.coordinate(d, index[d]))
    }

    /// Leaves along each axis.
    #[must_use]
    pub fn leaves(&self) -> [usize; 3] {
        self.counts().map(|n| n.div_ceil(LEAF))
    }

    /// An estimate of the bytes that it takes to mesh an ordinary solid on this grid: as large as the space, without fine structure. What
    /// is larger is found out while it is made.
    #[must_use]
    pub fn estimated_bytes(&self) -> u64 {
        let [x, y, z] = self.cells.map(|n| n as u64);
        let leaves: u64 = self.leaves().iter().map(|&n| n as u64).product();
        // A ball that fills a cube has about 3 vertices per sample point of a face, a disc in a square 3 per point of a side.
        let vertices = if z == 0 { 2 * (x + y) } else { x * y + y * z + z * x };
        leaves * 4 + vertices * BYTES_PER_VERTEX as u64
    }
}

impl Lattice for Grid {
    fn counts(&self) -> [usize; 3] {
        self.cells.map(|n| n + 1)
    }

    fn leaf(&self) -> [usize; 3] {
        [LEAF; 3]
    }

    /// Tasks wait with their programs, so there must not be too many of them: at most 20 along a side.
    fn task(&self) -> [usize; 3] {
        let longest = self.counts().into_iter().fold(0, usize::max);
        let mut side = LEAF * 4;
        while side * 20 < longest {
            side *= 4;
        }
        [side; 3]
    }

    /// Reaches to the next sample point beyond the block on each axis, so that a decided block has no crossed edge or cell.
    fn bounds(&self, block: &Block, out: &mut [Interval]) {
        for (axis, bounds) in out.iter_mut().enumerate() {
            *bounds = span(self.coordinate(axis, block.from[axis]), self.coordinate(axis, block.to[axis]));
        }
    }

    fn tell(&self, to: &mut Digest) -> bool {
        to.shown(self);
        true
    }
}
