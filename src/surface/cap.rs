//! Caps: closes a mesh at the faces of the modelling space, as if everything beyond were outside. Adds no evaluation.
//!
//! Each square of sample points in a face is filled up to the mesh: inside points become vertices, exactly on the face, and ambiguous squares
//! separate their inside corners as cubes do. A sample point has one vertex, also on an edge of the space that two faces share.

use rustc_hash::FxHashMap;

use super::brick::{Bricks, Leaf};
use super::grid::{Grid, LEAF};
use super::marching::SurfaceError;
use super::mesh::unit;
use crate::interrupt::Interrupt;

/// The caps of a mesh.
#[derive(Debug, Default)]
pub struct Caps {
    /// New vertices: inside sample points in the faces. Their numbers follow those of the mesh.
    pub positions: Vec<[f64; 3]>,
    /// Unit vectors out of the space.
    pub normals: Vec<[f64; 3]>,
    /// The six faces: lower and upper for each axis.
    pub faces: Vec<Face>,
}

/// The cap in one face.
#[derive(Debug)]
pub struct Face {
    /// The axis across the face.
    pub axis: usize,
    /// 0 for the lower face, 1 for the upper.
    pub side: usize,
    /// Its triangles, over the vertices of the mesh and then those of the caps.
    pub triangles: Vec<[u32; 3]>,
    /// Its new vertices, as indices into [`Caps::positions`], each once.
    pub points: Vec<u32>,
}

/// Fills the six faces; None where the vertices become more than [`Bricks::most_vertices`].
///
/// # Errors
/// If the work was asked to stop, or a vertex is missing that the signs ask for.
pub fn close(bricks: &Bricks, interrupt: &Interrupt) -> Result<Option<Caps>, SurfaceError> {
    let mut closing = Closing { bricks, numbers: FxHashMap::default(), caps: Caps::default() };
    for (axis, side) in (0..6).map(|face| (face / 2, face % 2)) {
        let Some(face) = closing.face(axis, side, interrupt)? else { return Ok(None) };
        closing.caps.faces.push(face);
    }
    Ok(Some(closing.caps))
}

struct Closing<'a> {
    bricks: &'a Bricks,
    numbers: FxHashMap<[usize; 3], u32>,
    caps: Caps,
}

impl Closing<'_> {
    /// Leaf by leaf, since most of a face is outside as a whole.
    fn face(&mut self, axis: usize, side: usize, interrupt: &Interrupt) -> Result<Option<Face>, SurfaceError> {
        let grid = self.bricks.grid;
        let plane = Plane::new(&grid, axis, side);
        let mut face = Face { axis, side, triangles: Vec::new(), points: Vec::new() };
        let leaves = grid.leaves();
        for v in 0..leaves[plane.v] {
            interrupt.tick()?;
            if self.bricks.positions.len() + self.caps.positions.len() > self.bricks.most_vertices {
                return Ok(None);
            }
            for u in 0..leaves[plane.u] {
                let mut at = [0; 3];
                (at[axis], at[plane.u], at[plane.v]) = (plane.index / LEAF, u, v);
                if matches!(self.bricks.leaf(at), Leaf::Outside) {
                    continue;
                }
                for j in v * LEAF..((v + 1) * LEAF).min(grid.cells[plane.v]) {
                    for i in u * LEAF..((u + 1) * LEAF).min(grid.cells[plane.u]) {
                        self.square(&plane.ring(i, j), &mut face.triangles)?;
                    }
                }
            }
        }
        self.list_points(&mut face);
        Ok(Some(face))
    }

    /// Fills one square: a fan for every run of inside corners between the vertices on the sides where the ring enters and leaves it.
    fn square(&mut self, ring: &[[usize; 3]; 4], triangles: &mut Vec<[u32; 3]>) -> Result<(), SurfaceError> {
        let inside = ring.map(|corner| self.bricks.is_inside(corner));
        if inside == [true; 4] {
            let [a, b, c, d] = ring.map(|corner| self.number(corner));
            triangles.extend([[a, b, c], [a, c, d]]);
            return Ok(());
        }
        for (first, length) in runs(inside) {
            let last = first + length - 1;
            let start = side_vertex(self.bricks, ring[(first + 3) % 4], ring[first])?;
            let end = side_vertex(self.bricks, ring[last % 4], ring[(last + 1) % 4])?;
            let corners: Vec<u32> = (first..=last).map(|i| self.number(ring[i % 4])).chain([end]).collect();
            triangles.extend(corners.windows(2).map(|pair| [start, pair[0], pair[1]]));
        }
        Ok(())
    }

    /// The number of the vertex at a sample point.
    fn number(&mut self, index: [usize; 3]) -> u32 {
        let (grid, caps) = (&self.bricks.grid, &mut self.caps);
        let known = self.bricks.positions.len();
        *self.numbers.entry(index).or_insert_with(|| {
            caps.positions.push(grid.point(index));
            caps.normals.push(outward(grid, index));
            (known + caps.positions.len() - 1) as u32
        })
    }

    fn list_points(&self, face: &mut Face) {
        let known = self.bricks.positions.len() as u32;
        let used = face.triangles.iter().flatten().filter(|&&v| v >= known).map(|v| v - known);
        face.points.extend(used);
        face.points.sort_unstable();
        face.points.dedup();
    }
}

