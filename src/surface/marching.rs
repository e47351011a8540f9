//! Marching cubes with one consistent table: from a shape and a grid to a mesh that is closed, oriented and 2-manifold by construction.
//!
//! Zero is inside, undefined is outside. The mesh has the signs of dense sampling at every sample point, only sooner. It is capped by the
//! modelling space, and the report says where. It may cut through itself where the solid is thinner than a cell, and it promises nothing
//! about parts that lie between sample points.

use std::fmt;
use std::sync::{Mutex, PoisonError};

use rayon::prelude::*;

use super::boxes::Lattice;
use super::brick::{Brick, Bricks, Leaf, bits};
use super::cap::{Caps, close};
use super::detail::Detail;
use super::grid::{Grid, LEAF};
use super::mesh::{Mesh, cross, minus, pieces, unit};
use super::sampler::{Counters, Sampler};
use super::sharp::Sharpened;
use super::table::{CASES, Edge, edge_start};
use crate::interrupt::{Cancelled, Interrupt};
use crate::limits::Limits;
use crate::reuse::Digest;
use crate::vm::{Precision, Shape};

/// A mesh and what there is to say about it.
#[derive(Clone, Debug)]
pub struct Extraction {
    /// The mesh; without triangles where no sample point is inside.
    pub mesh: Mesh,
    /// How many of its triangles are the object's own; those behind them close it at the faces of the space.
    pub own: usize,
    /// What it cost, where it was cut.
    pub report: Report,
}

/// What there is to say about an extraction.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Report {
    /// Points and boxes evaluated, undefined points.
    pub counters: Counters,
    /// Sample points of the whole grid: what dense sampling would have evaluated.
    pub samples: u64,
    /// Faces of the modelling space beyond which the object goes on: lower and upper for each axis. A boundary that lies exactly in a
    /// face is not cut by it.
    pub cut: [[bool; 2]; 3],
    /// Whether the whole space is inside.
    pub full: bool,
    /// Some of what the grid is too coarse to show.
    pub details: Vec<Detail>,
    /// What became of the creases, if they were to be sharp.
    pub sharpened: Option<Sharpened>,
}

/// Why there is no mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SurfaceError {
    /// The work was asked to stop.
    Cancelled,
    /// The shape has another number of coordinates than the grid (shape, grid).
    Dimension(usize, usize),
    /// The mesh would take more than this many bytes, `Limits::memory_bytes`.
    Memory(usize),
    /// Near this place the signs of neighbouring boxes contradict each other: an error of the evaluator, never of the user.
    Contradiction([f64; 3]),
}

impl fmt::Display for SurfaceError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Cancelled => write!(f, "cancelled"),
            Self::Dimension(shape, grid) => {
                write!(f, "the object has {shape} free coordinates where {grid} are needed")
            }
            Self::Memory(limit) => write!(f, "the mesh would take more than {} MiB of memory", limit >> 20),
            Self::Contradiction([x, y, z]) => write!(f, "the signs near ({x}, {y}, {z}) contradict each other"),
        }
    }
}

impl std::error::Error for SurfaceError {}

impl From<Cancelled> for SurfaceError {
    fn from(_: Cancelled) -> Self {
        Self::Cancelled
    }
}

/// Extracts the boundary of a 3-D shape on a grid. Runs on the current rayon pool; the same result for any number of threads.
///
/// # Errors
/// See [`SurfaceError`].
pub fn extract(shape: &Shape, grid: &Grid, limits: &Limits, interrupt: &Interrupt) -> Result<Extraction, SurfaceError> {
    extract_with(shape, grid, true, limits, interrupt)
}

/// The same without normals, for whatever has no use for them: [`Mesh::normals`] stays empty.
///
/// # Errors
/// See [`SurfaceError`].
pub fn extract_bare(
    shape: &Shape,
    grid: &Grid,
    limits: &Limits,
    interrupt: &Interrupt,
) -> Result<Extraction, SurfaceError> {
    extract_with(shape, grid, false, limits, interrupt)
}

