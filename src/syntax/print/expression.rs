//! Expressions as text. Parentheses of the tree are kept; where a tree was not built by the parser and needs more, they
//! are added.

use crate::syntax::tree::{ChainOp, CompareOp, Expr, ExprKind, FoldOp, Mapping, PrefixOp};

use super::{WIDTH, open_if};

/// The levels of language.md section 4; a larger number binds tighter.
const IF: u8 = 1;
const NOT: u8 = 4;
const COMPARE: u8 = 5;
const SUM: u8 = 8;
const SIGN: u8 = 10;
const POWER: u8 = 11;
const POSTFIX: u8 = 12;

/// Gathers text; with the source at hand numbers and comparisons keep their spelling.
#[derive(Default)]
pub struct Writer<'t> {
    source: Option<&'t str>,
    out: String,
}

impl<'t> Writer<'t> {
    /// A writer for a tree of `source`.
    pub fn with_source(source: &'t str) -> Self {
        Self { source: Some(source), out: String::with_capacity(source.len()) }
    }

    /// Everything written; a text ends with a line's end if it has several statements or is a file.
    pub fn finish(mut self) -> String {
        if self.source.is_some() && !self.out.is_empty() {
            self.out.push('\n');
        }
        self.out
    }

    /// Writes as it is.
    pub fn push(&mut self, text: &str) {
        self.out.push_str(text);
    }

    /// Begins a line, unless nothing stands before it.
    pub fn line(&mut self, indent: usize) {
        if !self.out.is_empty() {
            self.out.push('\n');
        }
        self.out.extend(std::iter::repeat_n(' ', indent));
    }

    /// Leaves one line blank before what comes next.
    pub fn blank(&mut self) {
        if !self.out.is_empty() && !self.out.ends_with('\n') && !self.out.ends_with("BEGIN") {
            self.out.push('\n');
        }
    }

    /// Takes back a blank line at the end of a block or text.
    pub fn drop_blank(&mut self) {
        if self.out.ends_with('\n') {
            self.out.pop();
        }
    }

    /// `key` and an expression.
    pub fn keyed(&mut self, key: &str, e: &Expr) {
        self.push(key);
        self.expr(e);
    }

    /// A whole definition's expression, WHERE included.
    pub fn value(&mut self, e: &Expr) {
        self.operand(e, 0);
    }

    /// An expression of level 1, as an argument is.
    pub fn expr(&mut self, e: &Expr) {
        self.operand(e, IF);
    }

    /// Expressions apart by commas between two brackets.
    pub fn bracketed(&mut self, open: &str, items: &[Expr], close: &str) {
        self.push(open);
        for (n, item) in items.iter().enumerate() {
            if n > 0 {
                self.push(", ");
            }
            self.expr(item);
        }
        self.push(close);
    }

    /// Bytes of the line so far.
    fn column(&self) -> usize {
        self.out.len() - self.out.rfind('\n').map_or(0, |n| n + 1)
    }

    /// A definition's expression, broken into lines if it is too long for one.
    pub fn broken(&mut self, e: &Expr, indent: usize) {
        let start = self.out.len();
        let column = self.column();
        self.value(e);
        if column + (self.out.len() - start) > WIDTH {
            self.out.truncate(start);
            self.lines(e, indent);
        }
    }

    fn lines(&mut self, e: &Expr, indent: usize) {
        match &e.kind {
            ExprKind::Where { body, bindings } => {
                self.lines_of(body, indent, IF);
                for (n, (name, value)) in bindings.iter().enumerate() {
                    if n > 0 {
                        self.push(",");
                    }
                    self.line(indent);
                    self.push(if n > 0 { "      " } else { "WHERE " });
                    self.push(&name.name);
                    self.keyed(" = ", value);
                }
            }
            ExprKind::If { condition, then, otherwise } => {
                self.condition(condition, then, otherwise.is_some());
                if let Some(otherwise) = otherwise {
                    self.line(indent);
                    self.push("ELSE ");
                    self.lines_of(otherwise, indent, IF);
                }
            }
            ExprKind::Chain { first, rest } => {
                let level = rest.first().map_or(POSTFIX, |r| r.0.level());
                self.operand(first, level + 1);
                for (op, _, operand) in rest {
                    let start = self.out.len();
                    self.push(chain_op(*op));
                    self.operand(operand, level + 1);
                    // Terms of a sum fill the line; objects stand one a line.
                    if level < SUM || self.column() > WIDTH {
                        let term = self.out.split_off(start);
                        self.line(indent);
                        self.push(term.trim_start());
                    }
                }
            }
            ExprKind::Array(items) => self.filled("[", items, "]", indent),
            ExprKind::Call { callee, arguments } => {
                self.push(&callee.name);
                self.filled("(", arguments, ")", indent);
            }
            _ => self.operand(e, IF),
        }
    }

