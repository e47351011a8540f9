//! Statements: from the grammar's pairs to the tree.

use std::sync::Arc;

use pest::iterators::{Pair, Pairs};

use super::expression::unquoted;
use super::{Builder, Rule};
use crate::source::Span;
use crate::syntax::explain;
use crate::syntax::scan::coordinate_digits;
use crate::syntax::tree::{
    Body, Expr, ExprKind, GeometricType, Ident, Parameter, ParameterKind, Range, Statement, StatementKind,
};

type P<'i> = Pair<'i, Rule>;

impl<'t> Builder<'t> {
    /// The statement of a `single`, if it holds one.
    pub(super) fn single(&mut self, pair: P<'t>) -> Option<StatementKind> {
        let statement = pair.into_inner().find(|p| p.as_rule() != Rule::EOI)?;
        Some(self.statement(statement))
    }

    fn statement(&mut self, pair: P<'t>) -> StatementKind {
        let rule = pair.as_rule();
        let mut inner = pair.into_inner();
        match rule {
            Rule::while_ => {
                inner.next();
                StatementKind::While { condition: self.next_expr(&mut inner), body: self.branch_in(inner) }
            }
            Rule::for_ => self.for_(inner),
            Rule::if_statement => self.if_statement(inner),
            Rule::include => self.include(inner),
            Rule::print => StatementKind::Print { items: self.exprs(inner) },
            Rule::definition => self.definition(inner),
            Rule::element => self.element(inner),
            Rule::type_ => self.type_(inner),
            _ => match inner.next() {
                Some(value) => self.bare(value),
                None => StatementKind::failed(),
            },
        }
    }

    /// A bare expression. One that begins like a definition but cannot be one is an error: `f(1) = 3`, `x1 = 3`.
    fn bare(&mut self, value: P<'t>) -> StatementKind {
        let value = self.value(value);
        if let ExprKind::Compare { first, rest } = &value.kind
            && let Some(at) = rest.first().map(|r| r.1)
            && self.text.get(at.range()) == Some("=")
        {
            // `x17 = 3` has been told already that there is no such coordinate.
            if !self.diagnostics.iter().any(|d| d.labels.iter().any(|l| l.span == first.span)) {
                self.diagnostics.push(explain::no_definition(self.text, first));
            }
        }
        StatementKind::Expression(value)
    }

    /// `a = b = 3;` was most likely meant to define both.
    fn compared(&mut self, name: &Ident, value: &Expr) {
        if let ExprKind::Compare { rest, .. } = &value.kind
            && let [(_, at, _)] = rest.as_slice()
            && self.text.get(at.range()) == Some("=")
        {
            self.diagnostics.push(explain::equality_defined(name, value.span));
        }
    }

    /// The statements of the branch that is next among `pairs`.
    fn branch_in(&mut self, mut pairs: Pairs<'t, Rule>) -> Vec<Statement> {
        pairs.find(|p| p.as_rule() == Rule::branch).map_or(Vec::new(), |branch| self.branch(branch))
    }

    fn branch(&mut self, pair: P<'t>) -> Vec<Statement> {
        match pair.into_inner().next() {
            Some(block) if block.as_rule() == Rule::block => self.block(block),
            Some(statement) => vec![self.inner_statement(statement, None)],
            None => Vec::new(),
        }
    }

    fn block(&mut self, pair: P<'t>) -> Vec<Statement> {
        let is_statement = |p: &P<'t>| !matches!(p.as_rule(), Rule::kw_begin | Rule::kw_end);
        let end = self.span(&pair).end;
        pair.into_inner().filter(is_statement).map(|p| self.inner_statement(p, Some(end))).collect()
    }

    /// A statement inside another; `end` is the end of the block whose `;` belongs to it.
    fn inner_statement(&mut self, pair: P<'t>, end: Option<u32>) -> Statement {
        let mut span = self.span(&pair);
        let written = self.text[span.range()].trim_end();
        let doc = explain::doc(self.text, self.comments, span.start as usize);
        let last = explain::last_token_end(self.text, span.start as usize, span.start as usize + written.len());
        span = Span::new(self.id, span.start as usize, last);
        if let Some(end) = end {
            span = Span::new(self.id, span.start as usize, explain::with_semicolon(self.text, last, end as usize));
        }
        let kind = self.statement(pair);
        Statement { kind, span, doc }
    }