/// The unit vector out of the space at a sample point in its faces.
fn outward(grid: &Grid, index: [usize; 3]) -> [f64; 3] {
    let sum = std::array::from_fn(|d| match index[d] {
        0 => -1.0,
        i if i == grid.cells[d] => 1.0,
        _ => 0.0,
    });
    unit(sum).unwrap_or([0.0, 0.0, 1.0])
}

/// The runs of inside corners of a ring with an outside one: index of the first (below 4), and length.
pub(super) fn runs(inside: [bool; 4]) -> impl Iterator<Item = (usize, usize)> {
    (0..4).filter(move |&i| inside[i] && !inside[(i + 3) % 4]).map(move |first| {
        let length = (1..4).find(|k| !inside[(first + k) % 4]).unwrap_or(4);
        (first, length)
    })
}

/// The vertex on the crossed side between two neighbouring sample points.
pub(super) fn side_vertex(bricks: &Bricks, a: [usize; 3], b: [usize; 3]) -> Result<u32, SurfaceError> {
    let start = std::array::from_fn(|d| a[d].min(b[d]));
    let axis = (0..3).find(|&d| a[d] != b[d]).unwrap_or(0);
    bricks.vertex(start, axis).ok_or_else(|| SurfaceError::Contradiction(bricks.grid.point(start)))
}

/// A plane of sample points: across `axis` at `index`, spanned by `u` and `v`.
pub(super) struct Plane {
    axis: usize,
    index: usize,
    pub(super) u: usize,
    pub(super) v: usize,
    reversed: bool,
}

impl Plane {
    /// A face of the space.
    pub(super) fn new(grid: &Grid, axis: usize, side: usize) -> Self {
        Self { axis, index: side * grid.cells[axis], u: (axis + 1) % 3, v: (axis + 2) % 3, reversed: side == 0 }
    }

    /// The only plane of a 2-D grid, seen from above: x1 to the right, x2 up.
    pub(super) fn flat() -> Self {
        Self { axis: 2, index: 0, u: 0, v: 1, reversed: false }
    }

    /// The corners of a square, counter-clockwise seen from outside.
    pub(super) fn ring(&self, i: usize, j: usize) -> [[usize; 3]; 4] {
        let mut ring = [[0, 0], [1, 0], [1, 1], [0, 1]].map(|[a, b]| {
            let mut at = [0; 3];
            (at[self.axis], at[self.u], at[self.v]) = (self.index, i + a, j + b);
            at
        });
        if self.reversed {
            ring.reverse();
        }
        ring
    }
}
