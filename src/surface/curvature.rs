//! Curvatures of boundaries at the vertices of a mesh or an outline, and what they add up to. Positive where the boundary bends round the
//! object as a ball's does.
//!
//! Second derivatives are central differences of exact gradients over a ten-thousandth of a cell, which leaves them nine digits or so.
//! Creases have no curvature: a vertex whose slopes jump within that distance is left out.

use rayon::prelude::*;

use super::mesh::{Mesh, cross, dot, minus};
use super::sampler::Sampler;
use crate::interrupt::{Cancelled, Interrupt};
use crate::vm::Shape;

/// Half the length of a difference, as a part of a cell.
const STEP: f64 = 1e-4;
/// Points whose gradients are computed together.
const AT_ONCE: usize = 512;
/// Operations that the curvatures of one boundary may take.
const WORK: usize = 20_000_000_000;

/// What a curvature adds up to over a boundary.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sum {
    /// Its integral over the boundary's smooth parts.
    pub integral: f64,
    /// Its average over them.
    pub average: f64,
    /// The least at a vertex.
    pub least: f64,
    /// The largest.
    pub largest: f64,
}

/// Mean and Gaussian curvature over the boundary of a solid; of the triangles only the first `own`, which are no caps. `None` where nothing
/// is smooth, or where it would take too long.
///
/// # Errors
/// [`Cancelled`] soon after the interrupt was set.
pub fn of_mesh(
    shape: &Shape,
    mesh: &Mesh,
    own: usize,
    cell: [f64; 3],
    interrupt: &Interrupt,
) -> Result<Option<[Sum; 2]>, Cancelled> {
    let Some(bends) = bends(shape, &mesh.positions, cell, interrupt)? else { return Ok(None) };
    let area = |triangle: [u32; 3]| {
        let [a, b, c] = mesh.corners(triangle);
        let normal = cross(minus(b, a), minus(c, a));
        0.5 * dot(normal, normal).sqrt()
    };
    let triangles = &mesh.triangles[..own];
    let curvature = |which: usize| {
        let parts = triangles.iter().map(|&t| (area(t), t.map(|v| bends[v as usize].map(|bend| bend[which]))));
        sum(parts)
    };
    Ok(curvature(0).zip(curvature(1)).map(|(mean, gauss)| [mean, gauss]))
}

/// The curvature along outlines; `is_own` says of which points, namely not of those that close a figure at the edge of the space.
///
/// # Errors
/// [`Cancelled`] soon after the interrupt was set.
pub fn of_lines(
    shape: &Shape,
    lines: &[Vec<[f64; 2]>],
    cell: [f64; 3],
    is_own: impl Fn([f64; 2]) -> bool,
    interrupt: &Interrupt,
) -> Result<Option<Sum>, Cancelled> {
    let places: Vec<[f64; 3]> = lines.iter().flatten().map(|&[x, y]| [x, y, 0.0]).collect();
    let Some(bends) = bends(shape, &places, cell, interrupt)? else { return Ok(None) };
    let mut parts = Vec::with_capacity(places.len());
    let mut first = 0;
    for line in lines {
        for i in 0..line.len() {
            let j = (i + 1) % line.len();
            let ([a, b], [c, d]) = (line[i], line[j]);
            if is_own(line[i]) && is_own(line[j]) {
                parts.push(((c - a).hypot(d - b), [first + i, first + j].map(|k| bends[k].map(|bend| bend[0]))));
            }
        }
        first += line.len();
    }
    Ok(sum(parts))
}

/// Adds up values at the corners of triangles or the ends of sides, each part with its area or length. A corner without a value leaves
/// its part to the others.
fn sum<const N: usize>(parts: impl IntoIterator<Item = (f64, [Option<f64>; N])>) -> Option<Sum> {
    let mut all = Sum { least: f64::INFINITY, largest: f64::NEG_INFINITY, ..Sum::default() };
    let mut measure = 0.0;
    for (size, corners) in parts {
        let known = corners.iter().flatten();
        let count = known.clone().count();
        if count > 0 {
            all.integral += size * known.clone().sum::<f64>() / count as f64;
            measure += size;
            all.least = known.clone().fold(all.least, |least, &bend| least.min(bend));
            all.largest = known.fold(all.largest, |largest, &bend| largest.max(bend));
        }
    }
    all.average = all.integral / measure;
    (measure > 0.0).then_some(all)
}

