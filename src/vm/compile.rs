//! Compiles an expression graph to a program: expands maps, orders the operations so that few values are kept at a time, puts numbers
//! into the operations. Never changes a value under [`Demand::Value`], nor a sign under [`Demand::Sign`]. Never recurses.

use std::fmt;
use std::sync::Arc;

use rustc_hash::FxHashMap;

use super::program::{Demand, Op, Program, Side, Value};
use super::region::RegionProgram;
use super::slots::SlotScratch;
use crate::field::expand::{expand, reachable_all};
use crate::field::{Coordinate, Coordinates, Graph, Node, NodeId, SharedLeaf, SharedRegion};
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
        Self::compile_all(graph, &[root], inputs, demand, limits).map(|(program, _)| program)
    }

    /// The program for several values at once, and where it leaves them; its own value is the first.
    pub(crate) fn compile_all(
        graph: &Graph,
        roots: &[NodeId],
        inputs: &[Coordinate],
        demand: Demand,
        limits: &Limits,
    ) -> Result<(Self, Vec<Value>), CompileError> {
        let limit = limits.program_operations;
        let used = roots.iter().fold(Coordinates::default(), |all, root| all.union(graph.coordinates(*root)));
        if let Some(c) = used.iter().find(|c| !inputs.contains(c)) {
            return Err(CompileError::Unbound(c));
        }
        let expanded = expand(graph, roots, limit).map_err(|e| CompileError::TooLarge(e.limit))?;
        let (graph, roots) = expanded.as_ref().map_or((graph, roots), |(graph, roots)| (graph, &roots[..]));
        let mut emitter = Emitter::new(graph, roots, inputs, demand, limits);
        for node in order(graph, roots, &emitter.reached) {
            emitter.emit(node)?;
            if emitter.operations.len() > limit {
                return Err(CompileError::TooLarge(limit));
            }
        }
        let values: Vec<Value> = roots.iter().map(|root| emitter.operand(*root)).collect();
        let mut slots = Vec::new();
        let slot_count = SlotScratch::default().assign(inputs.len(), &emitter.operations, &values, &mut slots);
        let program = Self {
            inputs: inputs.into(),
            leaves: emitter.leaves.into(),
            regions: emitter.regions.into(),
            operations: emitter.operations,
            slots,
            slot_count,
            root: values[0],
            demand,
        };
        Ok((program, values))
    }
}

/// The nodes below the roots so that each comes after what it reads: of its operands the one that needs the most slots is computed
/// first (Sethi and Ullman), so that a chain keeps a value or two, whichever way it leans.
fn order(graph: &Graph, roots: &[NodeId], reached: &[bool]) -> Vec<NodeId> {
    let need = needs(graph, reached);
    let mut done = vec![false; reached.len()];
    let mut ordered = Vec::new();
    let mut open: Vec<(NodeId, bool)> = roots.iter().rev().map(|root| (*root, false)).collect();
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
fn needs(graph: &Graph, reached: &[bool]) -> Vec<u32> {
    let mut need = vec![0u32; reached.len()];
    for index in (0..reached.len()).filter(|i| reached[*i]) {
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

/// What each node is wanted for, from the roots down. Signs are passed on through set operations, complements and the branches of a
/// condition; everything else needs values.
fn wants(graph: &Graph, roots: &[NodeId], reached: &[bool], demand: Demand) -> Vec<u8> {
    let mut wants = vec![0u8; reached.len()];
    let want = if demand == Demand::Sign { wanted::INSIDE } else { wanted::VALUE };
    roots.iter().for_each(|root| wants[root.index()] = want);
    for index in (0..reached.len()).rev().filter(|i| reached[*i]) {
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

/// A region with its arguments, and whether only the sign of its first output is wanted.
type Applied = (SharedRegion, Arc<[NodeId]>, bool);

struct Emitter<'a> {
    graph: &'a Graph,
    inputs: &'a [Coordinate],
    reached: Vec<bool>,
    wants: Vec<u8>,
    values: Vec<Value>,
    operations: Vec<Op>,
    leaves: Vec<SharedLeaf>,
    leaf_numbers: FxHashMap<SharedLeaf, u32>,
    limits: &'a Limits,
    regions: Vec<Arc<RegionProgram>>,
    /// Compiled regions, whatever their arguments.
    compiled: FxHashMap<(SharedRegion, bool), Arc<RegionProgram>>,
    /// The number of each region with its arguments, and its value; apart where only its sign is wanted.
    running: FxHashMap<Applied, (u32, Value)>,
}

impl<'a> Emitter<'a> {
    fn new(graph: &'a Graph, roots: &[NodeId], inputs: &'a [Coordinate], demand: Demand, limits: &'a Limits) -> Self {
        let reached = reachable_all(graph, roots);
        let wants = wants(graph, roots, &reached, demand);
        Self {
            graph,
            inputs,
            wants,
            values: vec![0; reached.len()],
            reached,
            operations: Vec::new(),
            leaves: Vec::new(),
            leaf_numbers: FxHashMap::default(),
            limits,
            regions: Vec::new(),
            compiled: FxHashMap::default(),
            running: FxHashMap::default(),
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

    fn emit(&mut self, node: NodeId) -> Result<(), CompileError> {
        let op = match self.graph.node(node) {
            Node::Constant(_) => return Ok(()),
            Node::Coordinate(c) => {
                let position = self.inputs.iter().position(|i| i == c);
                self.values[node.index()] = position.map_or(0, |p| p as Value);
                return Ok(());
            }
            Node::Unary(op, a) => Op::Unary(*op, self.operand(*a)),
            Node::Binary(op, a, b) => self.binary(*op, *a, *b, node),
            Node::Ternary(op, [a, b, c]) => self.ternary(*op, [*a, *b, *c], node),
            Node::Leaf(leaf, arguments) => self.leaf(leaf, arguments),
            Node::Region(region, output, arguments) => {
                let sign = *output == 0 && self.side(node).is_some();
                let (number, value) = self.region((region.clone(), arguments.clone(), sign))?;
                if *output == 0 {
                    self.values[node.index()] = value;
                    return Ok(());
                }
                Op::Output(number, *output, value)
            }
            Node::Map(..) => unreachable!("maps were expanded"),
        };
        self.values[node.index()] = self.push(op);
        Ok(())
    }

    /// Runs a region with its arguments, once however many of its outputs are read: its number and its first output.
    fn region(&mut self, applied: Applied) -> Result<(u32, Value), CompileError> {
        if let Some(known) = self.running.get(&applied) {
            return Ok(*known);
        }
        let (region, arguments, sign) = &applied;
        let kind = (region.clone(), *sign);
        let program = match self.compiled.get(&kind) {
            Some(program) => program.clone(),
            None => {
                let program = Arc::new(RegionProgram::compile(&region.0, *sign, self.limits)?);
                self.compiled.insert(kind, program.clone());
                program
            }
        };
        let number = self.regions.len() as u32;
        self.regions.push(program);
        let mut before = None;
        for (place, argument) in (0u32..).zip(arguments.iter()) {
            let argument = self.operand(*argument);
            before = Some(self.push(Op::Give(number, place, argument, before.unwrap_or(argument))));
        }
        let value = self.push(Op::Region(number, before.unwrap_or(0)));
        self.running.insert(applied, (number, value));
        Ok((number, value))
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
