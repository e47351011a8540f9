//! Runs a program over a block of lanes: one closure per operation, whatever kind of number the lanes hold. The instruction set is
//! chosen when the program runs; the bits of the results do not depend on it, since nothing is ever fused or reordered.
//!
//! Each result is computed into a spare block, which then changes places with the block of its slot: so a result may take the slot of
//! an operand, and the loops never write where they read (they would fall back to scalar code).

use std::sync::Arc;

#[cfg(not(debug_assertions))]
use multiversion::multiversion;

use super::program::{Op, Program, Value};
use super::region::{Counts, RegionProgram, RegionStore};
use crate::field::SharedLeaf;
use crate::interrupt::Interrupt;
use crate::number::{Binary, Leaf, Ternary, Unary};

/// A kind of number to evaluate with, and how a block of them lies in memory.
pub(crate) trait Kind: Sized {
    /// One number.
    type Item: Copy;
    /// [`Kind::LANES`] numbers, by component, aligned to a cache line.
    type Block: Default;
    /// What is told of each operation and its results.
    type Watch: Default;

    /// Numbers in a block.
    const LANES: usize;

    fn get(block: &Self::Block, lane: usize) -> Self::Item;
    fn set(block: &mut Self::Block, lane: usize, item: Self::Item);
    fn constant(value: f64) -> Self::Item;
    fn unary(op: Unary, a: Self::Item) -> Self::Item;
    fn binary(op: Binary, a: Self::Item, b: Self::Item) -> Self::Item;
    fn ternary(op: Ternary, a: Self::Item, b: Self::Item, c: Self::Item) -> Self::Item;

    /// An operation on the first lanes of a block.
    #[inline(always)]
    fn unary_block(op: Unary, a: &Self::Block, out: &mut Self::Block, lanes: usize) {
        for i in 0..lanes.min(Self::LANES) {
            Self::set(out, i, Self::unary(op, Self::get(a, i)));
        }
    }

    fn leaf(leaf: &dyn Leaf, arguments: &[Self::Item]) -> Self::Item;

    /// A leaf at the first lanes of its arguments' blocks.
    fn leaf_block(leaf: &dyn Leaf, arguments: &[&Self::Block], out: &mut Self::Block, lanes: usize) {
        for i in 0..lanes {
            let mut items = [Self::constant(0.0); 4];
            items.iter_mut().zip(arguments).for_each(|(item, block)| *item = Self::get(block, i));
            Self::set(out, i, Self::leaf(leaf, &items[..arguments.len()]));
        }
    }

    /// Runs operations on the first `lanes` lanes of the blocks, with the best instructions that there are.
    fn run_code(code: Code<'_>, store: &mut Store<Self>, lanes: usize, watch: &mut Self::Watch);

    /// Runs a program on the first `lanes` lanes of the input blocks.
    fn run(program: &Program, store: &mut Store<Self>, lanes: usize, watch: &mut Self::Watch) {
        Self::run_code(Code::of(program), store, lanes, watch);
    }

    /// Runs a region on the first `lanes` lanes of the arguments that it was given.
    fn region(program: &RegionProgram, store: &mut RegionStore<Self>, lanes: usize);

    /// Called before a program of so many operations runs on so many lanes.
    fn begin(_: &mut Self::Watch, _operations: usize, _lanes: usize) {}

    /// Called with each operation before its result takes its slot.
    #[inline(always)]
    fn watch(_: &mut Self::Watch, _at: usize, _op: &Op, _operands: &Operands<'_, Self>, _result: &Self::Block) {}
}

/// Operations to run in their order, and where their operands and results lie.
#[derive(Clone, Copy)]
pub(crate) struct Code<'a> {
    pub(crate) operations: &'a [Op],
    /// The slot of each operation's result.
    pub(crate) results: &'a [u32],
    /// The slot of each value that an operation reads.
    pub(crate) slots: &'a [u32],
    pub(crate) leaves: &'a [SharedLeaf],
    pub(crate) regions: &'a [Arc<RegionProgram>],
}

impl<'a> Code<'a> {
    /// The whole of a program.
    pub(crate) fn of(program: &'a Program) -> Self {
        Self {
            operations: &program.operations,
            results: &program.slots[program.inputs.len()..],
            slots: &program.slots,
            leaves: &program.leaves,
            regions: &program.regions,
        }
    }
}

/// The blocks of an evaluator, kept from one call to the next.
pub(crate) struct Store<K: Kind> {
    slots: Vec<Box<K::Block>>,
    spare: Box<K::Block>,
    regions: Vec<RegionStore<K>>,
    /// Lanes that are asked for, of those that are computed.
    pub(crate) live: usize,
    /// What loops and searches ask whether to go on.
    pub(crate) interrupt: Interrupt,
}

impl<K: Kind> Store<K> {
    pub(crate) fn new() -> Self {
        Self::heeding(&Interrupt::default())
    }

