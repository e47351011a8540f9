//! Nodes of a graph as pieces of text, each with the level of its outermost operator, joined with as few brackets as the grammar needs.
//! Never recurses: operands come before what reads them.

use std::collections::BTreeSet;

use rustc_hash::FxHashMap;

use super::{InForce, in_force};
use crate::builtins::{self, Meaning};
use crate::field::{Coordinate, Graph, Node, NodeId, SharedLeaf};
use crate::number::{Binary, Ternary, Unary};

/// Bytes up to which a part that is read twice is written twice.
const SHORT: usize = 12;
/// Brackets within brackets from which a part gets a name: the parser counts them.
const DEEP: usize = 100;

/// How tightly the outermost operator of a text binds, loosest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Level {
    If,
    Or,
    And,
    Not,
    Compare,
    Union,
    Intersect,
    Sum,
    Product,
    Sign,
    Power,
    Postfix,
}

#[derive(Clone, Debug)]
struct Part {
    text: String,
    level: Level,
    /// Brackets within brackets.
    depth: usize,
    /// A call that takes one more argument: `MAX(a, b)`.
    fold: Option<Binary>,
}

impl Part {
    fn new(level: Level, text: String, depth: usize) -> Self {
        Self { text, level, depth, fold: None }
    }

    /// The part as an operand of something that takes `level` or tighter.
    fn within(mut self, level: Level) -> Self {
        if self.level < level {
            self.text.insert(0, '(');
            self.text.push(')');
            self.depth += 1;
            self.level = Level::Postfix;
        }
        self
    }
}

/// The words for a leaf: its call as far as the file.
type Leaves<'a> = Box<dyn Fn(&SharedLeaf) -> Option<String> + 'a>;

/// Writes nodes in ascending order.
pub(super) struct Writer<'a> {
    graph: &'a Graph,
    uses: FxHashMap<NodeId, usize>,
    main: Option<InForce>,
    leaves: Leaves<'a>,
    /// The coordinates that no text names, each with one that the nodes do not use.
    renamed: FxHashMap<Coordinate, Coordinate>,
    parts: FxHashMap<NodeId, Part>,
    bindings: Vec<(String, String)>,
    rewritten: bool,
}

impl<'a> Writer<'a> {
    /// `uses` counts how often each node is read, and as a root.
    pub(super) fn new(
        graph: &'a Graph,
        uses: FxHashMap<NodeId, usize>,
        main: Option<InForce>,
        leaves: impl Fn(&SharedLeaf) -> Option<String> + 'a,
    ) -> Self {
        let (parts, bindings) = Default::default();
        let renamed = renamed(graph, uses.keys());
        Self { graph, uses, main, leaves: Box::new(leaves), renamed, parts, bindings, rewritten: false }
    }

    /// The names that were given to parts, in their order, and whether an operation was written out.
    pub(super) fn finish(self) -> (Vec<(String, String)>, bool) {
        (self.bindings, self.rewritten)
    }

    /// The text of a node for something that takes `level` or tighter.
    pub(super) fn take(&mut self, id: NodeId, level: Level) -> String {
        self.operand(id, level).text
    }

    /// Writes a node whose operands have been written.
    ///
    /// # Errors
    /// Words that say what the language has no expression for.
    pub(super) fn add(&mut self, id: NodeId) -> Result<(), String> {
        let part = self.part(id)?;
        let shared = self.uses.get(&id).is_some_and(|&uses| uses > 1) && part.text.len() > SHORT;
        let part = if shared || part.depth > DEEP { self.named(part.text) } else { part };
        self.parts.insert(id, part);
        Ok(())
    }

    fn named(&mut self, text: String) -> Part {
        let name = format!("q{}", self.bindings.len() + 1);
        self.bindings.push((name.clone(), text));
        Part::new(Level::Postfix, name, 0)
    }

