//! Builds expression graphs: `Graph` as an [`Algebra`]. Constants are folded and nodes simplified, but only where no bit of a result
//! changes (the sign of an undefined value apart). Never reorders a sum, never assumes that a value is defined or finite.

use std::sync::Arc;

use rustc_hash::FxHashMap;

use super::graph::{Coordinate, Graph, Node, NodeId, SharedLeaf};
use crate::number::{Algebra, Binary, Real, Ternary, Unary};

impl Algebra for Graph {
    type Number = NodeId;

    fn constant(&mut self, value: f64) -> NodeId {
        self.intern(Node::Constant(Real::new(value)))
    }

    fn unary(&mut self, op: Unary, a: NodeId) -> NodeId {
        if let Some(value) = self.number(a) {
            return self.constant(op.real(value));
        }
        match (op, self.node(a)) {
            (Unary::Powi(1), _) => a,
            (Unary::Neg, &Node::Unary(Unary::Neg, inner)) => inner,
            (Unary::Abs, &Node::Unary(Unary::Neg, inner)) => self.unary(Unary::Abs, inner),
            (Unary::Powi(n), &Node::Unary(Unary::Neg | Unary::Abs, inner)) if n % 2 == 0 => self.unary(op, inner),
            (Unary::Abs, &Node::Unary(Unary::Abs, _)) => a,
            (Unary::Floor | Unary::Ceil | Unary::Round, &Node::Unary(Unary::Floor | Unary::Ceil | Unary::Round, _)) => {
                a
            }
            _ => self.intern(Node::Unary(op, a)),
        }
    }

    fn binary(&mut self, op: Binary, a: NodeId, b: NodeId) -> NodeId {
        match (self.number(a), self.number(b)) {
            (Some(x), Some(y)) => self.constant(op.real(x, y)),
            (Some(x), None) => self.left_constant(op, x, a, b),
            (None, Some(y)) => self.right_constant(op, a, y, b),
            (None, None) => self.two_operands(op, a, b),
        }
    }

    fn ternary(&mut self, op: Ternary, a: NodeId, b: NodeId, c: NodeId) -> NodeId {
        match (op, self.number(a), self.number(b), self.number(c)) {
            (_, Some(x), Some(y), Some(z)) => self.constant(op.real(x, y, z)),
            (Ternary::Select, Some(x), ..) => {
                if is_true(x) {
                    b
                } else {
                    c
                }
            }
            (Ternary::Select, ..) if b == c => b,
            (Ternary::Union, _, _, Some(1.0)) => self.binary(Binary::Max, a, b),
            (Ternary::Intersection, _, _, Some(1.0)) => self.binary(Binary::Min, a, b),
            _ => self.intern(Node::Ternary(op, [a, b, c])),
        }
    }
}

/// Whether a number counts as true: neither 0 nor undefined.
#[must_use]
pub fn is_true(value: f64) -> bool {
    value != 0.0 && !value.is_nan()
}

impl Graph {
    /// The coordinate as a node.
    pub fn coordinate(&mut self, c: Coordinate) -> NodeId {
        self.intern(Node::Coordinate(c))
    }

    /// Data at the point with these arguments, one per axis of the leaf; a number where all of them are.
    pub fn leaf(&mut self, leaf: SharedLeaf, arguments: &[NodeId]) -> NodeId {
        let numbers: Option<Vec<f64>> = arguments.iter().map(|a| self.number(*a)).collect();
        match numbers {
            Some(at) => {
                let value = leaf.0.value(&at);
                self.constant(value)
            }
            None => self.intern(Node::Leaf(leaf, arguments.into())),
        }
    }

    /// A node of any graph, with its operands replaced by nodes of this one.
    pub fn rebuilt(&mut self, node: &Node, operand: impl Fn(NodeId) -> NodeId) -> NodeId {
        match node {
            Node::Constant(c) => self.constant(c.get()),
            Node::Coordinate(c) => self.coordinate(*c),
            Node::Unary(op, a) => self.unary(*op, operand(*a)),
            Node::Binary(op, a, b) => self.binary(*op, operand(*a), operand(*b)),
            Node::Ternary(op, [a, b, c]) => self.ternary(*op, operand(*a), operand(*b), operand(*c)),
            Node::Leaf(leaf, arguments) => {
                let arguments: Vec<NodeId> = arguments.iter().map(|a| operand(*a)).collect();
                self.leaf(leaf.clone(), &arguments)
            }
            Node::Region(region, output, arguments) => {
                let arguments = arguments.iter().map(|a| operand(*a)).collect();
                self.intern(Node::Region(region.clone(), *output, arguments))
            }
            Node::Map(body, mapping) => {
                let mapping: Vec<(Coordinate, NodeId)> = mapping.iter().map(|(c, e)| (*c, operand(*e))).collect();
                self.map(operand(*body), &mapping)
            }
        }
    }

