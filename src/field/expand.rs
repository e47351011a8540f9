//! Replaces the maps (`AT`) below a node by substitution, within a budget of nodes. Shared parts stay shared: a part is copied once
//! per mapping of the coordinates that it uses. Never recurses.

use rustc_hash::FxHashMap;

use super::graph::{Coordinate, Graph, Node, NodeId};

/// The expansion would take more nodes than allowed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TooLarge {
    /// The number of nodes that was allowed.
    pub limit: usize,
}

/// The nodes that the value at `root` needs, by number. Iterative: one pass downwards.
#[must_use]
pub fn reachable(graph: &Graph, root: NodeId) -> Vec<bool> {
    reachable_all(graph, &[root])
}

/// The nodes that the values at these roots need, by number.
#[must_use]
pub fn reachable_all(graph: &Graph, roots: &[NodeId]) -> Vec<bool> {
    let length = roots.iter().map(|root| root.index() + 1).max().unwrap_or(0);
    let mut reached = vec![false; length];
    roots.iter().for_each(|root| reached[root.index()] = true);
    for index in (0..length).rev() {
        if reached[index] {
            graph.node(id(index)).for_each_operand(|e| reached[e.index()] = true);
        }
    }
    reached
}

fn id(index: usize) -> NodeId {
    NodeId(u32::try_from(index).unwrap_or(u32::MAX))
}

/// A graph with just what the roots need, and no map in it; the roots' numbers in it come with it. `None` if there is no map to begin
/// with, so that the graph can be used as it is.
///
/// # Errors
/// [`TooLarge`] if the result would have more than `limit` nodes.
pub fn expand(graph: &Graph, roots: &[NodeId], limit: usize) -> Result<Option<(Graph, Vec<NodeId>)>, TooLarge> {
    let reached = reachable_all(graph, roots);
    let has_map = (0..reached.len()).any(|i| reached[i] && matches!(graph.node(id(i)), Node::Map(..)));
    if !has_map {
        return Ok(None);
    }
    let mut expansion = Expansion::new(graph, limit);
    let roots = roots.iter().map(|root| expansion.run(*root)).collect::<Result<_, _>>()?;
    Ok(Some((expansion.result, roots)))
}

/// One expression of the new graph per coordinate.
type Mapping = [NodeId; Coordinate::MOST];

/// Which mapping a node is seen through.
type MappingId = u32;

struct Expansion<'a> {
    source: &'a Graph,
    result: Graph,
    limit: usize,
    mappings: Vec<Mapping>,
    numbers: FxHashMap<Mapping, MappingId>,
    done: FxHashMap<(NodeId, MappingId), NodeId>,
}

impl<'a> Expansion<'a> {
    fn new(source: &'a Graph, limit: usize) -> Self {
        let mut result = Graph::new();
        let identity: Mapping = std::array::from_fn(|i| result.coordinate(Coordinate(i as u8 + 1)));
        let mut numbers = FxHashMap::default();
        numbers.insert(identity, 0);
        Self { source, result, limit, mappings: vec![identity], numbers, done: FxHashMap::default() }
    }

    fn run(&mut self, root: NodeId) -> Result<NodeId, TooLarge> {
        let mut open = vec![(root, 0)];
        while let Some(&(node, mapping)) = open.last() {
            let before = open.len();
            if self.done.contains_key(&(node, mapping)) || self.visit(node, mapping, &mut open) {
                debug_assert_eq!(open.len(), before);
                open.pop();
            }
            if self.result.len() > self.limit.saturating_add(Coordinate::MOST) || open.len() > self.limit.saturating_mul(4) {
                return Err(TooLarge { limit: self.limit });
            }
        }
        Ok(self.done[&(root, 0)])
    }

    /// Expands one node if all that it reads is expanded, and says so; else puts what is missing on the list.
    fn visit(&mut self, node: NodeId, mapping: MappingId, open: &mut Vec<(NodeId, MappingId)>) -> bool {
        let made = match self.source.node(node) {
            Node::Map(body, table) => match self.through(*body, table, mapping, open) {
                Some(made) => made,
                None => return false,
            },
            plain => {
                let before = open.len();
                plain.for_each_operand(|e| {
                    if !self.done.contains_key(&(e, mapping)) {
                        open.push((e, mapping));
                    }
                });
                if open.len() > before {
                    return false;
                }
                self.rebuild(node, mapping)
            }
        };
        self.done.insert((node, mapping), made);
        true
    }

    /// The body of a map seen through its mapping, once the mapped expressions and then the body are there.
    fn through(
        &mut self,
        body: NodeId,
        table: &[(Coordinate, NodeId)],
        mapping: MappingId,
        open: &mut Vec<(NodeId, MappingId)>,
    ) -> Option<NodeId> {
        let before = open.len();
        open.extend(table.iter().map(|(_, e)| (*e, mapping)).filter(|key| !self.done.contains_key(key)));
        if open.len() > before {
            return None;
        }
        let used = self.source.coordinates(body);
        let mut inner = self.mappings[0];
        for c in used.iter() {
            inner[usize::from(c.0) - 1] = self.mappings[mapping as usize][usize::from(c.0) - 1];
        }
        for (c, e) in table.iter().filter(|(c, _)| used.contains(*c)) {
            inner[usize::from(c.0) - 1] = self.done[&(*e, mapping)];
        }
        let inner = self.number_of(inner);
        let made = self.done.get(&(body, inner)).copied();
        if made.is_none() {
            open.push((body, inner));
        }
        made
    }

    fn number_of(&mut self, mapping: Mapping) -> MappingId {
        let next = self.mappings.len() as MappingId;
        let number = *self.numbers.entry(mapping).or_insert(next);
        if number == next {
            self.mappings.push(mapping);
        }
        number
    }

    fn rebuild(&mut self, node: NodeId, mapping: MappingId) -> NodeId {
        match self.source.node(node) {
            Node::Coordinate(c) => self.mappings[mapping as usize][usize::from(c.0) - 1],
            plain => {
                let done = &self.done;
                self.result.rebuilt(plain, |e| done[&(e, mapping)])
            }
        }
    }
}
