//! Programs along rays: where a set expression of polynomials, of degree four at most, is first inside. Each part's polynomial comes from
//! running its operations on polynomials of the distance; a part may also be `A + B sqrt(Q)` with such polynomials, as a torus is. Says no to
//! every other program.

#[cfg(not(debug_assertions))]
use multiversion::multiversion;

use super::program::{Op, Program, Value};
use crate::number::polynomial::{self, MOST};
use crate::number::{Binary, Ternary, Unary};

/// Rays at a time.
pub const LANES: usize = 16;
/// Parts of a set expression at most.
const PARTS: usize = 64;
/// Operations at most: beyond that boxes pay.
const OPERATIONS: usize = 2_000;

/// A number for each of several rays.
pub type Row = [f64; LANES];

/// A polynomial in the storage: its first row and its degree.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Poly {
    row: usize,
    degree: usize,
    /// Whether it is a sum of squares, so that it has a root.
    square: bool,
}

/// `a + b sqrt(q)`; what is missing is zero.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Kind {
    a: Option<Poly>,
    b: Option<(Poly, Poly)>,
}

/// A step of the computation, from rows to later rows.
#[derive(Clone, Copy, Debug)]
enum Step {
    Constant(usize, f64),
    /// `x a + y b`
    Mix(Poly, (f64, Poly), (f64, Poly)),
    /// `x a`
    Scale(Poly, f64, Poly),
    Multiply(Poly, Poly, Poly),
    /// Of numbers.
    Unary(usize, Unary, usize),
    Binary(usize, Binary, usize, usize),
    /// A polynomial by a number.
    Divide(Poly, Poly, usize),
}

/// A part of a set expression.
#[derive(Clone, Copy, Debug)]
struct Part {
    kind: Kind,
    /// What vanishes where the part does: the part, or `a^2 - b^2 q`.
    vanishes: Poly,
}

/// How the parts are joined: each operation after its operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Token {
    Part(usize),
    Union,
    Intersection,
    Complement,
}

/// A program as polynomials along rays.
#[derive(Clone, Debug)]
pub struct Along {
    steps: Vec<Step>,
    rows: usize,
    parts: Vec<Part>,
    tokens: Vec<Token>,
}

/// Storage for one thread.
#[derive(Debug, Default)]
pub struct Rows {
    values: Vec<Row>,
    roots: Vec<Row>,
    stack: Vec<Row>,
}

/// The rows of the axes: start and change of each.
const AXES: usize = 6;

struct Builder {
    steps: Vec<Step>,
    rows: usize,
    kinds: Vec<Option<Kind>>,
}

impl Along {
    /// The program of a shape of three axes, whose other inputs have these values.
    #[must_use]
    pub fn of(program: &Program, fixed: &[f64]) -> Option<Self> {
        let inputs = program.inputs.len();
        if inputs != 3 + fixed.len() || program.operations.len() > OPERATIONS || !program.leaves.is_empty() {
            return None;
        }
        let mut builder = Builder { steps: Vec::new(), rows: AXES, kinds: Vec::new() };
        for axis in 0..3 {
            let poly = Poly { row: 2 * axis, degree: 1, square: false };
            builder.kinds.push(Some(Kind { a: Some(poly), b: None }));
        }
        for &value in fixed {
            let poly = builder.constant(value);
            builder.kinds.push(Some(Kind { a: Some(poly), b: None }));
        }
        for op in &program.operations {
            let kind = builder.operation(op);
            builder.kinds.push(kind);
        }
        let mut along = Self { steps: Vec::new(), rows: 0, parts: Vec::new(), tokens: Vec::new() };
        along.tree(program, &mut builder)?;
        along.steps = builder.steps;
        along.rows = builder.rows;
        Some(along)
    }