    /// A node of another graph, with all that it reads, in this one; `known` says which nodes are here already, and what they are.
    pub fn copied(&mut self, from: &Self, root: NodeId, known: &mut FxHashMap<NodeId, NodeId>) -> NodeId {
        let mut open = vec![root];
        while let Some(&node) = open.last() {
            if known.contains_key(&node) {
                open.pop();
                continue;
            }
            let before = open.len();
            from.node(node).for_each_operand(|operand| {
                if !known.contains_key(&operand) {
                    open.push(operand);
                }
            });
            if open.len() == before {
                open.pop();
                let made = self.rebuilt(from.node(node), |operand| known[&operand]);
                known.insert(node, made);
            }
        }
        known[&root]
    }

    /// `body AT (mapping)`: each listed coordinate replaced by its expression, all at once. A coordinate that is listed twice takes
    /// its last expression; those that the body does not use, and those that stay what they are, are dropped.
    pub fn map(&mut self, body: NodeId, mapping: &[(Coordinate, NodeId)]) -> NodeId {
        let used = self.coordinates(body);
        let mut table = [None; Coordinate::MOST];
        for &(c, e) in mapping.iter().filter(|(c, _)| used.contains(*c)) {
            table[usize::from(c.0) - 1] = Some(e);
        }
        let kept: Arc<[(Coordinate, NodeId)]> = used
            .iter()
            .filter_map(|c| table[usize::from(c.0) - 1].map(|e| (c, e)))
            .filter(|(c, e)| *self.node(*e) != Node::Coordinate(*c))
            .collect();
        match (kept.first(), self.node(body)) {
            (None, _) => body,
            (Some(&(_, e)), Node::Coordinate(_)) => e,
            _ => self.intern(Node::Map(body, kept)),
        }
    }

    /// `constant op b`, where b is no number.
    fn left_constant(&mut self, op: Binary, x: f64, a: NodeId, b: NodeId) -> NodeId {
        match op {
            Binary::Add | Binary::Mul => self.right_constant(op, b, x, a),
            Binary::And if !is_true(x) => self.constant(0.0),
            Binary::Or if is_true(x) => self.constant(1.0),
            Binary::And | Binary::Or if self.is_truth(b) => b,
            Binary::Sub if is_zero(x, true) => self.unary(Unary::Neg, b),
            _ => self.intern(Node::Binary(op, a, b)),
        }
    }

    /// `a op constant`, where a is no number.
    fn right_constant(&mut self, op: Binary, a: NodeId, y: f64, b: NodeId) -> NodeId {
        match op {
            Binary::Add if is_zero(y, true) => a,
            Binary::Sub if is_zero(y, false) => a,
            Binary::Mul | Binary::Div if y == 1.0 => a,
            Binary::Mul | Binary::Div if y == -1.0 => self.unary(Unary::Neg, a),
            Binary::Div if has_exact_inverse(y) => {
                let inverse = self.constant(1.0 / y);
                self.intern(Node::Binary(Binary::Mul, a, inverse))
            }
            Binary::Pow if y == 1.0 => a,
            Binary::And if !is_true(y) => self.constant(0.0),
            Binary::Or if is_true(y) => self.constant(1.0),
            Binary::And | Binary::Or if self.is_truth(a) => a,
            _ => self.intern(Node::Binary(op, a, b)),
        }
    }

    fn two_operands(&mut self, op: Binary, a: NodeId, b: NodeId) -> NodeId {
        let negated = |id: NodeId| match self.node(id) {
            Node::Unary(Unary::Neg, inner) => Some(*inner),
            _ => None,
        };
        match (op, negated(a), negated(b)) {
            (Binary::Min | Binary::Max, ..) if a == b => a,
            (Binary::Add, _, Some(y)) => self.intern(Node::Binary(Binary::Sub, a, y)),
            (Binary::Add, Some(x), None) => self.intern(Node::Binary(Binary::Sub, b, x)),
            (Binary::Sub, _, Some(y)) => self.binary(Binary::Add, a, y),
            (Binary::Mul | Binary::Div, Some(x), Some(y)) => self.binary(op, x, y),
            (Binary::Add | Binary::Mul, ..) if a > b => self.intern(Node::Binary(op, b, a)),
            _ => self.intern(Node::Binary(op, a, b)),
        }
    }

    /// Whether the node's value is always 1 or 0.
    fn is_truth(&self, id: NodeId) -> bool {
        use Binary::{And, Equal, Less, LessEqual, NotEqual, Or};
        matches!(
            self.node(id),
            Node::Unary(Unary::Not, _) | Node::Binary(Less | LessEqual | Equal | NotEqual | And | Or, ..)
        )
    }
}

/// Whether `value` is the zero of that sign.
fn is_zero(value: f64, negative: bool) -> bool {
    value == 0.0 && value.is_sign_negative() == negative
}

/// Whether `value` is a power of two whose inverse is exact, so that a division by it is a multiplication.
fn has_exact_inverse(value: f64) -> bool {
    let mantissa = value.to_bits() & ((1 << 52) - 1);
    let exponent = (value.to_bits() >> 52) & 0x7ff;
    mantissa == 0 && (2..=2044).contains(&exponent)
}
