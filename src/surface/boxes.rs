//! The hierarchy of boxes: intervals decide which boxes of sample points are wholly inside or outside, shorter programs go down into the
//! undecided ones, and only the undecided leaves are handed to a visitor. Knows neither meshes nor pixels, and never evaluates a point.
//!
//! A [`Lattice`] says where the sample points lie: an axis-aligned grid, the pixels of a plane, or pixels x depth of a camera. A [`walk`]
//! has two phases. From the whole lattice down to tasks ([`Lattice::task`]) all boxes of a level are examined in parallel; then the tasks
//! run in parallel, each with a [`Visitor`] of its own, depth first, so that a visitor sees its boxes in a fixed order: axis 2 slowest,
//! axis 0 fastest at every level (front to back where axis 2 is depth). What the visitors gathered comes back in a fixed order too: the
//! same for any number of threads.

use std::sync::Arc;

use rayon::prelude::*;

use super::memory::{Left, Memory, Tally};
use super::sampler::{Counters, Sampler};
use crate::interrupt::{Cancelled, Interrupt};
use crate::number::Interval;
use crate::reuse::Digest;
use crate::vm::interval::Boxes;
use crate::vm::{Precision, Program, Shape};

/// Most boxes that one split gives: 4 along each of three axes.
pub const LANES: usize = 64;

/// A box of sample points by their indices: `from <= i < to` on each axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Block {
    /// First index on each axis.
    pub from: [usize; 3],
    /// One past the last index on each axis.
    pub to: [usize; 3],
}

impl Block {
    /// Sample points along each axis.
    #[must_use]
    pub fn counts(&self) -> [usize; 3] {
        std::array::from_fn(|d| self.to[d] - self.from[d])
    }

    /// Sample points in all.
    #[must_use]
    pub fn points(&self) -> u64 {
        self.counts().iter().map(|&n| n as u64).product()
    }

    /// Whether no side is longer than that of `other`.
    fn fits(&self, other: [usize; 3]) -> bool {
        self.counts().iter().zip(other).all(|(&n, m)| n <= m)
    }
}

/// Where sample points lie, as far as the hierarchy needs it.
pub trait Lattice: Sync {
    /// Sample points along each index axis, at least 1; a plane has 1 along axis 2.
    fn counts(&self) -> [usize; 3];

    /// Points along each axis of a leaf, the smallest box: about 512 points, 8 x 8 x 8 or 16 x 16 x 1.
    fn leaf(&self) -> [usize; 3];

    /// Points along each axis of a task, the piece that one thread descends with one visitor: `leaf` times a power of 4, or
    /// `counts` where the axis must not be cut between tasks (the depth of a camera).
    fn task(&self) -> [usize; 3];

    /// Writes bounds of each coordinate of the space (`Shape::dimension` of them) over `block`. They must hold every point that the
    /// visitor will evaluate for that block, as it is computed in floating point.
    fn bounds(&self, block: &Block, out: &mut [Interval]);

    /// Tells a digest which sample points these are, of all that there could be; `false` if nothing of a walk over them is to be kept for
    /// the next time.
    fn tell(&self, _to: &mut Digest) -> bool {
        false
    }
}

/// What is done with the boxes of one task.
pub trait Visitor: Send {
    /// Whether anything in the block is still of interest; asked right before a box is split and before a leaf is visited.
    fn wants(&mut self, _block: &Block) -> bool {
        true
    }

    /// All points of the block are inside (`f >= 0`) or all are outside (`f < 0` or undefined), its bounds included.
    fn uniform(&mut self, block: &Block, inside: bool);

    /// An undecided leaf, with the program that is right inside its bounds (as good as the shape's own there, perhaps shorter).
    fn leaf(&mut self, block: &Block, program: &Program, sampler: &mut Sampler);

    /// The task is done: a visitor may turn what it gathered into something smaller.
    fn finish(&mut self, _sampler: &mut Sampler) {}

    /// Tells what its result depends on besides the lattice, the block and the program that is right inside it; asked before anything
    /// else of the task, where [`Lattice::tell`] said yes.
    fn tell(&self, _to: &mut Digest) {}

    /// What may be kept of its result now that it is done; `None` if it is not for another time.
    fn keep(&mut self) -> Option<Left> {
        None
    }

    /// Takes what another visitor kept of the same task, instead of all other calls. `false` if it cannot.
    fn recall(&mut self, _left: &Left) -> bool {
        false
    }
}

