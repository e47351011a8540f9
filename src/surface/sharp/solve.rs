//! Where surfaces meet: Newton's method on two of them or more, for many starts at once. Knows no mesh.

use super::super::grid::Grid;
use super::super::mesh::{dot, unit};
use super::super::sampler::Sampler;
use crate::vm::Program;

/// Surfaces whose normals differ by less than 0.002 are one smooth surface.
const SMOOTH: f64 = 1.0 - 2e-6;
/// Steps of Newton's method: where surfaces touch each step halves the distance only.
const STEPS: usize = 40;
/// When a step is so short, in cells, the place is known.
const CONVERGED: f64 = 1e-11;
/// How far from where it starts a place is looked for, in cells along each axis.
const RANGE: f64 = 8.0;

/// The value of a piece at a point, and its slopes.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Local {
    pub(super) value: f64,
    pub(super) slope: [f64; 3],
}

impl Local {
    /// A program at many points.
    pub(super) fn all(program: &Program, at: &[[f64; 3]], sampler: &mut Sampler) -> Vec<Self> {
        let columns: [Vec<f64>; 3] = std::array::from_fn(|d| at.iter().map(|p| p[d]).collect());
        let mut value = vec![0.0; at.len()];
        let mut slopes: [Vec<f64>; 3] = std::array::from_fn(|_| vec![0.0; at.len()]);
        let dimension = sampler.dimension();
        let [x, y, z] = &columns;
        let [a, b, c] = &mut slopes;
        let by = &mut [&mut a[..], b, c][..dimension];
        sampler.slopes(program, &[&x[..], y, z][..dimension], &mut value, by);
        let [a, b, c] = &slopes;
        (0..at.len()).map(|i| Self { value: value[i], slope: [a[i], b[i], c[i]] }).collect()
    }

    pub(super) fn of(program: &Program, at: [f64; 3], sampler: &mut Sampler) -> Self {
        Self::all(program, &[at], sampler)[0]
    }

    /// The values of a program at points.
    pub(super) fn values(program: &Program, at: &[[f64; 3]], sampler: &mut Sampler) -> Vec<f64> {
        let columns: [Vec<f64>; 3] = std::array::from_fn(|d| at.iter().map(|p| p[d]).collect());
        let [x, y, z] = &columns;
        let mut values = vec![0.0; at.len()];
        let dimension = sampler.dimension();
        sampler.values(program, &[&x[..], y, z][..dimension], &mut values);
        values
    }

    fn is_finite(&self) -> bool {
        self.value.is_finite() && self.slope.iter().all(|s| s.is_finite())
    }

    pub(super) fn steepness(&self) -> f64 {
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
    /// The sides of a cell; 1 where there is no axis.
    pub(super) cell: [f64; 3],
    /// How far a vertex may be from a surface on which it lies: as far as vertices are kept off the ends of their edges.
    pub(super) near: f64,
    /// Least distance of a new vertex from the sides of its square in a face of the space, by axis.
    pub(super) margin: [f64; 3],
    space: [[f64; 3]; 2],
}

impl Scale {
    pub(super) fn of(grid: &Grid) -> Self {
        let cell = grid.cell();
        let margin = std::array::from_fn(|d| {
            let unit = grid.lo[d].abs().max(grid.hi[d].abs()) * f64::from(f32::EPSILON);
            (8.0 * unit).max(1e-6 * cell[d]).min(0.25 * cell[d])
        });
        let near = 1.1 * margin.iter().fold(0.0, |m: f64, &c| m.max(c));
        let cell = std::array::from_fn(|d| if d < grid.dimension() { cell[d] } else { 1.0 });
        Self { cell, near, margin, space: [grid.lo, grid.hi] }
    }

    /// From one point to another, in cells.
    pub(super) fn cells(&self, from: [f64; 3], to: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|d| (to[d] - from[d]) / self.cell[d])
    }

    /// Of a place that is not within the space: an axis along which it is not, and the place moved within.
    pub(super) fn beyond(&self, place: [f64; 3], dimension: usize) -> Option<(usize, [f64; 3])> {
        (0..dimension).find_map(|d| {
            let inner = [self.space[0][d] + self.margin[d], self.space[1][d] - self.margin[d]];
            let is_within = place[d] > inner[0] && place[d] < inner[1];
            let mut moved = place;
            moved[d] = moved[d].clamp(self.space[0][d] + 0.05 * self.cell[d], self.space[1][d] - 0.05 * self.cell[d]);
            (!is_within).then_some((d, moved))
        })
    }

    /// A coordinate of a new vertex in a face of the space, kept off the ends of the range of its cell, on whichever side it is.
    pub(super) fn kept_off(&self, axis: usize, at: f64, [lo, hi]: [f64; 2]) -> Option<f64> {
        let margin = self.margin[axis];
        let is_clear = |end: f64| (at - end).abs() >= margin;
        let kept = if is_clear(lo) && is_clear(hi) { at } else { at.clamp(lo + margin, hi - margin) };
        (kept > self.space[0][axis] && kept < self.space[1][axis]).then_some(kept)
    }
}

