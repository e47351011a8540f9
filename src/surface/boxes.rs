//! The hierarchy of boxes: intervals decide which boxes of sample points are wholly inside or outside, shorter programs go down into the
//! undecided ones, and only the undecided leaves are handed to a visitor. Knows neither meshes nor pixels, and never evaluates a point.
//!
//! A [`Lattice`] says where the sample points lie: an axis-aligned grid, the pixels of a plane, or pixels x depth of a camera. A [`walk`]
//! has two phases. From the whole lattice down to tasks ([`Lattice::task`]) all boxes of a level are examined in parallel; then the tasks
//! run in parallel, each with a [`Visitor`] of its own, depth first, so that a visitor sees its boxes in a fixed order: axis 2 slowest,
//! axis 0 fastest at every level (front to back where axis 2 is depth). What the visitors gathered comes back in a fixed order too: the
//! same for any number of threads.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use rayon::prelude::*;
use rustc_hash::FxHashMap;

use super::memory::{Left, Memory, Tally};
use super::sampler::{Counters, Sampler};
use crate::interrupt::{Cancelled, Interrupt};
use crate::number::Interval;
use crate::reuse::Digest;
use crate::vm::interval::Boxes;
use crate::vm::specialise::Writer;
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

    /// Points along each axis of the pieces that a task is put together from, where long programs are to be shortened: as [`Lattice::task`],
    /// but cut along axis 2 too.
    fn part(&self) -> [usize; 3] {
        self.task()
    }

    /// The sample points that are walked: all of them, unless only a part is asked for. It begins at multiples of the sides of a task.
    fn window(&self) -> Block {
        Block { from: [0; 3], to: self.counts() }
    }

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

/// Walks the lattice, or its window. `visitor` makes the visitor of a task (or of a decided box) from its block. Runs on the current rayon pool;
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

