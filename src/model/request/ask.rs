//! The questions themselves: from a session and a [`View`] to a subject, and from a subject to answers.

use std::io::Write;

use crate::diagnostic::Diagnostic;
use crate::field::{Coordinate, Graph, NodeId};
use crate::interrupt::Interrupt;
use crate::limits::Limits;
use crate::number::{Algebra, Binary};
use crate::surface::figure::measure as measure_figure;
use crate::surface::line::intervals;
use crate::surface::marching::SurfaceError;
use crate::surface::measure::{MeasureError, measure_as as measure_solid};
use crate::surface::star::measure::Found;
use crate::vm::Demand;

use super::fields::{Sampled, Sampling};
use super::info::role;
use super::make::{Workshop, Written, cancelled, make};
use super::measured::{Dimension, Measured};
use super::output::Output;
use super::pictures;
use super::space;
use super::starred::{Along, Way, measured};
use super::subject::{Level, Place, Sequence, Subject};
use super::together::subject;
use super::told;
use super::way::{Ready, Route};
use super::{Cells, Options, Timing, View};
use crate::model::environment::{self, Object, Role};
use crate::model::route::{Question, star};
use crate::model::session::Session;
use crate::vm::{Precision, Shape};

/// An answer, or the messages that say why there is none.
type Asked<T> = Result<T, Vec<Diagnostic>>;

/// Makes an output and writes it through the session's host; `standard` is what `-o -` writes to.
///
/// # Errors
/// Messages whose category decides the exit status.
pub fn write(session: &mut Session, output: &Output, options: &Options, standard: &mut dyn Write) -> Asked<Written> {
    session.turn();
    let subject = subject(session, &options.view, &options.timing)?;
    let subject = match &options.slices {
        Some(slices) => subject.sliced(slices).map_err(|d| vec![d])?,
        None => subject,
    };
    let subject =
        subject.cut(&options.cuts, &pictures::view(&options.picture).map_err(|d| vec![d])?).map_err(|d| vec![d])?;
    let host = session.host.clone();
    let guide = Ready::of(session, &options.view.guide).map_err(|d| vec![d])?;
    let (graph, limits, interrupt) = (&session.graph, &session.limits, &session.interrupt);
    let shop = Workshop { graph, limits, interrupt, host: &*host, guide };
    let made = make(&shop, &subject, output, options, standard);
    let told = match made {
        Ok(written) => return Ok(written),
        Err(told) => broken_star(session, &subject, options, told),
    };
    Err(subject.notes.iter().cloned().chain([told]).collect())
}

/// The message about a route that cannot be taken, with the part that breaks it.
fn broken_star(session: &mut Session, subject: &Subject, options: &Options, told: Diagnostic) -> Diagnostic {
    let name = &subject.name;
    let known = told.code == "no-star" && told.labels.is_empty() && options.view.route == Route::Star;
    let place = if known { session.breaks(name, subject, options.view.centre.as_deref()) } else { None };
    match place {
        Some(span) => told.at(span, "this part"),
        None => told,
    }
}

impl Session {
    /// Where the part stands that breaks the rays of a subject.
    fn breaks(&mut self, name: &str, subject: &Subject, centre: Option<&[f64]>) -> Option<crate::source::Span> {
        let axes: Vec<Coordinate> = subject.axes.iter().map(|axis| axis.coordinate).collect();
        let centre = centre.or(subject.centre.as_deref());
        let question =
            Question { node: subject.node, axes: &axes, fixed: &subject.fixed, centre, hint: None, told: false };
        let found = star(&self.graph, question, &self.limits, &self.interrupt).ok()?;
        let node = found.err()?.node()?;
        self.place_of_node(name, subject.node, node)
    }
}

/// Measures an object: a solid, a plane figure, or one of a single coordinate.
///
/// # Errors
/// Messages for the user.
pub fn measure(session: &mut Session, view: &View) -> Asked<Measured> {
    session.turn();
    let subject = subject(session, view, &Timing::default())?;
    subject.is_alone("a measurement").map_err(|told| vec![told])?;
    let measured = measure_subject(session, view, &subject);
    measured.map_err(|told| subject.notes.iter().cloned().chain([told]).collect())
}

