//! What a grid is too coarse to show: parts and holes between its sample points, and parts without thickness. It looks only where intervals
//! leave room for something, and tells only what it has seen: a point of the other sign, with none among the sample points about it.

use super::grid::Grid;
use super::sampler::Sampler;
use crate::interrupt::Interrupt;
use crate::vm::{Program, Shape};

/// Steps towards a part that may be there.
const STEPS: usize = 8;
/// Sample points on each side of a detail that must all have the other sign.
const AROUND: usize = 3;
/// Details that are told of; one is enough to make somebody look.
const MOST: usize = 4;

/// What is not shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Some of the object, with no sample point in it.
    Part,
    /// A hole in it, with no sample point in it.
    Hole,
    /// Some of it where the function is 0 and no more: it has no thickness, and the mesh makes it up.
    Sheet,
}

/// A detail that the grid does not show.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Detail {
    /// What it is.
    pub kind: Kind,
    /// A point of it; in a plane, the last coordinate is 0.
    pub place: [f64; 3],
    /// How wide it is there, about; 0 for a sheet.
    pub width: f64,
}

/// The evaluated points of a leaf, x fastest.
pub(super) struct Points<'a> {
    pub(super) grid: &'a Grid,
    /// Index of the first point.
    pub(super) from: [usize; 3],
    /// Points along each side.
    pub(super) side: [usize; 3],
    pub(super) values: &'a [f64],
}

impl Points<'_> {
    fn index(&self, i: usize) -> [usize; 3] {
        let [w, h, _] = self.side;
        [i % w, i / w % h, i / (w * h)]
    }

    fn place(&self, i: usize) -> [f64; 3] {
        let at = self.index(i);
        self.grid.point(std::array::from_fn(|d| self.from[d] + at[d]))
    }

    /// A point of the other sign in a leaf whose points are all inside or all outside, looked for from the one whose value is nearest to 0.
    pub(super) fn hidden(&self, inside: bool, program: &Program, sampler: &mut Sampler) -> Option<Detail> {
        // Towards more outside, or towards more inside: the value with this sign grows.
        let sign = if inside { -1.0 } else { 1.0 };
        let best = (0..self.values.len())
            .filter(|&i| !self.values[i].is_nan())
            .max_by(|&a, &b| (sign * self.values[a]).total_cmp(&(sign * self.values[b])))?;
        if self.values[best].abs() > 2.0 * self.steepness(best) {
            return None;
        }
        let cell = self.grid.cell();
        let from = self.grid.point(self.from);
        let to = self.grid.point(std::array::from_fn(|d| self.from[d] + self.side[d] - 1));
        let near = |p: [f64; 3]| (0..3).all(|d| p[d] >= from[d] - 0.5 * cell[d] && p[d] <= to[d] + 0.5 * cell[d]);
        let mut place = self.place(best);
        for step in 0..STEPS {
            let (value, slope) = slope_at(place, self.grid.dimension(), program, sampler);
            if inside != (value >= 0.0) && !value.is_nan() {
                let kind = if inside { Kind::Hole } else { Kind::Part };
                return Some(Detail { kind, place, width: 0.0 });
            }
            let square: f64 = slope.iter().map(|s| s * s).sum();
            let way = slope.map(|s| -value * s / square);
            if !way.iter().all(|w| w.is_finite()) {
                return None;
            }
            if step == 0 && !near(std::array::from_fn(|d| place[d] + way[d])) {
                return None;
            }
            // Half as far again: a boundary that is only approached is never crossed.
            let next: [f64; 3] = std::array::from_fn(|d| place[d] + 1.5 * way[d]);
            place = std::array::from_fn(|d| next[d].clamp(self.grid.lo[d], self.grid.hi[d]));
        }
        None
    }

    /// The largest difference to a neighbour.
    fn steepness(&self, i: usize) -> f64 {
        let (at, stride) = (self.index(i), [1, self.side[0], self.side[0] * self.side[1]]);
        let mut steepest = 0.0_f64;
        for d in 0..3 {
            if at[d] > 0 {
                steepest = steepest.max((self.values[i] - self.values[i - stride[d]]).abs());
            }
            if at[d] + 1 < self.side[d] {
                steepest = steepest.max((self.values[i] - self.values[i + stride[d]]).abs());
            }
        }
        steepest
    }

    /// A place of the object without thickness, if all inside points of the leaf have the value 0 and no solid part is right beside.
    pub(super) fn sheet(&self, program: &Program, sampler: &mut Sampler) -> Option<Detail> {
        let mut zero = None;
        for (i, &value) in self.values.iter().enumerate() {
            if value > 0.0 {
                return None;
            }
            if value == 0.0 && zero.is_none() {
                zero = Some(i);
            }
        }
        let place = self.place(zero?);
        let cell = self.grid.cell();
        let beside: Vec<[f64; 3]> =
            directions(self.grid.dimension()).map(|way| shifted(place, way, cell, 0.01)).collect();
        let mut probes = Vec::new();
        for &p in &beside {
            probes.push(p);
            probes.extend(straight(self.grid.dimension()).map(|way| shifted(p, way, cell, 0.001)));
        }
        let values = values_at(&probes, self.grid.dimension(), program, sampler);
        let is_solid = values.chunks_exact(probes.len() / beside.len()).any(|all| all.iter().all(|&v| v >= 0.0));
        (!is_solid).then_some(Detail { kind: Kind::Sheet, place, width: 0.0 })
    }
}