/// What a walk brings back.
#[derive(Debug)]
pub struct Walk<V> {
    /// The visitors: of tasks, and of boxes decided above the tasks, which saw just one call of [`Visitor::uniform`]. In a fixed order.
    pub visitors: Vec<V>,
    /// What it cost.
    pub counters: Counters,
}

/// Walks the whole lattice. `visitor` makes the visitor of a task (or of a decided box) from its block. Runs on the current rayon pool;
/// progress counts sample points.
///
/// # Errors
/// [`Cancelled`] soon after the interrupt was set.
pub fn walk<L, V, F>(lattice: &L, shape: &Shape, visitor: F, interrupt: &Interrupt) -> Result<Walk<V>, Cancelled>
where
    L: Lattice,
    V: Visitor,
    F: Fn(&Block) -> V + Sync,
{
    interrupt.begin(points(lattice));
    walk_on(lattice, shape, visitor, interrupt)
}

/// Sample points of a lattice: what a walk advances the progress by.
#[must_use]
pub fn points(lattice: &impl Lattice) -> u64 {
    Block { from: [0; 3], to: lattice.counts() }.points()
}

/// The same as a part of a greater task, whose progress was begun already.
///
/// # Errors
/// [`Cancelled`] soon after the interrupt was set.
pub fn walk_on<L, V, F>(lattice: &L, shape: &Shape, visitor: F, interrupt: &Interrupt) -> Result<Walk<V>, Cancelled>
where
    L: Lattice,
    V: Visitor,
    F: Fn(&Block) -> V + Sync,
{
    let whole = Block { from: [0; 3], to: lattice.counts() };
    let mut counters = Counters::default();
    let room = room(lattice, shape, &whole);
    let tasks = gather_tasks(lattice, (shape, room), whole, &mut counters, interrupt)?;
    let memory = Memory::of(lattice, (shape, room), interrupt);
    let done: Vec<(V, Counters, bool)> = tasks
        .into_par_iter()
        .map_init(
            || Walker::new(lattice, (shape, room), interrupt),
            |walker, task| {
                let (block, mut own) = (task.block, visitor(&task.block));
                let program = match task.state {
                    State::Decided(inside) => {
                        walker.decide(&mut own, &block, inside);
                        own.finish(&mut walker.sampler);
                        return Ok((own, walker.take_counters(), false));
                    }
                    State::Open(program) => program,
                };
                let key = memory.as_ref().map(|memory| memory.key(&own, &block, &program));
                if let Some(counters) = memory.as_ref().zip(key).and_then(|(memory, key)| memory.recall(&mut own, key))
                {
                    interrupt.tick()?;
                    interrupt.advance(block.points());
                    return Ok((own, counters, true));
                }
                walker.descend(0, &block, &program, &mut own)?;
                own.finish(&mut walker.sampler);
                let counters = walker.take_counters();
                if let Some((memory, key)) = memory.as_ref().zip(key) {
                    // Nothing that was evaluated after the interrupt was set may outlive it.
                    interrupt.tick()?;
                    memory.keep(&mut own, key, &counters);
                }
                Ok((own, counters, false))
            },
        )
        .collect::<Result<_, Cancelled>>()?;
    let mut visitors = Vec::with_capacity(done.len());
    let mut tally = Tally::default();
    tally.count(&counters, false);
    for (own, cost, was_kept) in done {
        tally.count(&cost, was_kept);
        visitors.push(own);
        counters.add(cost);
    }
    if memory.is_some() {
        interrupt.kept_pieces(tally.0);
    }
    Ok(Walk { visitors, counters })
}

/// A box of the upper phase.
struct Piece {
    block: Block,
    state: State,
}

enum State {
    Open(Arc<Program>),
    Decided(bool),
}

/// Splits the whole lattice, level by level, into tasks and boxes that are decided already.
fn gather_tasks<L: Lattice>(
    lattice: &L,
    (shape, room): (&Shape, f64),
    whole: Block,
    counters: &mut Counters,
    interrupt: &Interrupt,
) -> Result<Vec<Piece>, Cancelled> {
    let task = lattice.task();
    let is_open = |piece: &Piece| matches!(piece.state, State::Open(_)) && !piece.block.fits(task);
    let mut pieces = vec![Piece { block: whole, state: State::Open(Arc::clone(&shape.program)) }];
    while pieces.iter().any(is_open) {
        let level: Vec<(Vec<Piece>, u64)> = pieces
            .into_par_iter()
            .map_init(
                || Level::new((shape, room), interrupt),
                |level, piece| {
                    interrupt.tick()?;
                    match &piece.state {
                        State::Open(program) if !piece.block.fits(task) => {
                            Ok((level.pieces(lattice, program, &piece.block), level.children.len() as u64))
                        }
                        _ => Ok((vec![piece], 0)),
                    }
                },
            )
            .collect::<Result<_, Cancelled>>()?;
        counters.boxes += level.iter().map(|(_, boxes)| boxes).sum::<u64>();
        pieces = level.into_iter().flat_map(|(pieces, _)| pieces).collect();
    }
    Ok(pieces)
}

