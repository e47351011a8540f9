//! Expressions: from the grammar's flat lists of operands and operators to the tree, by the table of precedences.

use std::sync::{Arc, LazyLock};

use pest::iterators::{Pair, Pairs};
use pest::pratt_parser::{Assoc, Op, PrattParser};

use super::{Builder, Rule};
use crate::diagnostic::Diagnostic;
use crate::source::Span;
use crate::syntax::explain;
use crate::syntax::scan::coordinate_digits;
use crate::syntax::tree::{ChainOp, CompareOp, Expr, ExprKind, FoldOp, Ident, Mapping, Name, PrefixOp};

/// The levels of language.md section 4, loosest first.
static PRECEDENCE: LazyLock<PrattParser<Rule>> = LazyLock::new(|| {
    PrattParser::new()
        .op(Op::infix(Rule::op_or, Assoc::Left))
        .op(Op::infix(Rule::op_and, Assoc::Left))
        .op(Op::prefix(Rule::not_))
        .op(Op::infix(Rule::op_compare, Assoc::Left) | Op::infix(Rule::assign, Assoc::Left))
        .op(Op::infix(Rule::op_set, Assoc::Left))
        .op(Op::infix(Rule::op_meet, Assoc::Left))
        .op(Op::infix(Rule::op_add, Assoc::Left))
        .op(Op::infix(Rule::op_mul, Assoc::Left))
        .op(Op::prefix(Rule::sign))
        .op(Op::infix(Rule::op_power, Assoc::Right))
        .op(Op::postfix(Rule::index) | Op::postfix(Rule::at))
});

type P<'i> = Pair<'i, Rule>;

impl<'t> Builder<'t> {
    pub(super) fn span(&self, pair: &P<'_>) -> Span {
        let span = pair.as_span();
        Span::new(self.id, self.base + span.start(), self.base + span.end())
    }

    /// A name as written; a coordinate always in lower case.
    pub(super) fn ident(&self, pair: &P<'_>) -> Ident {
        let name = match pair.as_rule() {
            Rule::coordinate => Name::from(pair.as_str().to_ascii_lowercase()),
            _ => Name::from(pair.as_str()),
        };
        Ident { name, span: self.span(pair) }
    }

    fn error(&mut self, diagnostic: Diagnostic) {
        self.diagnostics.push(diagnostic);
    }

    /// `value`: an expression and its WHERE.
    pub(super) fn value(&mut self, pair: P<'t>) -> Expr {
        let mut inner = pair.into_inner();
        let body = self.next_expr(&mut inner);
        match inner.next() {
            Some(clause) => self.where_(body, clause),
            None => body,
        }
    }

    fn where_(&mut self, body: Expr, clause: P<'t>) -> Expr {
        let mut span = body.span;
        let mut bindings = Vec::new();
        for binding in clause.into_inner().filter(|p| p.as_rule() == Rule::binding) {
            let mut inner = binding.into_inner();
            let Some(name) = inner.next() else { continue };
            let name = self.ident(&name);
            inner.next();
            let value = self.next_expr(&mut inner);
            span = span.to(value.span);
            bindings.push((name, value));
        }
        Expr { kind: ExprKind::Where { body: Box::new(body), bindings }, span }
    }

    /// The next pair, which is an `expr`; a gap would be a mistake of the grammar and counts as an undefined number.
    pub(super) fn next_expr(&mut self, pairs: &mut Pairs<'t, Rule>) -> Expr {
        match pairs.next() {
            Some(pair) => self.expr(pair),
            None => Expr { kind: ExprKind::Number(f64::NAN), span: Span::new(self.id, self.base, self.base) },
        }
    }

    pub(super) fn exprs(&mut self, pairs: Pairs<'t, Rule>) -> Vec<Expr> {
        pairs.filter(|p| p.as_rule() == Rule::expr).map(|p| self.expr(p)).collect()
    }

    /// `expr`: an IF or a flat list.
    pub(super) fn expr(&mut self, pair: P<'t>) -> Expr {
        let mut inner = pair.into_inner();
        match inner.peek() {
            Some(first) if first.as_rule() == Rule::if_ => {
                inner.next();
                self.if_(first)
            }
            _ => self.flat(inner),
        }
    }

    fn if_(&mut self, pair: P<'t>) -> Expr {
        let mut span = self.span(&pair);
        let mut parts = self.exprs(pair.into_inner()).into_iter();
        let mut part = || parts.next().map(Box::new);
        let (condition, then, otherwise) = (part(), part(), part());
        let missing = Expr { kind: ExprKind::Number(f64::NAN), span };
        let condition = condition.unwrap_or_else(|| Box::new(missing.clone()));
        let then = then.unwrap_or_else(|| Box::new(missing));
        span.end = otherwise.as_ref().map_or(then.span.end, |o| o.span.end);
        Expr { kind: ExprKind::If { condition, then, otherwise }, span }
    }

