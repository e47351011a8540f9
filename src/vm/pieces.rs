//! The smooth pieces of a program: which branch each of its choices takes at a point, and the program that takes those branches everywhere.
//! What `MAX`, `ABS`, `IF` and the set operations put together is taken apart again; never changes a value where the branches are those.

use rustc_hash::FxHashMap;

use super::block::Doubles;
use super::compile::extreme_of;
use super::kernels::{Kind, Store};
use super::program::{Op, Program, Value};
use super::slots::SlotScratch;
use crate::interrupt::Interrupt;
use crate::number::{Binary, Ternary, Unary};

/// Longest program that is taken apart: every value of it is kept for a block of points.
const MOST_OPERATIONS: usize = 1 << 14;

/// What an operation does at a point.
#[derive(Clone, Copy, Debug)]
enum Branch {
    /// The same everywhere.
    Smooth,
    /// Another value is the result.
    Is(Value),
    /// The result is this number for as long as the branch lasts.
    Number(f64),
    /// The operand with the other sign.
    Negated(Value),
    /// `a - turns * b`
    Turned(Value, Value, f64),
}

impl Branch {
    /// What tells it from the other branches of the same operation.
    fn bits(self) -> u64 {
        match self {
            Self::Smooth => 0,
            Self::Is(value) => 1 + u64::from(value),
            Self::Negated(value) => u64::MAX - u64::from(value),
            Self::Number(number) | Self::Turned(_, _, number) => number.to_bits(),
        }
    }
}

/// The branch that an operation takes where the values are `get`.
fn branch(op: &Op, own: f64, get: impl Fn(Value) -> f64) -> Branch {
    let pick = |extreme: Binary, a: f64, b: f64| match extreme {
        Binary::Min => (a <= b) | a.is_nan(),
        _ => (a >= b) | b.is_nan(),
    };
    let either = |first: bool, a: Value, b: Value| Branch::Is(if first { a } else { b });
    match *op {
        Op::Binary(extreme @ (Binary::Min | Binary::Max), a, b) | Op::Extreme(extreme, _, a, b) => {
            either(pick(extreme, get(a), get(b)), a, b)
        }
        Op::WithRight(extreme @ (Binary::Min | Binary::Max), a, number) => {
            if pick(extreme, get(a), number) {
                Branch::Is(a)
            } else {
                Branch::Number(number)
            }
        }
        Op::WithLeft(extreme @ (Binary::Min | Binary::Max), number, b) => {
            if pick(extreme, number, get(b)) {
                Branch::Number(number)
            } else {
                Branch::Is(b)
            }
        }
        // Every R-function is 0 where its min or max is, and smooth elsewhere; with the parameter 1 it is the min or max.
        Op::Join(join @ (Ternary::Union | Ternary::Intersection), a, b, alpha)
            if alpha == 1.0 || own.abs() <= 1e-5 * (get(a).abs() + get(b).abs()) =>
        {
            match extreme_of(join, Some(alpha)) {
                Some(extreme) => either(pick(extreme, get(a), get(b)), a, b),
                None => Branch::Smooth,
            }
        }
        Op::Ternary(Ternary::Select, [condition, a, b]) => {
            let condition = get(condition);
            either((condition != 0.0) & !condition.is_nan(), a, b)
        }
        Op::Unary(Unary::Abs, a) => {
            if get(a) < 0.0 {
                Branch::Negated(a)
            } else {
                Branch::Is(a)
            }
        }
        Op::Binary(Binary::Mod, a, b) => Branch::Turned(a, b, (get(a) / get(b)).floor()),
        Op::Unary(Unary::Floor | Unary::Ceil | Unary::Round | Unary::Sign | Unary::Not, _) => Branch::Number(own),
        Op::Binary(op, ..) | Op::WithRight(op, ..) | Op::WithLeft(op, ..) if is_truth(op) => Branch::Number(own),
        _ => Branch::Smooth,
    }
}

