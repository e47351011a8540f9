//! What an expression is worth: a number, a function of the coordinates, an array, a text or a function. Values say nothing of
//! where they came from.

use std::fmt::Write as _;
use std::sync::Arc;

use crate::field::{Coordinates, Graph, NodeId};
use crate::number::{Algebra, Binary, Reals, Ternary, Unary};
use crate::syntax::tree::{Name, Parameter};
use crate::vm::reference;

use super::definition::Definition;

/// A number, or a function of the coordinates as a node of the session's graph.
///
/// Numbers stay out of the graph, so that a loop may count to a million without leaving a million nodes behind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Scalar {
    /// A number.
    Number(f64),
    /// A node that is not a constant.
    Node(NodeId),
}

impl Scalar {
    /// The number, if it is one.
    #[must_use]
    pub fn number(self) -> Option<f64> {
        match self {
            Self::Number(value) => Some(value),
            Self::Node(_) => None,
        }
    }

    /// The scalar as a node; a number becomes a constant.
    pub fn node(self, graph: &mut Graph) -> NodeId {
        match self {
            Self::Number(value) => graph.constant(value),
            Self::Node(id) => id,
        }
    }

    /// The coordinates that it depends on.
    #[must_use]
    pub fn coordinates(self, graph: &Graph) -> Coordinates {
        match self {
            Self::Number(_) => Coordinates::default(),
            Self::Node(id) => graph.coordinates(id),
        }
    }

    /// A node as a scalar: what depends on no coordinate becomes a number, such as an object at a point.
    #[must_use]
    pub fn of(graph: &Graph, id: NodeId) -> Self {
        match graph.number(id) {
            Some(value) => Self::Number(value),
            None if graph.coordinates(id).is_empty() => Self::Number(reference::eval(&mut Reals, graph, id, &[])),
            None => Self::Node(id),
        }
    }
}

/// Numbers where all operands are numbers, nodes of the graph elsewhere.
pub struct Scalars<'a>(pub &'a mut Graph);

impl Algebra for Scalars<'_> {
    type Number = Scalar;

    fn constant(&mut self, value: f64) -> Scalar {
        Scalar::Number(value)
    }

    fn unary(&mut self, op: Unary, a: Scalar) -> Scalar {
        match a {
            Scalar::Number(a) => Scalar::Number(op.real(a)),
            Scalar::Node(a) => {
                let id = self.0.unary(op, a);
                Scalar::of(self.0, id)
            }
        }
    }

    fn binary(&mut self, op: Binary, a: Scalar, b: Scalar) -> Scalar {
        if let (Scalar::Number(a), Scalar::Number(b)) = (a, b) {
            return Scalar::Number(op.real(a, b));
        }
        let (a, b) = (a.node(self.0), b.node(self.0));
        let id = self.0.binary(op, a, b);
        Scalar::of(self.0, id)
    }

    fn ternary(&mut self, op: Ternary, a: Scalar, b: Scalar, c: Scalar) -> Scalar {
        if let (Scalar::Number(a), Scalar::Number(b), Scalar::Number(c)) = (a, b, c) {
            return Scalar::Number(op.real(a, b, c));
        }
        let (a, b, c) = (a.node(self.0), b.node(self.0), c.node(self.0));
        let id = self.0.ternary(op, a, b, c);
        Scalar::of(self.0, id)
    }
}

/// An array; its elements may be arrays.
#[derive(Clone, Debug)]
pub struct Array {
    items: Vec<Value>,
    depth: u16,
    elements: usize,
}

/// Arrays within arrays, at most so many levels.
pub const ARRAY_DEPTH: u16 = 64;

impl Array {
    /// The array of these items, none of them a text or a function.
    #[must_use]
    pub fn new(items: Vec<Value>) -> Self {
        let (mut depth, mut elements) = (1, 0_usize);
        for item in &items {
            match item {
                Value::Array(inner) => {
                    depth = depth.max(inner.depth.saturating_add(1));
                    elements = elements.saturating_add(inner.elements);
                }
                _ => elements = elements.saturating_add(1),
            }
        }
        Self { items, depth, elements }
    }

    /// The items.
    #[must_use]
    pub fn items(&self) -> &[Value] {
        &self.items
    }

    /// Levels of nesting: 1 for a plain array.
    #[must_use]
    pub fn depth(&self) -> u16 {
        self.depth
    }

    /// Elements of all levels.
    #[must_use]
    pub fn elements(&self) -> usize {
        self.elements
    }

    /// Puts a value in the place of another.
    pub fn set(&mut self, index: usize, value: Value) {
        let plain = !matches!(value, Value::Array(_)) && !matches!(self.items[index], Value::Array(_));
        self.items[index] = value;
        if !plain {
            self.recount();
        }
    }

    /// The item at `index` for changing it in place; [`Array::recount`] must follow.
    pub fn item_mut(&mut self, index: usize) -> &mut Value {
        &mut self.items[index]
    }

    /// Counts levels and elements anew.
    pub fn recount(&mut self) {
        *self = Self::new(std::mem::take(&mut self.items));
    }
}

/// A function that the user wrote.
#[derive(Debug)]
pub struct Function {
    /// The definition that it stands in.
    pub definition: Arc<Definition>,
    /// Its own name.
    pub name: Name,
    /// For a function that is defined inside a body.
    pub local: Option<LocalFunction>,
}

