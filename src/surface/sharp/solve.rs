//! Where surfaces meet: Newton's method on two of them in a plane, and on several in space. Knows no mesh.

use super::super::grid::Grid;
use super::super::mesh::{dot, unit};
use super::super::sampler::Sampler;
use crate::vm::Program;

/// Surfaces whose normals differ by less than 0.002 are one smooth surface.
const SMOOTH: f64 = 1.0 - 2e-6;
/// Steps of Newton's method: where surfaces touch each step halves the distance only.
const STEPS: usize = 40;
/// When a step is so short, as a part of a cell, the place is known.
const CONVERGED: f64 = 1e-11;
/// Least sine of the angle between lines that meet.
const LEAST_SINE: f64 = 1e-9;

/// The value of a piece at a point, and its slopes.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Local {
    pub(super) value: f64,
    pub(super) slope: [f64; 3],
}

impl Local {
    pub(super) fn of(program: &Program, at: [f64; 3], sampler: &mut Sampler) -> Self {
        let [x, y, z] = at.map(|c| [c]);
        let mut value = [0.0];
        let [mut a, mut b, mut c] = [[0.0]; 3];
        let dimension = sampler.dimension();
        let slopes = &mut [&mut a[..], &mut b, &mut c][..dimension];
        sampler.slopes(program, &[&x[..], &y, &z][..dimension], &mut value, slopes);
        Self { value: value[0], slope: [a[0], b[0], c[0]] }
    }

    /// The value of a program at a point.
    pub(super) fn value(program: &Program, at: [f64; 3], sampler: &mut Sampler) -> f64 {
        let [x, y, z] = at.map(|c| [c]);
        let mut value = [0.0];
        let dimension = sampler.dimension();
        sampler.values(program, &[&x[..], &y, &z][..dimension], &mut value);
        value[0]
    }

    fn is_finite(&self) -> bool {
        self.value.is_finite() && self.slope.iter().all(|s| s.is_finite())
    }

    fn steepness(&self) -> f64 {
        dot(self.slope, self.slope).sqrt()
    }

    /// About how far the surface is; undefined where the piece has no slope.
    pub(super) fn distance(&self) -> f64 {
        if self.value == 0.0 { 0.0 } else { self.value.abs() / self.steepness() }
    }

    /// Out of the solid; 0 where there is no slope.
    pub(super) fn normal(&self) -> [f64; 3] {
        unit(self.slope.map(|s| -s)).unwrap_or_default()
    }
}

/// How close is close: lengths of a cell and about it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scale {
    /// The longest side of a cell.
    pub(super) cell: f64,
    /// How far a vertex may be from a surface on which it lies: as far as vertices are kept off the ends of their edges.
    pub(super) near: f64,
    /// Least distance of a new vertex from the faces of its cell or the sides of its square, by axis.
    pub(super) margin: [f64; 3],
    /// How far beyond them it may lie: the tip of a crease may stick out of its cell between sample points that are all outside.
    pub(super) reach: f64,
    space: [[f64; 3]; 2],
}

impl Scale {
    /// With a reach of so many cells.
    pub(super) fn of(grid: &Grid, reach: f64) -> Self {
        let cell = grid.cell();
        let margin = std::array::from_fn(|d| {
            let unit = grid.lo[d].abs().max(grid.hi[d].abs()) * f64::from(f32::EPSILON);
            (8.0 * unit).max(1e-6 * cell[d]).min(0.25 * cell[d])
        });
        let longest = cell.into_iter().fold(0.0, f64::max);
        Self {
            cell: longest,
            near: 1.1 * margin.into_iter().fold(0.0, f64::max),
            margin,
            reach: reach * longest,
            space: [grid.lo, grid.hi],
        }
    }

    /// A coordinate of a new vertex, kept off the ends of the range of its cell, on whichever side it is; none if it is too far from
    /// it, or beyond the space.
    pub(super) fn kept_off(&self, axis: usize, at: f64, [lo, hi]: [f64; 2]) -> Option<f64> {
        let margin = self.margin[axis];
        let reach = self.reach.max(0.1 * margin);
        if at < lo - reach || at > hi + reach {
            return None;
        }
        let is_clear = |end: f64| (at - end).abs() >= margin;
        let kept = if is_clear(lo) && is_clear(hi) { at } else { at.clamp(lo + margin, hi - margin) };
        (kept > self.space[0][axis] && kept < self.space[1][axis]).then_some(kept)
    }
}

/// What becomes of two surfaces in a plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Meeting {
    /// They cross there.
    At([f64; 3]),
    /// They are one smooth surface, or go over into each other.
    Smooth,
    /// They do not meet nearby.
    Nowhere,
}

