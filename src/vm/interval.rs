//! Ranges over boxes, up to 64 boxes at a time, and which operands can never matter in each: what `specialise` shortens by.

use super::choice::{Choice, Choices, watch};
use super::kernels::{Code, Kind, Operands, Store, ranges};
use super::program::{Op, Program};
use super::region::{RegionProgram, RegionStore};
use super::specialise::{Marks, Scratch};
use crate::interrupt::Interrupt;
use crate::number::{Binary, Interval, Leaf, Ternary, Unary};

/// Boxes at a time.
pub const LANES: usize = 64;

/// Bounds and flags, each together.
#[repr(align(64))]
pub(crate) struct IntervalBlock {
    lo: [f64; LANES],
    hi: [f64; LANES],
    undefined: [bool; LANES],
}

impl Default for IntervalBlock {
    fn default() -> Self {
        Self { lo: [0.0; LANES], hi: [0.0; LANES], undefined: [false; LANES] }
    }
}

/// The kind of number with bounds.
pub(crate) struct Ranges;

impl Kind for Ranges {
    type Item = Interval;
    type Block = IntervalBlock;
    type Watch = Choices;
    const LANES: usize = LANES;

    fn run_code(code: Code<'_>, store: &mut Store<Self>, lanes: usize, watch: &mut Choices) {
        ranges(code, store, lanes, watch);
    }

    #[inline(always)]
    fn get(block: &IntervalBlock, lane: usize) -> Interval {
        Interval { lo: block.lo[lane], hi: block.hi[lane], undefined: block.undefined[lane] }
    }
    #[inline(always)]
    fn set(block: &mut IntervalBlock, lane: usize, item: Interval) {
        block.lo[lane] = item.lo;
        block.hi[lane] = item.hi;
        block.undefined[lane] = item.undefined;
    }
    #[inline(always)]
    fn constant(value: f64) -> Interval {
        Interval::point(value)
    }
    #[inline(always)]
    fn unary(op: Unary, a: Interval) -> Interval {
        op.interval(a)
    }
    #[inline(always)]
    fn binary(op: Binary, a: Interval, b: Interval) -> Interval {
        op.interval(a, b)
    }
    #[inline(always)]
    fn ternary(op: Ternary, a: Interval, b: Interval, c: Interval) -> Interval {
        op.interval(a, b, c)
    }
    fn leaf(leaf: &dyn Leaf, arguments: &[Interval]) -> Interval {
        leaf.bounds(arguments)
    }

    fn region(program: &RegionProgram, store: &mut RegionStore<Self>, lanes: usize) {
        program.run_ranges(store, lanes);
    }
    fn begin(choices: &mut Choices, operations: usize, lanes: usize) {
        choices.begin(operations, lanes);
    }

    #[inline(always)]
    fn watch(choices: &mut Choices, at: usize, op: &Op, operands: &Operands<'_, Self>, result: &IntervalBlock) {
        watch(choices, at, op, operands, result);
    }
}

/// Evaluates programs over boxes. Keep one per thread.
pub struct Boxes {
    store: Store<Ranges>,
    choices: Choices,
    pub(crate) scratch: Scratch,
}

impl Default for Boxes {
    fn default() -> Self {
        Self::new()
    }
}

impl Boxes {
    /// An evaluator without storage yet.
    #[must_use]
    pub fn new() -> Self {
        Self::heeding(&Interrupt::default())
    }

    /// The same, but once the interrupt is set loops and searches end at once, with bounds that say nothing.
    #[must_use]
    pub fn heeding(interrupt: &Interrupt) -> Self {
        Self { store: Store::heeding(interrupt), choices: Choices::default(), scratch: Scratch::default() }
    }

    /// Bounds of the values over `out.len()` boxes, at most [`LANES`]: `boxes` has one slice of that length per input of the program.
    ///
    /// # Panics
    /// If the number of slices or a length is another, or above [`LANES`].
    pub fn eval(&mut self, program: &Program, boxes: &[&[Interval]], out: &mut [Interval]) {
        assert_eq!(boxes.len(), program.inputs().len(), "one slice per input");
        assert!(boxes.iter().all(|b| b.len() == out.len()) && out.len() <= LANES, "one interval per box, 64 at most");
        self.store.reserve(program);
        self.choices.begin(program.operations.len(), out.len());
        self.scratch.forget();
        for (input, intervals) in boxes.iter().enumerate() {
            let block = self.store.input(input);
            intervals.iter().enumerate().for_each(|(lane, interval)| Ranges::set(block, lane, *interval));
        }
        self.store.live = out.len();
        Ranges::run(program, &mut self.store, out.len(), &mut self.choices);
        let result = self.store.result(program);
        out.iter_mut().enumerate().for_each(|(lane, interval)| *interval = Ranges::get(result, lane));
    }

    /// The program that is right inside the box of one lane of the last [`Boxes::eval`], which must have been of this program: same
    /// values under [`super::Demand::Value`], same signs under [`super::Demand::Sign`]. `None` if no operation falls away.
    #[must_use]
    pub fn specialise(&mut self, program: &Program, lane: usize) -> Option<Program> {
        self.scratch.specialise(program, &self.choices.of, lane)
    }
    /// [`Boxes::specialise`] into a program that is there already, so that nothing is allocated; whether it became shorter. If not,
    /// what stands there is of no use.
    pub(crate) fn specialise_into(&mut self, program: &Program, lane: usize, out: &mut Program) -> bool {
        self.scratch.specialise_into(program, &self.choices.of, lane, out)
    }

    /// What the boxes of the last [`Boxes::eval`] still read, and its choices: for threads that write their programs together.
    pub(crate) fn marks(&mut self, program: &Program) -> (&Marks, &[Choice]) {
        let choices = &self.choices.of;
        (self.scratch.marks(program, choices), choices)
    }
}