    fn flat(&mut self, pairs: impl Iterator<Item = P<'t>>) -> Expr {
        let this = std::cell::RefCell::new(self);
        PRECEDENCE
            .map_primary(|pair| this.borrow_mut().primary(pair))
            .map_prefix(|op, operand| this.borrow_mut().prefix(&op, operand))
            .map_infix(|left, op, right| this.borrow_mut().infix(left, &op, right))
            .map_postfix(|base, op| this.borrow_mut().postfix(base, op))
            .parse(pairs)
    }

    fn primary(&mut self, pair: P<'t>) -> Expr {
        let span = self.span(&pair);
        match pair.as_rule() {
            Rule::number => Expr { kind: ExprKind::Number(self.number(&pair)), span },
            Rule::text => Expr { kind: ExprKind::Text(unquoted(pair.as_str())), span },
            Rule::paren => {
                let mut inner = pair.into_inner();
                let value = inner.next().map(|value| self.value(value));
                let kind = value.map_or(ExprKind::Number(f64::NAN), |value| ExprKind::Paren(Box::new(value)));
                Expr { kind, span }
            }
            Rule::array => Expr { kind: ExprKind::Array(self.exprs(pair.into_inner())), span },
            Rule::reference => self.reference(pair),
            _ => Expr { kind: self.word(&pair), span },
        }
    }

    fn number(&mut self, pair: &P<'_>) -> f64 {
        let value = pair.as_str().parse().unwrap_or(f64::NAN);
        if !f64::is_finite(value) {
            let span = self.span(pair);
            self.error(explain::number_too_large(span));
        }
        value
    }

    /// A coordinate, PI or a plain name.
    fn word(&mut self, pair: &P<'_>) -> ExprKind {
        let word = pair.as_str();
        match coordinate_digits(word) {
            Some(digits) => ExprKind::Coordinate(self.coordinate(digits, pair)),
            None if word.eq_ignore_ascii_case("PI") => ExprKind::Pi,
            None if word.eq_ignore_ascii_case("INFINITY") => ExprKind::Infinity,
            None => ExprKind::Name(Name::from(word)),
        }
    }

    pub(super) fn coordinate(&mut self, digits: &str, pair: &P<'_>) -> u8 {
        let number = digits.parse().unwrap_or(0);
        if (1..=16).contains(&number) && !digits.starts_with('0') {
            return number;
        }
        let span = self.span(pair);
        self.error(explain::no_such_coordinate(pair.as_str(), span));
        1
    }

    fn reference(&mut self, pair: P<'t>) -> Expr {
        let mut inner = pair.into_inner();
        let Some(head) = inner.next() else { return self.next_expr(&mut inner) };
        let head_span = self.span(&head);
        let Some(arguments) = inner.next() else { return Expr { kind: self.word(&head), span: head_span } };
        let span = head_span.to(self.span(&arguments));
        if let Some(digits) = coordinate_digits(head.as_str()) {
            self.coordinate(digits, &head);
            self.error(explain::called_coordinate(head.as_str(), span));
        }
        let callee = self.ident(&head);
        let kind = self.call(callee, arguments);
        Expr { kind, span }
    }

    fn call(&mut self, callee: Ident, arguments: P<'t>) -> ExprKind {
        let mut parts: Vec<_> = arguments.into_inner().filter(|p| p.as_rule() == Rule::argument).collect();
        let ranged = |p: &P<'t>| p.clone().into_inner().any(|q| q.as_rule() == Rule::kw_to);
        let Some(place) = parts.iter().position(ranged) else {
            let arguments = parts.into_iter().map(|p| self.argument(p)).collect();
            return ExprKind::Call { callee, arguments };
        };
        let range = parts.remove(place);
        let span = self.span(&range);
        let mut rest: Vec<_> = parts.into_iter().map(|p| self.argument(p)).collect();
        let op = fold_op(&callee.name);
        let Some((op, (index, from, to))) = op.zip(self.fold_range(range)) else {
            self.error(match op {
                Some(_) => explain::fold_form(&callee, span),
                None => explain::misplaced_to(span, &callee),
            });
            return ExprKind::Call { callee, arguments: rest };
        };
        match rest.pop() {
            Some(body) if rest.is_empty() && place == 0 => {
                let (from, to, body) = (Box::new(from), Box::new(to), Box::new(body));
                ExprKind::Fold { op, index, from, to, body }
            }
            _ => {
                self.error(explain::fold_form(&callee, span));
                ExprKind::Call { callee, arguments: rest }
            }
        }
    }

