//! Values at many points, in double or single precision. Double precision decides what a user sees; single precision may filter.
//! Allocates nothing per block once it has seen its largest program.

use super::kernels::{Code, Kind, Store, doubles, singles};
use super::lattice::Walked;
use super::program::Program;
use super::region::{Counts, Pointwise, RegionProgram, RegionStore};
use crate::interrupt::Interrupt;
use crate::number::float::Float;
use crate::number::{Binary, Leaf, Ternary, Unary};

/// 1 KB of numbers, aligned to a cache line; the allocator's own header keeps blocks off a pitch of 1 KB, at which they would
/// collide in the cache.
#[repr(align(64))]
pub struct Lanes<T, const N: usize>([T; N]);

impl<T: Float, const N: usize> Default for Lanes<T, N> {
    fn default() -> Self {
        Self([T::ZERO; N])
    }
}

/// The numbers that blocks of points can hold: `f64`, 128 of them, and `f32`, 256 of them.
pub trait Scalar: Float + sealed::Blocks {}

impl Scalar for f64 {}
impl Scalar for f32 {}

mod sealed {
    use super::{Kind, Lanes};

    pub trait Blocks: Sized {
        #[expect(private_bounds, reason = "the trait is sealed; evaluators alone know what a kind is")]
        type Of: Kind<Item = Self, Block: AsRef<[Self]> + AsMut<[Self]>, Watch = ()>;
    }

    impl<T, const N: usize> AsRef<[T]> for Lanes<T, N> {
        fn as_ref(&self) -> &[T] {
            &self.0
        }
    }
    impl<T, const N: usize> AsMut<[T]> for Lanes<T, N> {
        fn as_mut(&mut self) -> &mut [T] {
            &mut self.0
        }
    }
}

/// Blocks of doubles.
pub struct Doubles;
/// Blocks of singles.
pub struct Singles;

impl sealed::Blocks for f64 {
    type Of = Doubles;
}
impl sealed::Blocks for f32 {
    type Of = Singles;
}

impl Kind for Doubles {
    type Item = f64;
    type Block = Lanes<f64, 128>;
    type Watch = ();
    const LANES: usize = 128;

    fn run_code(code: Code<'_>, store: &mut Store<Self>, lanes: usize, watch: &mut ()) {
        doubles(code, store, lanes, watch);
    }

    #[inline(always)]
    fn get(block: &Self::Block, lane: usize) -> f64 {
        block.0[lane]
    }
    #[inline(always)]
    fn set(block: &mut Self::Block, lane: usize, item: f64) {
        block.0[lane] = item;
    }
    #[inline(always)]
    fn constant(value: f64) -> f64 {
        value
    }
    #[inline(always)]
    fn unary(op: Unary, a: f64) -> f64 {
        op.real(a)
    }
    #[inline(always)]
    fn binary(op: Binary, a: f64, b: f64) -> f64 {
        op.real(a, b)
    }
    /// Rare arguments are looked for by the block, not by the lane.
    #[inline(always)]
    fn unary_block(op: Unary, a: &Self::Block, out: &mut Self::Block, lanes: usize) {
        let lanes = lanes.min(Self::LANES);
        op.map(&a.0[..lanes], &mut out.0[..lanes]);
    }
    #[inline(always)]
    fn ternary(op: Ternary, a: f64, b: f64, c: f64) -> f64 {
        op.real(a, b, c)
    }
    fn leaf(leaf: &dyn Leaf, arguments: &[f64]) -> f64 {
        leaf.value(arguments)
    }

    fn leaf_block(leaf: &dyn Leaf, arguments: &[&Self::Block], out: &mut Self::Block, lanes: usize) {
        let mut at: [&[f64]; 4] = [&[]; 4];
        at.iter_mut().zip(arguments).for_each(|(to, from)| *to = &from.0[..lanes]);
        leaf.values(&at[..arguments.len()], &mut out.0[..lanes]);
    }

    fn region(program: &RegionProgram, store: &mut RegionStore<Self>, lanes: usize) {
        program.run(store, lanes);
    }
}

impl Pointwise for Doubles {
    const STEADY: bool = true;