/// What becomes of surfaces near a place.
#[derive(Clone, Debug)]
pub(super) enum Meeting {
    /// They cross there, where they are like this.
    At([f64; 3], Vec<Local>),
    /// They are one smooth surface, or go over into each other.
    Smooth,
    /// They do not meet nearby.
    Nowhere,
}

/// The points nearest to each start, about, where surfaces meet: on a curve if they are two, a corner if they are more. In the plane across an axis
/// if there is one.
pub(super) fn meet(
    pieces: &[&Program],
    from: &[[f64; 3]],
    axis: Option<usize>,
    scale: &Scale,
    sampler: &mut Sampler,
) -> Vec<Meeting> {
    let mut found = vec![Meeting::Nowhere; from.len()];
    let mut places = from.to_vec();
    let mut open: Vec<usize> = (0..from.len()).collect();
    let narrowest = scale.cell.iter().fold(f64::INFINITY, |m: f64, &c| m.min(c));
    for _ in 0..STEPS {
        let at: Vec<[f64; 3]> = open.iter().map(|&i| places[i]).collect();
        let locals: Vec<Vec<Local>> = pieces.iter().map(|piece| Local::all(piece, &at, sampler)).collect();
        let mut next = Vec::with_capacity(open.len());
        for (k, &i) in open.iter().enumerate() {
            let here: Vec<Local> = locals.iter().map(|of| of[k]).collect();
            let resolved = 8.0 * f64::EPSILON * places[i].iter().fold(0.0_f64, |m, c| m.max(c.abs()));
            let is_smooth = pieces.len() == 2 && dot(here[0].normal(), here[1].normal()) > SMOOTH;
            // Where surfaces touch the way to the line is long, and the line does not matter.
            if is_smooth && here.iter().all(|local| local.distance() <= scale.near) {
                found[i] = Meeting::Smooth;
                continue;
            }
            let Some(step) = least_squares(&here, axis, scale) else { continue };
            let length = dot(step, step).sqrt();
            if length <= CONVERGED.max(resolved / narrowest) {
                if is_smooth {
                    found[i] = Meeting::Smooth;
                } else if here.iter().all(|local| local.distance() <= 1e-3 * scale.near + resolved) {
                    found[i] = Meeting::At(places[i], here);
                }
                continue;
            }
            let shorter = (1.0 / length).min(1.0);
            places[i] = std::array::from_fn(|d| places[i][d] + shorter * step[d] * scale.cell[d]);
            if scale.cells(from[i], places[i]).iter().any(|way| way.abs() > RANGE) {
                continue;
            }
            next.push(i);
        }
        open = next;
    }
    found
}

/// The shortest step that comes nearest to all tangent planes, in cells.
fn least_squares(locals: &[Local], axis: Option<usize>, scale: &Scale) -> Option<[f64; 3]> {
    let mut matrix = [[0.0; 3]; 3];
    let mut right = [0.0; 3];
    for local in locals {
        let slope: [f64; 3] =
            std::array::from_fn(|d| if Some(d) == axis { 0.0 } else { local.slope[d] * scale.cell[d] });
        let steepness = dot(slope, slope).sqrt();
        if !local.is_finite() || steepness == 0.0 {
            return None;
        }
        let (row, rest) = (slope.map(|s| s / steepness), -local.value / steepness);
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
        let mut is_done = true;
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            if a[p][q].abs() <= f64::EPSILON * 1e-3 * (a[p][p].abs() + a[q][q].abs()) {
                continue;
            }
            is_done = false;
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
        if is_done {
            break;
        }
    }
    ([a[0][0], a[1][1], a[2][2]], vectors)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_planes_meet_in_their_corner_and_two_in_the_nearest_point() {
        let scale = Scale { cell: [1.0; 3], near: 0.0, margin: [0.0; 3], space: [[0.0; 3]; 2] };
        let plane = |value: f64, slope: [f64; 3]| Local { value, slope };
        let three = [plane(-1.0, [2.0, 0.0, 0.0]), plane(2.0, [0.0, 1.0, 1.0]), plane(0.0, [0.0, 1.0, -1.0])];
        let step = least_squares(&three, None, &scale).expect("they meet");
        [0.5, -1.0, -1.0].iter().zip(step).for_each(|(want, got)| assert!((want - got).abs() < 1e-14, "{step:?}"));
        let step = least_squares(&three[..2], None, &scale).expect("they meet");
        [0.5, -1.0, -1.0].iter().zip(step).for_each(|(want, got)| assert!((want - got).abs() < 1e-14, "{step:?}"));
        let step = least_squares(&three[..2], Some(2), &scale).expect("they meet");
        [0.5, -2.0, 0.0].iter().zip(step).for_each(|(want, got)| assert!((want - got).abs() < 1e-14, "{step:?}"));
        assert_eq!(least_squares(&[plane(1.0, [0.0; 3])], None, &scale), None);
    }
}
