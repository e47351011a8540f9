//! Sharp features: puts the creases and corners of a solid into its mesh. Never makes a closed 2-manifold anything else, and leaves the parts of the mesh
//! that no crease crosses as they are, to the bit.
//!
//! A crease is where pieces of the function meet: the branches of set operations, `MAX`, `MIN`, `ABS`, `IF` and `MOD`. Every vertex of the cubes' mesh knows
//! its piece ([`Pieces`]). Two vertices of different pieces that are joined across the face of a cell have a crease between them, and there
//! the outline of the solid in that face has a corner: the side gets it as a new vertex, found by Newton's method on both pieces in the plane of the face, for both
//! cells that share it. Then each polygon of a cell is cut anew into triangles that lie on one piece each; where pieces meet in a corner within the
//! cell, about a vertex there. A polygon stays a disc, and no chord lies in a face, so the mesh stays as closed as it was, whatever is
//! found; and no new triangle leaves its cell.

mod caps;
mod fill;
mod patches;
mod solve;
mod study;
mod weave;

use std::ops::Range;

use rayon::prelude::*;
use rustc_hash::{FxHashMap, FxHashSet};

use super::boxes::{Block, Visitor, Walk, walk};
use super::check::check;
use super::grid::{Grid, LEAF};
use super::marching::{Extraction, SurfaceError, extract};
use super::mesh::{Mesh, cross, minus, unit};
use super::sampler::{Counters, Sampler};
use crate::interrupt::Interrupt;
use crate::limits::Limits;
use crate::vm::{Pieces, Precision, Program, Shape};
use patches::{Patch, patches};
use solve::Scale;
use study::{Student, Study};
use weave::Woven;

/// Why a cell that a crease crosses stays as it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Plain {
    /// The function jumps there: a vertex lies on none of the pieces.
    Step,
    /// Pieces that are beside each other do not meet nearby.
    Apart,
    /// They meet outside the cell.
    Outside,
    /// Where they meet is not on the boundary.
    Hidden,
    /// More creases than a polygon can hold.
    Crowded,
    /// The mesh would have had a fault.
    Fault,
}

impl Plain {
    /// All of them, in order.
    pub const ALL: [Self; 6] = [Self::Step, Self::Apart, Self::Outside, Self::Hidden, Self::Crowded, Self::Fault];

    /// What it is, after "because" or in brackets.
    #[must_use]
    pub fn told(self) -> &'static str {
        match self {
            Self::Step => "the function jumps",
            Self::Apart => "the surfaces do not meet",
            Self::Outside => "they meet outside the cell",
            Self::Hidden => "they meet off the boundary",
            Self::Crowded => "too much in one cell",
            Self::Fault => "the mesh would have had a fault",
        }
    }
}

/// What became of the cells that creases cross.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Sharpened {
    /// Cells whose creases and corners are in the mesh.
    pub cells: usize,
    /// Cells that stay plain, by reason, in the order of [`Plain::ALL`].
    pub plain: [usize; Plain::ALL.len()],
    /// New vertices.
    pub vertices: usize,
}

impl Sharpened {
    /// Cells that stay plain.
    #[must_use]
    pub fn left(&self) -> usize {
        self.plain.iter().sum()
    }
}

/// A leaf in which several pieces are live.
struct Work {
    patches: Range<usize>,
    program: Program,
}

/// Extracts the boundary of a 3-D shape on a grid, with its creases and corners if they are to be `sharp`.
///
/// # Errors
/// See [`SurfaceError`].
pub fn extract_as(
    shape: &Shape,
    grid: &Grid,
    sharp: bool,
    limits: &Limits,
    interrupt: &Interrupt,
) -> Result<Extraction, SurfaceError> {
    let mut extraction = extract(shape, grid, limits, interrupt)?;
    if sharp {
        let sharpened = sharpen(&mut extraction, shape, grid, interrupt)?;
        extraction.report.sharpened = Some(sharpened);
    }
    Ok(extraction)
}

/// Puts creases and corners into the mesh of an extraction of that shape on that grid. The same result for any number of threads.
///
/// # Errors
/// [`SurfaceError::Cancelled`] soon after the interrupt was set.
pub fn sharpen(
    extraction: &mut Extraction,
    shape: &Shape,
    grid: &Grid,
    interrupt: &Interrupt,
) -> Result<Sharpened, SurfaceError> {
    let _phase = interrupt.phase("creases");
    let shape = &Shape { precision: Precision::Double, ..shape.clone() };
    if extraction.own == 0 || Pieces::is_smooth(&shape.program) {
        return Ok(Sharpened::default());
    }
    let mut patches = patches(&extraction.mesh, extraction.own, grid);
    // By leaves; those of a leaf keep their order.
    patches.sort_by_key(|patch| patch.leaf(grid));
    let (works, counters) = survey(&patches, shape, grid, interrupt)?;
    extraction.report.counters.add(counters);
    // Tips may stick out of their cells, unless that is what makes a fault.
    for reach in [2.0, 0.0] {
        let (mesh, sharpened) = attempt(extraction, &patches, &works, (shape, grid, reach), interrupt)?;
        match mesh {
            Some((mesh, own)) => (extraction.mesh, extraction.own) = (mesh, own),
            None if sharpened.left() > 0 && reach > 0.0 => continue,
            None => {}
        }
        return Ok(sharpened);
    }
    Ok(Sharpened::default())
}

