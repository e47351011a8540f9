//! An expression graph as functions of POV-Ray: text in which every shared part is computed once. Never recurses; reads no program.
//!
//! The language has no local names, but a function evaluates each of its arguments once. So a part that several others read is an
//! argument of a function of its own, which stands around all that read it: its immediate dominator. Long terms are cut into functions, so
//! that no reader has to nest deeply.

use std::collections::BTreeSet;

use super::operations::{self, Form, HELPERS, number};
use crate::field::expand::reachable;
use crate::field::{Graph, Node, NodeId};
use crate::number::{Binary, Ternary, Unary};

/// Brackets within brackets of one function.
const NESTING: usize = 24;
/// Parameters of one function that POV-Ray takes.
const PARAMETERS: usize = 56;
/// Functions that call functions, well below what POV-Ray takes.
const CALLS: usize = 250;
/// Characters of a line of a declaration, above which it is broken.
const LINE: usize = 140;

/// Why an expression cannot be written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Unwritten {
    /// It needs more values at a time, or functions within functions, than POV-Ray takes.
    TooDeep,
    /// A number in it is infinite or undefined.
    NoNumber,
}

/// What a text reads: x, y and z by 0, 1 and 2, the value of a node by its number above those.
type Free = BTreeSet<u32>;

fn name(free: u32) -> String {
    match free {
        0 => "x".into(),
        1 => "y".into(),
        2 => "z".into(),
        node => format!("n{}", node - 2),
    }
}

fn is_name(words: &str) -> bool {
    words.chars().all(char::is_alphanumeric)
}

fn names(free: &Free) -> String {
    free.iter().map(|free| name(*free)).collect::<Vec<_>>().join(", ")
}

/// A part of the text of an expression.
#[derive(Clone, Debug, Default)]
struct Text {
    words: String,
    free: Free,
    /// Brackets within brackets.
    nesting: usize,
    /// Functions within functions that its value takes.
    calls: usize,
}

impl Text {
    fn word(words: String) -> Self {
        Self { words, ..Self::default() }
    }

    fn reads(free: u32) -> Self {
        Self { words: name(free), free: Free::from([free]), nesting: 0, calls: 0 }
    }

    /// Texts between brackets; `shape` makes the words of theirs.
    fn of(parts: &[Self], words: String) -> Self {
        Self {
            words,
            free: parts.iter().flat_map(|part| part.free.iter().copied()).collect(),
            nesting: 1 + parts.iter().map(|part| part.nesting).max().unwrap_or(0),
            calls: parts.iter().map(|part| part.calls).max().unwrap_or(0),
        }
    }
}

/// Writes functions with names of their own.
pub(super) struct Writer<'a> {
    graph: &'a Graph,
    /// What the names of its functions begin with.
    prefix: &'a str,
    pub(super) declarations: String,
    pub(super) helpers: BTreeSet<&'static str>,
    count: usize,
}

impl<'a> Writer<'a> {
    pub(super) fn new(graph: &'a Graph, prefix: &'a str) -> Self {
        Self { graph, prefix, declarations: String::new(), helpers: BTreeSet::new(), count: 0 }
    }

    /// Declares what the value at a root takes; its text as a function of x, y and z.
    pub(super) fn write(&mut self, root: NodeId) -> Result<String, Unwritten> {
        let plan = Plan::of(self.graph, root);
        let mut texts: Vec<Option<Text>> = vec![None; plan.reached.len()];
        for at in (0..plan.reached.len()).filter(|at| plan.reached[*at]) {
            let id = NodeId(u32::try_from(at).unwrap_or(u32::MAX));
            let text = self.plain(id, &plan, &mut texts)?;
            let text = self.around(text, &plan.bound[at], &mut texts)?;
            let text = if text.nesting >= NESTING { self.function(text)? } else { text };
            texts[at] = Some(text);
        }
        let text = texts[root.index()].take().unwrap_or_default();
        if text.calls > CALLS { Err(Unwritten::TooDeep) } else { Ok(text.words) }
    }

