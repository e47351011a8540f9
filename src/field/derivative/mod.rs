//! The exact derivative of an expression by a coordinate, as an expression: `DIFF` and `GRAD`. Conditions, MIN, MAX and ABS give the
//! derivative of the taken branch (the first on a tie), steps give 0, and where both operands of an R-function vanish its root's
//! derivative counts as 0. Never recurses; never approximates, apart from second derivatives of data.

mod region;

use std::sync::Arc;

use rustc_hash::FxHashMap;

use super::graph::{Coordinate, Graph, Node, NodeId, SharedLeaf};
use crate::number::{Algebra, Binary, Interval, Leaf, Ternary, Unary};

/// The derivative of `node` by the coordinate `by`, built in the same graph. Parts that both use are shared.
pub fn derivative(graph: &mut Graph, node: NodeId, by: Coordinate) -> NodeId {
    let mut rules = Rules { graph, done: FxHashMap::default() };
    let mut open = vec![(node, by)];
    while let Some(&key) = open.last() {
        if rules.known(key).is_some() || rules.visit(key, &mut open) {
            open.pop();
        }
    }
    let slope = rules.known((node, by)).flatten();
    slope.unwrap_or_else(|| graph.constant(0.0))
}

/// A node and the coordinate by which it is derived.
type Key = (NodeId, Coordinate);

/// A derivative; `None` is a zero that needs no node.
type Slope = Option<NodeId>;

struct Rules<'a> {
    graph: &'a mut Graph,
    done: FxHashMap<Key, Slope>,
}