    fn for_(&mut self, mut inner: Pairs<'t, Rule>) -> StatementKind {
        inner.next();
        let index = inner.next().map(|name| self.ident(&name));
        inner.next();
        let from = self.next_expr(&mut inner);
        inner.next();
        let to = self.next_expr(&mut inner);
        let step = match inner.peek() {
            Some(step) if step.as_rule() == Rule::step => self.exprs(step.into_inner()).pop(),
            _ => None,
        };
        let body = self.branch_in(inner);
        match index {
            Some(index) => StatementKind::For { index, from, to, step, body },
            None => StatementKind::failed(),
        }
    }

    /// An IF whose branches are bare expressions is an expression.
    fn if_statement(&mut self, mut inner: Pairs<'t, Rule>) -> StatementKind {
        let keyword = inner.next().map(|k| self.span(&k));
        let condition = self.next_expr(&mut inner);
        let mut branches = inner.filter(|p| p.as_rule() == Rule::branch);
        let then = branches.next().map_or(Vec::new(), |b| self.branch(b));
        let otherwise = branches.next().map(|b| self.branch(b));
        let keyword = keyword.unwrap_or(condition.span);
        match (single_expression(&then), otherwise.as_deref().map(single_expression)) {
            (Some(then), None) => StatementKind::Expression(if_expression(keyword, condition, then, None)),
            (Some(then), Some(Some(other))) => {
                StatementKind::Expression(if_expression(keyword, condition, then, Some(other)))
            }
            _ => StatementKind::If { condition, then, otherwise },
        }
    }

    fn include(&mut self, mut inner: Pairs<'t, Rule>) -> StatementKind {
        let path = inner.find(|p| p.as_rule() == Rule::text);
        let path_span = path.as_ref().map_or(Span::new(self.id, self.base, self.base), |p| self.span(p));
        StatementKind::Include { path: path.map_or(Arc::from(""), |p| unquoted(p.as_str())), path_span }
    }

    fn definition(&mut self, mut inner: Pairs<'t, Rule>) -> StatementKind {
        let Some(name) = inner.next().map(|name| self.ident(&name)) else {
            return StatementKind::failed();
        };
        self.not_constant(&name);
        let mut parameters = None;
        let mut body = Body::Block(Vec::new());
        let mut range = None;
        for part in inner {
            match part.as_rule() {
                Rule::parameters => parameters = Some(self.parameters(part)),
                Rule::block => body = Body::Block(self.block(part)),
                Rule::value => {
                    let value = self.value(part);
                    self.compared(&name, &value);
                    body = Body::Expression(value);
                }
                Rule::range => range = self.range(part),
                _ => {}
            }
        }
        StatementKind::Define { name, parameters, body, range }
    }

    fn not_constant(&mut self, name: &Ident) {
        let value = [("PI", "the number 3.14159..."), ("INFINITY", "beyond all numbers")];
        if let Some((_, is)) = value.iter().find(|(word, _)| name.name.eq_ignore_ascii_case(word)) {
            self.diagnostics.push(explain::defined_constant(name, is));
        }
    }

    fn parameters(&mut self, pair: P<'t>) -> Vec<Parameter> {
        let mut parameters: Vec<Parameter> = Vec::new();
        for part in pair.into_inner() {
            let mut kind = None;
            for word in part.into_inner() {
                match word.as_rule() {
                    Rule::kind => kind = self.kind(word),
                    _ => {
                        let name = self.ident(&word);
                        self.not_constant(&name);
                        if let Some(first) = parameters.iter().find(|p| p.name.name == name.name) {
                            self.diagnostics.push(explain::parameter_twice(&name, first.name.span));
                        }
                        parameters.push(Parameter { name, kind: kind.take() });
                    }
                }
            }
        }
        parameters
    }

    fn kind(&mut self, pair: P<'t>) -> Option<(ParameterKind, Arc<str>)> {
        let words = pair.into_inner().next()?;
        let written = words.as_str();
        let kind = match written.to_ascii_lowercase().replace(' ', "").as_str() {
            "gob" | "pob" | "gob/pob" | "pob/gob" | "real" => ParameterKind::Scalar,
            "array" => ParameterKind::Array,
            "text" => ParameterKind::Text,
            "function" => ParameterKind::Function,
            _ => {
                let span = self.span(&words);
                self.diagnostics.push(explain::unknown_kind(written, span));
                return None;
            }
        };
        Some((kind, Arc::from(written)))
    }

