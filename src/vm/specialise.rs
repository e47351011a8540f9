//! Shortens a program for one box, by the choices that its intervals left: copies what is still read, renumbered. Computes nothing, and
//! allocates nothing once it has seen its largest program.
//!
//! One pass from the root down marks what each of up to 64 boxes still reads, a bit per box; the marks are then turned, so that the
//! program of one box is copied in time that goes with what stays of it, however long the whole is.

use std::sync::Arc;

use super::choice::{Choice, is_truth};
use super::program::{Op, Program, Value};
use crate::number::Ternary;

/// Operations whose marks are turned at a time, and most boxes.
const GROUP: usize = 64;

/// What the boxes of an evaluation still read.
#[derive(Clone, Debug, Default)]
pub(crate) struct Marks {
    /// By value, inputs first: a bit for each box that reads it.
    readers: Vec<u64>,
    /// For each box, a bit for each operation: those of all boxes for the first 64 operations, then for the next.
    live: Vec<[u64; GROUP]>,
    /// The boxes for which an operation falls away.
    shorter: u64,
}

/// Working storage for copies.
#[derive(Clone, Debug, Default)]
pub(crate) struct Writer {
    renumbered: Vec<Value>,
    /// By value of the copy, the operation that reads it last.
    last_use: Vec<u32>,
    free: Vec<u32>,
}

/// Read by no operation.
const NEVER: u32 = u32::MAX;

/// What `specialise` works with, kept from one program to the next.
#[derive(Clone, Debug, Default)]
pub(crate) struct Scratch {
    marks: Option<Marks>,
    spare: Marks,
    writer: Writer,
    /// Where a program is written before its length is known.
    shorter: Option<Program>,
}

/// What becomes of an operation.
enum Fate {
    Stays,
    /// Another value takes its place.
    Is(Value),
    /// A number takes its place.
    Number(f64),
}

/// For one box: whether the first operand is enough, or the second; of a truth, whether it is certain, or certainly not so.
#[inline(always)]
fn fate(op: &Op, first: bool, second: bool) -> Fate {
    if !(first | second) {
        return Fate::Stays;
    }
    match *op {
        ref op if is_truth(op) => Fate::Number(if first { 1.0 } else { 0.0 }),
        Op::Binary(_, a, b) | Op::Extreme(_, _, a, b) | Op::Join(_, a, b, _) => Fate::Is(if first { a } else { b }),
        Op::Ternary(Ternary::Select, [_, a, b]) => Fate::Is(if first { a } else { b }),
        Op::WithRight(_, a, number) => {
            if first {
                Fate::Is(a)
            } else {
                Fate::Number(number)
            }
        }
        Op::WithLeft(_, number, b) => {
            if first {
                Fate::Number(number)
            } else {
                Fate::Is(b)
            }
        }
        _ => Fate::Stays,
    }
}

impl Marks {
    /// Marks what each box still reads, from the root down.
    fn make(&mut self, program: &Program, choices: &[Choice]) {
        assert_eq!(choices.len(), program.operations.len(), "the choices are those of this program");
        let (inputs, count) = (program.inputs.len(), choices.len());
        self.readers.clear();
        self.readers.resize(inputs + count, 0);
        self.readers[program.root as usize] = u64::MAX;
        self.live.clear();
        self.live.resize(count.div_ceil(GROUP), [0; GROUP]);
        let (mut aliases, mut everywhere) = (0, u64::MAX);
        for at in (0..count).rev() {
            let live = self.readers[inputs + at];
            everywhere &= live;
            if live == 0 {
                continue;
            }
            let Choice { first, second } = choices[at];
            aliases |= mark(&mut self.readers, &program.operations[at], live, first & live, second & live);
        }
        for (group, live) in self.live.iter_mut().enumerate() {
            let readers = &self.readers[inputs + group * GROUP..];
            let size = readers.len().min(GROUP);
            live[..size].copy_from_slice(&readers[..size]);
            turn(live);
        }
        self.shorter = aliases | !everywhere;
    }

    /// Writes the program with each operation's choice in the given box made; whether that makes it shorter. If not, what was
    /// written is of no use.
    pub(crate) fn write(
        &self,
        (program, choices): (&Program, &[Choice]),
        lane: usize,
        writer: &mut Writer,
        out: &mut Program,
    ) -> bool {
        if self.shorter >> lane & 1 == 0 {
            return false;
        }
        let inputs = program.inputs.len();
        let Writer { renumbered, last_use, .. } = &mut *writer;
        for scratch in [&mut *renumbered, &mut *last_use] {
            if scratch.len() < inputs + choices.len() {
                scratch.resize(inputs + choices.len(), 0);
            }
        }
        for input in 0..inputs {
            (renumbered[input], last_use[input]) = (input as Value, NEVER);
        }
        out.operations.clear();
        for (group, live) in self.live.iter().enumerate() {
            let mut rest = live[lane];
            while rest != 0 {
                let at = group * GROUP + rest.trailing_zeros() as usize;
                rest &= rest - 1;
                let (op, choice) = (&program.operations[at], choices[at]);
                let place = out.operations.len();
                let next = (inputs + place) as Value;
                let number = match fate(op, choice.first >> lane & 1 == 1, choice.second >> lane & 1 == 1) {
                    Fate::Is(value) => renumbered[value as usize],
                    Fate::Number(number) => {
                        out.operations.push(Op::Constant(number));
                        next
                    }
                    Fate::Stays => {
                        out.operations.push(op.renumbered(|v| {
                            let value = renumbered[v as usize];
                            last_use[value as usize] = place as u32;
                            value
                        }));
                        next
                    }
                };
                renumbered[inputs + at] = number;
                if number == next {
                    last_use[next as usize] = NEVER;
                }
            }
        }
        out.root = renumbered[program.root as usize];
        writer.assign_slots(inputs, out);
        out.take_surroundings(program);
        out.operations.len() < choices.len()
    }
}

