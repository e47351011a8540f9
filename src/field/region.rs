//! Regions: what binds variables of its own. A loop that runs at each point, the highest value over a section, the highest value over a
//! ball. Each is a closed function with a graph of its own, whose coordinates are its parameters, so that nothing can be captured by
//! accident: `AT` replaces its arguments and never looks inside.

use std::hash::{Hash, Hasher};
use std::sync::Arc;

use super::derivative::derivative;
use super::expand::{TooLarge, expand, reachable_all};
use super::graph::{Coordinate, Coordinates, Graph, Node, NodeId};
use crate::number::{Binary, Interval, Real, Ternary, Unary};
use crate::reuse::Digest;

/// Regions within regions, at most so many levels.
pub const DEPTH: u8 = 4;

/// Parameters of a region at most. Its derivative has twice as many.
const PARAMETERS: usize = Coordinate::MOST / 2;
/// Parameters up to which what does not change inside is computed outside; else only the coordinates are read from there.
const COMPUTED_OUTSIDE: usize = Coordinate::MOST / 4;

/// A closed function of its parameters, that is of the coordinates x1, x2, ... of its own graph.
#[derive(Debug)]
pub struct Region {
    graph: Graph,
    form: Form,
    depth: u8,
    hash: u128,
}

/// What a region does with its parameters.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Form {
    /// The first `next.len()` parameters are variables, which start from the arguments of the same number. While the condition is true
    /// each takes its next value, all at once; the outputs are their values when it no longer is. Beyond the limit of turns all
    /// are undefined.
    Loop {
        /// Whether there is another turn.
        condition: NodeId,
        /// The next value of each variable.
        next: Arc<[NodeId]>,
        /// The parts of the condition, which all must hold.
        guards: Arc<[Guard]>,
    },
    /// The highest value of `body` where the first parameter goes from the first argument to the second; the parameters from the second
    /// on are the arguments from the third on. Output 0 is that value, output 1 where it is. Undefined values count as lowest; from
    /// a larger to a smaller number there is none.
    Section {
        /// The function.
        body: NodeId,
        /// Its derivative by the first parameter.
        slope: NodeId,
        /// Whether it is continuous in it wherever it is defined.
        continuous: bool,
    },
    /// The highest value of `body` in the closed ball about the first `dimension` arguments; the argument behind them is the radius, those
    /// that follow are the parameters that do not move. Output 0 is that value, the others are the steps to where it is.
    Ball {
        /// The function.
        body: NodeId,
        /// The number of parameters that move.
        dimension: usize,
    },
}

/// A part of the condition of a loop.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Guard {
    /// Whether it holds.
    pub holds: NodeId,
    /// If it compares a variable with a number: what is known where it fails.
    pub bound: Option<Bound>,
}

/// What is known of a variable: it lies between two numbers, or is undefined.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Bound {
    /// Its place among the variables.
    pub variable: usize,
    /// The least number.
    pub lo: Real,
    /// The largest number.
    pub hi: Real,
}

impl Bound {
    /// The variable and its range.
    #[must_use]
    pub fn within(self) -> (usize, Interval) {
        (self.variable, Interval::new(self.lo.get(), self.hi.get()))
    }
}

/// The parts of a condition that must all hold, the first `variables` parameters being what may be bounded.
fn guards(graph: &Graph, condition: NodeId, variables: usize) -> Arc<[Guard]> {
    let mut open = vec![condition];
    let mut found = Vec::new();
    while let Some(holds) = open.pop() {
        if let Node::Binary(Binary::And, a, b) = graph.node(holds) {
            open.extend([*b, *a]);
        } else {
            found.push(Guard { holds, bound: fails(graph, holds, variables) });
        }
    }
    found.into()
}

/// What is known where a comparison of a variable with a number fails.
fn fails(graph: &Graph, holds: NodeId, variables: usize) -> Option<Bound> {
    let Node::Binary(op @ (Binary::Less | Binary::LessEqual), a, b) = graph.node(holds) else { return None };
    let variable = |id: NodeId| match graph.node(id) {
        Node::Coordinate(c) => Some(usize::from(c.0) - 1).filter(|i| *i < variables),
        _ => None,
    };
    let strict = *op == Binary::LessEqual;
    let bound = |variable, lo, hi| Some(Bound { variable, lo: Real::new(lo), hi: Real::new(hi) });
    match (variable(*a), graph.number(*b), graph.number(*a), variable(*b)) {
        (Some(i), Some(least), ..) => bound(i, if strict { least.next_up() } else { least }, f64::INFINITY),
        (_, _, Some(most), Some(i)) => bound(i, f64::NEG_INFINITY, if strict { most.next_down() } else { most }),
        _ => None,
    }
}

