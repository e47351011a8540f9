//! The 256 colours that stand for those of some pictures: cut by variance, then moved to the means of what they stand for.
//!
//! No dithering: flat and softly shaded faces stay calm from frame to frame. The same pictures give the same colours.

use rustc_hash::FxHashMap;

use crate::picture::Image;

/// Distinct colours that are looked at one by one; beyond, they are counted in cells of 8 x 8 x 8.
const DISTINCT: usize = 1 << 16;

/// Rounds of moving each colour to the mean of those that it stands for.
const ROUNDS: usize = 4;

/// How often each colour occurs.
#[derive(Clone, Debug, Default)]
pub struct Histogram {
    counts: FxHashMap<[u8; 3], u64>,
    coarse: bool,
}

impl Histogram {
    /// Counts the pixels of a picture.
    pub fn add(&mut self, image: &Image) {
        for pixel in image.rgba.chunks_exact(4) {
            let colour = self.cell([pixel[0], pixel[1], pixel[2]]);
            *self.counts.entry(colour).or_default() += 1;
            if self.counts.len() > DISTINCT && !self.coarse {
                self.coarse = true;
                let fine = std::mem::take(&mut self.counts);
                for (colour, count) in fine {
                    *self.counts.entry(self.cell(colour)).or_default() += count;
                }
            }
        }
    }

    fn cell(&self, colour: [u8; 3]) -> [u8; 3] {
        if self.coarse { colour.map(|c| c & 0xf8 | c >> 5) } else { colour }
    }

    /// At most `limit` colours that stand for all that were counted.
    #[must_use]
    pub fn palette(&self, limit: usize) -> Palette {
        let mut all: Vec<_> = self.counts.iter().map(|(&colour, &count)| (colour, count)).collect();
        all.sort_unstable();
        let mut palette = Palette { colours: cut(&mut all, limit.max(1)) };
        for _ in 0..if all.len() > limit { ROUNDS } else { 0 } {
            palette.settle(&all);
        }
        palette
    }
}

/// A few colours.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Palette {
    /// The colours; not empty.
    pub colours: Vec<[u8; 3]>,
}

impl Palette {
    /// The number of the colour nearest to `colour`, the first of equal ones.
    #[must_use]
    pub fn nearest(&self, colour: [u8; 3]) -> usize {
        let distance = |&(_, c): &(usize, &[u8; 3])| (0..3).map(|k| square(c[k].abs_diff(colour[k]))).sum::<u32>();
        self.colours.iter().enumerate().min_by_key(distance).map_or(0, |(index, _)| index)
    }

    /// One byte for each pixel: the number of the nearest colour.
    #[must_use]
    pub fn indices(&self, image: &Image) -> Vec<u8> {
        let mut known: FxHashMap<[u8; 3], u8> = FxHashMap::default();
        let colours = image.rgba.chunks_exact(4).map(|pixel| [pixel[0], pixel[1], pixel[2]]);
        colours.map(|colour| *known.entry(colour).or_insert_with(|| self.nearest(colour) as u8)).collect()
    }

    /// Moves each colour to the mean of those that it stands for.
    fn settle(&mut self, all: &[([u8; 3], u64)]) {
        let mut sums = vec![([0_u64; 3], 0_u64); self.colours.len()];
        for &(colour, count) in all {
            let (sum, total) = &mut sums[self.nearest(colour)];
            (0..3).for_each(|k| sum[k] += u64::from(colour[k]) * count);
            *total += count;
        }
        for (colour, (sum, total)) in self.colours.iter_mut().zip(sums).filter(|(_, (_, total))| *total > 0) {
            *colour = sum.map(|s| ((s + total / 2) / total) as u8);
        }
    }
}

fn square(v: u8) -> u32 {
    u32::from(v) * u32::from(v)
}

/// A part of the colours that one will stand for.
struct Part {
    from: usize,
    to: usize,
    /// Sum of squared distances from the mean along the channel where it is largest.
    spread: f64,
    channel: usize,
    mean: [f64; 3],
}

impl Part {
    fn new(all: &[([u8; 3], u64)], from: usize, to: usize) -> Self {
        let total: f64 = all[from..to].iter().map(|&(_, n)| n as f64).sum();
        let sum = |f: &dyn Fn([u8; 3]) -> f64| all[from..to].iter().map(|&(c, n)| f(c) * n as f64).sum::<f64>();
        let mean: [f64; 3] = std::array::from_fn(|k| sum(&|c| f64::from(c[k])) / total.max(1.0));
        let spreads: [f64; 3] = std::array::from_fn(|k| sum(&|c| (f64::from(c[k]) - mean[k]).powi(2)));
        let channel = (0..3).max_by(|&a, &b| spreads[a].total_cmp(&spreads[b])).unwrap_or(0);
        Self { from, to, spread: spreads[channel], channel, mean }
    }
}

/// Splits the part of the largest spread at its mean until there are enough parts; their means.
fn cut(all: &mut [([u8; 3], u64)], limit: usize) -> Vec<[u8; 3]> {
    let mut parts = vec![Part::new(all, 0, all.len())];
    while parts.len() < limit {
        let Some(widest) = (0..parts.len()).max_by(|&a, &b| parts[a].spread.total_cmp(&parts[b].spread)) else { break };
        let Part { from, to, spread, channel, mean } = parts[widest];
        if spread <= 0.0 {
            break;
        }
        all[from..to].sort_unstable_by_key(|&(c, n)| (c[channel], c, n));
        let middle = from + all[from..to].partition_point(|(c, _)| f64::from(c[channel]) <= mean[channel]);
        parts[widest] = Part::new(all, from, middle);
        parts.push(Part::new(all, middle, to));
    }
    parts.iter().map(|part| part.mean.map(|v| v.round() as u8)).collect()
}
