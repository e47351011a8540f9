//! Smooth functions of two arguments as sheets of uniform B-splines, quadratic (one continuous derivative) or cubic (two), bounded by their
//! coefficients.
//! Made from scattered values ([`scatter`]) and from pictures ([`height`]). Never reads a file.

mod front;
mod grid;
pub mod height;
pub mod scatter;

use std::sync::Arc;

use super::fingerprint::Fingerprint;
use super::pyramid::{Pyramid, Range};
use super::volume::{Placement, Samples, Volume};
use crate::number::{Interval, Leaf};

/// What a sum of sixteen products may err, as a part of the largest coefficient.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// Numbers over a grid, with their bounds over any part of it.
#[derive(Debug)]
struct Numbers {
    volume: Volume,
    pyramid: Pyramid,
    largest: f64,
}

impl Numbers {
    fn new(name: &str, [nx, ny]: [usize; 2], values: Vec<f64>) -> Self {
        let largest = values.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        let volume = Volume {
            name: name.to_owned(),
            dimension: 2,
            size: [nx, ny, 1],
            placement: Placement::default(),
            samples: Samples::Doubles(values),
        };
        Self { pyramid: Pyramid::new(&volume), volume, largest }
    }

    fn row(&self, first: usize, j: usize) -> &[f64] {
        match &self.volume.samples {
            Samples::Doubles(all) => &all[first + self.volume.size[0] * j..],
            _ => &[],
        }
    }

    /// Bounds of weighted means of the numbers with these indices, and of what is computed for them.
    fn range(&self, [x, y]: [(usize, usize); 2]) -> (f64, f64) {
        let Range { lo, hi, .. } = self.pyramid.range(&self.volume, [x.0, y.0, 0], [x.1, y.1, 0]);
        let room = ROUNDING * self.largest;
        (lo - room, hi + room)
    }
}

/// A sheet over a rectangle of `elements[0]` by `elements[1]` elements; beyond it the value is that of the nearest place of the rectangle.
#[derive(Debug)]
pub struct Sheet {
    degree: usize,
    elements: [usize; 2],
    /// The place of the first element's lower corner along each axis, and how many elements there are in a length of 1.
    origin: [f64; 2],
    inverse: [f64; 2],
    /// Where the rectangle begins and ends, in elements.
    domain: [[f64; 2]; 2],
    /// `elements + degree` along each axis.
    coefficients: Numbers,
    /// Their differences along each axis.
    differences: [Numbers; 2],
    fingerprint: u128,
}

/// Where a point falls on one axis.
struct Place {
    element: usize,
    t: f64,
    beyond: bool,
}

impl Sheet {
    /// A sheet whose first element begins at `origin`; `domain` is the part of it that counts, in elements.
    fn new(
        name: &str,
        degree: usize,
        elements: [usize; 2],
        origin: [f64; 2],
        inverse: [f64; 2],
        domain: [[f64; 2]; 2],
        coefficients: Vec<f64>,
    ) -> Arc<Self> {
        let [nx, ny] = elements.map(|n| n + degree);
        let mut hash = Fingerprint::new(0x7368_6565 + degree as u64);
        [nx, ny].iter().for_each(|&n| hash.add(n as u64));
        origin
            .iter()
            .chain(&inverse)
            .chain(domain.iter().flatten())
            .chain(&coefficients)
            .for_each(|v| hash.add(v.to_bits()));
        let at = |i: usize, j: usize| coefficients[i + nx * j];
        let along_x =
            (0..ny).flat_map(|j| (0..nx - 1).map(move |i| (i, j))).map(|(i, j)| at(i + 1, j) - at(i, j)).collect();
        let along_y =
            (0..ny - 1).flat_map(|j| (0..nx).map(move |i| (i, j))).map(|(i, j)| at(i, j + 1) - at(i, j)).collect();
        let differences = [Numbers::new(name, [nx - 1, ny], along_x), Numbers::new(name, [nx, ny - 1], along_y)];
        let coefficients = Numbers::new(name, [nx, ny], coefficients);
        Arc::new(Self {
            degree,
            elements,
            origin,
            inverse,
            domain,
            coefficients,
            differences,
            fingerprint: hash.value(),
        })
    }

    fn place(&self, axis: usize, at: f64) -> Place {
        let s = (at - self.origin[axis]) * self.inverse[axis];
        let [lo, hi] = self.domain[axis];
        let inner = s.clamp(lo, hi);
        let element = (inner as usize).min(self.elements[axis] - 1);
        Place { element, t: inner - element as f64, beyond: s < lo || s > hi }
    }

