//! Bounds of a function and of its derivatives by x1, x2 and x3 over boxes, node by node. Never evaluates a point; never claims more than
//! intervals show, but for functions that jump: where a condition or an angle changes from one branch to another they count as continuous
//! unless the branches are certainly apart.

use super::expand::reachable;
use super::graph::{Graph, Node, NodeId};
use crate::number::{Binary, Interval, Ternary, Unary};

/// A value over a box with its derivatives.
#[derive(Clone, Copy, Debug)]
pub struct Sloped {
    /// The values.
    pub value: Interval,
    /// The derivatives by x1, x2 and x3.
    pub by: [Interval; 3],
}

const ZERO: Interval = Interval { lo: 0.0, hi: 0.0, undefined: false };
const ONE: Interval = Interval { lo: 1.0, hi: 1.0, undefined: false };
/// What a weight of a norm can be.
const WEIGHT: (f64, f64) = (-1.0, 1.0);

impl Sloped {
    fn constant(value: f64) -> Self {
        Self { value: Interval::point(value), by: [ZERO; 3] }
    }

    fn is_flat(&self) -> bool {
        self.by.iter().all(|by| *by == ZERO)
    }

    /// An upper bound of the length of the gradient; infinite where nothing is known.
    #[must_use]
    pub fn steepest(&self) -> f64 {
        let [x, y, z] = self.by.map(Interval::largest);
        let length = (x * x + y * y + z * z).sqrt() * (1.0 + 4.0 * f64::EPSILON);
        if length.is_nan() { f64::INFINITY } else { length }
    }
}

/// Evaluates one expression over boxes.
pub struct Slopes<'a> {
    graph: &'a Graph,
    root: NodeId,
    order: Vec<NodeId>,
    known: Vec<Sloped>,
}

impl<'a> Slopes<'a> {
    /// For the value at a root of a graph without maps, data and regions, of no coordinates but x1, x2 and x3. What else there is counts
    /// as not known.
    #[must_use]
    pub fn new(graph: &'a Graph, root: NodeId) -> Self {
        let reached = reachable(graph, root);
        let order = (0u32..).map(NodeId).take(reached.len()).filter(|id| reached[id.index()]).collect();
        Self { graph, root, order, known: vec![Sloped::constant(0.0); reached.len()] }
    }

    /// Nodes that a box takes.
    #[must_use]
    pub fn len(&self) -> usize {
        self.order.len()
    }

