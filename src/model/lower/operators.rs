//! Operators on values: arithmetic by element, comparisons, truths and the set operations in the system in force. What can be known
//! to be undefined is an error here. Knows nothing of names.

use std::sync::Arc;

use crate::number::{Algebra, Binary, Ternary, Unary};
use crate::source::Span;
use crate::syntax::tree::{ChainOp, CompareOp, Expr, PrefixOp};

use super::super::errors;
use super::super::value::{Array, Scalar, System, Value};
use super::{Lower, Lowered};

impl Lower<'_> {
    /// A scalar, or an error that says what it is instead.
    pub(super) fn as_scalar(&self, value: &Value, span: Span, place: &str) -> Lowered<Scalar> {
        match value {
            Value::Scalar(scalar) => Ok(*scalar),
            other => Err(errors::needs_scalar(place, other, span).into()),
        }
    }

    /// `first op e op e ...`, left to right.
    pub(super) fn chain(&mut self, first: &Expr, rest: &[(ChainOp, Span, Expr)]) -> Lowered<Value> {
        let mut value = self.expr(first)?;
        let mut span = first.span;
        for (op, _, operand) in rest {
            if let Some(known) = decided(*op, &value) {
                value = known;
                continue;
            }
            let right = self.expr(operand)?;
            value = self.chained(*op, (&value, span), (&right, operand.span))?;
            span = span.to(operand.span);
        }
        Ok(value)
    }

    fn chained(&mut self, op: ChainOp, (a, at): (&Value, Span), (b, bt): (&Value, Span)) -> Lowered<Value> {
        let arithmetic = match op {
            ChainOp::Add => Binary::Add,
            ChainOp::Sub => Binary::Sub,
            ChainOp::Mul => Binary::Mul,
            ChainOp::Div => Binary::Div,
            _ => {
                let place = errors::operand_of(op);
                let a = self.as_scalar(a, at, place)?;
                let b = self.as_scalar(b, bt, place)?;
                return self.scalar_chain(op, a, b, at.to(bt)).map(Value::Scalar);
            }
        };
        self.arithmetic(arithmetic, a, b, at, bt)
    }

    fn scalar_chain(&mut self, op: ChainOp, a: Scalar, b: Scalar, span: Span) -> Lowered<Scalar> {
        match op {
            ChainOp::And => Ok(self.scalars().binary(Binary::And, a, b)),
            ChainOp::Or => Ok(self.scalars().binary(Binary::Or, a, b)),
            ChainOp::Union => self.union(a, b, span),
            ChainOp::Intersect => self.intersection(a, b, span),
            ChainOp::Subtract => {
                let b = self.scalars().unary(Unary::Neg, b);
                self.intersection(a, b, span)
            }
            _ => {
                self.note_product(a, b);
                self.intersection(a, b, span)
            }
        }
    }

    /// `@` is `&` between objects that should share no coordinate: which they have is told when somebody asks.
    fn note_product(&mut self, a: Scalar, b: Scalar) {
        let (Scalar::Node(a), Scalar::Node(b), Some(definition)) = (a, b, &self.current) else { return };
        self.state.note_product(definition.id, [self.graph.coordinates(a), self.graph.coordinates(b)]);
    }

    /// `a | b` in the system in force.
    pub(super) fn union(&mut self, a: Scalar, b: Scalar, span: Span) -> Lowered<Scalar> {
        let system = self.system(span)?;
        let mut algebra = self.scalars();
        Ok(match system {
            System::Alpha(Scalar::Number(1.0)) => algebra.binary(Binary::Max, a, b),
            System::Alpha(alpha) => algebra.ternary(Ternary::Union, a, b, alpha),
            System::Smooth(m) => algebra.ternary(Ternary::UnionSmooth, a, b, Scalar::Number(m)),
        })
    }

    /// `a & b` in the system in force.
    pub(super) fn intersection(&mut self, a: Scalar, b: Scalar, span: Span) -> Lowered<Scalar> {
        let system = self.system(span)?;
        let mut algebra = self.scalars();
        Ok(match system {
            System::Alpha(Scalar::Number(1.0)) => algebra.binary(Binary::Min, a, b),
            System::Alpha(alpha) => algebra.ternary(Ternary::Intersection, a, b, alpha),
            System::Smooth(m) => algebra.ternary(Ternary::IntersectionSmooth, a, b, Scalar::Number(m)),
        })
    }

    /// Arithmetic on two values, by element where one is an array.
    pub(super) fn arithmetic(&mut self, op: Binary, a: &Value, b: &Value, at: Span, bt: Span) -> Lowered<Value> {
        match (a, b) {
            (Value::Scalar(Scalar::Node(_)), Value::Scalar(Scalar::Number(0.0))) if op == Binary::Div => {
                Err(errors::divides_by_zero(at.to(bt), bt).into())
            }
            (Value::Scalar(x), Value::Scalar(y)) => {
                let result = self.scalars().binary(op, *x, *y);
                errors::check_defined(&[*x, *y], result, || errors::operation(op, *x, *y), at.to(bt))?;
                Ok(Value::Scalar(result))
            }
            (Value::Array(x), Value::Array(y)) => {
                if x.items().len() != y.items().len() {
                    return Err(errors::lengths_differ(x.items().len(), y.items().len(), at, bt).into());
                }
                let pairs = x.items().iter().zip(y.items());
                let items: Lowered<Vec<Value>> = pairs.map(|(x, y)| self.arithmetic(op, x, y, at, bt)).collect();
                self.array(items?, at.to(bt))
            }
            (Value::Array(x), Value::Scalar(_)) => {
                let items: Lowered<Vec<Value>> = x.items().iter().map(|x| self.arithmetic(op, x, b, at, bt)).collect();
                self.array(items?, at.to(bt))
            }
            (Value::Scalar(_), Value::Array(y)) => {
                let items: Lowered<Vec<Value>> = y.items().iter().map(|y| self.arithmetic(op, a, y, at, bt)).collect();
                self.array(items?, at.to(bt))
            }
            (Value::Scalar(_) | Value::Array(_), other) => Err(errors::no_arithmetic(other, bt).into()),
            (other, _) => Err(errors::no_arithmetic(other, at).into()),
        }
    }

    /// The same on each scalar of a value.
    pub(super) fn each(
        &mut self,
        value: &Value,
        span: Span,
        f: &mut impl FnMut(&mut Self, Scalar) -> Lowered<Scalar>,
    ) -> Lowered<Value> {
        match value {
            Value::Scalar(scalar) => f(self, *scalar).map(Value::Scalar),
            Value::Array(array) => {
                let items: Lowered<Vec<Value>> = array.items().iter().map(|v| self.each(v, span, f)).collect();
                self.array(items?, span)
            }
            other => Err(errors::no_arithmetic(other, span).into()),
        }
    }

    pub(super) fn prefix(&mut self, op: PrefixOp, operand: &Expr) -> Lowered<Value> {
        let value = self.expr(operand)?;
        match op {
            PrefixOp::Plus => self.each(&value, operand.span, &mut |_, s| Ok(s)),
            PrefixOp::Minus => {
                self.each(&value, operand.span, &mut |lower, s| Ok(lower.scalars().unary(Unary::Neg, s)))
            }
            PrefixOp::Complement => {
                let scalar = self.as_scalar(&value, operand.span, "an operand of `~`")?;
                Ok(Value::Scalar(self.scalars().unary(Unary::Neg, scalar)))
            }
            PrefixOp::Not => {
                let scalar = self.as_scalar(&value, operand.span, "an operand of NOT")?;
                Ok(Value::Scalar(self.scalars().unary(Unary::Not, scalar)))
            }
        }
    }

    /// `a < b <= c`: all of them hold.
    pub(super) fn compare(&mut self, first: &Expr, rest: &[(CompareOp, Span, Expr)]) -> Lowered<Value> {
        let mut left = self.compared(first)?;
        let mut all = None;
        for (op, _, operand) in rest {
            let right = self.compared(operand)?;
            let mut algebra = self.scalars();
            let holds = match op {
                CompareOp::Less => algebra.binary(Binary::Less, left, right),
                CompareOp::LessEqual => algebra.binary(Binary::LessEqual, left, right),
                CompareOp::Greater => algebra.binary(Binary::Less, right, left),
                CompareOp::GreaterEqual => algebra.binary(Binary::LessEqual, right, left),
                CompareOp::Equal => algebra.binary(Binary::Equal, left, right),
                CompareOp::NotEqual => algebra.binary(Binary::NotEqual, left, right),
            };
            all = Some(match all {
                None => holds,
                Some(before) => algebra.binary(Binary::And, before, holds),
            });
            left = right;
        }
        Ok(Value::Scalar(all.unwrap_or(Scalar::Number(1.0))))
    }

    fn compared(&mut self, e: &Expr) -> Lowered<Scalar> {
        let value = self.expr(e)?;
        self.as_scalar(&value, e.span, "an operand of a comparison")
    }

    pub(super) fn power(&mut self, base: &Expr, exponent: &Expr) -> Lowered<Value> {
        let a = self.expr(base)?;
        let b = self.expr(exponent)?;
        let span = base.span.to(exponent.span);
        match whole(&b) {
            Some(n) => self.each(&a, base.span, &mut |lower, s| {
                let result = lower.scalars().unary(Unary::Powi(n), s);
                let shown = || errors::operation(Binary::Pow, s, Scalar::Number(f64::from(n)));
                errors::check_defined(&[s], result, shown, span)?;
                Ok(result)
            }),
            None => self.arithmetic(Binary::Pow, &a, &b, base.span, exponent.span),
        }
    }

    /// An array, if it is within the limits.
    pub(super) fn array(&self, items: Vec<Value>, span: Span) -> Lowered<Value> {
        let array = Array::new(items);
        let limit = self.world.limits.array_elements;
        if array.elements() > limit {
            return Err(errors::array_too_large(limit, span).into());
        }
        if array.depth() > super::super::value::ARRAY_DEPTH {
            return Err(errors::array_too_deep(super::super::value::ARRAY_DEPTH, span).into());
        }
        Ok(Value::Array(Arc::new(array)))
    }

    /// `condition` true: `a`, else `b`, at each point; arrays by element. A name that only one of them has is undefined elsewhere.
    pub(super) fn select(&mut self, condition: Scalar, a: &Value, b: &Value, span: Span) -> Lowered<Value> {
        if a.same(b) {
            return Ok(a.clone());
        }
        match (a, b) {
            (Value::Scalar(x), Value::Scalar(y)) => {
                Ok(Value::Scalar(self.scalars().ternary(Ternary::Select, condition, *x, *y)))
            }
            (Value::Array(x), Value::Array(y)) if x.items().len() == y.items().len() => {
                let pairs = x.items().iter().zip(y.items());
                let items: Lowered<Vec<Value>> = pairs.map(|(x, y)| self.select(condition, x, y, span)).collect();
                self.array(items?, span)
            }
            _ => Err(errors::branches_differ(a, b, span).into()),
        }
    }
}

/// AND after a falsehood and OR after a truth need no further operand.
fn decided(op: ChainOp, left: &Value) -> Option<Value> {
    let Value::Scalar(Scalar::Number(value)) = left else { return None };
    let truth = *value != 0.0 && !value.is_nan();
    match op {
        ChainOp::And if !truth => Some(Value::number(0.0)),
        ChainOp::Or if truth => Some(Value::number(1.0)),
        _ => None,
    }
}

/// A whole constant exponent of a size for which repeated squaring is the better way.
fn whole(value: &Value) -> Option<i32> {
    let Value::Scalar(Scalar::Number(n)) = value else { return None };
    #[allow(clippy::cast_possible_truncation)]
    (n.fract() == 0.0 && n.abs() <= 1024.0).then_some(*n as i32)
}