    fn lines_of(&mut self, e: &Expr, indent: usize, level: u8) {
        if self.level(e) < level { self.operand(e, level) } else { self.lines(e, indent) }
    }

    /// Like `bracketed`, with as many items on a line as fit.
    fn filled(&mut self, open: &str, items: &[Expr], close: &str, indent: usize) {
        self.push(open);
        for (n, item) in items.iter().enumerate() {
            if n > 0 {
                self.push(", ");
            }
            let start = self.out.len();
            self.expr(item);
            if self.column() + 1 > WIDTH && n > 0 {
                let item = self.out.split_off(start);
                self.out.truncate(self.out.trim_end().len());
                self.line(indent);
                self.push(&item);
            }
        }
        self.push(close);
    }

    fn level(&self, e: &Expr) -> u8 {
        match &e.kind {
            ExprKind::Where { .. } => 0,
            ExprKind::If { .. } => IF,
            ExprKind::Chain { rest, .. } => rest.first().map_or(POSTFIX, |r| r.0.level()),
            ExprKind::Compare { .. } => COMPARE,
            ExprKind::Prefix { op: PrefixOp::Not, .. } => NOT,
            ExprKind::Prefix { .. } => SIGN,
            ExprKind::Power { .. } => POWER,
            ExprKind::Number(n) if n.is_sign_negative() => SIGN,
            _ => POSTFIX,
        }
    }

    /// Writes an operand of something that takes operands of `level` or tighter.
    fn operand(&mut self, e: &Expr, level: u8) {
        if self.level(e) < level {
            self.push("(");
            self.bare(e);
            self.push(")");
        } else {
            self.bare(e);
        }
    }

    fn bare(&mut self, e: &Expr) {
        match &e.kind {
            ExprKind::Number(value) => self.number(*value, e),
            ExprKind::Text(text) => self.push(&format!("\"{text}\"")),
            ExprKind::Coordinate(n) => self.push(&format!("x{n}")),
            ExprKind::Name(name) => self.push(name),
            ExprKind::Pi => self.push("PI"),
            ExprKind::Infinity => self.push("INFINITY"),
            ExprKind::Array(items) => self.bracketed("[", items, "]"),
            ExprKind::Paren(inner) => {
                self.push("(");
                self.value(inner);
                self.push(")");
            }
            ExprKind::Chain { first, rest } => self.chain(first, rest),
            ExprKind::Compare { first, rest } => {
                self.operand(first, COMPARE + 1);
                for (op, at, operand) in rest {
                    // As an argument, `a = (NOT b)` would set `a`.
                    let written = self.source.filter(|_| !is_negation(operand)).and_then(|s| s.get(at.range()));
                    let spelt = written.unwrap_or_else(|| compare_op(*op));
                    self.push(&format!(" {spelt} "));
                    self.operand(operand, COMPARE + 1);
                }
            }
            ExprKind::Prefix { op, operand } => self.prefix(*op, operand),
            ExprKind::Power { base, exponent } => {
                self.operand(base, POSTFIX);
                self.push("**");
                let signed = matches!(&exponent.kind, ExprKind::Prefix { op, .. } if *op != PrefixOp::Not);
                self.operand(exponent, if signed { SIGN } else { POWER });
            }
            ExprKind::Index { base, indices } => {
                self.operand(base, POSTFIX);
                self.bracketed("[", indices, "]");
            }
            ExprKind::Call { callee, arguments } => {
                self.push(&callee.name);
                self.bracketed("(", arguments, ")");
            }
            ExprKind::Fold { op, index, from, to, body } => {
                self.push(&format!("{}({}", fold_op(*op), index.name));
                self.keyed(" = ", from);
                self.keyed(" TO ", to);
                self.keyed(", ", body);
                self.push(")");
            }
            ExprKind::At { body, mapping } => {
                self.operand(body, POSTFIX);
                self.mapping(mapping);
            }
            ExprKind::If { condition, then, otherwise } => {
                self.condition(condition, then, otherwise.is_some());
                if let Some(otherwise) = otherwise {
                    self.keyed(" ELSE ", otherwise);
                }
            }
            ExprKind::Where { body, bindings } => {
                self.expr(body);
                for (n, (name, value)) in bindings.iter().enumerate() {
                    self.push(if n > 0 { ", " } else { " WHERE " });
                    self.push(&name.name);
                    self.keyed(" = ", value);
                }
            }
            ExprKind::Setting { name, value } => {
                self.push(&name.name);
                self.keyed(" = ", value);
            }
        }
    }

