//! Ranges over boxes, up to 64 boxes at a time, and which operands can never matter in each: what `specialise` shortens by.

use super::kernels::{Kind, Operands, Store, run};
use super::program::{Op, Program, Side};
use super::specialise::Scratch;
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

/// What is known of one operation in each box, a bit per lane: that only its first operand matters, only its second, or (both bits)
/// that it is a truth whose value is known.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Choice {
    pub(crate) first: u64,
    pub(crate) second: u64,
    pub(crate) holds: u64,
}

/// The choices of a program's last evaluation.
#[derive(Clone, Debug, Default)]
pub(crate) struct Choices {
    pub(crate) of: Vec<Choice>,
    lanes: usize,
}

struct Ranges;

impl Kind for Ranges {
    type Item = Interval;
    type Block = IntervalBlock;
    type Watch = Choices;
    const LANES: usize = LANES;

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

    #[inline(always)]
    fn watch(choices: &mut Choices, at: usize, op: &Op, operands: &Operands<'_, Self>, result: &IntervalBlock) {
        let lanes = choices.lanes;
        let choice = match *op {
            Op::Binary(op @ (Binary::Min | Binary::Max), a, b) => {
                let (a, b) = (operands.of(a), operands.of(b));
                pick(lanes, |i| by_value(op, Self::get(a, i), Self::get(b, i)))
            }
            Op::WithRight(op @ (Binary::Min | Binary::Max), a, b) => {
                let (a, b) = (operands.of(a), Interval::point(b));
                pick(lanes, |i| by_value(op, Self::get(a, i), b))
            }
            Op::WithLeft(op @ (Binary::Min | Binary::Max), a, b) => {
                let (a, b) = (Interval::point(a), operands.of(b));
                pick(lanes, |i| by_value(op, a, Self::get(b, i)))
            }
            Op::Extreme(op, side, a, b) => {
                let (a, b) = (operands.of(a), operands.of(b));
                pick(lanes, |i| by_sign(op, side, Self::get(a, i), Self::get(b, i)))
            }
            Op::Ternary(Ternary::Select, [condition, ..]) => {
                let condition = operands.of(condition);
                pick(lanes, |i| match certainty(Self::get(condition, i)) {
                    Some(true) => Pick::First,
                    Some(false) => Pick::Second,
                    None => Pick::Neither,
                })
            }
            Op::Ternary(Ternary::Union, [a, b, _]) | Op::Join(Ternary::Union | Ternary::UnionSmooth, a, b, _) => {
                // The parameter of `Join` is a number; where it varies it may be undefined itself, so both stay.
                if matches!(op, Op::Ternary(..)) {
                    return;
                }
                let (a, b) = (operands.of(a), operands.of(b));
                pick(lanes, |i| by_definition(Self::get(a, i), Self::get(b, i), Self::get(result, i)))
            }
            ref op if is_truth(op) => pick(lanes, |i| match certainty(Self::get(result, i)) {
                Some(holds) => Pick::Known(holds),
                None => Pick::Neither,
            }),
            _ => return,
        };
        choices.of[at] = choice;
    }
}

/// What is known of one operation in one box.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Pick {
    Neither,
    First,
    Second,
    Known(bool),
}

#[inline(always)]
fn pick(lanes: usize, f: impl Fn(usize) -> Pick) -> Choice {
    let mut choice = Choice::default();
    for lane in 0..lanes.min(LANES) {
        let pick = f(lane);
        let known = matches!(pick, Pick::Known(_));
        choice.first |= u64::from(known | (pick == Pick::First)) << lane;
        choice.second |= u64::from(known | (pick == Pick::Second)) << lane;
        choice.holds |= u64::from(pick == Pick::Known(true)) << lane;
    }
    choice
}

/// Operations whose value is 1 or 0 and that are not decided by one operand alone.
fn is_truth(op: &Op) -> bool {
    use Binary::{And, Equal, Less, LessEqual, NotEqual, Or};
    match op {
        Op::Unary(Unary::Not, _) => true,
        Op::Binary(op, ..) | Op::WithRight(op, ..) | Op::WithLeft(op, ..) => {
            matches!(op, Less | LessEqual | Equal | NotEqual | And | Or)
        }
        _ => false,
    }
}

/// Whether a condition is certainly true (not 0, defined) or certainly false (0 or undefined); `None` if it depends.
#[inline(always)]
fn certainty(a: Interval) -> Option<bool> {
    if !a.undefined && (a.lo > 0.0 || a.hi < 0.0) {
        Some(true)
    } else if a.is_empty() || (a.lo == 0.0 && a.hi == 0.0) {
        Some(false)
    } else {
        None
    }
}

