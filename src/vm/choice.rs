//! Which operands can never matter in a box, judged by their intervals: what `specialise` shortens by. Free of branches within a loop
//! over boxes. Never drops an operand that may be undefined where that would show.

use super::compile::extreme_of;
use super::interval::{IntervalBlock, LANES, Ranges};
use super::kernels::{Kind, Operands};
use super::program::{Op, Side};
use crate::number::{Binary, Interval, Ternary, Unary};

/// What is known of one operation in each box, a bit per lane: that only its first operand matters, or only its second; of a truth, that
/// it is certain, or certainly not so. Never both.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Choice {
    pub(crate) first: u64,
    pub(crate) second: u64,
}

/// The choices of a program's last evaluation.
#[derive(Clone, Debug, Default)]
pub(crate) struct Choices {
    pub(crate) of: Vec<Choice>,
    lanes: usize,
}

impl Choices {
    /// Makes room for an evaluation.
    pub(crate) fn begin(&mut self, operations: usize, lanes: usize) {
        self.of.clear();
        self.of.resize(operations, Choice::default());
        self.lanes = lanes;
    }
}

/// Whether the first operand is enough, whether the second is; at most one of the two.
type Enough = (bool, bool);

/// The choices of all lanes. A macro for the sake of the same loops as in the kernels.
macro_rules! pick {
    ($lanes:ident, $i:ident => $enough:expr) => {{
        let mut choice = Choice::default();
        for $i in 0..$lanes.min(LANES) {
            let (first, second): Enough = $enough;
            choice.first |= u64::from(first) << $i;
            choice.second |= u64::from(second) << $i;
        }
        choice
    }};
}

/// Notes what the operands, and of truths the result, say about an operation.
#[inline(always)]
pub(crate) fn watch(
    choices: &mut Choices,
    at: usize,
    op: &Op,
    operands: &Operands<'_, Ranges>,
    result: &IntervalBlock,
) {
    const MIN: Binary = Binary::Min;
    const MAX: Binary = Binary::Max;
    let lanes = choices.lanes;
    let get = Ranges::get;
    choices.of[at] = match *op {
        Op::Binary(op @ (MIN | MAX), a, b) => {
            let (a, b) = (operands.of(a), operands.of(b));
            match op {
                MIN => pick!(lanes, i => by_value(MIN, get(a, i), get(b, i))),
                _ => pick!(lanes, i => by_value(MAX, get(a, i), get(b, i))),
            }
        }
        Op::WithRight(op @ (MIN | MAX), a, number) => {
            let (a, b) = (operands.of(a), Interval::point(number));
            match op {
                MIN => pick!(lanes, i => by_value(MIN, get(a, i), b)),
                _ => pick!(lanes, i => by_value(MAX, get(a, i), b)),
            }
        }
        Op::WithLeft(op @ (MIN | MAX), number, b) => {
            let (a, b) = (Interval::point(number), operands.of(b));
            match op {
                MIN => pick!(lanes, i => by_value(MIN, a, get(b, i))),
                _ => pick!(lanes, i => by_value(MAX, a, get(b, i))),
            }
        }
        Op::Extreme(op, side, a, b) => {
            let (a, b) = (operands.of(a), operands.of(b));
            match (op, side) {
                (MAX, Side::Inside) => pick!(lanes, i => union_inside(get(a, i), get(b, i))),
                (_, Side::Inside) => pick!(lanes, i => intersection_inside(get(a, i), get(b, i))),
                (MAX, Side::Upper) => pick!(lanes, i => by_class::<true>(MAX, get(a, i), get(b, i))),
                (_, Side::Upper) => pick!(lanes, i => by_class::<true>(MIN, get(a, i), get(b, i))),
                (MAX, Side::Lower) => pick!(lanes, i => by_class::<false>(MAX, get(a, i), get(b, i))),
                (_, Side::Lower) => pick!(lanes, i => by_class::<false>(MIN, get(a, i), get(b, i))),
                (MAX, Side::Both) => pick!(lanes, i => by_value(MAX, get(a, i), get(b, i))),
                (_, Side::Both) => pick!(lanes, i => by_value(MIN, get(a, i), get(b, i))),
            }
        }
        Op::Ternary(Ternary::Select, [condition, ..]) => {
            let condition = operands.of(condition);
            pick!(lanes, i => certainty(get(condition, i)))
        }
        Op::Join(op, a, b, number) if extreme_of(op, Some(number)) == Some(MAX) => {
            let (a, b) = (operands.of(a), operands.of(b));
            // An R-union with an operand that is nowhere defined is the other one.
            pick!(lanes, i => (get(b, i).is_empty(), get(a, i).is_empty() & !get(b, i).is_empty()))
        }
        ref op if is_truth(op) => pick!(lanes, i => certainty(get(result, i))),
        _ => return,
    };
}

