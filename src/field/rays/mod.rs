//! What a function looks like along rays from a centre: its ray form, worked out from the expression itself \[A92\]. Maps are seen through,
//! not expanded. Symbolic alone: whether a coefficient is positive in every direction is for others to prove.

mod centre;
mod form;
mod poly;
mod rules;
mod star;

use rustc_hash::FxHashMap;

use super::graph::{Coordinate, Graph, Node, NodeId};
pub use centre::centres;
pub use form::{Degree, RayForm, TERMS, Term};
use poly::Sums;
use rules::Rules;
pub use rules::Why;
pub use star::Star;

/// The part of an expression that breaks the ray form: a node of the expression's graph, and why.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Broken {
    /// The node.
    pub node: NodeId,
    /// Why.
    pub why: Why,
}

/// A form, or the first part that has none.
pub type Found = Result<RayForm, Broken>;

/// Which mapping a node is seen through; 0 is none.
type View = u32;
/// A node seen through a mapping.
type Key = (NodeId, View);

/// What coordinates stand for behind a map.
#[derive(Debug)]
struct Mapped {
    of: Vec<(Coordinate, NodeId)>,
    outer: View,
}

/// The analysis of one expression about one centre.
#[derive(Debug)]
pub struct Rays<'g> {
    source: &'g Graph,
    axes: Vec<Coordinate>,
    centre: Vec<f64>,
    sums: Sums,
    views: Vec<Mapped>,
    numbers: FxHashMap<Key, View>,
    forms: FxHashMap<Key, Found>,
    order: Vec<Key>,
    limit: usize,
    /// What must not be negative for a ray to leave the shape once.
    single: Vec<NodeId>,
}

impl<'g> Rays<'g> {
    /// An analysis of functions of a graph about a centre: one number for each axis. Coordinates that are no axes are parameters, the
    /// same everywhere. At most `limit` nodes are looked at.
    #[must_use]
    pub fn new(source: &'g Graph, axes: &[Coordinate], centre: &[f64], limit: usize) -> Self {
        let identity = Mapped { of: Vec::new(), outer: 0 };
        Self {
            source,
            axes: axes.to_vec(),
            centre: centre.to_vec(),
            sums: Sums::default(),
            views: vec![identity],
            numbers: FxHashMap::default(),
            forms: FxHashMap::default(),
            order: Vec::new(),
            limit,
            single: Vec::new(),
        }
    }

    /// The graph of the coefficients. Where a coordinate is an axis it is there a component of the direction.
    #[must_use]
    pub fn graph(&self) -> &Graph {
        &self.sums.graph
    }

    /// The centre.
    #[must_use]
    pub fn centre(&self) -> &[f64] {
        &self.centre
    }

    /// The ray form of a function.
    ///
    /// # Errors
    /// The first part, in the order of the operands, that has no ray form.
    pub fn form(&mut self, root: NodeId) -> Found {
        let form = self.find((root, 0))?;
        Ok(self.sums.tidied(&form))
    }

    fn find(&mut self, root: Key) -> Found {
        let mut open = vec![root];
        while let Some(&key) = open.last() {
            if self.forms.contains_key(&key) {
                open.pop();
                continue;
            }
            if self.forms.len() >= self.limit {
                return Err(Broken { node: root.0, why: Why::Size });
            }
            if let Some(found) = self.visit(key, &mut open) {
                self.forms.insert(key, found);
                self.order.push(key);
                open.pop();
            }
        }
        self.forms[&root].clone()
    }

    /// The form of a node, if those of all that it reads are known; else puts what is missing on the list.
    fn visit(&mut self, key: Key, open: &mut Vec<Key>) -> Option<Found> {
        let (node, view) = key;
        let rule = self.source.node(node);
        let before = open.len();
        match rule {
            Node::Coordinate(c) => return self.coordinate(*c, view, open),
            Node::Map(body, mapping) => {
                let inner = self.through(key, mapping);
                let body = (*body, inner);
                return match self.forms.get(&body) {
                    Some(found) => Some(found.clone()),
                    None => {
                        open.push(body);
                        None
                    }
                };
            }
            plain => plain.for_each_operand(|e| {
                if !self.forms.contains_key(&(e, view)) {
                    open.push((e, view));
                }
            }),
        }
        if open.len() > before {
            // The first operand first, so that its fault is found first.
            open[before..].reverse();
            return None;
        }
        let mut operands = Vec::new();
        let mut fault = None;
        rule.for_each_operand(|e| match &self.forms[&(e, view)] {
            Ok(form) => operands.push(form.clone()),
            Err(broken) => fault = fault.or(Some(*broken)),
        });
        if let Some(broken) = fault {
            return Some(Err(broken));
        }
        let made = match rule {
            Node::Constant(value) => Ok(match value.get() {
                0.0 => RayForm::zero(),
                value => RayForm::one(Degree::ZERO, self.sums.constant(value)),
            }),
            rule => Rules { sums: &mut self.sums }.of(rule, &operands),
        };
        Some(made.map_err(|why| Broken { node, why }))
    }

    /// The view behind a map.
    fn through(&mut self, key: Key, mapping: &[(Coordinate, NodeId)]) -> View {
        let next = self.views.len() as View;
        let number = *self.numbers.entry(key).or_insert(next);
        if number == next {
            self.views.push(Mapped { of: mapping.to_vec(), outer: key.1 });
        }
        number
    }

    /// What a coordinate is, seen through a mapping: that of the nearest one that replaces it.
    fn coordinate(&mut self, c: Coordinate, view: View, open: &mut Vec<Key>) -> Option<Found> {
        let mut at = view;
        while at != 0 {
            let Mapped { of, outer } = &self.views[at as usize];
            if let Some((_, node)) = of.iter().find(|(mapped, _)| *mapped == c) {
                let key = (*node, *outer);
                if !self.forms.contains_key(&key) {
                    open.push(key);
                }
                return self.forms.get(&key).cloned();
            }
            at = *outer;
        }
        let node = self.sums.graph.coordinate(c);
        let Some(axis) = self.axes.iter().position(|axis| *axis == c) else {
            return Some(Ok(RayForm::one(Degree::ZERO, node)));
        };
        let mut terms = vec![Term { degree: Degree::number(1.0), coefficient: node }];
        if self.centre[axis] != 0.0 {
            terms.push(Term { degree: Degree::ZERO, coefficient: self.sums.constant(self.centre[axis]) });
        }
        Some(Ok(RayForm::new(terms)))
    }
}
