//! The tree oracle: the value of an expression at a point, by walking the tree with the plain arithmetic of the platform and with a
//! running bound of the rounding error. Shares nothing with the lowering, the graph or the number room, so that it can find them
//! wrong. Knows expressions, definitions and functions; statements of bodies, arrays and data it refuses.
//!
//! Objects are passed by name here: a parameter is its argument's expression, evaluated at whatever point it is asked for. That is
//! what AT means, said in the most direct way.

use std::rc::Rc;

use rustc_hash::FxHashMap;

use crate::syntax::tree::{
    Body, ChainOp, CompareOp, Expr, ExprKind, FoldOp, Ident, Mapping, Name, Parameter, PrefixOp, Statement,
    StatementKind,
};

/// Rounding errors of one operation, in units of the last place: the plain functions are allowed as many as ours.
const UNITS: f64 = 8.0;

/// A value with a bound of its error: the exact value of the expression's rounded operands lies within `error` of `value`, to first
/// order. An infinite error says that a step or a branch could go either way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounded {
    /// The value.
    pub value: f64,
    /// How far off it may be.
    pub error: f64,
}

/// The oracle does not know this form.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unknown(pub String);

type Answer = Result<Bounded, Unknown>;

/// The definitions of a script, as written.
#[derive(Debug, Default)]
pub struct Oracle<'t> {
    formulas: Vec<Formula<'t>>,
    /// The last definition of each name.
    last: FxHashMap<&'t str, usize>,
}

#[derive(Debug)]
struct Formula<'t> {
    name: &'t Name,
    parameters: Option<&'t [Parameter]>,
    body: &'t Expr,
    /// The definition of the same name above, which a formula that reads its own name continues.
    above: Option<usize>,
    /// The formula of `r_alpha` in force.
    alpha: Option<usize>,
}

/// The names around an expression, innermost first.
type Scope<'t> = Option<Rc<Bound<'t>>>;

struct Bound<'t> {
    name: &'t str,
    meaning: Meaning<'t>,
    outer: Scope<'t>,
}

enum Meaning<'t> {
    Number(f64),
    /// An expression where it was written.
    Object(&'t Expr, Scope<'t>, usize),
}

impl<'t> Oracle<'t> {
    /// The oracle of a script's statements.
    ///
    /// # Errors
    /// [`Unknown`] for a statement that is no definition by an expression.
    pub fn new(statements: &'t [Statement]) -> Result<Self, Unknown> {
        let mut oracle = Self::default();
        let mut alpha = None;
        for statement in statements {
            let StatementKind::Define { name, parameters, body: Body::Expression(body), .. } = &statement.kind else {
                return Err(Unknown("a statement that is no definition by an expression".to_owned()));
            };
            let above = oracle.last.get(&*name.name).copied();
            let index = oracle.formulas.len();
            oracle.formulas.push(Formula { name: &name.name, parameters: parameters.as_deref(), body, above, alpha });
            oracle.last.insert(&name.name, index);
            if &*name.name == "r_alpha" {
                alpha = Some(index);
            }
        }
        Ok(oracle)
    }

    /// The value of a name at a point (x1, x2, ...).
    ///
    /// # Errors
    /// [`Unknown`] where a form is met that the oracle does not know.
    pub fn value(&self, name: &str, point: &[f64]) -> Answer {
        let index = *self.last.get(name).ok_or_else(|| Unknown(name.to_owned()))?;
        let point: Vec<Bounded> = point.iter().map(|&x| exact(x)).collect();
        self.expr(self.formulas[index].body, &None, index, &point)
    }