    /// Whether there is no node.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.order.is_empty()
    }

    /// The value and its derivatives over a box.
    pub fn over(&mut self, space: &[Interval; 3]) -> Sloped {
        for at in 0..self.order.len() {
            let id = self.order[at];
            self.known[id.index()] = self.node(id, space);
        }
        self.known[self.root.index()]
    }

    fn node(&self, id: NodeId, space: &[Interval; 3]) -> Sloped {
        let of = |id: NodeId| self.known[id.index()];
        let sloped = match self.graph.node(id) {
            Node::Constant(c) => return Sloped::constant(c.get()),
            Node::Coordinate(c) => {
                let k = usize::from(c.0) - 1;
                let by = std::array::from_fn(|axis| if axis == k { ONE } else { ZERO });
                Sloped { value: space.get(k).copied().unwrap_or(Interval::WHOLE), by }
            }
            Node::Unary(Unary::Sqrt, a) => {
                let value = Unary::Sqrt.interval(of(*a).value);
                self.root_of_squares(*a, value).unwrap_or_else(|| unary(Unary::Sqrt, of(*a)))
            }
            Node::Unary(op, a) => unary(*op, of(*a)),
            Node::Binary(op, a, b) => binary(*op, of(*a), of(*b)),
            Node::Ternary(op, [a, b, c]) => ternary(*op, of(*a), of(*b), of(*c)),
            Node::Leaf(..) | Node::Region(..) | Node::Map(..) => {
                Sloped { value: Interval::WHOLE.or_undefined(true), by: [Interval::WHOLE; 3] }
            }
        };
        // What may be undefined may be anything.
        let sane = |by: Interval| if by.undefined || by.is_empty() { Interval::WHOLE } else { by };
        Sloped { by: sloped.by.map(sane), ..sloped }
    }

    /// The root of a sum of squares: a norm, whose derivatives are bounded by those of what is squared, also where the sum is 0.
    fn root_of_squares(&self, sum: NodeId, value: Interval) -> Option<Sloped> {
        let mut open = vec![sum];
        let mut by = [ZERO; 3];
        while let Some(id) = open.pop() {
            let (factor, square) = match self.graph.node(id) {
                Node::Binary(Binary::Add, a, b) => {
                    open.extend([*a, *b]);
                    continue;
                }
                Node::Constant(c) if c.get() >= 0.0 => continue,
                Node::Binary(Binary::Mul, a, b) if a != b => match self.graph.number(*b) {
                    Some(factor) if factor >= 0.0 => (factor, self.graph.node(*a)),
                    _ => return None,
                },
                other => (1.0, other),
            };
            let squared = match square {
                Node::Unary(Unary::Powi(2), a) => *a,
                Node::Binary(Binary::Mul, a, b) if a == b => *a,
                _ => return None,
            };
            let inner = self.known[squared.index()];
            let most = factor.sqrt().next_up();
            let weight = quotient(times(Interval::point(factor), inner.value), value);
            let weight = within(weight, -most, most);
            by = std::array::from_fn(|k| plus(by[k], times(weight, inner.by[k])));
        }
        Some(Sloped { value, by })
    }
}

fn plus(a: Interval, b: Interval) -> Interval {
    Binary::Add.interval(a, b)
}

fn minus(a: Interval, b: Interval) -> Interval {
    Binary::Sub.interval(a, b)
}

/// A product in which a 0 that is known wins over what is not.
fn times(a: Interval, b: Interval) -> Interval {
    if a == ZERO || b == ZERO { ZERO } else { Binary::Mul.interval(a, b) }
}

fn quotient(a: Interval, b: Interval) -> Interval {
    if a == ZERO { ZERO } else { Binary::Div.interval(a, b) }
}

/// What is known by other means to lie between two numbers.
fn within(a: Interval, lo: f64, hi: f64) -> Interval {
    let clipped = a.clip(lo, hi);
    if a.undefined || clipped.is_empty() { Interval::new(lo, hi) } else { clipped }
}

/// The chain rule.
fn chain(value: Interval, parts: &[(Interval, Sloped)]) -> Sloped {
    let by = std::array::from_fn(|k| {
        parts.iter().fold(ZERO, |sum, (weight, part)| {
            // A constant's slope stays 0, whatever a function does there.
            if part.by[k] == ZERO { sum } else { plus(sum, times(*weight, part.by[k])) }
        })
    });
    Sloped { value, by }
}