    /// `i = a TO b`
    fn fold_range(&mut self, pair: P<'t>) -> Option<(Ident, Expr, Expr)> {
        let mut inner = pair.into_inner();
        let index = inner.next().filter(|p| p.as_rule() == Rule::name)?;
        let index = self.ident(&index);
        inner.next();
        let from = self.next_expr(&mut inner);
        inner.next();
        Some((index, from, self.next_expr(&mut inner)))
    }

    /// `e`, or `name = e`: a setting, but a comparison if what follows the `=` compares or joins on. `x4 = e` always sets.
    fn argument(&mut self, pair: P<'t>) -> Expr {
        let mut inner = pair.into_inner();
        if let Some(to) = inner.clone().find(|p| p.as_rule() == Rule::kw_to) {
            let span = self.span(&to);
            self.error(explain::stray_to(span));
        }
        if inner.peek().is_some_and(|p| p.as_rule() == Rule::expr) {
            return self.next_expr(&mut inner);
        }
        let (Some(head), Some(assign), Some(value)) = (inner.next(), inner.next(), inner.next()) else {
            return self.next_expr(&mut inner);
        };
        let loose = |p: P<'t>| matches!(p.as_rule(), Rule::op_compare | Rule::op_or | Rule::op_and | Rule::not_);
        let coordinate = head.as_rule() == Rule::coordinate;
        if !coordinate && value.clone().into_inner().any(loose) {
            return self.flat([head, assign].into_iter().chain(value.into_inner()));
        }
        if let Some(digits) = coordinate_digits(head.as_str()) {
            self.coordinate(digits, &head);
        }
        let name = self.ident(&head);
        let value = self.expr(value);
        let span = name.span.to(value.span);
        Expr { kind: ExprKind::Setting { name, value: Box::new(value) }, span }
    }

    fn prefix(&mut self, op: &P<'_>, operand: Expr) -> Expr {
        let span = self.span(op).to(operand.span);
        let op = match op.as_str() {
            "-" => PrefixOp::Minus,
            "+" => PrefixOp::Plus,
            "~" => PrefixOp::Complement,
            _ => PrefixOp::Not,
        };
        Expr { kind: ExprKind::Prefix { op, operand: Box::new(operand) }, span }
    }

    fn infix(&mut self, left: Expr, op: &P<'_>, right: Expr) -> Expr {
        let span = left.span.to(right.span);
        let at = self.span(op);
        let kind = match op.as_rule() {
            Rule::op_power => ExprKind::Power { base: Box::new(left), exponent: Box::new(right) },
            Rule::op_compare | Rule::assign => {
                // After the `=` of an argument a NOT may stand, which elsewhere needs the parentheses that the tree gets here.
                let right = match right.kind {
                    ExprKind::Prefix { op: PrefixOp::Not, .. } => {
                        Expr { span: right.span, kind: ExprKind::Paren(Box::new(right)) }
                    }
                    _ => right,
                };
                let kind = compare(left, compare_op(op.as_str()), at, right);
                self.suspicious_chain(&kind, span);
                kind
            }
            _ => chain(left, chain_op(op), at, right),
        };
        Expr { kind, span }
    }

    /// Looks at a chain of comparisons that has just grown.
    fn suspicious_chain(&mut self, kind: &ExprKind, span: Span) {
        let ExprKind::Compare { first, rest } = kind else { return };
        if rest.len() < 2 {
            return;
        }
        let fresh = if rest.len() == 2 { Some(&**first) } else { None };
        let new = rest.len() - if fresh.is_some() { 2 } else { 1 };
        let operands = fresh.into_iter().chain(rest[new..].iter().map(|r| &r.2));
        let found: Vec<_> = operands.filter_map(set_operator).collect();
        for at in found {
            let op = &self.text[at.range()];
            self.error(explain::set_in_comparison(op, at, span));
        }
        let equal = |r: &(CompareOp, Span, Expr)| &self.text[r.1.range()] == "=";
        if rest.len() == 2 && rest.iter().all(equal) {
            self.error(explain::equality_chain(span));
        }
    }

    fn postfix(&mut self, base: Expr, op: P<'t>) -> Expr {
        let span = base.span.to(self.span(&op));
        let kind = match op.as_rule() {
            Rule::index => ExprKind::Index { base: Box::new(base), indices: self.exprs(op.into_inner()) },
            _ => self.at(base, op),
        };
        Expr { kind, span }
    }