/// Sample points that are walked: what a walk advances the progress by.
#[must_use]
pub fn points(lattice: &impl Lattice) -> u64 {
    lattice.window().points()
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
    let whole = lattice.window();
    let mut counters = Counters::default();
    let room = room(lattice, shape, &whole);
    let tasks = gather_tasks(lattice, (shape, room), whole, &mut counters, interrupt)?;
    let walkers = Pool::default();
    let memory = Memory::of(lattice, (shape, room), interrupt);
    let done: Vec<(V, Counters, bool)> = tasks
        .into_par_iter()
        .map(|task| {
            let mut own = visitor(&task.block);
            let open = task.parts.iter().any(|part| part.program().is_some());
            let memory = memory.as_ref().filter(|_| open);
            let key = memory.map(|memory| memory.key(&own, &task.block, task.told()));
            if let Some(counters) = memory.zip(key).and_then(|(memory, key)| memory.recall(&mut own, key)) {
                interrupt.tick()?;
                interrupt.advance(task.block.points());
                return Ok((own, counters, true));
            }
            let mut walker = walkers.take(|| Walker::new(lattice, (shape, room), interrupt));
            for Piece { block, state } in &task.parts {
                match state {
                    State::Decided(inside) => walker.decide(&mut own, block, *inside),
                    State::Open(program) => walker.descend(0, block, program, &mut own)?,
                }
            }
            own.finish(&mut walker.sampler);
            let counters = walker.take_counters();
            walkers.give(walker);
            if let Some((memory, key)) = memory.zip(key) {
                // Nothing that was evaluated after the interrupt was set may outlive it.
                interrupt.tick()?;
                memory.keep(&mut own, key, &counters);
            }
            Ok((own, counters, false))
        })
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

#[derive(Clone)]
enum State {
    Open(Arc<Program>),
    Decided(bool),
}

/// What one visitor goes through: its pieces, by axis 2.
struct Task {
    block: Block,
    parts: Vec<Piece>,
}

/// Programs of more operations are shortened for pieces of tasks; for shorter ones it is not worth looking where a visitor never comes.
const LONG: usize = 256;

/// Operations of all pieces' programs at which they are cut along axis 2 no further: about 100 MB.
const MANY: usize = 1 << 22;

/// Splits the whole lattice, level by level, into tasks and boxes that are decided already.
fn gather_tasks<L: Lattice>(
    lattice: &L,
    (shape, room): (&Shape, f64),
    whole: Block,
    counters: &mut Counters,
    interrupt: &Interrupt,
) -> Result<Vec<Task>, Cancelled> {
    let task = lattice.task();
    let in_parts = lattice.part() != task && shape.program.len() > LONG && !shape.program.has_regions();
    let mut floor = if in_parts { lattice.part() } else { task };
    let mut pieces = vec![Piece { block: whole, state: State::Open(Arc::clone(&shape.program)) }];
    let levels = Pool::default();
    while pieces.iter().any(|piece| piece.program().is_some() && !piece.block.fits(floor)) {
        // One box keeps one thread busy; its parts are shortened by all.
        let alone = pieces.len() == 1;
        let level: Vec<(Vec<Piece>, u64)> = pieces
            .into_par_iter()
            .map(|piece| {
                interrupt.tick()?;
                match &piece.state {
                    State::Open(program) if !piece.block.fits(floor) => {
                        let mut level = levels.take(|| Box::new(Level::new((shape, room), interrupt)));
                        level.examine(lattice, program, &piece.block, floor);
                        let parts = if alone { level.pieces_together(program) } else { level.pieces(program) };
                        let boxes = level.children.len() as u64;
                        levels.give(level);
                        Ok((parts, boxes))
                    }
                    _ => Ok((vec![piece], 0)),
                }
            })
            .collect::<Result<_, Cancelled>>()?;
        counters.boxes += level.iter().map(|(_, boxes)| boxes).sum::<u64>();
        pieces = level.into_iter().flat_map(|(pieces, _)| pieces).collect();
        if pieces.iter().filter_map(Piece::program).map(|program| program.len()).sum::<usize>() > MANY {
            floor = task;
        }
    }
    Ok(if in_parts { columns(pieces, task) } else { pieces.into_iter().map(Task::of).collect() })
}

/// The tasks that pieces make up: those over each other along axis 2 together. As the pieces come by axis 2, so do those of a task.
fn columns(pieces: Vec<Piece>, task: [usize; 3]) -> Vec<Task> {
    let mut tasks: Vec<Task> = Vec::new();
    let mut places: FxHashMap<[usize; 2], usize> = FxHashMap::default();
    let mut blocks = Vec::new();
    for Piece { block, state } in pieces {
        let whole = [task[0], task[1], block.counts()[2]];
        cut(&block, whole, &mut blocks);
        for &block in &blocks {
            let part = Piece { block, state: state.clone() };
            let [x, y, _] = block.from;
            let place = *places.entry([x, y]).or_insert(tasks.len());
            match tasks.get_mut(place) {
                Some(task) => {
                    task.block.to[2] = block.to[2];
                    task.parts.push(part);
                }
                None => tasks.push(Task::of(part)),
            }
        }
    }
    tasks
}

impl Task {
    fn of(piece: Piece) -> Self {
        Self { block: piece.block, parts: vec![piece] }
    }

    /// Its pieces, each with its program or whether it is inside.
    fn told(&self) -> impl Iterator<Item = (&Block, Result<&Program, bool>)> {
        self.parts.iter().map(|Piece { block, state }| match state {
            State::Open(program) => (block, Ok(&**program)),
            State::Decided(inside) => (block, Err(*inside)),
        })
    }
}

impl Piece {
    /// The program of one that is not decided.
    fn program(&self) -> Option<&Program> {
        match &self.state {
            State::Open(program) => Some(program),
            State::Decided(_) => None,
        }
    }
}

/// What threads work with, kept from one piece of work to the next: as many as threads ever work at a time.
struct Pool<T>(Mutex<Vec<T>>);

impl<T> Default for Pool<T> {
    fn default() -> Self {
        Self(Mutex::new(Vec::new()))
    }
}

impl<T> Pool<T> {
    fn all(&self) -> MutexGuard<'_, Vec<T>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn take(&self, make: impl FnOnce() -> T) -> T {
        let one = self.all().pop();
        one.unwrap_or_else(make)
    }

    fn give(&self, one: T) {
        self.all().push(one);
    }
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
                let Level { boxes, shorter, .. } = &mut *level;
                let shorter = shorter.get_or_insert_with(|| program.nothing());
                let part = if boxes.specialise_into(program, lane, shorter) { &*shorter } else { program };
                self.descend(depth + 1, &child, part, visitor)?;
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
    /// The program of the child that is descended into.
    shorter: Option<Program>,
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
            shorter: None,
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

    /// The children, each with its own program, or decided.
    fn pieces(&mut self, program: &Arc<Program>) -> Vec<Piece> {
        let Self { children, values, boxes, room, .. } = self;
        let piece = |(lane, &block): (usize, &Block)| {
            let mut shorter = || boxes.specialise(program, lane).map_or_else(|| Arc::clone(program), Arc::new);
            Piece { block, state: verdict(values[lane], *room).map_or_else(|| State::Open(shorter()), State::Decided) }
        };
        children.iter().enumerate().map(piece).collect()
    }

    /// The same by all threads.
    fn pieces_together(&mut self, program: &Arc<Program>) -> Vec<Piece> {
        let Self { children, values, boxes, room, .. } = self;
        let (marks, choices) = boxes.marks(program);
        let (children, values, room) = (&*children, &*values, *room);
        let shorter = |(writer, out): &mut (Writer, Program), lane: usize| {
            let shorter = marks.write((program, choices), lane, writer, out);
            State::Open(if shorter { Arc::new(out.clone()) } else { Arc::clone(program) })
        };
        let piece = |scratch: &mut (Writer, Program), lane: usize| Piece {
            block: children[lane],
            state: verdict(values[lane], room).map_or_else(|| shorter(scratch, lane), State::Decided),
        };
        let scratch = || (Writer::default(), program.nothing());
        (0..children.len()).into_par_iter().map_init(scratch, piece).collect()
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
    cut(block, steps, out);
}

/// Cuts a box into boxes of those lengths (the last ones may be shorter), axis 2 slowest.
fn cut(block: &Block, steps: [usize; 3], out: &mut Vec<Block>) {
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
