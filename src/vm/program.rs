//! A compiled expression: a flat list of operations in an order in which each comes after what it reads. Immutable; knows nothing of
//! how it is evaluated.

use std::sync::Arc;

use super::region::RegionProgram;
use crate::field::{Coordinate, SharedLeaf};
use crate::number::{Binary, Ternary, Unary};

/// What is asked of a program's value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Demand {
    /// The value itself, to the bit.
    Value,
    /// Only whether it is >= 0 (inside) or not (negative or undefined: outside). Set operations at the top become max and min.
    Sign,
}

/// A value within a program: the inputs come first, then the results of the operations in their order.
pub(crate) type Value = u32;

/// Which question about a value is asked where only a sign matters. Below a complement more than inside or not must be kept: an
/// undefined value stays undefined there, while a negative one turns positive.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Side {
    /// Whether it is >= 0; undefined is not.
    Inside,
    /// Whether it is >= 0, < 0 or undefined.
    Upper,
    /// Whether it is <= 0, > 0 or undefined.
    Lower,
    /// Both of the latter.
    Both,
}

/// An operation. A parameter that is a number stands in the operation itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Op {
    /// A number where an operand must be a value.
    Constant(f64),
    Unary(Unary, Value),
    Binary(Binary, Value, Value),
    /// `value op number`
    WithRight(Binary, Value, f64),
    /// `number op value`
    WithLeft(Binary, f64, Value),
    /// `IF a THEN b ELSE c`, and R-functions whose parameter varies.
    Ternary(Ternary, [Value; 3]),
    /// An R-function whose parameter is a number.
    Join(Ternary, Value, Value, f64),
    /// Min or max of which only a sign is asked.
    Extreme(Binary, Side, Value, Value),
    /// Data: the leaf's number in the program, its arity, its arguments.
    Leaf(u32, u8, [Value; 4]),
    /// Hands a region, by its number in the program, one of its arguments; the value behind it is that of the argument before, or the same
    /// again. Its own value is not used but for the order.
    Give(u32, u32, Value, Value),
    /// Runs a region, whose last argument was that; its first output.
    Region(u32, Value),
    /// Another output of a region that has run.
    Output(u32, u32, Value),
}

impl Op {
    /// Calls `f` with each value that the operation reads.
    #[inline(always)]
    pub(crate) fn for_each_operand(&self, mut f: impl FnMut(Value)) {
        match *self {
            Self::Constant(_) => {}
            Self::Unary(_, a) | Self::WithRight(_, a, _) | Self::WithLeft(_, _, a) => f(a),
            Self::Region(_, a) | Self::Output(_, _, a) => f(a),
            Self::Binary(_, a, b) | Self::Join(_, a, b, _) | Self::Extreme(_, _, a, b) | Self::Give(_, _, a, b) => {
                f(a);
                f(b);
            }
            Self::Ternary(_, operands) => operands.into_iter().for_each(f),
            Self::Leaf(_, arity, arguments) => arguments[..usize::from(arity)].iter().copied().for_each(f),
        }
    }

    /// The operation with each value replaced.
    #[inline(always)]
    pub(crate) fn renumbered(self, mut f: impl FnMut(Value) -> Value) -> Self {
        match self {
            Self::Constant(_) => self,
            Self::Unary(op, a) => Self::Unary(op, f(a)),
            Self::WithRight(op, a, c) => Self::WithRight(op, f(a), c),
            Self::WithLeft(op, c, a) => Self::WithLeft(op, c, f(a)),
            Self::Binary(op, a, b) => Self::Binary(op, f(a), f(b)),
            Self::Join(op, a, b, c) => Self::Join(op, f(a), f(b), c),
            Self::Extreme(op, side, a, b) => Self::Extreme(op, side, f(a), f(b)),
            Self::Give(region, place, a, b) => Self::Give(region, place, f(a), f(b)),
            Self::Region(region, a) => Self::Region(region, f(a)),
            Self::Output(region, output, a) => Self::Output(region, output, f(a)),
            Self::Ternary(op, [a, b, c]) => Self::Ternary(op, [f(a), f(b), f(c)]),
            Self::Leaf(leaf, arity, mut arguments) => {
                arguments[..usize::from(arity)].iter_mut().for_each(|a| *a = f(*a));
                Self::Leaf(leaf, arity, arguments)
            }
        }
    }
}

/// A compiled expression. Cheap to share between threads; every evaluator takes it by reference.
#[derive(Clone, Debug)]
pub struct Program {
    pub(crate) inputs: Arc<[Coordinate]>,
    pub(crate) leaves: Arc<[SharedLeaf]>,
    /// The regions, one for each set of arguments.
    pub(crate) regions: Arc<[Arc<RegionProgram>]>,
    /// In an order in which each comes after what it reads; none is superfluous.
    pub(crate) operations: Vec<Op>,
    /// The slot of each value, inputs included: a place in the evaluator's storage that later values use again.
    pub(crate) slots: Vec<u32>,
    /// How many slots there are.
    pub(crate) slot_count: u32,
    /// The value of the whole.
    pub(crate) root: Value,
    pub(crate) demand: Demand,
}

