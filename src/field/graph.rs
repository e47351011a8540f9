//! The expression graph: an arena of hash-consed nodes, a function of n coordinates from any of them. Knows no language; a node may
//! carry an opaque origin for underlining.
//!
//! Operands always have smaller numbers than the node that uses them, so every walk is a loop over numbers, never a recursion.

use std::fmt;
use std::hash::{Hash, Hasher};
use std::sync::Arc;

use rustc_hash::FxHashMap;

use super::region::SharedRegion;
use crate::number::{Binary, Real, Ternary, Unary};

/// A node of a [`Graph`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct NodeId(pub u32);

impl NodeId {
    /// As an index into per-node tables.
    #[must_use]
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// A coordinate x1 ... x16, by its number from 1; numbers beyond those stand for what no text names: the variables that a loop changes
/// while it is built, and a parameter by which something is derived. In the graph of a [`super::Region`] they are its parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Coordinate(pub u8);

impl Coordinate {
    /// The largest number.
    pub const MOST: usize = 128;
    /// The largest number that a text can name.
    pub const NAMED: usize = 16;
}

impl fmt::Display for Coordinate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "x{}", self.0)
    }
}

/// Data as a function: a shared leaf, equal to another when their content's fingerprints are.
#[derive(Clone, Debug)]
pub struct SharedLeaf(pub Arc<dyn crate::number::Leaf>);

impl PartialEq for SharedLeaf {
    fn eq(&self, other: &Self) -> bool {
        self.0.fingerprint() == other.0.fingerprint()
    }
}
impl Eq for SharedLeaf {}
impl Hash for SharedLeaf {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.0.fingerprint().hash(state);
    }
}

/// The kinds of node.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Node {
    /// A number.
    Constant(Real),
    /// A coordinate of the point.
    Coordinate(Coordinate),
    /// One operand.
    Unary(Unary, NodeId),
    /// Two operands.
    Binary(Binary, NodeId, NodeId),
    /// Three operands.
    Ternary(Ternary, [NodeId; 3]),
    /// Data at the mapped point: volumes, meshes.
    Leaf(SharedLeaf, Arc<[NodeId]>),
    /// An output, by its number, of a region applied to these arguments.
    Region(SharedRegion, u32, Arc<[NodeId]>),
    /// `body AT (...)`: the body with each listed coordinate replaced, all at once. Sorted by coordinate, each once.
    Map(NodeId, Arc<[(Coordinate, NodeId)]>),
}

impl Node {
    /// Calls `f` with each node that this one reads directly, a map's body included.
    pub fn for_each_operand(&self, mut f: impl FnMut(NodeId)) {
        match self {
            Self::Constant(_) | Self::Coordinate(_) => {}
            Self::Unary(_, a) => f(*a),
            Self::Binary(_, a, b) => {
                f(*a);
                f(*b);
            }
            Self::Ternary(_, [a, b, c]) => {
                f(*a);
                f(*b);
                f(*c);
            }
            Self::Leaf(_, arguments) | Self::Region(_, _, arguments) => arguments.iter().copied().for_each(f),
            Self::Map(body, mapping) => {
                f(*body);
                mapping.iter().for_each(|(_, e)| f(*e));
            }
        }
    }
}

/// Which coordinates a node's value depends on: bit i for x(i+1).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Coordinates(pub u128);

impl Coordinates {
    #[allow(clippy::cast_possible_truncation)]
    const MOST: u8 = Coordinate::MOST as u8;

    /// Just one.
    #[must_use]
    pub fn one(c: Coordinate) -> Self {
        Self(1 << (c.0 - 1))
    }
    /// All of both.
    #[must_use]
    pub fn union(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
    /// Those of `self` that are not in `other`.
    #[must_use]
    pub fn without(self, other: Self) -> Self {
        Self(self.0 & !other.0)
    }
    /// Whether `c` is one of them.
    #[must_use]
    pub fn contains(self, c: Coordinate) -> bool {
        self.0 & (1 << (c.0 - 1)) != 0
    }
    /// Whether one of them is in `other`.
    #[must_use]
    pub fn meets(self, other: Self) -> bool {
        self.0 & other.0 != 0
    }
    /// Whether there is none: a number.
    #[must_use]
    pub fn is_empty(self) -> bool {
        self.0 == 0
    }
    /// In ascending order.
    pub fn iter(self) -> impl Iterator<Item = Coordinate> {
        (1..=Self::MOST).map(Coordinate).filter(move |c| self.contains(*c))
    }
}

/// The arena. Nodes are never removed; equal nodes are one.
#[derive(Clone, Debug, Default)]
pub struct Graph {
    nodes: Vec<Node>,
    coordinates: Vec<Coordinates>,
    numbers: FxHashMap<Node, NodeId>,
}

impl Graph {
    /// An empty graph.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Number of nodes.
    #[must_use]
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Whether it has no node.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// The node with that number.
    ///
    /// # Panics
    /// If `id` is of another graph.
    #[must_use]
    pub fn node(&self, id: NodeId) -> &Node {
        &self.nodes[id.index()]
    }

    /// The coordinates that the value at `id` depends on.
    #[must_use]
    pub fn coordinates(&self, id: NodeId) -> Coordinates {
        self.coordinates[id.index()]
    }

    /// All nodes, by number.
    #[must_use]
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// The value if the node is a number.
    #[must_use]
    pub fn number(&self, id: NodeId) -> Option<f64> {
        match self.node(id) {
            Node::Constant(c) => Some(c.get()),
            _ => None,
        }
    }

    /// The node, made if it is new. No simplification: see `build`.
    ///
    /// # Panics
    /// At 2^32 nodes; `Limits::graph_nodes` stands far below.
    pub fn intern(&mut self, node: Node) -> NodeId {
        if let Some(&id) = self.numbers.get(&node) {
            return id;
        }
        let id = NodeId(u32::try_from(self.nodes.len()).expect("Limits::graph_nodes is below 2^32"));
        self.coordinates.push(self.coordinates_of(&node));
        self.nodes.push(node.clone());
        self.numbers.insert(node, id);
        id
    }

    fn coordinates_of(&self, node: &Node) -> Coordinates {
        let mut all = Coordinates::default();
        match node {
            Node::Coordinate(c) => return Coordinates::one(*c),
            Node::Map(body, mapping) => {
                let inner = self.coordinates(*body);
                all = mapping.iter().fold(inner, |rest, (c, _)| rest.without(Coordinates::one(*c)));
                for (c, e) in mapping.iter() {
                    if inner.contains(*c) {
                        all = all.union(self.coordinates(*e));
                    }
                }
            }
            _ => node.for_each_operand(|e| all = all.union(self.coordinates(e))),
        }
        all
    }
}
