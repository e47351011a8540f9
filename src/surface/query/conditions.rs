//! What a point has to meet: functions that are not to be negative, or not to be otherwise. Each is compiled by itself, and its derivatives
//! once they are asked for. Decides nothing.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::field::derivative::derivative;
use crate::field::{Coordinate, Graph, Node, NodeId};
use crate::interrupt::{Cancelled, Interrupt};
use crate::limits::Limits;
use crate::number::{Algebra, Binary, Ternary, Unary};
use crate::reuse::Digest;
use crate::surface::space::enclose;
use crate::vm::{CompileError, Demand, Program};

/// Conditions that are looked at by themselves; what an intersection has beyond is looked at together.
const MOST: usize = 24;
/// Operations of the derivatives of one condition; beyond, plain intervals must do.
const SLOPES: usize = 200_000;

/// One of them.
pub(super) struct Condition {
    pub(super) value: Arc<Program>,
    /// Whether the point is to be outside: `f < 0` or undefined.
    pub(super) outside: bool,
    node: NodeId,
    slopes: Slopes,
}

/// The derivatives of a condition by each axis; none where it does not change along one.
enum Slopes {
    Unknown,
    Known(Arc<[Option<Arc<Program>>]>),
    TooLong,
}

/// All that a point has to meet at once, over the same axes.
pub struct Conditions {
    graph: Graph,
    axes: Vec<Coordinate>,
    pub(super) all: Vec<Condition>,
    limits: Limits,
}

impl Conditions {
    /// No condition yet, for points of these coordinates.
    #[must_use]
    pub fn over(axes: &[Coordinate], limits: &Limits) -> Self {
        Self { graph: Graph::new(), axes: axes.to_vec(), all: Vec::new(), limits: limits.clone() }
    }

    /// The point is to be inside of an object. What all of an intersection asks becomes a condition each.
    ///
    /// # Errors
    /// If the object depends on another coordinate, or is too large.
    pub fn inside(&mut self, graph: &Graph, object: NodeId) -> Result<(), CompileError> {
        let node = set(graph, object, &mut self.graph);
        let parts = split(&mut self.graph, node);
        parts.into_iter().try_for_each(|part| self.add(part, false))
    }

    /// The point is to be outside of an object: its function is negative there or undefined.
    ///
    /// # Errors
    /// As [`Conditions::inside`].
    pub fn outside(&mut self, graph: &Graph, object: NodeId) -> Result<(), CompileError> {
        let node = set(graph, object, &mut self.graph);
        self.add(node, true)
    }

    /// The point is to be within a distance of another.
    ///
    /// # Errors
    /// None but those of [`Conditions::inside`].
    pub fn within(&mut self, distance: f64, of: &[f64]) -> Result<(), CompileError> {
        let graph = &mut self.graph;
        let mut left = graph.constant(distance * distance);
        for (&axis, &centre) in self.axes.iter().zip(of) {
            let (x, c) = (graph.coordinate(axis), graph.constant(centre));
            let offset = graph.binary(Binary::Sub, x, c);
            let square = graph.unary(Unary::Powi(2), offset);
            left = graph.binary(Binary::Sub, left, square);
        }
        self.add(left, false)
    }

    /// The point is to lie beyond a place on an axis.
    ///
    /// # Errors
    /// None but those of [`Conditions::inside`].
    pub fn beyond(&mut self, (axis, up): (usize, bool), place: f64) -> Result<(), CompileError> {
        let graph = &mut self.graph;
        let (x, place) = (graph.coordinate(self.axes[axis]), graph.constant(place));
        let (more, less) = if up { (x, place) } else { (place, x) };
        let beyond = graph.binary(Binary::Sub, more, less);
        self.add(beyond, false)
    }

    /// One program for all that asks for the inside: not negative where all of it is met.
    ///
    /// # Errors
    /// If it is too large.
    pub(super) fn whole(&mut self) -> Result<Arc<Program>, CompileError> {
        let inside: Vec<NodeId> = self.all.iter().filter(|c| !c.outside).map(|c| c.node).collect();
        let graph = &mut self.graph;
        let node = inside.into_iter().reduce(|a, b| graph.binary(Binary::Min, a, b));
        let node = node.unwrap_or_else(|| graph.constant(1.0));
        Program::compile(&self.graph, node, &self.axes, Demand::Value, &self.limits).map(Arc::new)
    }

    /// The objects of which [`Conditions::inside`] would make conditions, each by itself.
    #[must_use]
    pub fn parts(graph: &Graph, object: NodeId) -> (Graph, Vec<NodeId>) {
        let mut own = Graph::new();
        let node = set(graph, object, &mut own);
        let parts = split(&mut own, node);
        (own, parts)
    }

    fn add(&mut self, node: NodeId, outside: bool) -> Result<(), CompileError> {
        if self.all.iter().any(|known| known.node == node && known.outside == outside) {
            return Ok(());
        }
        let value = Program::compile(&self.graph, node, &self.axes, Demand::Value, &self.limits)?;
        self.all.push(Condition { value: Arc::new(value), outside, node, slopes: Slopes::Unknown });
        Ok(())
    }

    /// The coordinates of a point.
    #[must_use]
    pub fn axes(&self) -> &[Coordinate] {
        &self.axes
    }

