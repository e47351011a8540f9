//! Compiled regions: loops that run at each point and searches for highest values, as programs of their own, and the blocks that they
//! work on. Never changes what a region means: that is said in `field::region` and computed as `vm::reference` does.

mod repeat;
mod search;

use std::hash::Hash;

use super::compile::CompileError;
use super::kernels::{Kind, Store};
use super::program::{Demand, Program, Value};
use crate::field::{Bound, Coordinate, Form, NodeId, Region};
use crate::interrupt::Interrupt;
use crate::limits::Limits;
use crate::number::Interval;
use crate::number::extremum::ball::Plan;
use crate::number::turns::Turns;
use crate::reuse::Digest;
use search::Probe;

/// What loops and searches have cost.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Turns of loops, over all points.
    pub turns: u64,
    /// Loops that took more turns than allowed at some point, which is undefined there.
    pub endless: u64,
    /// Points at which a highest value was searched.
    pub searches: u64,
}

impl Counts {
    /// Both taken together.
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        Self {
            turns: self.turns + other.turns,
            endless: self.endless + other.endless,
            searches: self.searches + other.searches,
        }
    }
}

/// Kinds of number that stand for one point, with or without derivatives.
pub(crate) trait Pointwise: Kind {
    /// Whether it has no derivatives.
    const STEADY: bool;

    /// The value as a double.
    fn number(item: Self::Item) -> f64;
    /// A number that moves as `by` times another one does.
    fn moving(value: f64, with: Self::Item, by: f64) -> Self::Item;
}

/// A program with several results.
#[derive(Debug)]
pub(crate) struct Body {
    program: Program,
    roots: Vec<Value>,
}

impl Body {
    fn compile(region: &Region, roots: &[NodeId], parameters: usize, limits: &Limits) -> Result<Self, CompileError> {
        #[allow(clippy::cast_possible_truncation)]
        let inputs: Vec<Coordinate> = (1..=parameters as u8).map(Coordinate).collect();
        let (program, roots) = Program::compile_all(region.graph(), roots, &inputs, Demand::Value, limits)?;
        Ok(Self { program, roots })
    }
}

/// A compiled region.
#[derive(Debug)]
pub(crate) struct RegionProgram {
    work: Work,
    fingerprint: u128,
}

#[derive(Debug)]
enum Work {
    /// The condition, then the next values of the variables, then the parts of the condition; what is known where those fail.
    Loop { body: Body, states: usize, guards: Vec<Option<(usize, Interval)>>, limit: usize },
    /// The value; the value and its derivative.
    Section { body: Body, both: Body, continuous: bool, budget: usize },
    /// The value, over so many parameters that move; whether only its sign is wanted at points.
    Ball { body: Body, dimension: usize, plan: Plan, sign: bool },
}

impl RegionProgram {
    /// The program of a region. If only the `sign` of its first output is wanted at points, a search ends as soon as that is known.
    ///
    /// # Errors
    /// [`CompileError::TooLarge`] if a part takes more operations than `limits` allow.
    pub(crate) fn compile(region: &Region, sign: bool, limits: &Limits) -> Result<Self, CompileError> {
        let coordinates = |roots: &[NodeId]| {
            let used = roots.iter().flat_map(|root| region.graph().coordinates(*root).iter().last());
            used.map(|c| usize::from(c.0)).max().unwrap_or(0)
        };
        let roots = region.form().roots();
        let compile =
            |roots: &[NodeId], least: usize| Body::compile(region, roots, coordinates(roots).max(least), limits);
        let work = match region.form() {
            Form::Loop { next, guards, .. } => Work::Loop {
                body: compile(&roots, next.len())?,
                states: next.len(),
                guards: guards.iter().map(|guard| guard.bound.map(Bound::within)).collect(),
                limit: limits.point_turns,
            },
            Form::Section { continuous, .. } => Work::Section {
                body: compile(&roots[..1], 1)?,
                both: compile(&roots, 1)?,
                continuous: *continuous,
                budget: limits.section_pieces,
            },
            Form::Ball { dimension, .. } => Work::Ball {
                body: compile(&roots, *dimension)?,
                dimension: *dimension,
                plan: Plan::new(*dimension),
                sign,
            },
        };
        let mut digest = Digest::of("region program");
        (region.fingerprint(), sign, limits.point_turns, limits.section_pieces).hash(&mut digest);
        Ok(Self { work, fingerprint: digest.key().bits() })
    }