impl Form {
    /// The nodes whose values the region asks for.
    #[must_use]
    pub fn roots(&self) -> Vec<NodeId> {
        match self {
            Self::Loop { condition, next, guards } => {
                let guards = guards.iter().map(|guard| guard.holds);
                std::iter::once(*condition).chain(next.iter().copied()).chain(guards).collect()
            }
            Self::Section { body, slope, .. } => vec![*body, *slope],
            Self::Ball { body, .. } => vec![*body],
        }
    }
}

impl Region {
    /// A region over a graph without maps.
    #[must_use]
    pub fn shared(graph: Graph, form: Form) -> SharedRegion {
        let inner = graph.nodes().iter().filter_map(|node| match node {
            Node::Region(region, ..) => Some(region.0.depth),
            _ => None,
        });
        let depth = inner.max().unwrap_or(0).saturating_add(1);
        let mut digest = Digest::of("region");
        graph.nodes().hash(&mut digest);
        form.hash(&mut digest);
        SharedRegion(Arc::new(Self { hash: digest.key().bits(), graph, form, depth }))
    }

    /// A hash of all that it is.
    #[must_use]
    pub fn fingerprint(&self) -> u128 {
        self.hash
    }

    /// Its graph, without maps.
    #[must_use]
    pub fn graph(&self) -> &Graph {
        &self.graph
    }

    /// What it does.
    #[must_use]
    pub fn form(&self) -> &Form {
        &self.form
    }

    /// The number of its outputs.
    #[must_use]
    pub fn outputs(&self) -> usize {
        match &self.form {
            Form::Loop { next, .. } => next.len(),
            Form::Section { .. } => 2,
            Form::Ball { dimension, .. } => dimension + 1,
        }
    }
}

/// A region that many nodes share; equal to another with equal content.
#[derive(Clone, Debug)]
pub struct SharedRegion(pub Arc<Region>);

impl PartialEq for SharedRegion {
    fn eq(&self, other: &Self) -> bool {
        let (a, b) = (&*self.0, &*other.0);
        Arc::ptr_eq(&self.0, &other.0) || (a.hash == b.hash && a.form == b.form && a.graph.nodes() == b.graph.nodes())
    }
}
impl Eq for SharedRegion {}
impl Hash for SharedRegion {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.0.hash.hash(state);
    }
}

/// Why something cannot be made a region.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refused {
    /// It would have more nodes than allowed.
    TooLarge(usize),
    /// It has too many variables, or reads too many values from outside.
    TooMany,
    /// Regions lie within each other, too many levels deep.
    TooDeep,
}

impl From<TooLarge> for Refused {
    fn from(error: TooLarge) -> Self {
        Self::TooLarge(error.limit)
    }
}

/// Roots cut out of a graph: parameters first, then what was read from outside.
struct Cut {
    graph: Graph,
    roots: Vec<NodeId>,
    /// Nodes of the graph that it was cut from.
    captured: Vec<NodeId>,
}

/// Cuts roots out of a graph as functions of the variables: the variables become the first parameters. What does not depend on them is
/// computed outside and becomes a parameter as a whole.
fn cut(graph: &mut Graph, roots: &[NodeId], variables: &[Coordinate], limit: usize) -> Result<Cut, Refused> {
    match cut_by(graph, roots, variables, limit, true)? {
        cut if variables.len() + cut.captured.len() <= COMPUTED_OUTSIDE => Ok(cut),
        _ => {
            let cut = cut_by(graph, roots, variables, limit, false)?;
            if variables.len() + cut.captured.len() > PARAMETERS { Err(Refused::TooMany) } else { Ok(cut) }
        }
    }
}