    /// A store whose loops and searches end once the interrupt is set, with results that mean nothing.
    pub(crate) fn heeding(interrupt: &Interrupt) -> Self {
        let interrupt = interrupt.clone();
        Self { slots: Vec::new(), spare: Box::default(), regions: Vec::new(), live: 0, interrupt }
    }

    /// Makes room for a program; allocates only for more slots than ever before.
    pub(crate) fn reserve(&mut self, program: &Program) {
        self.reserve_slots(program.slot_count());
        while self.regions.len() < program.regions.len() {
            self.regions.push(RegionStore::heeding(&self.interrupt));
        }
    }

    /// Makes room for so many slots.
    pub(crate) fn reserve_slots(&mut self, count: usize) {
        while self.slots.len() < count {
            self.slots.push(Box::default());
        }
    }

    /// The block of a slot.
    pub(crate) fn slot(&self, slot: u32) -> &K::Block {
        &self.slots[slot as usize]
    }

    /// What loops and searches have cost since the last call.
    pub(crate) fn take_counts(&mut self) -> Counts {
        self.regions.iter_mut().fold(Counts::default(), |all, region| all.plus(region.take_counts()))
    }

    /// The block of an input.
    pub(crate) fn input(&mut self, input: usize) -> &mut K::Block {
        &mut self.slots[input]
    }

    /// The block of any value that is kept to the end.
    pub(crate) fn of(&self, program: &Program, value: Value) -> &K::Block {
        &self.slots[program.slots[value as usize] as usize]
    }

    /// The block that holds the results once the program has run.
    pub(crate) fn result(&self, program: &Program) -> &K::Block {
        &self.slots[program.slots[program.root as usize] as usize]
    }
}

/// The blocks that operations read, by value.
pub(crate) struct Operands<'a, K: Kind> {
    blocks: &'a [Box<K::Block>],
    slots: &'a [u32],
}

impl<'a, K: Kind> Operands<'a, K> {
    #[inline(always)]
    pub(crate) fn of(&self, value: Value) -> &'a K::Block {
        &self.blocks[self.slots[value as usize] as usize]
    }
}

/// Runs the operations on the first `lanes` lanes of their blocks. Inlined into one function per kind and instruction set.
#[inline(always)]
fn run<K: Kind>(code: Code<'_>, store: &mut Store<K>, lanes: usize, watch: &mut K::Watch) {
    for (at, (op, slot)) in code.operations.iter().zip(code.results).enumerate() {
        let operands = Operands { blocks: &store.slots, slots: code.slots };
        if let Op::Give(..) | Op::Region(..) | Op::Output(..) = op {
            let live = store.live.min(lanes);
            if !region::<K>(code.regions, op, &operands, &mut store.regions, live, &mut store.spare) {
                continue;
            }
            std::mem::swap(&mut store.spare, &mut store.slots[*slot as usize]);
            continue;
        }
        step::<K>(code.leaves, op, &operands, &mut store.spare, lanes);
        K::watch(watch, at, op, &operands, &store.spare);
        std::mem::swap(&mut store.spare, &mut store.slots[*slot as usize]);
    }
}

