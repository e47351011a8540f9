//! The object near one place: the workpiece with those strokes alone that reach there, in a small graph, so that what a stroke costs goes with
//! its neighbours and not with all that were made before. Knows no language.

use rustc_hash::FxHashMap;

use crate::field::expand::expand;
use crate::field::{Graph, Node, NodeId};

/// The workpiece and the tools of its strokes, without maps: what the small graphs are made of.
#[derive(Debug, Default)]
pub struct Local {
    store: Graph,
    /// What a node of the session's graph is in the store.
    known: FxHashMap<NodeId, NodeId>,
}

/// What a stroke does with the object before it: operations, each of what stands before it in the list, of the object, and of nodes of the
/// store.
#[derive(Clone, Debug, Default)]
pub struct Link(Vec<(Node, Vec<From>)>);

/// An operand of a link.
#[derive(Clone, Copy, Debug)]
enum From {
    /// The object before.
    Before,
    /// What stands at that place of the list.
    Own(usize),
    /// A node of the store.
    Store(NodeId),
}

impl Local {
    /// Forgets everything, since the session's graph is another one.
    pub fn clear(&mut self) {
        *self = Self::default();
    }

    /// A node of the session's graph in the store; `None` if it is too large.
    pub fn take(&mut self, from: &Graph, root: NodeId, limit: usize) -> Option<NodeId> {
        if let Some(&here) = self.known.get(&root) {
            return Some(here);
        }
        // Maps are expanded once, as a compiler does it, in a graph that holds nothing else.
        let mut alone = Graph::new();
        let root_alone = alone.copied(from, root, &mut FxHashMap::default());
        let here = match expand(&alone, &[root_alone], limit).ok()? {
            Some((expanded, roots)) => self.store.copied(&expanded, roots[0], &mut FxHashMap::default()),
            None => self.store.copied(&alone, root_alone, &mut FxHashMap::default()),
        };
        self.known.insert(root, here);
        Some(here)
    }

    /// What the node `after` does with the node `before`; `None` if that is too large.
    pub fn link(&mut self, from: &Graph, (before, after): (NodeId, NodeId), limit: usize) -> Option<Link> {
        // What each node on the way is; nothing is said of those that are still open.
        let mut what: FxHashMap<NodeId, From> = FxHashMap::default();
        what.insert(before, From::Before);
        let (mut link, mut open) = (Link::default(), vec![(after, false)]);
        while let Some((node, is_ready)) = open.pop() {
            if what.contains_key(&node) {
                continue;
            }
            // Nodes are numbered after what they read, and what is mapped is a tool: neither holds the object.
            if node < before || matches!(from.node(node), Node::Map(..)) || self.known.contains_key(&node) {
                what.insert(node, From::Store(self.take(from, node, limit)?));
            } else if is_ready {
                let mut operands = Vec::new();
                from.node(node).for_each_operand(|e| operands.extend(what.get(&e)));
                if operands.iter().all(|operand| matches!(operand, From::Store(_))) {
                    what.insert(node, From::Store(self.take(from, node, limit)?));
                } else {
                    what.insert(node, From::Own(link.0.len()));
                    link.0.push((from.node(node).clone(), operands));
                }
            } else {
                open.push((node, true));
                from.node(node).for_each_operand(|e| open.push((e, false)));
            }
        }
        Some(link)
    }

    /// The workpiece, a node of the store, with those strokes, as a graph of its own; and a further node of the store in it.
    pub fn chain<'l>(
        &self,
        base: NodeId,
        links: impl Iterator<Item = &'l Link>,
        further: Option<NodeId>,
    ) -> (Graph, NodeId, Option<NodeId>) {
        let (mut graph, mut known) = (Graph::new(), FxHashMap::default());
        let mut chain = graph.copied(&self.store, base, &mut known);
        let mut own: Vec<NodeId> = Vec::new();
        for Link(operations) in links {
            own.clear();
            for (operation, operands) in operations {
                let (mut before, mut after) = (Vec::new(), Vec::new());
                operation.for_each_operand(|operand| before.push(operand));
                after.extend(operands.iter().map(|operand| match operand {
                    From::Before => chain,
                    From::Own(place) => own[*place],
                    From::Store(node) => graph.copied(&self.store, *node, &mut known),
                }));
                let place = |operand| before.iter().position(|other| *other == operand);
                own.push(graph.rebuilt(operation, |operand| place(operand).map_or(operand, |k| after[k])));
            }
            chain = own.last().copied().unwrap_or(chain);
        }
        let further = further.map(|node| graph.copied(&self.store, node, &mut known));
        (graph, chain, further)
    }
}
