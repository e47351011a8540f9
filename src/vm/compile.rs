//! Compiles an expression graph to a program: expands maps, orders the operations so that few values are kept at a time, puts numbers
//! into the operations. Never changes a value under [`Demand::Value`], nor a sign under [`Demand::Sign`]. Never recurses.

use std::fmt;

use rustc_hash::FxHashMap;

use super::program::{Demand, Op, Program, Side, Value};
use super::slots::SlotScratch;
use crate::field::expand::{expand, reachable};
use crate::field::{Coordinate, Graph, Node, NodeId, SharedLeaf};
use crate::limits::Limits;
use crate::number::{Binary, Ternary, Unary};

/// Why an expression cannot be compiled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CompileError {
    /// It uses a coordinate that is not among the inputs.
    Unbound(Coordinate),
    /// It would take more operations than `Limits::program_operations`, the number given here.
    TooLarge(usize),
}

impl fmt::Display for CompileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unbound(c) => write!(f, "the coordinate {c} has no value here"),
            Self::TooLarge(limit) => write!(f, "the expression takes more than {limit} operations"),
        }
    }
}

impl std::error::Error for CompileError {}

impl Program {
    /// The program for the value at `root` as a function of `inputs`.
    ///
    /// # Errors
    /// [`CompileError::Unbound`] if it uses another coordinate; [`CompileError::TooLarge`] if it takes more operations, after the
    /// expansion of maps, than `limits` allow.
    pub fn compile(
        graph: &Graph,
        root: NodeId,
        inputs: &[Coordinate],
        demand: Demand,
        limits: &Limits,
    ) -> Result<Self, CompileError> {
        let limit = limits.program_operations;
        if let Some(c) = graph.coordinates(root).iter().find(|c| !inputs.contains(c)) {
            return Err(CompileError::Unbound(c));
        }
        let expanded = expand(graph, root, limit).map_err(|e| CompileError::TooLarge(e.limit))?;
        let (graph, root) = expanded.as_ref().map_or((graph, root), |(g, r)| (g, *r));
        let mut emitter = Emitter::new(graph, root, inputs, demand);
        for node in order(graph, root, &emitter.reached) {
            emitter.emit(node);
            if emitter.operations.len() > limit {
                return Err(CompileError::TooLarge(limit));
            }
        }
        let root = emitter.operand(root);
        let mut slots = Vec::new();
        let slot_count = SlotScratch::default().assign(inputs.len(), &emitter.operations, root, &mut slots);
        Ok(Self {
            inputs: inputs.into(),
            leaves: emitter.leaves.into(),
            operations: emitter.operations,
            slots,
            slot_count,
            root,
            demand,
        })
    }
}

/// The nodes below `root` so that each comes after what it reads: of its operands the one that needs the most slots is computed
/// first (Sethi and Ullman), so that a chain keeps a value or two, whichever way it leans.
fn order(graph: &Graph, root: NodeId, reached: &[bool]) -> Vec<NodeId> {
    let need = needs(graph, root, reached);
    let mut done = vec![false; root.index() + 1];
    let mut ordered = Vec::new();
    let mut open = vec![(root, false)];
    let mut operands: Vec<NodeId> = Vec::new();
    while let Some((node, ready)) = open.pop() {
        if done[node.index()] {
            continue;
        }
        if ready {
            done[node.index()] = true;
            ordered.push(node);
            continue;
        }
        open.push((node, true));
        operands.clear();
        graph.node(node).for_each_operand(|e| operands.push(e));
        // What is pushed last is computed first; of equals, the first operand.
        operands.reverse();
        operands.sort_by_key(|e| need[e.index()]);
        open.extend(operands.iter().filter(|e| !done[e.index()]).map(|e| (*e, false)));
    }
    ordered
}