    /// The value of `e`, which stands in formula `home`, at a point.
    fn expr(&self, e: &'t Expr, scope: &Scope<'t>, home: usize, point: &[Bounded]) -> Answer {
        let at = |e: &'t Expr| self.expr(e, scope, home, point);
        match &e.kind {
            ExprKind::Number(value) => Ok(exact(*value)),
            ExprKind::Pi => Ok(exact(std::f64::consts::PI)),
            ExprKind::Coordinate(c) => Ok(point.get(usize::from(*c) - 1).copied().unwrap_or_else(|| exact(f64::NAN))),
            ExprKind::Name(name) => self.name(name, scope, home, point),
            ExprKind::Paren(inner) => at(inner),
            ExprKind::Prefix { op, operand } => Ok(prefix(*op, at(operand)?)),
            ExprKind::Power { base, exponent } => {
                let (a, b) = (at(base)?, at(exponent)?);
                Ok(computed(&[a, b], |v| v[0].powf(v[1])))
            }
            ExprKind::Chain { first, rest } => {
                let mut value = at(first)?;
                for (op, _, operand) in rest {
                    let right = at(operand)?;
                    value = self.chain(*op, value, right, home, point)?;
                }
                Ok(value)
            }
            ExprKind::Compare { first, rest } => {
                let mut left = at(first)?;
                let mut all = exact(1.0);
                for (op, _, operand) in rest {
                    let right = at(operand)?;
                    let holds = decided(&[left, right], |v| compare(*op, v[0], v[1]));
                    all = decided(&[all, holds], |v| truth(v[0]) && truth(v[1]));
                    left = right;
                }
                Ok(all)
            }
            ExprKind::If { condition, then, otherwise } => {
                let c = at(condition)?;
                let value = match (truth(c.value), otherwise) {
                    (true, _) => at(then)?,
                    (false, Some(otherwise)) => at(otherwise)?,
                    (false, None) => exact(f64::NAN),
                };
                Ok(Bounded { error: if c.error == 0.0 { value.error } else { f64::INFINITY }, ..value })
            }
            ExprKind::Where { body, bindings } => {
                let mut inner = scope.clone();
                for (name, value) in bindings {
                    inner = bind(name, Meaning::Object(value, inner.clone(), home), inner);
                }
                self.expr(body, &inner, home, point)
            }
            ExprKind::At { body, mapping } => {
                let moved = self.moved(mapping, scope, home, point)?;
                self.expr(body, scope, home, &moved)
            }
            ExprKind::Fold { op, index, from, to, body } => {
                let (from, to) = (at(from)?.value, at(to)?.value);
                self.fold(*op, index, (from, to), body, scope, home, point)
            }
            ExprKind::Call { callee, arguments } => self.call(&callee.name, arguments, scope, home, point),
            _ => Err(Unknown(format!("{:?}", e.kind).chars().take(40).collect())),
        }
    }

    fn name(&self, name: &str, scope: &Scope<'t>, home: usize, point: &[Bounded]) -> Answer {
        let mut next = scope.as_ref();
        while let Some(bound) = next {
            if bound.name == name {
                return match &bound.meaning {
                    Meaning::Number(value) => Ok(exact(*value)),
                    Meaning::Object(e, scope, home) => self.expr(e, scope, *home, point),
                };
            }
            next = bound.outer.as_ref();
        }
        let own = &self.formulas[home];
        let continues = **own.name == *name && own.parameters.is_none();
        let index = if continues { own.above } else { self.last.get(name).copied() };
        let index = index.ok_or_else(|| Unknown(name.to_owned()))?;
        self.expr(self.formulas[index].body, &None, index, point)
    }

    fn moved(
        &self,
        mapping: &'t Mapping,
        scope: &Scope<'t>,
        home: usize,
        point: &[Bounded],
    ) -> Result<Vec<Bounded>, Unknown> {
        let mut moved = point.to_vec();
        let mut put = |c: usize, value: Bounded| {
            moved.resize(moved.len().max(c), exact(f64::NAN));
            moved[c - 1] = value;
        };
        match mapping {
            Mapping::Positional(all) => {
                for (c, e) in (1..).zip(all) {
                    put(c, self.expr(e, scope, home, point)?);
                }
            }
            Mapping::Named(all) => {
                for (c, _, e) in all {
                    put(usize::from(*c), self.expr(e, scope, home, point)?);
                }
            }
        }
        Ok(moved)
    }

    fn chain(&self, op: ChainOp, a: Bounded, b: Bounded, home: usize, point: &[Bounded]) -> Answer {
        Ok(match op {
            ChainOp::Add => computed(&[a, b], |v| v[0] + v[1]),
            ChainOp::Sub => computed(&[a, b], |v| v[0] - v[1]),
            ChainOp::Mul => computed(&[a, b], |v| v[0] * v[1]),
            ChainOp::Div => computed(&[a, b], |v| v[0] / v[1]),
            ChainOp::And => decided(&[a, b], |v| truth(v[0]) && truth(v[1])),
            ChainOp::Or => decided(&[a, b], |v| truth(v[0]) || truth(v[1])),
            _ => {
                let alpha = match self.formulas[home].alpha {
                    Some(index) => self.expr(self.formulas[index].body, &None, index, point)?,
                    None => exact(0.0),
                };
                match op {
                    ChainOp::Union => computed(&[a, b, alpha], |v| union(v[0], v[1], v[2])),
                    ChainOp::Subtract => computed(&[a, b, alpha], |v| intersection(v[0], -v[1], v[2])),
                    _ => computed(&[a, b, alpha], |v| intersection(v[0], v[1], v[2])),
                }
            }
        })
    }