    fn operand(&mut self, id: NodeId, level: Level) -> Part {
        let left = self.uses.get_mut(&id).map_or(0, |uses| {
            *uses = uses.saturating_sub(1);
            *uses
        });
        let part = if left == 0 { self.parts.remove(&id) } else { self.parts.get(&id).cloned() };
        part.unwrap_or_else(|| Part::new(Level::Postfix, String::new(), 0)).within(level)
    }

    /// An operand that will be written several times.
    fn short(&mut self, id: NodeId) -> String {
        let part = self.operand(id, Level::Postfix);
        if part.text.len() > SHORT { self.named(part.text).text } else { part.text }
    }

    fn part(&mut self, id: NodeId) -> Result<Part, String> {
        let graph = self.graph;
        Ok(match graph.node(id) {
            Node::Constant(value) => {
                let text = number(value.get());
                let level = if text.starts_with('-') { Level::Sign } else { Level::Postfix };
                Part::new(level, text, 0)
            }
            Node::Coordinate(c) => Part::new(Level::Postfix, self.coordinate(*c)?, 0),
            Node::Unary(op, a) => self.unary(*op, *a),
            Node::Binary(op, a, b) => self.binary(*op, *a, *b),
            Node::Ternary(op, [a, b, c]) => self.ternary(*op, *a, *b, *c),
            Node::Leaf(leaf, arguments) => {
                let words = (self.leaves)(leaf).ok_or("it holds data without a file")?;
                self.call(&format!("{words}, "), arguments)
            }
            Node::Map(body, mapping) => self.map(*body, mapping)?,
            Node::Region(..) => return Err("a part of it searches or runs a loop at each point".into()),
        })
    }

    fn unary(&mut self, op: Unary, a: NodeId) -> Part {
        match op {
            Unary::Neg => self.prefixed("-", a, Level::Sign),
            Unary::Not => self.prefixed("NOT ", a, Level::Not),
            Unary::Powi(n) => {
                let base = self.operand(a, Level::Postfix);
                Part::new(Level::Power, format!("{}**{n}", base.text), base.depth)
            }
            _ => self.call(&format!("{}(", name_of(|meaning| matches!(meaning, Meaning::Unary(o) if o == op))), &[a]),
        }
    }

    fn prefixed(&mut self, sign: &str, a: NodeId, level: Level) -> Part {
        let mut part = self.operand(a, level);
        part.text.insert_str(0, sign);
        Part::new(level, part.text, part.depth)
    }

    fn binary(&mut self, op: Binary, a: NodeId, b: NodeId) -> Part {
        use Level::{And, Compare, Or, Product, Sign, Sum};
        match op {
            Binary::Add => match self.graph.number(b).filter(|value| value.is_sign_negative() && *value != 0.0) {
                Some(value) => self.less(a, -value),
                None => self.commuting(a, b, " + ", (Sum, Product)),
            },
            Binary::Sub => self.joined(a, b, " - ", Sum, Product),
            Binary::Mul => self.commuting(a, b, "*", (Product, Sign)),
            Binary::Div => self.joined(a, b, "/", Product, Sign),
            Binary::And => self.joined(a, b, " AND ", And, Level::Not),
            Binary::Or => self.joined(a, b, " OR ", Or, And),
            Binary::Less => self.compared(a, b, " < "),
            Binary::LessEqual => self.compared(a, b, " <= "),
            Binary::Equal => self.compared(a, b, " == "),
            Binary::NotEqual => self.compared(a, b, " <> "),
            Binary::Pow if self.graph.number(b).is_none_or(|value| value.fract() != 0.0) => {
                let (base, power) = (self.operand(a, Level::Postfix), self.operand(b, Level::Postfix));
                Part::new(Level::Power, format!("{}**{}", base.text, power.text), base.depth.max(power.depth))
            }
            Binary::Min | Binary::Max | Binary::Hypot => self.folded(op, a, b),
            Binary::Pow | Binary::Atan2 | Binary::Mod => {
                let name = name_of(|meaning| matches!(meaning, Meaning::Binary(o) if o == op));
                let part = self.call(&format!("{name}("), &[a, b]);
                debug_assert!(part.level > Compare);
                part
            }
        }
    }