/// The steps of a region: what it is given, what it does, what it puts out. Whether there is a result.
fn region<K: Kind>(
    programs: &[Arc<RegionProgram>],
    op: &Op,
    operands: &Operands<'_, K>,
    regions: &mut [RegionStore<K>],
    live: usize,
    out: &mut K::Block,
) -> bool {
    match *op {
        Op::Give(region, place, value, _) => {
            regions[region as usize].give(place as usize, operands.of(value), live);
            false
        }
        Op::Region(region, _) => {
            let region = region as usize;
            K::region(&programs[region], &mut regions[region], live);
            regions[region].put_out(0, out, live);
            true
        }
        Op::Output(region, output, _) => {
            regions[region as usize].put_out(output as usize, out, live);
            true
        }
        _ => false,
    }
}

/// A loop over the lanes. A macro, not a function of a closure: the compiler must see the operation as a constant within the loop, or
/// it calls it lane by lane.
macro_rules! each {
    ($out:ident, $lanes:ident, $i:ident => $value:expr) => {
        for $i in 0..$lanes.min(K::LANES) {
            K::set($out, $i, $value);
        }
    };
}

/// The function that runs programs with one kind of number, for each instruction set. Builds without optimisation get the portable one
/// alone: the others would take most of the time of compiling the package.
macro_rules! runner {
    ($name:ident, $kind:ty) => {
        #[cfg_attr(
            not(debug_assertions),
            multiversion(targets("x86_64+avx512f+avx512bw+avx512dq+avx512vl", "x86_64+avx2"))
        )]
        pub(crate) fn $name<'a>(
            code: Code<'a>,
            store: &mut Store<$kind>,
            lanes: usize,
            watch: &mut <$kind as Kind>::Watch,
        ) {
            run::<$kind>(code, store, lanes, watch);
        }
    };
}

runner!(doubles, super::block::Doubles);
runner!(singles, super::block::Singles);
runner!(duals, super::gradient::Duals);
runner!(ranges, super::interval::Ranges);

#[inline(always)]
fn step<K: Kind>(leaves: &[SharedLeaf], op: &Op, operands: &Operands<'_, K>, out: &mut K::Block, lanes: usize) {
    match *op {
        Op::Constant(value) => {
            let value = K::constant(value);
            each!(out, lanes, i => value);
        }
        Op::Unary(op, a) => unary::<K>(op, operands.of(a), out, lanes),
        Op::Binary(op, a, b) => binary::<K>(op, operands.of(a), operands.of(b), out, lanes),
        Op::WithRight(op, a, number) => with_right::<K>(op, operands.of(a), number, out, lanes),
        Op::WithLeft(op, number, b) => with_left::<K>(op, number, operands.of(b), out, lanes),
        Op::Ternary(op, [a, b, c]) => ternary::<K>(op, [operands.of(a), operands.of(b), operands.of(c)], out, lanes),
        Op::Join(op, a, b, number) => join::<K>(op, operands.of(a), operands.of(b), number, out, lanes),
        Op::Extreme(op, _, a, b) => binary::<K>(op, operands.of(a), operands.of(b), out, lanes),
        Op::Give(..) | Op::Region(..) | Op::Output(..) => debug_assert!(false, "regions run by themselves"),
        Op::Leaf(leaf, arity, arguments) => {
            let blocks = arguments.map(|a| operands.of(a));
            K::leaf_block(&*leaves[leaf as usize].0, &blocks[..usize::from(arity)], out, lanes);
        }
    }
}

/// One loop for each of the operations listed, in which the operation is the constant `THE`.
macro_rules! apart {
    ($op:ident, $kind:ident [$($name:ident)*] $(, $rest:pat => $other:expr)?; $out:ident, $lanes:ident, $i:ident => $value:expr) => {
        match $op {
            $($kind::$name => {
                const THE: $kind = $kind::$name;
                each!($out, $lanes, $i => $value);
            })*
            $($rest => $other,)?
        }
    };
}

#[inline(always)]
fn unary<K: Kind>(op: Unary, a: &K::Block, out: &mut K::Block, lanes: usize) {
    /// One call for each of the operations listed, so that each is a constant within its loop.
    macro_rules! apart {
        ($($name:ident)*; $($power:literal)*) => {
            match op {
                $(Unary::$name => K::unary_block(Unary::$name, a, out, lanes),)*
                $(Unary::Powi($power) => K::unary_block(Unary::Powi($power), a, out, lanes),)*
                Unary::Powi(n) => K::unary_block(Unary::Powi(n), a, out, lanes),
            }
        };
    }
    apart!(
        Neg Abs Sqrt Cbrt Exp Log Log10 Sin Cos Tan Asin Acos Atan Sinh Cosh Tanh Asinh Acosh Atanh
        Floor Ceil Round Sign Not; 2 3 4 -1
    );
}

