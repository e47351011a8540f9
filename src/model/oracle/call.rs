//! Calls of the oracle: users' functions and the built-ins, by the standard library's arithmetic.

use std::cell::RefCell;
use std::rc::Rc;

use super::expr::{each, maximum, minimum, number, pair, power};
use super::{Answer, Beyond, Binding, Function, Later, Oracle, Point, Scope, Source, System, Value};
use crate::syntax::tree::{Body, Expr, ExprKind, FoldOp, Ident};

impl Oracle {
    /// A call: of a user's function, of a built-in, or AT on a name without parameters.
    pub(super) fn call(
        &self,
        callee: &Ident,
        arguments: &[Expr],
        scope: &Scope,
        system: &System,
        point: &Point,
    ) -> Answer {
        match self.binding(&callee.name, scope) {
            Some(Binding::Function(f)) => self.apply(&f, arguments, scope, system, point),
            found => {
                let built_in = self.built_in(&callee.name.to_uppercase(), arguments, scope, system, point);
                match (built_in, found) {
                    (Err(Beyond::Unknown(_)), Some(object)) => {
                        let mut to = match point {
                            Some(p) => **p,
                            None => return Err(Beyond::NeedsPoint),
                        };
                        for (i, e) in arguments.iter().enumerate() {
                            to[i] = self.number(e, scope, system, point)?;
                        }
                        self.force(&object, &Some(Rc::new(to)))
                    }
                    (answer, _) => answer,
                }
            }
        }
    }

    fn apply(&self, f: &Function, arguments: &[Expr], scope: &Scope, system: &System, point: &Point) -> Answer {
        if f.parameters.len() != arguments.len() {
            return Err(Beyond::Unknown(format!("arguments of {}", f.name)));
        }
        let mut inner = f.scope.clone();
        for (parameter, e) in f.parameters.iter().zip(arguments) {
            inner = inner.with(parameter, self.argument(e, scope, system));
        }
        match &*f.body {
            Body::Expression(e) => self.expr(e, &inner, &f.system, point),
            Body::Block(statements) => {
                let end = self.run(statements, &inner, &f.system, point)?;
                self.force(end.find(&f.name).unwrap_or(&Binding::Nothing), point)
            }
        }
    }

    /// An argument stands for an object, or for a function if it names one.
    fn argument(&self, e: &Expr, scope: &Scope, system: &System) -> Binding {
        if let ExprKind::Name(n) = &e.kind
            && let Some(Binding::Function(f)) = self.binding(n, scope)
        {
            return Binding::Function(f);
        }
        let source = Source::Expr(Rc::new(e.clone()));
        let later = Later { source, scope: scope.clone(), system: system.clone(), last: RefCell::new(None) };
        Binding::Later(Rc::new(later))
    }

    fn built_in(&self, name: &str, arguments: &[Expr], scope: &Scope, system: &System, point: &Point) -> Answer {
        let known = one(name).is_some() || two(name).is_some() || SPECIAL.contains(&name);
        if !known {
            return Err(Beyond::Unknown(format!("built-in {name}")));
        }
        let values = self.values(arguments, scope, system, point)?;
        if let (Some(f), [a]) = (one(name), values.as_slice()) {
            return each(a.clone(), &|a| Ok(f(a)));
        }
        if let (Some(f), [a, b]) = (two(name), values.as_slice()) {
            return pair(a.clone(), b.clone(), &|a, b| Ok(f(a, b)));
        }
        self.special(name, values, scope, system, point)
    }

    fn special(&self, name: &str, values: Vec<Value>, scope: &Scope, system: &System, point: &Point) -> Answer {
        let fold = match name {
            "SUM" => Some(FoldOp::Sum),
            "PRODUCT" => Some(FoldOp::Product),
            "UNION" => Some(FoldOp::Union),
            "INTERSECTION" => Some(FoldOp::Intersection),
            "MINIMUM" | "MIN" => Some(FoldOp::Minimum),
            "MAXIMUM" | "MAX" => Some(FoldOp::Maximum),
            _ => None,
        };
        if let Some(op) = fold {
            let list = match <[Value; 1]>::try_from(values) {
                Ok([Value::Array(list)]) => list,
                Ok([value]) => vec![value],
                Err(values) => values,
            };
            return self.fold(op, list, system, scope, point);
        }
        match (name, values.as_slice()) {
            ("CLAMP", [x, lo, hi]) => {
                // The maximum of two, but undefined where one is.
                let above = pair(x.clone(), lo.clone(), &|a, b| Ok(-minimum(-a, -b)))?;
                pair(above, hi.clone(), &|a, b| Ok(minimum(a, b)))
            }
            ("LERP" | "MIX", [a, b, t]) => {
                let step = pair(b.clone(), a.clone(), &|b, a| Ok(b - a))?;
                let part = pair(step, t.clone(), &|step, t| Ok(step * t))?;
                pair(a.clone(), part, &|a, part| Ok(a + part))
            }
            ("SMOOTHSTEP", [lo, hi, a]) => {
                let width = pair(hi.clone(), lo.clone(), &|hi, lo| Ok(hi - lo))?;
                let above = pair(a.clone(), lo.clone(), &|a, lo| Ok(a - lo))?;
                let part = pair(above, width, &|above, width| Ok(above / width))?;
                each(part, &|t| {
                    let t = t.clamp(0.0, 1.0);
                    Ok(t * t * (3.0 - 2.0 * t))
                })
            }
            ("HYPOT", [first, second, rest @ ..]) => {
                // Undefined is stronger than infinite, unlike in IEEE arithmetic.
                let length = |a: f64, b: f64| if a.is_nan() || b.is_nan() { f64::NAN } else { a.hypot(b) };
                let both = |a: Value, b: &Value| pair(a, b.clone(), &|a, b| Ok(length(a, b)));
                rest.iter().try_fold(both(first.clone(), second)?, both)
            }
            ("PNORM", [Value::Array(list), p]) => p_norm(list, p),
            ("PNORM", [list @ .., p]) => p_norm(list, p),
            ("LEN", [Value::Array(list)]) => Ok(Value::Number(list.len() as f64)),
            ("JOIN", [Value::Array(a), Value::Array(b)]) => Ok(Value::Array(a.iter().chain(b).cloned().collect())),
            ("DOT", [a, b]) => {
                let products = pair(a.clone(), b.clone(), &|a, b| Ok(a * b))?;
                Ok(Value::Number(numbers(products)?.into_iter().sum()))
            }
            ("NORM", [a]) => Ok(Value::Number(numbers(a.clone())?.into_iter().map(|a| a * a).sum::<f64>().sqrt())),
            ("CROSS", [a, b]) => {
                let (a, b) = (numbers(a.clone())?, numbers(b.clone())?);
                let part = |i: usize, j: usize| Value::Number(a[i] * b[j] - a[j] * b[i]);
                Ok(Value::Array(vec![part(1, 2), part(2, 0), part(0, 1)]))
            }
            _ => Err(Beyond::Unknown(format!("arguments of {name}"))),
        }
    }
}

