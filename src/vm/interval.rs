//! Ranges over boxes, up to 64 boxes at a time, and which operands can never matter in each: what `specialise` shortens by.

use super::compile::extreme_of;
use super::kernels::{Kind, Operands, Store, ranges};
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

/// The kind of number with bounds.
pub(crate) struct Ranges;

impl Kind for Ranges {
    type Item = Interval;
    type Block = IntervalBlock;
    type Watch = Choices;
    const LANES: usize = LANES;

    fn run(program: &Program, store: &mut Store<Self>, lanes: usize, watch: &mut Choices) {
        ranges(program, store, lanes, watch);
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
            Op::Join(op, a, b, number) if extreme_of(op, Some(number)) == Some(Binary::Max) => {
                let (a, b) = (operands.of(a), operands.of(b));
                pick(lanes, |i| by_definition(Self::get(a, i), Self::get(b, i)))
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
    let (first_less, second_less) = (a.hi < b.lo, b.hi < a.lo);
    let (first, second) = if op == Binary::Min { (first_less, second_less) } else { (second_less, first_less) };
    // An undefined operand undoes a min; a max leaves it aside, so that it must not be the one that is kept.
    let (a_suffers, b_suffers) =
        if op == Binary::Min { (b.undefined, a.undefined) } else { (a.undefined, b.undefined) };
    if first && !a_suffers {
        Pick::First
    } else if second && !b_suffers {
        Pick::Second
    } else {
        Pick::Neither
    }
}

/// An R-union with an operand that is nowhere defined is the other one.
#[inline(always)]
fn by_definition(a: Interval, b: Interval) -> Pick {
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
    match (side, op) {
        (Side::Inside, Binary::Max) => {
            preferred(a.is_positive() || b.is_negative(), b.is_positive() || a.is_negative(), op, a, b)
        }
        (Side::Inside, _) => {
            preferred(a.is_negative() || b.is_positive(), b.is_negative() || a.is_positive(), op, a, b)
        }
        (Side::Upper, _) => by_class(op, a, b, |x| x.is_positive(), |x| x.hi < 0.0),
        (Side::Lower, _) => by_class(op, a, b, positive, |x| x.hi <= 0.0),
        (Side::Both, _) => by_value(op, a, b),
    }
}

/// The operand whose class is that of the min or max, the classes being `top` (and defined), `bottom` and undefined.
#[inline(always)]
fn by_class(op: Binary, a: Interval, b: Interval, top: fn(Interval) -> bool, bottom: fn(Interval) -> bool) -> Pick {
    let keeps = |a: Interval, b: Interval| {
        if op == Binary::Max {
            // The other one may be undefined and is left aside then; but this one must stand where the other is defined.
            top(a) || (bottom(b) && !a.undefined) || b.is_empty()
        } else {
            a.is_empty() || (bottom(a) && !a.undefined && !b.undefined) || top(b)
        }
    };
    preferred(keeps(a, b), keeps(b, a), op, a, b)
}

/// Positive and defined throughout.
#[inline(always)]
fn positive(a: Interval) -> bool {
    a.lo > 0.0 && !a.undefined
}

/// Where both operands would do, or neither: what the values say.
#[inline(always)]
fn preferred(first: bool, second: bool, op: Binary, a: Interval, b: Interval) -> Pick {
    match (first, second) {
        (true, false) => Pick::First,
        (false, true) => Pick::Second,
        (true, true) if by_value(op, a, b) == Pick::Second => Pick::Second,
        (true, true) => Pick::First,
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
}