impl Writer {
    /// The slots of a copy, as [`super::slots`] gives them: a result may take the slot of an operand that is read there for the last time.
    fn assign_slots(&mut self, inputs: usize, out: &mut Program) {
        let Self { last_use, free, .. } = self;
        last_use[out.root as usize] = NEVER;
        free.clear();
        out.slots.clear();
        out.slots.extend(0..inputs as u32);
        out.slot_count = inputs as u32;
        for (at, op) in (0_u32..).zip(&out.operations) {
            op.for_each_operand(|v| {
                if last_use[v as usize] == at && v as usize >= inputs {
                    free.push(out.slots[v as usize]);
                    // An operand that is read twice by one operation is given back once.
                    last_use[v as usize] = NEVER;
                }
            });
            out.slots.push(free.pop().unwrap_or_else(|| {
                out.slot_count += 1;
                out.slot_count - 1
            }));
        }
    }
}

/// Marks what one operation reads, for the boxes that read it (`live`), those of them where its first operand is enough and those where
/// its second one is; gives the boxes in which another value takes its place.
#[inline(always)]
fn mark(readers: &mut [u64], op: &Op, live: u64, first: u64, second: u64) -> u64 {
    let stays = live & !(first | second);
    match *op {
        ref op if (first | second) != 0 && is_truth(op) => {
            op.for_each_operand(|v| readers[v as usize] |= stays);
            0
        }
        Op::Binary(_, a, b) | Op::Extreme(_, _, a, b) | Op::Join(_, a, b, _) => {
            readers[a as usize] |= stays | first;
            readers[b as usize] |= stays | second;
            first | second
        }
        Op::Ternary(Ternary::Select, [condition, a, b]) => {
            readers[condition as usize] |= stays;
            readers[a as usize] |= stays | first;
            readers[b as usize] |= stays | second;
            first | second
        }
        Op::WithRight(_, a, _) => {
            readers[a as usize] |= stays | first;
            first
        }
        Op::WithLeft(_, _, b) => {
            readers[b as usize] |= stays | second;
            second
        }
        ref op => {
            op.for_each_operand(|v| readers[v as usize] |= live);
            0
        }
    }
}

/// Turns a square of bits: bit `i` of word `k` becomes bit `k` of word `i`.
fn turn(bits: &mut [u64; GROUP]) {
    let mut mask = 0x0000_0000_ffff_ffff_u64;
    let mut step = 32;
    while step != 0 {
        for from in (0..GROUP).step_by(2 * step) {
            for k in from..from + step {
                let swapped = (bits[k] >> step ^ bits[k + step]) & mask;
                bits[k] ^= swapped << step;
                bits[k + step] ^= swapped;
            }
        }
        step /= 2;
        mask ^= mask << step;
    }
}

impl Scratch {
    /// Tells that the choices have changed.
    pub(crate) fn forget(&mut self) {
        if let Some(marks) = self.marks.take() {
            self.spare = marks;
        }
    }

    /// What the boxes of the last evaluation still read.
    pub(crate) fn marks(&mut self, program: &Program, choices: &[Choice]) -> &Marks {
        let spare = &mut self.spare;
        self.marks.get_or_insert_with(|| {
            let mut marks = std::mem::take(spare);
            marks.make(program, choices);
            marks
        })
    }

    /// [`Marks::write`] for programs that are done with before the next is written.
    pub(crate) fn specialise_into(
        &mut self,
        program: &Program,
        choices: &[Choice],
        lane: usize,
        out: &mut Program,
    ) -> bool {
        self.marks(program, choices);
        let Self { marks: Some(marks), writer, .. } = self else { return false };
        marks.write((program, choices), lane, writer, out)
    }

    /// The program with each operation's choice in the given box made; `None` if that makes it no shorter.
    pub(crate) fn specialise(&mut self, program: &Program, choices: &[Choice], lane: usize) -> Option<Program> {
        let mut out = self.shorter.take().unwrap_or_else(|| program.nothing());
        let shorter = self.specialise_into(program, choices, lane, &mut out).then(|| out.clone());
        self.shorter = Some(out);
        shorter
    }
}

impl Program {
    /// Room for a program that is to be written.
    pub(crate) fn nothing(&self) -> Self {
        Self {
            inputs: self.inputs.clone(),
            leaves: self.leaves.clone(),
            regions: self.regions.clone(),
            operations: Vec::new(),
            slots: Vec::new(),
            slot_count: 0,
            root: 0,
            demand: self.demand,
        }
    }

    /// Takes over what specialising does not change. Counts of shared things are left alone as far as can be: threads would take turns
    /// at them.
    fn take_surroundings(&mut self, other: &Self) {
        if !Arc::ptr_eq(&self.inputs, &other.inputs) {
            self.inputs = other.inputs.clone();
        }
        if !Arc::ptr_eq(&self.leaves, &other.leaves) {
            self.leaves = other.leaves.clone();
        }
        if !Arc::ptr_eq(&self.regions, &other.regions) {
            self.regions = other.regions.clone();
        }
        self.demand = other.demand;
    }
}

#[cfg(test)]
mod tests {
    use super::{GROUP, turn};

    #[test]
    fn turning_swaps_rows_and_columns() {
        let mut state = 1_u64;
        let bits: [u64; GROUP] = std::array::from_fn(|_| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            state ^ state >> 29
        });
        let mut turned = bits;
        turn(&mut turned);
        for (i, row) in bits.iter().enumerate() {
            assert!((0..GROUP).all(|k| row >> k & 1 == turned[k] >> i & 1));
        }
    }
}
