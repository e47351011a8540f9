//! Sharp features: puts the creases and corners of a solid into its mesh. Never makes a closed 2-manifold anything else, and leaves the parts of the mesh
//! that no crease crosses as they are, to the bit.
//!
//! A crease is where pieces of the function meet: the branches of set operations, `MAX`, `MIN`, `ABS`, `IF` and `MOD`. Every vertex of the cubes' mesh knows
//! its piece ([`Pieces`]). A polygon of a cell whose corners lie on different pieces has a crease or a corner of the solid near it: the point that lies on
//! all of them, found by Newton's method, becomes the middle of a fan, wherever it lies (`study`). A side between two such polygons that no
//! surface holds is turned into one from middle to middle, along the crease (after Kobbelt, Botsch, Schwanecke and Seidel, "Feature sensitive surface
//! extraction from volume data", 2001); so the triangles of a polyhedron lie in its faces (`sew`). Where a crease sticks out of its cell triangles
//! are turned over by that: they are flipped, and middles that have changed places are drawn together (`net`). Fans, flips and drawing together
//! with their conditions keep the mesh as closed and as much of a manifold as it was. A polygon whose triangles stay turned stays plain.

mod atlas;
mod caps;
mod corners;
mod fill;
mod net;
mod open;
mod patches;
mod sew;
mod solve;
mod study;
mod torn;

use std::ops::Range;

use rayon::prelude::*;

use super::boxes::{Block, Visitor, Walk, walk};
use super::grid::{Grid, LEAF};
use super::marching::{Extraction, SurfaceError, extract};
use super::sampler::{Counters, Sampler};
use crate::interrupt::Interrupt;
use crate::limits::Limits;
use crate::vm::{Pieces, Precision, Program, Shape};
use atlas::Atlas;
pub use corners::outlines_as;
use patches::{Cells, by_leaves};
use sew::Sewing;
use solve::Scale;
use study::{Facet, Student, Study};

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
    /// Parts that sampling tore off a tip, and that are gone since the tip is whole again.
    pub torn: usize,
}

impl Sharpened {
    /// Adds what became of others.
    pub fn add(&mut self, other: &Self) {
        self.cells += other.cells;
        self.vertices += other.vertices;
        self.torn += other.torn;
        self.plain.iter_mut().zip(other.plain).for_each(|(own, other)| *own += other);
    }

    /// Cells that stay plain.
    #[must_use]
    pub fn left(&self) -> usize {
        self.plain.iter().sum()
    }
}

/// A leaf in which several pieces are live.
struct Work<'a> {
    /// Its triangles.
    triangles: &'a [(usize, Range<usize>)],
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
    let cells = Cells::of(grid);
    let runs = by_leaves(&extraction.mesh, extraction.own, grid, &cells);
    let mut wanted = vec![false; grid.leaves().iter().product()];
    runs.iter().for_each(|(leaf, _)| wanted[*leaf] = true);
    let (found, counters) = survey(&wanted, shape, grid, interrupt)?;
    extraction.report.counters.add(counters);
    let of_leaf = |leaf: usize| {
        let first = runs.partition_point(|(other, _)| *other < leaf);
        let last = runs.partition_point(|(other, _)| *other <= leaf);
        &runs[first..last]
    };
    let works: Vec<Work<'_>> =
        found.into_iter().map(|(leaf, program)| Work { triangles: of_leaf(leaf), program }).collect();
    let scale = Scale::of(grid);
    let mesh = &extraction.mesh;
    let sampler = || Sampler::new(shape).heeding(interrupt);
    let student = || {
        let tracer = Pieces::heeding(interrupt);
        Student { mesh, grid, cells: &cells, scale, shape, sampler: sampler(), tracer }
    };
    let studied: Vec<(Option<Study>, Counters)> = works
        .par_iter()
        .map_init(student, |student, work| {
            interrupt.tick()?;
            let study = student.study(work);
            Ok((study, student.sampler.take_counters()))
        })
        .collect::<Result<_, SurfaceError>>()?;
    let mut studies = Vec::new();
    for (study, counters) in studied {
        extraction.report.counters.add(counters);
        studies.extend(study);
    }
    let mut atlas = Atlas::new(sampler(), scale.near);
    atlas.gather(&mut studies);
    let facets: Vec<Facet> = studies.into_iter().flat_map(|study| study.facets).collect();
    let (sewn, sharpened) = Sewing::new(extraction, facets, atlas, scale).sew(interrupt)?;
    if let Some((mesh, own)) = sewn {
        (extraction.mesh, extraction.own) = (mesh, own);
    }
    Ok(sharpened)
}

/// Finds the leaves among those that are wanted in which pieces of the function are live, each with the program that is right in it.
fn survey(
    wanted: &[bool],
    shape: &Shape,
    grid: &Grid,
    interrupt: &Interrupt,
) -> Result<(Vec<(usize, Program)>, Counters), SurfaceError> {
    let collect = |_: &Block| Collecting { wanted, leaves: grid.leaves(), found: Vec::new() };
    let Walk { visitors, counters } = walk(grid, shape, collect, interrupt)?;
    Ok((visitors.into_iter().flat_map(|visitor| visitor.found).collect(), counters))
}

/// The number of the leaf that owns a cell.
fn leaf_of(grid: &Grid, cell: [usize; 3]) -> usize {
    let [x, y, _] = grid.leaves();
    let at = cell.map(|i| i / LEAF);
    at[0] + x * (at[1] + y * at[2])
}

/// Keeps the programs of leaves that are wanted.
struct Collecting<'a> {
    wanted: &'a [bool],
    leaves: [usize; 3],
    found: Vec<(usize, Program)>,
}

impl Visitor for Collecting<'_> {
    fn wants(&mut self, block: &Block) -> bool {
        let [from, to] = [block.from.map(|i| i / LEAF), block.to.map(|i| i.div_ceil(LEAF))];
        (from[2]..to[2]).any(|z| {
            (from[1]..to[1]).any(|y| {
                let row = self.leaves[0] * (y + self.leaves[1] * z);
                self.wanted[row + from[0]..row + to[0]].contains(&true)
            })
        })
    }

    fn uniform(&mut self, _block: &Block, _inside: bool) {}

    fn leaf(&mut self, block: &Block, program: &Program, _sampler: &mut Sampler) {
        let at = block.from.map(|i| i / LEAF);
        let leaf = at[0] + self.leaves[0] * (at[1] + self.leaves[1] * at[2]);
        if self.wanted[leaf] && Pieces::has_branches(program) {
            self.found.push((leaf, program.clone()));
        }
    }
}
