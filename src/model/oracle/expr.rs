//! Expressions of the oracle: operators, mappings, folds, in plain arithmetic.

use std::rc::Rc;

use super::{Answer, Beyond, Binding, Later, Oracle, Point, Scope, Source, System, Value};
use crate::syntax::tree::{ChainOp, CompareOp, Expr, ExprKind, FoldOp, Mapping, PrefixOp};

impl Oracle {
    /// The value of an expression at a point.
    pub(super) fn expr(&self, e: &Expr, scope: &Scope, system: &System, point: &Point) -> Answer {
        self.deeper(|| match &e.kind {
            ExprKind::Number(n) => Ok(Value::Number(*n)),
            ExprKind::Text(t) => Ok(Value::Text(t.to_string())),
            ExprKind::Pi => Ok(Value::Number(std::f64::consts::PI)),
            ExprKind::Infinity => Ok(Value::Number(f64::INFINITY)),
            ExprKind::Coordinate(c) => match point {
                Some(p) => Ok(Value::Number(p[usize::from(*c) - 1])),
                None => Err(Beyond::NeedsPoint),
            },
            ExprKind::Name(n) => match self.binding(n, scope) {
                Some(binding) => self.force(&binding, point),
                None => Err(Beyond::Unknown(format!("name {n}"))),
            },
            ExprKind::Array(list) => Ok(Value::Array(self.values(list, scope, system, point)?)),
            ExprKind::Paren(e) => self.expr(e, scope, system, point),
            ExprKind::Chain { first, rest } => {
                let mut value = self.expr(first, scope, system, point)?;
                for (op, _, e) in rest {
                    let right = self.expr(e, scope, system, point)?;
                    value = self.chain(*op, value, right, system, scope, point)?;
                }
                Ok(value)
            }
            ExprKind::Compare { first, rest } => self.compare(first, rest, scope, system, point),
            ExprKind::Prefix { op, operand } => {
                let value = self.expr(operand, scope, system, point)?;
                each(value, &|a| prefix(*op, a))
            }
            ExprKind::Power { base, exponent } => {
                let base = self.expr(base, scope, system, point)?;
                let exponent = self.expr(exponent, scope, system, point)?;
                pair(base, exponent, &|a, b| Ok(power(a, b)))
            }
            ExprKind::Index { base, indices } => {
                let base = self.expr(base, scope, system, point)?;
                let at: Vec<f64> =
                    indices.iter().map(|e| self.number(e, scope, system, point)).collect::<Answer<_>>()?;
                element(base, &at)
            }
            ExprKind::Call { callee, arguments } => self.call(callee, arguments, scope, system, point),
            ExprKind::Fold { op, index, from, to, body } => {
                let range = (self.number(from, scope, system, point)?, self.number(to, scope, system, point)?);
                let mut values = Vec::new();
                let mut i = range.0;
                while i <= range.1 {
                    let inner = scope.with(&index.name, Binding::Known(Value::Number(i)));
                    values.push(self.expr(body, &inner, system, point)?);
                    i += 1.0;
                }
                self.fold(*op, values, system, scope, point)
            }
            ExprKind::At { body, mapping } => {
                let mapped = self.mapped(mapping, scope, system, point)?;
                self.expr(body, scope, system, &mapped)
            }
            ExprKind::If { condition, then, otherwise } => {
                let c = self.number(condition, scope, system, point)?;
                match (c != 0.0 && !c.is_nan(), otherwise) {
                    (true, _) => self.expr(then, scope, system, point),
                    (false, Some(e)) => self.expr(e, scope, system, point),
                    (false, None) => Ok(Value::Number(f64::NAN)),
                }
            }
            ExprKind::Where { body, bindings } => {
                let mut inner = scope.clone();
                for (name, e) in bindings {
                    let later = Later {
                        source: Source::Expr(Rc::new(e.clone())),
                        scope: inner.clone(),
                        system: system.clone(),
                        last: std::cell::RefCell::new(None),
                    };
                    inner = inner.with(&name.name, Binding::Later(Rc::new(later)));
                }
                self.expr(body, &inner, system, point)
            }
            ExprKind::Setting { .. } => Err(Beyond::Unknown("a setting".into())),
        })
    }

    /// The value of an expression that must be a number.
    pub(super) fn number(&self, e: &Expr, scope: &Scope, system: &System, point: &Point) -> Answer<f64> {
        number(self.expr(e, scope, system, point)?)
    }

    /// The values of several expressions.
    pub(super) fn values(&self, list: &[Expr], scope: &Scope, system: &System, point: &Point) -> Answer<Vec<Value>> {
        list.iter().map(|e| self.expr(e, scope, system, point)).collect()
    }

