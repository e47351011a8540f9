//! What is measured of objects: VOLUME, AREA and the others, with their uncertainty. Finds the space of the object and hands it to the measures
//! that `yont measure` shows; computes nothing itself.

use std::sync::Arc;

use crate::builtins::{self, Meaning, Measure, Question, Special};
use crate::diagnostic::{Diagnostic, Severity};
use crate::field::{Coordinate, NodeId};
use crate::reuse::Digest;
use crate::source::Span;
use crate::surface::estimate::{Bend, Estimate};
use crate::surface::grid::MOST_CELLS;
use crate::surface::query::{NearestError, farthest};
use crate::surface::space::{Known, Outcome, find};
use crate::syntax::tree::{Expr, ExprKind};
use crate::vm::{Demand, Program, Shape};

use super::super::errors;
use super::super::request::measured::Dimension;
use super::super::request::subject::{Axis, Subject};
use super::super::request::{Cells, Way, dimension};
use super::super::value::{Array, Value};
use super::{Fault, Lower, Lowered};

/// Cells along the longest side.
pub(super) const CELLS: usize = 128;
/// What an answer takes in memory, roughly.
const ANSWER: usize = 1024;

/// What was measured: numbers with their errors, in the form of the answer.
#[derive(Clone, Debug)]
pub(super) enum Estimates {
    One(Estimate),
    Many(Vec<Self>),
}

impl Estimates {
    /// A number without an error.
    pub(super) fn exactly(value: f64) -> Self {
        Self::One(Estimate { value, error: 0.0 })
    }

    fn list(all: impl IntoIterator<Item = Estimate>) -> Self {
        Self::Many(all.into_iter().map(Self::One).collect())
    }

    /// The answer.
    pub(super) fn values(&self) -> Value {
        self.take(&|estimate| estimate.value)
    }

    fn take(&self, part: &dyn Fn(&Estimate) -> f64) -> Value {
        match self {
            // No minus before nothing.
            Self::One(estimate) => Value::number(part(estimate) + 0.0),
            Self::Many(all) => Value::Array(Array::new(all.iter().map(|one| one.take(part)).collect()).into()),
        }
    }
}

/// What a search for the space of an object gives.
pub(super) enum Space {
    Within(Vec<[f64; 2]>),
    /// Nothing, or nothing with an extent: a point at most.
    Nothing,
}