fn measure_subject(session: &Session, view: &View, subject: &Subject) -> Result<Measured, Diagnostic> {
    subject.shown_by("a measurement", &[])?;
    let (limits, interrupt) = (&session.limits, &session.interrupt);
    let shape = subject.shape(&session.graph, Demand::Sign, limits)?;
    let mut notes = subject.notes.clone();
    if view.precision == Precision::Single {
        notes.push(
            Diagnostic::note("single-precision", "measured in single precision: a preview")
                .fact("the error estimates do not know of it"),
        );
    }
    notes.extend(told::first_moment(subject));
    let _phase = interrupt.phase("measure");
    let way = Way { route: view.route, centre: view.centre.as_deref() };
    let asked = (view.cells, view.sharp, way);
    let (of, more, resolution, route) = dimension(subject, &shape, asked, (&session.graph, limits, interrupt))?;
    notes.extend(more);
    let bounds = subject.axes.iter().map(|a| (a.coordinate, a.range)).collect();
    Ok(Measured { object: subject.name.to_string(), bounds, resolution, route, of, notes })
}

/// What is measured of a subject in its space, what there is to say of it, the cells along the longest side, and the route that was taken.
///
/// # Errors
/// If it is empty there, or its boundary could not be found.
pub(in crate::model) fn dimension(
    subject: &Subject,
    shape: &Shape,
    (cells, sharp, way): (Cells, bool, Way<'_>),
    (graph, limits, interrupt): (&Graph, &Limits, &Interrupt),
) -> Result<(Dimension, Vec<Diagnostic>, usize, String), Diagnostic> {
    let mut notes = Vec::new();
    if let [axis] = subject.axes[..] {
        let line = intervals(shape, axis.range, interrupt)?;
        if line.intervals.is_empty() {
            return Err(told::empty(subject, None, None));
        }
        notes.extend(told::undefined(subject, &line.counters));
        notes.extend(told::cut(subject, &[line.cut, [false; 2], [false; 2]]));
        return Ok((Dimension::Line(line), notes, 0, String::new()));
    }
    let grid = subject.grid(cells, limits)?;
    let cells = grid.cells.into_iter().max().unwrap_or_default();
    let mut route = if subject.axes.len() == 3 { "cubes" } else { "squares" }.to_owned();
    let mut rays = None;
    match measured(subject, (shape, &grid), way, (graph, limits, interrupt))? {
        Some((Along::Solid(Found::All(all)), line)) => {
            let triangles = all.topology.triangles;
            return Ok((Dimension::Solid(all, triangles), notes, cells, line));
        }
        Some((Along::Plane(figure), line)) => return Ok((Dimension::Plane(figure), notes, cells, line)),
        Some((Along::Solid(found), line)) => rays = Some((found, line)),
        None => {}
    }
    let (of, report, is_settled) = if subject.axes.len() == 3 {
        let mut measures = measure_solid(shape, &grid, sharp, limits, interrupt).map_err(|e| unmeasured(&e))?;
        if let Some((_, line)) = rays.filter(|(found, _)| found.improve(&mut measures)) {
            route = format!("{line}; the rest by cubes");
        }
        let (report, is_settled) = (measures.report.clone(), measures.is_settled);
        let triangles = measures.topology.triangles;
        ((triangles > 0).then(|| Dimension::Solid(Box::new(measures), triangles)), report, is_settled)
    } else {
        let figure = measure_figure(shape, &grid, sharp, limits, interrupt).map_err(|e| unmeasured(&e.into()))?;
        let (report, is_settled) = (figure.report.clone(), figure.is_settled);
        ((figure.points > 0).then(|| Dimension::Plane(Box::new(figure))), report, is_settled)
    };
    let Some(of) = of else { return Err(told::empty(subject, None, Some(&report))) };
    notes.extend(told::of_report(subject, &report));
    notes.extend((!is_settled).then(|| told::unsettled(subject)));
    Ok((of, notes, cells, route))
}

pub(super) fn unmeasured(error: &MeasureError) -> Diagnostic {
    match error {
        MeasureError::Surface(SurfaceError::Cancelled) => cancelled(),
        other => Diagnostic::error("not-measured", other.to_string()).category(crate::diagnostic::Category::Result),
    }
}

/// The values of an object's function at points, and its derivatives by each coordinate if wanted.
///
/// # Errors
/// Messages for the user; one if a point has fewer numbers than the object has coordinates.
pub fn sample(session: &mut Session, view: &View, points: &[Vec<f64>], gradient: bool) -> Asked<Vec<Sampled>> {
    let width = points.iter().map(Vec::len).min().unwrap_or(16);
    let mut sampling = sampling(session, view, width, gradient)?;
    sampling.values(points, &session.interrupt).map_err(|_| vec![cancelled()])
}

/// The same for points that come one after the other, each of at least `width` numbers.
///
/// # Errors
/// As [`sample`].
pub fn sampling(session: &mut Session, view: &View, width: usize, gradient: bool) -> Asked<Sampling> {
    let placed = |c: Coordinate| usize::from(c.0) <= width || view.at.iter().any(|at| at.0 == c);
    let object = session.object_given(view.object.as_deref(), &placed)?;
    let mut fixed = view.at.clone();
    for axis in &object.axes {
        if let Role::Constant(value) = axis.role
            && !fixed.iter().any(|f| f.0 == axis.coordinate)
        {
            fixed.push((axis.coordinate, value));
        }
    }
    let missing = |c: &Coordinate| usize::from(c.0) > width && !fixed.iter().any(|f| f.0 == *c);
    if let Some(c) = object.uses.iter().find(missing) {
        let title = format!("`{}` depends on {c}, and a point has {width} numbers", object.name);
        return Err(vec![
            Diagnostic::error("short-point", title).help(format!("give each point {} numbers, or --at {c}=...", c.0)),
        ]);
    }
    let subject = Subject::of(object.name.clone(), object.node, fixed);
    let single = view.precision == Precision::Single;
    Sampling::new(&subject, &session.graph, (width, gradient, single), (&session.limits, &session.interrupt))
        .map_err(|told| vec![told])
}

/// The object that a view names as a subject, by itself.
///
/// # Errors
/// Messages for the user: what is missing or makes no sense.
pub(super) fn alone(session: &mut Session, view: &View, timing: &Timing) -> Asked<Subject> {
    let fixed = |c: Coordinate| view.at.iter().any(|at| at.0 == c);
    let mut object = session.object_given(view.object.as_deref(), &fixed)?;
    override_axes(&mut object, view);
    let mut told = Vec::new();
    let mut subject = Subject::of(object.name.clone(), object.node, Place::new());
    for axis in object.axes.iter().filter(|a| !a.is_space()) {
        let most = session.limits.frames;
        let steps = axis.steps(most);
        let asked = timing.frames.filter(|_| matches!(axis.role, Role::T)).unwrap_or(steps.len());
        if asked > most {
            told.push(too_many(&subject.name, axis, most));
        } else if let Err(diagnostic) = cast(&mut subject, axis, steps, timing) {
            told.push(diagnostic);
        }
    }
    let several = subject.groups.iter().chain(&subject.colour).map(|several| several.values.len());
    if several.fold(1, usize::saturating_mul) > session.limits.frames {
        told.push(too_many_sections(&subject.name, session.limits.frames));
    }
    match object.levels[..] {
        [0.0] => {}
        [level] => subject.node = lower(session, object.node, level),
        _ => {
            let mut levels = object.levels.clone();
            levels.sort_by(f64::total_cmp);
            levels.dedup();
            let level = |value| Level { value, node: lower(session, object.node, value) };
            subject.levels = levels.into_iter().map(level).collect();
        }
    }
    if !told.is_empty() {
        return Err(told);
    }
    subject.span = session.place(&object.name);
    subject.colouring = object.colour;
    subject.centre.clone_from(&object.center);
    subject.precision = view.precision;
    space::settle(session, &mut subject, &object).map_err(|told| vec![told])?;
    Ok(subject)
}

/// The function less a level.
fn lower(session: &mut Session, node: NodeId, level: f64) -> NodeId {
    let level = session.graph.constant(level);
    session.graph.binary(Binary::Sub, node, level)
}

/// Gives a coordinate that is no axis its part in the subject.
fn cast(subject: &mut Subject, axis: &environment::Axis, steps: Vec<f64>, timing: &Timing) -> Result<(), Diagnostic> {
    let coordinate = axis.coordinate;
    let first = *steps.first().ok_or_else(|| no_values(&subject.name, axis))?;
    subject.fixed.push((coordinate, first));
    let several = |values: Vec<f64>| Sequence { coordinate, values };
    match &axis.role {
        Role::T => subject.time = Some(several(frames(&steps, axis.range, timing.frames))),
        Role::V => subject.columns = Some(several(steps)),
        Role::W => subject.rows = Some(several(steps)),
        Role::C => subject.colour = Some(several(steps)),
        Role::Group(_) => subject.groups.push(several(steps)),
        Role::X | Role::Y | Role::Z | Role::Constant(_) => {}
    }
    Ok(())
}

/// Lets `--at` and `--bounds` win over the script.
fn override_axes(object: &mut Object, view: &View) {
    for &(c, lo, hi) in &view.bounds {
        match object.axes.iter_mut().find(|a| a.coordinate == c) {
            Some(axis) => axis.range = Some((lo, hi)),
            None => {
                if let Some(role) = environment::default_role(c).filter(|r| matches!(r, Role::X | Role::Y | Role::Z)) {
                    let range = Some((lo, hi));
                    let ends = (Some(lo), Some(hi));
                    object.axes.push(environment::Axis {
                        coordinate: c,
                        role,
                        declared: false,
                        range,
                        ends,
                        delta: None,
                    });
                }
            }
        }
    }
    for &(c, value) in &view.at {
        let role = Role::Constant(value);
        match object.axes.iter_mut().find(|a| a.coordinate == c) {
            Some(axis) => axis.role = role,
            None if object.uses.contains(c) => {
                let (range, ends, delta) = Default::default();
                object.axes.push(environment::Axis { coordinate: c, role, declared: false, range, ends, delta });
            }
            None => {}
        }
    }
}

/// The moments of the frames: the script's, or as many as were asked for over the same range.
fn frames(steps: &[f64], range: Option<(f64, f64)>, asked: Option<usize>) -> Vec<f64> {
    match (asked, range) {
        (Some(count), Some((lo, hi))) if count > 1 => {
            let (from, to) = if steps.first() > steps.last() { (hi, lo) } else { (lo, hi) };
            (0..count).map(|k| from + (to - from) * (k as f64 / (count - 1) as f64)).collect()
        }
        (Some(1), _) => steps[..1].to_vec(),
        _ => steps.to_vec(),
    }
}

fn too_many(name: &str, axis: &environment::Axis, most: usize) -> Diagnostic {
    let c = axis.coordinate;
    Diagnostic::error("too-many-frames", format!("`{name}` takes more than {most} values of {c}"))
        .fact("each of them would be a frame, a picture or a section")
        .help(format!("give {c} a larger {c}_delta or a shorter range, or ask for fewer --frames"))
}

fn too_many_sections(name: &str, most: usize) -> Diagnostic {
    Diagnostic::error("too-many-frames", format!("`{name}` has more than {most} sections to show together"))
        .help("give the coordinates of type G or C fewer values")
}

fn no_values(name: &str, axis: &environment::Axis) -> Diagnostic {
    let c = axis.coordinate;
    let (code, title) = match axis.role {
        Role::T => ("no-time", format!("`{name}` moves with {c}, which has no range")),
        _ => ("no-values", format!("`{name}` varies with {c}, which has the type {} and no range", role(&axis.role))),
    };
    Diagnostic::error(code, title)
        .help(format!("add to the script: {c}min = 0; {c}max = 1; {c}_delta = 0.1;"))
        .help(format!("or show one section: --at {c}=0"))
}