    /// Folds values, left to right as written.
    pub(super) fn fold(&self, op: FoldOp, values: Vec<Value>, system: &System, scope: &Scope, point: &Point) -> Answer {
        if op == FoldOp::Array {
            return Ok(Value::Array(values));
        }
        let mut values = values.into_iter();
        let Some(mut all) = values.next() else {
            return match op {
                FoldOp::Sum => Ok(Value::Number(0.0)),
                FoldOp::Product => Ok(Value::Number(1.0)),
                _ => Err(Beyond::Unknown("an empty fold".into())),
            };
        };
        for value in values {
            all = match op {
                FoldOp::Sum => self.chain(ChainOp::Add, all, value, system, scope, point)?,
                FoldOp::Product => self.chain(ChainOp::Mul, all, value, system, scope, point)?,
                FoldOp::Union => self.chain(ChainOp::Union, all, value, system, scope, point)?,
                FoldOp::Intersection => self.chain(ChainOp::Intersect, all, value, system, scope, point)?,
                FoldOp::Minimum => pair(all, value, &|a, b| Ok(minimum(a, b)))?,
                FoldOp::Maximum | FoldOp::Array => pair(all, value, &|a, b| Ok(maximum(a, b)))?,
            };
        }
        Ok(all)
    }

    fn mapped(&self, mapping: &Mapping, scope: &Scope, system: &System, point: &Point) -> Answer<Point> {
        let mut to = match point {
            Some(p) => **p,
            None => return Err(Beyond::NeedsPoint),
        };
        match mapping {
            Mapping::Positional(list) => {
                let mut values = self.values(list, scope, system, point)?;
                if let [Value::Array(spread)] = values.as_slice() {
                    values = spread.clone();
                }
                for (i, value) in values.into_iter().enumerate() {
                    to[i] = number(value)?;
                }
            }
            Mapping::Named(list) => {
                for (c, _, e) in list {
                    to[usize::from(*c) - 1] = self.number(e, scope, system, point)?;
                }
            }
        }
        Ok(Some(Rc::new(to)))
    }

    fn compare(
        &self,
        first: &Expr,
        rest: &[(CompareOp, crate::source::Span, Expr)],
        scope: &Scope,
        system: &System,
        point: &Point,
    ) -> Answer {
        let mut left = self.number(first, scope, system, point)?;
        let mut all = true;
        for (op, _, e) in rest {
            let right = self.number(e, scope, system, point)?;
            all &= match op {
                CompareOp::Less => left < right,
                CompareOp::LessEqual => left <= right,
                CompareOp::Greater => left > right,
                CompareOp::GreaterEqual => left >= right,
                CompareOp::Equal => left == right,
                CompareOp::NotEqual => left.partial_cmp(&right).is_some_and(std::cmp::Ordering::is_ne),
            };
            left = right;
        }
        Ok(Value::Number(truth(all)))
    }

    fn chain(&self, op: ChainOp, a: Value, b: Value, system: &System, scope: &Scope, point: &Point) -> Answer {
        match op {
            ChainOp::Union => self.set(a, b, system, scope, point, &|a, b, r| union(a, b, r)),
            ChainOp::Intersect | ChainOp::Product => {
                self.set(a, b, system, scope, point, &|a, b, r| intersection(a, b, r))
            }
            ChainOp::Subtract => self.set(a, b, system, scope, point, &|a, b, r| intersection(a, -b, r)),
            ChainOp::Add => pair(a, b, &|a, b| Ok(a + b)),
            ChainOp::Sub => pair(a, b, &|a, b| Ok(a - b)),
            ChainOp::Mul => pair(a, b, &|a, b| Ok(a * b)),
            ChainOp::Div => pair(a, b, &|a, b| Ok(a / b)),
            ChainOp::And => pair(a, b, &|a, b| Ok(truth(is_true(a) && is_true(b)))),
            ChainOp::Or => pair(a, b, &|a, b| Ok(truth(is_true(a) || is_true(b)))),
        }
    }

    fn set(
        &self,
        a: Value,
        b: Value,
        system: &System,
        _scope: &Scope,
        point: &Point,
        meaning: &dyn Fn(f64, f64, Rule) -> f64,
    ) -> Answer {
        let top = Scope::default();
        let rule = match system {
            System::Alpha(None) => Rule::Alpha(0.0),
            System::Alpha(Some(e)) => Rule::Alpha(self.number(e, &top, system, point)?),
            System::Smooth(None) => Rule::Smooth(0.0),
            System::Smooth(Some(e)) => Rule::Smooth(self.number(e, &top, system, point)?),
        };
        pair(a, b, &|a, b| Ok(meaning(a, b, rule)))
    }
}

