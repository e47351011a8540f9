//! Integrals over stars: volume, area, centroid and inertia of what a gauge F bounds, by Gauss's rule over the directions. Makes no mesh of
//! its own, but takes curvatures from those over a sphere.
//!
//! The directions are those to the faces of the cube from -1 to 1. Over a face the solid is `c + s v` with `0 < s < 1/F(v)`, whose volume
//! element is `s^2 ds`, so that moments are integrals of powers of 1/F alone; the area element is `|grad F| / F^3`. Panels are split where the
//! rule and its four parts differ most, and that difference is the estimate of the error. Where the gauge is smooth all digits are right;
//! along a crease the digits come one by one.

use rayon::prelude::*;

use super::guide::Solid;
use super::mesh::{MeshError, Space, circle, outline, over};
use super::{Gauge, guide::LEVELS};
use crate::interrupt::{Cancelled, Interrupt};
use crate::limits::Limits;
use crate::surface::check::check;
use crate::surface::contour::Contour;
use crate::surface::curvature;
use crate::surface::estimate::{Bend, Estimate};
use crate::surface::figure::Figure;
use crate::surface::grid::Grid;
use crate::surface::marching::{Report, SurfaceError};
use crate::surface::measure::{MeasureError, Measures, bounds};
use crate::surface::sampler::Counters;
use crate::vm::{Gradients, Shape};

/// Nodes of the rule along an axis of a panel.
const NODES: usize = 7;
/// The places of the rule between -1 and 1, and their weights.
const RULE: [[f64; 2]; NODES] = [
    [-0.949_107_912_342_758_5, 0.129_484_966_168_869_7],
    [-0.741_531_185_599_394_5, 0.279_705_391_489_276_64],
    [-0.405_845_151_377_397_2, 0.381_830_050_505_118_9],
    [0.0, 0.417_959_183_673_469_4],
    [0.405_845_151_377_397_2, 0.381_830_050_505_118_9],
    [0.741_531_185_599_394_5, 0.279_705_391_489_276_64],
    [0.949_107_912_342_758_5, 0.129_484_966_168_869_7],
];
/// Panels that one task evaluates.
const PANELS: usize = 16;
/// The error at which nothing more is split, as a share of the volume and the area.
const AIM: f64 = 1e-12;
/// The part of the error that the panels that are split make up.
const PART: f64 = 0.9;
/// Evaluations at most, in those of the first panels.
const PATIENCE: u64 = 3;
/// Where the first panels leave a larger error, more of them do not help.
const HOPELESS: f64 = 0.05;
/// The error beyond which there must be creases, or what is like them, and how much larger the error may be there than the difference.
const CREASED: f64 = 1e-8;
const CHANCE: f64 = 4.0;
/// What rounding leaves, as a share.
const ROUNDING: f64 = 2e-13;
/// The error up to which no cells are asked.
const SURE: f64 = 1e-7;
/// Volume, surface, and the moments of first and second order of three axes.
const SUMS: usize = 11;

type Sums = [f64; SUMS];

/// A part of a face of the cube, with its integrals.
#[derive(Clone, Debug)]
struct Panel<const N: usize> {
    axis: usize,
    side: f64,
    /// The range of each axis but that of the face, whose own is not read.
    ranges: [[f64; 2]; N],
    sums: Sums,
    /// An estimate of the errors of the sums.
    errors: Sums,
}

/// What the gauge encloses. Lengths are the units of the space, density is 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Enclosed<const N: usize> {
    /// Volume, or area of a plane figure.
    pub volume: Estimate,
    /// Area of the boundary, or length of the outline.
    pub surface: Estimate,
    /// Centre of mass.
    pub centroid: [Estimate; N],
    /// Inertia about the centre of mass.
    pub inertia: [[Estimate; N]; N],
    /// Directions in which the gauge was evaluated.
    pub points: u64,
    /// The errors of volume and surface as shares of them, added.
    pub error: f64,
}

/// Where the second moment of two axes lies among the sums.
fn second<const N: usize>(r: usize, s: usize) -> usize {
    let (r, s) = (r.min(s), r.max(s));
    2 + N + r * N - r * (r + 1) / 2 + s
}

