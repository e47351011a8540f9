//! Integrals over plane figures: area, length of the outlines, centroid, inertia, curvature, with error estimates from three resolutions.

use super::contour::Contour;
use super::curvature;
use super::estimate::{Bend, Estimate};
use super::grid::Grid;
use super::marching::{Report, SurfaceError};
use super::sharp::outlines_as;
use crate::interrupt::Interrupt;
use crate::limits::Limits;
use crate::reuse::Digest;
use crate::vm::Shape;

/// What can be measured of a plane figure. Lengths are the units of the space, density is 1.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Figure {
    /// Enclosed area.
    pub area: Estimate,
    /// Length of the outlines, also along the edges of the modelling space.
    pub perimeter: Estimate,
    /// Centre of mass.
    pub centroid: [Estimate; 2],
    /// Inertia about the centre of mass: `[[∫y², -∫xy], [-∫xy, ∫x²]]`.
    pub inertia: [[Estimate; 2]; 2],
    /// Connected parts.
    pub components: usize,
    /// Holes in all of them.
    pub holes: usize,
    /// Whether half the resolution gives as many parts and holes.
    pub is_settled: bool,
    /// Curvature along the outlines' smooth parts; a disc's is one over its radius.
    pub curvature: Option<Bend>,
    /// Number of points of the outlines.
    pub points: usize,
    /// What there is to say about the outlines.
    pub report: Report,
}

/// Measures a 2-D shape on a grid, and on two coarser ones for the estimates; with its corners if they are to be `sharp`.
///
/// # Errors
/// See [`SurfaceError`].
pub fn measure(
    shape: &Shape,
    grid: &Grid,
    sharp: bool,
    limits: &Limits,
    interrupt: &Interrupt,
) -> Result<Figure, SurfaceError> {
    let tell = |to: &mut Digest| {
        shape.tell(to);
        to.shown(&(grid, sharp, limits.memory_bytes));
    };
    interrupt.whole("measures", tell, |_| size_of::<Figure>(), || measured(shape, grid, sharp, limits, interrupt))
}

fn measured(
    shape: &Shape,
    grid: &Grid,
    sharp: bool,
    limits: &Limits,
    interrupt: &Interrupt,
) -> Result<Figure, SurfaceError> {
    let mut all = Vec::new();
    for grid in grid.coarser() {
        let found = outlines_as(shape, &grid, sharp, limits, interrupt)?;
        let is_own = |p: [f64; 2]| (0..2).all(|d| p[d] > grid.lo[d] && p[d] < grid.hi[d]);
        let bend = curvature::of_lines(shape, &found.lines, grid.cell(), is_own, interrupt)?;
        all.push((Moments::of(&found), bend, found));
    }
    let is_smooth = !has_corners(&all[0].2);
    // Corners may lie alike between the sample points of all three grids, so that the differences do not tell what they lose.
    let [lost_length, lost] =
        all[0].2.lines.iter().map(|line| lost(line)).fold([0.0; 2], |a, b| [a[0] + b[0], a[1] + b[1]]);
    let size = (0..2).map(|d| grid.hi[d] - grid.lo[d]).fold(0.0, f64::max);
    let estimate = |part: &dyn Fn(&Moments) -> f64, scale: f64| {
        let values = [0, 1, 2].map(|level| all.get(level).map(|(moments, ..)| part(moments)));
        Estimate::from(values, is_smooth, 2e-10 * scale)
    };
    let count = |found: &Contour| (found.lines.len() as i64, found.euler());
    let (lines, euler) = count(&all[0].2);
    let components = ((lines + euler) / 2).max(0) as usize;
    let area = all[0].0.area.abs();
    let mut report = all[0].2.report.clone();
    all[1..].iter().for_each(|level| report.counters.add(level.2.report.counters.clone()));
    Ok(Figure {
        area: estimate(&|m| m.area, area).at_least(lost),
        perimeter: estimate(&|m| m.perimeter, all[0].0.perimeter).at_least(lost_length),
        centroid: [0, 1].map(|d| {
            estimate(&|m| m.centroid[d], size).at_least(if lost > 0.0 { 0.25 * size * lost / area } else { 0.0 })
        }),
        inertia: [0, 1].map(|r| {
            [0, 1].map(|c| estimate(&|m| m.inertia[r][c], area * size * size).at_least(0.25 * lost * size * size))
        }),
        components,
        holes: lines as usize - components,
        is_settled: all.get(1).is_none_or(|half| count(&half.2) == (lines, euler)),
        curvature: Bend::from([0, 1, 2].map(|level| all.get(level).and_then(|found| found.1)), is_smooth),
        points: all[0].2.lines.iter().map(Vec::len).sum(),
        report,
    })
}