    #[allow(clippy::too_many_arguments)]
    fn fold(
        &self,
        op: FoldOp,
        index: &'t Ident,
        (from, to): (f64, f64),
        body: &'t Expr,
        scope: &Scope<'t>,
        home: usize,
        point: &[Bounded],
    ) -> Answer {
        let mut folded: Option<Bounded> = None;
        let mut i = from;
        while i <= to {
            let value = self.expr(body, &bind(index, Meaning::Number(i), scope.clone()), home, point)?;
            folded = Some(match (folded, op) {
                (None, _) => value,
                (Some(before), FoldOp::Sum) => self.chain(ChainOp::Add, before, value, home, point)?,
                (Some(before), FoldOp::Product) => self.chain(ChainOp::Mul, before, value, home, point)?,
                (Some(before), FoldOp::Union) => self.chain(ChainOp::Union, before, value, home, point)?,
                (Some(before), FoldOp::Intersection) => self.chain(ChainOp::Intersect, before, value, home, point)?,
                (Some(before), FoldOp::Minimum) => computed(&[before, value], |v| least(v[0], v[1])),
                (Some(before), FoldOp::Maximum) => computed(&[before, value], |v| v[0].max(v[1])),
                (_, FoldOp::Array) => return Err(Unknown("ARRAY".to_owned())),
            });
            i += 1.0;
        }
        Ok(folded.unwrap_or_else(|| exact(if op == FoldOp::Product { 1.0 } else { 0.0 })))
    }

    fn call(&self, name: &str, arguments: &'t [Expr], scope: &Scope<'t>, home: usize, point: &[Bounded]) -> Answer {
        if let Some(&index) = self.last.get(name)
            && let Some(parameters) = self.formulas[index].parameters
        {
            let mut inner = None;
            for (parameter, e) in parameters.iter().zip(arguments) {
                inner = bind(&parameter.name, Meaning::Object(e, scope.clone(), home), inner);
            }
            return self.expr(self.formulas[index].body, &inner, index, point);
        }
        let mut values = Vec::with_capacity(arguments.len());
        for e in arguments {
            values.push(self.expr(e, scope, home, point)?);
        }
        let known = plain(&name.to_ascii_uppercase(), values.len());
        known.map(|f| computed(&values, f)).ok_or_else(|| Unknown(name.to_owned()))
    }
}

fn bind<'t>(name: &'t Ident, meaning: Meaning<'t>, outer: Scope<'t>) -> Scope<'t> {
    Some(Rc::new(Bound { name: &name.name, meaning, outer }))
}

fn exact(value: f64) -> Bounded {
    Bounded { value, error: 0.0 }
}

fn truth(value: f64) -> bool {
    value != 0.0 && !value.is_nan()
}

/// The values of a function at all corners of its operands' error boxes.
fn corners(operands: &[Bounded], mut visit: impl FnMut(&[f64])) {
    let mut at: Vec<f64> = operands.iter().map(|o| o.value).collect();
    let loose: Vec<usize> = (0..operands.len()).filter(|&i| operands[i].error > 0.0).collect();
    for corner in 0_usize..1 << loose.len().min(4) {
        for (bit, &i) in loose.iter().enumerate() {
            let sign = if corner >> bit & 1 == 1 { 1.0 } else { -1.0 };
            at[i] = operands[i].value + sign * operands[i].error;
        }
        visit(&at);
    }
}

/// A function of its operands with the error that they and the rounding bring.
fn computed(operands: &[Bounded], f: impl Fn(&[f64]) -> f64) -> Bounded {
    let centre: Vec<f64> = operands.iter().map(|o| o.value).collect();
    let value = f(&centre);
    if operands.iter().any(|o| o.error.is_infinite()) {
        return Bounded { value, error: f64::INFINITY };
    }
    let mut error = 0.0_f64;
    corners(operands, |at| {
        let there = f(at);
        let away = if there.is_nan() && value.is_nan() || there == value { 0.0 } else { (there - value).abs() };
        error = if away.is_nan() { f64::INFINITY } else { error.max(away) };
    });
    let rounding = if value.is_finite() { UNITS * value.abs() * f64::EPSILON + f64::MIN_POSITIVE } else { 0.0 };
    Bounded { value, error: 2.0 * error + rounding }
}