impl<const N: usize> Panel<N> {
    fn halves(&self) -> Vec<Self> {
        let mut parts = vec![self.clone()];
        for axis in (0..N).filter(|axis| *axis != self.axis) {
            let [lo, hi] = self.ranges[axis];
            let middle = 0.5 * (lo + hi);
            let halves = |part: Self| {
                [[lo, middle], [middle, hi]].map(|range| {
                    let mut half = part.clone();
                    half.ranges[axis] = range;
                    half
                })
            };
            parts = parts.into_iter().flat_map(halves).collect();
        }
        parts
    }

    /// The nodes with their weights.
    fn nodes(&self, mut to: impl FnMut([f64; N], f64)) {
        for k in 0..NODES.pow(N as u32 - 1) {
            let (mut at, mut weight, mut rest) = ([self.side; N], 1.0, k);
            for axis in (0..N).filter(|axis| *axis != self.axis) {
                let ([place, share], [lo, hi]) = (RULE[rest % NODES], self.ranges[axis]);
                rest /= NODES;
                at[axis] = 0.5 * (lo + hi) + 0.5 * (hi - lo) * place;
                weight *= 0.5 * (hi - lo) * share;
            }
            to(at, weight);
        }
    }

    /// How much of the whole this panel may be wrong by.
    fn error(&self, whole: &Sums) -> f64 {
        (self.errors[0] / whole[0]).max(self.errors[1] / whole[1])
    }
}

/// Fills in the integrals of some panels; nothing if the gauge is not what was proved, or the shape reaches out of the space.
fn evaluate<const N: usize>(
    gauge: &Gauge,
    space: &[[f64; 2]],
    panels: &mut [Panel<N>],
    interrupt: &Interrupt,
) -> Result<Option<()>, Cancelled> {
    let good = panels.par_chunks_mut(PANELS).map_init(Gradients::new, |gradients, panels| {
        interrupt.tick()?;
        Ok(batch(gauge, space, panels, gradients))
    });
    good.try_reduce(|| Some(()), |a, b| Ok(a.and(b)))
}

fn batch<const N: usize>(
    gauge: &Gauge,
    space: &[[f64; 2]],
    panels: &mut [Panel<N>],
    gradients: &mut Gradients,
) -> Option<()> {
    let (mut directions, mut weights) = (Vec::new(), Vec::new());
    for panel in panels.iter() {
        panel.nodes(|at, weight| {
            directions.push(at);
            weights.push(weight);
        });
    }
    let count = directions.len();
    let mut columns: Vec<Vec<f64>> = (0..N).map(|d| directions.iter().map(|v| v[d]).collect()).collect();
    columns.extend(gauge.fixed.iter().map(|&value| vec![value; count]));
    let at: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
    let mut values = vec![0.0; count];
    let mut slopes: [Vec<f64>; N] = std::array::from_fn(|_| vec![0.0; count]);
    let by: [usize; N] = std::array::from_fn(|d| d);
    gradients.eval(&gauge.gauge, &at, &by, &mut values, &mut slopes.each_mut().map(Vec::as_mut_slice));
    let each = NODES.pow(N as u32 - 1);
    for (number, panel) in panels.iter_mut().enumerate() {
        panel.sums = [0.0; SUMS];
        for k in number * each..(number + 1) * each {
            let (v, f) = (directions[k], values[k]);
            let slope = slopes.iter().map(|s| s[k] * s[k]).sum::<f64>().sqrt();
            if !(f > 0.0 && f.is_finite() && slope.is_finite()) {
                return None;
            }
            let reach = 1.0 / f;
            let is_out = |d: usize| {
                let (x, [lo, hi]) = (gauge.centre[d] + v[d] * reach, space[d]);
                let room = 1e-9 * (hi - lo);
                x < lo - room || x > hi + room
            };
            if (0..N).any(is_out) {
                return None;
            }
            add::<N>(&mut panel.sums, v, reach, slope, weights[k]);
        }
    }
    Some(())
}

