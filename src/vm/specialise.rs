//! Shortens a program for one box, by the choices that its intervals left: copies what is still read, renumbered. Computes nothing, and
//! allocates nothing but the new program.

use super::choice::Choice;
use super::program::{Op, Program, Value};
use super::slots::SlotScratch;
use crate::number::Ternary;

/// Working storage, kept from one program to the next.
#[derive(Clone, Debug, Default)]
pub(crate) struct Scratch {
    live: Vec<bool>,
    renumbered: Vec<Value>,
    slots: SlotScratch,
}

/// What becomes of an operation.
enum Fate {
    Stays,
    /// Another value takes its place.
    Is(Value),
    /// A number takes its place.
    Number(f64),
}

#[inline(always)]
fn fate(op: &Op, choice: &Choice, lane: usize) -> Fate {
    let bit = |mask: u64| mask >> lane & 1 == 1;
    match (bit(choice.first), bit(choice.second)) {
        (false, false) => Fate::Stays,
        (true, true) => Fate::Number(if bit(choice.holds) { 1.0 } else { 0.0 }),
        (first, _) => match *op {
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
        },
    }
}

impl Scratch {
    /// The program with each operation's choice in the given lane made; `None` if that makes it no shorter.
    pub(crate) fn specialise(&mut self, program: &Program, choices: &[Choice], lane: usize) -> Option<Program> {
        assert_eq!(choices.len(), program.operations.len(), "the choices are those of this program");
        let kept = self.mark(program, choices, lane);
        if kept == program.operations.len() {
            return None;
        }
        let inputs = program.inputs.len();
        self.renumbered.clear();
        self.renumbered.extend(0..inputs as Value);
        let mut operations = Vec::with_capacity(kept);
        for (at, op) in program.operations.iter().enumerate() {
            let next = (inputs + operations.len()) as Value;
            let number = if self.live[inputs + at] {
                match fate(op, &choices[at], lane) {
                    Fate::Is(value) => self.renumbered[value as usize],
                    Fate::Number(number) => {
                        operations.push(Op::Constant(number));
                        next
                    }
                    Fate::Stays => {
                        operations.push(op.renumbered(|v| self.renumbered[v as usize]));
                        next
                    }
                }
            } else {
                next
            };
            self.renumbered.push(number);
        }
        let root = self.renumbered[program.root as usize];
        let mut slots = Vec::with_capacity(inputs + operations.len());
        let slot_count = self.slots.assign(inputs, &operations, &[root], &mut slots);
        Some(Program {
            inputs: program.inputs.clone(),
            leaves: program.leaves.clone(),
            regions: program.regions.clone(),
            operations,
            slots,
            slot_count,
            root,
            demand: program.demand,
        })
    }

    /// Marks what is still read, from the root down; gives the number of operations that stay.
    fn mark(&mut self, program: &Program, choices: &[Choice], lane: usize) -> usize {
        let inputs = program.inputs.len();
        self.live.clear();
        self.live.resize(inputs + program.operations.len(), false);
        self.live[program.root as usize] = true;
        let mut kept = 0;
        for (at, op) in program.operations.iter().enumerate().rev() {
            if !self.live[inputs + at] {
                continue;
            }
            match fate(op, &choices[at], lane) {
                Fate::Is(value) => self.live[value as usize] = true,
                Fate::Number(_) => kept += 1,
                Fate::Stays => {
                    kept += 1;
                    op.for_each_operand(|v| self.live[v as usize] = true);
                }
            }
        }
        kept
    }
}
