//! Bricks: the undecided leaves of a grid, 8 x 8 x 8 sample points each, with the signs of their points and the vertices on their crossed
//! edges. All that is inside or outside as a whole is a mark in a directory. Knows no triangles.
//!
//! A brick owns its points, the edges that start at them and the cells whose lowest corner they are. It evaluates the next plane of points on
//! each axis too, so that it can find its own vertices; who joins them asks the owner for every sign.

use std::hash::Hash;
use std::ops::Range;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use super::boxes::{Block, Lattice, Visitor, Walk, walk};
use super::detail::{self, Detail};
use super::grid::{BYTES_PER_VERTEX, Grid, LEAF};
use super::marching::SurfaceError;
use super::memory::Left;
use super::mesh::{pieces, unit};
use super::roots::{Edges, Roots, Samples, Source};
use super::sampler::{Counters, Sampler};
use crate::interrupt::Interrupt;
use crate::limits::Limits;
use crate::reuse::Digest;
use crate::vm::{Program, Shape};

/// Points along each side that a brick evaluates.
const SIDE: usize = LEAF + 1;

/// Those in all.
const POINTS: usize = SIDE * SIDE * SIDE;

/// An undecided leaf. Bit `x + 8 y` of word z stands for the point (x, y, z) of the brick.
#[derive(Clone, Debug)]
pub struct Brick {
    /// Its place, in leaves.
    pub at: [usize; 3],
    /// Which of its points are inside.
    pub inside: [u64; LEAF],
    /// Which of the edges that start at its points are crossed, by axis.
    pub crossed: [[u64; LEAF]; 3],
    /// Crossed edges before each word of `crossed`.
    before: [[u16; LEAF]; 3],
    /// Number of the vertex on its first crossed edge.
    first: u32,
}

impl Brick {
    /// The number of the vertex on a crossed edge of this brick.
    #[must_use]
    pub fn vertex(&self, [x, y, z]: [usize; 3], axis: usize) -> u32 {
        let bit = x + LEAF * y;
        let lower = self.crossed[axis][z] & ((1 << bit) - 1);
        self.first + u32::from(self.before[axis][z]) + lower.count_ones()
    }

    /// The number of the first vertex on the edges along an axis that start in plane z; the others follow in the order of their bits.
    #[must_use]
    pub fn first_vertex(&self, axis: usize, z: usize) -> u32 {
        self.first + u32::from(self.before[axis][z])
    }

    fn count(crossed: &[[u64; LEAF]; 3]) -> ([[u16; LEAF]; 3], u16) {
        let mut sum = 0;
        let before = crossed.map(|words| {
            words.map(|word| {
                let before = sum;
                sum += word.count_ones() as u16;
                before
            })
        });
        (before, sum)
    }
}

/// What a leaf of the grid is.
#[derive(Clone, Copy, Debug)]
pub enum Leaf<'a> {
    /// All its points are outside.
    Outside,
    /// All its points are inside.
    Inside,
    /// Some are.
    Mixed(&'a Brick),
}

impl Leaf<'_> {
    /// The signs of its points, one word per z. Points beyond the grid's end mean nothing.
    #[must_use]
    pub fn inside(&self) -> [u64; LEAF] {
        match self {
            Self::Outside => [0; LEAF],
            Self::Inside => [u64::MAX; LEAF],
            Self::Mixed(brick) => brick.inside,
        }
    }
}

const OUTSIDE: u32 = u32::MAX;
const INSIDE: u32 = u32::MAX - 1;

/// All signs and vertices of a shape on a grid.
#[derive(Debug)]
pub struct Bricks {
    /// The grid.
    pub grid: Grid,
    /// Vertices that the mesh may have, caps included.
    pub most_vertices: usize,
    /// The undecided leaves, in a fixed order.
    pub bricks: Vec<Brick>,
    /// The vertices on crossed edges, in the order of their bricks.
    pub positions: Vec<[f64; 3]>,
    /// Unit vectors out of the solid at the vertices, against the gradient; 0 where that vanishes or is undefined.
    pub normals: Vec<[f64; 3]>,
    /// What it cost.
    pub counters: Counters,
    /// Some of what the grid is too coarse to show.
    pub details: Vec<Detail>,
    directory: Vec<u32>,
}

impl Bricks {
    /// Evaluates the shape on the grid: intervals where they decide, points elsewhere. The shape's space must be that of the grid.
    ///
    /// # Errors
    /// [`SurfaceError::Cancelled`] soon after the interrupt was set; [`SurfaceError::Memory`] as soon as there are more vertices than
    /// `Limits::memory_bytes` hold.
    pub fn survey(shape: &Shape, grid: &Grid, limits: &Limits, interrupt: &Interrupt) -> Result<Self, SurfaceError> {
        Self::survey_with(shape, grid, true, limits, interrupt)
    }