/// Adds what a node with a weight counts.
fn add<const N: usize>(sums: &mut Sums, v: [f64; N], reach: f64, slope: f64, weight: f64) {
    let n = N as f64;
    let cone = weight * reach.powi(N as i32);
    sums[0] += cone / n;
    sums[1] += cone * slope;
    for r in 0..N {
        sums[2 + r] += cone * reach * v[r] / (n + 1.0);
        for s in r..N {
            sums[second::<N>(r, s)] += cone * reach * reach * v[r] * v[s] / (n + 2.0);
        }
    }
}

/// Panels on all faces of the cube, so many along each side.
fn first<const N: usize>(along: usize) -> Vec<Panel<N>> {
    let ends = |k: usize| [k, k + 1].map(|k| 2.0 * k as f64 / along as f64 - 1.0);
    let mut panels = Vec::new();
    for axis in 0..N {
        for side in [-1.0, 1.0] {
            for k in 0..along.pow(N as u32 - 1) {
                let (mut rest, mut ranges) = (k, [[0.0; 2]; N]);
                for (_, range) in ranges.iter_mut().enumerate().filter(|(other, _)| *other != axis) {
                    *range = ends(rest % along);
                    rest /= along;
                }
                panels.push(Panel { axis, side, ranges, sums: [0.0; SUMS], errors: [0.0; SUMS] });
            }
        }
    }
    panels
}

fn added<const N: usize>(panels: &[Panel<N>], of: impl Fn(&Panel<N>) -> &Sums) -> Sums {
    let plus = |sum: Sums, panel: &Panel<N>| std::array::from_fn(|k| sum[k] + of(panel)[k]);
    panels.iter().fold([0.0; SUMS], plus)
}

/// Splits some panels; their parts' errors are the differences of the old integrals from the new.
fn split<const N: usize>(
    gauge: &Gauge,
    space: &[[f64; 2]],
    panels: &[Panel<N>],
    interrupt: &Interrupt,
) -> Result<Option<Vec<Panel<N>>>, Cancelled> {
    let mut parts: Vec<Panel<N>> = panels.iter().flat_map(Panel::halves).collect();
    if evaluate(gauge, space, &mut parts, interrupt)?.is_none() {
        return Ok(None);
    }
    let each = 1 << (N - 1);
    for (panel, parts) in panels.iter().zip(parts.chunks_mut(each)) {
        let sums = added(parts, |part| &part.sums);
        for part in &mut *parts {
            part.errors = std::array::from_fn(|k| (panel.sums[k] - sums[k]).abs() / each as f64);
        }
    }
    Ok(Some(parts))
}

/// What a star encloses, with first panels whose nodes lie about as close as cells, so many along the longest side; nothing if it reaches
/// out of the space.
///
/// # Errors
/// [`Cancelled`] soon after the interrupt was set.
pub fn enclosed<const N: usize>(
    gauge: &Gauge,
    space: &[[f64; 2]],
    cells: usize,
    interrupt: &Interrupt,
) -> Result<Option<Enclosed<N>>, Cancelled> {
    let along = (cells / if N == 2 { 4 } else { 16 }).max(2);
    let mut panels = first::<N>(along);
    if evaluate(gauge, space, &mut panels, interrupt)?.is_none() {
        return Ok(None);
    }
    let each = NODES.pow(N as u32 - 1) as u64;
    let mut points = each * panels.len() as u64;
    let most = PATIENCE * points * (1 + (1 << (N - 1)));
    let Some(parts) = split(gauge, space, &panels, interrupt)? else { return Ok(None) };
    (points, panels) = (points + each * parts.len() as u64, parts);
    loop {
        let whole = added(&panels, |panel| &panel.sums);
        let total: f64 = panels.iter().map(|panel| panel.error(&whole)).sum();
        let is_hopeless = N > 2 && total > HOPELESS;
        if is_hopeless || total.is_nan() || total <= AIM || points >= most {
            return Ok(Some(finished(gauge, &panels, points)));
        }
        panels.sort_by(|a, b| b.error(&whole).total_cmp(&a.error(&whole)));
        let (mut sum, mut count) = (0.0, 0);
        while count < panels.len() && sum < PART * total {
            sum += panels[count].error(&whole);
            count += 1;
        }
        let room = ((most - points) / (each << (N - 1))).max(1) as usize;
        let rest = panels.split_off(count.min(room));
        let Some(parts) = split(gauge, space, &panels, interrupt)? else { return Ok(None) };
        points += each * parts.len() as u64;
        panels = rest;
        panels.extend(parts);
    }
}

