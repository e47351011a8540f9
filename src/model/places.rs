//! Where in the text a node of the graph comes from: found by lowering the parts of the definitions behind a name again, when it is asked.
//! Keeps nothing, so that nothing is paid for it otherwise.

use std::sync::Arc;

use rustc_hash::FxHashMap;

use crate::field::expand::reachable;
use crate::field::{Node, NodeId};
use crate::source::Span;
use crate::syntax::tree::{Body, Expr, ExprKind, Mapping, StatementKind};

use super::definition::Definition;
use super::lower::{Lower, World};
use super::session::Session;
use super::value::{Scalar, Value};

/// Parts of definitions that are looked through.
const PARTS: usize = 20_000;

impl Session {
    /// The smallest part of the text whose value a node is; else that of the nearest node that is made of it. `root` is the node of the
    /// name itself.
    pub(super) fn place_of_node(&mut self, name: &str, root: NodeId, node: NodeId) -> Option<Span> {
        let definition = self.state.get(name)?.clone();
        let mut places: FxHashMap<NodeId, Span> = FxHashMap::default();
        let mut left = PARTS;
        for one in self.behind(&definition) {
            let parts = parts(&one);
            left = left.saturating_sub(parts.len());
            if left == 0 {
                break;
            }
            self.places(&one, &parts, &mut places);
        }
        self.nearest(root, node, &places)
    }

    /// Adds where the nodes of the parts of a definition stand.
    fn places(&mut self, definition: &Arc<Definition>, parts: &[&Expr], places: &mut FxHashMap<NodeId, Span>) {
        let (excused, later) = Default::default();
        let world = World {
            limits: &self.limits,
            interrupt: &self.interrupt,
            host: &*self.host,
            sources: &self.sources,
            excused: &excused,
            later: &later,
        };
        let mut lower = Lower::new(world, &mut self.state, &mut self.graph, &mut self.files);
        for e in parts {
            if let Some(Value::Scalar(Scalar::Node(id))) = lower.part(definition, e) {
                // Of several parts with one value the first that is smallest: a name that stands for it is smaller than what it says.
                let is_name = matches!(e.kind, ExprKind::Name(_));
                places.entry(id).and_modify(|span| *span = if is_name { *span } else { e.span }).or_insert(e.span);
            }
        }
        drop(lower);
        for name in &definition.outputs {
            if let Some(Ok(Value::Scalar(Scalar::Node(id)))) = self.value(name) {
                places.entry(id).or_insert(definition.place());
            }
        }
    }

    /// The place of a node, or of the nearest one that reads it.
    fn nearest(&self, root: NodeId, node: NodeId, places: &FxHashMap<NodeId, Span>) -> Option<Span> {
        let reached = reachable(&self.graph, root);
        // How far each node is from `node`, upwards; operands have smaller numbers.
        let mut far: Vec<u32> = vec![u32::MAX; reached.len()];
        *far.get_mut(node.index())? = 0;
        for index in node.index() + 1..reached.len() {
            if reached[index] {
                let mut least = u32::MAX;
                let reader: &Node = self.graph.node(NodeId(index as u32));
                reader.for_each_operand(|e| least = least.min(far[e.index()]));
                far[index] = least.saturating_add(1);
            }
        }
        let known = places.iter().filter(|(id, _)| id.index() < far.len() && far[id.index()] < u32::MAX);
        known.min_by_key(|(id, span)| (far[id.index()], id.index(), span.start)).map(|(_, span)| *span)
    }
}

/// The parts of a definition that have values by themselves, larger ones first.
fn parts(definition: &Definition) -> Vec<&Expr> {
    let mut open: Vec<&Expr> = match &definition.statement.kind {
        StatementKind::Define { parameters: None, body: Body::Expression(e), .. } => vec![e],
        StatementKind::Element { value, .. } | StatementKind::Expression(value) => vec![value],
        _ => Vec::new(),
    };
    let mut all = Vec::new();
    while let Some(e) = open.pop() {
        all.push(e);
        match &e.kind {
            ExprKind::Number(_)
            | ExprKind::Text(_)
            | ExprKind::Coordinate(_)
            | ExprKind::Name(_)
            | ExprKind::Pi
            | ExprKind::Infinity => {}
            ExprKind::Array(items) => open.extend(items),
            ExprKind::Paren(inner) => open.push(inner),
            ExprKind::Chain { first, rest } => {
                open.push(first);
                open.extend(rest.iter().map(|(.., e)| e));
            }
            ExprKind::Compare { first, rest } => {
                open.push(first);
                open.extend(rest.iter().map(|(.., e)| e));
            }
            ExprKind::Prefix { operand, .. } => open.push(operand),
            ExprKind::Power { base, exponent } => open.extend([&**base, &**exponent]),
            ExprKind::Index { base, .. } => open.push(base),
            ExprKind::Call { arguments, .. } => open.extend(arguments),
            // What stands in them reads names that have a value there alone.
            ExprKind::Fold { .. } | ExprKind::Setting { .. } | ExprKind::Where { .. } => {}
            ExprKind::At { body, mapping } => {
                open.push(body);
                match mapping {
                    Mapping::Positional(all) => open.extend(all),
                    Mapping::Named(all) => open.extend(all.iter().map(|(.., e)| e)),
                }
            }
            ExprKind::If { condition, then, otherwise } => {
                open.extend([&**condition, &**then]);
                open.extend(otherwise.as_deref());
            }
        }
    }
    all
}
