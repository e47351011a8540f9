//! The questions themselves: from a session and a [`View`] to a subject, and from a subject to answers.

use std::fmt;
use std::io::Write;

use serde_json::{Map, Value, json};

use crate::diagnostic::Diagnostic;
use crate::field::{Coordinate, NodeId};
use crate::number::{Algebra, Binary};
use crate::surface::contour::outlines;
use crate::surface::marching::SurfaceError;
use crate::surface::measure::{Estimate, MeasureError, measure as measure_solid};
use crate::vm::Demand;

use super::fields::{Sampled, at_points};
use super::make::{Workshop, Written, cancelled, make};
use super::measured::{Dimension, Measured};
use super::output::Output;
use super::pictures;
use super::subject::{Axis, Level, Place, Sequence, Subject};
use super::together::subject;
use super::{Options, Timing, View};
use crate::model::environment::{self, Object, Role};
use crate::model::session::Session;

/// An answer, or the messages that say why there is none.
type Asked<T> = Result<T, Vec<Diagnostic>>;

/// Makes an output and writes it through the session's host; `standard` is what `-o -` writes to.
///
/// # Errors
/// Messages whose category decides the exit status.
pub fn write(session: &mut Session, output: &Output, options: &Options, standard: &mut dyn Write) -> Asked<Written> {
    let subject = subject(session, &options.view, &options.timing)?;
    let subject = match &options.slices {
        Some(slices) => subject.sliced(slices).map_err(|d| vec![d])?,
        None => subject,
    };
    let subject =
        subject.cut(&options.cuts, &pictures::view(&options.picture).map_err(|d| vec![d])?).map_err(|d| vec![d])?;
    let host = session.host.clone();
    let shop = Workshop { graph: &session.graph, limits: &session.limits, interrupt: &session.interrupt, host: &*host };
    make(&shop, &subject, output, options, standard).map_err(|d| vec![d])
}

/// Measures an object: a solid, or a plane figure.
///
/// # Errors
/// Messages for the user.
pub fn measure(session: &mut Session, view: &View) -> Asked<Measured> {
    let subject = subject(session, view, &Timing::default())?;
    let one = |d: Diagnostic| vec![d];
    subject.is_alone("a measurement").and_then(|()| subject.shown_by("a measurement", &[])).map_err(one)?;
    let grid = subject.grid(view.cells, &session.limits).map_err(one)?;
    let shape = subject.shape(&session.graph, Demand::Sign, &session.limits).map_err(one)?;
    let interrupt = &session.interrupt;
    let _phase = interrupt.phase("measure");
    let of = if subject.axes.len() == 3 {
        let measures = measure_solid(&shape, &grid, &session.limits, interrupt).map_err(|e| one(unmeasured(&e)))?;
        let triangles = measures.topology.triangles;
        if triangles == 0 {
            return Err(one(super::make::empty(&subject, None, Some(measures.report.samples))));
        }
        Dimension::Solid(Box::new(measures), triangles)
    } else {
        let rough =
            outlines(&shape, &grid.halved(), &session.limits, interrupt).map_err(|e| one(unmeasured(&e.into())))?;
        let fine = outlines(&shape, &grid, &session.limits, interrupt).map_err(|e| one(unmeasured(&e.into())))?;
        if fine.lines.is_empty() {
            return Err(one(super::make::empty(&subject, None, Some(fine.samples))));
        }
        let estimate = |value: f64, other: f64| Estimate { value, error: (value - other).abs() };
        Dimension::Plane {
            area: estimate(fine.area(), rough.area()),
            perimeter: estimate(fine.perimeter(), rough.perimeter()),
            euler: fine.euler(),
        }
    };
    let bounds = subject.axes.iter().map(|a| (a.coordinate, a.range)).collect();
    let resolution = grid.cells.into_iter().max().unwrap_or_default();
    Ok(Measured { object: subject.name.to_string(), bounds, resolution, of })
}

fn unmeasured(error: &MeasureError) -> Diagnostic {
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
    let object = session.object(view.object.as_deref())?;
    let given = points.iter().map(Vec::len).min().unwrap_or(16);
    let mut fixed = view.at.clone();
    for axis in &object.axes {
        if let Role::Constant(value) = axis.role
            && !fixed.iter().any(|f| f.0 == axis.coordinate)
        {
            fixed.push((axis.coordinate, value));
        }
    }
    let missing = |c: &Coordinate| usize::from(c.0) > given && !fixed.iter().any(|f| f.0 == *c);
    if let Some(c) = object.uses.iter().find(missing) {
        let title = format!("`{}` depends on {c}, and a point has {given} numbers", object.name);
        return Err(vec![
            Diagnostic::error("short-point", title).help(format!("give each point {} numbers, or --at {c}=...", c.0)),
        ]);
    }
    let subject = Subject::of(object.name.clone(), object.node, fixed);
    match at_points(&subject, &session.graph, points, gradient, &session.limits, &session.interrupt) {
        Ok(Ok(values)) => Ok(values),
        Ok(Err(_)) => Err(vec![cancelled()]),
        Err(told) => Err(vec![told]),
    }
}