    /// The text of a node, which takes that of its operands, or their names.
    fn plain(&mut self, id: NodeId, plan: &Plan, texts: &mut [Option<Text>]) -> Result<Text, Unwritten> {
        let node = self.graph.node(id);
        let mut parts = Vec::new();
        node.for_each_operand(|e| {
            let is_named = plan.is_named[e.index()];
            // Numbers and coordinates have a text for everyone.
            let is_short = matches!(self.graph.node(e), Node::Constant(_) | Node::Coordinate(_));
            parts.push(match &mut texts[e.index()] {
                _ if is_named => Text::reads(e.0 + 3),
                text if is_short => text.clone().unwrap_or_default(),
                text => text.take().unwrap_or_default(),
            });
        });
        let words: Vec<&str> = parts.iter().map(|part| part.words.as_str()).collect();
        let words = match node {
            Node::Constant(c) if !c.get().is_finite() => return Err(Unwritten::NoNumber),
            Node::Constant(c) => return Ok(Text::word(number(c.get()))),
            Node::Coordinate(c) => return Ok(Text::reads(u32::from(c.0) - 1)),
            // What has a name, or is one, is multiplied by itself; else a function does that.
            Node::Unary(Unary::Powi(2), _) if is_name(words[0]) => format!("({0}*{0})", words[0]),
            Node::Binary(Binary::Mul, a, b) if a == b && !is_name(words[0]) => {
                self.form(operations::unary(Unary::Powi(2)), &words[..1])
            }
            Node::Unary(op, _) => self.form(operations::unary(*op), &words),
            Node::Binary(op, ..) => self.form(operations::binary(*op), &words),
            Node::Ternary(Ternary::Select, [condition, ..]) => {
                // Where a condition is 1 or 0, its complement is negative or 0.
                let abs = if self.is_truth(*condition) { "" } else { "abs" };
                format!("select(-{abs}({}), {}, {})", words[0], words[1], words[2])
            }
            Node::Ternary(op, [.., c]) => {
                let is_set = matches!(op, Ternary::Union | Ternary::Intersection);
                let plain = is_set && self.graph.number(*c) == Some(0.0);
                let taken = if plain { 2 } else { 3 };
                self.form(Form::Call(operations::ternary(*op, plain)), &words[..taken])
            }
            Node::Leaf(..) | Node::Region(..) | Node::Map(..) => return Err(Unwritten::NoNumber),
        };
        Ok(Text::of(&parts, words))
    }

    fn is_truth(&self, id: NodeId) -> bool {
        use Binary::{And, Equal, Less, LessEqual, NotEqual, Or};
        matches!(
            self.graph.node(id),
            Node::Unary(Unary::Not, _) | Node::Binary(Less | LessEqual | Equal | NotEqual | And | Or, ..)
        )
    }

    fn form(&mut self, form: Form, words: &[&str]) -> String {
        match form {
            Form::Prefix(before) => format!("({before}{})", words.concat()),
            Form::Infix(between) => format!("({})", words.join(between)),
            Form::Call(function) => {
                self.need(function);
                format!("{function}({})", words.join(", "))
            }
            Form::CallWith(function, more) => format!("{function}({}, {more})", words.join(", ")),
        }
    }

    /// Notes a helper and those that it calls.
    pub(super) fn need(&mut self, function: &str) {
        let mut open = vec![function];
        while let Some(function) = open.pop() {
            if let Some(helper) = HELPERS.iter().find(|helper| helper.name == function) {
                self.helpers.insert(helper.name);
                open.extend(helper.after);
            }
        }
    }

    /// A text with the values that it names bound around it: those that need no other first, outermost.
    fn around(&mut self, mut text: Text, bound: &[NodeId], texts: &mut [Option<Text>]) -> Result<Text, Unwritten> {
        let mut layers: Vec<Vec<NodeId>> = Vec::new();
        let mut layer_of = std::collections::BTreeMap::new();
        for id in bound {
            let free = texts[id.index()].as_ref().map(|text| &text.free);
            let below = free.into_iter().flatten().filter_map(|free| layer_of.get(free)).max();
            let layer = below.map_or(0, |layer: &usize| layer + 1);
            layer_of.insert(id.0 + 3, layer);
            if layers.len() == layer {
                layers.push(Vec::new());
            }
            layers[layer].push(*id);
        }
        for layer in layers.iter().rev() {
            let body = text;
            let function = self.declare(&body)?;
            let mut parts: Vec<Text> = Vec::new();
            for free in &body.free {
                let of_layer = layer.iter().find(|id| id.0 + 3 == *free);
                let value = of_layer.and_then(|id| texts[id.index()].take());
                parts.push(value.unwrap_or_else(|| Text::reads(*free)));
            }
            text = call(&function, &parts, &body);
        }
        Ok(text)
    }