    /// The coefficients around a point, weighted along both axes.
    #[inline]
    fn sum(&self, [x, y]: [&Place; 2], wx: [f64; 4], wy: [f64; 4]) -> f64 {
        let mut sum = 0.0;
        for (j, wy) in wy.iter().enumerate().take(self.degree + 1) {
            let row = self.coefficients.row(x.element, y.element + j);
            let mut along = 0.0;
            for (wx, c) in wx.iter().zip(row).take(self.degree + 1) {
                along += wx * c;
            }
            sum += wy * along;
        }
        sum
    }

    /// The indices of the coefficients that count over an interval, and whether all of it lies beyond.
    fn over(&self, axis: usize, over: Interval) -> ((usize, usize), bool) {
        let (a, b) = (self.place(axis, over.lo), self.place(axis, over.hi));
        // Rounding may put a point into the element beside.
        let first = if a.t < 1e-9 { a.element.saturating_sub(1) } else { a.element };
        let last = if b.t > 1.0 - 1e-9 { (b.element + 1).min(self.elements[axis] - 1) } else { b.element };
        let outside = a.beyond && b.beyond && a.element == b.element && a.t == b.t;
        ((first, last + self.degree), outside)
    }
}

/// The B-splines that live on an element, `degree + 1` of them.
#[inline]
fn basis(degree: usize, t: f64) -> [f64; 4] {
    let (u, t2, t3) = (1.0 - t, t * t, t * t * t);
    match degree {
        2 => [0.5 * u * u, 0.5 + t - t2, 0.5 * t2, 0.0],
        _ => [u * u * u / 6.0, (3.0 * t3 - 6.0 * t2 + 4.0) / 6.0, (3.0 * (t + t2 - t3) + 1.0) / 6.0, t3 / 6.0],
    }
}

/// Their derivatives.
#[inline]
fn slopes(degree: usize, t: f64) -> [f64; 4] {
    let u = 1.0 - t;
    match degree {
        2 => [-u, 1.0 - 2.0 * t, t, 0.0],
        _ => [-0.5 * u * u, 1.5 * t * t - 2.0 * t, 0.5 + t - 1.5 * t * t, 0.5 * t * t],
    }
}

impl Leaf for Sheet {
    fn fingerprint(&self) -> u128 {
        self.fingerprint
    }

    fn name(&self) -> &str {
        &self.coefficients.volume.name
    }

    fn arity(&self) -> usize {
        2
    }

    fn value(&self, at: &[f64]) -> f64 {
        if at[0].is_nan() || at[1].is_nan() {
            return f64::NAN;
        }
        let [x, y] = [self.place(0, at[0]), self.place(1, at[1])];
        self.sum([&x, &y], basis(self.degree, x.t), basis(self.degree, y.t))
    }

    fn gradient(&self, at: &[f64], slope: &mut [f64]) -> f64 {
        slope.fill(f64::NAN);
        if at[0].is_nan() || at[1].is_nan() {
            return f64::NAN;
        }
        let [x, y] = [self.place(0, at[0]), self.place(1, at[1])];
        let (by_x, by_y) = (slopes(self.degree, x.t), slopes(self.degree, y.t));
        let by_x = self.sum([&x, &y], by_x, basis(self.degree, y.t));
        let by_y = self.sum([&x, &y], basis(self.degree, x.t), by_y);
        slope[0] = if x.beyond { 0.0 } else { by_x * self.inverse[0] };
        slope[1] = if y.beyond { 0.0 } else { by_y * self.inverse[1] };
        self.value(at)
    }

    fn bounds(&self, over: &[Interval]) -> Interval {
        if over[0].is_empty() || over[1].is_empty() {
            return Interval::EMPTY;
        }
        let (lo, hi) = self.coefficients.range([self.over(0, over[0]).0, self.over(1, over[1]).0]);
        Interval { lo, hi, undefined: over[0].undefined || over[1].undefined }
    }

    fn slope_bounds(&self, axis: usize, over: &[Interval]) -> Interval {
        if over[0].is_empty() || over[1].is_empty() {
            return Interval::EMPTY;
        }
        let undefined = over[0].undefined || over[1].undefined;
        let (mut places, outside) = ([self.over(0, over[0]).0, self.over(1, over[1]).0], self.over(axis, over[axis]).1);
        if outside {
            return Interval { lo: 0.0, hi: 0.0, undefined };
        }
        places[axis].1 -= 1;
        let (lo, hi) = self.differences[axis].range(places);
        let room = 4.0 * ROUNDING * self.coefficients.largest;
        let [inside_lo, inside_hi] = [lo - room, hi + room].map(|v| v * self.inverse[axis]);
        // Beyond the rectangle the slope is 0.
        Interval { lo: inside_lo.min(0.0), hi: inside_hi.max(0.0), undefined }
    }
}