    fn at(&mut self, body: Expr, pair: P<'t>) -> ExprKind {
        let span = self.span(&pair);
        let arguments = pair.into_inner().find(|p| p.as_rule() == Rule::arguments);
        let parts = arguments.into_iter().flat_map(Pair::into_inner);
        let parts: Vec<_> = parts.filter(|p| p.as_rule() == Rule::argument).map(|p| self.argument(p)).collect();
        let mapping = self.mapping(parts, span);
        ExprKind::At { body: Box::new(body), mapping }
    }

    fn mapping(&mut self, parts: Vec<Expr>, span: Span) -> Mapping {
        if !parts.iter().any(|p| matches!(p.kind, ExprKind::Setting { .. })) {
            if parts.is_empty() {
                self.error(explain::empty_mapping(span));
            }
            return Mapping::Positional(parts);
        }
        let mut named: Vec<(u8, Span, Expr)> = Vec::with_capacity(parts.len());
        for part in parts {
            let ExprKind::Setting { name, value } = part.kind else {
                self.error(explain::mixed_mapping(part.span));
                continue;
            };
            let digits = coordinate_digits(&name.name).and_then(|d| d.parse().ok());
            let Some(coordinate) = digits else {
                self.error(explain::mapped_name(&name));
                continue;
            };
            if let Some((_, first, _)) = named.iter().find(|n| n.0 == coordinate) {
                let diagnostic = explain::mapped_twice(&name, *first);
                self.error(diagnostic);
            }
            named.push((coordinate, name.span, *value));
        }
        Mapping::Named(named)
    }
}

/// The place of the first set-theoretic operator of an operand without parentheses.
fn set_operator(operand: &Expr) -> Option<Span> {
    match &operand.kind {
        ExprKind::Chain { rest, .. } => rest.first().filter(|r| matches!(r.0.level(), 6 | 7)).map(|r| r.1),
        _ => None,
    }
}

/// The text between the quotes.
pub(super) fn unquoted(text: &str) -> Arc<str> {
    Arc::from(text.trim_matches('"'))
}

fn fold_op(name: &str) -> Option<FoldOp> {
    let table = [
        ("SUM", FoldOp::Sum),
        ("PRODUCT", FoldOp::Product),
        ("UNION", FoldOp::Union),
        ("INTERSECTION", FoldOp::Intersection),
        ("MINIMUM", FoldOp::Minimum),
        ("MAXIMUM", FoldOp::Maximum),
        ("ARRAY", FoldOp::Array),
    ];
    table.into_iter().find(|(word, _)| word.eq_ignore_ascii_case(name)).map(|(_, op)| op)
}

fn compare_op(text: &str) -> CompareOp {
    match text {
        "<" => CompareOp::Less,
        "<=" => CompareOp::LessEqual,
        ">" => CompareOp::Greater,
        ">=" => CompareOp::GreaterEqual,
        "=" | "==" => CompareOp::Equal,
        _ => CompareOp::NotEqual,
    }
}

fn chain_op(op: &P<'_>) -> ChainOp {
    match (op.as_rule(), op.as_str()) {
        (Rule::op_or, _) => ChainOp::Or,
        (Rule::op_and, _) => ChainOp::And,
        (_, "|") => ChainOp::Union,
        (_, "\\") => ChainOp::Subtract,
        (_, "&") => ChainOp::Intersect,
        (_, "@") => ChainOp::Product,
        (_, "+") => ChainOp::Add,
        (_, "-") => ChainOp::Sub,
        (_, "*") => ChainOp::Mul,
        _ => ChainOp::Div,
    }
}

fn compare(left: Expr, op: CompareOp, at: Span, right: Expr) -> ExprKind {
    match left.kind {
        ExprKind::Compare { first, mut rest } => {
            rest.push((op, at, right));
            ExprKind::Compare { first, rest }
        }
        _ => ExprKind::Compare { first: Box::new(left), rest: vec![(op, at, right)] },
    }
}

/// Adds to the chain on the left if it is of the same level, so that a long sum stays flat.
fn chain(left: Expr, op: ChainOp, at: Span, right: Expr) -> ExprKind {
    match left.kind {
        ExprKind::Chain { first, mut rest } if rest.first().is_some_and(|r| r.0.level() == op.level()) => {
            rest.push((op, at, right));
            ExprKind::Chain { first, rest }
        }
        _ => ExprKind::Chain { first: Box::new(left), rest: vec![(op, at, right)] },
    }
}