/// An estimate of the slots that each node takes, as if nothing were shared.
fn needs(graph: &Graph, root: NodeId, reached: &[bool]) -> Vec<u32> {
    let mut need = vec![0u32; root.index() + 1];
    for index in (0..=root.index()).filter(|i| reached[*i]) {
        let node = graph.node(NodeId(index as u32));
        let mut operands = [0u32; 4];
        let mut count = 0;
        node.for_each_operand(|e| {
            if count < operands.len() {
                operands[count] = need[e.index()];
                count += 1;
            }
        });
        let operands = &mut operands[..count];
        operands.sort_unstable_by(|a, b| b.cmp(a));
        let held = operands.iter().zip(0u32..).map(|(n, held)| n.saturating_add(if *n == 0 { 0 } else { held })).max();
        need[index] = match node {
            Node::Constant(_) | Node::Coordinate(_) => 0,
            _ => held.unwrap_or(0).max(1),
        };
    }
    need
}

/// Which questions about each node's value matter: a set of the constants below, named as in [`Side`].
mod wanted {
    pub(super) const VALUE: u8 = 1;
    pub(super) const INSIDE: u8 = 2;
    pub(super) const UPPER: u8 = 4;
    pub(super) const LOWER: u8 = 8;

    /// What is asked of the operand of a complement.
    pub(super) fn complement(want: u8) -> u8 {
        (if want & (INSIDE | UPPER) != 0 { LOWER } else { 0 }) | (if want & LOWER != 0 { UPPER } else { 0 })
    }
}

/// What each node is wanted for, from the root down. Signs are passed on through set operations, complements and the branches of a
/// condition; everything else needs values.
fn wants(graph: &Graph, root: NodeId, reached: &[bool], demand: Demand) -> Vec<u8> {
    let mut wants = vec![0u8; root.index() + 1];
    wants[root.index()] = if demand == Demand::Sign { wanted::INSIDE } else { wanted::VALUE };
    for index in (0..=root.index()).rev().filter(|i| reached[*i]) {
        let want = wants[index];
        let node = graph.node(NodeId(index as u32));
        match node {
            _ if want & wanted::VALUE != 0 => node.for_each_operand(|e| wants[e.index()] |= wanted::VALUE),
            Node::Unary(Unary::Neg, a) => wants[a.index()] |= wanted::complement(want),
            Node::Binary(Binary::Min | Binary::Max, a, b) => {
                wants[a.index()] |= want;
                wants[b.index()] |= want;
            }
            Node::Ternary(Ternary::Select, [condition, a, b]) => {
                wants[condition.index()] |= wanted::VALUE;
                wants[a.index()] |= want;
                wants[b.index()] |= want;
            }
            Node::Ternary(op, [a, b, c]) if extreme_of(*op, graph.number(*c)).is_some() => {
                wants[a.index()] |= want;
                wants[b.index()] |= want;
            }
            _ => node.for_each_operand(|e| wants[e.index()] |= wanted::VALUE),
        }
    }
    wants
}

/// The max or min that has the same sign as an R-function whose parameter is a number in its range.
pub(crate) fn extreme_of(op: Ternary, parameter: Option<f64>) -> Option<Binary> {
    let parameter = parameter?;
    let alpha = parameter > -1.0 && parameter <= 1.0;
    match op {
        Ternary::Union if alpha => Some(Binary::Max),
        Ternary::Intersection if alpha => Some(Binary::Min),
        Ternary::UnionSmooth if parameter >= 0.0 => Some(Binary::Max),
        Ternary::IntersectionSmooth if parameter >= 0.0 => Some(Binary::Min),
        _ => None,
    }
}

struct Emitter<'a> {
    graph: &'a Graph,
    inputs: &'a [Coordinate],
    reached: Vec<bool>,
    wants: Vec<u8>,
    values: Vec<Value>,
    operations: Vec<Op>,
    leaves: Vec<SharedLeaf>,
    leaf_numbers: FxHashMap<SharedLeaf, u32>,
}

impl<'a> Emitter<'a> {
    fn new(graph: &'a Graph, root: NodeId, inputs: &'a [Coordinate], demand: Demand) -> Self {
        let reached = reachable(graph, root);
        let wants = wants(graph, root, &reached, demand);
        Self {
            graph,
            inputs,
            wants,
            values: vec![0; root.index() + 1],
            reached,
            operations: Vec::new(),
            leaves: Vec::new(),
            leaf_numbers: FxHashMap::default(),
        }
    }