/// The measures from the integrals of all panels.
fn finished<const N: usize>(gauge: &Gauge, panels: &[Panel<N>], points: u64) -> Enclosed<N> {
    let (sums, mut errors) = (added(panels, |panel| &panel.sums), added(panels, |panel| &panel.errors));
    let volume = sums[0];
    if errors[0] / volume + errors[1] / sums[1] > CREASED {
        // Where a crease runs through a panel, the rule and its parts may agree by chance.
        errors = errors.map(|error| CHANCE * error);
    }
    let wrong = |k: usize, scale: f64| errors[k] + ROUNDING * scale;
    let size = (0..N).map(|d| sums[second::<N>(d, d)] / volume).sum::<f64>().sqrt();
    let off: [f64; N] = std::array::from_fn(|d| sums[2 + d] / volume);
    let off_error: [f64; N] =
        std::array::from_fn(|d| (wrong(2 + d, volume * size) + off[d].abs() * wrong(0, volume)) / volume);
    let spread = |r: usize, s: usize| {
        let k = second::<N>(r, s);
        let error = wrong(k, volume * size * size)
            + volume * (off[r].abs() * off_error[s] + off[s].abs() * off_error[r])
            + (off[r] * off[s]).abs() * wrong(0, volume);
        Estimate { value: sums[k] - volume * off[r] * off[s], error }
    };
    let inertia = |r: usize, s: usize| {
        if r != s {
            let spread = spread(r, s);
            return Estimate { value: -spread.value, error: spread.error };
        }
        let others = (0..N).filter(|d| *d != r).map(|d| spread(d, d));
        others.fold(Estimate::default(), |a, b| Estimate { value: a.value + b.value, error: a.error + b.error })
    };
    let place = |d: usize| {
        let value = gauge.centre[d] + off[d];
        Estimate { value, error: off_error[d] + f64::EPSILON * value.abs() }
    };
    Enclosed {
        volume: Estimate { value: volume, error: wrong(0, volume) },
        surface: Estimate { value: sums[1], error: wrong(1, sums[1]) },
        centroid: std::array::from_fn(place),
        inertia: std::array::from_fn(|r| std::array::from_fn(|s| inertia(r, s))),
        points,
        error: errors[0] / volume + errors[1] / sums[1],
    }
}

/// What rays tell of a solid.
#[derive(Clone, Debug)]
pub enum Found {
    /// Everything.
    All(Box<Measures>),
    /// The integrals alone, which creases leave few digits: cells may do better, and tell the rest.
    Integrals(Box<Enclosed<3>>),
}

impl Found {
    /// Puts the integrals into what cells tell, if they are nearer; whether they are.
    #[must_use]
    pub fn improve(&self, measures: &mut Measures) -> bool {
        let Self::Integrals(found) = self else { return false };
        let share = |of: Estimate| of.error / of.value;
        let is_cut = measures.report.cut.iter().flatten().any(|cut| *cut);
        let nearer = found.error < share(measures.volume) + share(measures.area) && !is_cut;
        if nearer {
            measures.volume = found.volume;
            measures.area = found.surface;
            measures.centroid = found.centroid;
            measures.inertia = found.inertia;
        }
        nearer
    }
}

fn report(points: u64) -> Report {
    let counters = Counters { points, ..Counters::default() };
    Report { counters, samples: points, ..Report::default() }
}