/// One thread's way down: a level of scratch for each depth.
struct Walker<'a, L> {
    lattice: &'a L,
    shape: &'a Shape,
    room: f64,
    interrupt: &'a Interrupt,
    levels: Vec<Option<Box<Level>>>,
    sampler: Sampler,
    boxes: u64,
}

impl<'a, L: Lattice> Walker<'a, L> {
    fn new(lattice: &'a L, (shape, room): (&'a Shape, f64), interrupt: &'a Interrupt) -> Self {
        Self {
            lattice,
            shape,
            room,
            interrupt,
            levels: Vec::new(),
            sampler: Sampler::new(shape).heeding(interrupt),
            boxes: 0,
        }
    }

    fn take_counters(&mut self) -> Counters {
        let mut counters = self.sampler.take_counters();
        counters.boxes = std::mem::take(&mut self.boxes);
        counters
    }

    fn decide<V: Visitor>(&mut self, visitor: &mut V, block: &Block, inside: bool) {
        visitor.uniform(block, inside);
        self.interrupt.advance(block.points());
    }

    /// Splits down to the leaves; as deep as the lattice is long to base 4, so the recursion is short.
    fn descend<V: Visitor>(
        &mut self,
        depth: usize,
        block: &Block,
        program: &Program,
        visitor: &mut V,
    ) -> Result<(), Cancelled> {
        self.interrupt.tick()?;
        let is_leaf = block.fits(self.lattice.leaf());
        if is_leaf || !visitor.wants(block) {
            if is_leaf && visitor.wants(block) {
                visitor.leaf(block, program, &mut self.sampler);
                self.interrupt.tick()?;
            }
            self.interrupt.advance(block.points());
            return Ok(());
        }
        if self.levels.len() <= depth {
            self.levels.resize_with(depth + 1, || None);
        }
        let new = || Box::new(Level::new((self.shape, self.room), self.interrupt));
        let mut level = self.levels[depth].take().unwrap_or_else(new);
        level.examine(self.lattice, program, block, self.lattice.leaf());
        self.boxes += level.children.len() as u64;
        for lane in 0..level.children.len() {
            let child = level.children[lane];
            if let Some(inside) = verdict(level.values[lane], self.room) {
                self.decide(visitor, &child, inside);
            } else if visitor.wants(&child) {
                let shorter = level.boxes.specialise(program, lane);
                self.descend(depth + 1, &child, shorter.as_ref().unwrap_or(program), visitor)?;
            } else {
                self.interrupt.advance(child.points());
            }
        }
        self.levels[depth] = Some(level);
        Ok(())
    }
}

/// Whether the values decide a box: inside, outside, or (None) neither. Values that are computed at points may be off by `room`.
fn verdict(value: Interval, room: f64) -> Option<bool> {
    if value.lo > value.hi || value.hi < -room {
        Some(false)
    } else if value.lo >= room && !value.undefined {
        Some(true)
    } else {
        None
    }
}

/// Scratch for the split of one box: its children, their coordinates' bounds by input, and the values' bounds.
struct Level {
    children: Vec<Block>,
    inputs: Vec<[Interval; LANES]>,
    coordinates: Vec<Interval>,
    values: [Interval; LANES],
    boxes: Boxes,
    room: f64,
}

impl Level {
    fn new((shape, room): (&Shape, f64), interrupt: &Interrupt) -> Self {
        let nothing = Interval::new(0.0, 0.0);
        let mut inputs = vec![[nothing; LANES]; shape.dimension];
        inputs.extend(shape.fixed.iter().map(|&value| [fixed(value); LANES]));
        Self {
            children: Vec::with_capacity(LANES),
            inputs,
            coordinates: vec![nothing; shape.dimension],
            values: [nothing; LANES],
            boxes: Boxes::heeding(interrupt),
            room,
        }
    }

