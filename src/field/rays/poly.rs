//! Sums of products of a few atoms, beside the nodes that they stand for: what tells that terms cancel. An atom is any node that is no
//! sum and no product. Gives up on what is long; never changes what a node means but for rounding.

use std::collections::BTreeMap;
use std::rc::Rc;

use rustc_hash::FxHashMap;

use crate::field::{Coordinate, Graph, Node, NodeId};
use crate::number::{Algebra, Binary, Unary};

/// Products in a sum at most.
const LENGTH: usize = 48;
/// Factors in a product at most.
const FACTORS: u32 = 16;
/// Products in a sum that is written anew at most.
const TIDY: usize = 12;
/// The share of the parts of a sum below which it is the rounding of zero.
const ROUNDING: f64 = 1e-14;

/// Atoms with their powers, ascending.
type Product = Vec<(NodeId, u32)>;

/// A factor of a product, and the sum of the magnitudes that it was made of.
#[derive(Clone, Copy, Debug)]
struct Factor {
    value: f64,
    magnitude: f64,
}

impl Factor {
    fn is_zero(self) -> bool {
        self.value.abs() <= ROUNDING * self.magnitude
    }
}

/// A sum of products; empty is zero.
#[derive(Clone, Debug, Default)]
pub(super) struct Poly(BTreeMap<Product, Factor>);

impl Poly {
    fn atom(node: NodeId) -> Self {
        Self(BTreeMap::from([(vec![(node, 1)], Factor { value: 1.0, magnitude: 1.0 })]))
    }

    fn constant(value: f64) -> Self {
        Self(BTreeMap::from([(Vec::new(), Factor { value, magnitude: value.abs() })]))
    }

    fn scaled(&self, by: f64) -> Self {
        let scaled = |f: &Factor| Factor { value: f.value * by, magnitude: f.magnitude * by.abs() };
        Self(self.0.iter().map(|(product, f)| (product.clone(), scaled(f))).collect())
    }

    /// The sum, and the products that cancelled.
    fn plus(&self, other: &Self) -> Option<(Self, Vec<Product>)> {
        let mut sum = self.0.clone();
        for (product, factor) in &other.0 {
            let at = sum.entry(product.clone()).or_insert(Factor { value: 0.0, magnitude: 0.0 });
            at.value += factor.value;
            at.magnitude += factor.magnitude;
        }
        let lost = without_zeros(&mut sum);
        (sum.len() <= LENGTH).then_some((Self(sum), lost))
    }

    /// The product, and the products of atoms that cancelled in it.
    fn times(&self, other: &Self) -> Option<(Self, Vec<Product>)> {
        if self.0.len() * other.0.len() > 4 * LENGTH {
            return None;
        }
        let mut all: BTreeMap<Product, Factor> = BTreeMap::new();
        for (a, f) in &self.0 {
            for (b, g) in &other.0 {
                let at = all.entry(joined(a, b)?).or_insert(Factor { value: 0.0, magnitude: 0.0 });
                at.value += f.value * g.value;
                at.magnitude += f.magnitude * g.magnitude;
            }
        }
        let lost = without_zeros(&mut all);
        (all.len() <= LENGTH).then_some((Self(all), lost))
    }
}

/// Takes away what is zero, and tells what it was.
fn without_zeros(sum: &mut BTreeMap<Product, Factor>) -> Vec<Product> {
    let lost: Vec<Product> = sum.iter().filter(|(_, f)| f.is_zero()).map(|(product, _)| product.clone()).collect();
    lost.iter().for_each(|product| {
        sum.remove(product);
    });
    lost
}

fn joined(a: &Product, b: &Product) -> Option<Product> {
    let mut all: BTreeMap<NodeId, u32> = a.iter().copied().collect();
    b.iter().for_each(|(atom, power)| *all.entry(*atom).or_default() += power);
    (all.values().sum::<u32>() <= FACTORS).then(|| all.into_iter().collect())
}

/// A graph whose sums and products are also known as [`Poly`].
#[derive(Debug, Default)]
pub(super) struct Sums {
    pub(super) graph: Graph,
    /// `None`: too long.
    known: FxHashMap<NodeId, Option<Rc<Poly>>>,
    /// What fell away because it cancels or is multiplied by zero, and might be undefined somewhere.
    pub(super) lost: Vec<NodeId>,
}

impl Sums {
    fn poly(&self, node: NodeId) -> Option<Rc<Poly>> {
        match self.known.get(&node) {
            Some(known) => known.clone(),
            None => Some(Rc::new(match self.graph.number(node) {
                Some(value) if value.is_finite() => Poly::constant(value),
                Some(_) => return None,
                None => Poly::atom(node),
            })),
        }
    }

    fn keep(&mut self, node: NodeId, poly: Option<Poly>) -> NodeId {
        self.known.entry(node).or_insert_with(|| poly.map(Rc::new));
        node
    }

    pub(super) fn constant(&mut self, value: f64) -> NodeId {
        self.graph.constant(value)
    }

    pub(super) fn neg(&mut self, a: NodeId) -> NodeId {
        let poly = self.poly(a).map(|p| p.scaled(-1.0));
        let node = self.graph.unary(Unary::Neg, a);
        self.keep(node, poly)
    }

    /// Remembers the atoms of products that cancelled, coordinates apart: they must be finite for the rest to be right.
    fn lose(&mut self, lost: &[Product]) {
        for &(atom, _) in lost.iter().flatten() {
            if !matches!(self.graph.node(atom), Node::Coordinate(_)) {
                self.lost.push(atom);
            }
        }
    }

