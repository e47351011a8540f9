//! The questions that are answered by points: DISTANCE, CLOSEST and CURVE. Hands each to the search that answers it; computes nothing
//! itself.

use crate::diagnostic::Diagnostic;
use crate::field::{Coordinate, NodeId};
use crate::number::{Algebra, Binary};
use crate::reuse::Digest;
use crate::source::Span;
use crate::surface::estimate::Estimate;
use crate::surface::grid::{Grid, GridError};
use crate::surface::marching::SurfaceError;
use crate::surface::query::{CurveError, Nearest, NearestError, crossings, curves, nearest};
use crate::syntax::tree::Expr;
use crate::vm::{CompileError, Demand, Program};

use super::super::errors;
use super::super::value::Value;
use super::measured::{CELLS, Estimates, Space};
use super::questions::placed;
use super::{Fault, Lower, Lowered};

/// What an answer takes in memory, roughly.
const ANSWER: usize = 512;

/// An error that may be the request to stop.
enum Failed {
    Cancelled,
    Told(Box<Diagnostic>),
}

impl From<crate::interrupt::Cancelled> for Failed {
    fn from(_: crate::interrupt::Cancelled) -> Self {
        Self::Cancelled
    }
}

impl From<Failed> for Fault {
    fn from(failed: Failed) -> Self {
        match failed {
            Failed::Cancelled => Self::Cancelled,
            Failed::Told(told) => Self::Told(told),
        }
    }
}

