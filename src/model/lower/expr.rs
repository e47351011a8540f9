//! Expressions to values. One small function per kind of expression.

use std::sync::Arc;

use crate::field::{Coordinate, NodeId};
use crate::number::Reals;
use crate::source::Span;
use crate::syntax::tree::{Expr, ExprKind, Ident, Mapping, Name};
use crate::vm::reference;

use super::super::errors;
use super::super::value::{Scalar, Value};
use super::{DEPTH, Local, Lower, Lowered, Slot};

impl Lower<'_> {
    /// The value of an expression.
    pub(super) fn expr(&mut self, e: &Expr) -> Lowered<Value> {
        if self.depth >= DEPTH {
            return Err(errors::too_deep(self.world.limits.call_depth, e.span).into());
        }
        self.world.interrupt.tick()?;
        self.depth += 1;
        let value = self.kind(e);
        self.depth -= 1;
        value
    }

    fn kind(&mut self, e: &Expr) -> Lowered<Value> {
        match &e.kind {
            ExprKind::Number(value) => Ok(Value::number(*value)),
            ExprKind::Pi => Ok(Value::number(std::f64::consts::PI)),
            ExprKind::Infinity => Ok(Value::number(f64::INFINITY)),
            ExprKind::Text(text) => Ok(Value::Text(text.clone())),
            ExprKind::Coordinate(c) => Ok(self.coordinate(*c)),
            ExprKind::Name(name) => self.name(name, e.span),
            ExprKind::Array(items) => self.literal(items, e.span),
            ExprKind::Paren(inner) => self.expr(inner),
            ExprKind::Chain { first, rest } => self.chain(first, rest),
            ExprKind::Compare { first, rest } => self.compare(first, rest),
            ExprKind::Prefix { op, operand } => self.prefix(*op, operand),
            ExprKind::Power { base, exponent } => self.power(base, exponent),
            ExprKind::Index { base, indices } => self.index(base, indices),
            ExprKind::Call { callee, arguments } => self.call(callee, arguments, e.span),
            ExprKind::Fold { op, index, from, to, body } => self.fold(*op, index, (from, to), body, e.span),
            ExprKind::At { body, mapping } => self.at(body, mapping, e.span),
            ExprKind::If { condition, then, otherwise } => self.choose(condition, then, otherwise.as_deref(), e.span),
            ExprKind::Where { body, bindings } => self.with(body, bindings),
            ExprKind::Setting { name, .. } => Err(errors::stray_setting(&name.name, e.span).into()),
        }
    }

    /// A coordinate as a value.
    pub(super) fn coordinate(&mut self, c: u8) -> Value {
        Value::Scalar(Scalar::Node(self.graph.coordinate(Coordinate(c))))
    }

    /// A scalar expression; `place` names what needs it.
    pub(super) fn scalar(&mut self, e: &Expr, place: &str) -> Lowered<Scalar> {
        let value = self.expr(e)?;
        self.as_scalar(&value, e.span, place)
    }

    /// An expression that must be a number, free of coordinates.
    pub(super) fn number(&mut self, e: &Expr, place: &str) -> Lowered<f64> {
        match self.scalar(e, place)? {
            Scalar::Number(value) => Ok(value),
            Scalar::Node(id) => Err(errors::needs_number(place, self.graph.coordinates(id), e.span).into()),
        }
    }

    fn literal(&mut self, items: &[Expr], span: Span) -> Lowered<Value> {
        let mut values = Vec::with_capacity(items.len());
        for item in items {
            let value = self.expr(item)?;
            if matches!(value, Value::Text(_) | Value::Function(_)) {
                return Err(errors::not_an_element(&value, item.span).into());
            }
            values.push(value);
        }
        self.array(values, span)
    }

    fn choose(&mut self, condition: &Expr, then: &Expr, otherwise: Option<&Expr>, span: Span) -> Lowered<Value> {
        let c = self.scalar(condition, "a condition")?;
        if let Scalar::Number(value) = c {
            return match (value != 0.0 && !value.is_nan(), otherwise) {
                (true, _) => self.expr(then),
                (false, Some(otherwise)) => self.expr(otherwise),
                (false, None) => Ok(Value::number(f64::NAN)),
            };
        }
        let a = self.expr(then)?;
        let b = match otherwise {
            Some(otherwise) => self.expr(otherwise)?,
            None => self.each(&a, then.span, &mut |_, _| Ok(Scalar::Number(f64::NAN)))?,
        };
        self.select(c, &a, &b, span)
    }

    fn with(&mut self, body: &Expr, bindings: &[(Ident, Expr)]) -> Lowered<Value> {
        let before = self.locals.len();
        for (name, e) in bindings {
            let value = self.expr(e)?;
            self.locals.push(Local { name: name.name.clone(), slot: Slot::Is(value) });
        }
        let value = self.expr(body)?;
        self.locals.truncate(before);
        Ok(value)
    }

    fn at(&mut self, body: &Expr, mapping: &Mapping, span: Span) -> Lowered<Value> {
        let value = self.expr(body)?;
        match mapping {
            Mapping::Positional(arguments) => self.at_positional(&value, arguments, span),
            Mapping::Named(all) => {
                let all: Vec<(u8, Span, &Expr)> = all.iter().map(|(c, place, e)| (*c, *place, e)).collect();
                self.at_named(&value, &all, span)
            }
        }
    }

    /// `value AT (e1, ..., ek)`; one array spreads.
    pub(super) fn at_positional(&mut self, value: &Value, arguments: &[Expr], span: Span) -> Lowered<Value> {
        let mut points = Vec::with_capacity(arguments.len());
        for e in arguments {
            points.push((self.expr(e)?, e.span));
        }
        if let [(Value::Array(array), at)] = &points[..] {
            points = array.items().iter().map(|v| (v.clone(), *at)).collect();
        }
        if points.len() > 16 {
            return Err(errors::too_many_coordinates(points.len(), span).into());
        }
        let mut mapping = Vec::with_capacity(points.len());
        for (c, (point, at)) in (1..).zip(&points) {
            let node = self.as_scalar(point, *at, "a coordinate of AT")?.node(self.graph);
            mapping.push((Coordinate(c), node));
        }
        self.mapped(value, &mapping, span)
    }

    /// `value AT (x3 = u, x1 = v)`.
    pub(super) fn at_named(&mut self, value: &Value, all: &[(u8, Span, &Expr)], span: Span) -> Lowered<Value> {
        let mut mapping: Vec<(Coordinate, NodeId)> = Vec::with_capacity(all.len());
        for (c, place, e) in all {
            if mapping.iter().any(|(seen, _)| seen.0 == *c) {
                return Err(errors::coordinate_twice(Coordinate(*c), *place).into());
            }
            let node = self.scalar(e, "a coordinate of AT")?.node(self.graph);
            mapping.push((Coordinate(*c), node));
        }
        self.mapped(value, &mapping, span)
    }

    fn mapped(&mut self, value: &Value, mapping: &[(Coordinate, NodeId)], span: Span) -> Lowered<Value> {
        if value.coordinates(self.graph).is_empty() && matches!(value, Value::Scalar(_) | Value::Array(_)) {
            self.warnings.push(errors::at_without_coordinates(span));
        }
        self.each(value, span, &mut |lower, s| match s {
            Scalar::Number(_) => Ok(s),
            Scalar::Node(body) => {
                let id = lower.graph.map(body, mapping);
                if lower.graph.coordinates(id).is_empty() && lower.graph.number(id).is_none() {
                    return Ok(Scalar::Number(reference::eval(&mut Reals, lower.graph, id, &[])));
                }
                Ok(lower.wrap(id))
            }
        })
    }

    /// A name bound to a value while `f` runs.
    pub(super) fn let_in<T>(
        &mut self,
        name: &Name,
        value: Value,
        f: impl FnOnce(&mut Self) -> Lowered<T>,
    ) -> Lowered<T> {
        self.bound(vec![Local { name: name.clone(), slot: Slot::Is(value) }], f)
    }

    /// What PRINT shows: its items, one space apart.
    pub(super) fn printed(&mut self, items: &[Expr]) -> Lowered<String> {
        let mut parts = Vec::with_capacity(items.len());
        for item in items {
            let value = self.expr(item)?;
            parts.push(self.shown(item, &value));
        }
        Ok(parts.join(" "))
    }

    /// A value as PRINT and the prompt show it; an object that is asked for by its name says so.
    fn shown(&self, e: &Expr, value: &Value) -> String {
        match (&e.kind, value) {
            (ExprKind::Name(name), Value::Scalar(Scalar::Node(_))) if name.starts_with("gob_") => {
                super::super::session::line(name, value, self.graph)
            }
            _ => value.show(self.graph),
        }
    }

    /// A text argument.
    pub(super) fn text(&mut self, e: &Expr, place: &str) -> Lowered<Arc<str>> {
        match self.expr(e)? {
            Value::Text(text) => Ok(text),
            other => Err(errors::needs_text(place, &other, e.span).into()),
        }
    }
}
