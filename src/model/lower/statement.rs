//! Statements inside bodies, loops and branches: run over local names. A loop whose condition is a number is unrolled; one whose
//! condition depends on a coordinate becomes a loop that runs at each point, or, where its body needs numbers, a choice after each turn.

use std::sync::Arc;

use crate::diagnostic::Diagnostic;
use crate::source::Span;
use crate::syntax::tree::{Body, Expr, GeometricType, Ident, Name, Range, Statement, StatementKind};

use super::super::errors;
use super::super::names;
use super::super::value::{Active, Array, Scalar, Value};
use super::{Fault, Lower, Lowered, Slot, system_of};

/// Turns of a loop that depends on a coordinate and is unrolled all the same, before it is refused.
const POINT_TURNS: usize = 10_000;

impl Lower<'_> {
    /// Runs the statements of a body, a loop or a branch; the system of R-functions that they set ends with them.
    pub(super) fn block(&mut self, block: &[Statement]) -> Lowered<()> {
        let system = self.active.clone();
        let done = block.iter().try_for_each(|s| self.exec(s));
        self.active = system;
        done
    }

    /// Runs a statement of a body, a loop or a branch.
    pub(super) fn exec(&mut self, statement: &Statement) -> Lowered<()> {
        match &statement.kind {
            StatementKind::Define { name, parameters: Some(_), .. } => {
                let value = self.local_function(&name.name, statement)?;
                self.set_local(&name.name, value);
                Ok(())
            }
            StatementKind::Define { name, body, .. } => self.assign(name, body),
            StatementKind::Element { name, indices, value } => self.element(name, indices, value),
            StatementKind::If { condition, then, otherwise } => {
                self.branch(condition, then, otherwise.as_deref().unwrap_or_default(), statement.span)
            }
            StatementKind::While { condition, body } => self.repeat(condition, body, statement.span),
            StatementKind::For { index, from, to, step, body } => {
                self.count(index, (from, to, step.as_ref()), body, statement.span)
            }
            StatementKind::Type { .. }
            | StatementKind::Include { .. }
            | StatementKind::Print { .. }
            | StatementKind::Expression(_)
            | StatementKind::Failed { .. } => Err(errors::not_in_a_body(statement).into()),
        }
    }

    fn assign(&mut self, name: &Ident, body: &Body) -> Lowered<()> {
        let value = match body {
            Body::Expression(e) => self.expr(e)?,
            Body::Block(block) => self.nested_body(name, block)?,
        };
        if names::is_system(&name.name) {
            let system =
                system_of(&name.name, &value).ok_or_else(|| errors::bad_system(&name.name, &value, name.span))?;
            self.active = Active::Is(system);
            return Ok(());
        }
        self.set_local(&name.name, value);
        Ok(())
    }

    fn nested_body(&mut self, name: &Ident, block: &[Statement]) -> Lowered<Value> {
        let before = self.locals.len();
        let locals = names::assigned(block).into_iter();
        self.locals.extend(locals.map(|name| super::Local { name, slot: Slot::Unset }));
        self.block(block)?;
        let value = self.local(&name.name, name.span)?;
        self.locals.truncate(before);
        Ok(value)
    }

    fn branch(&mut self, condition: &Expr, then: &[Statement], otherwise: &[Statement], span: Span) -> Lowered<()> {
        let c = self.scalar(condition, "a condition")?;
        if let Scalar::Number(value) = c {
            return self.block(if is_true(value) { then } else { otherwise });
        }
        let names = union_of(names::assigned(then), names::assigned(otherwise));
        let before = self.slots(&names);
        self.block(then)?;
        let taken = self.slots(&names);
        self.put_slots(&names, before);
        self.block(otherwise)?;
        let other = self.slots(&names);
        self.merge(c, &names, taken, other, span)
    }

    fn repeat(&mut self, condition: &Expr, body: &[Statement], span: Span) -> Lowered<()> {
        let names = names::assigned(body);
        let mut undecided: Vec<(Scalar, Vec<Slot>)> = Vec::new();
        loop {
            let c = self.scalar(condition, "the condition of a loop")?;
            match c {
                Scalar::Number(value) if !is_true(value) => break,
                Scalar::Number(_) => {}
                Scalar::Node(id) => {
                    if undecided.is_empty() && self.at_each_point(condition, body, &names)? {
                        return Ok(());
                    }
                    if undecided.len() >= POINT_TURNS {
                        let coordinates = self.graph.coordinates(id);
                        return Err(errors::unbounded_loop(coordinates, POINT_TURNS, condition.span).into());
                    }
                    undecided.push((c, self.slots(&names)));
                }
            }
            self.turn(span)?;
            self.block(body)?;
        }
        for (c, before) in undecided.into_iter().rev() {
            let after = self.slots(&names);
            self.merge(c, &names, after, before, span)?;
        }
        Ok(())
    }

    fn count(
        &mut self,
        index: &Ident,
        (from, to, step): (&Expr, &Expr, Option<&Expr>),
        body: &[Statement],
        span: Span,
    ) -> Lowered<()> {
        let first = self.number(from, "a bound of FOR")?;
        let last = self.number(to, "a bound of FOR")?;
        let by = step.map_or(Ok(1.0), |e| self.number(e, "the STEP of FOR"))?;
        let turns = ((last - first) / by + 1e-10).floor();
        if by == 0.0 || !turns.is_finite() {
            return Err(errors::endless(step.map_or(span, |e| e.span)).into());
        }
        let mut k = 0.0;
        while k <= turns {
            self.turn(span)?;
            self.let_in(&index.name, Value::number(first + k * by), |lower| lower.block(body))?;
            k += 1.0;
        }
        Ok(())
    }

    pub(super) fn slots(&self, names: &[Name]) -> Vec<Slot> {
        let find = |name: &Name| self.locals[self.frame..].iter().rev().find(|l| l.name == *name);
        names.iter().map(|name| find(name).map_or(Slot::Unset, |l| l.slot.clone())).collect()
    }

    pub(super) fn put_slots(&mut self, names: &[Name], slots: Vec<Slot>) {
        let frame = self.frame;
        for (name, slot) in names.iter().zip(slots) {
            if let Some(local) = self.locals[frame..].iter_mut().rev().find(|l| l.name == *name) {
                local.slot = slot;
            }
        }
    }

    /// Each name takes its value of `a` where the condition holds, of `b` elsewhere.
    fn merge(&mut self, c: Scalar, names: &[Name], a: Vec<Slot>, b: Vec<Slot>, span: Span) -> Lowered<()> {
        let mut merged = Vec::with_capacity(names.len());
        for (a, b) in a.into_iter().zip(b) {
            merged.push(match (a, b) {
                (Slot::Is(a), Slot::Is(b)) => Slot::Is(self.select(c, &a, &b, span)?),
                (Slot::Is(a), Slot::Unset) => Slot::Is(self.else_undefined(c, &a, span)?),
                (Slot::Unset, Slot::Is(b)) => {
                    let not = crate::number::Algebra::unary(&mut self.scalars(), crate::number::Unary::Not, c);
                    Slot::Is(self.else_undefined(not, &b, span)?)
                }
                (failed @ Slot::Failed(_), _) | (_, failed) => failed,
            });
        }
        self.put_slots(names, merged);
        Ok(())
    }

    fn else_undefined(&mut self, c: Scalar, value: &Value, span: Span) -> Lowered<Value> {
        match value {
            Value::Function(_) | Value::Text(_) => Ok(value.clone()),
            _ => self.each(value, span, &mut |lower, s| Ok(lower.undefined_unless(c, s))),
        }
    }

    /// `IN [lo, hi] STEP s`: numbers, in order, around the value.
    pub(in crate::model) fn check_range(&mut self, name: &str, value: &Value, range: &Range) -> Lowered<()> {
        let lo = self.number(&range.lo, "a bound of a range")?;
        let hi = self.number(&range.hi, "a bound of a range")?;
        if lo > hi || lo.is_nan() || hi.is_nan() {
            return Err(errors::empty_range(lo, hi, range.lo.span.to(range.hi.span)).into());
        }
        if let Some(step) = &range.step {
            let by = self.number(step, "the STEP of a range")?;
            if by.is_nan() || by <= 0.0 {
                return Err(errors::bad_step(by, step.span).into());
            }
        }
        match value {
            Value::Scalar(Scalar::Number(v)) if (lo..=hi).contains(v) => Ok(()),
            Value::Scalar(Scalar::Number(v)) => {
                self.warnings.push(errors::outside_range(name, *v, lo, hi, range.lo.span.to(range.hi.span)));
                Ok(())
            }
            other => Err(errors::range_needs_number(name, other, range.lo.span.to(range.hi.span)).into()),
        }
    }

    /// The value behind a geometric type: a number, an array of numbers, or 0 where there is none; of a colour what
    /// [`Lower::colour`] makes.
    pub(super) fn type_value(&mut self, kind: &GeometricType) -> Lowered<Value> {
        if let GeometricType::Color(Some(e), range) = kind {
            return self.colour(e, range.as_deref());
        }
        let (GeometricType::Constant(e) | GeometricType::Group(e) | GeometricType::Center(e)) = kind else {
            return Ok(Value::number(0.0));
        };
        let Some(e) = e else { return Ok(Value::number(0.0)) };
        let value = self.expr(e)?;
        let number = |v: &Value| matches!(v, Value::Scalar(Scalar::Number(n)) if !n.is_nan());
        let fits = match (&value, kind) {
            (v, GeometricType::Constant(_)) => number(v),
            (Value::Array(a), _) => !a.items().is_empty() && a.items().iter().all(number),
            _ => false,
        };
        if fits { Ok(value) } else { Err(Fault::from(bad_type_value(kind, &value, e.span))) }
    }

    /// The value of COLOR: three scalars, or a scalar and the array of the range over which a palette shows it.
    fn colour(&mut self, e: &Expr, range: Option<&[Expr; 2]>) -> Lowered<Value> {
        let value = self.expr(e)?;
        let is_scalar = |v: &Value| matches!(v, Value::Scalar(_));
        let shown = match &value {
            Value::Array(a) if a.items().len() == 3 && a.items().iter().all(is_scalar) => {
                let part = |v: &Value| if let Value::Scalar(Scalar::Number(v)) = v { Some(*v) } else { None };
                if let Some(v) = a.items().iter().filter_map(part).find(|v| !(-1e-9..=1.0 + 1e-9).contains(v)) {
                    return Err(errors::colour_outside(v, e.span).into());
                }
                let Some([lo, hi]) = range else { return Ok(value) };
                return Err(errors::colour_with_range(lo.span.to(hi.span)).into());
            }
            Value::Array(a) if a.items().len() == 1 && is_scalar(&a.items()[0]) => a.items()[0].clone(),
            Value::Scalar(_) => value,
            _ => return Err(errors::bad_colour(&value, e.span).into()),
        };
        let (mut lo, mut hi) = (0.0, 1.0);
        if let Some([from, to]) = range {
            lo = self.number(from, "the range of a COLOR")?;
            hi = self.number(to, "the range of a COLOR")?;
            if lo == hi || !(hi - lo).is_finite() {
                return Err(errors::empty_range(lo, hi, from.span.to(to.span)).into());
            }
        }
        let range = Value::Array(Arc::new(Array::new(vec![Value::number(lo), Value::number(hi)])));
        Ok(Value::Array(Arc::new(Array::new(vec![shown, range]))))
    }
}

fn bad_type_value(kind: &GeometricType, value: &Value, span: Span) -> Diagnostic {
    match kind {
        GeometricType::Constant(_) => errors::needs_scalar("a CONSTANT", value, span),
        GeometricType::Group(_) => errors::needs_numbers("G", value, span),
        _ => errors::needs_numbers("CENTER", value, span),
    }
}

fn is_true(value: f64) -> bool {
    value != 0.0 && !value.is_nan()
}

fn union_of(mut a: Vec<Name>, b: Vec<Name>) -> Vec<Name> {
    for name in b {
        if !a.contains(&name) {
            a.push(name);
        }
    }
    a
}
