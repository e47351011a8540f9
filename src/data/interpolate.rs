//! A volume as a function of one to three world coordinates: nearest sample, trilinear (C0) or tricubic (C1, Catmull-Rom).
//!
//! Beyond the grid one added layer of cells falls linearly from the value at the border to the smallest value of the data, and it
//! stays there: with d the distance to the grid in cells along each axis, at most 1, the value is
//! `min + (1-d1)(1-d2)(1-d3) (border - min)`. So the function is finite wherever the samples are, and never reads a file.

use std::sync::Arc;

use super::error::DataError;
use super::fingerprint::Fingerprint;
use super::place::Locator;
use super::pyramid::{Pyramid, Range};
use super::volume::{Samples, Volume};
use crate::number::{Interval, Leaf};

/// How values between the samples are made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Interpolation {
    /// That of the nearest sample; halfway the one with the larger index.
    Nearest,
    /// Linear along each axis: continuous.
    Trilinear,
    /// Catmull-Rom along each axis, extended linearly at the borders: continuous with its derivative inside the grid. It may leave
    /// the range of the data by an eighth per axis.
    Tricubic,
}

impl Interpolation {
    /// The kinds by the names that the language has for them.
    pub const NAMES: [(&'static str, Self); 3] =
        [("nearest", Self::Nearest), ("trilinear", Self::Trilinear), ("tricubic", Self::Tricubic)];

    /// The kind of that name, in any case.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::NAMES.iter().find(|(known, _)| known.eq_ignore_ascii_case(name)).map(|&(_, kind)| kind)
    }
}

impl Volume {
    /// The volume as a function of its world coordinates, one for each axis.
    ///
    /// # Errors
    /// [`DataError::NoValues`] if no sample is finite; [`DataError::FlatGrid`] if the axes do not span the space.
    pub fn leaf(self: &Arc<Self>, kind: Interpolation) -> Result<Arc<dyn Leaf>, DataError> {
        Ok(Arc::new(Field::new(self.clone(), kind)?))
    }
}

/// A volume with all that makes it a function.
#[derive(Debug)]
struct Field {
    volume: Arc<Volume>,
    kind: Interpolation,
    locator: Locator,
    pyramid: Pyramid,
    /// The smallest value of the data: what lies far outside.
    floor: f64,
    fingerprint: u128,
}

/// Where a point falls on one axis.
#[derive(Clone, Copy)]
struct Place {
    /// Index within the grid, 0 ..= n - 1.
    inner: f64,
    /// How much of the border's value is left: 1 within the grid, 0 from one cell beyond.
    keep: f64,
    /// Derivative of `keep` by the index.
    keep_slope: f64,
}

impl Place {
    fn new(index: f64, count: usize) -> Self {
        let last = count as f64 - 1.0;
        let inner = index.clamp(0.0, last);
        let beyond = (index - inner).abs();
        let (keep, keep_slope) = match beyond {
            0.0 => (1.0, 0.0),
            d if d < 1.0 => (1.0 - d, if index < 0.0 { 1.0 } else { -1.0 }),
            _ => (0.0, 0.0),
        };
        Self { inner, keep, keep_slope }
    }
}

/// Up to four samples along one axis with their weights and the derivatives of these by the index.
struct Weights {
    first: usize,
    count: usize,
    weight: [f64; 4],
    slope: [f64; 4],
}

impl Field {
    fn new(volume: Arc<Volume>, kind: Interpolation) -> Result<Self, DataError> {
        let locator = Locator::new(&volume.placement, volume.dimension).ok_or(DataError::FlatGrid)?;
        let pyramid = Pyramid::new(&volume);
        let floor = pyramid.whole().lo;
        if floor.is_infinite() {
            return Err(DataError::NoValues);
        }
        let fingerprint = fingerprint(&volume, kind);
        Ok(Self { volume, kind, locator, pyramid, floor, fingerprint })
    }

    fn places(&self, index: [f64; 3]) -> [Place; 3] {
        std::array::from_fn(|axis| Place::new(index[axis], self.volume.size[axis]))
    }

    fn sample(&self, index: [usize; 3]) -> f64 {
        let [nx, ny, _] = self.volume.size;
        self.volume.samples.get(index[0] + nx * (index[1] + ny * index[2]))
    }