    /// The set operations from the root downwards.
    fn tree(&mut self, program: &Program, builder: &mut Builder) -> Option<()> {
        let inputs = program.inputs.len();
        let mut open = vec![(program.root, None)];
        while let Some((at, join)) = open.pop() {
            if let Some(token) = join {
                self.tokens.push(token);
                continue;
            }
            if let Some(part) = builder.kinds[at as usize].and_then(|kind| builder.part(kind)) {
                if self.parts.len() == PARTS {
                    return None;
                }
                self.tokens.push(Token::Part(self.parts.len()));
                self.parts.push(part);
                continue;
            }
            let op = *program.operations.get((at as usize).checked_sub(inputs)?)?;
            let (token, operands): (Token, [Option<Value>; 2]) = match op {
                Op::Extreme(Binary::Max, _, a, b) | Op::Binary(Binary::Max, a, b) => (Token::Union, [Some(a), Some(b)]),
                Op::Extreme(Binary::Min, _, a, b) | Op::Binary(Binary::Min, a, b) => {
                    (Token::Intersection, [Some(a), Some(b)])
                }
                Op::Join(Ternary::Union, a, b, alpha) if in_range(alpha) => (Token::Union, [Some(a), Some(b)]),
                Op::Join(Ternary::Intersection, a, b, alpha) if in_range(alpha) => {
                    (Token::Intersection, [Some(a), Some(b)])
                }
                Op::Unary(Unary::Neg, a) => (Token::Complement, [Some(a), None]),
                _ => return None,
            };
            open.push((at, Some(token)));
            open.extend(operands.into_iter().flatten().map(|operand| (operand, None)));
        }
        Some(())
    }

    /// Where each ray is first inside, for the distances from -1 to 1 along `start + t change`: -1 where it is inside at once, NaN where it
    /// never is.
    pub fn first(&self, rows: &mut Rows, start: &[Row; 3], change: &[Row; 3], out: &mut Row) {
        rows.values.resize(self.rows, [0.0; LANES]);
        for axis in 0..3 {
            (rows.values[2 * axis], rows.values[2 * axis + 1]) = (start[axis], change[axis]);
        }
        solve(self, rows, out);
    }

    /// The first place inside of an object of one part, if it was found on all rays.
    #[inline(always)]
    fn first_of_one(&self, rows: &[Row], out: &mut Row) -> bool {
        let ([Part { kind, vanishes }], [Token::Part(_)]) = (&self.parts[..], &self.tokens[..]) else { return false };
        let at = |poly: Poly, t: &Row| polynomial::value(&rows[poly.row..=poly.row + poly.degree], t);
        let parts = |t: &Row| {
            let a = kind.a.map_or([0.0; LANES], |a| at(a, t));
            (a, kind.b.map_or(([0.0; LANES], [0.0; LANES]), |(b, q)| (at(b, t), at(q, t))))
        };
        let mut is_whole = polynomial::first(&rows[vanishes.row..=vanishes.row + vanishes.degree], -1.0, 1.0, out);
        let (near, (factor, under)) = parts(&[-1.0; LANES]);
        let (a, (b, _)) = parts(out);
        for lane in 0..LANES {
            let begins_inside = near[lane] + factor[lane] * under[lane].max(0.0).sqrt() >= 0.0;
            // Where `a - b sqrt(q)` vanishes, `a` and `b` have the same sign.
            let is_missing = out[lane] == f64::INFINITY;
            is_whole &= begins_inside | is_missing | kind.b.is_none() | (a[lane] * b[lane] <= 0.0);
            let place = if is_missing { f64::NAN } else { out[lane] };
            out[lane] = if begins_inside { -1.0 } else { place };
        }
        is_whole
    }