impl Rules<'_> {
    /// The derivative, if it is known yet.
    fn known(&self, key: Key) -> Option<Slope> {
        if self.graph.coordinates(key.0).contains(key.1) { self.done.get(&key).copied() } else { Some(None) }
    }

    /// One of the known derivatives.
    fn slope(&self, node: NodeId, by: Coordinate) -> Slope {
        self.known((node, by)).flatten()
    }

    /// Derives one node if all that its rule needs is known, and says so; else puts what is missing on the list.
    fn visit(&mut self, key: Key, open: &mut Vec<Key>) -> bool {
        let (node, by) = key;
        let rule = self.graph.node(node).clone();
        let before = open.len();
        let mut need = |key: Key| {
            if self.known(key).is_none() {
                open.push(key);
            }
        };
        match &rule {
            Node::Map(body, mapping) => {
                mapping.iter().for_each(|(c, e)| {
                    need((*e, by));
                    if self.graph.coordinates(*e).contains(by) {
                        need((*body, *c));
                    }
                });
                if mapping.iter().all(|(c, _)| *c != by) {
                    need((*body, by));
                }
            }
            plain => plain.for_each_operand(|e| need((e, by))),
        }
        if open.len() > before {
            return false;
        }
        let slope = self.derive(node, &rule, by);
        self.done.insert(key, slope);
        true
    }

    fn derive(&mut self, node: NodeId, rule: &Node, by: Coordinate) -> Slope {
        match rule {
            Node::Constant(_) => None,
            Node::Coordinate(_) => Some(self.graph.constant(1.0)),
            Node::Unary(op, a) => {
                let slope = self.slope(*a, by)?;
                self.unary(*op, *a, node, slope)
            }
            Node::Binary(op, a, b) => self.binary(*op, (*a, self.slope(*a, by)), (*b, self.slope(*b, by)), node),
            Node::Ternary(Ternary::Select, [condition, a, b]) => {
                let (da, db) = (self.slope(*a, by), self.slope(*b, by));
                self.select(*condition, da, db)
            }
            Node::Ternary(Ternary::Norm, operands) => self.norm(*operands, node, by),
            Node::Ternary(op, operands) => self.set_operation(*op, *operands, by),
            Node::Leaf(leaf, arguments) => self.leaf(leaf, arguments, by),
            Node::Region(region, output, arguments) => self.region(&region.0, *output as usize, arguments, node, by),
            Node::Map(body, mapping) => self.through(*body, mapping, by),
        }
    }

    /// The chain rule through `body AT (mapping)`.
    fn through(&mut self, body: NodeId, mapping: &[(Coordinate, NodeId)], by: Coordinate) -> Slope {
        let mut sum = None;
        if mapping.iter().all(|(c, _)| *c != by) {
            sum = self.slope(body, by).map(|d| self.graph.map(d, mapping));
        }
        for (c, e) in mapping {
            let inner = self.slope(*e, by);
            let outer = if inner.is_some() { self.slope(body, *c) } else { None };
            let outer = outer.map(|d| self.graph.map(d, mapping));
            let term = self.times(outer, inner);
            sum = self.plus(sum, term);
        }
        sum
    }

    fn leaf(&mut self, leaf: &SharedLeaf, arguments: &[NodeId], by: Coordinate) -> Slope {
        let mut sum = None;
        for (axis, a) in arguments.iter().enumerate() {
            if let Some(inner) = self.slope(*a, by) {
                let slope = SharedLeaf(Arc::new(LeafSlope { of: leaf.clone(), axis }));
                let outer = self.graph.leaf(slope, arguments);
                let term = self.times(Some(outer), Some(inner));
                sum = self.plus(sum, term);
            }
        }
        sum
    }

    fn plus(&mut self, a: Slope, b: Slope) -> Slope {
        match (a, b) {
            (Some(a), Some(b)) => Some(self.graph.binary(Binary::Add, a, b)),
            _ => a.or(b),
        }
    }

    fn minus(&mut self, a: Slope, b: Slope) -> Slope {
        match (a, b) {
            (Some(a), Some(b)) => Some(self.graph.binary(Binary::Sub, a, b)),
            (None, Some(b)) => Some(self.graph.unary(Unary::Neg, b)),
            _ => a,
        }
    }

    fn times(&mut self, a: Slope, b: Slope) -> Slope {
        Some(self.graph.binary(Binary::Mul, a?, b?))
    }

    fn select(&mut self, condition: NodeId, a: Slope, b: Slope) -> Slope {
        if a.is_none() && b.is_none() {
            return None;
        }
        let zero = self.graph.constant(0.0);
        Some(self.graph.ternary(Ternary::Select, condition, a.unwrap_or(zero), b.unwrap_or(zero)))
    }

    /// `1 + a^2`
    fn one_and_square(&mut self, a: NodeId) -> NodeId {
        let one = self.graph.constant(1.0);
        let square = self.graph.unary(Unary::Powi(2), a);
        self.graph.binary(Binary::Add, one, square)
    }

    /// `1 - a` and `1 + a`
    fn about_one(&mut self, a: NodeId) -> (NodeId, NodeId) {
        let one = self.graph.constant(1.0);
        (self.graph.binary(Binary::Sub, one, a), self.graph.binary(Binary::Add, one, a))
    }

    fn unary(&mut self, op: Unary, a: NodeId, value: NodeId, d: NodeId) -> Slope {
        use Binary::{Div, Mul};
        Some(match op {
            Unary::Floor | Unary::Ceil | Unary::Round | Unary::Sign | Unary::Not => return None,
            Unary::Neg => self.graph.unary(Unary::Neg, d),
            Unary::Abs => {
                let zero = self.graph.constant(0.0);
                let condition = self.graph.binary(Binary::LessEqual, zero, a);
                let negative = self.graph.unary(Unary::Neg, d);
                return self.select(condition, Some(d), Some(negative));
            }
            Unary::Powi(n) => {
                let power = self.graph.unary(Unary::Powi(n.saturating_sub(1)), a);
                let factor = self.scaled(f64::from(n), power);
                self.graph.binary(Mul, factor, d)
            }
            Unary::Sqrt => self.over_scaled(d, 2.0, value),
            Unary::Cbrt => {
                let square = self.graph.unary(Unary::Powi(2), value);
                self.over_scaled(d, 3.0, square)
            }
            Unary::Exp => self.graph.binary(Mul, value, d),
            Unary::Log => self.graph.binary(Div, d, a),
            Unary::Log10 => self.over_scaled(d, std::f64::consts::LN_10, a),
            Unary::Sin | Unary::Sinh | Unary::Cosh => {
                let partner = match op {
                    Unary::Sin => Unary::Cos,
                    Unary::Sinh => Unary::Cosh,
                    _ => Unary::Sinh,
                };
                let factor = self.graph.unary(partner, a);
                self.graph.binary(Mul, factor, d)
            }
            Unary::Cos => {
                let sine = self.graph.unary(Unary::Sin, a);
                let product = self.graph.binary(Mul, sine, d);
                self.graph.unary(Unary::Neg, product)
            }
            Unary::Tan => {
                let factor = self.one_and_square(value);
                self.graph.binary(Mul, factor, d)
            }
            // 1 - tanh^2 would cancel far from 0.
            Unary::Tanh => {
                let cosh = self.graph.unary(Unary::Cosh, a);
                let once = self.graph.binary(Div, d, cosh);
                self.graph.binary(Div, once, cosh)
            }
            Unary::Atan => {
                let divisor = self.one_and_square(a);
                self.graph.binary(Div, d, divisor)
            }
            Unary::Atanh => {
                let (below, above) = self.about_one(a);
                let divisor = self.graph.binary(Mul, below, above);
                self.graph.binary(Div, d, divisor)
            }
            Unary::Asin | Unary::Acos | Unary::Asinh | Unary::Acosh => self.inverse_by_root(op, a, d),
        })
    }

    fn inverse_by_root(&mut self, op: Unary, a: NodeId, d: NodeId) -> NodeId {
        let root = match op {
            Unary::Asinh => {
                let one = self.graph.constant(1.0);
                self.graph.binary(Binary::Hypot, a, one)
            }
            Unary::Acosh => {
                let (below, above) = self.about_one(a);
                let below = self.graph.unary(Unary::Neg, below);
                let (below, above) = (self.graph.unary(Unary::Sqrt, below), self.graph.unary(Unary::Sqrt, above));
                self.graph.binary(Binary::Mul, below, above)
            }
            _ => {
                let (below, above) = self.about_one(a);
                let product = self.graph.binary(Binary::Mul, below, above);
                self.graph.unary(Unary::Sqrt, product)
            }
        };
        let quotient = self.graph.binary(Binary::Div, d, root);
        if op == Unary::Acos { self.graph.unary(Unary::Neg, quotient) } else { quotient }
    }

    fn scaled(&mut self, factor: f64, a: NodeId) -> NodeId {
        let factor = self.graph.constant(factor);
        self.graph.binary(Binary::Mul, a, factor)
    }

    fn over_scaled(&mut self, d: NodeId, factor: f64, divisor: NodeId) -> NodeId {
        let divisor = self.scaled(factor, divisor);
        self.graph.binary(Binary::Div, d, divisor)
    }

    fn binary(&mut self, op: Binary, (a, da): (NodeId, Slope), (b, db): (NodeId, Slope), value: NodeId) -> Slope {
        match op {
            Binary::Add => self.plus(da, db),
            Binary::Sub => self.minus(da, db),
            Binary::Mul => {
                let (left, right) = (self.times(da, Some(b)), self.times(Some(a), db));
                self.plus(left, right)
            }
            Binary::Div => {
                let inner = self.times(Some(value), db);
                let top = self.minus(da, inner)?;
                Some(self.graph.binary(Binary::Div, top, b))
            }
            Binary::Min => {
                let first = self.graph.binary(Binary::LessEqual, a, b);
                self.select(first, da, db)
            }
            Binary::Max => {
                let first = self.graph.binary(Binary::LessEqual, b, a);
                let otherwise = self.where_defined(b, db, da);
                self.select(first, da, otherwise)
            }
            Binary::Pow => self.power(a, da, b, db, value),
            Binary::Atan2 => {
                let (top_a, top_b) = (self.times(Some(b), da), self.times(Some(a), db));
                let top = self.minus(top_a, top_b)?;
                let (aa, bb) = (self.graph.unary(Unary::Powi(2), a), self.graph.unary(Unary::Powi(2), b));
                let sum = self.graph.binary(Binary::Add, aa, bb);
                Some(self.graph.binary(Binary::Div, top, sum))
            }
            Binary::Hypot => {
                let (top_a, top_b) = (self.times(Some(a), da), self.times(Some(b), db));
                let top = self.plus(top_a, top_b)?;
                let quotient = self.graph.binary(Binary::Div, top, value);
                self.select(value, Some(quotient), None)
            }
            Binary::Mod => {
                let quotient = self.graph.binary(Binary::Div, a, b);
                let whole = self.graph.unary(Unary::Floor, quotient);
                let lost = self.times(Some(whole), db);
                self.minus(da, lost)
            }
            _ => None,
        }
    }

    /// `then` where the value at `node` is defined, else `otherwise`.
    fn where_defined(&mut self, node: NodeId, then: Slope, otherwise: Slope) -> Slope {
        let defined = self.graph.binary(Binary::Equal, node, node);
        self.select(defined, then, otherwise)
    }

    fn power(&mut self, a: NodeId, da: Slope, b: NodeId, db: Slope, value: NodeId) -> Slope {
        let by_base = da.map(|d| {
            let one = self.graph.constant(1.0);
            let less = self.graph.binary(Binary::Sub, b, one);
            let power = self.graph.binary(Binary::Pow, a, less);
            let factor = self.graph.binary(Binary::Mul, b, power);
            self.graph.binary(Binary::Mul, factor, d)
        });
        let by_exponent = db.and_then(|d| {
            let log = self.graph.unary(Unary::Log, a);
            let log = self.select(a, Some(log), None);
            let factor = self.times(Some(value), log);
            self.times(factor, Some(d))
        });
        self.plus(by_base, by_exponent)
    }
}