/// Which R-function: `r_alpha` of equation (2), or `r_m` of equation (5).
#[derive(Clone, Copy)]
enum Rule {
    Alpha(f64),
    Smooth(f64),
}

/// The R-union, with the sign that the signs of the operands decide; an undefined operand leaves the other one, an infinite one
/// counts as in the maximum, and a parameter that is out of range makes it undefined.
fn union(a: f64, b: f64, rule: Rule) -> f64 {
    let (alpha, m) = match rule {
        Rule::Alpha(alpha) => (alpha, 0.0),
        Rule::Smooth(m) => (0.0, m),
    };
    if !(alpha > -1.0 && alpha <= 1.0 && m >= 0.0) {
        return f64::NAN;
    }
    if a.is_nan() || b.is_nan() {
        return maximum(a, b);
    }
    let plain = if alpha == 1.0 || a.is_infinite() || b.is_infinite() { a.max(b) } else { r_union(a, b, alpha) };
    let value = if m == 0.0 { plain } else { plain * a.hypot(b).powf(m) };
    if (a >= 0.0 || b >= 0.0) == (value >= 0.0) && !value.is_nan() { value } else { a.max(b) }
}

/// Equation (2) where it does not cancel, and its conjugate where it does.
fn r_union(a: f64, b: f64, alpha: f64) -> f64 {
    let s = a + b;
    let root = (((1.0 - alpha) / 2.0).sqrt() * s).hypot(((1.0 + alpha) / 2.0).sqrt() * (a - b));
    if s >= 0.0 { (s + root) / (1.0 + alpha) } else { 2.0 * a * (b / (s - root)) }
}

fn intersection(a: f64, b: f64, rule: Rule) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { -union(-a, -b, rule) }
}

/// A power; undefined if an operand is, also where any number would give the same.
pub(super) fn power(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.powf(b) }
}

/// The smaller; undefined if one is.
pub(super) fn minimum(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.min(b) }
}

/// The larger; an undefined operand leaves the other one.
pub(super) fn maximum(a: f64, b: f64) -> f64 {
    a.max(b)
}

fn prefix(op: PrefixOp, a: f64) -> Answer<f64> {
    Ok(match op {
        PrefixOp::Minus | PrefixOp::Complement => -a,
        PrefixOp::Plus => a,
        PrefixOp::Not => truth(!is_true(a)),
    })
}

fn truth(holds: bool) -> f64 {
    if holds { 1.0 } else { 0.0 }
}

fn is_true(a: f64) -> bool {
    a != 0.0 && !a.is_nan()
}

/// The number that a value is.
pub(super) fn number(value: Value) -> Answer<f64> {
    match value {
        Value::Number(n) => Ok(n),
        _ => Err(Beyond::Unknown("a number was wanted".into())),
    }
}

/// An element of an array, indexed from 1; undefined where an index, which must then depend on a coordinate, is not of the array.
fn element(value: Value, indices: &[f64]) -> Answer {
    indices.iter().try_fold(value, |value, &i| match value {
        Value::Array(list) if i.fract() != 0.0 || !(1.0..=list.len() as f64).contains(&i) => {
            Ok(Value::Number(f64::NAN))
        }
        Value::Array(mut list) => Ok(list.swap_remove(i as usize - 1)),
        _ => Err(Beyond::Unknown("index".into())),
    })
}

/// A function of one number, by element.
pub(super) fn each(value: Value, f: &dyn Fn(f64) -> Answer<f64>) -> Answer {
    match value {
        Value::Number(a) => Ok(Value::Number(f(a)?)),
        Value::Array(list) => Ok(Value::Array(list.into_iter().map(|v| each(v, f)).collect::<Answer<_>>()?)),
        Value::Text(_) => Err(Beyond::Unknown("a text in arithmetic".into())),
    }
}

/// A function of two numbers, by element; a number meets every element.
pub(super) fn pair(a: Value, b: Value, f: &dyn Fn(f64, f64) -> Answer<f64>) -> Answer {
    match (a, b) {
        (Value::Number(a), Value::Number(b)) => Ok(Value::Number(f(a, b)?)),
        (Value::Array(a), Value::Array(b)) if a.len() == b.len() => {
            Ok(Value::Array(a.into_iter().zip(b).map(|(a, b)| pair(a, b, f)).collect::<Answer<_>>()?))
        }
        (Value::Array(a), Value::Number(b)) => {
            Ok(Value::Array(a.into_iter().map(|a| pair(a, Value::Number(b), f)).collect::<Answer<_>>()?))
        }
        (Value::Number(a), Value::Array(b)) => {
            Ok(Value::Array(b.into_iter().map(|b| pair(Value::Number(a), b, f)).collect::<Answer<_>>()?))
        }
        _ => Err(Beyond::Unknown("kinds that do not fit".into())),
    }
}