    /// 1 where the object is inside, -1 elsewhere.
    #[inline(always)]
    fn inside(&self, rows: &[Row], stack: &mut Vec<Row>, t: &Row) -> Row {
        let at = |poly: Poly| polynomial::value(&rows[poly.row..=poly.row + poly.degree], t);
        stack.clear();
        for token in &self.tokens {
            match *token {
                Token::Part(k) => {
                    let Kind { a, b } = self.parts[k].kind;
                    let mut value = a.map_or([0.0; LANES], at);
                    if let Some((b, q)) = b {
                        let (b, q) = (at(b), at(q));
                        for lane in 0..LANES {
                            value[lane] += b[lane] * q[lane].max(0.0).sqrt();
                        }
                    }
                    stack.push(value.map(|v| if v >= 0.0 { 1.0 } else { -1.0 }));
                }
                Token::Complement => {
                    if let Some(top) = stack.last_mut() {
                        top.iter_mut().for_each(|v| *v = -*v);
                    }
                }
                Token::Union | Token::Intersection => {
                    let (Some(b), Some(a)) = (stack.pop(), stack.last_mut()) else { break };
                    let is_union = *token == Token::Union;
                    for (a, b) in a.iter_mut().zip(b) {
                        *a = if (*a > b) == is_union { *a } else { b };
                    }
                }
            }
        }
        stack.pop().unwrap_or([-1.0; LANES])
    }
}

/// The first place inside on each ray: from one of the parts' roots to the next, what lies between them.
#[cfg_attr(not(debug_assertions), multiversion(targets("x86_64+avx512f+avx512bw+avx512dq+avx512vl", "x86_64+avx2")))]
fn solve(along: &Along, rows: &mut Rows, out: &mut Row) {
    along.steps.iter().for_each(|step| step.run(&mut rows.values));
    if along.first_of_one(&rows.values, out) {
        return;
    }
    rows.roots.clear();
    for Part { vanishes, .. } in &along.parts {
        let mut found = [[0.0; LANES]; MOST];
        let count =
            polynomial::roots(&rows.values[vanishes.row..=vanishes.row + vanishes.degree], -1.0, 1.0, &mut found);
        rows.roots.extend_from_slice(&found[..count]);
    }
    let mut from = [-1.0; LANES];
    *out = [f64::NAN; LANES];
    for _ in 0..=rows.roots.len() {
        let mut to = [1.0; LANES];
        for root in &rows.roots {
            for lane in 0..LANES {
                let is_next = (root[lane] > from[lane]) & (root[lane] < to[lane]);
                to[lane] = if is_next { root[lane] } else { to[lane] };
            }
        }
        let middle: Row = std::array::from_fn(|lane| 0.5 * (from[lane] + to[lane]));
        let inside = along.inside(&rows.values, &mut rows.stack, &middle);
        let mut open = false;
        for lane in 0..LANES {
            let is_first = (inside[lane] > 0.0) & out[lane].is_nan() & (from[lane] < to[lane]);
            out[lane] = if is_first { from[lane] } else { out[lane] };
            open |= out[lane].is_nan() & (to[lane] < 1.0);
        }
        if !open {
            return;
        }
        from = to;
    }
}

fn in_range(alpha: f64) -> bool {
    -1.0 < alpha && alpha <= 1.0
}

impl Builder {
    fn poly(&mut self, degree: usize, square: bool) -> Poly {
        let row = self.rows;
        self.rows += degree + 1;
        Poly { row, degree, square }
    }

    fn constant(&mut self, value: f64) -> Poly {
        let poly = self.poly(0, value >= 0.0);
        self.steps.push(Step::Constant(poly.row, value));
        poly
    }

    fn kind(&self, value: Value) -> Option<Kind> {
        self.kinds[value as usize]
    }

    /// The number that a value is, if it does not change along a ray.
    fn number(&self, value: Value) -> Option<usize> {
        match self.kind(value)? {
            Kind { a: Some(Poly { row, degree: 0, .. }), b: None } => Some(row),
            _ => None,
        }
    }

    fn of_constant(&mut self, value: f64) -> Kind {
        Kind { a: Some(self.constant(value)), b: None }
    }