fn unary(op: Unary, a: Sloped) -> Sloped {
    let x = a.value;
    let value = op.interval(x);
    if a.is_flat() {
        return Sloped { value, by: [ZERO; 3] };
    }
    let one_less_square = || times(minus(ONE, x), plus(ONE, x));
    let weight = match op {
        Unary::Neg => Interval::point(-1.0),
        Unary::Abs if x.lo >= 0.0 => ONE,
        Unary::Abs if x.hi <= 0.0 => Interval::point(-1.0),
        Unary::Abs => Interval::new(WEIGHT.0, WEIGHT.1),
        Unary::Sqrt => quotient(Interval::point(0.5), value),
        Unary::Cbrt => quotient(ONE, times(Interval::point(3.0), Unary::Powi(2).interval(value))),
        Unary::Exp => value,
        Unary::Log => quotient(ONE, x),
        Unary::Log10 => quotient(Interval::point(std::f64::consts::LOG10_E), x),
        Unary::Sin => Unary::Cos.interval(x),
        Unary::Cos => Unary::Neg.interval(Unary::Sin.interval(x)),
        Unary::Tan => plus(ONE, Unary::Powi(2).interval(value)),
        Unary::Asin => quotient(ONE, Unary::Sqrt.interval(one_less_square())),
        Unary::Acos => quotient(Interval::point(-1.0), Unary::Sqrt.interval(one_less_square())),
        Unary::Atan => quotient(ONE, plus(ONE, Unary::Powi(2).interval(x))),
        Unary::Sinh => Unary::Cosh.interval(x),
        Unary::Cosh => Unary::Sinh.interval(x),
        Unary::Tanh => within(minus(ONE, Unary::Powi(2).interval(value)), 0.0, 1.0),
        Unary::Asinh => quotient(ONE, Binary::Hypot.interval(x, ONE)),
        Unary::Acosh => quotient(ONE, Unary::Sqrt.interval(minus(Unary::Powi(2).interval(x), ONE))),
        Unary::Atanh => quotient(ONE, one_less_square()),
        Unary::Floor | Unary::Ceil | Unary::Round | Unary::Sign | Unary::Not => return step(value),
        Unary::Powi(n) => times(Interval::point(f64::from(n)), Unary::Powi(n.saturating_sub(1)).interval(x)),
    };
    chain(value, &[(weight, a)])
}

/// What is level, but for jumps.
fn step(value: Interval) -> Sloped {
    let by = if value.is_point() { ZERO } else { Interval::WHOLE };
    Sloped { value, by: [by; 3] }
}

/// Either of two.
fn either(value: Interval, a: Sloped, b: Sloped) -> Sloped {
    Sloped { value, by: std::array::from_fn(|k| a.by[k].hull(b.by[k])) }
}

/// A divisor that reaches 0 from one side only, without the 0 itself, of which intervals do not know the sign: there a quotient is
/// infinite, which the numbers beside it tell as well.
fn one_sided(y: Interval) -> Interval {
    match (y.lo == 0.0, y.hi == 0.0) {
        (true, false) => Interval { lo: f64::MIN_POSITIVE, ..y },
        (false, true) => Interval { hi: -f64::MIN_POSITIVE, ..y },
        _ => y,
    }
}

fn binary(op: Binary, a: Sloped, b: Sloped) -> Sloped {
    let (x, mut y) = (a.value, b.value);
    let mut value = op.interval(x, y);
    if op == Binary::Div {
        y = one_sided(y);
        value = op.interval(x, y).or_undefined(value.undefined);
    }
    if a.is_flat() && b.is_flat() {
        return Sloped { value, by: [ZERO; 3] };
    }
    let (to_a, to_b) = match op {
        Binary::Add => (ONE, ONE),
        Binary::Sub => (ONE, Interval::point(-1.0)),
        Binary::Mul => (y, x),
        Binary::Div => (quotient(ONE, y), Unary::Neg.interval(quotient(value, y))),
        Binary::Min | Binary::Max => {
            let first = if op == Binary::Min { x.hi < y.lo } else { x.lo > y.hi };
            let second = if op == Binary::Min { y.hi < x.lo } else { y.lo > x.hi };
            return match (first, second) {
                (true, _) => Sloped { value, ..a },
                (_, true) => Sloped { value, ..b },
                _ => either(value, a, b),
            };
        }
        Binary::Pow => {
            let by_base = times(y, Binary::Pow.interval(x, minus(y, ONE)));
            let by_exponent = if b.is_flat() { ZERO } else { times(value, Unary::Log.interval(x)) };
            (by_base, by_exponent)
        }
        Binary::Atan2 => {
            let square = plus(Unary::Powi(2).interval(x), Unary::Powi(2).interval(y));
            (quotient(y, square), Unary::Neg.interval(quotient(x, square)))
        }
        Binary::Hypot => {
            let weight = |v: Interval| within(quotient(v, value), WEIGHT.0, WEIGHT.1);
            (weight(x), weight(y))
        }
        Binary::Mod => {
            let turns = Unary::Floor.interval(Binary::Div.interval(x, y));
            if !turns.is_point() {
                return Sloped { value, by: [Interval::WHOLE; 3] };
            }
            (ONE, Unary::Neg.interval(turns))
        }
        Binary::Less | Binary::LessEqual | Binary::Equal | Binary::NotEqual | Binary::And | Binary::Or => {
            return step(value);
        }
    };
    chain(value, &[(to_a, a), (to_b, b)])
}