    /// The value at fractional indices that are numbers.
    fn at(&self, index: [f64; 3]) -> f64 {
        let places = self.places(index);
        let keep = places[0].keep * places[1].keep * places[2].keep;
        if keep == 0.0 {
            return self.floor;
        }
        let inner = self.within(places.map(|p| p.inner));
        if keep == 1.0 { inner } else { self.floor + keep * (inner - self.floor) }
    }

    /// The interpolation itself, within the grid.
    fn within(&self, index: [f64; 3]) -> f64 {
        match self.kind {
            Interpolation::Nearest => self.sample(index.map(nearest)),
            Interpolation::Trilinear => self.trilinear(index),
            Interpolation::Tricubic => self.tricubic(index),
        }
    }

    fn trilinear(&self, index: [f64; 3]) -> f64 {
        let cells: [(usize, usize, f64); 3] = std::array::from_fn(|axis| cell(index[axis], self.volume.size[axis]));
        let [(i0, i1, tx), (j0, j1, ty), (k0, k1, tz)] = cells;
        let row = |j: usize, k: usize| mix(self.sample([i0, j, k]), self.sample([i1, j, k]), tx);
        let plane = |k: usize| if j1 == j0 { row(j0, k) } else { mix(row(j0, k), row(j1, k), ty) };
        if k1 == k0 { plane(k0) } else { mix(plane(k0), plane(k1), tz) }
    }

    /// The value of [`Field::tensor`], to the bit.
    fn tricubic(&self, index: [f64; 3]) -> f64 {
        let [wx, wy, wz] = std::array::from_fn(|axis| self.weights(index[axis], self.volume.size[axis]));
        let along =
            |w: &Weights, get: &dyn Fn(usize) -> f64| (0..w.count).fold(0.0, |sum, i| sum + w.weight[i] * get(i));
        let row = |j: usize, k: usize| along(&wx, &|i| self.sample([wx.first + i, wy.first + j, wz.first + k]));
        along(&wz, &|k| along(&wy, &|j| row(j, k)))
    }

    /// Value and derivatives by the indices, as a sum over the samples around.
    fn tensor(&self, index: [f64; 3]) -> (f64, [f64; 3]) {
        let [wx, wy, wz] = std::array::from_fn(|axis| self.weights(index[axis], self.volume.size[axis]));
        let (mut value, mut slope) = (0.0, [0.0; 3]);
        for k in 0..wz.count {
            let (mut plane, mut plane_x, mut plane_y) = (0.0, 0.0, 0.0);
            for j in 0..wy.count {
                let (mut row, mut row_x) = (0.0, 0.0);
                for i in 0..wx.count {
                    let sample = self.sample([wx.first + i, wy.first + j, wz.first + k]);
                    row += wx.weight[i] * sample;
                    row_x += wx.slope[i] * sample;
                }
                plane += wy.weight[j] * row;
                plane_x += wy.weight[j] * row_x;
                plane_y += wy.slope[j] * row;
            }
            value += wz.weight[k] * plane;
            slope[0] += wz.weight[k] * plane_x;
            slope[1] += wz.weight[k] * plane_y;
            slope[2] += wz.slope[k] * plane;
        }
        (value, slope)
    }

    fn weights(&self, index: f64, count: usize) -> Weights {
        let (i0, i1, t) = cell(index, count);
        if i0 == i1 {
            return Weights { first: i0, count: 1, weight: [1.0, 0.0, 0.0, 0.0], slope: [0.0; 4] };
        }
        match self.kind {
            Interpolation::Nearest => {
                Weights { first: nearest(index), count: 1, weight: [1.0, 0.0, 0.0, 0.0], slope: [0.0; 4] }
            }
            Interpolation::Trilinear => {
                Weights { first: i0, count: 2, weight: [1.0 - t, t, 0.0, 0.0], slope: [-1.0, 1.0, 0.0, 0.0] }
            }
            Interpolation::Tricubic => cubic(i0, t, count),
        }
    }

