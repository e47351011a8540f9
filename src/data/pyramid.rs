//! Smallest and largest sample over any box of indices, from a pyramid of blocks. Holds summaries only; the samples stay in the volume.

use super::volume::Volume;

/// The samples of a box of indices.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// The smallest defined one; `+inf` if there is none.
    pub lo: f64,
    /// The largest defined one; `-inf` if there is none.
    pub hi: f64,
    /// Whether one is undefined.
    pub undefined: bool,
}

impl Range {
    const EMPTY: Self = Self { lo: f64::INFINITY, hi: f64::NEG_INFINITY, undefined: false };

    fn join(self, other: Self) -> Self {
        Self { lo: self.lo.min(other.lo), hi: self.hi.max(other.hi), undefined: self.undefined || other.undefined }
    }

    fn one(value: f64) -> Self {
        if value.is_nan() {
            Self { undefined: true, ..Self::EMPTY }
        } else {
            Self { lo: value, hi: value, undefined: false }
        }
    }
}

/// Side of the blocks of the lowest level: 64 samples share one summary, which costs 3/8 of a byte per sample.
const BLOCK: usize = 4;

/// A box with at most this many cells along an axis is looked at directly; a larger one goes up a level.
const DIRECT: usize = 5;

#[derive(Clone, Debug)]
struct Level {
    size: [usize; 3],
    ranges: Vec<Range>,
}

/// The pyramid over one volume.
#[derive(Clone, Debug)]
pub struct Pyramid {
    levels: Vec<Level>,
}

impl Pyramid {
    /// Reads each sample once.
    #[must_use]
    pub fn new(volume: &Volume) -> Self {
        let mut levels = vec![reduce(volume.size, BLOCK, |index| Range::one(volume.samples.get(index)))];
        while let Some(last) = levels.last().filter(|level| level.ranges.len() > 1) {
            let next = reduce(last.size, 2, |index| last.ranges[index]);
            levels.push(next);
        }
        Self { levels }
    }

    /// All samples.
    #[must_use]
    pub fn whole(&self) -> Range {
        self.levels.last().map_or(Range::EMPTY, |level| level.ranges[0])
    }

    /// The samples with indices `lo..=hi` on each axis, perhaps with some of their neighbours. The indices must lie in the grid.
    #[must_use]
    pub fn range(&self, volume: &Volume, lo: [usize; 3], hi: [usize; 3]) -> Range {
        if narrow(lo, hi) {
            return fold(volume.size, lo, hi, |index| Range::one(volume.samples.get(index)));
        }
        let (mut lo, mut hi) = (lo.map(|i| i / BLOCK), hi.map(|i| i / BLOCK));
        let mut level = 0;
        while !narrow(lo, hi) && level + 1 < self.levels.len() {
            (lo, hi) = (lo.map(|i| i / 2), hi.map(|i| i / 2));
            level += 1;
        }
        let level = &self.levels[level];
        fold(level.size, lo, hi, |index| level.ranges[index])
    }
}

fn narrow(lo: [usize; 3], hi: [usize; 3]) -> bool {
    (0..3).all(|k| hi[k] - lo[k] < DIRECT)
}

/// One level up: blocks of `side` cells along each axis.
fn reduce(size: [usize; 3], side: usize, get: impl Fn(usize) -> Range) -> Level {
    let up = size.map(|n| n.div_ceil(side));
    let mut ranges = Vec::with_capacity(up.iter().product());
    for k in 0..up[2] {
        for j in 0..up[1] {
            for i in 0..up[0] {
                let lo = [i * side, j * side, k * side];
                let hi = std::array::from_fn(|axis| (lo[axis] + side).min(size[axis]) - 1);
                ranges.push(fold(size, lo, hi, &get));
            }
        }
    }
    Level { size: up, ranges }
}

fn fold(size: [usize; 3], lo: [usize; 3], hi: [usize; 3], get: impl Fn(usize) -> Range) -> Range {
    let mut all = Range::EMPTY;
    for k in lo[2]..=hi[2] {
        for j in lo[1]..=hi[1] {
            let row = size[0] * (j + size[1] * k);
            for i in lo[0]..=hi[0] {
                all = all.join(get(row + i));
            }
        }
    }
    all
}
