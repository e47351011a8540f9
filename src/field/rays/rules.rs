//! The ray form of each kind of node from those of its operands: the table of `mathematics.md` section 2. Says no wherever a rule does not
//! hold in every direction; never looks at numbers other than constants.

use super::form::{Degree, RayForm, Term};
use super::poly::Sums;
use crate::field::{Node, NodeId};
use crate::number::{Algebra, Binary, Ternary, Unary};

/// Why an expression has no ray form, or none that is a star.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Why {
    /// Data at a point that moves along the ray.
    Data,
    /// A loop or a search.
    Region,
    /// A function of something that changes along a ray, and for which there is no rule.
    Function,
    /// A root or a magnitude of several terms.
    Root,
    /// A power of several terms, or one whose exponent changes along a ray.
    Power,
    /// A quotient by several terms, or by zero.
    Quotient,
    /// The operands grow with different powers of the distance.
    Unlike,
    /// A comparison whose truth changes along a ray.
    Comparison,
    /// More terms than are kept, or degrees that vary with the direction.
    Terms,
    /// More nodes than are looked at.
    Size,
    /// The form is zero everywhere.
    Zero,
    /// The form has more terms than a root can be given for.
    Roots,
}

/// A form, or why there is none.
pub(super) type Ruled = Result<RayForm, Why>;

/// A form of one term or none; its degree, if it has one.
fn single(form: &RayForm) -> Option<Option<Degree>> {
    match form.terms() {
        [] => Some(None),
        [only] => Some(Some(only.degree)),
        _ => None,
    }
}

/// The degree of forms that have one term of the same degree each, or none.
fn common(forms: &[&RayForm]) -> Option<Degree> {
    let mut found: Option<Degree> = None;
    for form in forms {
        match (single(form)?, found) {
            (Some(degree), Some(before)) if !degree.is_same(before) => return None,
            (Some(degree), None) => found = Some(degree),
            _ => {}
        }
    }
    Some(found.unwrap_or(Degree::ZERO))
}

pub(super) struct Rules<'a> {
    pub(super) sums: &'a mut Sums,
}