fn extract_with(
    shape: &Shape,
    grid: &Grid,
    normals: bool,
    limits: &Limits,
    interrupt: &Interrupt,
) -> Result<Extraction, SurfaceError> {
    let make = || match extract_once(shape, grid, normals, limits, interrupt) {
        // Single precision, which took another branch than the intervals did.
        Err(SurfaceError::Contradiction(_)) if shape.precision == Precision::Single => {
            let double = Shape { precision: Precision::Double, ..shape.clone() };
            extract_once(&double, grid, normals, limits, interrupt)
        }
        result => result,
    };
    let tell = |to: &mut Digest| {
        shape.tell(to);
        to.shown(&(grid, limits.memory_bytes, normals));
    };
    let bytes = |of: &Extraction| {
        (of.mesh.positions.len() + of.mesh.normals.len()) * size_of::<[f64; 3]>()
            + of.mesh.triangles.len() * size_of::<[u32; 3]>()
    };
    interrupt.whole("meshes", tell, bytes, make)
}

fn extract_once(
    shape: &Shape,
    grid: &Grid,
    normals: bool,
    limits: &Limits,
    interrupt: &Interrupt,
) -> Result<Extraction, SurfaceError> {
    if shape.dimension != 3 || grid.dimension() != 3 {
        return Err(SurfaceError::Dimension(shape.dimension, 3));
    }
    let mut bricks = {
        let _phase = interrupt.phase("boxes");
        let survey = if normals { Bricks::survey } else { Bricks::survey_bare };
        survey(shape, grid, limits, interrupt)?
    };
    let _phase = interrupt.phase("mesh");
    let samples = grid.counts().iter().map(|&n| n as u64).product();
    let mut report = Report {
        counters: std::mem::take(&mut bricks.counters),
        samples,
        full: bricks.is_full(),
        details: std::mem::take(&mut bricks.details),
        ..Report::default()
    };
    let mut triangles = join(&bricks, interrupt)?;
    let caps = close(&bricks, interrupt)?.ok_or(SurfaceError::Memory(limits.memory_bytes))?;
    let uncapped = bricks.positions.len();
    let mut mesh = Mesh {
        positions: std::mem::take(&mut bricks.positions),
        normals: std::mem::take(&mut bricks.normals),
        triangles: Vec::new(),
    };
    let own = triangles.len();
    for face in &caps.faces {
        triangles.extend_from_slice(&face.triangles);
        report.cut[face.axis][face.side] = goes_on(shape, &caps, &face.points, &mut report.counters, interrupt);
    }
    interrupt.tick()?;
    mesh.positions.extend_from_slice(&caps.positions);
    mesh.triangles = triangles;
    if normals {
        mesh.normals.extend_from_slice(&caps.normals);
        mend(&mut mesh, uncapped);
    }
    Ok(Extraction { mesh, own, report })
}

/// The triangles of all cells between sample points, in the order of the bricks: counted first, then written where they belong.
fn join(bricks: &Bricks, interrupt: &Interrupt) -> Result<Vec<[u32; 3]>, SurfaceError> {
    let cases = Cases::new();
    let chunks: Vec<(&[Brick], usize)> = bricks
        .bricks
        .par_chunks(64)
        .map(|chunk| {
            let count = |brick| Neighbourhood::of(bricks, brick).count(&cases);
            (chunk, chunk.iter().map(count).sum())
        })
        .collect();
    interrupt.tick()?;
    // The first place where signs contradict each other, by the order of the bricks.
    let fault: Mutex<Option<([usize; 3], [f64; 3])>> = Mutex::new(None);
    let triangles = pieces(
        chunks,
        |(_, count)| *count,
        |(chunk, _), mut triangles| {
            if interrupt.is_cancelled() {
                return;
            }
            let mut numbers = Numbers::default();
            for brick in chunk {
                let neighbourhood = Neighbourhood::of(bricks, brick);
                match neighbourhood.join(&cases, &mut numbers, triangles) {
                    Ok(rest) => triangles = rest,
                    Err(at) => {
                        let mut fault = fault.lock().unwrap_or_else(PoisonError::into_inner);
                        if fault.is_none_or(|(other, _)| brick.at < other) {
                            *fault = Some((brick.at, at));
                        }
                        return;
                    }
                }
            }
        },
    );
    interrupt.tick()?;
    match fault.into_inner().unwrap_or_else(PoisonError::into_inner) {
        Some((_, at)) => Err(SurfaceError::Contradiction(at)),
        None => Ok(triangles),
    }
}