const SPECIAL: &[&str] = &[
    "SUM",
    "PRODUCT",
    "UNION",
    "INTERSECTION",
    "MINIMUM",
    "MAXIMUM",
    "MIN",
    "MAX",
    "CLAMP",
    "HYPOT",
    "PNORM",
    "LERP",
    "MIX",
    "SMOOTHSTEP",
    "LEN",
    "JOIN",
    "DOT",
    "NORM",
    "CROSS",
];

/// The p-norm of all the values at once, over logarithms: each power relative to that of the value that rules the sum.
fn p_norm(list: &[Value], p: &Value) -> Answer {
    let p = number(p.clone())?;
    let list: Answer<Vec<f64>> = list.iter().cloned().map(number).collect();
    let list: Vec<f64> = list?.into_iter().map(f64::abs).collect();
    if p == 0.0 || p.is_nan() || list.iter().any(|v| v.is_nan()) {
        return Ok(Value::Number(f64::NAN));
    }
    let pick = if p > 0.0 { f64::max } else { f64::min };
    let ruler = list.iter().copied().reduce(pick).unwrap_or(0.0);
    if p.is_infinite() || ruler == 0.0 || ruler.is_infinite() {
        return Ok(Value::Number(ruler));
    }
    let sum: f64 = list.iter().map(|v| (p * (v.ln() - ruler.ln())).exp()).sum();
    Ok(Value::Number(ruler * (sum.ln() / p).exp()))
}

fn numbers(value: Value) -> Answer<Vec<f64>> {
    match value {
        Value::Array(list) => list.into_iter().map(number).collect(),
        value => Ok(vec![number(value)?]),
    }
}

fn one(name: &str) -> Option<fn(f64) -> f64> {
    Some(match name {
        "ABS" => f64::abs,
        "SQRT" => f64::sqrt,
        "CBRT" => f64::cbrt,
        "EXP" => f64::exp,
        "LOG" | "LN" => f64::ln,
        "SEC" => |a| 1.0 / a.cos(),
        "CSC" => |a| 1.0 / a.sin(),
        "COT" => |a| a.cos() / a.sin(),
        "RAD" => f64::to_radians,
        "DEG" => f64::to_degrees,
        "SQR" => |a| a * a,
        "TRUNC" | "INT" => f64::trunc,
        "LOG10" => f64::log10,
        "LOG2" => f64::log2,
        "SIN" => f64::sin,
        "COS" => f64::cos,
        "TAN" => f64::tan,
        "ASIN" | "ARCSIN" => f64::asin,
        "ACOS" | "ARCCOS" => f64::acos,
        "ATAN" | "ARCTAN" => f64::atan,
        "SINH" => f64::sinh,
        "COSH" => f64::cosh,
        "TANH" => f64::tanh,
        "ASINH" | "ARSINH" => f64::asinh,
        "ACOSH" | "ARCOSH" => f64::acosh,
        "ATANH" | "ARTANH" => f64::atanh,
        "FLOOR" => f64::floor,
        "CEIL" => f64::ceil,
        "ROUND" => f64::round,
        "FRAC" => |a| a - a.floor(),
        "SIGN" | "SGN" => |a| {
            if a > 0.0 {
                1.0
            } else if a < 0.0 {
                -1.0
            } else {
                a
            }
        },
        _ => return None,
    })
}

fn two(name: &str) -> Option<fn(f64, f64) -> f64> {
    Some(match name {
        "ATAN2" => f64::atan2,
        "HEAVISIDE" => |edge, a| if a >= edge { 1.0 } else { 0.0 },
        "POW" => power,
        "MOD" => |a, b| a - b * (a / b).floor(),
        "MIN" => minimum,
        "MAX" => maximum,
        _ => return None,
    })
}