impl Rules<'_> {
    /// The form of a node that is no coordinate and no map.
    pub(super) fn of(&mut self, node: &Node, operands: &[RayForm]) -> Ruled {
        if let Some(constants) = operands.iter().map(RayForm::constant).collect::<Option<Vec<_>>>() {
            return Ok(self.constant(node, &constants));
        }
        match (node, operands) {
            (Node::Unary(op, _), [a]) => self.unary(*op, a),
            (Node::Binary(op, ..), [a, b]) => self.binary(*op, a, b),
            (Node::Ternary(Ternary::Select, _), [condition, a, b]) => self.select(condition, a, b),
            (Node::Ternary(op, _), [a, b, c]) => self.join(*op, a, b, c),
            (Node::Leaf(leaf, _), _) if leaf.0.is_ray_linear() => {
                let degree = common(&operands.iter().collect::<Vec<_>>()).ok_or(Why::Unlike)?;
                let at: Vec<NodeId> = operands.iter().map(|o| self.sums.coefficient(o)).collect();
                Ok(RayForm::one(degree, self.sums.graph.leaf(leaf.clone(), &at)))
            }
            (Node::Leaf(..), _) => Err(Why::Data),
            _ => Err(Why::Region),
        }
    }

    /// A function of what is the same all along a ray is so too: \[A92\] theorem 2.
    fn constant(&mut self, node: &Node, operands: &[Option<NodeId>]) -> RayForm {
        let mut numbers = Vec::with_capacity(operands.len());
        node.for_each_operand(|e| numbers.push(e));
        let operands: Vec<NodeId> =
            operands.iter().map(|o| o.unwrap_or_else(|| self.sums.graph.constant(0.0))).collect();
        let made = match (node, &operands[..]) {
            (Node::Unary(Unary::Neg, _), [a]) => self.sums.neg(*a),
            (Node::Unary(Unary::Powi(n), _), [a]) => self.sums.power(*a, *n),
            (Node::Binary(Binary::Mul, ..), [a, b]) => self.sums.multiply(*a, *b),
            (Node::Binary(Binary::Div, ..), [a, b]) => self.sums.divide(*a, *b),
            (Node::Binary(op @ (Binary::Add | Binary::Sub), ..), [a, b]) => {
                let second = if *op == Binary::Sub { self.sums.neg(*b) } else { *b };
                match self.sums.add(*a, second) {
                    Some(sum) => sum,
                    None => return RayForm::zero(),
                }
            }
            _ => {
                let place = |e: NodeId| numbers.iter().position(|n| *n == e).map_or(e, |k| operands[k]);
                self.sums.graph.rebuilt(node, place)
            }
        };
        if self.sums.graph.number(made) == Some(0.0) { RayForm::zero() } else { RayForm::one(Degree::ZERO, made) }
    }

    fn unary(&mut self, op: Unary, a: &RayForm) -> Ruled {
        if op == Unary::Neg {
            return Ok(self.sums.negated(a));
        }
        if let Unary::Powi(n) = op {
            return self.whole_power(a, n);
        }
        let root = |by: f64| move |d: Degree| Degree { value: d.value / by, of: d.of };
        let degree = match (op, single(a)) {
            (Unary::Sqrt, Some(Some(d))) => root(2.0)(d),
            (Unary::Cbrt, Some(Some(d))) => root(3.0)(d),
            (Unary::Abs, Some(Some(d))) => d,
            (Unary::Sign | Unary::Not, Some(Some(_))) => Degree::ZERO,
            (Unary::Sqrt | Unary::Cbrt | Unary::Abs, _) => return Err(Why::Root),
            (Unary::Sign | Unary::Not, _) => return Err(Why::Comparison),
            _ => return Err(Why::Function),
        };
        let coefficient = self.sums.coefficient(a);
        let coefficient = self.sums.graph.unary(op, coefficient);
        Ok(RayForm::one(degree, coefficient))
    }

    fn whole_power(&mut self, a: &RayForm, n: i32) -> Ruled {
        match a.terms() {
            [] => Err(Why::Power),
            [only] => {
                let degree = Degree { value: only.degree.value * f64::from(n), of: only.degree.of };
                let coefficient = self.sums.power(only.coefficient, n);
                Ok(RayForm::one(if n == 0 { Degree::ZERO } else { degree }, coefficient))
            }
            _ => {
                let n = u32::try_from(n).map_err(|_| Why::Quotient)?;
                let mut power = RayForm::one(Degree::ZERO, self.sums.constant(1.0));
                // More factors than there may be terms would have too many terms.
                for _ in 0..n.min(64) {
                    power = self.sums.product(&power, a).ok_or(Why::Terms)?;
                }
                if n > 64 { Err(Why::Terms) } else { Ok(power) }
            }
        }
    }

    fn binary(&mut self, op: Binary, a: &RayForm, b: &RayForm) -> Ruled {
        match op {
            Binary::Add => self.sums.sum(a, b).ok_or(Why::Terms),
            Binary::Sub => self.difference(a, b).ok_or(Why::Terms),
            Binary::Mul => self.sums.product(a, b).ok_or(Why::Terms),
            Binary::Div => match b.terms() {
                [only] => self.sums.quotient(a, *only).ok_or(Why::Terms),
                _ => Err(Why::Quotient),
            },
            Binary::Pow => self.power(a, b),
            Binary::Min | Binary::Max => self.extreme(op, a, b),
            Binary::Hypot | Binary::Mod => {
                let degree = common(&[a, b]).ok_or(Why::Unlike)?;
                Ok(self.together(op, a, b, degree))
            }
            Binary::Atan2 => {
                common(&[a, b]).ok_or(Why::Unlike)?;
                Ok(self.together(op, a, b, Degree::ZERO))
            }
            Binary::And | Binary::Or => match (single(a), single(b)) {
                (Some(_), Some(_)) => Ok(self.together(op, a, b, Degree::ZERO)),
                _ => Err(Why::Comparison),
            },
            Binary::Less | Binary::LessEqual | Binary::Equal | Binary::NotEqual => self.comparison(op, a, b),
        }
    }

    fn difference(&mut self, a: &RayForm, b: &RayForm) -> Option<RayForm> {
        let minus = self.sums.negated(b);
        self.sums.sum(a, &minus)
    }

    /// The operation on the coefficients of two forms of at most one term each.
    fn together(&mut self, op: Binary, a: &RayForm, b: &RayForm, degree: Degree) -> RayForm {
        let (a, b) = (self.sums.coefficient(a), self.sums.coefficient(b));
        RayForm::one(degree, self.sums.graph.binary(op, a, b))
    }

    /// Of forms that differ in one degree at most, the smaller or larger is that with the smaller or larger coefficient there.
    fn extreme(&mut self, op: Binary, a: &RayForm, b: &RayForm) -> Ruled {
        if let Some(degree) = common(&[a, b]) {
            return Ok(self.together(op, a, b, degree));
        }
        let mut terms: Vec<Term> = Vec::new();
        let mut degrees: Vec<Degree> = a.terms().iter().map(|t| t.degree).collect();
        degrees.extend(b.terms().iter().map(|t| t.degree).filter(|d| a.terms().iter().all(|t| !t.degree.is_same(*d))));
        let mut differing = 0;
        for degree in degrees {
            let of = |form: &RayForm| form.terms().iter().find(|t| t.degree.is_same(degree)).map(|t| t.coefficient);
            let (s, t) = (of(a), of(b));
            let coefficient = if s == t {
                s.ok_or(Why::Unlike)?
            } else {
                differing += 1;
                let zero = self.sums.constant(0.0);
                self.sums.graph.binary(op, s.unwrap_or(zero), t.unwrap_or(zero))
            };
            terms.push(Term { degree, coefficient });
        }
        if differing > 1 { Err(Why::Unlike) } else { Ok(RayForm::new(terms)) }
    }

    /// The truth is that of the coefficient of the difference, if that has one term: the power of the distance is positive.
    fn comparison(&mut self, op: Binary, a: &RayForm, b: &RayForm) -> Ruled {
        let truth = if common(&[a, b]).is_some() {
            return Ok(self.together(op, a, b, Degree::ZERO));
        } else {
            let difference = self.difference(a, b).ok_or(Why::Comparison)?;
            single(&difference).ok_or(Why::Comparison)?;
            let zero = self.sums.constant(0.0);
            let coefficient = self.sums.coefficient(&difference);
            self.sums.graph.binary(op, coefficient, zero)
        };
        // What fell away in the difference must be defined, or the comparison is false.
        let parts = a.terms().iter().chain(b.terms()).map(|t| t.coefficient);
        parts.for_each(|c| self.sums.drop_coefficient(c));
        Ok(RayForm::one(Degree::ZERO, truth))
    }

    fn power(&mut self, a: &RayForm, b: &RayForm) -> Ruled {
        let exponent = match b.constant() {
            Some(Some(exponent)) => exponent,
            Some(None) => self.sums.constant(0.0),
            None => return Err(Why::Power),
        };
        let number = self.sums.graph.number(exponent);
        match (a.terms(), number) {
            ([], _) => Err(Why::Power),
            ([only], _) => {
                let degree = self.raised(only.degree, exponent).ok_or(Why::Power)?;
                let coefficient = self.sums.graph.binary(Binary::Pow, only.coefficient, exponent);
                Ok(RayForm::one(degree, coefficient))
            }
            (_, Some(n)) if n.fract() == 0.0 && (0.0..=64.0).contains(&n) => self.whole_power(a, n as i32),
            _ => Err(Why::Power),
        }
    }

    /// The degree times an exponent. One that varies with the direction is kept as a factor, and leaves again by its inverse:
    /// \[A92\] theorem 1 (6).
    fn raised(&self, degree: Degree, exponent: NodeId) -> Option<Degree> {
        if degree.is_zero() {
            return Some(Degree::ZERO);
        }
        if let Some(value) = self.sums.graph.number(exponent) {
            let raised = Degree { value: degree.value * value, of: degree.of };
            return Some(if value == 0.0 { Degree::ZERO } else { raised });
        }
        let (factor, of, inverse) = self.factored(exponent);
        match (degree.of, inverse) {
            (None, false) => Some(Degree { value: degree.value * factor, of: Some(of) }),
            (None, true) => Some(Degree { value: degree.value, of: Some(exponent) }),
            (Some(known), true) if known == of => Some(Degree::number(degree.value * factor)),
            _ => None,
        }
    }

    /// An exponent as a number times a node, or a number divided by one.
    fn factored(&self, exponent: NodeId) -> (f64, NodeId, bool) {
        let graph = &self.sums.graph;
        let (mut factor, mut node, mut inverse) = (1.0, exponent, false);
        loop {
            let (by, next) = match *graph.node(node) {
                Node::Unary(Unary::Neg, a) => (-1.0, a),
                Node::Binary(Binary::Mul, a, b) => match (graph.number(a), graph.number(b)) {
                    (Some(by), _) => (by, b),
                    (_, Some(by)) => (by, a),
                    _ => return (factor, node, inverse),
                },
                Node::Binary(Binary::Div, a, b) => match (graph.number(a), graph.number(b)) {
                    (Some(by), _) if !inverse => {
                        factor *= by;
                        inverse = true;
                        node = b;
                        continue;
                    }
                    (_, Some(by)) => (1.0 / by, a),
                    _ => return (factor, node, inverse),
                },
                _ => return (factor, node, inverse),
            };
            factor = if inverse { factor / by } else { factor * by };
            node = next;
        }
    }

    /// An R-function of two forms of one degree: each is a power of its operands' size.
    fn join(&mut self, op: Ternary, a: &RayForm, b: &RayForm, c: &RayForm) -> Ruled {
        let degree = common(&[a, b]).ok_or(Why::Unlike)?;
        let Some(parameter) = c.constant() else { return Err(Why::Unlike) };
        let parameter = parameter.unwrap_or_else(|| self.sums.graph.constant(0.0));
        let degree = match op {
            Ternary::UnionSmooth | Ternary::IntersectionSmooth => {
                let m = self.sums.graph.number(parameter).ok_or(Why::Unlike)?;
                Degree { value: degree.value * (1.0 + m), of: degree.of }
            }
            _ => degree,
        };
        let (a, b) = (self.sums.coefficient(a), self.sums.coefficient(b));
        Ok(RayForm::one(degree, self.sums.graph.ternary(op, a, b, parameter)))
    }

    /// By branch: the condition is the same all along a ray.
    fn select(&mut self, condition: &RayForm, a: &RayForm, b: &RayForm) -> Ruled {
        single(condition).ok_or(Why::Comparison)?;
        let condition = self.sums.coefficient(condition);
        if let Some(known) = self.sums.graph.number(condition) {
            return Ok(if crate::field::build::is_true(known) { a.clone() } else { b.clone() });
        }
        let mut terms: Vec<Term> = Vec::new();
        let mut degrees: Vec<Degree> = a.terms().iter().map(|t| t.degree).collect();
        degrees.extend(b.terms().iter().map(|t| t.degree).filter(|d| a.terms().iter().all(|t| !t.degree.is_same(*d))));
        for degree in degrees {
            let zero = self.sums.constant(0.0);
            let of = |form: &RayForm| form.terms().iter().find(|t| t.degree.is_same(degree)).map(|t| t.coefficient);
            let (s, t) = (of(a).unwrap_or(zero), of(b).unwrap_or(zero));
            terms.push(Term { degree, coefficient: self.sums.graph.ternary(Ternary::Select, condition, s, t) });
        }
        Ok(RayForm::new(terms))
    }
}