    /// A hash of all that its values depend on.
    pub(crate) fn fingerprint(&self) -> u128 {
        self.fingerprint
    }

    /// Whether it searches for a highest value, or a part of it does.
    pub(crate) fn searches(&self) -> bool {
        match &self.work {
            Work::Loop { body, .. } => body.program.has_searches(),
            Work::Section { .. } | Work::Ball { .. } => true,
        }
    }

    /// Runs it on the first lanes of what it was given.
    pub(crate) fn run<K: Pointwise>(&self, store: &mut RegionStore<K>, lanes: usize) {
        match &self.work {
            Work::Loop { body, states, limit, .. } => {
                let (turns, endless) = repeat::points(body, *states, *limit, store, lanes);
                store.counts = store.counts.plus(Counts { turns, endless, searches: 0 });
            }
            Work::Section { body, both, continuous, budget } => {
                store.counts.searches += lanes as u64;
                search::sections(body, both, (*continuous, *budget), store, lanes);
            }
            Work::Ball { body, dimension, plan, sign } => {
                store.counts.searches += lanes as u64;
                search::balls(body, *dimension, (plan, *sign), store, lanes);
            }
        }
    }

    /// Bounds what it puts out, over the boxes in the first lanes.
    pub(crate) fn run_ranges(&self, store: &mut RegionStore<super::interval::Ranges>, lanes: usize) {
        match &self.work {
            Work::Loop { body, states, guards, limit } => {
                repeat::ranges(body, (*states, guards), *limit, store, lanes);
            }
            Work::Section { both, continuous, .. } => search::section_ranges(both, *continuous, store, lanes),
            Work::Ball { body, dimension, plan, .. } => {
                search::ball_ranges(body, *dimension, plan, store, lanes);
            }
        }
    }
}

/// The blocks of a region within an evaluator, kept from one call to the next.
pub(crate) struct RegionStore<K: Kind> {
    /// Its arguments.
    given: Vec<Box<K::Block>>,
    outputs: Vec<Box<K::Block>>,
    /// Next values, while the old ones are still read.
    held: Vec<Box<K::Block>>,
    inner: Store<K>,
    watch: K::Watch,
    /// The lane that each lane at work came from.
    places: Vec<usize>,
    /// The lanes at work that go on.
    going: Vec<usize>,
    /// For loops over boxes, by lane.
    turns: Vec<Turns>,
    probe: Option<Box<Probe>>,
    counts: Counts,
}

impl<K: Kind> RegionStore<K> {
    pub(crate) fn heeding(interrupt: &Interrupt) -> Self {
        Self {
            given: Vec::new(),
            outputs: Vec::new(),
            held: Vec::new(),
            inner: Store::heeding(interrupt),
            watch: K::Watch::default(),
            places: Vec::new(),
            going: Vec::new(),
            turns: Vec::new(),
            probe: None,
            counts: Counts::default(),
        }
    }

    /// What it has cost since the last call, regions within it included.
    pub(crate) fn take_counts(&mut self) -> Counts {
        std::mem::take(&mut self.counts).plus(self.inner.take_counts())
    }

    /// Takes an argument.
    pub(crate) fn give(&mut self, place: usize, block: &K::Block, lanes: usize) {
        room::<K>(&mut self.given, place + 1);
        copy::<K>(block, &mut self.given[place], lanes);
    }

    /// Copies an output.
    pub(crate) fn put_out(&self, output: usize, out: &mut K::Block, lanes: usize) {
        copy::<K>(&self.outputs[output], out, lanes);
    }

    /// Runs a program on what stands in the inner inputs.
    fn run(&mut self, program: &Program, lanes: usize) {
        self.inner.live = lanes;
        K::begin(&mut self.watch, program.operations.len(), lanes);
        K::run(program, &mut self.inner, lanes.next_multiple_of(16).min(K::LANES), &mut self.watch);
    }
}

/// Makes room for so many blocks.
fn room<K: Kind>(blocks: &mut Vec<Box<K::Block>>, count: usize) {
    while blocks.len() < count {
        blocks.push(Box::default());
    }
}

fn copy<K: Kind>(from: &K::Block, to: &mut K::Block, lanes: usize) {
    for i in 0..lanes.min(K::LANES) {
        K::set(to, i, K::get(from, i));
    }
}