impl Rules<'_> {
    /// `v^(1-p) (|a|^(p-1) d|a| + |b|^(p-1) d|b|)` with the powers taken of quotients, and for a varying p
    /// `v/p (A log(|a|/v) + B log(|b|/v)) dp` with `A = (|a|/v)^p`; 0 where the norm is 0. That of the larger or smaller magnitude for an
    /// infinite p.
    fn norm(&mut self, [a, b, p]: [NodeId; 3], value: NodeId, by: Coordinate) -> Slope {
        let (da, db, dp) = (self.slope(a, by), self.slope(b, by), self.slope(p, by));
        let (x, y) = (self.graph.unary(Unary::Abs, a), self.graph.unary(Unary::Abs, b));
        let mut magnitude = |o: NodeId, size: NodeId, d: Slope| match d {
            Some(d) if size != o => self.unary(Unary::Abs, o, size, d),
            d => d,
        };
        let (da, db) = (magnitude(a, x, da), magnitude(b, y, db));
        if self.graph.number(p).is_some_and(f64::is_infinite) {
            let first = if self.graph.number(p) == Some(f64::INFINITY) { (y, x) } else { (x, y) };
            let first = self.graph.binary(Binary::LessEqual, first.0, first.1);
            return self.select(first, da, db);
        }
        let (r, s) = (self.graph.binary(Binary::Div, x, value), self.graph.binary(Binary::Div, y, value));
        let one = self.graph.constant(1.0);
        let less = self.graph.binary(Binary::Sub, p, one);
        let (u, v) = (self.graph.binary(Binary::Pow, r, less), self.graph.binary(Binary::Pow, s, less));
        let (left, right) = (self.times(Some(u), da), self.times(Some(v), db));
        let mut sum = self.plus(left, right);
        if dp.is_some() {
            let mut part = |r: NodeId| {
                let power = self.graph.binary(Binary::Pow, r, p);
                let log = self.graph.unary(Unary::Log, r);
                let product = self.graph.binary(Binary::Mul, power, log);
                self.select(power, Some(product), None)
            };
            let (left, right) = (part(r), part(s));
            let factor = self.plus(left, right);
            let ratio = self.graph.binary(Binary::Div, value, p);
            let factor = self.times(Some(ratio), factor);
            let by_p = self.times(factor, dp);
            sum = self.plus(sum, by_p);
        }
        self.select(value, sum, None)
    }
}