    /// A text as a function of what it reads, called with that.
    fn function(&mut self, body: Text) -> Result<Text, Unwritten> {
        let function = self.declare(&body)?;
        let parts: Vec<Text> = body.free.iter().map(|free| Text::reads(*free)).collect();
        Ok(call(&function, &parts, &body))
    }

    /// Declares a function whose parameters are what the text reads.
    fn declare(&mut self, body: &Text) -> Result<String, Unwritten> {
        if body.free.len() > PARAMETERS {
            return Err(Unwritten::TooDeep);
        }
        self.count += 1;
        let function = format!("{}_{}", self.prefix, self.count);
        self.declarations += &declaration(&function, &format!("({}) {{ {} }}", names(&body.free), body.words));
        Ok(function)
    }
}

/// A call of a function of that body.
fn call(function: &str, parts: &[Text], body: &Text) -> Text {
    let words: Vec<&str> = parts.iter().map(|part| part.words.as_str()).collect();
    let text = Text::of(parts, format!("{function}({})", words.join(", ")));
    // The arguments are there before the function is called.
    Text { calls: text.calls.max(1 + body.calls), ..text }
}

/// A declaration, on several lines if it is long.
pub(super) fn declaration(function: &str, value: &str) -> String {
    let mut text = format!("#declare {function} = function");
    let mut column = text.len();
    for word in value.split_inclusive(' ') {
        if column + word.len() > LINE {
            text.truncate(text.trim_end().len());
            text += "\n  ";
            column = 2;
        }
        text += word;
        column += word.len();
    }
    text + "\n"
}

/// Which nodes have names, and around which nodes they are bound.
struct Plan {
    reached: Vec<bool>,
    is_named: Vec<bool>,
    /// For each node, those whose immediate dominator it is, in their order.
    bound: Vec<Vec<NodeId>>,
}

impl Plan {
    fn of(graph: &Graph, root: NodeId) -> Self {
        let reached = reachable(graph, root);
        let count = reached.len();
        let mut uses = vec![0usize; count];
        // The immediate dominator of each node, and how deep it stands in their tree. All that reads a node has a larger number.
        let mut dominator: Vec<Option<usize>> = vec![None; count];
        let mut depth = vec![0usize; count];
        for at in (0..count).rev().filter(|at| reached[*at]) {
            depth[at] = dominator[at].map_or(0, |above| depth[above] + 1);
            let node = graph.node(NodeId(u32::try_from(at).unwrap_or(u32::MAX)));
            let squared = matches!(node, Node::Binary(Binary::Mul, a, b) if a == b);
            let mut read = 0;
            node.for_each_operand(|e| {
                let e = e.index();
                read += 1;
                uses[e] += usize::from(!squared || read == 1);
                dominator[e] = Some(match dominator[e] {
                    None => at,
                    Some(known) => meet(known, at, &dominator, &depth),
                });
            });
        }
        let mut is_named = vec![false; count];
        let mut bound = vec![Vec::new(); count];
        for at in (0..count).filter(|at| reached[*at] && uses[*at] > 1) {
            let id = NodeId(u32::try_from(at).unwrap_or(u32::MAX));
            if let (Some(above), false) =
                (dominator[at], matches!(graph.node(id), Node::Constant(_) | Node::Coordinate(_)))
            {
                is_named[at] = true;
                bound[above].push(id);
            }
        }
        Self { reached, is_named, bound }
    }
}

/// Where the ways up from two nodes meet.
fn meet(mut a: usize, mut b: usize, dominator: &[Option<usize>], depth: &[usize]) -> usize {
    while a != b {
        let lower = if depth[a] >= depth[b] { &mut a } else { &mut b };
        match dominator[*lower] {
            Some(above) => *lower = above,
            None => return *lower,
        }
    }
    a
}