/// The same; what does not depend on the variables is computed outside only if so wished.
fn cut_by(
    graph: &mut Graph,
    roots: &[NodeId],
    variables: &[Coordinate],
    limit: usize,
    computed_outside: bool,
) -> Result<Cut, Refused> {
    let expanded = expand(graph, roots, limit)?;
    let (source, roots) = match &expanded {
        Some((source, roots)) => (source, roots.clone()),
        None => (&*graph, roots.to_vec()),
    };
    let moving = variables.iter().fold(Coordinates::default(), |all, c| all.union(Coordinates::one(*c)));
    let depends = |id: NodeId| match source.node(id) {
        Node::Coordinate(c) => moving.contains(*c),
        _ if computed_outside => source.coordinates(id).meets(moving),
        _ => !source.coordinates(id).is_empty(),
    };
    let reached = reachable_all(source, &roots);
    if reached.iter().filter(|r| **r).count() > limit {
        return Err(Refused::TooLarge(limit));
    }
    // What is read from outside: the operands of what depends on a variable, and roots.
    let mut outside = vec![false; reached.len()];
    let mut note = |id: NodeId| outside[id.index()] |= source.number(id).is_none() && !depends(id);
    roots.iter().for_each(|id| note(*id));
    let all = (0u32..).map(NodeId).take(reached.len()).filter(|id| reached[id.index()]);
    all.clone().filter(|id| depends(*id)).for_each(|id| source.node(id).for_each_operand(&mut note));
    let captured: Vec<NodeId> = all.clone().filter(|id| outside[id.index()]).collect();
    if variables.len() + captured.len() > PARAMETERS {
        // Too many to be parameters: the caller sees it by their number.
        return Ok(Cut { graph: Graph::new(), roots: Vec::new(), captured });
    }
    let mut inner = Graph::new();
    let parameters: Vec<NodeId> =
        (1..).take(variables.len() + captured.len()).map(|i| inner.coordinate(Coordinate(i))).collect();
    let mut copies: Vec<Option<NodeId>> = vec![None; reached.len()];
    captured.iter().zip(&parameters[variables.len()..]).for_each(|(id, p)| copies[id.index()] = Some(*p));
    for id in all.filter(|id| depends(*id) || source.number(*id).is_some()) {
        let copy = match source.node(id) {
            Node::Coordinate(c) => {
                let place = variables.iter().position(|v| v == c);
                parameters[place.unwrap_or(0)]
            }
            node => inner.rebuilt(node, |e| copies[e.index()].unwrap_or(e)),
        };
        copies[id.index()] = Some(copy);
    }
    let roots = roots.iter().map(|id| copies[id.index()].unwrap_or(*id)).collect();
    let captured = match expanded {
        Some((source, _)) => import(graph, &source, &captured, &[]),
        None => captured,
    };
    Ok(Cut { graph: inner, roots, captured })
}

/// Copies roots from one graph into another, coordinate i replaced by `parameters[i - 1]`; those beyond the list stay.
pub fn import(target: &mut Graph, source: &Graph, roots: &[NodeId], parameters: &[NodeId]) -> Vec<NodeId> {
    let reached = reachable_all(source, roots);
    let mut copies: Vec<Option<NodeId>> = vec![None; reached.len()];
    for id in (0u32..).map(NodeId).take(reached.len()).filter(|id| reached[id.index()]) {
        let copy = match source.node(id) {
            Node::Coordinate(c) => match parameters.get(usize::from(c.0) - 1) {
                Some(parameter) => *parameter,
                None => target.coordinate(*c),
            },
            node => target.rebuilt(node, |e| copies[e.index()].unwrap_or(e)),
        };
        copies[id.index()] = Some(copy);
    }
    roots.iter().map(|id| copies[id.index()].unwrap_or(*id)).collect()
}

impl Graph {
    /// A node for each output of a region.
    fn outputs_of(&mut self, region: &SharedRegion, arguments: &Arc<[NodeId]>) -> Vec<NodeId> {
        let count = u32::try_from(region.0.outputs()).unwrap_or(0);
        (0..count).map(|output| self.intern(Node::Region(region.clone(), output, arguments.clone()))).collect()
    }

    /// A loop that runs at each point: while the condition is true, each variable takes its next value, all at once. Variables are
    /// coordinates that nothing else uses, each with its first value. The nodes of their last values.
    ///
    /// # Errors
    /// [`Refused`] if it is too large, too wide or too deep.
    pub fn repeat(
        &mut self,
        condition: NodeId,
        variables: &[(Coordinate, NodeId, NodeId)],
        limit: usize,
    ) -> Result<Vec<NodeId>, Refused> {
        let roots: Vec<NodeId> = std::iter::once(condition).chain(variables.iter().map(|v| v.2)).collect();
        let names: Vec<Coordinate> = variables.iter().map(|v| v.0).collect();
        let cut = cut(self, &roots, &names, limit)?;
        let guards = guards(&cut.graph, cut.roots[0], variables.len());
        let form = Form::Loop { condition: cut.roots[0], next: cut.roots[1..].into(), guards };
        let region = shallow(Region::shared(cut.graph, form))?;
        let arguments = variables.iter().map(|v| v.1).chain(cut.captured).collect();
        Ok(self.outputs_of(&region, &arguments))
    }