/// What the rules of the R-functions share: `f`, `g` with their derivatives, and the parameter.
struct Operands {
    f: (NodeId, Slope),
    g: (NodeId, Slope),
    parameter: (NodeId, Slope),
    /// Add for a union, Sub for an intersection: the sign before the root.
    sign: Binary,
}

impl Rules<'_> {
    /// R-functions with their treatment of undefined operands.
    fn set_operation(&mut self, op: Ternary, [f, g, parameter]: [NodeId; 3], by: Coordinate) -> Slope {
        let union = matches!(op, Ternary::Union | Ternary::UnionSmooth);
        let operands = Operands {
            f: (f, self.slope(f, by)),
            g: (g, self.slope(g, by)),
            parameter: (parameter, self.slope(parameter, by)),
            sign: if union { Binary::Add } else { Binary::Sub },
        };
        let slope = match op {
            Ternary::Union | Ternary::Intersection => self.with_alpha(&operands),
            _ => self.smooth(&operands),
        };
        if !union {
            return slope;
        }
        let slope = self.where_defined(g, slope, operands.f.1);
        self.where_defined(f, slope, operands.g.1)
    }

    /// `(f + g +- r) / (1 + a)` with `r = sqrt(f^2 + g^2 - 2 a f g)` and `dr = ((f - a g) df + (g - a f) dg - f g da) / r`.
    fn with_alpha(&mut self, o: &Operands) -> Slope {
        let (a, da) = o.parameter;
        let one = self.graph.constant(1.0);
        let scale = self.graph.binary(Binary::Add, one, a);
        let root = self.root_of_alpha(o);
        let (af, ag) = (self.graph.binary(Binary::Mul, a, o.f.0), self.graph.binary(Binary::Mul, a, o.g.0));
        let by_f = self.graph.binary(Binary::Sub, o.f.0, ag);
        let by_g = self.graph.binary(Binary::Sub, o.g.0, af);
        let (t1, t2) = (self.times(Some(by_f), o.f.1), self.times(Some(by_g), o.g.1));
        let mut top = self.plus(t1, t2);
        if da.is_some() {
            let product = self.graph.binary(Binary::Mul, o.f.0, o.g.0);
            let t3 = self.times(Some(product), da);
            top = self.minus(top, t3);
        }
        let root_slope = top.map(|top| self.graph.binary(Binary::Div, top, root));
        let root_slope = self.select(root, root_slope, None);
        let sum = self.plus(o.f.1, o.g.1);
        let mut slope = if o.sign == Binary::Add { self.plus(sum, root_slope) } else { self.minus(sum, root_slope) };
        if da.is_some() {
            let op = if o.sign == Binary::Add { Ternary::Union } else { Ternary::Intersection };
            let value = self.graph.ternary(op, o.f.0, o.g.0, a);
            let t4 = self.times(Some(value), da);
            slope = self.minus(slope, t4);
        }
        slope.map(|s| self.graph.binary(Binary::Div, s, scale))
    }

    /// `sqrt(f^2 + g^2 - 2 a f g)` without overflow or cancellation.
    fn root_of_alpha(&mut self, o: &Operands) -> NodeId {
        let one = self.graph.constant(1.0);
        let half = self.graph.constant(0.5);
        let mut side = |weight: Binary, sum: Binary| {
            let w = self.graph.binary(weight, one, o.parameter.0);
            let w = self.graph.binary(Binary::Mul, w, half);
            let w = self.graph.unary(Unary::Sqrt, w);
            let s = self.graph.binary(sum, o.f.0, o.g.0);
            self.graph.binary(Binary::Mul, w, s)
        };
        let (p, q) = (side(Binary::Sub, Binary::Add), side(Binary::Add, Binary::Sub));
        self.graph.binary(Binary::Hypot, p, q)
    }

    /// `(f + g +- r) r^m` with `r = hypot(f, g)`; the parameter m counts as constant, and where both vanish the slope is 0.
    fn smooth(&mut self, o: &Operands) -> Slope {
        let m = o.parameter.0;
        let r = self.graph.binary(Binary::Hypot, o.f.0, o.g.0);
        let (t1, t2) = (self.times(Some(o.f.0), o.f.1), self.times(Some(o.g.0), o.g.1));
        let top = self.plus(t1, t2)?;
        let dr = self.graph.binary(Binary::Div, top, r);
        let sum = self.graph.binary(Binary::Add, o.f.0, o.g.0);
        let base = self.graph.binary(o.sign, sum, r);
        let dsum = self.plus(o.f.1, o.g.1);
        let dbase = if o.sign == Binary::Add { self.plus(dsum, Some(dr)) } else { self.minus(dsum, Some(dr)) };
        let factor = self.graph.binary(Binary::Pow, r, m);
        let left = self.times(dbase, Some(factor));
        let grown = self.graph.binary(Binary::Mul, base, m);
        let grown = self.graph.binary(Binary::Mul, grown, factor);
        let grown = self.graph.binary(Binary::Div, grown, r);
        let right = self.times(Some(grown), Some(dr));
        let slope = self.plus(left, right);
        self.select(r, slope, None)
    }
}