    /// Splits `block` and bounds the program's values over each child.
    fn examine<L: Lattice>(&mut self, lattice: &L, program: &Program, block: &Block, floor: [usize; 3]) {
        split(block, lattice.leaf(), floor, &mut self.children);
        for (lane, child) in self.children.iter().enumerate() {
            lattice.bounds(child, &mut self.coordinates);
            for (input, &bounds) in self.inputs.iter_mut().zip(&self.coordinates) {
                input[lane] = bounds;
            }
        }
        let count = self.children.len();
        let mut slices: [&[Interval]; 16] = [&[]; 16];
        for (slice, input) in slices.iter_mut().zip(&self.inputs) {
            *slice = &input[..count];
        }
        self.boxes.eval(program, &slices[..self.inputs.len()], &mut self.values[..count]);
    }

    fn pieces<L: Lattice>(&mut self, lattice: &L, program: &Arc<Program>, block: &Block) -> Vec<Piece> {
        self.examine(lattice, program, block, lattice.task());
        let room = self.room;
        let state = |boxes: &mut Boxes, lane: usize, value| match verdict(value, room) {
            Some(inside) => State::Decided(inside),
            None => State::Open(boxes.specialise(program, lane).map_or_else(|| Arc::clone(program), Arc::new)),
        };
        let (boxes, values) = (&mut self.boxes, &self.values);
        let children = self.children.iter().enumerate();
        children.map(|(lane, &block)| Piece { block, state: state(boxes, lane, values[lane]) }).collect()
    }
}

/// How far values at points may be from the bounds of their boxes: nothing in double precision; in single precision what most of some
/// points of the lattice show, and some more, so that boxes near the boundary are left to the points.
fn room(lattice: &impl Lattice, shape: &Shape, whole: &Block) -> f64 {
    const POINTS: usize = 256;
    if shape.precision == Precision::Double {
        return 0.0;
    }
    let mut sides = vec![Interval::new(0.0, 0.0); shape.dimension];
    lattice.bounds(whole, &mut sides);
    let steps = [0.819_172_513_396_164_4, 0.671_043_606_703_789_2, 0.549_700_477_901_970_3];
    let columns: Vec<Vec<f64>> = sides
        .iter()
        .zip(steps)
        .map(|(side, step)| {
            (0..POINTS).map(|i| side.lo + (side.hi - side.lo) * (0.5 + step * i as f64).fract()).collect()
        })
        .collect();
    let at: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
    let values = |precision| {
        let mut out = vec![0.0; POINTS];
        Sampler::new(&Shape { precision, ..shape.clone() }).values(&shape.program, &at, &mut out);
        out
    };
    let (double, single) = (values(Precision::Double), values(Precision::Single));
    let mut errors: Vec<f64> =
        double.iter().zip(&single).map(|(a, b)| (a - b).abs()).filter(|error| error.is_finite()).collect();
    errors.sort_by(f64::total_cmp);
    8.0 * errors.get(errors.len() * 9 / 10).copied().unwrap_or(0.0)
}

/// The bounds of an input that does not move.
fn fixed(value: f64) -> Interval {
    if value.is_nan() {
        Interval { lo: f64::INFINITY, hi: f64::NEG_INFINITY, undefined: true }
    } else {
        Interval::new(value, value)
    }
}

/// The children of `block`, axis 2 slowest: on each axis at most 4, each a leaf times a power of 4 long (the last one may be shorter), never
/// shorter than `floor`. So all boxes of a lattice lie on multiples of their own length. The power is the same on all axes: a long box
/// is cut across until it is about a cube of leaves, since cutting it lengthwise too gives needles, whose intervals tell little.
fn split(block: &Block, leaf: [usize; 3], floor: [usize; 3], out: &mut Vec<Block>) {
    let scale = (0..3).map(|d| scale(block.to[d] - block.from[d], leaf[d], floor[d])).max().unwrap_or(1);
    let steps: [usize; 3] = std::array::from_fn(|d| leaf[d].saturating_mul(scale).max(floor[d]));
    let starts = |d: usize| (block.from[d]..block.to[d]).step_by(steps[d]);
    out.clear();
    for z in starts(2) {
        for y in starts(1) {
            for x in starts(0) {
                let from = [x, y, z];
                out.push(Block { from, to: std::array::from_fn(|d| (from[d] + steps[d]).min(block.to[d])) });
            }
        }
    }
}

/// The largest power of 4 whose product with `leaf` is shorter than the side; 1 for a side that is not to be cut.
fn scale(length: usize, leaf: usize, floor: usize) -> usize {
    let mut scale = 1_usize;
    while length > floor && leaf.saturating_mul(scale).saturating_mul(4) < length {
        scale *= 4;
    }
    scale
}
