//! Trees of set operations over ray forms with one centre, as one gauge: the function F of the direction with the boundary at
//! `c + v / F(v)`, 0 where a ray never leaves. Builds expressions; proves nothing about their signs, but lists what must be proved.

use super::form::{Degree, RayForm};
use super::{Broken, Key, Rays, Why};
use crate::field::{Node, NodeId};
use crate::number::{Algebra, Binary, Ternary, Unary};

/// A shape that each ray from the centre leaves once, if what it lists holds in every direction.
#[derive(Clone, Debug)]
pub struct Star {
    /// The gauge: the boundary in the direction v is `c + v / F(v)`. It is of degree 1, not negative, and undefined where a coefficient is.
    pub gauge: NodeId,
    /// What must be positive in every direction for the gauge to be right, if it is no number: that the centre lies inside each part.
    pub positive: Option<NodeId>,
    /// What must not be negative in any direction for a ray to leave it only once, if anything.
    pub single: Option<NodeId>,
    /// What must be finite in every direction, if anything besides the gauge.
    pub finite: Option<NodeId>,
    /// The forms that the shape is joined of; one if it is a form by itself.
    pub leaves: Vec<RayForm>,
}

/// A shape on its way: a gauge, or nothing at all (a part without inside).
type Gauge = NodeId;