/// Measures a star in space; nothing where the space cuts it.
///
/// # Errors
/// As those of the other route.
pub fn solid(
    gauge: &Gauge,
    shape: &Shape,
    grid: &Grid,
    limits: &Limits,
    interrupt: &Interrupt,
) -> Result<Option<Found>, MeasureError> {
    let ranges: Vec<[f64; 2]> = (0..3).map(|d| [grid.lo[d], grid.hi[d]]).collect();
    let cells = grid.cells.into_iter().max().unwrap_or(1);
    let Some(found) = enclosed::<3>(gauge, &ranges, cells, interrupt)? else { return Ok(None) };
    if found.error.is_nan() || found.error > HOPELESS {
        return Ok(None);
    }
    if found.error > SURE {
        return Ok(Some(Found::Integrals(Box::new(found))));
    }
    let Some(reaches) = bounds(shape, grid, limits, interrupt)? else { return Ok(None) };
    let is_cut = |d: usize| {
        let [lo, hi] = ranges[d];
        let [least, most] = reaches[d];
        least.value - least.error <= lo || most.value + most.error >= hi
    };
    if (0..3).any(is_cut) {
        return Ok(None);
    }
    // About as many vertices as cells would give.
    let level = (0..LEVELS).take_while(|l| Solid::Sphere.vertices(*l) <= 3 * cells * cells).last().unwrap_or(0).max(2);
    let space = Space { ranges };
    let (mut bends, mut topology, mut points) = (Vec::new(), None, found.points);
    for level in [level, level - 1, level - 2] {
        let mesh = match over(gauge, &space, &Solid::Sphere.guide(level), true, interrupt) {
            Ok(made) => made.boundary,
            Err(MeshError::Cancelled) => return Err(Cancelled.into()),
            Err(_) => return Ok(None),
        };
        points += mesh.positions.len() as u64;
        if topology.is_none() {
            let Ok(checked) = check(&mesh) else { return Ok(None) };
            topology = Some(checked);
        }
        let own = mesh.triangles.len();
        bends.push(curvature::of_mesh(shape, &mesh, own, grid.cell(), interrupt).map_err(SurfaceError::from)?);
    }
    let bend = |which: usize| Bend::from([0, 1, 2].map(|k| bends[k].map(|of| of[which])), found.error < SURE);
    Ok(Some(Found::All(Box::new(Measures {
        volume: found.volume,
        area: found.surface,
        centroid: found.centroid,
        inertia: found.inertia,
        bounds: Some(reaches),
        topology: topology.unwrap_or_default(),
        parts: 1,
        is_settled: true,
        curvature: bend(0).zip(bend(1)).map(|(mean, gauss)| [mean, gauss]),
        report: report(points),
    }))))
}

/// Measures a star in the plane, as [`solid`] does.
///
/// # Errors
/// As those of the other route.
pub fn figure(
    gauge: &Gauge,
    shape: &Shape,
    grid: &Grid,
    interrupt: &Interrupt,
) -> Result<Option<Figure>, SurfaceError> {
    let ranges: Vec<[f64; 2]> = (0..2).map(|d| [grid.lo[d], grid.hi[d]]).collect();
    let cells = grid.cells.into_iter().max().unwrap_or(1);
    let Some(found) = enclosed::<2>(gauge, &ranges, cells, interrupt)? else { return Ok(None) };
    if found.error.is_nan() || found.error > SURE {
        return Ok(None);
    }
    let space = Space { ranges };
    let (mut bends, mut points) = (Vec::new(), found.points);
    let corners = (8 * cells).max(64);
    for corners in [corners, corners / 2, corners / 4] {
        let made = match outline(gauge, &space, &circle(corners), interrupt) {
            Ok(made) if made.cut.iter().flatten().any(|cut| *cut) => return Ok(None),
            Ok(made) => Contour { lines: vec![made.boundary], report: Report::default() },
            Err(MeshError::Cancelled) => return Err(Cancelled.into()),
            Err(_) => return Ok(None),
        };
        points += corners as u64;
        bends.push(curvature::of_lines(shape, &made.lines, grid.cell(), |_| true, interrupt)?);
    }
    Ok(Some(Figure {
        area: found.volume,
        perimeter: found.surface,
        centroid: found.centroid,
        inertia: found.inertia,
        components: 1,
        holes: 0,
        is_settled: true,
        curvature: Bend::from([bends[0], bends[1], bends[2]], found.error < SURE),
        points: corners,
        report: report(points),
    }))
}