/// Where two surfaces meet in the plane across `axis` through `from`: looked for from a point of each.
pub(super) fn meet(
    pair: [&Program; 2],
    from: [[f64; 3]; 2],
    axis: usize,
    scale: &Scale,
    sampler: &mut Sampler,
) -> Meeting {
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut places = from;
    let mut cosine = 0.0;
    for _ in 0..STEPS {
        // Lines of the plane: the tangents of the two surfaces, each at its own place in the first step.
        let locals = [Local::of(pair[0], places[0], sampler), Local::of(pair[1], places[1], sampler)];
        if !locals.iter().all(Local::is_finite) {
            return Meeting::Nowhere;
        }
        let lines = [0, 1].map(|k| {
            let [a, b] = [locals[k].slope[u], locals[k].slope[v]];
            let length = a.hypot(b);
            let (a, b) = (a / length, b / length);
            [a, b, a * places[k][u] + b * places[k][v] - locals[k].value / length]
        });
        cosine = dot(locals[0].normal(), locals[1].normal());
        let sine = lines[0][0] * lines[1][1] - lines[0][1] * lines[1][0];
        if sine.is_nan() || sine.abs() < LEAST_SINE {
            break;
        }
        let mut next = places[0];
        let middle = [u, v].map(|d| 0.5 * (places[0][d] + places[1][d]));
        // Relative to the middle, so that no digits are lost far from the origin.
        let rest = lines.map(|[a, b, c]| c - a * middle[0] - b * middle[1]);
        let step = [
            (rest[0] * lines[1][1] - rest[1] * lines[0][1]) / sine,
            (lines[0][0] * rest[1] - lines[1][0] * rest[0]) / sine,
        ];
        let length = step[0].hypot(step[1]);
        let shorter = (scale.cell / length).min(1.0);
        (next[u], next[v]) = (middle[0] + shorter * step[0], middle[1] + shorter * step[1]);
        if [u, v].iter().any(|&d| (next[d] - from[0][d]).abs() > 4.0 * scale.cell) {
            return Meeting::Nowhere;
        }
        let is_one = places[0] == places[1];
        places = [next; 2];
        if is_one && length <= (CONVERGED * scale.cell).max(4.0 * f64::EPSILON * next[u].abs().max(next[v].abs())) {
            return if cosine > SMOOTH { Meeting::Smooth } else { Meeting::At(next) };
        }
    }
    if cosine > SMOOTH { Meeting::Smooth } else { Meeting::Nowhere }
}

/// The point nearest to `from`, about, where several surfaces meet: on a curve if they are two, a corner if they are more.
pub(super) fn corner(pieces: &[&Program], from: [f64; 3], scale: &Scale, sampler: &mut Sampler) -> Option<[f64; 3]> {
    let mut at = from;
    for _ in 0..STEPS {
        let locals: Vec<Local> = pieces.iter().map(|piece| Local::of(piece, at, sampler)).collect();
        let step = least_squares(&locals)?;
        let length = dot(step, step).sqrt();
        let shorter = (scale.cell / length).min(1.0);
        at = std::array::from_fn(|d| at[d] + shorter * step[d]);
        if (0..3).any(|d| (at[d] - from[d]).abs() > 4.0 * scale.cell) {
            return None;
        }
        let resolved = 8.0 * f64::EPSILON * at.iter().fold(0.0_f64, |m, c| m.max(c.abs()));
        if length <= (CONVERGED * scale.cell).max(resolved) {
            let is_there = |piece: &&Program| Local::of(piece, at, sampler).distance() <= 1e-3 * scale.near + resolved;
            return pieces.iter().all(is_there).then_some(at);
        }
    }
    None
}

/// The shortest step that comes nearest to all tangent planes.
fn least_squares(locals: &[Local]) -> Option<[f64; 3]> {
    let mut matrix = [[0.0; 3]; 3];
    let mut right = [0.0; 3];
    for local in locals {
        let steepness = local.steepness();
        if !local.is_finite() || steepness == 0.0 {
            return None;
        }
        let (row, rest) = (local.slope.map(|s| s / steepness), -local.value / steepness);
        for r in 0..3 {
            right[r] += row[r] * rest;
            (0..3).for_each(|c| matrix[r][c] += row[r] * row[c]);
        }
    }
    let (values, vectors) = eigen(matrix);
    let largest = values.into_iter().fold(0.0, f64::max);
    let mut step = [0.0; 3];
    for (value, vector) in values.into_iter().zip(vectors) {
        // Directions in which the planes do not differ stay as they are.
        if value > 1e-7 * largest {
            let part = dot(vector, right) / value;
            (0..3).for_each(|d| step[d] += part * vector[d]);
        }
    }
    step.iter().all(|s| s.is_finite()).then_some(step)
}

/// The eigenvalues and eigenvectors of a symmetric matrix, by Jacobi's rotations.
fn eigen(mut a: [[f64; 3]; 3]) -> ([f64; 3], [[f64; 3]; 3]) {
    let mut vectors = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    for _ in 0..12 {
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            if a[p][q].abs() <= f64::EPSILON * 1e-3 * (a[p][p].abs() + a[q][q].abs()) {
                continue;
            }
            let theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
            let t = theta.signum() / (theta.abs() + (theta * theta + 1.0).sqrt());
            let t = if theta == 0.0 { 1.0 } else { t };
            let c = 1.0 / (t * t + 1.0).sqrt();
            let s = t * c;
            for row in &mut a {
                (row[p], row[q]) = (c * row[p] - s * row[q], s * row[p] + c * row[q]);
            }
            for k in 0..3 {
                (a[p][k], a[q][k]) = (c * a[p][k] - s * a[q][k], s * a[p][k] + c * a[q][k]);
                (vectors[p][k], vectors[q][k]) =
                    (c * vectors[p][k] - s * vectors[q][k], s * vectors[p][k] + c * vectors[q][k]);
            }
        }
    }
    ([a[0][0], a[1][1], a[2][2]], vectors)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_planes_meet_in_their_corner_and_two_in_the_nearest_point() {
        let plane = |value: f64, slope: [f64; 3]| Local { value, slope };
        let three = [plane(-1.0, [2.0, 0.0, 0.0]), plane(2.0, [0.0, 1.0, 1.0]), plane(0.0, [0.0, 1.0, -1.0])];
        let step = least_squares(&three).expect("they meet");
        [0.5, -1.0, -1.0].iter().zip(step).for_each(|(want, got)| assert!((want - got).abs() < 1e-14, "{step:?}"));
        let step = least_squares(&three[..2]).expect("they meet");
        [0.5, -1.0, -1.0].iter().zip(step).for_each(|(want, got)| assert!((want - got).abs() < 1e-14, "{step:?}"));
        assert_eq!(least_squares(&[plane(1.0, [0.0; 3])]), None);
    }
}
