//! Facts about a node that others ask for: how many operations its value takes. Never changes a graph.

use super::expand::reachable;
use super::graph::{Graph, Node, NodeId};

/// The number of operations that the value at `root` takes as it stands: shared parts count once, numbers and coordinates not, a map
/// as one (what it becomes when compiled may be more).
#[must_use]
pub fn operations(graph: &Graph, root: NodeId) -> usize {
    let reached = reachable(graph, root);
    let counts = |index: usize| {
        u32::try_from(index).is_ok_and(|i| !matches!(graph.node(NodeId(i)), Node::Constant(_) | Node::Coordinate(_)))
    };
    (0..reached.len()).filter(|i| reached[*i] && counts(*i)).count()
}
