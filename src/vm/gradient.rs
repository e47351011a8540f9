//! Values with their exact derivatives by up to three inputs at a time, forward, a block of points at a time. The values are those of
//! [`super::Points`] to the bit.

use super::kernels::{Code, Kind, Store, duals};
use super::program::Program;
use super::region::{Counts, Pointwise, RegionProgram, RegionStore};
use crate::interrupt::Interrupt;
use crate::number::dual::Dual;
use crate::number::{Binary, Leaf, Ternary, Unary};

/// Derivatives at a time.
const DIRECTIONS: usize = 3;
/// Points at a time.
const LANES: usize = 64;

/// Values and slopes, each together.
#[repr(align(64))]
pub(crate) struct DualBlock {
    value: [f64; LANES],
    slope: [[f64; LANES]; DIRECTIONS],
}

impl Default for DualBlock {
    fn default() -> Self {
        Self { value: [0.0; LANES], slope: [[0.0; LANES]; DIRECTIONS] }
    }
}

/// The kind of number with three slopes.
pub(crate) struct Duals;

impl Kind for Duals {
    type Item = Dual<DIRECTIONS>;
    type Block = DualBlock;
    type Watch = ();
    const LANES: usize = LANES;

    fn run_code(code: Code<'_>, store: &mut Store<Self>, lanes: usize, watch: &mut ()) {
        duals(code, store, lanes, watch);
    }

    #[inline(always)]
    fn get(block: &DualBlock, lane: usize) -> Self::Item {
        Dual { value: block.value[lane], slope: [block.slope[0][lane], block.slope[1][lane], block.slope[2][lane]] }
    }
    #[inline(always)]
    fn set(block: &mut DualBlock, lane: usize, item: Self::Item) {
        block.value[lane] = item.value;
        block.slope[0][lane] = item.slope[0];
        block.slope[1][lane] = item.slope[1];
        block.slope[2][lane] = item.slope[2];
    }
    #[inline(always)]
    fn constant(value: f64) -> Self::Item {
        Dual::constant(value)
    }
    #[inline(always)]
    fn unary(op: Unary, a: Self::Item) -> Self::Item {
        op.dual(a)
    }
    /// For angles: values, then what each slope is multiplied by, then each slope, since rare ones are looked for by the block. The
    /// others are better done in one loop.
    #[inline(always)]
    fn unary_block(op: Unary, a: &DualBlock, out: &mut DualBlock, lanes: usize) {
        let lanes = lanes.min(LANES);
        if !matches!(op, Unary::Sin | Unary::Cos | Unary::Tan) {
            for i in 0..lanes {
                Self::set(out, i, op.dual(Self::get(a, i)));
            }
            return;
        }
        let mut by = [0.0; LANES];
        op.map(&a.value[..lanes], &mut out.value[..lanes]);
        op.slopes_map(&a.value[..lanes], &out.value[..lanes], &mut by[..lanes]);
        for (out, slope) in out.slope.iter_mut().zip(&a.slope) {
            for ((out, &slope), &by) in out[..lanes].iter_mut().zip(slope).zip(&by) {
                *out = crate::number::dual::times(by, slope);
            }
        }
    }
    #[inline(always)]
    fn binary(op: Binary, a: Self::Item, b: Self::Item) -> Self::Item {
        op.dual(a, b)
    }
    #[inline(always)]
    fn ternary(op: Ternary, a: Self::Item, b: Self::Item, c: Self::Item) -> Self::Item {
        op.dual(a, b, c)
    }
    fn leaf(leaf: &dyn Leaf, arguments: &[Self::Item]) -> Self::Item {
        super::reference::leaf_dual(leaf, arguments)
    }

    fn region(program: &RegionProgram, store: &mut RegionStore<Self>, lanes: usize) {
        program.run(store, lanes);
    }
}

impl Pointwise for Duals {
    const STEADY: bool = false;

    fn number(item: Self::Item) -> f64 {
        item.value
    }
    fn moving(value: f64, with: Self::Item, by: f64) -> Self::Item {
        Dual { value, slope: with.slope.map(|s| crate::number::dual::times(by, s)) }
    }
}

/// Evaluates programs with derivatives. Keep one per thread.
pub struct Gradients {
    store: Store<Duals>,
}

impl Default for Gradients {
    fn default() -> Self {
        Self::new()
    }
}

impl Gradients {
    /// An evaluator without storage yet.
    #[must_use]
    pub fn new() -> Self {
        Self { store: Store::new() }
    }

    /// The same, but once the interrupt is set loops and searches end at once, with values that mean nothing.
    #[must_use]
    pub fn heeding(interrupt: &Interrupt) -> Self {
        Self { store: Store::heeding(interrupt) }
    }

    /// What loops and searches have cost since the last call.
    pub fn take_counts(&mut self) -> Counts {
        self.store.take_counts()
    }

    /// The values at `value.len()` points and, into `slopes[k]`, their derivatives by the input `by[k]`; any number of those, three
    /// at a time. `points` has one slice per input of the program.
    ///
    /// # Panics
    /// If a number of slices or a length does not fit.
    pub fn eval(
        &mut self,
        program: &Program,
        points: &[&[f64]],
        by: &[usize],
        value: &mut [f64],
        slopes: &mut [&mut [f64]],
    ) {
        let count = value.len();
        assert_eq!(points.len(), program.inputs().len(), "one slice per input");
        assert!(points.iter().all(|p| p.len() == count), "one coordinate per point");
        assert_eq!(by.len(), slopes.len(), "one slice per derivative");
        assert!(slopes.iter().all(|s| s.len() == count), "one slope per point");
        self.store.reserve(program);
        for first in (0..by.len().max(1)).step_by(DIRECTIONS) {
            let last = by.len().min(first + DIRECTIONS);
            for start in (0..count).step_by(LANES) {
                let range = start..count.min(start + LANES);
                self.block(program, points, &by[first..last], range.clone());
                let result = self.store.result(program);
                value[range.clone()].copy_from_slice(&result.value[..range.len()]);
                for (slope, computed) in slopes[first..last].iter_mut().zip(&result.slope) {
                    slope[range.clone()].copy_from_slice(&computed[..range.len()]);
                }
            }
        }
    }

    fn block(&mut self, program: &Program, points: &[&[f64]], by: &[usize], range: std::ops::Range<usize>) {
        for (input, values) in points.iter().enumerate() {
            let block = self.store.input(input);
            block.value[..range.len()].copy_from_slice(&values[range.clone()]);
            for (direction, slope) in block.slope.iter_mut().enumerate() {
                slope.fill(if by.get(direction) == Some(&input) { 1.0 } else { 0.0 });
            }
        }
        self.store.live = range.len();
        Duals::run(program, &mut self.store, range.len().next_multiple_of(8), &mut ());
    }
}