    /// The same without normals.
    ///
    /// # Errors
    /// As for [`Bricks::survey`].
    pub fn survey_bare(
        shape: &Shape,
        grid: &Grid,
        limits: &Limits,
        interrupt: &Interrupt,
    ) -> Result<Self, SurfaceError> {
        Self::survey_with(shape, grid, false, limits, interrupt)
    }

    fn survey_with(
        shape: &Shape,
        grid: &Grid,
        normal: bool,
        limits: &Limits,
        interrupt: &Interrupt,
    ) -> Result<Self, SurfaceError> {
        let leaves = grid.leaves();
        let most_vertices = (limits.memory_bytes / BYTES_PER_VERTEX).min(INSIDE as usize - 1);
        if grid.estimated_bytes() > limits.memory_bytes as u64 {
            return Err(SurfaceError::Memory(limits.memory_bytes));
        }
        let found = AtomicUsize::new(0);
        let gathering = |_: &Block| Gathering::new(grid, &found, most_vertices, normal);
        let Walk { visitors, counters } = walk(grid, shape, gathering, interrupt)?;
        let vertices = visitors.iter().map(|visitor| visitor.part.along.len()).sum::<usize>();
        if vertices > most_vertices {
            return Err(SurfaceError::Memory(limits.memory_bytes));
        }
        let mut all = Self {
            grid: *grid,
            most_vertices,
            bricks: Vec::with_capacity(visitors.iter().map(|visitor| visitor.part.bricks.len()).sum()),
            positions: Vec::new(),
            normals: Vec::new(),
            counters,
            details: Vec::new(),
            directory: vec![OUTSIDE; leaves.iter().product()],
        };
        let mut suspects = Vec::new();
        let mut parts = Vec::with_capacity(visitors.len());
        let mut first = 0;
        for Gathering { part, .. } in visitors {
            suspects.extend_from_slice(&part.suspects);
            for block in &part.inside {
                all.mark_inside(block);
            }
            let from = all.bricks.len();
            for brick in &part.bricks {
                let place = all.place(brick.at);
                all.directory[place] = all.bricks.len() as u32;
                all.bricks.push(Brick { first: brick.first + first, ..brick.clone() });
            }
            first += part.along.len() as u32;
            parts.push((from..all.bricks.len(), part));
        }
        all.normals = pieces(
            parts.iter().collect(),
            |(_, part)| part.normals.len(),
            |(_, part), to| to.copy_from_slice(&part.normals),
        );
        all.positions = all.place_vertices(parts);
        interrupt.tick()?;
        all.details = detail::confirm(suspects, grid, |index| all.is_inside(index), shape, interrupt);
        Ok(all)
    }

    /// Whether every sample point is inside.
    #[must_use]
    pub fn is_full(&self) -> bool {
        self.directory.iter().all(|&leaf| leaf == INSIDE)
    }

    /// The leaf at that place; outside beyond the grid.
    #[must_use]
    pub fn leaf(&self, at: [usize; 3]) -> Leaf<'_> {
        let leaves = self.grid.leaves();
        if (0..3).any(|d| at[d] >= leaves[d]) {
            return Leaf::Outside;
        }
        match self.directory[self.place(at)] {
            OUTSIDE => Leaf::Outside,
            INSIDE => Leaf::Inside,
            brick => Leaf::Mixed(&self.bricks[brick as usize]),
        }
    }

    /// Whether a sample point is inside.
    #[must_use]
    pub fn is_inside(&self, index: [usize; 3]) -> bool {
        let [x, y, z] = index.map(|i| i % LEAF);
        match self.leaf(index.map(|i| i / LEAF)) {
            Leaf::Outside => false,
            Leaf::Inside => true,
            Leaf::Mixed(brick) => brick.inside[z] >> (x + LEAF * y) & 1 == 1,
        }
    }

    /// The vertex on the edge that starts at a sample point, if the edge is crossed.
    #[must_use]
    pub fn vertex(&self, index: [usize; 3], axis: usize) -> Option<u32> {
        let at = index.map(|i| i % LEAF);
        match self.leaf(index.map(|i| i / LEAF)) {
            Leaf::Mixed(brick) if brick.crossed[axis][at[2]] >> (at[0] + LEAF * at[1]) & 1 == 1 => {
                Some(brick.vertex(at, axis))
            }
            _ => None,
        }
    }

    fn place(&self, at: [usize; 3]) -> usize {
        let [x, y, _] = self.grid.leaves();
        at[0] + x * (at[1] + y * at[2])
    }

    /// The positions of all vertices, from those of ranges of bricks along their edges.
    fn place_vertices(&self, parts: Vec<(Range<usize>, Arc<Part>)>) -> Vec<[f64; 3]> {
        let counts = self.grid.counts();
        let axes: [Vec<f64>; 3] = std::array::from_fn(|d| (0..counts[d]).map(|i| self.grid.coordinate(d, i)).collect());
        pieces(
            parts,
            |(_, part)| part.along.len(),
            |(range, part), positions| {
                let mut next = positions.iter_mut().zip(&part.along);
                for brick in &self.bricks[range] {
                    let from = brick.at.map(|at| LEAF * at);
                    for (axis, words) in brick.crossed.iter().enumerate() {
                        for (z, &word) in words.iter().enumerate() {
                            for (bit, (position, &along)) in bits(word).zip(&mut next) {
                                let [x, y] = [axes[0][from[0] + bit % LEAF], axes[1][from[1] + bit / LEAF]];
                                *position = [x, y, axes[2][from[2] + z]];
                                position[axis] = along;
                            }
                        }
                    }
                }
            },
        )
    }

    fn mark_inside(&mut self, block: &Block) {
        let (from, to) = (block.from.map(|i| i / LEAF), block.to.map(|i| i.div_ceil(LEAF)));
        for z in from[2]..to[2] {
            for y in from[1]..to[1] {
                let row = self.place([from[0], y, z]);
                self.directory[row..row + to[0] - from[0]].fill(INSIDE);
            }
        }
    }
}