fn ternary(op: Ternary, a: Sloped, b: Sloped, c: Sloped) -> Sloped {
    let value = op.interval(a.value, b.value, c.value);
    match op {
        Ternary::Select => select(value, a.value, b, c),
        _ if a.is_flat() && b.is_flat() && c.is_flat() => Sloped { value, by: [ZERO; 3] },
        // A parameter that moves is rare, and nothing is claimed of it.
        _ if !c.is_flat() => Sloped { value, by: [Interval::WHOLE; 3] },
        Ternary::Union => sets(value, a, b, c.value, 1.0),
        Ternary::Intersection => sets(value, a, b, c.value, -1.0),
        Ternary::UnionSmooth | Ternary::IntersectionSmooth => {
            let (plain, sign) =
                if op == Ternary::UnionSmooth { (Ternary::Union, 1.0) } else { (Ternary::Intersection, -1.0) };
            let plain = sets(plain.interval(a.value, b.value, ZERO), a, b, ZERO, sign);
            let size = binary(Binary::Hypot, a, b);
            let factor = binary(Binary::Pow, size, c);
            Sloped { value, ..binary(Binary::Mul, plain, factor) }
        }
        Ternary::Norm => {
            let less = minus(c.value, ONE);
            let weight = |v: Interval| {
                let (size, sign) = (Unary::Abs.interval(v), unit(v));
                let share = Binary::Pow.interval(quotient(size, value), less);
                // For exponents from 1 on no operand moves the norm faster than itself.
                let share = if c.value.lo >= 1.0 { within(share, 0.0, 1.0) } else { share };
                times(sign, share)
            };
            chain(value, &[(weight(a.value), a), (weight(b.value), b)])
        }
    }
}

/// The sign of a number.
fn unit(v: Interval) -> Interval {
    Interval::new(if v.lo >= 0.0 { 1.0 } else { -1.0 }, if v.hi <= 0.0 { -1.0 } else { 1.0 })
}

/// `IF a THEN b ELSE c`.
fn select(value: Interval, condition: Interval, b: Sloped, c: Sloped) -> Sloped {
    let may_fail = condition.undefined || condition.contains(0.0);
    let may_hold = condition.lo < 0.0 || condition.hi > 0.0;
    let apart = b.value.hi < c.value.lo || c.value.hi < b.value.lo;
    match (may_hold, may_fail) {
        (true, false) => b,
        (false, _) => c,
        (true, true) if apart => Sloped { value, by: [Interval::WHOLE; 3] },
        (true, true) => either(value, b, c),
    }
}

/// The R-union of \[P95\] eq. (2) with `sign` 1, the intersection with -1: by an operand it moves `(1 + s w)/(1 + alpha)` as fast as that,
/// where w is the operand's part in the root, from -1 to 1.
fn sets(value: Interval, a: Sloped, b: Sloped, alpha: Interval, sign: f64) -> Sloped {
    let (f, g) = (a.value, b.value);
    let part = |f: Interval, g: Interval| {
        let own = minus(f, times(alpha, g));
        let rest = times(minus(ONE, Unary::Powi(2).interval(alpha)), Unary::Powi(2).interval(g));
        let root = Unary::Sqrt.interval(within(plus(Unary::Powi(2).interval(own), rest), 0.0, f64::INFINITY));
        let share = within(quotient(own, root), WEIGHT.0, WEIGHT.1);
        quotient(plus(ONE, times(Interval::point(sign), share)), plus(ONE, alpha))
    };
    chain(value, &[(part(f, g), a), (part(g, f), b)])
}