    /// Bounds from the values at the corners of the cells: between them the function is linear in each index, so the corners of
    /// the pieces of the box hold its extremes. `None` if there are too many pieces or the interpolation is not linear.
    fn corners(&self, over: [(f64, f64); 3]) -> Option<Range> {
        if self.kind != Interpolation::Trilinear {
            return None;
        }
        let mut stops = [[0.0; 5]; 3];
        let mut counts = [0; 3];
        for axis in 0..3 {
            counts[axis] = breaks(over[axis], self.volume.size[axis], &mut stops[axis])?;
        }
        if counts.iter().product::<usize>() > 64 {
            return None;
        }
        let mut all = Range { lo: f64::INFINITY, hi: f64::NEG_INFINITY, undefined: false };
        for &z in &stops[2][..counts[2]] {
            for &y in &stops[1][..counts[1]] {
                for &x in &stops[0][..counts[0]] {
                    let value = self.at([x, y, z]);
                    if value.is_nan() {
                        return None;
                    }
                    all.lo = all.lo.min(value);
                    all.hi = all.hi.max(value);
                }
            }
        }
        Some(all)
    }

    /// Bounds from all samples that take part.
    fn samples_over(&self, over: [(f64, f64); 3]) -> Range {
        let reach = if self.kind == Interpolation::Tricubic { 1.0 } else { 0.0 };
        let (mut lo, mut hi) = ([0; 3], [0; 3]);
        let (mut leaves, mut far) = (false, false);
        for axis in 0..3 {
            let last = self.volume.size[axis] as f64 - 1.0;
            let (a, b) = over[axis];
            leaves |= a < 0.0 || b > last;
            far |= b <= -1.0 || a >= last + 1.0;
            lo[axis] = (a.floor() - reach).clamp(0.0, last) as usize;
            hi[axis] = (b.floor() + 1.0 + reach).clamp(0.0, last) as usize;
        }
        if far {
            return Range { lo: self.floor, hi: self.floor, undefined: false };
        }
        let mut range = self.pyramid.range(&self.volume, lo, hi);
        if self.kind == Interpolation::Tricubic && range.lo < range.hi {
            // The absolute weights of Catmull-Rom add up to 1.25 at most, so those of three axes to 1.953125.
            let (middle, radius) = (0.5 * range.lo + 0.5 * range.hi, 0.5 * range.hi - 0.5 * range.lo);
            (range.lo, range.hi) = (middle - 1.954 * radius, middle + 1.954 * radius);
        }
        if leaves {
            range.lo = range.lo.min(self.floor);
            range.hi = range.hi.max(self.floor);
        }
        range
    }
}

impl Leaf for Field {
    fn fingerprint(&self) -> u128 {
        self.fingerprint
    }

    fn name(&self) -> &str {
        &self.volume.name
    }

    fn arity(&self) -> usize {
        self.volume.dimension
    }

    fn value(&self, at: &[f64]) -> f64 {
        let index = self.locator.index(at);
        if index.iter().any(|i| i.is_nan()) { f64::NAN } else { self.at(index) }
    }

    fn gradient(&self, at: &[f64], slope: &mut [f64]) -> f64 {
        let index = self.locator.index(at);
        if index.iter().any(|i| i.is_nan()) {
            slope.fill(f64::NAN);
            return f64::NAN;
        }
        let places = self.places(index);
        let keep = places[0].keep * places[1].keep * places[2].keep;
        if keep == 0.0 {
            slope.fill(0.0);
            return self.floor;
        }
        let (inner, inner_slope) = self.tensor(places.map(|p| p.inner));
        let by_index = std::array::from_fn(|axis| {
            let p = places[axis];
            if p.keep_slope == 0.0 {
                return keep * inner_slope[axis];
            }
            keep / p.keep * p.keep_slope * (inner - self.floor)
        });
        self.locator.slope(by_index, slope);
        self.at(index)
    }

