//! Which names a statement defines, which it reads, and what of that is known without evaluating anything. Knows no values.

use rustc_hash::FxHashSet;

use crate::builtins;
use crate::source::Span;
use crate::syntax::tree::{Body, ChainOp, Expr, ExprKind, FoldOp, Ident, Mapping, Name, Statement, StatementKind};

/// The name that holds the parameter of the R-functions.
pub const R_ALPHA: &str = "r_alpha";
/// The name that holds the exponent of the factor of \[P95\] eq. (5).
pub const R_M: &str = "r_m";

/// Whether the name sets the system of R-functions.
#[must_use]
pub fn is_system(name: &str) -> bool {
    name == R_ALPHA || name == R_M
}

/// Whether the name is that of an object, a primitive or an operation on objects.
#[must_use]
pub fn is_geometric(name: &str) -> bool {
    ["gob_", "pob_", "tr_"].iter().any(|prefix| name.starts_with(prefix))
}

/// What a statement says of names.
#[derive(Debug, Default)]
pub struct Names {
    /// Names that it reads from outside, each with its first place; its own name is among them if it extends itself.
    pub reads: Vec<(Name, Span)>,
    /// Calls of names from outside: name, place, number of arguments.
    pub calls: Vec<(Name, Span, usize)>,
    /// Calls of built-in functions: name as written, place, number of arguments.
    pub builtins: Vec<(Name, Span, usize)>,
    /// Whether a set operation stands in it, so that the system of R-functions matters.
    pub uses_system: bool,
}

/// The names that a block of statements assigns, in the order of their first assignment; those of the system and the indices of FOR
/// are not among them.
#[must_use]
pub fn assigned(block: &[Statement]) -> Vec<Name> {
    let mut names = Vec::new();
    let mut seen = FxHashSet::default();
    collect_assigned(block, &mut names, &mut seen);
    names
}

fn collect_assigned(block: &[Statement], names: &mut Vec<Name>, seen: &mut FxHashSet<Name>) {
    for statement in block {
        match &statement.kind {
            StatementKind::Define { name, .. } | StatementKind::Element { name, .. }
                if !is_system(&name.name) && seen.insert(name.name.clone()) =>
            {
                names.push(name.name.clone());
            }
            StatementKind::If { then, otherwise, .. } => {
                collect_assigned(then, names, seen);
                collect_assigned(otherwise.as_deref().unwrap_or_default(), names, seen);
            }
            StatementKind::While { body, .. } | StatementKind::For { body, .. } => collect_assigned(body, names, seen),
            _ => {}
        }
    }
}

/// What a statement at the top of a program says of names.
#[must_use]
pub fn of_statement(statement: &Statement) -> Names {
    let mut walk = Walk::default();
    match &statement.kind {
        StatementKind::If { .. } | StatementKind::While { .. } | StatementKind::For { .. } => {
            walk.bound = assigned(std::slice::from_ref(statement));
            walk.statement(statement);
        }
        _ => walk.statement(statement),
    }
    walk.names
}

/// What an expression says of names.
#[must_use]
pub fn of_expression(expression: &Expr) -> Names {
    let mut walk = Walk::default();
    walk.expr(expression);
    walk.names
}

#[derive(Default)]
struct Walk {
    names: Names,
    /// Names that are bound where the walk stands.
    bound: Vec<Name>,
    seen: FxHashSet<Name>,
}

impl Walk {
    fn read(&mut self, name: &Name, span: Span) {
        if self.bound.iter().any(|b| b == name) {
            return;
        }
        if is_system(name) {
            self.names.uses_system = true;
        } else if self.seen.insert(name.clone()) {
            self.names.reads.push((name.clone(), span));
        }
    }

    fn within(&mut self, names: impl IntoIterator<Item = Name>, f: impl FnOnce(&mut Self)) {
        let before = self.bound.len();
        self.bound.extend(names);
        f(self);
        self.bound.truncate(before);
    }