/// What one task gathers.
struct Gathering<'a> {
    grid: &'a Grid,
    found: &'a AtomicUsize,
    most: usize,
    normal: bool,
    /// Shared only once the task is done.
    part: Arc<Part>,
    scratch: Scratch,
}

/// What there is in the block of a task.
#[derive(Clone, Debug, Default)]
struct Part {
    inside: Vec<Block>,
    bricks: Vec<Brick>,
    /// The coordinates of the vertices along their edges.
    along: Vec<f64>,
    normals: Vec<[f64; 3]>,
    suspects: Vec<Detail>,
}

impl Part {
    fn bytes(&self) -> usize {
        self.inside.capacity() * size_of::<Block>()
            + self.bricks.capacity() * size_of::<Brick>()
            + self.along.capacity() * size_of::<f64>()
            + self.normals.capacity() * size_of::<[f64; 3]>()
            + self.suspects.capacity() * size_of::<Detail>()
    }
}

#[derive(Default)]
struct Scratch {
    columns: [Vec<f64>; 3],
    values: Vec<f64>,
    slopes: [Vec<f64>; 3],
    axes: [Vec<f64>; 3],
    edges: Edges,
    roots: Roots,
}

impl<'a> Gathering<'a> {
    fn new(grid: &'a Grid, found: &'a AtomicUsize, most: usize, normal: bool) -> Self {
        Self { grid, found, most, normal, part: Arc::default(), scratch: Scratch::default() }
    }

    fn part(&mut self) -> &mut Part {
        Arc::make_mut(&mut self.part)
    }

    /// Evaluates the block and the next plane on each axis; x fastest. Returns the points along each side.
    fn evaluate(&mut self, block: &Block, program: &Program, sampler: &mut Sampler) -> [usize; 3] {
        let side = std::array::from_fn(|d| (block.to[d] + 1).min(self.grid.cells[d] + 1) - block.from[d]);
        let scratch = &mut self.scratch;
        for (d, axis) in scratch.axes.iter_mut().enumerate() {
            axis.clear();
            axis.extend((0..side[d]).map(|i| self.grid.coordinate(d, block.from[d] + i)));
        }
        let [x, y, z] = &scratch.axes;
        scratch.values.clear();
        scratch.values.resize(x.len() * y.len() * z.len(), 0.0);
        sampler.lattice(program, &[&x[..], y, z][..self.grid.dimension()], &mut scratch.values);
        side
    }

    /// Vertices on all edges in the scratch, and their normals if they are wanted.
    fn solve(&mut self, program: &Program, sampler: &mut Sampler) {
        let dimension = self.grid.dimension();
        let Scratch { columns, values, slopes, axes, edges, roots } = &mut self.scratch;
        edges.load(Samples { axes, values, epsilon: sampler.epsilon() });
        let part = Arc::make_mut(&mut self.part);
        let first = part.along.len();
        roots.solve(edges, &mut Source { sampler, program, dimension }, &mut part.along);
        if !self.normal {
            return;
        }
        let found = &part.along[first..];
        edges.columns(found, columns);
        slopes.iter_mut().for_each(|slopes| slopes.resize(found.len(), 0.0));
        values.resize(found.len(), 0.0);
        let [x, y, z] = &columns;
        let [a, b, c] = slopes;
        c.fill(0.0);
        sampler.slopes(program, &[&x[..], y, z][..dimension], values, &mut [&mut a[..], b, c][..dimension]);
        let slopes = a.iter().zip(b.iter()).zip(c.iter());
        part.normals.extend(slopes.map(|((&a, &b), &c)| unit([-a, -b, -c]).unwrap_or([0.0; 3])));
    }
}

