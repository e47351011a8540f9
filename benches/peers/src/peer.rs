//! The same expression for Fidget: our graph, operation by operation, in its context; and its evaluators behind one trait. Times nothing.

use fidget::context::{Context, Node};
use yont::field::{self, Coordinate, Graph, NodeId};
use yont::number::{Binary, Ternary, Unary};

/// An expression of Fidget, negative inside.
pub struct Expression {
    /// Its arena.
    pub context: Context,
    /// The value.
    pub root: Node,
}

impl Expression {
    /// The function at `root`, positive inside, turned to Fidget's sign. R-functions are written as the formula that defines them.
    ///
    /// # Panics
    /// On operations that the works of this bench do not use.
    pub fn of(graph: &Graph, root: NodeId) -> Self {
        let mut context = Context::new();
        let mut made: Vec<Option<Node>> = vec![None; root.index() + 1];
        // Operands stand before what reads them, and nothing that stays unread matters.
        for index in 0..=root.index() {
            made[index] = translate(&mut context, graph.node(NodeId(index as u32)), &made);
        }
        let value = made[root.index()].expect("an operation that the peer has");
        let root = context.neg(value).expect("a node of the context");
        Self { context, root }
    }

    /// An operation list in Fidget's own text form, read by Fidget.
    ///
    /// # Panics
    /// If Fidget refuses the text.
    pub fn read(text: &str) -> Self {
        let (context, root) = Context::from_text(text.as_bytes()).expect("an operation list");
        Self { context, root }
    }
}

fn translate(to: &mut Context, node: &field::Node, made: &[Option<Node>]) -> Option<Node> {
    let operand = |id: &NodeId| made[id.index()];
    Some(match node {
        field::Node::Constant(c) => to.constant(c.get() as f32),
        field::Node::Coordinate(Coordinate(c)) => match c {
            1 => to.x(),
            2 => to.y(),
            3 => to.z(),
            _ => return None,
        },
        field::Node::Unary(op, a) => unary(to, *op, operand(a)?)?,
        field::Node::Binary(op, a, b) => binary(to, *op, operand(a)?, operand(b)?)?,
        field::Node::Ternary(op, [a, b, c]) => ternary(to, *op, operand(a)?, operand(b)?, operand(c)?)?,
        _ => return None,
    })
}

fn unary(to: &mut Context, op: Unary, a: Node) -> Option<Node> {
    match op {
        Unary::Neg => to.neg(a),
        Unary::Abs => to.abs(a),
        Unary::Sqrt => to.sqrt(a),
        Unary::Sin => to.sin(a),
        Unary::Cos => to.cos(a),
        Unary::Exp => to.exp(a),
        Unary::Log => to.ln(a),
        Unary::Powi(n) if n > 0 => return Some(power(to, a, n)),
        _ => return None,
    }
    .ok()
}

/// a to the power n by repeated squaring.
fn power(to: &mut Context, a: Node, n: i32) -> Node {
    let mut result = None;
    for bit in (0..=n.ilog2()).rev() {
        if let Some(r) = result {
            result = to.square(r).ok();
        }
        if n >> bit & 1 == 1 {
            result = Some(result.map_or(a, |r| to.mul(r, a).expect("nodes of the context")));
        }
    }
    result.expect("n is positive")
}

fn binary(to: &mut Context, op: Binary, a: Node, b: Node) -> Option<Node> {
    match op {
        Binary::Add => to.add(a, b),
        Binary::Sub => to.sub(a, b),
        Binary::Mul => to.mul(a, b),
        Binary::Div => to.div(a, b),
        Binary::Min => to.min(a, b),
        Binary::Max => to.max(a, b),
        _ => return None,
    }
    .ok()
}

/// `[P95]` eq. (4): the R-functions with alpha = 0; with alpha = 1 the larger and the smaller.
fn ternary(to: &mut Context, op: Ternary, a: Node, b: Node, alpha: Node) -> Option<Node> {
    let alpha = to.get_const(alpha).ok()?;
    let union = match op {
        Ternary::Union => true,
        Ternary::Intersection => false,
        _ => return None,
    };
    if alpha == 1.0 {
        return if union { to.max(a, b) } else { to.min(a, b) }.ok();
    }
    if alpha != 0.0 {
        return None;
    }
    let (aa, bb) = (to.square(a).ok()?, to.square(b).ok()?);
    let squares = to.add(aa, bb).ok()?;
    let root = to.sqrt(squares).ok()?;
    let sum = to.add(a, b).ok()?;
    if union { to.add(sum, root) } else { to.sub(sum, root) }.ok()
}