    /// `IF c THEN a`; an `a` that would take the ELSE that follows gets parentheses.
    fn condition(&mut self, condition: &Expr, then: &Expr, guarded: bool) {
        self.keyed("IF ", condition);
        self.push(" THEN ");
        self.operand(then, if guarded && open_if(then) { POSTFIX } else { IF });
    }

    fn number(&mut self, value: f64, e: &Expr) {
        let spelt = self.source.and_then(|s| s.get(e.span.range()));
        match spelt {
            Some(spelt) => self.push(spelt),
            None => self.push(format!("{value:?}").trim_end_matches(".0")),
        }
    }

    fn chain(&mut self, first: &Expr, rest: &[(ChainOp, crate::source::Span, Expr)]) {
        let level = rest.first().map_or(POSTFIX, |r| r.0.level());
        self.operand(first, level + 1);
        for (op, _, operand) in rest {
            self.push(chain_op(*op));
            self.operand(operand, level + 1);
        }
    }

    fn prefix(&mut self, op: PrefixOp, operand: &Expr) {
        let (sign, level) = match op {
            PrefixOp::Minus => ("-", SIGN),
            PrefixOp::Plus => ("+", SIGN),
            PrefixOp::Complement => ("~", SIGN),
            PrefixOp::Not => ("NOT ", NOT),
        };
        self.push(sign);
        self.operand(operand, level);
    }

    fn mapping(&mut self, mapping: &Mapping) {
        self.push(" AT ");
        match mapping {
            Mapping::Positional(parts) => self.bracketed("(", parts, ")"),
            Mapping::Named(parts) => {
                for (n, (coordinate, _, value)) in parts.iter().enumerate() {
                    self.push(&format!("{}x{coordinate}", if n > 0 { ", " } else { "(" }));
                    self.keyed(" = ", value);
                }
                self.push(")");
            }
        }
    }
}

fn chain_op(op: ChainOp) -> &'static str {
    match op {
        ChainOp::Or => " OR ",
        ChainOp::And => " AND ",
        ChainOp::Union => " | ",
        ChainOp::Subtract => " \\ ",
        ChainOp::Intersect => " & ",
        ChainOp::Product => " @ ",
        ChainOp::Add => " + ",
        ChainOp::Sub => " - ",
        ChainOp::Mul => "*",
        ChainOp::Div => "/",
    }
}

/// `==` rather than `=`, which would define at the start of a statement and name a setting in a call.
/// `(NOT a)`.
fn is_negation(e: &Expr) -> bool {
    let ExprKind::Paren(inner) = &e.kind else { return false };
    matches!(inner.kind, ExprKind::Prefix { op: PrefixOp::Not, .. })
}

fn compare_op(op: CompareOp) -> &'static str {
    match op {
        CompareOp::Less => "<",
        CompareOp::LessEqual => "<=",
        CompareOp::Greater => ">",
        CompareOp::GreaterEqual => ">=",
        CompareOp::Equal => "==",
        CompareOp::NotEqual => "<>",
    }
}

fn fold_op(op: FoldOp) -> &'static str {
    match op {
        FoldOp::Sum => "SUM",
        FoldOp::Product => "PRODUCT",
        FoldOp::Union => "UNION",
        FoldOp::Intersection => "INTERSECTION",
        FoldOp::Minimum => "MINIMUM",
        FoldOp::Maximum => "MAXIMUM",
        FoldOp::Array => "ARRAY",
    }
}