    fn operation(&mut self, op: &Op) -> Option<Kind> {
        match *op {
            Op::Constant(value) => Some(self.of_constant(value)),
            Op::Unary(op, a) => self.unary(op, a),
            Op::WithRight(op, a, c) => {
                if let (Binary::Pow, 0.0..=4.0, true) = (op, c, c.fract() == 0.0) {
                    return self.power(self.kind(a)?, c as u32);
                }
                let (a, c) = (self.kind(a)?, self.of_constant(c));
                self.binary(op, a, c)
            }
            Op::WithLeft(op, c, a) => {
                let (c, a) = (self.of_constant(c), self.kind(a)?);
                self.binary(op, c, a)
            }
            Op::Binary(Binary::Mul, a, b) if a == b => self.power(self.kind(a)?, 2),
            Op::Binary(op, a, b) => self.binary(op, self.kind(a)?, self.kind(b)?),
            _ => None,
        }
    }

    fn unary(&mut self, op: Unary, a: Value) -> Option<Kind> {
        let kind = self.kind(a)?;
        if let Some(row) = self.number(a) {
            let poly = self.poly(0, matches!(op, Unary::Abs | Unary::Sqrt));
            self.steps.push(Step::Unary(poly.row, op, row));
            return Some(Kind { a: Some(poly), b: None });
        }
        match op {
            Unary::Neg => Some(self.scaled(kind, -1.0)),
            Unary::Powi(n @ 0..=4) => self.power(kind, n as u32),
            Unary::Sqrt => match kind {
                Kind { a: Some(q), b: None } if q.square && q.degree <= 4 => {
                    let one = self.constant(1.0);
                    Some(Kind { a: None, b: Some((one, q)) })
                }
                _ => None,
            },
            _ => None,
        }
    }

    fn binary(&mut self, op: Binary, a: Kind, b: Kind) -> Option<Kind> {
        let number = |kind: Kind| match kind {
            Kind { a: Some(poly), b: None } if poly.degree == 0 => Some(poly.row),
            _ => None,
        };
        match (op, number(a), number(b)) {
            (Binary::Add, ..) => self.sum(a, b, 1.0),
            (Binary::Sub, ..) => self.sum(a, b, -1.0),
            (Binary::Mul, ..) => self.product(a, b),
            (op, Some(a), Some(b)) => {
                let poly = self.poly(0, false);
                self.steps.push(Step::Binary(poly.row, op, a, b));
                Some(Kind { a: Some(poly), b: None })
            }
            (Binary::Div, None, Some(by)) => {
                let part = a.a.map(|p| self.divided(p, by));
                let root = a.b.map(|(b, q)| (self.divided(b, by), q));
                Some(Kind { a: part, b: root })
            }
            _ => None,
        }
    }

    fn divided(&mut self, p: Poly, by: usize) -> Poly {
        let made = self.poly(p.degree, false);
        self.steps.push(Step::Divide(made, p, by));
        made
    }

    fn scale(&mut self, p: Poly, by: f64) -> Poly {
        let made = self.poly(p.degree, p.square && by >= 0.0);
        self.steps.push(Step::Scale(made, by, p));
        made
    }

    fn scaled(&mut self, kind: Kind, by: f64) -> Kind {
        Kind { a: kind.a.map(|a| self.scale(a, by)), b: kind.b.map(|(b, q)| (self.scale(b, by), q)) }
    }

    fn mix(&mut self, a: Poly, b: Poly, sign: f64) -> Poly {
        let made = self.poly(a.degree.max(b.degree), sign > 0.0 && a.square && b.square);
        self.steps.push(Step::Mix(made, (1.0, a), (sign, b)));
        made
    }

    fn add(&mut self, a: Option<Poly>, b: Option<Poly>, sign: f64) -> Option<Poly> {
        match (a, b) {
            (Some(a), Some(b)) => Some(self.mix(a, b, sign)),
            (None, Some(b)) => Some(if sign < 0.0 { self.scale(b, -1.0) } else { b }),
            (a, None) => a,
        }
    }

    fn sum(&mut self, a: Kind, b: Kind, sign: f64) -> Option<Kind> {
        let q = same(a, b)?;
        let root = self.add(a.b.map(|(b, _)| b), b.b.map(|(b, _)| b), sign);
        Some(Kind { a: self.add(a.a, b.a, sign), b: root.zip(q) })
    }