/// Operations whose value is 1 or 0.
#[inline(always)]
pub(crate) fn is_truth(op: &Op) -> bool {
    use Binary::{And, Equal, Less, LessEqual, NotEqual, Or};
    match op {
        Op::Unary(Unary::Not, _) => true,
        Op::Binary(op, ..) | Op::WithRight(op, ..) | Op::WithLeft(op, ..) => {
            matches!(op, Less | LessEqual | Equal | NotEqual | And | Or)
        }
        _ => false,
    }
}

/// Whether a condition is certainly true (not 0, defined), and whether certainly false (0 or undefined).
#[inline(always)]
fn certainty(a: Interval) -> Enough {
    let nonzero = (a.lo > 0.0) | (a.hi < 0.0);
    (nonzero & !a.undefined & !a.is_empty(), a.is_empty() | ((a.lo == 0.0) & (a.hi == 0.0)))
}

/// The operand that is the value of a min or max all over the box, to the bit. The bounds must differ: at a tie of two zeros their
/// signs could.
#[inline(always)]
fn by_value(op: Binary, a: Interval, b: Interval) -> Enough {
    let (first_less, second_less) = (a.hi < b.lo, b.hi < a.lo);
    // An undefined operand undoes a min; a max leaves it aside, so that it must not be the one that is kept.
    if op == Binary::Min {
        let first = first_less & !b.undefined;
        (first, second_less & !a.undefined & !first)
    } else {
        let first = second_less & !a.undefined;
        (first, first_less & !b.undefined & !first)
    }
}

/// Inside where one is: an operand that is outside throughout changes nothing, one that is inside throughout decides.
#[inline(always)]
fn union_inside(a: Interval, b: Interval) -> Enough {
    let enough = (a.is_positive() | b.is_negative(), b.is_positive() | a.is_negative());
    preferred(enough, by_value(Binary::Max, a, b))
}

/// Inside where both are: an operand that is outside throughout decides, one that is inside throughout changes nothing.
#[inline(always)]
fn intersection_inside(a: Interval, b: Interval) -> Enough {
    let enough = (a.is_negative() | b.is_positive(), b.is_negative() | a.is_positive());
    preferred(enough, by_value(Binary::Min, a, b))
}

/// The operand whose class is that of the min or max: at least 0, less, or undefined; if not `UPPER`, positive, at most 0, or undefined.
#[inline(always)]
fn by_class<const UPPER: bool>(op: Binary, a: Interval, b: Interval) -> Enough {
    preferred((keeps_class::<UPPER>(op, a, b), keeps_class::<UPPER>(op, b, a)), by_value(op, a, b))
}

#[inline(always)]
fn keeps_class<const UPPER: bool>(op: Binary, a: Interval, b: Interval) -> bool {
    let top = |x: Interval| if UPPER { x.is_positive() } else { (x.lo > 0.0) & !x.undefined };
    let bottom = |x: Interval| if UPPER { x.hi < 0.0 } else { x.hi <= 0.0 };
    if op == Binary::Max {
        // The other one may be undefined and is left aside then; but this one must stand where the other is defined.
        top(a) | (bottom(b) & !a.undefined) | b.is_empty()
    } else {
        a.is_empty() | (bottom(a) & !a.undefined & !b.undefined) | top(b)
    }
}

/// Where both operands would do, or neither: what the values say.
#[inline(always)]
fn preferred((first, second): Enough, by_value: Enough) -> Enough {
    let tie = first == second;
    let first_of_tie = (first & !by_value.1) | by_value.0;
    ((tie & first_of_tie) | (!tie & first), (tie & by_value.1) | (!tie & second))
}