    fn range(&mut self, pair: P<'t>) -> Option<Range> {
        let inner = pair.into_inner();
        let step = inner.clone().find(|p| p.as_rule() == Rule::step);
        let mut bounds = self.exprs(inner).into_iter();
        let step = step.and_then(|step| self.exprs(step.into_inner()).pop());
        Some(Range { lo: bounds.next()?, hi: bounds.next()?, step })
    }

    fn element(&mut self, inner: Pairs<'t, Rule>) -> StatementKind {
        let mut name = None;
        let mut indices = Vec::new();
        let mut value = None;
        for part in inner {
            match part.as_rule() {
                Rule::name => name = Some(self.ident(&part)),
                Rule::index => indices.extend(self.exprs(part.into_inner())),
                Rule::value => value = Some(self.value(part)),
                _ => {}
            }
        }
        match (name, value) {
            (Some(name), Some(value)) => StatementKind::Element { name, indices, value },
            _ => StatementKind::failed(),
        }
    }

    fn type_(&mut self, mut inner: Pairs<'t, Rule>) -> StatementKind {
        let subject = inner.next().and_then(|s| s.into_inner().next());
        let (Some(subject), Some(kind)) = (subject, inner.next()) else {
            return StatementKind::failed();
        };
        if let Some(digits) = coordinate_digits(subject.as_str()) {
            self.coordinate(digits, &subject);
        }
        let subject = self.ident(&subject);
        let kind = self.geometric_type(kind);
        StatementKind::Type { subject, kind }
    }

    fn geometric_type(&mut self, pair: P<'t>) -> GeometricType {
        if pair.as_rule() == Rule::axis {
            return match pair.as_str().to_ascii_uppercase().as_str() {
                "X" => GeometricType::X,
                "Y" => GeometricType::Y,
                "Z" => GeometricType::Z,
                "T" => GeometricType::T,
                "V" => GeometricType::V,
                "W" => GeometricType::W,
                _ => GeometricType::C,
            };
        }
        let coloured = pair.as_rule() == Rule::coloured;
        let mut inner = pair.into_inner();
        let word = inner.next().map_or("", |w| w.as_str()).to_ascii_uppercase();
        if coloured {
            let range = inner.clone().find(|p| p.as_rule() == Rule::colour_range);
            let range = range.and_then(|r| <[Expr; 2]>::try_from(self.exprs(r.into_inner())).ok());
            return GeometricType::Color(self.exprs(inner).pop(), range.map(Box::new));
        }
        let value = self.exprs(inner).pop();
        match word.as_str() {
            "CONSTANT" => GeometricType::Constant(value),
            "G" => GeometricType::Group(value),
            _ => GeometricType::Center(value),
        }
    }
}

fn single_expression(statements: &[Statement]) -> Option<Expr> {
    match statements {
        [Statement { kind: StatementKind::Expression(expr), .. }] => Some(expr.clone()),
        _ => None,
    }
}

/// `IF c THEN a ELSE b WHERE ...`: the WHERE is of the whole, not of `b`; one of `a` is put in parentheses.
fn if_expression(keyword: Span, condition: Expr, then: Expr, otherwise: Option<Expr>) -> Expr {
    let then = match then.kind {
        ExprKind::Where { .. } => Expr { span: then.span, kind: ExprKind::Paren(Box::new(then)) },
        _ => then,
    };
    let (otherwise, bindings) = match otherwise {
        Some(Expr { kind: ExprKind::Where { body, bindings }, .. }) => (Some(*body), bindings),
        other => (other, Vec::new()),
    };
    let span = keyword.to(otherwise.as_ref().map_or(then.span, |o| o.span));
    let kind =
        ExprKind::If { condition: Box::new(condition), then: Box::new(then), otherwise: otherwise.map(Box::new) };
    let whole = Expr { kind, span };
    match bindings.last() {
        Some((_, last)) => {
            let span = span.to(last.span);
            Expr { kind: ExprKind::Where { body: Box::new(whole), bindings }, span }
        }
        None => whole,
    }
}