/// The operand that is the value of a min or max all over the box, to the bit. The bounds must differ: at a tie of two zeros their
/// signs could.
#[inline(always)]
fn by_value(op: Binary, a: Interval, b: Interval) -> Pick {
    let (low, high, low_pick, high_pick) =
        if op == Binary::Min { (a, b, Pick::First, Pick::Second) } else { (b, a, Pick::Second, Pick::First) };
    // Min takes the low one; an undefined operand undoes it. Max takes the high one, and leaves an undefined one aside.
    let below = low.hi < high.lo;
    let above = high.hi < low.lo;
    if op == Binary::Min {
        if below && !high.undefined {
            return low_pick;
        }
        if above && !low.undefined {
            return high_pick;
        }
    } else {
        if below && !high.undefined {
            return high_pick;
        }
        if above && !low.undefined {
            return low_pick;
        }
    }
    Pick::Neither
}

/// An R-union with an operand that is nowhere defined is the other one.
#[inline(always)]
fn by_definition(a: Interval, b: Interval, _result: Interval) -> Pick {
    if b.is_empty() {
        Pick::First
    } else if a.is_empty() {
        Pick::Second
    } else {
        Pick::Neither
    }
}

/// The operand that alone decides the sign of a min or max all over the box.
#[inline(always)]
fn by_sign(op: Binary, side: Side, a: Interval, b: Interval) -> Pick {
    let picks = |side| if op == Binary::Max { union_sign(side, a, b) } else { intersection_sign(side, a, b) };
    match side {
        Side::Inside | Side::Complement => picks(side),
        Side::Both => {
            let inside = picks(Side::Inside);
            if inside == picks(Side::Complement) { inside } else { Pick::Neither }
        }
    }
}

#[inline(always)]
fn union_sign(side: Side, a: Interval, b: Interval) -> Pick {
    let (first, second) = if side == Side::Inside {
        // Inside where one is: an operand that is outside throughout changes nothing, one that is inside throughout decides.
        (a.is_positive() || b.is_negative(), b.is_positive() || a.is_negative())
    } else {
        // At most 0 where both are; an undefined operand leaves the other one, so it must not be what is left.
        (positive(a) || (b.hi <= 0.0 && !a.undefined) || b.is_empty(), positive(b) || (a.hi <= 0.0 && !b.undefined) || a.is_empty())
    };
    preferred(first, second, a, b, Binary::Max)
}

#[inline(always)]
fn intersection_sign(side: Side, a: Interval, b: Interval) -> Pick {
    let (first, second) = if side == Side::Inside {
        // Inside where both are: an operand that is outside throughout decides, one that is inside throughout changes nothing.
        (a.is_negative() || b.is_positive(), b.is_negative() || a.is_positive())
    } else {
        // At most 0 where one is and both are defined.
        let at_most = |x: Interval, y: Interval| x.hi <= 0.0 && !x.undefined && !y.undefined;
        (a.is_empty() || at_most(a, b) || positive(b), b.is_empty() || at_most(b, a) || positive(a))
    };
    preferred(first, second, a, b, Binary::Min)
}

/// Positive and defined throughout.
#[inline(always)]
fn positive(a: Interval) -> bool {
    a.lo > 0.0 && !a.undefined
}

/// Of two operands of which each would do, or neither: what the values say.
#[inline(always)]
fn preferred(first: bool, second: bool, a: Interval, b: Interval, op: Binary) -> Pick {
    match (first, second) {
        (true, false) => Pick::First,
        (false, true) => Pick::Second,
        (true, true) => match by_value(op, a, b) {
            Pick::Neither => Pick::First,
            pick => pick,
        },
        (false, false) => by_value(op, a, b),
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
        Self { store: Store::new(), choices: Choices::default(), scratch: Scratch::default() }
    }

    /// Bounds of the values over `out.len()` boxes, at most [`LANES`]: `boxes` has one slice of that length per input of the program.
    ///
    /// # Panics
    /// If the number of slices or a length is another, or above [`LANES`].
    pub fn eval(&mut self, program: &Program, boxes: &[&[Interval]], out: &mut [Interval]) {
        assert_eq!(boxes.len(), program.inputs().len(), "one slice per input");
        assert!(boxes.iter().all(|b| b.len() == out.len()) && out.len() <= LANES, "one interval per box, 64 at most");
        self.store.reserve(program);
        self.choices.of.clear();
        self.choices.of.resize(program.operations.len(), Choice::default());
        self.choices.lanes = out.len();
        for (input, intervals) in boxes.iter().enumerate() {
            let block = self.store.input(input);
            intervals.iter().enumerate().for_each(|(lane, interval)| Ranges::set(block, lane, *interval));
        }
        run::<Ranges>(program, &mut self.store, out.len(), &mut self.choices);
        let result = self.store.result(program);
        out.iter_mut().enumerate().for_each(|(lane, interval)| *interval = Ranges::get(result, lane));
    }

    /// The program that is right inside the box of one lane of the last [`Boxes::eval`], which must have been of this program: same
    /// values under [`super::Demand::Value`], same signs under [`super::Demand::Sign`]. `None` if no operation falls away.
    #[must_use]
    pub fn specialise(&mut self, program: &Program, lane: usize) -> Option<Program> {
        self.scratch.specialise(program, &self.choices.of, lane)
    }
}