impl Lower<'_> {
    /// `UNCERTAINTY(VOLUME(g))`
    pub(super) fn uncertainty(&mut self, of: &Expr) -> Lowered<Value> {
        let mut inner = of;
        while let ExprKind::Paren(e) = &inner.kind {
            inner = e;
        }
        if let ExprKind::Call { callee, arguments } = &inner.kind
            && let Some(builtin) = builtins::find(&callee.name)
            && let Meaning::Special(Special::Question(question)) = builtin.meaning
        {
            if !builtin.arity().admits(arguments.len()) {
                return Err(errors::wrong_builtin_count(builtin, arguments.len(), inner.span).into());
            }
            let found = match (question, &arguments[..]) {
                (Question::Measure(of), all) => self.measured(of, all, inner.span)?,
                (Question::Distance, [g, p]) => self.distance(g, p, inner.span)?,
                _ => return Err(errors::no_uncertainty(of.span).into()),
            };
            return Ok(found.take(&|estimate| estimate.error));
        }
        Err(errors::no_uncertainty(of.span).into())
    }

    /// A built-in that measures an object.
    pub(super) fn measured(&mut self, of: Measure, arguments: &[Expr], span: Span) -> Lowered<Estimates> {
        let name = name(of);
        let Some((e, rest)) = arguments.split_first() else { return Ok(Estimates::exactly(f64::NAN)) };
        let cells = match rest.first() {
            Some(cells) => self.cells(cells)?,
            None => CELLS,
        };
        let node = self.object(e, name)?;
        let axes = self.axes(&[node]);
        if axes.is_empty() {
            return Err(errors::measure_of_number(name, e.span).into());
        }
        if of == Measure::Bounds {
            return self.reaches(node, &axes, e.span);
        }
        if axes.len() > 3 {
            return Err(errors::measure_dimension(name, &axes, e.span).into());
        }
        let Space::Within(ranges) = self.space_of(name, node, &axes, e.span)? else {
            return nothing(of, axes.len()).ok_or_else(|| errors::measure_of_nothing(name, e.span).into());
        };
        let found = self.dimension(name, (node, &axes, ranges), cells, e)?;
        answer(of, &axes, &found).ok_or_else(|| errors::measure_missing(name, axes.len(), span).into())
    }

    pub(super) fn cells(&mut self, e: &Expr) -> Lowered<usize> {
        let cells = self.number(e, "the number of cells")?;
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, clippy::cast_precision_loss)]
        match cells.fract() == 0.0 && (1.0..=MOST_CELLS as f64).contains(&cells) {
            true => Ok(cells as usize),
            false => Err(errors::bad_cells(cells, MOST_CELLS, e.span).into()),
        }
    }

    /// Where an object lies, found by intervals.
    pub(super) fn space_of(&mut self, name: &str, node: NodeId, axes: &[Coordinate], span: Span) -> Lowered<Space> {
        let (limits, interrupt) = (self.world.limits, self.world.interrupt);
        let program = Program::compile(self.graph, node, axes, Demand::Sign, limits)
            .map_err(|error| errors::question_too_large(name, error, span))?;
        let known = vec![Known::Sought(None, None); axes.len()];
        let work = limits.search_operations;
        let program = Arc::new(program);
        let _phase = interrupt.phase("space");
        let outcome = interrupt.whole(
            "spaces",
            |to| {
                program.tell(&[], to);
                to.shown(&work);
            },
            |_| ANSWER,
            || find(Arc::clone(&program), &known, work, interrupt),
        )?;
        match outcome {
            Outcome::Within(ranges, _) => Ok(Space::Within(ranges)),
            Outcome::Endless(ends) => Err(errors::measure_endless(name, axes, &ends, span).into()),
            Outcome::Point(_) | Outcome::Empty(true, _) => Ok(Space::Nothing),
            Outcome::Empty(false, _) => Err(errors::measure_unknown(name, span).into()),
        }
    }

    /// Measures an object in its space, as `yont measure --sharp` does.
    fn dimension(
        &mut self,
        name: &str,
        (node, axes, ranges): (NodeId, &[Coordinate], Vec<[f64; 2]>),
        cells: usize,
        e: &Expr,
    ) -> Lowered<Dimension> {
        let (limits, interrupt) = (self.world.limits, self.world.interrupt);
        let mut subject = Subject::of(self.called(e).into(), node, Vec::new());
        let axis = |(order, (&coordinate, range)): (usize, (&Coordinate, [f64; 2]))| Axis { coordinate, range, order };
        subject.axes = axes.iter().zip(ranges).enumerate().map(axis).collect();
        let program = Program::compile(self.graph, node, axes, Demand::Sign, limits)
            .map_err(|error| errors::question_too_large(name, error, e.span))?;
        let shape = Shape::new(program, axes.len(), Vec::new());
        let _phase = interrupt.phase("measure");
        let found =
            dimension(&subject, &shape, (Cells::Along(cells), true, Way::default()), (self.graph, limits, interrupt));
        // What the work was told when it stopped is no message of its own.
        interrupt.tick()?;
        let here = |told: Diagnostic| {
            let mut told = told.at(e.span, "this object");
            told.help.retain(|help| !help.contains("--"));
            told.help(format!("{name}(..., {}) looks at it with smaller cells", 2 * cells))
        };
        match found {
            Ok((found, notes, ..)) => {
                let warnings = notes.into_iter().filter(|note| note.severity == Severity::Warning);
                self.warnings.extend(warnings.map(here));
                Ok(found)
            }
            Err(told) => Err(Fault::from(here(told))),
        }
    }

    /// The words of an expression, as messages call the object.
    fn called(&self, e: &Expr) -> String {
        const SHOWN: usize = 40;
        let text = self.world.sources.text(e.span);
        if text.chars().count() <= SHOWN {
            text.to_owned()
        } else {
            text.chars().take(SHOWN).chain("...".chars()).collect()
        }
    }

    /// `BOUNDS(g)`
    fn reaches(&mut self, node: NodeId, axes: &[Coordinate], span: Span) -> Lowered<Estimates> {
        let name = "BOUNDS";
        let Space::Within(ranges) = self.space_of(name, node, axes, span)? else {
            return Err(errors::measure_of_nothing(name, span).into());
        };
        let conditions = self.both(name, &[node], span)?;
        let Some(from) = self.decided(name, "whether the object is empty", conditions, span)? else {
            return Err(errors::measure_of_nothing(name, span).into());
        };
        let (limits, interrupt, graph) = (self.world.limits, self.world.interrupt, &*self.graph);
        let program = Program::compile(graph, node, axes, Demand::Value, limits)
            .map_err(|error| errors::question_too_large(name, error, span))?;
        let tell = |to: &mut Digest| {
            program.tell(&[], to);
            to.shown(&(&ranges, limits.question_boxes));
        };
        let ends = || {
            let each = |k: usize| [false, true].map(|up| (k, up));
            let find = |(k, up)| farthest(graph, node, (axes, &ranges), (k, up, &from), (limits, interrupt));
            (0..axes.len()).flat_map(each).map(find).collect::<Result<Vec<_>, NearestError>>()
        };
        let _phase = interrupt.phase("questions");
        let found = interrupt.whole("reaches", tell, |_| ANSWER, ends).map_err(|error| match error {
            NearestError::Cancelled => Fault::Cancelled,
            NearestError::Compile(error) => errors::question_too_large(name, error, span).into(),
        })?;
        // Where the proof fails, the space that was found by intervals holds all the same.
        let estimate = |(k, found): (usize, &Option<[f64; 2]>)| match *found {
            Some([value, error]) => Estimate { value, error },
            None => Estimate::between(from[k / 2], ranges[k / 2][k % 2]),
        };
        let found: Vec<Estimate> = found.iter().enumerate().map(estimate).collect();
        let mut rows = vec![[Estimate { value: 0.0, error: 0.0 }; 2]; axes.last().map_or(0, |c| usize::from(c.0))];
        for row in &mut rows {
            *row = [f64::NEG_INFINITY, f64::INFINITY].map(|value| Estimate { value, error: 0.0 });
        }
        for (axis, ends) in axes.iter().zip(found.chunks_exact(2)) {
            rows[usize::from(axis.0) - 1] = [ends[0], ends[1]];
        }
        Ok(Estimates::Many(rows.into_iter().map(Estimates::list).collect()))
    }
}