/// The mesh with its creases and how many of its triangles are the object's own, if it has creases and no fault.
fn attempt(
    extraction: &mut Extraction,
    patches: &[Patch],
    works: &[Work],
    (shape, grid, reach): (&Shape, &Grid, f64),
    interrupt: &Interrupt,
) -> Result<(Option<(Mesh, usize)>, Sharpened), SurfaceError> {
    let mesh = &extraction.mesh;
    let scale = Scale::of(grid, reach);
    let sampler = || Sampler::new(shape).heeding(interrupt);
    let student = || Student { mesh, grid, scale, shape, sampler: sampler(), tracer: Pieces::heeding(interrupt) };
    let studied: Vec<(Option<Study>, Counters)> = works
        .par_iter()
        .map_init(student, |student, work| {
            interrupt.tick()?;
            let study = student.study(work, patches);
            Ok((study, student.sampler.take_counters()))
        })
        .collect::<Result<_, SurfaceError>>()?;
    let mut studies = Vec::new();
    for (study, counters) in studied {
        extraction.report.counters.add(counters);
        studies.extend(study);
    }
    if studies.is_empty() {
        return Ok((None, Sharpened::default()));
    }
    let splits = Splits::of(&studies, mesh.positions.len() as u32);
    let woven: Vec<(Vec<Woven>, Counters)> = studies
        .par_iter()
        .map_init(student, |student, study| {
            interrupt.tick()?;
            let woven = student.weave(study, patches, &splits);
            Ok((woven, student.sampler.take_counters()))
        })
        .collect::<Result<_, SurfaceError>>()?;
    let mut all = Vec::new();
    for (woven, counters) in woven {
        extraction.report.counters.add(counters);
        all.extend(woven);
    }
    let strangers = student().strangers(&all, patches, &splits);
    all.extend(strangers);
    Ok(put_together(extraction, patches, &splits, all))
}

/// Finds the leaves in which pieces of the function are live and the mesh has triangles.
fn survey(
    patches: &[Patch],
    shape: &Shape,
    grid: &Grid,
    interrupt: &Interrupt,
) -> Result<(Vec<Work>, Counters), SurfaceError> {
    let mut ranges = vec![0..0; grid.leaves().iter().product()];
    let mut start = 0;
    for same in patches.chunk_by(|a, b| a.leaf(grid) == b.leaf(grid)) {
        ranges[same[0].leaf(grid)] = start..start + same.len();
        start += same.len();
    }
    let collect = |_: &Block| Collecting { ranges: &ranges, leaves: grid.leaves(), works: Vec::new() };
    let Walk { visitors, counters } = walk(grid, shape, collect, interrupt)?;
    Ok((visitors.into_iter().flat_map(|visitor| visitor.works).collect(), counters))
}

/// Keeps the programs of leaves with triangles.
struct Collecting<'a> {
    ranges: &'a [Range<usize>],
    leaves: [usize; 3],
    works: Vec<Work>,
}

impl Visitor for Collecting<'_> {
    fn wants(&mut self, block: &Block) -> bool {
        let [from, to] = [block.from.map(|i| i / LEAF), block.to.map(|i| i.div_ceil(LEAF))];
        (from[2]..to[2]).any(|z| {
            (from[1]..to[1]).any(|y| {
                let row = self.leaves[0] * (y + self.leaves[1] * z);
                self.ranges[row + from[0]..row + to[0]].iter().any(|range| !range.is_empty())
            })
        })
    }

    fn uniform(&mut self, _block: &Block, _inside: bool) {}

    fn leaf(&mut self, block: &Block, program: &Program, _sampler: &mut Sampler) {
        let at = block.from.map(|i| i / LEAF);
        let patches = self.ranges[at[0] + self.leaves[0] * (at[1] + self.leaves[1] * at[2])].clone();
        if !patches.is_empty() && Pieces::has_branches(program) {
            self.works.push(Work { patches, program: program.clone() });
        }
    }
}

/// The sides that get new vertices, and those vertices.
struct Splits {
    /// Numbers of the new vertices of a side, from the smaller end to the larger.
    of: FxHashMap<[u32; 2], Range<u32>>,
    /// Places of new vertices; their numbers follow those of the mesh.
    places: Vec<[f64; 3]>,
    first: u32,
    /// Whether a vertex is an end of such a side.
    marked: Vec<bool>,
}