fn is_truth(op: Binary) -> bool {
    use Binary::{And, Equal, Less, LessEqual, NotEqual, Or};
    matches!(op, Less | LessEqual | Equal | NotEqual | And | Or)
}

/// Whether an operation has branches.
fn is_choice(op: &Op) -> bool {
    !matches!(branch(op, 0.0, |_| 0.0), Branch::Smooth)
}

/// Takes programs apart. Keep one per thread.
pub struct Pieces {
    store: Store<Doubles>,
    live: Vec<bool>,
    /// The branches that matter at a point, and what tells them from others.
    branches: Vec<(usize, Branch)>,
    key: Vec<u64>,
    renumbered: Vec<Value>,
    slots: SlotScratch,
}

impl Default for Pieces {
    fn default() -> Self {
        Self::new()
    }
}

impl Pieces {
    /// An evaluator without storage yet.
    #[must_use]
    pub fn new() -> Self {
        let (live, branches, key, renumbered) = Default::default();
        Self { store: Store::new(), live, branches, key, renumbered, slots: SlotScratch::default() }
    }

    /// One whose loops and searches end once the interrupt is set, with pieces that mean nothing.
    #[must_use]
    pub fn heeding(interrupt: &Interrupt) -> Self {
        Self { store: Store::heeding(interrupt), ..Self::new() }
    }

    /// Whether a program has no branches.
    #[must_use]
    pub fn is_smooth(program: &Program) -> bool {
        !program.operations.iter().any(is_choice)
    }

    /// Whether a program has branches, and is short enough to be taken apart.
    #[must_use]
    pub fn has_branches(program: &Program) -> bool {
        program.len() <= MOST_OPERATIONS && !Self::is_smooth(program)
    }

    /// The number of the piece at each of `out.len()` points: `points` has one slice of that length per input of the program. Pieces that
    /// are new are put behind those that `pieces` holds already, which must be of this program. Their values at such a point are
    /// the program's own.
    ///
    /// # Panics
    /// If the number of slices or a length is another.
    pub fn at(&mut self, program: &Program, points: &[&[f64]], pieces: &mut Vec<Program>, out: &mut [usize]) {
        assert_eq!(points.len(), program.inputs().len(), "one slice per input");
        assert!(points.iter().all(|p| p.len() == out.len()), "one coordinate per point");
        // With a slot for each value all of them are there when the program has run.
        let values = program.inputs.len() + program.operations.len();
        let kept = Program { slots: (0..values as u32).collect(), slot_count: values as u32, ..program.clone() };
        self.store.reserve(&kept);
        let mut known: FxHashMap<Vec<u64>, usize> = FxHashMap::default();
        for (block, out) in out.chunks_mut(Doubles::LANES).enumerate() {
            for (input, values) in points.iter().enumerate() {
                let values = &values[block * Doubles::LANES..][..out.len()];
                self.store.input(input).as_mut()[..out.len()].copy_from_slice(values);
            }
            self.store.live = out.len();
            Doubles::run(&kept, &mut self.store, out.len().next_multiple_of(16), &mut ());
            for (lane, piece) in out.iter_mut().enumerate() {
                self.branch_at(&kept, lane);
                *piece = match known.get(&self.key) {
                    Some(&number) => number,
                    None => {
                        let new = self.build(program);
                        let same = |old: &Program| old.root == new.root && old.operations == new.operations;
                        let number = pieces.iter().position(same).unwrap_or_else(|| {
                            pieces.push(new);
                            pieces.len() - 1
                        });
                        known.insert(self.key.clone(), number);
                        number
                    }
                };
            }
        }
    }