    fn exprs<'e>(&mut self, all: impl IntoIterator<Item = &'e Expr>) {
        all.into_iter().for_each(|e| self.expr(e));
    }

    fn expr(&mut self, e: &Expr) {
        match &e.kind {
            ExprKind::Number(_) | ExprKind::Text(_) | ExprKind::Pi | ExprKind::Infinity | ExprKind::Coordinate(_) => {}
            ExprKind::Name(name) => self.read(name, e.span),
            ExprKind::Array(items) => self.exprs(items),
            ExprKind::Paren(inner) | ExprKind::Prefix { operand: inner, .. } => self.expr(inner),
            ExprKind::Chain { first, rest } => {
                let set = |op: &ChainOp| {
                    matches!(op, ChainOp::Union | ChainOp::Subtract | ChainOp::Intersect | ChainOp::Product)
                };
                self.names.uses_system |= rest.iter().any(|(op, _, _)| set(op));
                self.expr(first);
                self.exprs(rest.iter().map(|(_, _, e)| e));
            }
            ExprKind::Compare { first, rest } => {
                self.expr(first);
                self.exprs(rest.iter().map(|(_, _, e)| e));
            }
            ExprKind::Power { base, exponent } => self.exprs([&**base, exponent]),
            ExprKind::Index { base, indices } => {
                self.expr(base);
                self.exprs(indices);
            }
            ExprKind::Call { callee, arguments } => {
                self.call(callee, e.span, arguments.len());
                self.exprs(arguments);
            }
            ExprKind::Fold { op, index, from, to, body } => {
                self.names.uses_system |= matches!(op, FoldOp::Union | FoldOp::Intersection);
                self.exprs([&**from, to]);
                self.within([index.name.clone()], |w| w.expr(body));
            }
            ExprKind::At { body, mapping } => {
                self.expr(body);
                self.mapping(mapping);
            }
            ExprKind::If { condition, then, otherwise } => {
                self.exprs([&**condition, then]);
                self.exprs(otherwise.as_deref());
            }
            ExprKind::Where { body, bindings } => self.within([], |w| {
                for (name, value) in bindings {
                    w.expr(value);
                    w.bound.push(name.name.clone());
                }
                w.expr(body);
            }),
            ExprKind::Setting { value, .. } => self.expr(value),
        }
    }

    fn mapping(&mut self, mapping: &Mapping) {
        match mapping {
            Mapping::Positional(all) => self.exprs(all),
            Mapping::Named(all) => all.iter().for_each(|(_, _, e)| self.expr(e)),
        }
    }

    fn call(&mut self, callee: &Ident, whole: Span, arguments: usize) {
        let name = &callee.name;
        if builtins::find(name).is_some() {
            self.names.builtins.push((name.clone(), whole, arguments));
            let upper = name.to_ascii_uppercase();
            self.names.uses_system |= upper == "UNION" || upper == "INTERSECTION";
            return;
        }
        if !self.bound.iter().any(|b| b == name) {
            self.names.calls.push((name.clone(), whole, arguments));
        }
        self.read(name, callee.span);
    }

    fn block(&mut self, block: &[Statement]) {
        block.iter().for_each(|s| self.statement(s));
    }

    /// A statement whose assigned names are bound already, or one at the top.
    fn statement(&mut self, statement: &Statement) {
        match &statement.kind {
            StatementKind::Define { name, parameters, body, range } => {
                let own: Vec<Name> = match (parameters, body) {
                    (Some(parameters), _) => {
                        parameters.iter().map(|p| p.name.name.clone()).chain([name.name.clone()]).collect()
                    }
                    (None, Body::Block(_)) => vec![name.name.clone()],
                    (None, Body::Expression(_)) => Vec::new(),
                };
                self.within(own, |w| w.body(body));
                if let Some(range) = range {
                    self.exprs([&range.lo, &range.hi]);
                    self.exprs(&range.step);
                }
            }
            StatementKind::Element { name, indices, value } => {
                self.read(&name.name, name.span);
                self.exprs(indices);
                self.expr(value);
            }
            StatementKind::If { condition, then, otherwise } => {
                self.expr(condition);
                self.block(then);
                self.block(otherwise.as_deref().unwrap_or_default());
            }
            StatementKind::While { condition, body } => {
                self.expr(condition);
                self.block(body);
            }
            StatementKind::For { index, from, to, step, body } => {
                self.exprs([from, to]);
                self.exprs(step);
                self.within([index.name.clone()], |w| w.block(body));
            }
            StatementKind::Type { kind, .. } => {
                self.exprs(kind.expressions());
            }
            StatementKind::Print { items } => self.exprs(items),
            StatementKind::Expression(e) => self.expr(e),
            StatementKind::Include { .. } | StatementKind::Failed { .. } => {}
        }
    }

    fn body(&mut self, body: &Body) {
        match body {
            Body::Expression(e) => self.expr(e),
            Body::Block(block) => self.within(assigned(block), |w| w.block(block)),
        }
    }
}