    fn bounds(&self, over: &[Interval]) -> Interval {
        let unknown = over.iter().any(|i| i.undefined);
        if over.iter().any(|i| i.lo > i.hi) {
            return Interval { lo: f64::INFINITY, hi: f64::NEG_INFINITY, undefined: true };
        }
        let index = self.locator.indices(over);
        if index.iter().any(|(a, b)| a.is_nan() || b.is_nan()) {
            return Interval { lo: f64::NEG_INFINITY, hi: f64::INFINITY, undefined: true };
        }
        let range = self.corners(index).unwrap_or_else(|| self.samples_over(index));
        let exact = range.lo == range.hi && self.kind != Interpolation::Tricubic;
        widen(range, self.pyramid.whole(), exact, unknown)
    }
}

/// Makes room for the rounding of the value's own computation: each of its few steps errs by at most half a unit of the largest
/// number around; where they are all equal, mixing them is exact.
fn widen(range: Range, whole: Range, exact: bool, unknown: bool) -> Interval {
    let undefined = range.undefined || unknown;
    if exact || range.lo > range.hi {
        return Interval { lo: range.lo, hi: range.hi, undefined };
    }
    let room = 64.0 * f64::EPSILON * whole.lo.abs().max(whole.hi.abs());
    let (lo, hi) = (range.lo - room, range.hi + room);
    // Sums of samples near the end of the doubles may overflow, and their differences then are undefined.
    let overflow = !(whole.hi - whole.lo).is_finite();
    if overflow || !lo.is_finite() || !hi.is_finite() {
        return Interval { lo: f64::NEG_INFINITY, hi: f64::INFINITY, undefined: undefined || overflow };
    }
    Interval { lo, hi, undefined }
}

/// `a` at 0, `b` at 1, constant where they are equal, and monotone in t.
#[inline]
fn mix(a: f64, b: f64, t: f64) -> f64 {
    a + t * (b - a)
}

/// The two neighbours of an index of the grid and the place between them; one neighbour twice on an axis of one sample.
#[inline]
fn cell(index: f64, count: usize) -> (usize, usize, f64) {
    let low = (index as usize).min(count.saturating_sub(2));
    (low, (low + 1).min(count - 1), index - low as f64)
}

/// The nearest sample of an index of the grid.
fn nearest(index: f64) -> usize {
    (index + 0.5) as usize
}

/// Catmull-Rom weights; the sample before the first is `2 s0 - s1`, and so at the end.
fn cubic(low: usize, t: f64, count: usize) -> Weights {
    let (t2, t3) = (t * t, t * t * t);
    let w = [
        0.5 * (2.0 * t2 - t3 - t),
        0.5 * (3.0 * t3 - 5.0 * t2 + 2.0),
        0.5 * (4.0 * t2 - 3.0 * t3 + t),
        0.5 * (t3 - t2),
    ];
    let s = [
        0.5 * (4.0 * t - 3.0 * t2 - 1.0),
        0.5 * (9.0 * t2 - 10.0 * t),
        0.5 * (8.0 * t - 9.0 * t2 + 1.0),
        0.5 * (3.0 * t2 - 2.0 * t),
    ];
    let mut all = Weights { first: low.saturating_sub(1), count: 0, weight: [0.0; 4], slope: [0.0; 4] };
    let last = (low + 2).min(count - 1);
    all.count = last - all.first + 1;
    for (offset, (w, s)) in w.into_iter().zip(s).enumerate() {
        let mut add = |index: usize, factor: f64| {
            all.weight[index - all.first] += factor * w;
            all.slope[index - all.first] += factor * s;
        };
        match (low + offset).checked_sub(1) {
            None => {
                add(0, 2.0);
                add(1, -1.0);
            }
            Some(index) if index >= count => {
                add(count - 1, 2.0);
                add(count - 2, -1.0);
            }
            Some(index) => add(index, 1.0),
        }
    }
    all
}

/// The ends of an interval of indices and the whole numbers between them at which the function bends; how many, if at most five.
fn breaks((lo, hi): (f64, f64), count: usize, stops: &mut [f64; 5]) -> Option<usize> {
    let (lo, hi) = (lo.clamp(-1.0, count as f64), hi.clamp(-1.0, count as f64));
    stops[0] = lo;
    let mut filled = 1;
    let mut next = lo.floor() + 1.0;
    while next < hi {
        *stops.get_mut(filled)? = next;
        filled += 1;
        next += 1.0;
    }
    if hi > lo {
        *stops.get_mut(filled)? = hi;
        filled += 1;
    }
    Some(filled)
}

/// A hash of the kind, the size, the place and the samples.
fn fingerprint(volume: &Volume, kind: Interpolation) -> u128 {
    let mut hash = Fingerprint::new(kind as u64);
    volume.size.iter().for_each(|&n| hash.add(n as u64));
    let place = &volume.placement;
    place.origin.iter().chain(place.directions.iter().flatten()).for_each(|v| hash.add(v.to_bits()));
    match &volume.samples {
        Samples::Bytes(all) => {
            all.chunks(8).for_each(|chunk| hash.add(chunk.iter().fold(0, |word, &b| word << 8 | u64::from(b))));
        }
        Samples::Singles(all) => all.iter().for_each(|v| hash.add(u64::from(v.to_bits()))),
        Samples::Doubles(all) => all.iter().for_each(|v| hash.add(v.to_bits())),
    }
    hash.value()
}