    /// The part of a space in which all conditions that ask for the inside may be met; its ends are finite where intervals can tell. `None` if
    /// it is proved that there is no such part.
    pub(super) fn together(
        &mut self,
        space: &[[f64; 2]],
        boxes: usize,
        interrupt: &Interrupt,
    ) -> Result<Option<Vec<[f64; 2]>>, Cancelled> {
        let inside = self.all.iter().filter(|condition| !condition.outside).map(|condition| condition.node);
        let graph = &mut self.graph;
        let all = inside.collect::<Vec<_>>().into_iter().reduce(|a, b| graph.binary(Binary::Min, a, b));
        if space.iter().flatten().all(|end| end.is_finite()) {
            return Ok(Some(space.to_vec()));
        }
        let program = all.map(|node| Program::compile(&self.graph, node, &self.axes, Demand::Sign, &self.limits));
        match program {
            Some(Ok(program)) => enclose(Arc::new(program), space, boxes, interrupt),
            _ => Ok(Some(space.to_vec())),
        }
    }

    /// Whether two conditions say the opposite of each other.
    pub(super) fn contradict(&self) -> bool {
        self.all.iter().any(|a| a.outside && self.all.iter().any(|b| !b.outside && a.node == b.node))
    }

    /// The programs of the derivatives of a condition, made when they are first asked for.
    pub(super) fn slopes(&mut self, number: usize) -> Option<Arc<[Option<Arc<Program>>]>> {
        if let Slopes::Unknown = self.all[number].slopes {
            self.all[number].slopes = self.derived(number).map_or(Slopes::TooLong, |all| Slopes::Known(all.into()));
        }
        match &self.all[number].slopes {
            Slopes::Known(all) => Some(Arc::clone(all)),
            _ => None,
        }
    }

    fn derived(&mut self, number: usize) -> Option<Vec<Option<Arc<Program>>>> {
        let node = self.all[number].node;
        if self.all[number].value.len() > SLOPES || self.all[number].value.has_regions() {
            return None;
        }
        let limits = Limits { program_operations: SLOPES, ..self.limits.clone() };
        let mut all = Vec::with_capacity(self.axes.len());
        for &axis in &self.axes {
            if !self.graph.coordinates(node).contains(axis) {
                all.push(None);
                continue;
            }
            let slope = derivative(&mut self.graph, node, axis);
            let program = Program::compile(&self.graph, slope, &self.axes, Demand::Value, &limits).ok()?;
            all.push(Some(Arc::new(program)));
        }
        Some(all)
    }

    /// Tells all that an answer depends on.
    pub fn tell(&self, to: &mut Digest) {
        to.shown(&self.axes.len());
        for condition in &self.all {
            to.shown(&condition.outside);
            condition.value.tell(&[], to);
        }
    }
}

/// A copy of an object in another graph in which set operations are maximum and minimum: the same set with the same boundary.
fn set(graph: &Graph, object: NodeId, to: &mut Graph) -> NodeId {
    // For each node whether it is asked for as a set and as a value. Operands have smaller numbers, so the last comes first.
    let mut wanted: BTreeMap<NodeId, [bool; 2]> = BTreeMap::from([(object, [true, false])]);
    let mut order = Vec::new();
    while let Some((id, as_what)) = wanted.pop_last() {
        order.push((id, as_what));
        let node = graph.node(id);
        let mut mark = |id: NodeId, as_set: bool| {
            wanted.entry(id).or_default()[usize::from(!as_set)] = true;
        };
        if as_what[0] {
            let parts = set_operands(node);
            node.for_each_operand(|operand| mark(operand, parts.contains(&operand)));
        }
        if as_what[1] {
            node.for_each_operand(|operand| mark(operand, false));
        }
    }
    let mut made: BTreeMap<(NodeId, bool), NodeId> = BTreeMap::new();
    for (id, [as_set, as_value]) in order.into_iter().rev() {
        let node = graph.node(id);
        if as_value {
            let new = to.rebuilt(node, |operand| made[&(operand, false)]);
            made.insert((id, false), new);
        }
        if as_set {
            let parts = set_operands(node);
            let operand = |operand: NodeId| made[&(operand, parts.contains(&operand))];
            let new = match *node {
                Node::Ternary(Ternary::Union | Ternary::UnionSmooth, [a, b, _]) => {
                    to.binary(Binary::Max, operand(a), operand(b))
                }
                Node::Ternary(Ternary::Intersection | Ternary::IntersectionSmooth, [a, b, _]) => {
                    to.binary(Binary::Min, operand(a), operand(b))
                }
                _ => to.rebuilt(node, operand),
            };
            made.insert((id, true), new);
        }
    }
    made[&(object, true)]
}

/// The operands of a set that are sets themselves.
fn set_operands(node: &Node) -> Vec<NodeId> {
    match *node {
        Node::Ternary(
            Ternary::Union | Ternary::UnionSmooth | Ternary::Intersection | Ternary::IntersectionSmooth,
            [a, b, parameter],
        ) if parameter != a && parameter != b => vec![a, b],
        Node::Ternary(Ternary::Select, [condition, a, b]) if condition != a && condition != b => vec![a, b],
        Node::Binary(Binary::Min | Binary::Max, a, b) => vec![a, b],
        Node::Unary(Unary::Neg, a) => vec![a],
        Node::Map(body, ref mapping) if mapping.iter().all(|(_, e)| *e != body) => vec![body],
        _ => Vec::new(),
    }
}

/// The operands of an intersection, of maps of one as well.
fn split(graph: &mut Graph, node: NodeId) -> Vec<NodeId> {
    let mut parts = Vec::new();
    let mut open = vec![node];
    while let Some(node) = open.pop() {
        let is_full = parts.len() + open.len() + 2 > MOST;
        match graph.node(node).clone() {
            Node::Binary(Binary::Min, a, b) if !is_full => open.extend([b, a]),
            Node::Map(body, mapping) if !is_full => match *graph.node(body) {
                Node::Binary(Binary::Min, a, b) => {
                    let [a, b] = [a, b].map(|part| graph.map(part, &mapping));
                    open.extend([b, a]);
                }
                _ => parts.push(node),
            },
            _ => parts.push(node),
        }
    }
    parts
}