impl Rays<'_> {
    /// The shape as a star about the centre, if its form allows it.
    ///
    /// # Errors
    /// The first part that breaks it.
    pub fn star(&mut self, root: NodeId) -> Result<Star, Broken> {
        let mut star = Star { gauge: root, positive: None, single: None, finite: None, leaves: Vec::new() };
        let mut positive = Vec::new();
        let mut open = vec![Step::Visit((root, 0), false)];
        let mut done: Vec<Gauge> = Vec::new();
        while let Some(step) = open.pop() {
            match step {
                Step::Visit(key, complement) => {
                    self.shape((key, complement), (&mut star.leaves, &mut positive), &mut open, &mut done)?
                }
                Step::Join(is_union) => {
                    if let (Some(b), Some(a)) = (done.pop(), done.pop()) {
                        let gauge = if is_union { self.least(a, b) } else { self.largest(a, b) };
                        done.push(gauge);
                    }
                }
            }
        }
        star.gauge = done.pop().unwrap_or(root);
        if star.leaves.len() == 1 {
            self.alone(&mut star);
        }
        star.positive = distinct(positive).into_iter().reduce(|a, b| self.least(a, b));
        let single = distinct(std::mem::take(&mut self.single));
        star.single = single.into_iter().reduce(|a, b| self.least(a, b));
        let magnitudes: Vec<NodeId> =
            distinct(self.sums.lost.clone()).iter().map(|d| self.sums.graph.unary(Unary::Abs, *d)).collect();
        star.finite = magnitudes.into_iter().reduce(|a, b| self.sums.graph.binary(Binary::Add, a, b));
        Ok(star)
    }

    /// A single form needs no care for directions in which it has no root: where its gauge is not positive it is no star.
    fn alone(&mut self, star: &mut Star) {
        if let Ok(gauge) = self.gauge(&star.leaves[0].clone(), &mut Vec::new(), false) {
            star.gauge = gauge;
        }
    }

    fn shape(
        &mut self,
        (key, complement): (Key, bool),
        (leaves, positive): (&mut Vec<RayForm>, &mut Vec<NodeId>),
        open: &mut Vec<Step>,
        done: &mut Vec<Gauge>,
    ) -> Result<(), Broken> {
        let found = self.find(key);
        let (node, view) = key;
        let why = match &found {
            Ok(form) => {
                let form = if complement { self.sums.negated(form) } else { form.clone() };
                let form = self.sums.tidied(&form);
                match self.gauge(&form, positive, true) {
                    Ok(gauge) => {
                        leaves.push(form);
                        done.push(gauge);
                        return Ok(());
                    }
                    Err(why) => Broken { node: self.grown(key), why },
                }
            }
            Err(broken) => *broken,
        };
        if why.why == Why::Size {
            return Err(why);
        }
        let (a, b, union) = match self.source.node(node) {
            Node::Map(body, mapping) => {
                let inner = self.through(key, mapping);
                open.push(Step::Visit((*body, inner), complement));
                return Ok(());
            }
            Node::Unary(Unary::Neg, a) => {
                open.push(Step::Visit((*a, view), !complement));
                return Ok(());
            }
            Node::Binary(Binary::Max, a, b) => (*a, *b, true),
            Node::Binary(Binary::Min, a, b) => (*a, *b, false),
            Node::Ternary(op @ (Ternary::Union | Ternary::Intersection), [a, b, c]) if self.is_alpha(*c) => {
                (*a, *b, *op == Ternary::Union)
            }
            Node::Ternary(op @ (Ternary::UnionSmooth | Ternary::IntersectionSmooth), [a, b, c])
                if self.source.number(*c).is_some_and(|m| m >= 0.0) =>
            {
                (*a, *b, *op == Ternary::UnionSmooth)
            }
            _ => return Err(why),
        };
        open.push(Step::Join(union != complement));
        open.push(Step::Visit((b, view), complement));
        open.push(Step::Visit((a, view), complement));
        Ok(())
    }

    fn is_alpha(&self, c: NodeId) -> bool {
        self.source.number(c).is_some_and(|alpha| -1.0 < alpha && alpha <= 1.0)
    }

    /// Where a form grew to more terms than have a root: the innermost node that has them.
    fn grown(&self, key: Key) -> NodeId {
        let many = |key: &Key| matches!(self.forms.get(key), Some(Ok(form)) if !has_root(form));
        let mut at = key;
        loop {
            let (node, view) = at;
            let mut next = None;
            match self.source.node(node) {
                Node::Map(body, _) => next = self.numbers.get(&at).map(|inner| (*body, *inner)),
                plain => plain.for_each_operand(|e| {
                    if next.is_none() && many(&(e, view)) {
                        next = Some((e, view));
                    }
                }),
            }
            match next.filter(many) {
                Some(inner) => at = inner,
                None => return at.0,
            }
        }
    }

    /// The gauge of a form, and what must be positive for it. With `tamed` it is 0 where a ray never leaves; without, it may be negative or
    /// undefined there.
    fn gauge(&mut self, form: &RayForm, positive: &mut Vec<NodeId>, tamed: bool) -> Result<Gauge, Why> {
        if form.terms().iter().any(|t| t.degree.of.is_some()) {
            return self.varying(form, positive, tamed);
        }
        let gauge = match *form.terms() {
            [] => return Err(Why::Zero),
            [only] => {
                self.must_be_positive(only.coefficient, positive);
                self.sums.constant(0.0)
            }
            [low, high] => {
                self.must_be_positive(low.coefficient, positive);
                let outward = self.opposite(high.coefficient);
                let outward = if tamed { self.not_negative(outward) } else { outward };
                let ratio = self.sums.divide(outward, low.coefficient);
                self.root(ratio, high.degree.value - low.degree.value)
            }
            [low, middle, high] if evenly(form) => {
                self.must_be_positive(low.coefficient, positive);
                // With a positive first and no positive last coefficient there is one sign change at most, whatever the middle one is. Where
                // the last one is zero, what is left is a form of two terms, whose gauge the same formula gives.
                let outward = self.opposite(high.coefficient);
                if self.sums.graph.number(outward).is_none_or(|value| value.is_nan() || value < 0.0) {
                    self.single.push(outward);
                }
                let ratio = self.quadratic([low.coefficient, middle.coefficient, outward]);
                self.root(ratio, middle.degree.value - low.degree.value)
            }
            _ => return Err(Why::Roots),
        };
        Ok(gauge)
    }

    /// The gauge of a number and a term whose degree depends on the direction, which must be positive: `1 - ABS(x1)**p - ABS(x2)**p`.
    fn varying(&mut self, form: &RayForm, positive: &mut Vec<NodeId>, tamed: bool) -> Result<Gauge, Why> {
        let [low, high] = *form.terms() else { return Err(Why::Terms) };
        let (true, Some(of)) = (low.degree.is_zero(), high.degree.of) else { return Err(Why::Terms) };
        let factor = self.sums.constant(high.degree.value);
        let degree = self.sums.multiply(factor, of);
        self.must_be_positive(degree, positive);
        self.must_be_positive(low.coefficient, positive);
        let outward = self.opposite(high.coefficient);
        let outward = if tamed { self.not_negative(outward) } else { outward };
        let ratio = self.sums.divide(outward, low.coefficient);
        let one = self.sums.constant(1.0);
        let power = self.sums.divide(one, degree);
        Ok(self.sums.graph.binary(Binary::Pow, ratio, power))
    }

    fn opposite(&mut self, node: NodeId) -> NodeId {
        let minus = self.sums.neg(node);
        self.sums.tidy(minus)
    }

    fn must_be_positive(&mut self, node: NodeId, positive: &mut Vec<NodeId>) {
        if self.sums.graph.number(node).is_none_or(|value| value.is_nan() || value <= 0.0) {
            positive.push(node);
        }
    }

    /// `1/t` where `a + b t - c t^2` vanishes, for positive a and c that is not negative: `(sqrt(b^2 + 4 a c) - b) / 2 a`, without cancellation.
    fn quadratic(&mut self, [a, b, c]: [NodeId; 3]) -> NodeId {
        let square = self.sums.power(b, 2);
        let four = self.sums.constant(4.0);
        let product = self.sums.multiply(a, c);
        let product = self.sums.multiply(four, product);
        let inside = self.sums.add(square, product).unwrap_or(product);
        let graph = &mut self.sums.graph;
        let root = graph.unary(Unary::Sqrt, inside);
        let two = graph.constant(2.0);
        let far = graph.binary(Binary::Sub, root, b);
        let far = graph.binary(Binary::Div, far, a);
        let far = graph.binary(Binary::Div, far, two);
        // Where b > 0 the same number without a difference of like ones.
        let near = graph.binary(Binary::Add, root, b);
        let near = graph.binary(Binary::Div, c, near);
        let near = graph.binary(Binary::Mul, two, near);
        let zero = graph.constant(0.0);
        let falls = graph.binary(Binary::Less, zero, b);
        graph.ternary(Ternary::Select, falls, near, far)
    }

    fn root(&mut self, ratio: NodeId, gap: f64) -> NodeId {
        // An even power would hide that a ray never leaves.
        let ratio = if (1.0 / gap).rem_euclid(2.0) == 0.0 { self.not_negative(ratio) } else { ratio };
        let graph = &mut self.sums.graph;
        if (gap - 1.0).abs() < 1e-12 {
            ratio
        } else if (gap - 2.0).abs() < 1e-12 {
            graph.unary(Unary::Sqrt, ratio)
        } else if (gap - 3.0).abs() < 1e-12 {
            graph.unary(Unary::Cbrt, ratio)
        } else {
            let power = graph.constant(1.0 / gap);
            graph.binary(Binary::Pow, ratio, power)
        }
    }

    /// The part that is not negative; undefined where it is undefined.
    fn not_negative(&mut self, node: NodeId) -> NodeId {
        let minus = self.opposite(node);
        let graph = &mut self.sums.graph;
        let zero = graph.constant(0.0);
        let least = graph.binary(Binary::Min, minus, zero);
        graph.unary(Unary::Neg, least)
    }

    /// The larger, undefined where one is: the gauge of an intersection.
    fn largest(&mut self, a: NodeId, b: NodeId) -> NodeId {
        let graph = &mut self.sums.graph;
        let (a, b) = (graph.unary(Unary::Neg, a), graph.unary(Unary::Neg, b));
        let least = graph.binary(Binary::Min, a, b);
        graph.unary(Unary::Neg, least)
    }

    /// The smaller: the gauge of a union.
    fn least(&mut self, a: NodeId, b: NodeId) -> NodeId {
        self.sums.graph.binary(Binary::Min, a, b)
    }
}

/// What is to be done with a tree of set operations.
enum Step {
    /// Look at a node, or at its complement.
    Visit(Key, bool),
    /// Join the last two: their union, or their intersection.
    Join(bool),
}

fn distinct(mut nodes: Vec<NodeId>) -> Vec<NodeId> {
    nodes.sort_unstable();
    nodes.dedup();
    nodes
}

/// Whether the degrees of three terms lie at equal distances.
fn evenly(form: &RayForm) -> bool {
    let [a, b, c] = form.terms() else { return false };
    Degree::number(b.degree.value - a.degree.value).is_same(Degree::number(c.degree.value - b.degree.value))
}

/// Whether there is a formula for where a form vanishes.
fn has_root(form: &RayForm) -> bool {
    let numbers = form.terms().iter().all(|t| t.degree.of.is_none());
    numbers && (form.terms().len() <= 2 || evenly(form))
}