/// Keeps the details that no sample point about them shows, measures them, and drops all but a few.
pub(super) fn confirm(
    suspects: Vec<Detail>,
    grid: &Grid,
    is_inside: impl Fn([usize; 3]) -> bool,
    shape: &Shape,
    interrupt: &Interrupt,
) -> Vec<Detail> {
    let mut sampler = Sampler::new(shape).heeding(interrupt);
    let alone = |detail: &Detail| {
        let [x, y, z] = std::array::from_fn(|d| window(grid, d, detail.place[d]));
        let all =
            z.flat_map(|k| y.clone().flat_map(move |j| [(j, k)])).flat_map(|(j, k)| x.clone().map(move |i| [i, j, k]));
        detail.kind == Kind::Sheet || all.into_iter().all(|index| is_inside(index) == (detail.kind == Kind::Hole))
    };
    suspects
        .into_iter()
        .filter(alone)
        .take(MOST)
        .map(|detail| if detail.kind == Kind::Sheet { detail } else { measured(detail, grid, shape, &mut sampler) })
        .collect()
}

/// The sample points about a coordinate.
fn window(grid: &Grid, axis: usize, at: f64) -> std::ops::RangeInclusive<usize> {
    let cells = grid.cells[axis];
    if cells == 0 {
        return 0..=0;
    }
    let index = ((at - grid.lo[axis]) / grid.cell()[axis]).floor().clamp(0.0, cells as f64) as usize;
    index.saturating_sub(AROUND)..=(index + 1 + AROUND).min(cells)
}

/// The same detail with its middle and its width.
fn measured(detail: Detail, grid: &Grid, shape: &Shape, sampler: &mut Sampler) -> Detail {
    const PARTS: usize = 64;
    let cell = grid.cell();
    let mut place = detail.place;
    let mut width = f64::INFINITY;
    for _ in 0..2 {
        width = f64::INFINITY;
        for axis in 0..grid.dimension() {
            let step = 2.0 * cell[axis] / PARTS as f64;
            let line = |sign: f64| {
                (1..=PARTS).map(move |k| {
                    let mut p = place;
                    p[axis] += sign * step * k as f64;
                    p
                })
            };
            let [below, above] = [-1.0, 1.0].map(|sign| {
                let values = values_at(&line(sign).collect::<Vec<_>>(), grid.dimension(), &shape.program, sampler);
                let own = |value: &&f64| (**value >= 0.0) == (detail.kind == Kind::Part);
                values.iter().take_while(own).count() as f64
            });
            place[axis] += 0.5 * step * (above - below);
            width = width.min(step * (above + below + 1.0));
        }
    }
    Detail { place, width, ..detail }
}

/// The directions to all neighbours on a grid.
fn directions(dimension: usize) -> impl Iterator<Item = [f64; 3]> {
    let way = |n: usize| [n % 3, n / 3 % 3, n / 9].map(|part| part as f64 - 1.0);
    (0..27).map(way).filter(move |way| *way != [0.0; 3] && way[dimension..].iter().all(|&part| part == 0.0))
}

/// Those along the axes.
fn straight(dimension: usize) -> impl Iterator<Item = [f64; 3]> {
    directions(dimension).filter(|way| way.iter().filter(|part| **part != 0.0).count() == 1)
}

fn shifted(place: [f64; 3], way: [f64; 3], cell: [f64; 3], part: f64) -> [f64; 3] {
    std::array::from_fn(|d| place[d] + part * way[d] * cell[d])
}

fn values_at(places: &[[f64; 3]], dimension: usize, program: &Program, sampler: &mut Sampler) -> Vec<f64> {
    let [x, y, z]: [Vec<f64>; 3] = std::array::from_fn(|d| places.iter().map(|p| p[d]).collect());
    let mut values = vec![0.0; places.len()];
    sampler.values(program, &[&x[..], &y, &z][..dimension], &mut values);
    values
}

fn slope_at(place: [f64; 3], dimension: usize, program: &Program, sampler: &mut Sampler) -> (f64, [f64; 3]) {
    let [x, y, z] = place.map(|c| [c]);
    let mut value = [0.0];
    let [mut a, mut b, mut c] = [[0.0]; 3];
    sampler.slopes(program, &[&x[..], &y, &z][..dimension], &mut value, &mut [&mut a[..], &mut b, &mut c][..dimension]);
    (value[0], [a[0], b[0], c[0]])
}

/// Details that one task keeps for a closer look.
pub(super) const SUSPECTS: usize = 64;