impl Splits {
    /// A side that two leaves know gets what the first of them found.
    fn of(studies: &[Study], first: u32) -> Self {
        let mut splits =
            Self { of: FxHashMap::default(), places: Vec::new(), first, marked: vec![false; first as usize] };
        let mut known = FxHashSet::default();
        let mut taken = FxHashSet::default();
        // In single precision, as files hold it.
        let mut is_free = |place: &[f64; 3]| taken.insert(place.map(|c| (c as f32 + 0.0).to_bits()));
        for segment in studies.iter().flat_map(|study| &study.segments) {
            let is_new = known.insert(segment.ends) && !segment.points.is_empty();
            // Where a crease comes back to the same place it is there already.
            if is_new && segment.points.iter().all(&mut is_free) {
                let start = first + splits.places.len() as u32;
                splits.places.extend_from_slice(&segment.points);
                splits.of.insert(segment.ends, start..first + splits.places.len() as u32);
                segment.ends.iter().for_each(|&end| splits.marked[end as usize] = true);
            }
        }
        splits
    }

    /// The new vertices from one vertex to another.
    fn between(&self, a: u32, b: u32) -> Vec<u32> {
        if !self.marked[a as usize] || !self.marked[b as usize] {
            return Vec::new();
        }
        match self.of.get(&[a.min(b), a.max(b)]) {
            None => Vec::new(),
            Some(range) if a < b => range.clone().collect(),
            Some(range) => range.clone().rev().collect(),
        }
    }

    fn place(&self, mesh: &Mesh, vertex: u32) -> [f64; 3] {
        match vertex.checked_sub(self.first) {
            Some(new) => self.places[new as usize],
            None => mesh.positions[vertex as usize],
        }
    }
}

/// The mesh with the polygons that were filled anew, unless it has a fault then.
fn put_together(
    extraction: &Extraction,
    patches: &[Patch],
    splits: &Splits,
    woven: Vec<Woven>,
) -> (Option<(Mesh, usize)>, Sharpened) {
    let (mesh, own) = (&extraction.mesh, extraction.own);
    let mut new = Mesh { positions: mesh.positions.clone(), normals: mesh.normals.clone(), triangles: Vec::new() };
    new.positions.extend_from_slice(&splits.places);
    let mut sharpened = Sharpened::default();
    let mut of_patch: FxHashMap<usize, Vec<[u32; 3]>> = FxHashMap::default();
    for Woven { patch, triangles, centres, verdict } in woven {
        match verdict {
            Some(Ok(())) => sharpened.cells += 1,
            Some(Err(reason)) => sharpened.plain[reason as usize] += 1,
            None => {}
        }
        if let Some(mut triangles) = triangles {
            // Vertices within the cell have their numbers from the top down until now.
            let first = new.positions.len() as u32;
            for v in triangles.iter_mut().flatten().filter(|v| **v > u32::MAX - 256) {
                *v = first + (u32::MAX - *v);
            }
            new.positions.extend(centres);
            of_patch.insert(patches[patch].triangles.start, triangles);
        }
    }
    let ends: FxHashMap<usize, usize> = patches.iter().map(|p| (p.triangles.start, p.triangles.end)).collect();
    new.triangles.reserve(mesh.triangles.len() + 4 * splits.places.len());
    let mut at = 0;
    while at < own {
        let end = ends[&at];
        match of_patch.get(&at) {
            Some(triangles) => new.triangles.extend_from_slice(triangles),
            None => new.triangles.extend_from_slice(&mesh.triangles[at..end]),
        }
        at = end;
    }
    let new_own = new.triangles.len();
    caps::split(mesh, own, splits, &mut new.triangles);
    sharpened.vertices = new.positions.len() - mesh.positions.len();
    give_normals(&mut new, mesh.positions.len());
    if check(&new).is_err() {
        let cells = sharpened.cells + sharpened.left();
        let mut plain = [0; Plain::ALL.len()];
        plain[Plain::Fault as usize] = cells;
        return (None, Sharpened { cells: 0, plain, vertices: 0 });
    }
    (Some((new, new_own)), sharpened)
}

/// Normals of the new vertices: those of the triangles about them, weighted by area.
fn give_normals(mesh: &mut Mesh, known: usize) {
    let mut sums = vec![[0.0; 3]; mesh.positions.len() - known];
    for &triangle in &mesh.triangles {
        if triangle.iter().all(|&v| (v as usize) < known) {
            continue;
        }
        let [a, b, c] = mesh.corners(triangle);
        let normal = cross(minus(b, a), minus(c, a));
        for vertex in triangle.map(|v| v as usize).into_iter().filter(|&v| v >= known) {
            (0..3).for_each(|d| sums[vertex - known][d] += normal[d]);
        }
    }
    mesh.normals.extend(sums.into_iter().map(|sum| unit(sum).unwrap_or([0.0, 0.0, 1.0])));
}
