//! The triangles of a mesh by the leaves and cells of its grid, and the closed polygons that those of a cell fill. Evaluates nothing.

use std::ops::Range;

use rayon::prelude::*;

use super::super::grid::Grid;
use super::super::mesh::Mesh;
use super::leaf_of;

/// Triangles that are looked at by one thread at once.
const AT_ONCE: usize = 1 << 13;

/// The cells of a grid, by the coordinates of their sides.
pub(super) struct Cells {
    sides: [Vec<f64>; 3],
    lo: [f64; 3],
    /// Cells per unit of length.
    density: [f64; 3],
}

impl Cells {
    pub(super) fn of(grid: &Grid) -> Self {
        let sides = |d: usize| (0..=grid.cells[d]).map(|i| grid.coordinate(d, i)).collect();
        Self { sides: std::array::from_fn(sides), lo: grid.lo, density: grid.cell().map(|cell| 1.0 / cell) }
    }

    /// The cell that holds a coordinate.
    pub(super) fn along(&self, axis: usize, at: f64) -> usize {
        let sides = &self.sides[axis];
        let last = sides.len().saturating_sub(2);
        let mut cell = (((at - self.lo[axis]) * self.density[axis]) as usize).min(last);
        while cell > 0 && at < sides[cell] {
            cell -= 1;
        }
        while cell < last && at >= sides[cell + 1] {
            cell += 1;
        }
        cell
    }

    /// The cell of a triangle, whose middle is never in a face of it.
    fn of_triangle(&self, mesh: &Mesh, triangle: [u32; 3]) -> [usize; 3] {
        let [a, b, c] = mesh.corners(triangle);
        std::array::from_fn(|d| self.along(d, (a[d] + b[d] + c[d]) / 3.0))
    }
}

/// The object's own triangles by leaves: the number of the leaf, and triangles that follow each other; ascending.
pub(super) fn by_leaves(mesh: &Mesh, own: usize, grid: &Grid, cells: &Cells) -> Vec<(usize, Range<usize>)> {
    let parts: Vec<Vec<(usize, Range<usize>)>> = mesh.triangles[..own]
        .par_chunks(AT_ONCE)
        .enumerate()
        .map(|(n, triangles)| {
            let mut runs: Vec<(usize, Range<usize>)> = Vec::new();
            for (t, &triangle) in (n * AT_ONCE..).zip(triangles) {
                let leaf = leaf_of(grid, cells.of_triangle(mesh, triangle));
                match runs.last_mut() {
                    Some(last) if last.0 == leaf => last.1.end = t + 1,
                    _ => runs.push((leaf, t..t + 1)),
                }
            }
            runs
        })
        .collect();
    let mut all: Vec<(usize, Range<usize>)> = parts.into_iter().flatten().collect();
    all.sort_by_key(|(leaf, triangles)| (*leaf, triangles.start));
    all
}

/// A closed polygon and the triangles that fill it.
#[derive(Clone, Debug, Default)]
pub(super) struct Polygon {
    /// Its corners, counter-clockwise seen from outside the solid.
    pub(super) corners: Vec<u32>,
    /// By their numbers in the mesh.
    pub(super) triangles: Vec<usize>,
}

/// The triangles of some ranges by their cells.
pub(super) fn by_cells(mesh: &Mesh, ranges: &[(usize, Range<usize>)], cells: &Cells) -> Vec<([usize; 3], Vec<usize>)> {
    let mut all: Vec<([usize; 3], Vec<usize>)> = Vec::new();
    for t in ranges.iter().flat_map(|(_, range)| range.clone()) {
        let cell = cells.of_triangle(mesh, mesh.triangles[t]);
        match all.last_mut() {
            Some(last) if last.0 == cell => last.1.push(t),
            _ => all.push((cell, vec![t])),
        }
    }
    // A cell that two ranges share.
    all.sort_by_key(|(cell, triangles)| (cell[2], cell[1], cell[0], triangles[0]));
    all.dedup_by(|next, last| {
        let is_same = next.0 == last.0;
        if is_same {
            last.1.append(&mut next.1);
        }
        is_same
    });
    all
}

/// The polygons that the triangles of one cell fill, in the order of their first sides.
pub(super) fn polygons(mesh: &Mesh, numbers: &[usize]) -> Vec<Polygon> {
    let triangle = |&t: &usize| mesh.triangles[t];
    let sides: Vec<[u32; 2]> = numbers.iter().map(triangle).flat_map(|[a, b, c]| [[a, b], [b, c], [c, a]]).collect();
    let mut border: Vec<[u32; 2]> = sides.iter().filter(|[a, b]| !sides.contains(&[*b, *a])).copied().collect();
    let mut all = Vec::new();
    while let Some(&[first, _]) = border.first() {
        let (mut corners, mut at) = (Vec::new(), first);
        while let Some(next) = border.iter().position(|side| side[0] == at) {
            corners.push(at);
            at = border.remove(next)[1];
        }
        let within = |t: &&usize| corners.contains(&triangle(t)[0]);
        all.push(Polygon { triangles: numbers.iter().filter(within).copied().collect(), corners });
    }
    all
}
