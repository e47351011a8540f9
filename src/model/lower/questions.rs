//! The questions whether objects meet: INTERSECTS, INCLUDES, WITNESS. Hands each to the search that answers it and makes a value of the
//! answer; computes nothing itself. Answers are remembered by what the objects are.

use std::sync::Arc;

use crate::builtins::Question;
use crate::field::{Coordinate, Coordinates, NodeId};
use crate::source::Span;
use crate::surface::query::{Conditions, Verdict, decide};
use crate::syntax::tree::Expr;
use crate::vm::CompileError;

use super::super::errors;
use super::super::value::{Array, Value};
use super::{Fault, Lower, Lowered};

/// What an answer takes in memory, roughly.
const ANSWER: usize = 512;

impl Lower<'_> {
    /// A built-in that asks about objects.
    pub(super) fn question(&mut self, question: Question, arguments: &[Expr], span: Span) -> Lowered<Value> {
        match (question, arguments) {
            (Question::Intersects, [a, b]) => self.intersects(a, b, span),
            (Question::Includes, [a, b]) => self.includes(a, b, span),
            (Question::Witness, all) => self.witness(all, span),
            (Question::Measure(of), all) => self.measured(of, all, span).map(|found| found.values()),
            (Question::Distance, [g, p]) => self.distance(g, p, span).map(|found| found.values()),
            (Question::Closest, [g, p]) => self.closest(g, p, span),
            (Question::Curve, [a, b, cells @ ..]) => self.curve(a, b, cells.first(), span),
            (Question::Uncertainty, [of]) => self.uncertainty(of),
            _ => Ok(Value::number(f64::NAN)),
        }
    }

    /// An argument that is an object: a function of coordinates that a text can name, or a number everywhere.
    pub(super) fn object(&mut self, e: &Expr, name: &str) -> Lowered<NodeId> {
        let scalar = self.scalar(e, &format!("the object of {name}"))?;
        let node = scalar.node(self.graph);
        let is_known = |c: Coordinate| usize::from(c.0) <= Coordinate::NAMED;
        match self.graph.coordinates(node).iter().all(is_known) {
            true => Ok(node),
            false => Err(errors::question_varies(name, node, e.span).into()),
        }
    }

    /// The coordinates that some objects use.
    pub(super) fn axes(&self, objects: &[NodeId]) -> Vec<Coordinate> {
        let all = objects.iter().fold(Coordinates::default(), |all, id| all.union(self.graph.coordinates(*id)));
        all.iter().collect()
    }

    fn intersects(&mut self, a: &Expr, b: &Expr, span: Span) -> Lowered<Value> {
        let name = "INTERSECTS";
        let objects = [self.object(a, name)?, self.object(b, name)?];
        let conditions = self.both(name, &objects, span)?;
        match self.decided(name, "whether the objects meet", conditions, span)? {
            Some(_) => Ok(Value::number(1.0)),
            None => Ok(Value::number(0.0)),
        }
    }

    fn witness(&mut self, all: &[Expr], span: Span) -> Lowered<Value> {
        let name = "WITNESS";
        let objects: Vec<NodeId> = all.iter().map(|e| self.object(e, name)).collect::<Lowered<_>>()?;
        let axes = self.axes(&objects);
        let conditions = self.both(name, &objects, span)?;
        let what = if objects.len() > 1 { "whether the objects meet" } else { "whether the object is empty" };
        match self.decided(name, what, conditions, span)? {
            Some(point) => Ok(placed(&axes, &point)),
            None => Err(errors::no_witness(objects.len() > 1, span).into()),
        }
    }

    /// Every point of the second object belongs to the first: to each part of it, if it is an intersection.
    fn includes(&mut self, a: &Expr, b: &Expr, span: Span) -> Lowered<Value> {
        let name = "INCLUDES";
        let (outer, inner) = (self.object(a, name)?, self.object(b, name)?);
        if outer == inner {
            return Ok(Value::number(1.0));
        }
        let axes = self.axes(&[outer, inner]);
        let (graph, parts) = Conditions::parts(self.graph, outer);
        let mut open = None;
        for part in parts {
            let mut conditions = Conditions::over(&axes, self.world.limits);
            let told = conditions.inside(self.graph, inner).and_then(|()| conditions.outside(&graph, part));
            told.map_err(|error| too_large(name, error, span))?;
            // A part that is known not to include all of the other decides, whatever could not be decided before.
            match self.decided(name, "whether one object includes the other", conditions, span) {
                Ok(Some(_)) => return Ok(Value::number(0.0)),
                Ok(None) => {}
                Err(Fault::Cancelled) => return Err(Fault::Cancelled),
                Err(fault) => open = open.or(Some(fault)),
            }
        }
        open.map_or(Ok(Value::number(1.0)), Err)
    }

    /// The conditions of a point of all these objects.
    pub(super) fn both(&mut self, name: &str, objects: &[NodeId], span: Span) -> Lowered<Conditions> {
        let mut conditions = Conditions::over(&self.axes(objects), self.world.limits);
        let told = objects.iter().try_for_each(|&object| conditions.inside(self.graph, object));
        told.map_err(|error| too_large(name, error, span))?;
        Ok(conditions)
    }

    /// A point that meets the conditions, or none; an error if that is not known.
    pub(super) fn decided(
        &mut self,
        name: &str,
        what: &str,
        mut conditions: Conditions,
        span: Span,
    ) -> Lowered<Option<Vec<f64>>> {
        let (limits, interrupt) = (self.world.limits, self.world.interrupt);
        let boxes = limits.question_boxes;
        let axes = conditions.axes().to_vec();
        let space = vec![[f64::NEG_INFINITY, f64::INFINITY]; axes.len()];
        let _phase = interrupt.phase("questions");
        let conditions = &mut conditions;
        let mut digest = crate::reuse::Digest::of("question");
        conditions.tell(&mut digest);
        let verdict = interrupt.whole(
            "answers",
            |to| to.shown(&(digest.key(), boxes)),
            |_| ANSWER,
            || decide(conditions, &space, boxes, interrupt).map(Arc::new),
        )?;
        match &*verdict {
            Verdict::Never => Ok(None),
            Verdict::At(point) => Ok(Some(point.clone())),
            Verdict::Open(near) => Err(errors::undecided(name, what, (&axes, near), boxes, span).into()),
        }
    }
}

fn too_large(name: &str, error: CompileError, span: Span) -> Fault {
    errors::question_too_large(name, error, span).into()
}

/// A point as an array: the coordinates up to the highest that is used, 0 for those between that are not.
pub(super) fn placed(axes: &[Coordinate], point: &[f64]) -> Value {
    let mut all = vec![0.0; axes.last().map_or(0, |c| usize::from(c.0))];
    for (axis, &c) in axes.iter().zip(point) {
        all[usize::from(axis.0) - 1] = c;
    }
    Value::Array(Array::new(all.into_iter().map(Value::number).collect()).into())
}
