//! Functions as folds: a sum, the least, the largest or the p-norm of many operands, with something around it. Finds the fold; evaluates
//! nothing.

use rustc_hash::FxHashMap;

use super::graph::{Coordinate, Graph, Node, NodeId};
use crate::number::{Binary, Ternary, Unary};

/// How operands are put together. The order does not matter but for rounding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum How {
    /// Added.
    Sum,
    /// The least of them.
    Least,
    /// The largest of them.
    Largest,
    /// The p-norm for this p, neither 0 nor infinite.
    Norm(f64),
}

/// A function as `around(fold of operands)`.
#[derive(Debug)]
pub struct Folded {
    /// How the operands are put together.
    pub how: How,
    /// Each in a graph of its own; `true`: with its sign changed.
    pub operands: Vec<(Graph, NodeId, bool)>,
    /// The function with the coordinate `whole` in the place of the fold.
    pub around: (Graph, NodeId),
    /// That coordinate, which the function does not use.
    pub whole: Coordinate,
}

/// Operations around a fold that are looked through at most.
const AROUND: usize = 16;

/// The function as a fold of at least `least` operands, if it is one under a few operations.
#[must_use]
pub fn folded(graph: &Graph, root: NodeId, least: usize) -> Option<Folded> {
    let mut at = root;
    for _ in 0..AROUND {
        if let Some((how, operands)) = chain(graph, at, least) {
            let used = graph.coordinates(root);
            let whole = (1..=Coordinate::MOST as u8).rev().map(Coordinate).find(|c| !used.contains(*c))?;
            let operands = operands.into_iter().map(|(node, minus)| {
                let (graph, node) = copied(graph, node, None);
                (graph, node, minus)
            });
            let operands = operands.collect();
            return Some(Folded { how, operands, around: copied(graph, root, Some((at, whole))), whole });
        }
        at = match graph.node(at) {
            Node::Unary(_, a) => *a,
            Node::Binary(_, a, b) | Node::Ternary(Ternary::Norm, [a, b, _]) => larger(graph, *a, *b),
            _ => return None,
        };
    }
    None
}

/// The operand that more is behind, by the order in which nodes were made: what is made of much is made late.
fn larger(graph: &Graph, a: NodeId, b: NodeId) -> NodeId {
    match (graph.number(a), graph.number(b)) {
        (Some(_), _) => b,
        (_, Some(_)) => a,
        _ => a.max(b),
    }
}

/// A chain of one operation, if it has so many operands.
fn chain(graph: &Graph, root: NodeId, least: usize) -> Option<(How, Vec<(NodeId, bool)>)> {
    let how = match graph.node(root) {
        Node::Binary(Binary::Add | Binary::Sub, ..) => How::Sum,
        Node::Binary(Binary::Min, ..) => How::Least,
        Node::Binary(Binary::Max, ..) => How::Largest,
        Node::Ternary(Ternary::Norm, [_, _, p]) => How::Norm(graph.number(*p).filter(|p| *p != 0.0 && p.is_finite())?),
        _ => return None,
    };
    let (mut open, mut found) = (vec![(root, false)], Vec::new());
    while let Some((node, minus)) = open.pop() {
        match (graph.node(node), how) {
            (Node::Binary(op @ (Binary::Add | Binary::Sub), a, b), How::Sum) => {
                open.push((*b, minus ^ (*op == Binary::Sub)));
                open.push((*a, minus));
            }
            (Node::Unary(Unary::Neg, a), How::Sum) => open.push((*a, !minus)),
            (Node::Binary(Binary::Min, a, b), How::Least) | (Node::Binary(Binary::Max, a, b), How::Largest) => {
                open.extend([(*b, minus), (*a, minus)]);
            }
            (Node::Ternary(Ternary::Norm, [a, b, _]), How::Norm(p)) if is_norm(graph, node, p) => {
                open.extend([(*b, minus), (*a, minus)]);
            }
            (Node::Unary(Unary::Abs, a), How::Norm(_)) => open.push((*a, minus)),
            // A norm is not negative, so the square of its root is the norm.
            (Node::Unary(Unary::Powi(2), a), How::Norm(p)) => match graph.node(*a) {
                Node::Unary(Unary::Sqrt, inner) if is_norm(graph, *inner, p) => open.push((*inner, minus)),
                _ => found.push((node, minus)),
            },
            _ => found.push((node, minus)),
        }
    }
    (found.len() >= least).then_some((how, found))
}

fn is_norm(graph: &Graph, node: NodeId, p: f64) -> bool {
    matches!(graph.node(node), Node::Ternary(Ternary::Norm, [_, _, q]) if graph.number(*q) == Some(p))
}

/// What a node is made of in a graph of its own; one node may be replaced by a coordinate.
fn copied(graph: &Graph, root: NodeId, instead: Option<(NodeId, Coordinate)>) -> (Graph, NodeId) {
    let (mut copy, mut names) = (Graph::new(), FxHashMap::<NodeId, NodeId>::default());
    if let Some((node, coordinate)) = instead {
        names.insert(node, copy.coordinate(coordinate));
    }
    let root = copy.copied(graph, root, &mut names);
    (copy, root)
}
