//! The object near one place: the workpiece with those strokes alone that reach there, in a graph of its own, so that what a stroke costs
//! goes with its neighbours and not with all that were made before. Knows no language.

use rustc_hash::FxHashMap;

use crate::field::expand::expand;
use crate::field::{Graph, Node, NodeId};

/// Nodes that chains may leave behind before the graph is made anew.
const LEFT_BEHIND: usize = 1 << 16;

/// A small graph: the workpiece, the tools, and the chains that were asked for.
#[derive(Debug, Default)]
pub struct Local {
    graph: Graph,
    /// What a node of the session's graph is here.
    known: FxHashMap<NodeId, NodeId>,
    /// Nodes when it was last made anew.
    settled: usize,
}

/// A node's own number for what it is here, while a chain goes through it.
enum Step {
    Enter(NodeId),
    Leave(NodeId),
}

impl Local {
    /// The graph that its answers are nodes of.
    pub fn graph(&mut self) -> &mut Graph {
        &mut self.graph
    }

    /// Forgets everything, since the session's graph is another one or too much was left behind.
    pub fn clear(&mut self) {
        *self = Self::default();
    }

    /// The workpiece with those strokes: for each the node of the object before it and the one after it. `None` if it is too large.
    pub fn chain(&mut self, from: &Graph, base: NodeId, strokes: &[(NodeId, NodeId)], limit: usize) -> Option<NodeId> {
        if self.graph.len() > LEFT_BEHIND + 2 * self.settled {
            self.clear();
        }
        let mut chain = self.take(from, base, limit)?;
        if self.settled == 0 {
            self.settled = self.graph.len();
        }
        for &(before, after) in strokes {
            chain = self.graft(from, after, (before, chain), limit)?;
        }
        Some(chain)
    }

    /// A node that stands for itself.
    pub fn take(&mut self, from: &Graph, root: NodeId, limit: usize) -> Option<NodeId> {
        if let Some(&here) = self.known.get(&root) {
            return Some(here);
        }
        // Maps are expanded once, as a compiler does it.
        let here = match expand(from, &[root], limit).ok()? {
            Some((expanded, roots)) => self.copy(&expanded, roots[0], &mut FxHashMap::default()),
            None => {
                let mut known = std::mem::take(&mut self.known);
                let here = self.copy(from, root, &mut known);
                self.known = known;
                here
            }
        };
        self.known.insert(root, here);
        Some(here)
    }

    /// Copies a node and what it reads.
    fn copy(&mut self, from: &Graph, root: NodeId, known: &mut FxHashMap<NodeId, NodeId>) -> NodeId {
        let mut open = vec![root];
        while let Some(&node) = open.last() {
            let waiting = open.len();
            if !known.contains_key(&node) {
                from.node(node).for_each_operand(|e| {
                    if !known.contains_key(&e) {
                        open.push(e);
                    }
                });
            }
            if open.len() == waiting {
                open.pop();
                if !known.contains_key(&node) {
                    let copied = with_operands(from.node(node), |e| known[&e]);
                    known.insert(node, self.graph.intern(copied));
                }
            }
        }
        known[&root]
    }

    /// The node `root` with another node in the place of `before`.
    fn graft(&mut self, from: &Graph, root: NodeId, (before, chain): (NodeId, NodeId), limit: usize) -> Option<NodeId> {
        let mut here: FxHashMap<NodeId, NodeId> = FxHashMap::default();
        here.insert(before, chain);
        let mut through: FxHashMap<NodeId, bool> = FxHashMap::default();
        through.insert(before, true);
        let mut open = vec![Step::Enter(root)];
        while let Some(step) = open.pop() {
            match step {
                Step::Enter(node) if through.contains_key(&node) || self.known.contains_key(&node) => {}
                // What is mapped is a tool: it does not hold the workpiece.
                Step::Enter(node) if matches!(from.node(node), Node::Map(..)) => {
                    self.take(from, node, limit)?;
                }
                Step::Enter(node) => {
                    open.push(Step::Leave(node));
                    from.node(node).for_each_operand(|e| open.push(Step::Enter(e)));
                }
                Step::Leave(node) => {
                    let mut holds = false;
                    from.node(node).for_each_operand(|e| holds |= through.get(&e).copied().unwrap_or(false));
                    through.insert(node, holds);
                    let known = &self.known;
                    let copied = with_operands(from.node(node), |e| {
                        here.get(&e).or_else(|| known.get(&e)).copied().unwrap_or(e)
                    });
                    let new = self.graph.intern(copied);
                    if holds {
                        here.insert(node, new)
                    } else {
                        self.known.insert(node, new)
                    };
                }
            }
        }
        here.get(&root).or_else(|| self.known.get(&root)).copied()
    }
}

/// The same operation of other operands.
fn with_operands(node: &Node, mut of: impl FnMut(NodeId) -> NodeId) -> Node {
    match node {
        Node::Constant(_) | Node::Coordinate(_) => node.clone(),
        Node::Unary(op, a) => Node::Unary(*op, of(*a)),
        Node::Binary(op, a, b) => Node::Binary(*op, of(*a), of(*b)),
        Node::Ternary(op, operands) => Node::Ternary(*op, operands.map(of)),
        Node::Leaf(leaf, arguments) => Node::Leaf(leaf.clone(), arguments.iter().map(|e| of(*e)).collect()),
        Node::Region(region, output, arguments) => {
            Node::Region(region.clone(), *output, arguments.iter().map(|e| of(*e)).collect())
        }
        Node::Map(body, mapping) => Node::Map(of(*body), mapping.iter().map(|(c, e)| (*c, of(*e))).collect()),
    }
}