/// The name of what is measured.
fn name(of: Measure) -> &'static str {
    let is = |meaning: Meaning| matches!(meaning, Meaning::Special(Special::Question(Question::Measure(m))) if m == of);
    builtins::all().find(|builtin| is(builtin.meaning)).map_or("?", |builtin| builtin.name)
}

/// The answer for an object without an extent, where there is one.
fn nothing(of: Measure, axes: usize) -> Option<Estimates> {
    let zero = Estimate { value: 0.0, error: 0.0 };
    match of {
        Measure::Inertia => Some(Estimates::Many(vec![Estimates::list(vec![zero; axes]); axes])),
        Measure::Area | Measure::Perimeter if !is_of(of, axes) => None,
        Measure::Volume | Measure::Area | Measure::Perimeter | Measure::Components => Some(Estimates::exactly(0.0)),
        _ => None,
    }
}

/// Whether that is measured of objects of so many coordinates.
fn is_of(of: Measure, axes: usize) -> bool {
    match of {
        Measure::Area => axes > 1,
        Measure::Perimeter => axes == 2,
        Measure::MeanCurvature | Measure::Genus => axes > 1,
        Measure::GaussCurvature => axes == 3,
        _ => true,
    }
}

/// What was asked, of all that was measured.
fn answer(of: Measure, axes: &[Coordinate], found: &Dimension) -> Option<Estimates> {
    if !is_of(of, axes.len()) {
        return None;
    }
    #[allow(clippy::cast_precision_loss)]
    let count = |n: usize| Some(Estimates::exactly(n as f64));
    let one = |estimate: Estimate| Some(Estimates::One(estimate));
    let rows = |rows: Vec<Vec<Estimate>>| Some(Estimates::Many(rows.into_iter().map(Estimates::list).collect()));
    match (found, of) {
        (Dimension::Solid(m, _), _) => match of {
            Measure::Volume => one(m.volume),
            Measure::Area => one(m.area),
            Measure::Centroid => Some(point(axes, &m.centroid)),
            Measure::Inertia => rows(m.inertia.iter().map(|row| row.to_vec()).collect()),
            Measure::Components => count(m.parts),
            #[allow(clippy::cast_precision_loss)]
            Measure::Genus => Some(Estimates::exactly(m.topology.genus as f64)),
            Measure::MeanCurvature => m.curvature.map(|[mean, _]| bend(&mean)),
            Measure::GaussCurvature => m.curvature.map(|[_, gauss]| bend(&gauss)),
            Measure::Perimeter | Measure::Bounds => None,
        },
        (Dimension::Plane(f), _) => match of {
            Measure::Volume | Measure::Area => one(f.area),
            Measure::Perimeter => one(f.perimeter),
            Measure::Centroid => Some(point(axes, &f.centroid)),
            Measure::Inertia => rows(f.inertia.iter().map(|row| row.to_vec()).collect()),
            Measure::Components => count(f.components),
            Measure::Genus => count(f.holes),
            Measure::MeanCurvature => f.curvature.map(|curvature| bend(&curvature)),
            Measure::GaussCurvature | Measure::Bounds => None,
        },
        (Dimension::Line(line), Measure::Volume) => one(line.length),
        (Dimension::Line(line), Measure::Components) => count(line.intervals.len()),
        (Dimension::Line(line), _) => {
            let length = line.length;
            let first: f64 = line.intervals.iter().map(|[a, b]| 0.5 * (b - a) * (a + b)).sum();
            let centre = first / length.value;
            let within = line.intervals.iter().map(|[a, b]| ((b - centre).powi(3) - (a - centre).powi(3)) / 3.0);
            let size = line.intervals.iter().flatten().fold(0.0_f64, |most, end| most.max((end - centre).abs()));
            match of {
                Measure::Centroid => {
                    Some(point(axes, &[Estimate { value: centre, error: length.error * size / length.value }]))
                }
                Measure::Inertia => {
                    let value = Estimate { value: within.sum(), error: length.error * size * size };
                    rows(vec![vec![value]])
                }
                _ => None,
            }
        }
    }
}

/// A point in the coordinates up to the highest that is used; 0 along those that are not.
fn point(axes: &[Coordinate], at: &[Estimate]) -> Estimates {
    let mut all = vec![Estimate { value: 0.0, error: 0.0 }; axes.last().map_or(0, |c| usize::from(c.0))];
    for (axis, &estimate) in axes.iter().zip(at) {
        all[usize::from(axis.0) - 1] = estimate;
    }
    Estimates::list(all)
}

/// The least, the average, the largest and the integral.
fn bend(bend: &Bend) -> Estimates {
    Estimates::list([bend.least, bend.average, bend.largest, bend.integral])
}