/// Mean and Gaussian curvature at each place; in the plane the curvature and 0. `None` if it would take too long.
#[allow(clippy::type_complexity)]
fn bends(
    shape: &Shape,
    places: &[[f64; 3]],
    cell: [f64; 3],
    interrupt: &Interrupt,
) -> Result<Option<Vec<Option<[f64; 2]>>>, Cancelled> {
    let count = 2 * shape.dimension + 1;
    if places.len().saturating_mul(count * (shape.program.len() + 8)) > WORK {
        return Ok(None);
    }
    let step = STEP * cell[..shape.dimension].iter().copied().fold(f64::INFINITY, f64::min);
    let parts = places.par_chunks(AT_ONCE).map_init(
        || Sampler::new(shape).heeding(interrupt),
        |sampler, chunk| {
            interrupt.tick()?;
            let slopes: Vec<Vec<[f64; 3]>> =
                (0..count).map(|k| gradients(shape, chunk, offset(k, step), sampler)).collect();
            let at = |i: usize| bend(shape.dimension, |k| slopes[k][i], step);
            Ok((0..chunk.len()).map(at).collect::<Vec<_>>())
        },
    );
    Ok(Some(parts.collect::<Result<Vec<_>, Cancelled>>()?.concat()))
}

/// Of the points of a difference: the place itself, then below and above it on each axis.
fn offset(k: usize, step: f64) -> [f64; 3] {
    let mut offset = [0.0; 3];
    if k > 0 {
        offset[(k - 1) / 2] = if k % 2 == 1 { -step } else { step };
    }
    offset
}

/// The gradients of minus the function, which point outward.
fn gradients(shape: &Shape, places: &[[f64; 3]], by: [f64; 3], sampler: &mut Sampler) -> Vec<[f64; 3]> {
    let [x, y, z]: [Vec<f64>; 3] = std::array::from_fn(|d| places.iter().map(|p| p[d] + by[d]).collect());
    let mut values = vec![0.0; places.len()];
    let [mut a, mut b, mut c] = [(); 3].map(|()| vec![0.0; places.len()]);
    let dimension = shape.dimension;
    let slopes = &mut [&mut a[..], &mut b, &mut c][..dimension];
    sampler.slopes(&shape.program, &[&x[..], &y, &z][..dimension], &mut values, slopes);
    (0..places.len()).map(|i| [-a[i], -b[i], -c[i]]).collect()
}

/// The curvatures from the gradients around a point; `None` at a crease and where there is no slope.
fn bend(dimension: usize, slope: impl Fn(usize) -> [f64; 3], step: f64) -> Option<[f64; 2]> {
    let g = slope(0);
    let steepness = dot(g, g).sqrt();
    let mut second = [[0.0; 3]; 3];
    for (axis, row) in second.iter_mut().enumerate().take(dimension) {
        let (below, above) = (slope(2 * axis + 1), slope(2 * axis + 2));
        for d in 0..dimension {
            let (left, right) = ((g[d] - below[d]) / step, (above[d] - g[d]) / step);
            // A slope that jumps, beyond what rounding and the third derivative do to it.
            if (left - right).abs() > 0.05 * (left.abs() + right.abs()) + 1e-9 * steepness / step {
                return None;
            }
            row[d] = 0.5 * (left + right);
        }
    }
    let s = |i: usize, j: usize| 0.5 * (second[i][j] + second[j][i]);
    let trace = s(0, 0) + s(1, 1) + s(2, 2);
    let along: f64 = (0..3).map(|i| (0..3).map(|j| g[i] * s(i, j) * g[j]).sum::<f64>()).sum();
    let sum = (trace - along / (steepness * steepness)) / steepness;
    if dimension == 2 {
        return sum.is_finite().then_some([sum, 0.0]);
    }
    let minor = |i: usize, j: usize| {
        let (a, b) = ((i + 1) % 3, (i + 2) % 3);
        let (c, d) = ((j + 1) % 3, (j + 2) % 3);
        s(a, c) * s(b, d) - s(a, d) * s(b, c)
    };
    let gauss: f64 = (0..3).map(|i| (0..3).map(|j| g[i] * minor(i, j) * g[j]).sum::<f64>()).sum();
    let bends = [0.5 * sum, gauss / steepness.powi(4)];
    bends.iter().all(|b| b.is_finite()).then_some(bends)
}