impl Program {
    /// The coordinates that a point gives, in this order.
    #[must_use]
    pub fn inputs(&self) -> &[Coordinate] {
        &self.inputs
    }

    /// Whether an operation is a loop or a search, so that a point takes much longer than the number of operations tells.
    #[must_use]
    pub fn has_regions(&self) -> bool {
        !self.regions.is_empty()
    }

    /// Whether an operation searches for a highest value, so that a point takes longer still.
    #[must_use]
    pub fn has_searches(&self) -> bool {
        self.regions.iter().any(|region| region.searches())
    }

    /// The data that the whole is, if it is nothing else, and the values that it reads: inputs come first.
    #[must_use]
    pub(crate) fn sole_leaf(&self) -> Option<(&dyn crate::number::Leaf, &[Value])> {
        match &self.operations[..] {
            [Op::Leaf(leaf, arity, arguments)] => {
                Some((&*self.leaves[*leaf as usize].0, &arguments[..usize::from(*arity)]))
            }
            _ => None,
        }
    }

    /// Number of operations.
    #[must_use]
    pub fn len(&self) -> usize {
        self.operations.len()
    }

    /// What a value costs, in operations: data may take many.
    #[must_use]
    pub fn work(&self) -> usize {
        if self.leaves.is_empty() {
            return self.len();
        }
        let work = |op: &Op| match *op {
            Op::Leaf(leaf, ..) => self.leaves[leaf as usize].0.work(),
            _ => 1,
        };
        self.operations.iter().map(work).sum()
    }

    /// Whether there is no operation: the value is one of the inputs.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.operations.is_empty()
    }

    /// What was asked of it when it was compiled.
    #[must_use]
    pub fn demand(&self) -> Demand {
        self.demand
    }

    /// How many values are kept at a time, inputs included.
    #[must_use]
    pub fn slot_count(&self) -> usize {
        self.slot_count as usize
    }

    /// The value, if it is one number everywhere.
    #[must_use]
    pub fn number(&self) -> Option<f64> {
        let index = (self.root as usize).checked_sub(self.inputs.len())?;
        match self.operations.get(index) {
            Some(Op::Constant(value)) => Some(*value),
            _ => None,
        }
    }

    /// Whether the value changes without jumps wherever it is defined and its derivatives are finite: no step, comparison, choice, data or
    /// loop is in it. Undefined operands that MAX passes over make jumps as well: those of powers cannot be told by their derivatives.
    #[must_use]
    pub fn is_continuous(&self) -> bool {
        let plain = |op: &Op| match *op {
            Op::Constant(_) | Op::Extreme(..) => true,
            Op::Unary(op, _) => !matches!(op, Unary::Floor | Unary::Ceil | Unary::Round | Unary::Sign | Unary::Not),
            Op::Binary(op, ..) | Op::WithRight(op, ..) | Op::WithLeft(op, ..) => matches!(
                op,
                Binary::Add
                    | Binary::Sub
                    | Binary::Mul
                    | Binary::Div
                    | Binary::Min
                    | Binary::Max
                    | Binary::Pow
                    | Binary::Hypot
            ),
            Op::Ternary(op, _) | Op::Join(op, ..) => op != Ternary::Select,
            Op::Leaf(..) | Op::Give(..) | Op::Region(..) | Op::Output(..) => false,
        };
        let is_power = |op: &Op| {
            matches!(op, Op::Binary(Binary::Pow, ..) | Op::WithRight(Binary::Pow, ..) | Op::WithLeft(Binary::Pow, ..))
        };
        let passes_over = |op: &Op| {
            matches!(
                op,
                Op::Binary(Binary::Max, ..)
                    | Op::WithRight(Binary::Max, ..)
                    | Op::WithLeft(Binary::Max, ..)
                    | Op::Extreme(Binary::Max, ..)
                    | Op::Ternary(Ternary::Union | Ternary::UnionSmooth, _)
                    | Op::Join(Ternary::Union | Ternary::UnionSmooth, ..)
            )
        };
        let all = &self.operations;
        all.iter().all(plain) && !(all.iter().any(is_power) && all.iter().any(passes_over))
    }

    /// Which of the inputs the value depends on, by position.
    #[must_use]
    pub fn uses_input(&self, input: usize) -> bool {
        let mut used = self.root as usize == input;
        for op in &self.operations {
            op.for_each_operand(|v| used |= v as usize == input);
        }
        used
    }
}
