//! Takes a program apart by the axes that move each operation. Computes nothing; allocates only for larger programs than before.

use super::super::compile::has_number_form;
use super::super::program::{Op, Program, Value};
use crate::number::{Binary, Unary};

/// Most inputs of a program on a lattice.
pub(super) const AXES: usize = 16;

/// Which stage computes a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum When {
    /// Never moved, or by inner axes alone: once. What nothing moves is also computed with the tables.
    Block,
    /// By walked axes alone: over those.
    Table,
    /// By both, but not by the fastest walked axis.
    Plane,
    /// By both.
    Point,
}

/// In the order in which they are laid out: the last two read from tables.
const STAGES: [When; 4] = [When::Block, When::Table, When::Plane, When::Point];

/// A part of a program's operations; operands keep their numbers as values.
#[derive(Debug, Default)]
pub(super) struct Stage {
    pub(super) operations: Vec<Op>,
    /// The slot of each result.
    pub(super) results: Vec<u32>,
    /// Operations whose number is that of a table's slot at each step.
    entries: Vec<(u32, u32)>,
}

impl Stage {
    fn clear(&mut self) {
        self.operations.clear();
        self.results.clear();
        self.entries.clear();
    }

    /// Enters the numbers of a step, by the slot of their table.
    #[inline(always)]
    pub(super) fn enter(&mut self, number: impl Fn(u32) -> f64) {
        for &(at, slot) in &self.entries {
            match &mut self.operations[at as usize] {
                Op::WithRight(_, _, to) | Op::WithLeft(_, to, _) | Op::Constant(to) => *to = number(slot),
                _ => {}
            }
        }
    }
}

/// Where the values of the whole are.
#[derive(Clone, Copy, Debug)]
pub(super) enum Root {
    /// In this slot of the blocks, lane by lane.
    Block(u32),
    /// In this slot of the tables, step by step.
    Table(u32),
}

/// The stages of a program.
#[derive(Debug)]
pub(super) struct Plan {
    pub(super) block: Stage,
    pub(super) table: Stage,
    pub(super) plane: Stage,
    pub(super) point: Stage,
    /// The slot of each value in the blocks.
    pub(super) slots: Vec<u32>,
    /// The slot of each value in the tables.
    pub(super) table_of: Vec<u32>,
    pub(super) root: Root,
    axes: Vec<u32>,
    when: Vec<When>,
    /// The operations of each stage.
    own: [Vec<u32>; 4],
    last: Vec<u32>,
    blocks: Slots,
    tables: Slots,
}

/// Read to the end.
const ALWAYS: u32 = u32::MAX;

/// Slots in use.
#[derive(Debug, Default)]
struct Slots {
    free: Vec<u32>,
    count: u32,
}

impl Slots {
    fn start(&mut self, inputs: usize) {
        self.free.clear();
        self.count = inputs as u32;
    }

    fn take(&mut self) -> u32 {
        self.free.pop().unwrap_or_else(|| {
            self.count += 1;
            self.count - 1
        })
    }
}

impl Default for Plan {
    fn default() -> Self {
        Self {
            block: Stage::default(),
            table: Stage::default(),
            plane: Stage::default(),
            point: Stage::default(),
            slots: Vec::new(),
            table_of: Vec::new(),
            root: Root::Block(0),
            axes: Vec::new(),
            when: Vec::new(),
            own: Default::default(),
            last: Vec::new(),
            blocks: Slots::default(),
            tables: Slots::default(),
        }
    }
}

impl Plan {
    /// Slots of the blocks.
    pub(super) fn block_slots(&self) -> usize {
        self.blocks.count as usize
    }

    /// Slots of the tables.
    pub(super) fn table_slots(&self) -> usize {
        self.tables.count as usize
    }