    /// Finds the branches that matter at the point of one lane, ascending by operation, and what the result is made of.
    fn branch_at(&mut self, program: &Program, lane: usize) {
        let inputs = program.inputs.len();
        self.live.clear();
        self.live.resize(inputs + program.operations.len(), false);
        self.live[program.root as usize] = true;
        self.branches.clear();
        self.key.clear();
        for (at, op) in program.operations.iter().enumerate().rev() {
            if !self.live[inputs + at] {
                continue;
            }
            let get = |value: Value| self.store.of(program, value).as_ref()[lane];
            let taken = branch(op, get((inputs + at) as Value), get);
            match taken {
                Branch::Smooth => op.for_each_operand(|v| self.live[v as usize] = true),
                Branch::Is(value) | Branch::Negated(value) => self.live[value as usize] = true,
                Branch::Turned(a, b, _) => {
                    self.live[a as usize] = true;
                    self.live[b as usize] = true;
                }
                Branch::Number(_) => {}
            }
            if !matches!(taken, Branch::Smooth) {
                self.branches.push((at, taken));
                self.key.extend([at as u64, taken.bits()]);
            }
        }
        self.branches.reverse();
    }

    /// The program that takes these branches everywhere.
    fn build(&mut self, program: &Program) -> Program {
        let inputs = program.inputs.len();
        self.renumbered.clear();
        self.renumbered.extend(0..inputs as Value);
        let mut operations = Vec::new();
        let mut branches = self.branches.iter().peekable();
        for (at, op) in program.operations.iter().enumerate() {
            let next = |operations: &Vec<Op>| (inputs + operations.len()) as Value;
            let mut number = next(&operations);
            if self.live[inputs + at] {
                let new = |v: Value| self.renumbered[v as usize];
                match branches.next_if(|(chosen, _)| *chosen == at).map_or(Branch::Smooth, |(_, taken)| *taken) {
                    Branch::Is(value) => number = new(value),
                    Branch::Number(value) => operations.push(Op::Constant(value)),
                    Branch::Negated(value) => operations.push(Op::Unary(Unary::Neg, new(value))),
                    Branch::Turned(a, b, turns) => {
                        operations.push(Op::WithLeft(Binary::Mul, turns, new(b)));
                        number = next(&operations);
                        operations.push(Op::Binary(Binary::Sub, new(a), number - 1));
                    }
                    Branch::Smooth => operations.push(op.renumbered(new)),
                }
            }
            self.renumbered.push(number);
        }
        let root = self.renumbered[program.root as usize];
        let mut slots = Vec::with_capacity(inputs + operations.len());
        let slot_count = self.slots.assign(inputs, &operations, &[root], &mut slots);
        Program { operations, slots, slot_count, root, ..program.clone() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::field::{Coordinate, Graph};
    use crate::limits::Limits;
    use crate::number::Algebra;
    use crate::vm::{Demand, Points};

    #[test]
    fn a_piece_goes_on_beyond_its_branch() {
        let mut graph = Graph::new();
        let x = graph.coordinate(Coordinate(1));
        let size = graph.unary(Unary::Abs, x);
        let one = graph.constant(1.0);
        let step = graph.binary(Binary::Mod, x, one);
        let root = graph.binary(Binary::Min, size, step);
        let program = Program::compile(&graph, root, &[Coordinate(1)], Demand::Value, &Limits::default())
            .expect("few operations");
        assert!(Pieces::has_branches(&program));
        let at = [-0.25, 0.25, 1.25, 1.5, -0.75];
        let (mut pieces, mut which) = (Vec::new(), [0; 5]);
        Pieces::new().at(&program, &[&at], &mut pieces, &mut which);
        // |x| at the first (as -x), x at 0.25 (by either branch the same), x - 1 twice, x + 1.
        assert_eq!(which[2], which[3]);
        assert_ne!(which[0], which[1]);
        for (&x, &piece) in at.iter().zip(&which) {
            let (mut own, mut whole) = ([0.0], [0.0]);
            Points::<f64>::new().eval(&pieces[piece], &[&[x]], &mut own);
            Points::<f64>::new().eval(&program, &[&[x]], &mut whole);
            assert_eq!(own, whole, "at {x}");
            assert!(!Pieces::has_branches(&pieces[piece]));
        }
        let mut beyond = [0.0];
        Points::<f64>::new().eval(&pieces[which[2]], &[&[7.0]], &mut beyond);
        assert_eq!(beyond, [6.0]);
    }
}