/// Points along each side of a brick and the next plane.
const SIDE: usize = LEAF + 1;

/// From one point to the next along each axis.
const STRIDE: [usize; 3] = [1, SIDE, SIDE * SIDE];

/// Points in all.
const POINTS: usize = SIDE * SIDE * SIDE;

/// Numbers of vertices, by the axis of the edge and the point where it starts.
struct Numbers([u32; 3 * POINTS]);

/// No vertex.
const NONE: u32 = u32::MAX;

impl Default for Numbers {
    fn default() -> Self {
        Self([NONE; 3 * POINTS])
    }
}

/// The table with its edges as places among [`Numbers`], relative to the cell's lowest corner.
struct Cases(Vec<Vec<[usize; 3]>>);

impl Cases {
    fn new() -> Self {
        let place = |edge: Edge| {
            let (start, axis) = edge_start(edge);
            axis * POINTS + start.iter().zip(STRIDE).map(|(at, stride)| at * stride).sum::<usize>()
        };
        Self(CASES.iter().map(|case| case.iter().map(|t: &[Edge; 3]| t.map(place)).collect()).collect())
    }
}

/// A brick and the seven leaves that hold the far corners of its cells, by bits x, y, z.
struct Neighbourhood<'a> {
    leaves: [Leaf<'a>; 8],
    grid: &'a Grid,
    at: [usize; 3],
}

impl<'a> Neighbourhood<'a> {
    fn of(bricks: &'a Bricks, brick: &'a Brick) -> Self {
        let leaves = std::array::from_fn(|n| match n {
            0 => Leaf::Mixed(brick),
            _ => bricks.leaf(std::array::from_fn(|d| brick.at[d] + (n >> d & 1))),
        });
        Self { leaves, grid: &bricks.grid, at: brick.at }
    }

    /// The signs of 9 x 9 x 9 points, bit x of row (z, y).
    fn rows(&self) -> [[u16; SIDE]; SIDE] {
        let words: [[u64; LEAF]; 8] = std::array::from_fn(|n| self.leaves[n].inside());
        std::array::from_fn(|z| {
            std::array::from_fn(|y| {
                let n = 2 * (y / LEAF) + 4 * (z / LEAF);
                let row = |n: usize| (words[n][z % LEAF] >> (LEAF * (y % LEAF))) as u16 & 0xff;
                row(n) | (row(n + 1) & 1) << LEAF
            })
        })
    }

    /// Writes the numbers of the vertices on all edges that start at those points.
    fn number(&self, numbers: &mut Numbers) {
        numbers.0.fill(NONE);
        for (n, leaf) in self.leaves.iter().enumerate() {
            let Leaf::Mixed(brick) = leaf else { continue };
            let far: [usize; 3] = std::array::from_fn(|d| n >> d & 1);
            // Of a neighbour the points of its first plane, row or corner alone.
            let mask = [u64::MAX, 0x0101_0101_0101_0101][far[0]] & [u64::MAX, 0xff][far[1]];
            let corner = far.iter().zip(STRIDE).map(|(far, stride)| far * LEAF * stride).sum::<usize>();
            for axis in 0..3 {
                for z in 0..[LEAF, 1][far[2]] {
                    let plane = axis * POINTS + corner + z * STRIDE[2];
                    let word = brick.crossed[axis][z];
                    for (next, bit) in (brick.first_vertex(axis, z)..).zip(bits(word & mask)) {
                        let number = if n == 0 { next } else { brick.vertex([bit % LEAF, bit / LEAF, z], axis) };
                        numbers.0[plane + bit % LEAF + bit / LEAF * STRIDE[1]] = number;
                    }
                }
            }
        }
    }