/// A function defined inside a body, with the values that its body sees.
#[derive(Debug)]
pub struct LocalFunction {
    /// The statement of the function.
    pub statement: Arc<crate::syntax::tree::Statement>,
    /// The names around it and their values when it was defined.
    pub captured: Vec<(Name, Value)>,
    /// The system of R-functions in force there.
    pub system: Active,
    /// How many functions lie captured within each other.
    pub depth: usize,
}

impl Function {
    /// The statement that defines it.
    #[must_use]
    pub fn statement(&self) -> &crate::syntax::tree::Statement {
        self.local.as_ref().map_or(&self.definition.statement, |l| &l.statement)
    }

    /// Its parameters.
    #[must_use]
    pub fn parameters(&self) -> &[Parameter] {
        match &self.statement().kind {
            crate::syntax::tree::StatementKind::Define { parameters: Some(parameters), .. } => parameters,
            _ => &[],
        }
    }

    /// `name(p, q)` as the user wrote it.
    #[must_use]
    pub fn signature(&self) -> String {
        let names: Vec<&str> = self.parameters().iter().map(|p| &*p.name.name).collect();
        format!("{}({})", self.name, names.join(", "))
    }
}

/// The system of R-functions in force, evaluated: \[P95\] eq. (2) with its alpha, or eq. (5) with its m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum System {
    /// `r_alpha`
    Alpha(Scalar),
    /// `r_m`, at least 1
    Smooth(f64),
}

/// The system of R-functions where an evaluation stands.
#[derive(Clone, Debug)]
pub enum Active {
    /// As set by that statement; not looked up before an operator needs it.
    InForce(super::definition::SystemInForce),
    /// Known.
    Is(System),
}

/// What an expression is worth.
#[derive(Clone, Debug)]
pub enum Value {
    /// A number or a function of the coordinates.
    Scalar(Scalar),
    /// An array.
    Array(Arc<Array>),
    /// A text.
    Text(Arc<str>),
    /// A function of the user's.
    Function(Arc<Function>),
}

impl Value {
    /// A number.
    #[must_use]
    pub fn number(value: f64) -> Self {
        Self::Scalar(Scalar::Number(value))
    }

    /// What messages call this kind of value, with its article.
    #[must_use]
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Scalar(Scalar::Number(_)) => "a number",
            Self::Scalar(Scalar::Node(_)) => "a function of the coordinates",
            Self::Array(_) => "an array",
            Self::Text(_) => "a text",
            Self::Function(_) => "a function with parameters",
        }
    }

    /// The node of a scalar that is no constant number.
    #[must_use]
    pub fn varying(&self) -> Option<NodeId> {
        if let Self::Scalar(Scalar::Node(node)) = self { Some(*node) } else { None }
    }

    /// The coordinates that it depends on.
    #[must_use]
    pub fn coordinates(&self, graph: &Graph) -> Coordinates {
        match self {
            Self::Scalar(s) => s.coordinates(graph),
            Self::Array(a) => a.items().iter().fold(Coordinates::default(), |all, v| all.union(v.coordinates(graph))),
            Self::Text(_) | Self::Function(_) => Coordinates::default(),
        }
    }

    /// Whether two values are the same: numbers by their bits, nodes by their identity, functions by where they stand.
    #[must_use]
    pub fn same(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Scalar(Scalar::Number(a)), Self::Scalar(Scalar::Number(b))) => a.to_bits() == b.to_bits(),
            (Self::Scalar(a), Self::Scalar(b)) => a == b,
            (Self::Array(a), Self::Array(b)) => {
                Arc::ptr_eq(a, b)
                    || (a.items().len() == b.items().len() && a.items().iter().zip(b.items()).all(|(a, b)| a.same(b)))
            }
            (Self::Text(a), Self::Text(b)) => a == b,
            (Self::Function(a), Self::Function(b)) => Arc::ptr_eq(a, b) || a.definition.id == b.definition.id,
            _ => false,
        }
    }

    /// The value in one line, as PRINT and the prompt show it.
    #[must_use]
    pub fn show(&self, graph: &Graph) -> String {
        let mut out = String::new();
        self.write(graph, &mut out);
        out
    }

    fn write(&self, graph: &Graph, out: &mut String) {
        match self {
            Self::Scalar(Scalar::Number(value)) => out.push_str(&number(*value)),
            Self::Scalar(Scalar::Node(id)) => {
                let names: Vec<String> = graph.coordinates(*id).iter().map(|c| c.to_string()).collect();
                let _ = write!(out, "function of {}", names.join(", "));
            }
            Self::Array(array) => write_array(array, graph, out),
            Self::Text(text) => out.push_str(text),
            Self::Function(f) => {
                let _ = write!(out, "function {}", f.signature());
            }
        }
    }
}

/// Items of an array that are shown before the rest is only counted.
const SHOWN: usize = 100;

fn write_array(array: &Array, graph: &Graph, out: &mut String) {
    out.push('[');
    for (i, item) in array.items().iter().enumerate() {
        if i > 0 {
            out.push_str(", ");
        }
        if i == SHOWN {
            let _ = write!(out, "... {} more", array.items().len() - SHOWN);
            break;
        }
        item.write(graph, out);
    }
    out.push(']');
}

/// A number in the shortest digits that read back the same; `undefined` for NaN.
#[must_use]
pub fn number(value: f64) -> String {
    if value.is_nan() {
        return "undefined".to_owned();
    }
    if value.is_infinite() {
        return if value > 0.0 { "infinity" } else { "-infinity" }.to_owned();
    }
    let size = value.abs();
    if size != 0.0 && !(1e-5..1e16).contains(&size) { format!("{value:e}") } else { format!("{value}") }
}