impl Visitor for Gathering<'_> {
    fn tell(&self, to: &mut Digest) {
        self.normal.hash(to);
    }

    /// Nothing of what was broken off.
    fn keep(&mut self) -> Option<Left> {
        let is_whole = self.found.load(Ordering::Relaxed) <= self.most;
        is_whole.then(|| Left { what: self.part.clone(), bytes: self.part.bytes() })
    }

    fn recall(&mut self, left: &Left) -> bool {
        let Ok(part) = left.what.clone().downcast::<Part>() else { return false };
        self.found.fetch_add(part.along.len(), Ordering::Relaxed);
        self.part = part;
        true
    }

    /// Nothing more once all tasks together have found too many vertices.
    fn wants(&mut self, _block: &Block) -> bool {
        self.found.load(Ordering::Relaxed) <= self.most
    }

    fn uniform(&mut self, block: &Block, inside: bool) {
        if inside {
            self.part().inside.push(*block);
        }
    }

    fn leaf(&mut self, block: &Block, program: &Program, sampler: &mut Sampler) {
        let side = self.evaluate(block, program, sampler);
        let signs = Signs::of(&self.scratch.values, side);
        if self.part.suspects.len() < detail::SUSPECTS {
            let points = detail::Points { grid: self.grid, from: block.from, side, values: &self.scratch.values };
            let found = match signs.uniform {
                Some(inside) => points.hidden(inside, program, sampler).or_else(|| points.sheet(program, sampler)),
                None => points.sheet(program, sampler),
            };
            self.part().suspects.extend(found);
        }
        if let Some(inside) = signs.uniform {
            self.uniform(block, inside);
            return;
        }
        let at = block.from.map(|i| i / LEAF);
        let crossed: [[u64; LEAF]; 3] = std::array::from_fn(|axis| signs.crossed(axis, side));
        let (before, count) = Brick::count(&crossed);
        let first = self.part.along.len() as u32;
        self.part().bricks.push(Brick { at, inside: signs.owned(), crossed, before, first });
        self.found.fetch_add(usize::from(count), Ordering::Relaxed);
        let edges = &mut self.scratch.edges;
        edges.clear();
        for (axis, words) in crossed.iter().enumerate() {
            for (z, &word) in words.iter().enumerate() {
                bits(word).for_each(|bit| edges.push(axis, [bit % LEAF, bit / LEAF, z]));
            }
        }
        self.solve(program, sampler);
    }
}

/// The set bits, ascending.
pub(super) fn bits(mut word: u64) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let bit = word.trailing_zeros() as usize;
        (word != 0).then(|| {
            word &= word - 1;
            bit
        })
    })
}

/// The signs of the points that a brick evaluated: row by row, bit x for x.
struct Signs {
    rows: [[u16; SIDE]; SIDE],
    uniform: Option<bool>,
}

impl Signs {
    fn of(values: &[f64], side: [usize; 3]) -> Self {
        debug_assert!(values.len() <= POINTS);
        let mut rows = [[0; SIDE]; SIDE];
        let mut inside = 0;
        for (i, line) in values.chunks_exact(side[0]).enumerate() {
            let row = line.iter().enumerate().fold(0, |row, (x, &value)| row | u16::from(value >= 0.0) << x);
            inside += row.count_ones() as usize;
            rows[i / side[1]][i % side[1]] = row;
        }
        let uniform = [(0, false), (values.len(), true)].into_iter().find(|&(n, _)| n == inside).map(|(_, sign)| sign);
        Self { rows, uniform }
    }

    /// The brick's own points.
    fn owned(&self) -> [u64; LEAF] {
        std::array::from_fn(|z| word(|y| self.rows[z][y]))
    }

    /// The crossed ones among the edges that start at the brick's own points and end at evaluated ones.
    fn crossed(&self, axis: usize, side: [usize; 3]) -> [u64; LEAF] {
        let edges: [usize; 3] = std::array::from_fn(|d| if d == axis { side[d] - 1 } else { side[d].min(LEAF) });
        let row = |y: usize, z: usize| {
            if y >= edges[1] || z >= edges[2] {
                return 0;
            }
            let here = self.rows[z][y];
            let there = match axis {
                0 => here >> 1,
                1 => self.rows[z][y + 1],
                _ => self.rows[z + 1][y],
            };
            (here ^ there) & ((1 << edges[0]) - 1)
        };
        std::array::from_fn(|z| word(|y| row(y, z)))
    }
}

/// Eight rows of eight bits in one word.
fn word(row: impl Fn(usize) -> u16) -> u64 {
    (0..LEAF).fold(0, |word, y| word | u64::from(row(y) & 0xff) << (LEAF * y))
}
