//! Derivatives of regions. Of a loop: the same loop with the derivatives of its variables alongside. Of a highest value: that of the
//! function where it is highest (the envelope theorem). Never approximates; undefined where there is no rule.

use std::sync::Arc;

use super::super::graph::{Coordinate, Graph, Node, NodeId};
use super::super::region::{Form, Region, import};
use super::{Rules, Slope, derivative};
use crate::number::{Algebra, Binary, Ternary, Unary};

/// How near to its boundary, in parts of the radius, a place in a ball counts as on it.
const RIM: f64 = 1e-9;

impl Rules<'_> {
    /// The derivative of an output of a region, whose arguments' derivatives are known.
    pub(super) fn region(
        &mut self,
        region: &Region,
        output: usize,
        arguments: &[NodeId],
        node: NodeId,
        by: Coordinate,
    ) -> Slope {
        let slopes: Vec<Slope> = arguments.iter().map(|a| self.slope(*a, by)).collect();
        let Node::Region(shared, _, shared_arguments) = self.graph.node(node).clone() else { return None };
        let place = |graph: &mut Graph, output: u32| {
            graph.intern(Node::Region(shared.clone(), output, shared_arguments.clone()))
        };
        match region.form() {
            Form::Loop { condition, next } => self.repeated(region, (*condition, next), output, arguments, &slopes),
            Form::Section { body, slope, .. } => {
                let at = place(self.graph, 1);
                if output == 0 {
                    self.along(region, (*body, *slope), at, arguments, &slopes)
                } else {
                    self.moved(region, *slope, at, arguments, &slopes)
                }
            }
            Form::Ball { body, dimension } if output == 0 => {
                let steps: Vec<NodeId> = (1..=*dimension as u32).map(|i| place(self.graph, i)).collect();
                self.within(region, *body, &steps, arguments, &slopes)
            }
            Form::Ball { .. } => Some(self.graph.constant(f64::NAN)),
        }
    }

    /// A loop with the derivatives of those variables that have one.
    fn repeated(
        &mut self,
        region: &Region,
        (condition, next): (NodeId, &Arc<[NodeId]>),
        output: usize,
        arguments: &[NodeId],
        slopes: &[Slope],
    ) -> Slope {
        let mut inner = region.graph().clone();
        let moving = moving(&mut inner, next, slopes);
        if !moving[output] {
            return None;
        }
        let (count, all) = (next.len(), arguments.len());
        let order: Vec<usize> = (0..count).chain(count..all).collect();
        // Variables, their derivatives, what is read from outside, its derivatives.
        let (variables, outside) = order.split_at(count);
        let mut made: Vec<NodeId> = Vec::new();
        let mut parameter_of = vec![0; all];
        let mut slope_of = vec![0; all];
        for part in [variables, outside] {
            for &i in part {
                made.push(arguments[i]);
                parameter_of[i] = made.len();
            }
            for &i in part.iter().filter(|i| moving[**i]) {
                made.push(slopes[i].unwrap_or_else(|| self.graph.constant(0.0)));
                slope_of[i] = made.len();
            }
        }
        if made.len() > Coordinate::MOST {
            return Some(self.graph.constant(f64::NAN));
        }
        let partials: Vec<(usize, usize, NodeId)> = (0..count)
            .filter(|i| moving[*i])
            .flat_map(|i| (0..all).map(move |j| (i, j)))
            .filter(|(_, j)| moving[*j])
            .map(|(i, j)| (i, j, derivative(&mut inner, next[i], parameter(j))))
            .collect();
        let mut graph = Graph::new();
        let parameters: Vec<NodeId> = parameter_of.iter().map(|p| graph.coordinate(Coordinate(*p as u8))).collect();
        let roots: Vec<NodeId> =
            std::iter::once(condition).chain(next.iter().copied()).chain(partials.iter().map(|p| p.2)).collect();
        let copies = import(&mut graph, &inner, &roots, &parameters);
        let mut steps: Vec<NodeId> = copies[1..=count].to_vec();
        for i in (0..count).filter(|i| moving[*i]) {
            let mut sum = None;
            for ((_, j, _), by) in partials.iter().zip(&copies[count + 1..]).filter(|(p, _)| p.0 == i) {
                if graph.number(*by) == Some(0.0) {
                    continue;
                }
                let slope = graph.coordinate(Coordinate(slope_of[*j] as u8));
                let term = graph.binary(Binary::Mul, *by, slope);
                sum = Some(sum.map_or(term, |sum| graph.binary(Binary::Add, sum, term)));
            }
            steps.push(sum.unwrap_or_else(|| graph.constant(0.0)));
        }
        let shared = Region::new(graph, Form::Loop { condition: copies[0], next: steps.into() });
        let which = slope_of[output] - 1;
        Some(self.graph.intern(Node::Region(shared, which as u32, made.into())))
    }

    /// The partial derivatives of a root of a region by its parameters, where those have derivatives themselves, summed up.
    fn total(&mut self, region: &Region, root: NodeId, parameters: &[NodeId], slopes: &[Slope]) -> Slope {
        let mut inner = region.graph().clone();
        let mut sum = None;
        for (j, slope) in slopes.iter().enumerate().filter(|(_, slope)| slope.is_some()) {
            let partial = derivative(&mut inner, root, parameter(j));
            if inner.number(partial) == Some(0.0) {
                continue;
            }
            let outer = import(self.graph, &inner, &[partial], parameters)[0];
            let term = self.times(Some(outer), *slope);
            sum = self.plus(sum, term);
        }
        sum
    }

    /// The highest value over a section: the derivative where it is, and at an end with the end.
    fn along(
        &mut self,
        region: &Region,
        (body, slope): (NodeId, NodeId),
        at: NodeId,
        arguments: &[NodeId],
        slopes: &[Slope],
    ) -> Slope {
        let parameters: Vec<NodeId> = std::iter::once(at).chain(arguments[2..].iter().copied()).collect();
        let still: Vec<Slope> = std::iter::once(None).chain(slopes[2..].iter().copied()).collect();
        let inside = self.total(region, body, &parameters, &still);
        let end = self.at_end(at, arguments, slopes, None);
        let outer = end.map(|_| import(self.graph, region.graph(), &[slope], &parameters)[0]);
        let end = self.times(outer, end);
        self.plus(inside, end)
    }

    /// How an end moves where the highest value is at that end; `inside` elsewhere.
    fn at_end(&mut self, at: NodeId, arguments: &[NodeId], slopes: &[Slope], inside: Slope) -> Slope {
        let at_lo = self.graph.binary(Binary::Equal, at, arguments[0]);
        let at_hi = self.graph.binary(Binary::Equal, at, arguments[1]);
        let lower = self.select(at_lo, slopes[0], inside);
        self.select(at_hi, slopes[1], lower)
    }

    /// How the place of the highest value moves: with an end, or as the implicit function theorem says.
    fn moved(&mut self, region: &Region, slope: NodeId, at: NodeId, arguments: &[NodeId], slopes: &[Slope]) -> Slope {
        let parameters: Vec<NodeId> = std::iter::once(at).chain(arguments[2..].iter().copied()).collect();
        let still: Vec<Slope> = std::iter::once(None).chain(slopes[2..].iter().copied()).collect();
        let across = self.total(region, slope, &parameters, &still);
        let inside = across.map(|across| {
            let mut inner = region.graph().clone();
            let bend = derivative(&mut inner, slope, Coordinate(1));
            let bend = import(self.graph, &inner, &[bend], &parameters)[0];
            let quotient = self.graph.binary(Binary::Div, across, bend);
            self.graph.unary(Unary::Neg, quotient)
        });
        self.at_end(at, arguments, slopes, inside)
    }

    /// The highest value in a ball: the derivative where it is; on its boundary it also moves with the radius.
    fn within(
        &mut self,
        region: &Region,
        body: NodeId,
        steps: &[NodeId],
        arguments: &[NodeId],
        slopes: &[Slope],
    ) -> Slope {
        let dimension = steps.len();
        let (radius, grows) = (arguments[dimension], slopes[dimension]);
        let mut parameters: Vec<NodeId> = Vec::new();
        for (centre, step) in arguments.iter().zip(steps) {
            parameters.push(self.graph.binary(Binary::Add, *centre, *step));
        }
        parameters.extend(&arguments[dimension + 1..]);
        let mut moving = slopes.to_vec();
        moving.remove(dimension);
        let inside = self.total(region, body, &parameters, &moving);
        let Some(grows) = grows else { return inside };
        // Each parameter that moves grows by its share of the step.
        let zero = self.graph.constant(0.0);
        let mut length = zero;
        let mut outward: Vec<Slope> = vec![None; parameters.len()];
        for (step, out) in steps.iter().zip(&mut outward) {
            length = self.graph.binary(Binary::Hypot, length, *step);
            let share = self.graph.binary(Binary::Div, *step, radius);
            *out = Some(self.graph.binary(Binary::Mul, share, grows));
        }
        let rim = self.scaled(1.0 - RIM, radius);
        let on_rim = self.graph.binary(Binary::LessEqual, rim, length);
        let growth = self.total(region, body, &parameters, &outward);
        let growth = growth.map(|g| self.graph.ternary(Ternary::Select, on_rim, g, zero));
        self.plus(inside, growth)
    }
}

/// The parameter of a region by its place from 0.
fn parameter(place: usize) -> Coordinate {
    Coordinate(u8::try_from(place + 1).unwrap_or(u8::MAX))
}

/// Which parameters of a loop have a derivative: those that start with one, and variables that take one over.
fn moving(inner: &mut Graph, next: &[NodeId], slopes: &[Slope]) -> Vec<bool> {
    let mut moving: Vec<bool> = slopes.iter().map(Option::is_some).collect();
    loop {
        let mut changed = false;
        for i in 0..next.len() {
            let takes = |j: usize, inner: &mut Graph| {
                let slope = derivative(inner, next[i], parameter(j));
                inner.number(slope) != Some(0.0)
            };
            if !moving[i] && (0..moving.len()).any(|j| moving[j] && takes(j, inner)) {
                moving[i] = true;
                changed = true;
            }
        }
        if !changed {
            return moving;
        }
    }
}