impl Lower<'_> {
    /// `DISTANCE(g, p)`
    pub(super) fn distance(&mut self, g: &Expr, p: &Expr, span: Span) -> Lowered<Estimates> {
        let (_, _, (_, distance, error)) = self.nearest("DISTANCE", g, p, span)?;
        Ok(Estimates::One(Estimate { value: distance, error }))
    }

    /// `CLOSEST(g, p)`
    pub(super) fn closest(&mut self, g: &Expr, p: &Expr, span: Span) -> Lowered<Value> {
        let (axes, mut point, (place, ..)) = self.nearest("CLOSEST", g, p, span)?;
        for (axis, c) in axes.iter().zip(place) {
            point[usize::from(axis.0) - 1] = c;
        }
        self.array(point.into_iter().map(Value::number).collect(), span)
    }

    /// The axes of an object, a point, and the nearest point of the object with its distance and what that may be off.
    #[allow(clippy::type_complexity)]
    fn nearest(
        &mut self,
        name: &str,
        g: &Expr,
        p: &Expr,
        span: Span,
    ) -> Lowered<(Vec<Coordinate>, Vec<f64>, (Vec<f64>, f64, f64))> {
        let node = self.object(g, name)?;
        let point = self.point(name, p)?;
        let axes = self.axes(&[node]);
        let needs = axes.last().map_or(0, |c| usize::from(c.0));
        if point.len() < needs {
            return Err(errors::short_point(name, needs, point.len(), p.span).into());
        }
        let to: Vec<f64> = axes.iter().map(|c| point[usize::from(c.0) - 1]).collect();
        let (limits, interrupt, graph) = (self.world.limits, self.world.interrupt, &*self.graph);
        let told = |error: CompileError| Failed::Told(Box::new(errors::question_too_large(name, error, span)));
        let program = Program::compile(graph, node, &axes, Demand::Value, limits).map_err(told)?;
        let _phase = interrupt.phase("questions");
        let tell = |digest: &mut Digest| {
            program.tell(&[], digest);
            digest.numbers(&to);
            digest.shown(&limits.question_boxes);
        };
        let search = || {
            nearest(graph, node, (&axes, &to), limits, interrupt).map_err(|error| match error {
                NearestError::Cancelled => Failed::Cancelled,
                NearestError::Compile(error) => told(error),
            })
        };
        let found = interrupt.whole("nearest points", tell, |_| ANSWER, search)?;
        match found {
            Nearest::Found { place, distance, error } => Ok((axes, point, (place, distance, error))),
            Nearest::Nothing => Err(errors::measure_of_nothing(name, g.span).into()),
            Nearest::Open(near) => {
                let what = "whether some point of the object is nearer";
                Err(errors::undecided(name, what, (&axes, &near), limits.question_boxes, span).into())
            }
        }
    }

    /// An array of numbers that is a point.
    fn point(&mut self, name: &str, e: &Expr) -> Lowered<Vec<f64>> {
        let place = format!("the point of {name}");
        let value = self.expr(e)?;
        let Value::Array(array) = &value else { return Err(errors::needs_numbers(&place, &value, e.span).into()) };
        let mut point = Vec::with_capacity(array.items().len());
        for item in array.items() {
            let scalar = self.as_scalar(item, e.span, &place)?;
            match scalar.number() {
                Some(c) if c.is_finite() => point.push(c),
                Some(_) => return Err(errors::point_not_finite(name, e.span).into()),
                None => return Err(errors::needs_number(&place, scalar.coordinates(self.graph), e.span).into()),
            }
        }
        Ok(point)
    }

    /// `CURVE(g1, g2)`, `CURVE(g1, g2, cells)`
    pub(super) fn curve(&mut self, a: &Expr, b: &Expr, cells: Option<&Expr>, span: Span) -> Lowered<Value> {
        let name = "CURVE";
        let objects = [self.object(a, name)?, self.object(b, name)?];
        let cells = match cells {
            Some(e) => self.cells(e)?,
            None => CELLS,
        };
        let axes = self.axes(&objects);
        if !(2..=3).contains(&axes.len()) {
            return Err(errors::curve_dimension(axes.len(), span).into());
        }
        let both = self.graph.binary(Binary::Min, objects[0], objects[1]);
        let lines = match self.space_of(name, both, &axes, span)? {
            Space::Within(ranges) => self.lines(objects, &axes, &ranges, (cells, span))?,
            Space::Nothing => Vec::new(),
        };
        let mut all = Vec::with_capacity(lines.len());
        for line in lines {
            let points = line.iter().map(|point| placed(&axes, point)).collect();
            all.push(self.array(points, span)?);
        }
        self.array(all, span)
    }

    fn lines(
        &self,
        objects: [NodeId; 2],
        axes: &[Coordinate],
        ranges: &[[f64; 2]],
        (cells, span): (usize, Span),
    ) -> Lowered<Vec<Vec<Vec<f64>>>> {
        let (limits, interrupt, graph) = (self.world.limits, self.world.interrupt, &*self.graph);
        let grid = Grid::new(ranges, cells).map_err(|error: GridError| errors::no_curve(&error.to_string(), span))?;
        let bytes = grid.estimated_bytes();
        if bytes > limits.memory_bytes as u64 {
            return Err(errors::no_curve("so many cells take more memory than the limit", span).into());
        }
        let _phase = interrupt.phase("questions");
        let tell = |digest: &mut Digest| {
            for object in objects {
                // What cannot be compiled is told by the search itself.
                if let Ok(program) = Program::compile(graph, object, axes, Demand::Value, limits) {
                    program.tell(&[], digest);
                }
            }
            digest.shown(&grid);
        };
        let size = |lines: &Vec<Vec<Vec<f64>>>| ANSWER + lines.iter().map(|line| line.len() * 64).sum::<usize>();
        let search = || {
            let found = match axes.len() {
                3 => curves(graph, objects, (axes, &grid), limits, interrupt),
                _ => crossings(graph, objects, (axes, &grid), limits, interrupt)
                    .map(|points| points.into_iter().map(|point| vec![point]).collect()),
            };
            found.map_err(|error| match error {
                CurveError::Surface(SurfaceError::Cancelled) => Failed::Cancelled,
                error => Failed::Told(Box::new(errors::no_curve(&error.to_string(), span))),
            })
        };
        Ok(interrupt.whole("curves", tell, size, search)?)
    }
}