/// Whether an outline turns by more than 40 degrees somewhere.
fn has_corners(contour: &Contour) -> bool {
    contour.lines.iter().any(|line| {
        let count = line.len();
        let length =
            |i: usize| (0..2).map(|d| (line[(i + 1) % count][d] - line[i % count][d]).powi(2)).sum::<f64>().sqrt();
        // A vertex beside a sample point leaves a side so short that its direction says nothing.
        let least = 0.1 * (0..count).map(length).fold(0.0, f64::max);
        let side = |i: usize| {
            let ([a, b], [c, d]) = (line[i % count], line[(i + 1) % count]);
            [(c - a) / length(i), (d - b) / length(i)]
        };
        (0..count).filter(|&i| length(i).min(length(i + 1)) > least).any(|i| {
            let ([a, b], [c, d]) = (side(i), side(i + 1));
            a * c + b * d < 0.766
        })
    })
}

/// What an outline loses of length and area where one of its sides bevels a corner: where it turns at both ends of the side, by more than
/// 40 degrees together.
fn lost(line: &[[f64; 2]]) -> [f64; 2] {
    // Beyond this turn the sides beside tell little of the corner.
    const SHARPEST: f64 = -0.87;
    let count = line.len();
    let step = |i: usize| {
        let ([a, b], [c, d]) = (line[i % count], line[(i + 1) % count]);
        let length = (c - a).hypot(d - b);
        ([(c - a) / length, (d - b) / length], length)
    };
    let along = |[a, b]: [f64; 2], [c, d]: [f64; 2]| a * c + b * d;
    let mut sum = [0.0; 2];
    for i in 0..count {
        let [(before, _), (own, length), (behind, _)] = [step(i), step(i + 1), step(i + 2)];
        // A side that goes straight on at one end is no bevel.
        let bends = along(before, own).max(along(own, behind)) < 0.996;
        let cosine = along(before, behind);
        if bends && cosine < 0.766 {
            let half = (0.5 * (1.0 + cosine.max(SHARPEST))).sqrt();
            let height = 0.5 * length * (1.0 - half * half).sqrt() / half;
            sum[0] += 1.2 * length * (1.0 / half - 1.0);
            sum[1] += 1.2 * 0.5 * length * height;
        }
    }
    sum
}

/// The integrals over the inside of outlines.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Moments {
    area: f64,
    perimeter: f64,
    centroid: [f64; 2],
    inertia: [[f64; 2]; 2],
}

impl Moments {
    /// By Green's theorem, about a point of the figure, so that one far from the origin loses no digits.
    fn of(contour: &Contour) -> Self {
        let perimeter = contour.perimeter();
        let Some(&middle) = contour.lines.iter().flatten().next() else { return Self::default() };
        let (mut area, mut first, mut second) = (0.0, [0.0; 2], [[0.0; 2]; 2]);
        for line in &contour.lines {
            for (a, b) in line.iter().zip(line.iter().cycle().skip(1)) {
                let [a, b]: [[f64; 2]; 2] = [a, b].map(|p| [p[0] - middle[0], p[1] - middle[1]]);
                let twice = a[0] * b[1] - b[0] * a[1];
                area += twice / 2.0;
                for r in 0..2 {
                    first[r] += twice / 6.0 * (a[r] + b[r]);
                    for s in 0..2 {
                        let sum = (a[r] + b[r]) * (a[s] + b[s]);
                        second[r][s] += twice / 24.0 * (a[r] * a[s] + b[r] * b[s] + sum);
                    }
                }
            }
        }
        if area == 0.0 {
            return Self { perimeter, ..Self::default() };
        }
        let offset = first.map(|m| m / area);
        let spread = |r: usize, s: usize| second[r][s] - area * offset[r] * offset[s];
        let inertia = [[spread(1, 1), -spread(0, 1)], [-spread(1, 0), spread(0, 0)]];
        Self { area, perimeter, centroid: [0, 1].map(|d| middle[d] + offset[d]), inertia }
    }
}