    /// Calls `f` with the lowest corner of each of the brick's cells that are crossed, and its case.
    #[inline(always)]
    fn each(&self, mut f: impl FnMut([usize; 3], usize)) {
        let rows = self.rows();
        let cells: [usize; 3] = std::array::from_fn(|d| (self.grid.cells[d] - LEAF * self.at[d]).min(LEAF));
        for z in 0..cells[2] {
            for y in 0..cells[1] {
                let four = [rows[z][y], rows[z][y + 1], rows[z + 1][y], rows[z + 1][y + 1]];
                let any = four[0] | four[1] | four[2] | four[3];
                let all = four[0] & four[1] & four[2] & four[3];
                let mixed = (any | any >> 1) & !(all & all >> 1) & ((1 << cells[0]) - 1);
                for x in bits(u64::from(mixed)) {
                    f([x, y, z], (0..4).fold(0, |case, i| case | usize::from(four[i] >> x & 3) << (2 * i)));
                }
            }
        }
    }

    /// How many triangles the brick's cells have.
    fn count(&self, cases: &Cases) -> usize {
        let mut count = 0;
        self.each(|_, case| count += cases.0[case].len());
        count
    }

    /// Writes the triangles of the brick's cells and gives back what is behind them.
    ///
    /// # Errors
    /// A place where signs contradict each other.
    fn join<'t>(
        &self,
        cases: &Cases,
        numbers: &mut Numbers,
        triangles: &'t mut [[u32; 3]],
    ) -> Result<&'t mut [[u32; 3]], [f64; 3]> {
        self.number(numbers);
        let (mut next, mut wrong) = (0, None);
        self.each(|at, case| {
            let cell = at.iter().zip(STRIDE).map(|(at, stride)| at * stride).sum::<usize>();
            for places in &cases.0[case] {
                let triangle = places.map(|place| numbers.0[cell + place]);
                if triangle.contains(&NONE) {
                    wrong = wrong.or(Some(at));
                }
                triangles[next] = triangle;
                next += 1;
            }
        });
        match wrong {
            Some(at) => Err(self.grid.point(std::array::from_fn(|d| LEAF * self.at[d] + at[d]))),
            None => Ok(&mut triangles[next..]),
        }
    }
}

/// Whether the object goes on beyond a face: whether the function is above zero at one of the inside points in it.
fn goes_on(shape: &Shape, caps: &Caps, points: &[u32], counters: &mut Counters, interrupt: &Interrupt) -> bool {
    const AT_ONCE: usize = 128;
    let mut sampler = Sampler::new(shape).heeding(interrupt);
    let mut values = [0.0; AT_ONCE];
    let found = points.chunks(AT_ONCE).any(|chunk| {
        let columns: [Vec<f64>; 3] =
            std::array::from_fn(|d| chunk.iter().map(|&p| caps.positions[p as usize][d]).collect());
        let [x, y, z] = &columns;
        sampler.values(&shape.program, &[x, y, z], &mut values[..chunk.len()]);
        values[..chunk.len()].iter().any(|&value| value > 0.0)
    });
    counters.add(sampler.take_counters());
    found
}

/// Gives vertices without a normal that of the triangles about them.
pub(super) fn mend_normals(mesh: &mut Mesh) {
    let count = mesh.positions.len();
    mend(mesh, count);
}

/// Where the gradient gave no normal, the sum of the normals of the triangles about the vertex does, weighted by area.
fn mend(mesh: &mut Mesh, count: usize) {
    let missing: Vec<bool> = mesh.normals.iter().map(|n| *n == [0.0; 3]).collect();
    if !missing[..count].contains(&true) {
        return;
    }
    for &triangle in &mesh.triangles {
        let [a, b, c] = mesh.corners(triangle);
        let normal = cross(minus(b, a), minus(c, a));
        for vertex in triangle.map(|v| v as usize).into_iter().filter(|&v| missing[v]) {
            (0..3).for_each(|d| mesh.normals[vertex][d] += normal[d]);
        }
    }
    for (normal, _) in mesh.normals.iter_mut().zip(missing).filter(|(_, missing)| *missing) {
        *normal = unit(*normal).unwrap_or([0.0, 0.0, 1.0]);
    }
}