    fn push(&mut self, op: Op) -> Value {
        self.operations.push(op);
        (self.inputs.len() + self.operations.len() - 1) as Value
    }

    /// The value of a node whose operations are there; a number gets an operation of its own, right before its reader.
    fn operand(&mut self, node: NodeId) -> Value {
        match self.graph.number(node) {
            Some(number) => self.push(Op::Constant(number)),
            None => self.values[node.index()],
        }
    }

    fn emit(&mut self, node: NodeId) {
        let op = match self.graph.node(node) {
            Node::Constant(_) => return,
            Node::Coordinate(c) => {
                let position = self.inputs.iter().position(|i| i == c);
                self.values[node.index()] = position.map_or(0, |p| p as Value);
                return;
            }
            Node::Unary(op, a) => Op::Unary(*op, self.operand(*a)),
            Node::Binary(op, a, b) => self.binary(*op, *a, *b, node),
            Node::Ternary(op, [a, b, c]) => self.ternary(*op, [*a, *b, *c], node),
            Node::Leaf(leaf, arguments) => self.leaf(leaf, arguments),
            Node::Map(..) => unreachable!("maps were expanded"),
        };
        self.values[node.index()] = self.push(op);
    }

    /// The question that is asked of a node of which only a sign matters.
    fn side(&self, node: NodeId) -> Option<Side> {
        let want = self.wants[node.index()];
        let above = want & (wanted::INSIDE | wanted::UPPER) != 0;
        match (want & wanted::VALUE != 0, above, want & wanted::LOWER != 0) {
            (true, ..) => None,
            (_, true, true) => Some(Side::Both),
            (_, _, true) => Some(Side::Lower),
            _ if want & wanted::UPPER != 0 => Some(Side::Upper),
            _ => Some(Side::Inside),
        }
    }

    fn binary(&mut self, op: Binary, a: NodeId, b: NodeId, node: NodeId) -> Op {
        let extreme = matches!(op, Binary::Min | Binary::Max);
        if let (true, Some(side)) = (extreme, self.side(node)) {
            return Op::Extreme(op, side, self.operand(a), self.operand(b));
        }
        match (has_number_form(op), self.graph.number(a), self.graph.number(b)) {
            (true, None, Some(y)) => Op::WithRight(op, self.operand(a), y),
            (true, Some(x), None) => Op::WithLeft(op, x, self.operand(b)),
            _ => Op::Binary(op, self.operand(a), self.operand(b)),
        }
    }

    fn ternary(&mut self, op: Ternary, [a, b, c]: [NodeId; 3], node: NodeId) -> Op {
        let parameter = self.graph.number(c);
        if let (Some(extreme), Some(side)) = (extreme_of(op, parameter), self.side(node)) {
            return Op::Extreme(extreme, side, self.operand(a), self.operand(b));
        }
        match parameter {
            Some(parameter) if op != Ternary::Select => Op::Join(op, self.operand(a), self.operand(b), parameter),
            _ => Op::Ternary(op, [self.operand(a), self.operand(b), self.operand(c)]),
        }
    }

    fn leaf(&mut self, leaf: &SharedLeaf, nodes: &[NodeId]) -> Op {
        let next = self.leaves.len() as u32;
        let number = *self.leaf_numbers.entry(leaf.clone()).or_insert(next);
        if number == next {
            self.leaves.push(leaf.clone());
        }
        let mut arguments = [0; 4];
        for (argument, node) in arguments.iter_mut().zip(nodes) {
            *argument = self.operand(*node);
        }
        Op::Leaf(number, nodes.len().min(4) as u8, arguments)
    }
}

/// The operations that exist with a number in place of an operand.
pub(crate) fn has_number_form(op: Binary) -> bool {
    use Binary::{Add, Div, Less, LessEqual, Max, Min, Mul, Sub};
    matches!(op, Add | Sub | Mul | Div | Min | Max | Less | LessEqual)
}