    /// Takes a program apart whose inputs have so many numbers each, the first `inner` of them in the lanes; `lanes` of them at a time.
    /// `false`, and nothing is done, if that would not save time.
    pub(super) fn make(&mut self, program: &Program, lengths: &[usize], inner: usize, lanes: usize) -> bool {
        self.mark(program, lengths, inner);
        if !self.pays(program, lengths, inner, lanes) {
            return false;
        }
        self.read(program);
        let inputs = program.inputs.len();
        [&mut self.block, &mut self.table, &mut self.plane, &mut self.point].into_iter().for_each(Stage::clear);
        self.blocks.start(inputs);
        self.tables.start(inputs);
        for slots in [&mut self.slots, &mut self.table_of] {
            slots.clear();
            slots.extend(0..inputs as u32);
            slots.resize(inputs + program.operations.len(), 0);
        }
        for stage in STAGES {
            let own = std::mem::take(&mut self.own[stage as usize]);
            for &at in &own {
                let (at, op) = (at as usize, &program.operations[at as usize]);
                if stage == When::Table { self.tabulate(op, at, inputs) } else { self.lay(op, at, inputs, stage) }
            }
            self.own[stage as usize] = own;
        }
        let root = program.root as usize;
        self.root = match self.when[root] {
            When::Table => Root::Table(self.table_of[root]),
            _ => Root::Block(self.slots[root]),
        };
        true
    }

    /// Which axes move each value, and so when it is computed.
    fn mark(&mut self, program: &Program, lengths: &[usize], inner: usize) {
        let inner = (1_u32 << inner) - 1;
        self.axes.clear();
        self.axes.extend(lengths.iter().enumerate().map(|(axis, &length)| u32::from(length > 1) << axis));
        let moving = self.axes.iter().fold(0, |all, axes| all | axes);
        let walked = moving & !inner;
        let fastest = walked & walked.wrapping_neg();
        let when = |axes: u32| match (axes & inner != 0, axes & walked != 0) {
            (_, false) => When::Block,
            (false, true) => When::Table,
            (true, true) if axes & fastest == 0 => When::Plane,
            (true, true) => When::Point,
        };
        self.when.clear();
        self.when.extend(self.axes.iter().map(|&axes| when(axes)));
        self.own.iter_mut().for_each(Vec::clear);
        for (at, op) in (0_u32..).zip(&program.operations) {
            let mut axes = 0;
            op.for_each_operand(|v| axes |= self.axes[v as usize]);
            let when = when(axes);
            self.axes.push(axes);
            self.when.push(when);
            self.own[when as usize].push(at);
            if axes == 0 {
                self.own[When::Table as usize].push(at);
            }
        }
    }

    /// Whether the stages take less time than all operations at all points, in additions on one lane.
    fn pays(&self, program: &Program, lengths: &[usize], inner: usize, lanes: usize) -> bool {
        /// What it takes to begin an operation, and to take one apart.
        const BEGIN: usize = 40;
        /// Lanes of a block, about.
        const BLOCK: usize = 128;
        const APART: usize = 200;
        let points: usize = lengths.iter().product();
        let steps: usize = lengths[inner..].iter().product();
        let planes = steps / lengths[inner..].iter().copied().find(|&n| n > 1).unwrap_or(1);
        let pieces = (points / steps).div_ceil(lanes.max(1));
        let [block, table, plane, point] = self.own.each_ref().map(|own| {
            let weigh = |at: &u32| weight(&program.operations[*at as usize]);
            (own.len(), own.iter().map(weigh).sum::<usize>())
        });
        let run = |(count, weight): (usize, usize), lanes: usize| {
            weight * lanes.next_multiple_of(16) + count * BEGIN * lanes.div_ceil(BLOCK)
        };
        let laid = run(block, lanes) + run(table, steps) + run(plane, lanes) * planes + run(point, lanes) * steps;
        let all = (block.0 + table.0 + plane.0 + point.0, block.1 + table.1 + plane.1 + point.1);
        laid * pieces + all.0 * APART < run(all, points)
    }

    /// Which operation reads each value last; [`ALWAYS`] if a later stage does.
    fn read(&mut self, program: &Program) {
        let inputs = program.inputs.len();
        self.last.clear();
        self.last.resize(self.axes.len(), 0);
        for (at, op) in program.operations.iter().enumerate() {
            let when = self.when[inputs + at];
            op.for_each_operand(|v| {
                let v = v as usize;
                // What nothing moves is computed in two stages, in either of which it may be read to the end.
                let kept = self.last[v] == ALWAYS || self.when[v] != when || self.axes[v] == 0;
                self.last[v] = if kept { ALWAYS } else { at as u32 };
            });
        }
        self.last[program.root as usize] = ALWAYS;
    }