    /// `a op b`, left to right: `first` is the level of the operator, `second` that of its right operand.
    fn joined(&mut self, a: NodeId, b: NodeId, op: &str, first: Level, second: Level) -> Part {
        let (mut left, right) = (self.operand(a, first), self.operand(b, second));
        left.text += op;
        left.text += &right.text;
        Part::new(first, left.text, left.depth.max(right.depth))
    }

    /// The same where the operands may change places: a chain goes to the left, where it needs no brackets.
    fn commuting(&mut self, a: NodeId, b: NodeId, op: &str, (first, second): (Level, Level)) -> Part {
        let level = |writer: &Self, id: NodeId| writer.parts.get(&id).map(|part| part.level);
        let swap = level(self, b) == Some(first) && level(self, a) != Some(first);
        let (a, b) = if swap { (b, a) } else { (a, b) };
        self.joined(a, b, op, first, second)
    }

    /// `a - value`.
    fn less(&mut self, a: NodeId, value: f64) -> Part {
        let mut left = self.operand(a, Level::Sum);
        left.text += &format!(" - {}", number(value));
        Part::new(Level::Sum, left.text, left.depth)
    }

    /// A comparison. Set operations in it get brackets, since `a < b & c < d` is refused.
    fn compared(&mut self, a: NodeId, b: NodeId, op: &str) -> Part {
        let part = self.joined(a, b, op, Level::Sum, Level::Sum);
        Part { level: Level::Compare, ..part }
    }

    /// `MAX(a, b, c)`: from left to right, so that a chain is one call.
    fn folded(&mut self, op: Binary, a: NodeId, b: NodeId) -> Part {
        let open = self.parts.get(&a).is_some_and(|part| part.fold == Some(op));
        let mut part = if open {
            let (mut left, right) = (self.operand(a, Level::If), self.operand(b, Level::If));
            left.text.pop();
            left.text += &format!(", {})", right.text);
            Part::new(Level::Postfix, left.text, left.depth.max(right.depth + 1))
        } else {
            let name = name_of(|meaning| matches!(meaning, Meaning::Fold(o) if o == op));
            self.call(&format!("{name}("), &[a, b])
        };
        part.fold = Some(op);
        part
    }

    fn call(&mut self, open: &str, arguments: &[NodeId]) -> Part {
        let parts: Vec<Part> = arguments.iter().map(|a| self.operand(*a, Level::If)).collect();
        let depth = parts.iter().map(|part| part.depth).max().unwrap_or(0) + 1;
        let texts: Vec<String> = parts.into_iter().map(|part| part.text).collect();
        Part::new(Level::Postfix, format!("{open}{})", texts.join(", ")), depth)
    }

    fn ternary(&mut self, op: Ternary, a: NodeId, b: NodeId, c: NodeId) -> Part {
        if op == Ternary::Select {
            return self.choice(a, b, c);
        }
        if op == Ternary::Norm {
            return self.call("PNORM(", &[a, b, c]);
        }
        let union = matches!(op, Ternary::Union | Ternary::UnionSmooth);
        if in_force(op, self.graph.number(c)).is_none_or(|system| Some(system) != self.main) {
            return self.written_out(op, union, (a, b), c);
        }
        // The parameter is not written, but it was counted.
        self.operand(c, Level::If);
        if union {
            return self.joined(a, b, " | ", Level::Union, Level::Intersect);
        }
        let is_complement = |part: &Part| part.level == Level::Sign && part.text.starts_with('-');
        let complement = self.parts.get(&b).is_some_and(is_complement);
        if !complement {
            return self.joined(a, b, " & ", Level::Intersect, Level::Sum);
        }
        let right = self.operand(b, Level::Sign);
        let left = self.operand(a, Level::Union);
        Part::new(Level::Union, format!("{} \\ {}", left.text, &right.text[1..]), left.depth.max(right.depth))
    }

