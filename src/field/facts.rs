//! Facts about a node that others ask for: how many operations its value takes. Never changes a graph.

use rustc_hash::FxHashSet;

use super::expand::reachable;
use super::graph::{Graph, Node, NodeId};

/// Nodes up to which they are looked for one by one.
const SMALL: usize = 1024;

/// The number of operations that the value at `root` takes as it stands: shared parts count once, numbers and coordinates not, a map
/// as one (what it becomes when compiled may be more).
#[must_use]
pub fn operations(graph: &Graph, root: NodeId) -> usize {
    let counts = |node: NodeId| usize::from(!matches!(graph.node(node), Node::Constant(_) | Node::Coordinate(_)));
    // A small part of a large graph costs what it is large itself.
    let (mut seen, mut open) = (FxHashSet::default(), vec![root]);
    seen.insert(root);
    let mut count = 0;
    while let Some(node) = open.pop() {
        if seen.len() > SMALL {
            let reached = reachable(graph, root);
            let nodes = (0..=root.0).map(NodeId).filter(|node| reached[node.index()]);
            return nodes.map(counts).sum();
        }
        count += counts(node);
        graph.node(node).for_each_operand(|operand| {
            if seen.insert(operand) {
                open.push(operand);
            }
        });
    }
    count
}
