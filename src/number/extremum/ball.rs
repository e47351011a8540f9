//! The highest value of a function in a closed ball of two or more dimensions, and bounds of it.
//!
//! A pattern search from the best of many starts: from where it is, it looks in many directions, at two distances, and goes on
//! with the highest; where there is none it looks nearer by. What lies beyond the ball is drawn to its boundary.

use super::AT_ONCE;
use crate::number::{Binary, Interval};

/// What the search asks of a function of several variables, about the centre of the ball.
pub trait Ball {
    /// Values at these steps from the centre, one slice per variable, of at most 2 [`AT_ONCE`] numbers.
    fn values(&mut self, steps: &[Vec<f64>], values: &mut [f64]);
    /// Ranges of the values over these steps, one slice per variable, of at most [`AT_ONCE`] intervals.
    fn ranges(&mut self, steps: &[Vec<Interval>], values: &mut [Interval]);
}

/// Starts from which the search goes on.
const CLIMBS: usize = 3;
/// Looks of one climb at most.
const LOOKS: usize = 200;
/// Parts of the radius at which a climb ends.
const NEAREST: f64 = 1e-10;

/// Directions to look in: at most [`AT_ONCE`] unit vectors, evenly spread in two and three dimensions.
#[must_use]
pub fn directions(dimension: usize) -> Vec<Vec<f64>> {
    let mut all: Vec<Vec<f64>> = Vec::new();
    let unit = |v: Vec<f64>| {
        let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
        v.into_iter().map(|x| x / length).collect::<Vec<f64>>()
    };
    if dimension <= 3 {
        // The faces, edges and corners of a cube; in the plane also what lies between.
        let steps: &[f64] = if dimension == 2 { &[-2.0, -1.0, 0.0, 1.0, 2.0] } else { &[-1.0, 0.0, 1.0] };
        let count = steps.len().pow(u32::try_from(dimension).unwrap_or(3));
        for i in 0..count {
            let v: Vec<f64> =
                (0..dimension).map(|k| steps[i / steps.len().pow(u32::try_from(k).unwrap_or(0)) % steps.len()]).collect();
            let rim = v.iter().any(|x| x.abs() == steps[steps.len() - 1]);
            if rim {
                all.push(unit(v));
            }
        }
        return all;
    }
    for k in 0..dimension {
        for sign in [1.0, -1.0] {
            all.push((0..dimension).map(|i| if i == k { sign } else { 0.0 }).collect());
        }
    }
    // The rest is scattered, the same every time, each with its opposite.
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    let mut next = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        #[allow(clippy::cast_precision_loss)]
        let value = (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0;
        value
    };
    while all.len() + 2 <= AT_ONCE - 2 {
        let v = unit((0..dimension).map(|_| next()).collect());
        all.push(v.iter().map(|x| -x).collect());
        all.push(v);
    }
    all
}

/// The steps from the centre to where the function is highest in the ball; NaN where the radius is undefined or infinite.
pub fn highest<B: Ball + ?Sized>(ball: &mut B, dimension: usize, radius: f64, directions: &[Vec<f64>]) -> Vec<f64> {
    if !radius.is_finite() {
        return vec![f64::NAN; dimension];
    }
    let centre = vec![0.0; dimension];
    if radius <= 0.0 {
        return centre;
    }
    let mut starts: Vec<Vec<f64>> = vec![centre];
    for scale in [radius, 0.5 * radius] {
        starts.extend(directions.iter().map(|d| d.iter().map(|x| scale * x).collect()));
    }
    let values = ask(ball, dimension, &starts);
    let mut order: Vec<usize> = (0..starts.len()).collect();
    let rank = |v: f64| if v.is_nan() { f64::NEG_INFINITY } else { v };
    order.sort_by(|&i, &j| rank(values[j]).total_cmp(&rank(values[i])).then(i.cmp(&j)));
    let (mut best, mut top) = (starts[order[0]].clone(), values[order[0]]);
    for &i in order.iter().take(CLIMBS).filter(|i| !values[**i].is_nan()) {
        let (at, value) = climb(ball, radius, directions, (starts[i].clone(), values[i]));
        if value > top || top.is_nan() {
            (best, top) = (at, value);
        }
    }
    best
}

/// Values at any number of places.
fn ask<B: Ball + ?Sized>(ball: &mut B, dimension: usize, places: &[Vec<f64>]) -> Vec<f64> {
    let mut values = vec![0.0; places.len()];
    for (places, values) in places.chunks(2 * AT_ONCE).zip(values.chunks_mut(2 * AT_ONCE)) {
        let steps: Vec<Vec<f64>> = (0..dimension).map(|k| places.iter().map(|p| p[k]).collect()).collect();
        ball.values(&steps, values);
    }
    values
}

fn climb<B: Ball + ?Sized>(
    ball: &mut B,
    radius: f64,
    directions: &[Vec<f64>],
    (mut at, mut value): (Vec<f64>, f64),
) -> (Vec<f64>, f64) {
    let mut reach = 0.25 * radius;
    for _ in 0..LOOKS {
        let mut places: Vec<Vec<f64>> = Vec::with_capacity(2 * directions.len());
        for scale in [reach, 0.3 * reach] {
            places.extend(directions.iter().map(|d| {
                let step: Vec<f64> = at.iter().zip(d).map(|(a, d)| a + scale * d).collect();
                within(step, radius)
            }));
        }
        let values = ask(ball, at.len(), &places);
        let mut found = None;
        for (i, v) in values.iter().enumerate() {
            if *v > value {
                value = *v;
                found = Some(i);
            }
        }
        match found {
            Some(i) => {
                at.clone_from(&places[i]);
                if i >= directions.len() {
                    reach *= 0.6;
                }
            }
            None => reach *= 0.1,
        }
        if reach < NEAREST * radius {
            break;
        }
    }
    (at, value)
}