    fn choice(&mut self, condition: NodeId, then: NodeId, otherwise: NodeId) -> Part {
        let undefined = self.graph.number(otherwise).is_some_and(f64::is_nan);
        let (c, a) = (self.operand(condition, Level::Or), self.operand(then, Level::Or));
        let b = self.operand(otherwise, Level::If);
        let depth = c.depth.max(a.depth).max(b.depth);
        let text = format!("IF {} THEN {}", c.text, a.text);
        Part::new(Level::If, if undefined { text } else { format!("{text} ELSE {}", b.text) }, depth + 1)
    }

    /// A set operation of another system than the one that the definition sets, by \[P95\] equations (2) and (5).
    fn written_out(&mut self, op: Ternary, union: bool, (a, b): (NodeId, NodeId), c: NodeId) -> Part {
        self.rewritten = true;
        let (f, g, p) = (self.short(a), self.short(b), self.short(c));
        let sign = if union { '+' } else { '-' };
        let text = match op {
            Ternary::Union | Ternary::Intersection => {
                format!("({f} + {g} {sign} SQRT({f}**2 + {g}**2 - 2*{p}*{f}*{g}))/(1 + {p})")
            }
            _ => format!("({f} + {g} {sign} SQRT({f}**2 + {g}**2))*({f}**2 + {g}**2)**({p}/2)"),
        };
        Part::new(Level::Product, text, 3)
    }

    /// The name of a coordinate.
    fn coordinate(&self, c: Coordinate) -> Result<String, String> {
        match self.renamed.get(&c) {
            Some(name) => Ok(name.to_string()),
            None if usize::from(c.0) > Coordinate::NAMED => Err("it moves more coordinates than have names".into()),
            None => Ok(c.to_string()),
        }
    }

    fn map(&mut self, body: NodeId, mapping: &[(Coordinate, NodeId)]) -> Result<Part, String> {
        let body = self.operand(body, Level::Postfix);
        let mut depth = body.depth;
        let mut named = Vec::with_capacity(mapping.len());
        for (c, e) in mapping {
            let e = self.operand(*e, Level::If);
            depth = depth.max(e.depth + 1);
            named.push(format!("{} = {}", self.coordinate(*c)?, e.text));
        }
        Ok(Part::new(Level::Postfix, format!("{} AT ({})", body.text, named.join(", ")), depth))
    }
}

/// Names for the coordinates of some nodes that have none, the last that are free; as far as there are free ones.
fn renamed<'a>(graph: &Graph, nodes: impl Iterator<Item = &'a NodeId>) -> FxHashMap<Coordinate, Coordinate> {
    let mut used = BTreeSet::new();
    for node in nodes {
        match graph.node(*node) {
            Node::Coordinate(c) => used.extend([*c]),
            Node::Map(_, mapping) => used.extend(mapping.iter().map(|(c, _)| *c)),
            _ => {}
        }
    }
    #[allow(clippy::cast_possible_truncation)]
    let named = Coordinate(Coordinate::NAMED as u8);
    let free = (1..=named.0).rev().map(Coordinate).filter(|c| !used.contains(c));
    used.iter().copied().filter(|c| *c > named).zip(free.collect::<Vec<_>>()).collect()
}

/// The name of the built-in with that meaning; each operation has one.
fn name_of(meaning: impl Fn(Meaning) -> bool) -> &'static str {
    builtins::all().find(|builtin| meaning(builtin.meaning)).map_or("?", |builtin| builtin.name)
}

/// A finite number in the shortest digits that read back the same; what is undefined as an expression that is.
pub(super) fn number(value: f64) -> String {
    if value.is_nan() {
        "(IF 0 THEN 0)".into()
    } else if value.is_infinite() {
        if value > 0.0 { "INFINITY" } else { "-INFINITY" }.into()
    } else {
        format!("{value:?}").trim_end_matches(".0").to_owned()
    }
}