    /// Appends an operation over the walked axes.
    fn tabulate(&mut self, op: &Op, at: usize, inputs: usize) {
        release(op, at, inputs, &mut self.last, &self.table_of, &mut self.tables);
        let slot = self.tables.take();
        self.table_of[inputs + at] = slot;
        self.table.operations.push(*op);
        self.table.results.push(slot);
    }

    /// Appends an operation over the lanes; an operand from a table becomes a number.
    fn lay(&mut self, op: &Op, at: usize, inputs: usize, stage: When) {
        let tabled = |v: Value| self.when[v as usize] == When::Table;
        let (entered, op) = match *op {
            Op::Binary(kind, a, b) | Op::Extreme(kind, _, a, b) if has_number_form(kind) && tabled(a) => {
                (Some(a), Op::WithLeft(kind, 0.0, b))
            }
            Op::Binary(kind, a, b) | Op::Extreme(kind, _, a, b) if has_number_form(kind) && tabled(b) => {
                (Some(b), Op::WithRight(kind, a, 0.0))
            }
            other => (None, other),
        };
        let op = if entered.is_none() { self.spread(op, stage) } else { op };
        release(&op, at, inputs, &mut self.last, &self.slots, &mut self.blocks);
        let slot = self.blocks.take();
        self.slots[inputs + at] = slot;
        let table = entered.map(|v| self.table_of[v as usize]);
        let to = self.stage(stage);
        if let Some(table) = table {
            to.entries.push((to.operations.len() as u32, table));
        }
        to.operations.push(op);
        to.results.push(slot);
    }

    /// The operation with each operand from a table spread over lanes of its own, right before it.
    fn spread(&mut self, op: Op, stage: When) -> Op {
        let mut from = [0; 4];
        let mut count = 0;
        op.for_each_operand(|v| {
            if self.when[v as usize] == When::Table && !from[..count].contains(&v) {
                from[count] = v;
                count += 1;
            }
        });
        let mut to = from;
        for (&v, to) in from[..count].iter().zip(&mut to) {
            let slot = self.blocks.take();
            *to = self.slots.len() as Value;
            // A value more, that the next operation reads last.
            self.slots.push(slot);
            self.when.push(stage);
            self.last.push(0);
            let table = self.table_of[v as usize];
            let stage = self.stage(stage);
            stage.entries.push((stage.operations.len() as u32, table));
            stage.operations.push(Op::Constant(0.0));
            stage.results.push(slot);
        }
        let spread = |v: Value| from[..count].iter().position(|f| *f == v).map_or(v, |i| to[i]);
        if count == 0 { op } else { op.renumbered(spread) }
    }

    fn stage(&mut self, stage: When) -> &mut Stage {
        match stage {
            When::Block => &mut self.block,
            When::Table => &mut self.table,
            When::Plane => &mut self.plane,
            When::Point => &mut self.point,
        }
    }
}

/// Gives back the slots of the operands that the operation reads last.
fn release(op: &Op, at: usize, inputs: usize, last: &mut [u32], slot_of: &[u32], slots: &mut Slots) {
    let operations = slot_of.len().min(last.len());
    op.for_each_operand(|v| {
        let v = v as usize;
        // Values beyond the program's own are spread numbers, which one operation reads.
        let own = v < operations && v >= inputs;
        if own && last[v] != ALWAYS && (last[v] as usize == at || v > at + inputs) {
            slots.free.push(slot_of[v]);
            last[v] = ALWAYS;
        }
    });
}

/// About how many additions an operation takes.
fn weight(op: &Op) -> usize {
    use Unary::{Abs, Ceil, Floor, Neg, Not, Powi, Round, Sign, Sqrt};
    match op {
        Op::Unary(Neg | Abs | Sign | Not | Floor | Ceil | Round | Powi(_), _) => 1,
        Op::Unary(Sqrt, _) | Op::Binary(Binary::Hypot | Binary::Div | Binary::Mod, ..) => 4,
        Op::Binary(Binary::Pow | Binary::Atan2, ..) => 40,
        Op::Unary(..) | Op::Join(..) | Op::Leaf(..) => 12,
        _ => 1,
    }
}