    /// The highest value of `body` where a coordinate goes from `lo` to `hi`, which are free of it only by chance: their own
    /// coordinate is that outside.
    ///
    /// # Errors
    /// [`Refused`] if it is too large, too wide or too deep.
    pub fn section(
        &mut self,
        body: NodeId,
        over: Coordinate,
        (lo, hi): (NodeId, NodeId),
        limit: usize,
    ) -> Result<NodeId, Refused> {
        let mut cut = cut(self, &[body], &[over], limit)?;
        let body = cut.roots[0];
        let slope = derivative(&mut cut.graph, body, Coordinate(1));
        let continuous = is_continuous(&cut.graph, body);
        let region = shallow(Region::shared(cut.graph, Form::Section { body, slope, continuous }))?;
        let arguments: Arc<[NodeId]> = [lo, hi].into_iter().chain(cut.captured).collect();
        Ok(self.outputs_of(&region, &arguments)[0])
    }

    /// The highest value of `body` in the closed ball of that radius about the point, in these coordinates.
    ///
    /// # Errors
    /// [`Refused`] if it is too large, too wide or too deep.
    pub fn ball(&mut self, body: NodeId, over: &[Coordinate], radius: NodeId, limit: usize) -> Result<NodeId, Refused> {
        let cut = cut(self, &[body], over, limit)?;
        let form = Form::Ball { body: cut.roots[0], dimension: over.len() };
        let region = shallow(Region::shared(cut.graph, form))?;
        let centre: Vec<NodeId> = over.iter().map(|c| self.coordinate(*c)).collect();
        let arguments: Arc<[NodeId]> = centre.into_iter().chain([radius]).chain(cut.captured).collect();
        Ok(self.outputs_of(&region, &arguments)[0])
    }
}

fn shallow(region: SharedRegion) -> Result<SharedRegion, Refused> {
    if region.0.depth > DEPTH { Err(Refused::TooDeep) } else { Ok(region) }
}

/// Whether the value is continuous in the first parameter wherever it is defined and finite. May say no of what is.
///
/// A maximum leaves an undefined operand aside and so may jump where that one begins: its operands must be defined everywhere.
fn is_continuous(graph: &Graph, root: NodeId) -> bool {
    is_continuous_in(graph, root, Coordinates::one(Coordinate(1)))
}

fn is_continuous_in(graph: &Graph, root: NodeId, by: Coordinates) -> bool {
    use Binary::{Add, Div, Hypot, Max, Min, Mul, Pow, Sub};
    let reached = reachable_all(graph, &[root]);
    let mut total = vec![false; reached.len()];
    for id in (0u32..).map(NodeId).take(reached.len()).filter(|id| reached[id.index()]) {
        let node = graph.node(id);
        let mut operands = true;
        node.for_each_operand(|e| operands &= total[e.index()]);
        let continuous = match node {
            Node::Unary(op, _) => !matches!(op, Unary::Floor | Unary::Ceil | Unary::Round | Unary::Sign | Unary::Not),
            Node::Binary(Max, ..) | Node::Ternary(Ternary::Union | Ternary::UnionSmooth, _) => operands,
            Node::Binary(op, ..) => matches!(op, Add | Sub | Mul | Div | Min | Pow | Hypot),
            // A parameter that passes 0 jumps there.
            Node::Ternary(Ternary::Norm, [_, _, p]) => graph.number(*p).is_some(),
            Node::Ternary(op, _) => *op != Ternary::Select,
            Node::Constant(_) | Node::Coordinate(_) => true,
            // The highest value of what is continuous in all its parameters moves continuously with them.
            Node::Region(region, 0, _) => match *region.0.form() {
                Form::Section { body, .. } | Form::Ball { body, .. } => {
                    is_continuous_in(region.0.graph(), body, Coordinates(u128::MAX))
                }
                Form::Loop { .. } => false,
            },
            Node::Leaf(..) | Node::Region(..) | Node::Map(..) => false,
        };
        if !continuous && graph.coordinates(id).meets(by) {
            return false;
        }
        let by_zero =
            matches!(node, Node::Ternary(Ternary::Norm, [_, _, p]) if graph.number(*p).is_none_or(|p| p == 0.0));
        total[id.index()] = operands && !by_zero && is_total(node);
    }
    true
}

/// Whether an operation is defined and finite for all finite operands that do not overflow.
fn is_total(node: &Node) -> bool {
    match node {
        Node::Constant(c) => c.get().is_finite(),
        Node::Coordinate(_) => true,
        Node::Unary(op, _) => {
            use Unary::{Acos, Acosh, Asin, Atanh, Log, Log10, Powi, Sqrt, Tan};
            !matches!(op, Sqrt | Log | Log10 | Asin | Acos | Acosh | Atanh | Tan | Powi(i32::MIN..0))
        }
        Node::Binary(op, ..) => !matches!(op, Binary::Div | Binary::Pow | Binary::Mod),
        Node::Ternary(..) => true,
        Node::Leaf(..) | Node::Region(..) | Node::Map(..) => false,
    }
}