/// What there is to know of one object without searching for its boundary.
#[derive(Clone, Debug)]
pub struct Info {
    object: Object,
    operations: usize,
}

/// What there is to know of each object of a session.
///
/// # Errors
/// Messages for the user, of all objects that fail.
pub fn info(session: &mut Session) -> Asked<Vec<Info>> {
    let mut all = Vec::new();
    let mut told = Vec::new();
    for name in session.objects() {
        match session.object(Some(&name)) {
            Ok(object) => {
                let operations = crate::field::operations(&session.graph, object.node);
                all.push(Info { object, operations });
            }
            Err(mut errors) => told.append(&mut errors),
        }
    }
    if told.is_empty() { Ok(all) } else { Err(told) }
}

impl Info {
    /// As JSON, with the keys that the manual lists.
    #[must_use]
    pub fn json(&self) -> Value {
        let object = &self.object;
        let coordinates: Vec<String> = object.uses.iter().map(|c| c.to_string()).collect();
        let types: Map<String, Value> =
            object.axes.iter().map(|a| (a.coordinate.to_string(), json!(role(&a.role)))).collect();
        let bounds: Map<String, Value> = object
            .axes
            .iter()
            .filter_map(|a| Some((a.coordinate.to_string(), json!([a.range?.0, a.range?.1]))))
            .collect();
        json!({
            "name": &*object.name, "doc": &*object.doc, "coordinates": coordinates, "types": types, "bounds": bounds,
            "route": "cubes", "operations": self.operations,
        })
    }
}

impl fmt::Display for Info {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let object = &self.object;
        let axes: Vec<String> = object
            .axes
            .iter()
            .map(|a| match a.range {
                Some((lo, hi)) => format!("{} : {} from {lo} to {hi}", a.coordinate, role(&a.role)),
                None => format!("{} : {}", a.coordinate, role(&a.role)),
            })
            .collect();
        let axes = if axes.is_empty() { "no coordinates".into() } else { axes.join(", ") };
        write!(f, "{}: {axes}; {} operations", object.name, self.operations)?;
        if let Some(line) = object.doc.lines().map(str::trim).find(|l| !l.is_empty()) {
            write!(f, "\n  {line}")?;
        }
        Ok(())
    }
}

/// A geometric type as the language writes it.
#[must_use]
pub fn role(role: &Role) -> String {
    match role {
        Role::X => "X".into(),
        Role::Y => "Y".into(),
        Role::Z => "Z".into(),
        Role::T => "T".into(),
        Role::V => "V".into(),
        Role::W => "W".into(),
        Role::C => "C".into(),
        Role::Constant(value) => format!("CONSTANT = {value}"),
        Role::Group(values) => format!("G = {values:?}"),
    }
}

/// The object that a view names as a subject, by itself.
///
/// # Errors
/// Messages for the user: what is missing or makes no sense.
pub(super) fn alone(session: &mut Session, view: &View, timing: &Timing) -> Asked<Subject> {
    let mut object = session.object(view.object.as_deref())?;
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
    let bounds = object.bounds().unwrap_or_else(|d| {
        told.push(d);
        Vec::new()
    });
    if !told.is_empty() {
        return Err(told);
    }
    subject.axes = object
        .space()
        .iter()
        .zip(bounds)
        .map(|(a, (lo, hi))| Axis { coordinate: a.coordinate, range: [lo, hi], order: order(&a.role) })
        .collect();
    subject.span = session.place(&object.name);
    subject.colouring = object.colour;
    Ok(subject)
}

/// Which of X, Y and Z a role is.
fn order(role: &Role) -> usize {
    [Role::X, Role::Y, Role::Z].iter().position(|known| known == role).unwrap_or(2)
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
                    object.axes.push(environment::Axis { coordinate: c, role, declared: false, range, delta: None });
                }
            }
        }
    }
    for &(c, value) in &view.at {
        if let Some(axis) = object.axes.iter_mut().find(|a| a.coordinate == c) {
            axis.role = Role::Constant(value);
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