/// The step, drawn to the boundary if it leads out of the ball.
fn within(step: Vec<f64>, radius: f64) -> Vec<f64> {
    let length = step.iter().fold(0.0, |all, x| Binary::Hypot.real(all, *x));
    if length <= radius {
        return step;
    }
    let scale = radius / length;
    step.into_iter().map(|x| x * scale).collect()
}

/// Over a box of centres: the range of the highest value, and of the steps to it.
pub fn bounds<B: Ball + ?Sized>(
    ball: &mut B,
    dimension: usize,
    radius: Interval,
    directions: &[Vec<f64>],
) -> (Interval, Interval) {
    if radius.is_empty() {
        return (Interval::EMPTY, Interval::EMPTY);
    }
    if !radius.hi.is_finite() || !radius.lo.is_finite() {
        return (Interval::WHOLE.or_undefined(true), Interval::WHOLE.or_undefined(true));
    }
    let outer = radius.hi.max(0.0);
    // Drawing to the boundary may leave the ball by rounding.
    let reach = outer * (1.0 + 1e-15);
    let step = Interval::new(-reach, reach).or_undefined(radius.undefined);
    let radius_or_none = radius.clip(0.0, f64::INFINITY);
    let radius_or_none = if radius_or_none.is_empty() { Interval::point(0.0) } else { radius_or_none };
    // Below: it is no less than at each start of the search.
    let rows: Vec<&Vec<f64>> = directions.iter().take(AT_ONCE - 1).collect();
    let starts: Vec<Vec<Interval>> = (0..dimension)
        .map(|k| {
            let moved = rows.iter().map(|d| Binary::Mul.interval(radius_or_none, Interval::point(d[k])));
            moved.chain([Interval::point(0.0)]).map(|i| i.or_undefined(false)).collect()
        })
        .collect();
    let mut values = [Interval::EMPTY; AT_ONCE];
    let count = rows.len() + 1;
    ball.ranges(&starts, &mut values[..count]);
    let defined = values[..count].iter().filter(|v| !v.undefined);
    let floor = defined.clone().map(|v| v.lo).fold(f64::NEG_INFINITY, f64::max);
    let undefined = defined.count() == 0;
    // Above: no more than over all cells that touch the ball; those that reach the floor are cut again.
    let mut cells: Vec<Vec<Interval>> = vec![vec![step; dimension]];
    let (mut top, mut low) = (f64::NEG_INFINITY, f64::INFINITY);
    for _ in 0..6 {
        let mut cut = 1;
        while cells.len() * (cut + 1_usize).saturating_pow(u32::try_from(dimension).unwrap_or(u32::MAX)) <= AT_ONCE {
            cut += 1;
        }
        if cut == 1 && top > f64::NEG_INFINITY {
            break;
        }
        cells = cells.iter().flat_map(|cell| pieces(cell, cut)).filter(|cell| touches(cell, reach)).collect();
        cells.truncate(AT_ONCE);
        let steps: Vec<Vec<Interval>> = (0..dimension).map(|k| cells.iter().map(|c| c[k]).collect()).collect();
        let count = cells.len();
        ball.ranges(&steps, &mut values[..count]);
        (top, low) = (f64::NEG_INFINITY, f64::INFINITY);
        let mut keep = vec![false; count];
        for (value, keep) in values[..count].iter().zip(&mut keep) {
            if !value.is_empty() && value.hi >= floor {
                top = top.max(value.hi);
                low = low.min(value.lo);
                *keep = true;
            }
        }
        let mut keep = keep.into_iter();
        cells.retain(|_| keep.next() == Some(true));
        if cells.is_empty() {
            break;
        }
    }
    if low > top && floor == f64::NEG_INFINITY {
        return (Interval::EMPTY, step);
    }
    let bottom = if undefined { low } else { floor.max(low) };
    (Interval::new(bottom, top.max(bottom)).or_undefined(undefined || radius.undefined), step)
}

/// A cell cut into `cut` parts along each axis.
fn pieces(cell: &[Interval], cut: usize) -> Vec<Vec<Interval>> {
    let mut all: Vec<Vec<Interval>> = vec![Vec::new()];
    for side in cell {
        #[allow(clippy::cast_precision_loss)]
        let at = |i: usize| if i == cut { side.hi } else { side.lo + (side.hi - side.lo) * (i as f64 / cut as f64) };
        all = all
            .into_iter()
            .flat_map(|first| {
                (0..cut).map(move |i| {
                    let mut cell = first.clone();
                    cell.push(Interval::new(at(i), at(i + 1)));
                    cell
                })
            })
            .collect();
    }
    all
}

/// Whether a cell has a place within the radius of the centre.
fn touches(cell: &[Interval], radius: f64) -> bool {
    let square: f64 = cell.iter().map(|side| side.smallest() * side.smallest()).sum();
    square <= radius * radius * (1.0 + 1e-12)
}