#[inline(always)]
fn binary<K: Kind>(op: Binary, a: &K::Block, b: &K::Block, out: &mut K::Block, lanes: usize) {
    apart!(
        op,
        Binary [Add Sub Mul Div Min Max Pow Atan2 Hypot Mod Less LessEqual Equal NotEqual And Or];
        out, lanes, i => K::binary(THE, K::get(a, i), K::get(b, i))
    );
}

/// For the operations of [`super::compile::has_number_form`].
#[inline(always)]
fn with_right<K: Kind>(op: Binary, a: &K::Block, number: f64, out: &mut K::Block, lanes: usize) {
    let b = K::constant(number);
    apart!(
        op,
        Binary [Add Sub Mul Div Min Max Less LessEqual],
        _ => debug_assert!(false, "{op:?} has no form with a number");
        out, lanes, i => K::binary(THE, K::get(a, i), b)
    );
}

/// For the operations of [`super::compile::has_number_form`].
#[inline(always)]
fn with_left<K: Kind>(op: Binary, number: f64, b: &K::Block, out: &mut K::Block, lanes: usize) {
    let a = K::constant(number);
    apart!(
        op,
        Binary [Add Sub Mul Div Min Max Less LessEqual],
        _ => debug_assert!(false, "{op:?} has no form with a number");
        out, lanes, i => K::binary(THE, a, K::get(b, i))
    );
}

#[inline(always)]
fn ternary<K: Kind>(op: Ternary, [a, b, c]: [&K::Block; 3], out: &mut K::Block, lanes: usize) {
    apart!(
        op,
        Ternary [Select Union Intersection UnionSmooth IntersectionSmooth Norm];
        out, lanes, i => K::ternary(THE, K::get(a, i), K::get(b, i), K::get(c, i))
    );
}

#[inline(always)]
fn join<K: Kind>(op: Ternary, a: &K::Block, b: &K::Block, number: f64, out: &mut K::Block, lanes: usize) {
    let c = K::constant(number);
    apart!(
        op,
        Ternary [Union Intersection UnionSmooth IntersectionSmooth Norm],
        Ternary::Select => debug_assert!(false, "a condition has no parameter");
        out, lanes, i => K::ternary(THE, K::get(a, i), K::get(b, i), c)
    );
}

#[cfg(test)]
mod sets;
#[cfg(test)]
mod tests {
    use super::super::block::{Doubles, Points};
    use super::{Kind, Store};
    use crate::field::{Coordinate, Graph};
    use crate::limits::Limits;
    use crate::number::{Algebra, Binary, Unary};
    use crate::vm::{Demand, Program};

    /// Where the blocks of a store lie, sorted: they change places, and nothing else.
    fn places<K: Kind>(store: &Store<K>) -> Vec<*const K::Block> {
        let mut all: Vec<*const K::Block> = store.slots.iter().chain([&store.spare]).map(|b| &raw const **b).collect();
        all.sort_unstable();
        all
    }

    #[test]
    fn a_warm_store_allocates_nothing() {
        let mut graph = Graph::new();
        let x = graph.coordinate(Coordinate(1));
        let sine = graph.unary(Unary::Sin, x);
        let root = graph.binary(Binary::Mul, sine, x);
        let program = Program::compile(&graph, root, &[Coordinate(1)], Demand::Value, &Limits::default())
            .expect("two operations");
        let mut store = Store::<Doubles>::new();
        store.reserve(&program);
        let warm = places(&store);
        for _ in 0..5 {
            store.reserve(&program);
            Doubles::run(&program, &mut store, 128, &mut ());
        }
        assert_eq!(places(&store), warm);
        let mut out = [0.0; 300];
        Points::<f64>::new().eval(&program, &[&[0.5; 300]], &mut out);
        assert!(out.iter().all(|v| *v == 0.5 * Unary::Sin.real(0.5)));
    }
}
