//! The slow, obvious walk over the graph, for any kind of number: what every compiled evaluator must agree with. Shares nothing with
//! the compiler; a map evaluates its body at the mapped point. Never recurses.

pub mod region;

use rustc_hash::FxHashMap;

use crate::field::{Coordinate, Graph, Node, NodeId, Region};
use crate::number::{Algebra, Dual, Duals, Interval, Intervals, Leaf, Reals};

/// Kinds of number at which data can be asked too.
pub trait Meaning: Algebra {
    /// The leaf at these arguments.
    fn leaf(&mut self, leaf: &dyn Leaf, arguments: &[Self::Number]) -> Self::Number;

    /// The outputs of a region for these arguments.
    fn region(&mut self, region: &Region, arguments: &[Self::Number]) -> Vec<Self::Number>;
}

impl Meaning for Reals {
    fn leaf(&mut self, leaf: &dyn Leaf, arguments: &[f64]) -> f64 {
        leaf.value(arguments)
    }
    fn region(&mut self, region: &Region, arguments: &[f64]) -> Vec<f64> {
        region::at_a_point(self, region, arguments, |v| *v, |v, _, _| v)
    }
}

impl Meaning for Intervals {
    fn leaf(&mut self, leaf: &dyn Leaf, arguments: &[Interval]) -> Interval {
        leaf.bounds(arguments)
    }
    fn region(&mut self, region: &Region, arguments: &[Interval]) -> Vec<Interval> {
        region::over_a_box(region, arguments)
    }
}

impl<const N: usize> Meaning for Duals<N> {
    fn leaf(&mut self, leaf: &dyn Leaf, arguments: &[Dual<N>]) -> Dual<N> {
        leaf_dual(leaf, arguments)
    }
    fn region(&mut self, region: &Region, arguments: &[Dual<N>]) -> Vec<Dual<N>> {
        let moving = |value: f64, with: &Dual<N>, by: f64| Dual {
            value,
            slope: with.slope.map(|s| crate::number::dual::times(by, s)),
        };
        region::at_a_point(self, region, arguments, |d| d.value, moving)
    }
}

/// The chain rule at a leaf.
pub(crate) fn leaf_dual<const N: usize>(leaf: &dyn Leaf, arguments: &[Dual<N>]) -> Dual<N> {
    let (mut at, mut by) = ([0.0; 4], [0.0; 4]);
    at.iter_mut().zip(arguments).for_each(|(to, from)| *to = from.value);
    let value = leaf.gradient(&at[..arguments.len()], &mut by[..arguments.len()]);
    let slope = std::array::from_fn(|k| {
        arguments.iter().zip(by).fold(0.0, |sum, (a, d)| sum + crate::number::dual::times(d, a.slope[k]))
    });
    Dual { value, slope }
}

/// A point: one number per coordinate, undefined (`None`) where none was given.
type Point<N> = Vec<Option<N>>;

/// The value at `root` where each coordinate has the number that `point` lists. A coordinate that is not listed is undefined (NaN).
pub fn eval<M: Meaning>(meaning: &mut M, graph: &Graph, root: NodeId, point: &[(Coordinate, M::Number)]) -> M::Number {
    eval_all(meaning, graph, &[root], point).remove(0)
}

/// The values at several roots.
fn eval_all<M: Meaning>(
    meaning: &mut M,
    graph: &Graph,
    roots: &[NodeId],
    point: &[(Coordinate, M::Number)],
) -> Vec<M::Number> {
    let mut first: Point<M::Number> = vec![None; Coordinate::MOST + 1];
    for (c, number) in point {
        first[usize::from(c.0)] = Some(number.clone());
    }
    let mut walk =
        Walk { meaning, graph, points: vec![first], mapped: FxHashMap::default(), values: FxHashMap::default() };
    let mut open: Vec<Key> = roots.iter().map(|root| (*root, 0)).collect();
    while let Some(&key) = open.last() {
        if walk.values.contains_key(&key) {
            open.pop();
            continue;
        }
        let missing = walk.missing(key);
        if missing.is_empty() {
            walk.compute(key);
        } else {
            open.extend(missing);
        }
    }
    roots.iter().map(|root| walk.values[&(*root, 0)].clone()).collect()
}

/// A node and the number of the point at which it is evaluated.
type Key = (NodeId, usize);

struct Walk<'a, M: Meaning> {
    meaning: &'a mut M,
    graph: &'a Graph,
    points: Vec<Point<M::Number>>,
    /// The mapped point of each map.
    mapped: FxHashMap<Key, usize>,
    values: FxHashMap<Key, M::Number>,
}

impl<M: Meaning> Walk<'_, M> {
    /// What must be evaluated before `key` can be: the operands, or of a map the mapping and then the body.
    fn missing(&mut self, (node, at): Key) -> Vec<Key> {
        let mut needed = Vec::new();
        match self.graph.node(node) {
            Node::Map(body, mapping) => {
                needed.extend(mapping.iter().map(|(_, e)| (*e, at)).filter(|key| !self.values.contains_key(key)));
                if needed.is_empty() {
                    let inner = self.mapped_point((node, at));
                    needed.extend(Some((*body, inner)).filter(|key| !self.values.contains_key(key)));
                }
            }
            plain => plain.for_each_operand(|e| {
                if !self.values.contains_key(&(e, at)) {
                    needed.push((e, at));
                }
            }),
        }
        needed
    }

    fn mapped_point(&mut self, key: Key) -> usize {
        if let Some(&known) = self.mapped.get(&key) {
            return known;
        }
        let mut inner = self.points[key.1].clone();
        if let Node::Map(_, mapping) = self.graph.node(key.0) {
            for (c, e) in mapping.iter() {
                inner[usize::from(c.0)] = Some(self.values[&(*e, key.1)].clone());
            }
        }
        self.points.push(inner);
        self.mapped.insert(key, self.points.len() - 1);
        self.points.len() - 1
    }

    fn compute(&mut self, key: Key) {
        let (node, at) = key;
        let operand = |walk: &Self, e: NodeId| walk.values[&(e, at)].clone();
        let value = match self.graph.node(node) {
            Node::Constant(c) => self.meaning.constant(c.get()),
            Node::Coordinate(c) => match self.points[at][usize::from(c.0)].clone() {
                Some(number) => number,
                None => self.meaning.constant(f64::NAN),
            },
            Node::Unary(op, a) => {
                let a = operand(self, *a);
                self.meaning.unary(*op, a)
            }
            Node::Binary(op, a, b) => {
                let (a, b) = (operand(self, *a), operand(self, *b));
                self.meaning.binary(*op, a, b)
            }
            Node::Ternary(op, [a, b, c]) => {
                let (a, b, c) = (operand(self, *a), operand(self, *b), operand(self, *c));
                self.meaning.ternary(*op, a, b, c)
            }
            Node::Leaf(leaf, arguments) => {
                let arguments: Vec<M::Number> = arguments.iter().map(|e| operand(self, *e)).collect();
                self.meaning.leaf(&*leaf.0, &arguments)
            }
            Node::Region(region, output, arguments) => {
                let arguments: Vec<M::Number> = arguments.iter().map(|e| operand(self, *e)).collect();
                self.meaning.region(&region.0, &arguments)[*output as usize].clone()
            }
            Node::Map(body, _) => self.values[&(*body, self.mapped[&key])].clone(),
        };
        self.values.insert(key, value);
    }
}
