//! The triangles of a mesh by the cells of its grid, and the closed polygons that those of a cell fill. Evaluates nothing.

use std::ops::Range;

use super::super::grid::Grid;
use super::super::mesh::Mesh;
use super::leaf_of;

/// Triangles that lie in one cell and follow each other in the mesh.
#[derive(Clone, Debug)]
pub(super) struct Patch {
    pub(super) cell: [usize; 3],
    pub(super) triangles: Range<usize>,
}

impl Patch {
    /// The number of the leaf that owns the cell.
    pub(super) fn leaf(&self, grid: &Grid) -> usize {
        leaf_of(grid, self.cell)
    }
}

/// The patches of the object's own triangles, in their order.
pub(super) fn patches(mesh: &Mesh, own: usize, grid: &Grid) -> Vec<Patch> {
    let mut all: Vec<Patch> = Vec::with_capacity(own / 2);
    for (t, &triangle) in mesh.triangles[..own].iter().enumerate() {
        let [a, b, c] = mesh.corners(triangle);
        let cell = std::array::from_fn(|d| cell_along(grid, d, (a[d] + b[d] + c[d]) / 3.0));
        match all.last_mut() {
            Some(last) if last.cell == cell => last.triangles.end = t + 1,
            _ => all.push(Patch { cell, triangles: t..t + 1 }),
        }
    }
    all
}

/// The cell that holds a coordinate. The middle of a triangle is never in a face of its cell.
pub(super) fn cell_along(grid: &Grid, axis: usize, at: f64) -> usize {
    let last = grid.cells[axis] - 1;
    let mut cell = (((at - grid.lo[axis]) / grid.cell()[axis]) as usize).min(last);
    while cell > 0 && at < grid.coordinate(axis, cell) {
        cell -= 1;
    }
    while cell < last && at >= grid.coordinate(axis, cell + 1) {
        cell += 1;
    }
    cell
}

/// A closed polygon and the triangles that fill it.
#[derive(Clone, Debug, Default)]
pub(super) struct Polygon {
    /// Its corners, counter-clockwise seen from outside the solid.
    pub(super) corners: Vec<u32>,
    pub(super) triangles: Vec<[u32; 3]>,
}

/// The polygons that the triangles of one cell fill, in the order of their first sides.
pub(super) fn polygons(triangles: &[[u32; 3]]) -> Vec<Polygon> {
    let sides = || triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
    let mut border: Vec<[u32; 2]> = sides().filter(|&[a, b]| !sides().any(|side| side == [b, a])).collect();
    let mut all = Vec::new();
    while let Some(&[first, _]) = border.first() {
        let (mut corners, mut at) = (Vec::new(), first);
        while let Some(next) = border.iter().position(|side| side[0] == at) {
            corners.push(at);
            at = border.remove(next)[1];
        }
        let within = |triangle: &&[u32; 3]| corners.contains(&triangle[0]);
        all.push(Polygon { triangles: triangles.iter().filter(within).copied().collect(), corners });
    }
    all
}