    fn multiply(&mut self, a: Poly, b: Poly) -> Option<Poly> {
        if a.degree + b.degree > MOST {
            return None;
        }
        let made = self.poly(a.degree + b.degree, a == b || a.square && b.square);
        self.steps.push(Step::Multiply(made, a, b));
        Some(made)
    }

    fn times(&mut self, a: Option<Poly>, b: Option<Poly>) -> Option<Option<Poly>> {
        match (a, b) {
            (Some(a), Some(b)) => self.multiply(a, b).map(Some),
            _ => Some(None),
        }
    }

    fn product(&mut self, a: Kind, b: Kind) -> Option<Kind> {
        let q = same(a, b)?;
        let (ab, bb) = (a.b.map(|(b, _)| b), b.b.map(|(b, _)| b));
        let plain = self.times(a.a, b.a)?;
        let both = self.times(ab, bb)?;
        let both = self.times(both, q)?;
        let (first, second) = (self.times(a.a, bb)?, self.times(ab, b.a)?);
        let root = self.add(first, second, 1.0);
        Some(Kind { a: self.add(plain, both, 1.0), b: root.zip(q) })
    }

    fn power(&mut self, kind: Kind, n: u32) -> Option<Kind> {
        let mut power = if n == 0 { self.of_constant(1.0) } else { kind };
        for _ in 1..n {
            power = self.product(power, kind)?;
        }
        Some(power)
    }

    /// A value as a part of a set expression.
    fn part(&mut self, kind: Kind) -> Option<Part> {
        let vanishes = match kind {
            Kind { a: None, b: None } => return None,
            Kind { a: Some(a), b: None } => a,
            Kind { a, b: Some((b, q)) } => {
                let square = self.times(a, a)?;
                let root = self.multiply(b, b).and_then(|b| self.multiply(b, q))?;
                self.add(square, Some(root), -1.0)?
            }
        };
        Some(Part { kind, vanishes })
    }
}

/// What two values have the root of, if it is one.
fn same(a: Kind, b: Kind) -> Option<Option<Poly>> {
    match (a.b, b.b) {
        (Some((_, p)), Some((_, q))) if p.row != q.row => None,
        (p, q) => Some(p.or(q).map(|(_, q)| q)),
    }
}

impl Step {
    /// Results lie behind what they are made of.
    #[inline(always)]
    fn run(self, rows: &mut [Row]) {
        match self {
            Self::Constant(row, value) => rows[row] = [value; LANES],
            Self::Unary(to, op, a) => rows[to] = rows[a].map(|a| op.real(a)),
            Self::Binary(to, op, a, b) => {
                let (a, b) = (rows[a], rows[b]);
                rows[to] = std::array::from_fn(|lane| op.real(a[lane], b[lane]));
            }
            Self::Scale(to, by, a) => {
                for k in 0..=a.degree {
                    rows[to.row + k] = rows[a.row + k].map(|a| by * a);
                }
            }
            Self::Divide(to, a, by) => {
                let by = rows[by];
                for k in 0..=a.degree {
                    let a = rows[a.row + k];
                    rows[to.row + k] = std::array::from_fn(|lane| a[lane] / by[lane]);
                }
            }
            Self::Mix(to, (x, a), (y, b)) => {
                for k in 0..=to.degree {
                    let of = |p: Poly, rows: &[Row]| if k <= p.degree { rows[p.row + k] } else { [0.0; LANES] };
                    let (a, b) = (of(a, rows), of(b, rows));
                    rows[to.row + k] = std::array::from_fn(|lane| x * a[lane] + y * b[lane]);
                }
            }
            Self::Multiply(to, a, b) => {
                let (before, after) = rows.split_at_mut(to.row);
                after[..=to.degree].fill([0.0; LANES]);
                for i in 0..=a.degree {
                    for j in 0..=b.degree {
                        let (x, y) = (&before[a.row + i], &before[b.row + j]);
                        after[i + j].iter_mut().zip(x.iter().zip(y)).for_each(|(sum, (x, y))| *sum += x * y);
                    }
                }
            }
        }
    }
}