    fn number(item: Self::Item) -> f64 {
        item
    }
    fn moving(value: f64, _: Self::Item, _: f64) -> Self::Item {
        value
    }
}

impl Kind for Singles {
    type Item = f32;
    type Block = Lanes<f32, 256>;
    type Watch = ();
    const LANES: usize = 256;

    fn run_code(code: Code<'_>, store: &mut Store<Self>, lanes: usize, watch: &mut ()) {
        singles(code, store, lanes, watch);
    }

    #[inline(always)]
    fn get(block: &Self::Block, lane: usize) -> f32 {
        block.0[lane]
    }
    #[inline(always)]
    fn set(block: &mut Self::Block, lane: usize, item: f32) {
        block.0[lane] = item;
    }
    #[inline(always)]
    fn constant(value: f64) -> f32 {
        value as f32
    }
    #[inline(always)]
    fn unary(op: Unary, a: f32) -> f32 {
        op.single(a)
    }
    #[inline(always)]
    fn binary(op: Binary, a: f32, b: f32) -> f32 {
        op.single(a, b)
    }
    /// Rare arguments are looked for by the block, not by the lane.
    #[inline(always)]
    fn unary_block(op: Unary, a: &Self::Block, out: &mut Self::Block, lanes: usize) {
        let lanes = lanes.min(Self::LANES);
        op.map(&a.0[..lanes], &mut out.0[..lanes]);
    }
    #[inline(always)]
    fn ternary(op: Ternary, a: f32, b: f32, c: f32) -> f32 {
        op.single(a, b, c)
    }
    fn leaf(leaf: &dyn Leaf, arguments: &[f32]) -> f32 {
        let mut at = [0.0; 4];
        at.iter_mut().zip(arguments).for_each(|(to, from)| *to = f64::from(*from));
        leaf.value(&at[..arguments.len()]) as f32
    }

    fn region(program: &RegionProgram, store: &mut RegionStore<Self>, lanes: usize) {
        program.run(store, lanes);
    }
}

impl Pointwise for Singles {
    const STEADY: bool = true;

    fn number(item: Self::Item) -> f64 {
        f64::from(item)
    }
    fn moving(value: f64, _: Self::Item, _: f64) -> Self::Item {
        value as f32
    }
}

/// Evaluates programs at points, a block at a time. Keep one per thread.
pub struct Points<T: Scalar> {
    pub(super) store: Store<T::Of>,
    pub(super) walked: Option<Box<Walked<T>>>,
}

impl<T: Scalar> Default for Points<T> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T: Scalar> Points<T> {
    /// An evaluator without storage yet.
    #[must_use]
    pub fn new() -> Self {
        Self { store: Store::new(), walked: None }
    }

    /// The same, but once the interrupt is set loops and searches end at once, with values that mean nothing.
    #[must_use]
    pub fn heeding(interrupt: &Interrupt) -> Self {
        Self { store: Store::heeding(interrupt), walked: None }
    }

    /// What loops and searches have cost since the last call.
    pub fn take_counts(&mut self) -> Counts {
        self.store.take_counts()
    }

    /// The values at `out.len()` points: `points` has one slice of that length per input of the program.
    ///
    /// # Panics
    /// If the number of slices or a length is another.
    pub fn eval(&mut self, program: &Program, points: &[&[T]], out: &mut [T]) {
        assert_eq!(points.len(), program.inputs().len(), "one slice per input");
        assert!(points.iter().all(|p| p.len() == out.len()), "one coordinate per point");
        self.store.reserve(program);
        let size = <T::Of as Kind>::LANES;
        for (block, out) in out.chunks_mut(size).enumerate() {
            for (input, values) in points.iter().enumerate() {
                let values = &values[block * size..][..out.len()];
                self.store.input(input).as_mut()[..out.len()].copy_from_slice(values);
            }
            self.store.live = out.len();
            // Whole vectors are computed; what the lanes beyond the last point hold is never read.
            T::Of::run(program, &mut self.store, out.len().next_multiple_of(16), &mut ());
            out.copy_from_slice(&self.store.result(program).as_ref()[..out.len()]);
        }
    }
}