/// A yes or no; undecided if the operands' errors may change it.
fn decided(operands: &[Bounded], f: impl Fn(&[f64]) -> bool) -> Bounded {
    let centre: Vec<f64> = operands.iter().map(|o| o.value).collect();
    let holds = f(&centre);
    let mut sure = operands.iter().all(|o| o.error.is_finite());
    corners(operands, |at| sure &= f(at) == holds);
    Bounded { value: f64::from(u8::from(holds)), error: if sure { 0.0 } else { f64::INFINITY } }
}

fn prefix(op: PrefixOp, a: Bounded) -> Bounded {
    match op {
        PrefixOp::Plus => a,
        PrefixOp::Minus | PrefixOp::Complement => Bounded { value: -a.value, ..a },
        PrefixOp::Not => decided(&[a], |v| !truth(v[0])),
    }
}

fn compare(op: CompareOp, a: f64, b: f64) -> bool {
    match op {
        CompareOp::Less => a < b,
        CompareOp::LessEqual => a <= b,
        CompareOp::Greater => a > b,
        CompareOp::GreaterEqual => a >= b,
        CompareOp::Equal => a == b,
        CompareOp::NotEqual => a < b || a > b,
    }
}

/// The smaller; undefined if one is.
fn least(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.min(b) }
}

/// [P95] eq. (2); where the sum is negative, multiplied by its conjugate.
fn union(f: f64, g: f64, alpha: f64) -> f64 {
    if f.is_nan() || g.is_nan() {
        return f.max(g);
    }
    if alpha == 1.0 {
        return f.max(g);
    }
    let (s, r) = (f + g, (f * f + g * g - 2.0 * alpha * f * g).sqrt());
    if s >= 0.0 { (s + r) / (1.0 + alpha) } else { 2.0 * f * g / (s - r) }
}

fn intersection(f: f64, g: f64, alpha: f64) -> f64 {
    if f.is_nan() || g.is_nan() { f64::NAN } else { -union(-f, -g, alpha) }
}

/// A built-in function with so many arguments, in the platform's arithmetic.
fn plain(name: &str, arguments: usize) -> Option<fn(&[f64]) -> f64> {
    let f: fn(&[f64]) -> f64 = match (name, arguments) {
        ("SIN", 1) => |v| v[0].sin(),
        ("COS", 1) => |v| v[0].cos(),
        ("TAN", 1) => |v| v[0].tan(),
        ("ASIN", 1) => |v| v[0].asin(),
        ("ACOS", 1) => |v| v[0].acos(),
        ("ATAN", 1) => |v| v[0].atan(),
        ("SINH", 1) => |v| v[0].sinh(),
        ("COSH", 1) => |v| v[0].cosh(),
        ("TANH", 1) => |v| v[0].tanh(),
        ("ASINH", 1) => |v| v[0].asinh(),
        ("EXP", 1) => |v| v[0].exp(),
        ("LOG", 1) => |v| v[0].ln(),
        ("LOG10", 1) => |v| v[0].log10(),
        ("SQRT", 1) => |v| v[0].sqrt(),
        ("CBRT", 1) => |v| v[0].cbrt(),
        ("ABS", 1) => |v| v[0].abs(),
        ("FLOOR", 1) => |v| v[0].floor(),
        ("CEIL", 1) => |v| v[0].ceil(),
        ("ROUND", 1) => |v| v[0].round(),
        ("SIGN", 1) => |v| if v[0] == 0.0 { 0.0 } else { v[0].signum() },
        ("FRAC", 1) => |v| v[0] - v[0].floor(),
        ("MOD", 2) => |v| v[0] - v[1] * (v[0] / v[1]).floor(),
        ("ATAN2", 2) => |v| v[0].atan2(v[1]),
        ("HYPOT", 2) => |v| v[0].hypot(v[1]),
        ("POW", 2) => |v| v[0].powf(v[1]),
        ("MIN", 2) => |v| least(v[0], v[1]),
        ("MAX", 2) => |v| v[0].max(v[1]),
        ("CLAMP", 3) => |v| if v[0].is_nan() { f64::NAN } else { v[0].max(v[1]).min(v[2]) },
        ("LERP", 3) => |v| v[0] + (v[1] - v[0]) * v[2],
        _ => return None,
    };
    Some(f)
}