    /// A coefficient that is used no more.
    pub(super) fn drop_coefficient(&mut self, node: NodeId) {
        if !self.is_total(node) {
            self.lost.push(node);
        }
    }

    /// The sum, or `None` where it is zero because all of it cancels.
    pub(super) fn add(&mut self, a: NodeId, b: NodeId) -> Option<NodeId> {
        let both = self.poly(a).zip(self.poly(b));
        let sum = both.and_then(|(p, q)| p.plus(&q));
        if let Some((_, lost)) = &sum {
            self.lose(lost);
        }
        match sum {
            Some((sum, _)) if sum.0.is_empty() => None,
            Some((sum, lost)) if !lost.is_empty() => Some(self.written(&sum)),
            other => {
                let node = self.graph.binary(Binary::Add, a, b);
                Some(self.keep(node, other.map(|(sum, _)| sum)))
            }
        }
    }

    pub(super) fn multiply(&mut self, a: NodeId, b: NodeId) -> NodeId {
        let both = self.poly(a).zip(self.poly(b));
        let node = self.graph.binary(Binary::Mul, a, b);
        let product = both.and_then(|(p, q)| p.times(&q));
        if let Some((_, lost)) = &product {
            self.lose(lost);
        }
        self.keep(node, product.map(|(product, _)| product))
    }

    pub(super) fn divide(&mut self, a: NodeId, b: NodeId) -> NodeId {
        let node = self.graph.binary(Binary::Div, a, b);
        match self.graph.number(b) {
            Some(by) if by != 0.0 => {
                let poly = self.poly(a).map(|p| p.scaled(1.0 / by));
                self.keep(node, poly)
            }
            _ => node,
        }
    }

    pub(super) fn power(&mut self, a: NodeId, n: i32) -> NodeId {
        let node = self.graph.unary(Unary::Powi(n), a);
        let poly = match (self.poly(a), u32::try_from(n)) {
            (Some(poly), Ok(n @ 1..=8)) => {
                let mut power = Some((*poly).clone());
                for _ in 1..n {
                    let next = power.and_then(|power| power.times(&poly));
                    if let Some((_, lost)) = &next {
                        self.lose(lost);
                    }
                    power = next.map(|(power, _)| power);
                }
                power
            }
            // A high power of something is an atom, as long as it is not a number.
            _ => return node,
        };
        self.keep(node, poly)
    }

    /// The same value in fewer operations, if its sum of products is known and takes fewer.
    pub(super) fn tidy(&mut self, node: NodeId) -> NodeId {
        let Some(poly) = self.poly(node).filter(|poly| poly.0.len() <= TIDY) else { return node };
        if poly.0.is_empty() {
            return node;
        }
        let other = self.written(&poly);
        let count = |sums: &Self, node| crate::field::operations(&sums.graph, node);
        if count(self, other) < count(self, node) { other } else { node }
    }

    /// Whether the value is finite wherever the coordinates are.
    pub(super) fn is_total(&self, node: NodeId) -> bool {
        let is_coordinate = |atom: &NodeId| matches!(self.graph.node(*atom), Node::Coordinate(_));
        self.poly(node).is_some_and(|poly| poly.0.keys().flatten().all(|(atom, _)| is_coordinate(atom)))
    }

    /// The factors of the products of coordinates in a node that is a polynomial of these with numbers, each product as its coordinates.
    pub(super) fn polynomial(&self, node: NodeId, axes: &[Coordinate]) -> Option<Vec<(Vec<usize>, f64)>> {
        let axis = |atom: NodeId| match self.graph.node(atom) {
            Node::Coordinate(c) => axes.iter().position(|axis| axis == c),
            _ => None,
        };
        let product = |product: &Product| -> Option<Vec<usize>> {
            let each = product.iter().map(|(atom, power)| Some(vec![axis(*atom)?; *power as usize]));
            Some(each.collect::<Option<Vec<_>>>()?.concat())
        };
        self.poly(node)?.0.iter().map(|(p, factor)| Some((product(p)?, factor.value))).collect()
    }

    /// The sum as an expression.
    fn written(&mut self, poly: &Poly) -> NodeId {
        // What is added first, then what is taken away, and the number that stands alone as the last, as one would write it.
        let mut ordered: Vec<(&Product, f64)> = poly.0.iter().map(|(p, factor)| (p, factor.value)).collect();
        ordered.sort_by_key(|(p, factor)| (p.is_empty(), *factor < 0.0));
        let mut sum: Option<NodeId> = None;
        for (product, factor) in ordered {
            let mut node: Option<NodeId> = None;
            for (atom, power) in product {
                let power = self.graph.unary(Unary::Powi(i32::try_from(*power).unwrap_or(1)), *atom);
                node = Some(node.map_or(power, |node| self.graph.binary(Binary::Mul, node, power)));
            }
            let size = self.graph.constant(factor.abs());
            let node = match node {
                Some(node) => self.graph.binary(Binary::Mul, node, size),
                None => size,
            };
            sum = Some(match (sum, factor < 0.0) {
                (None, false) => node,
                (None, true) => self.graph.unary(Unary::Neg, node),
                (Some(sum), false) => self.graph.binary(Binary::Add, sum, node),
                (Some(sum), true) => self.graph.binary(Binary::Sub, sum, node),
            });
        }
        let node = sum.unwrap_or_else(|| self.graph.constant(0.0));
        self.keep(node, Some(poly.clone()))
    }
}