/// The derivative of a leaf by one of its arguments, itself a leaf. Its own slope, a second derivative of data, is a difference
/// quotient.
#[derive(Debug)]
struct LeafSlope {
    of: SharedLeaf,
    axis: usize,
}

impl Leaf for LeafSlope {
    fn fingerprint(&self) -> u128 {
        let turned = self.of.0.fingerprint().rotate_left(17);
        turned.wrapping_mul(0x9e37_79b9_7f4a_7c15_f39c_c060_5ced_c835) ^ (self.axis as u128 + 1)
    }

    fn name(&self) -> &str {
        self.of.0.name()
    }

    fn arity(&self) -> usize {
        self.of.0.arity()
    }

    fn value(&self, at: &[f64]) -> f64 {
        let mut slope = [0.0; 4];
        self.of.0.gradient(at, &mut slope[..at.len()]);
        slope[self.axis]
    }

    fn gradient(&self, at: &[f64], slope: &mut [f64]) -> f64 {
        let mut near = [0.0; 4];
        near[..at.len()].copy_from_slice(at);
        for (axis, out) in slope.iter_mut().enumerate() {
            let step = (at[axis].abs() + 1.0) * 1e-6;
            near[axis] = at[axis] + step;
            let above = self.value(&near[..at.len()]);
            near[axis] = at[axis] - step;
            let below = self.value(&near[..at.len()]);
            near[axis] = at[axis];
            *out = (above - below) / (2.0 * step);
        }
        self.value(at)
    }

    fn bounds(&self, over: &[Interval]) -> Interval {
        self.of.0.slope_bounds(self.axis, over)
    }
}
