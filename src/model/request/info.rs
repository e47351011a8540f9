//! What there is to know of an object without looking for its boundary: coordinates, types, modelling space, the way to its boundary.

use std::fmt;

use serde_json::{Map, Value, json};

use crate::diagnostic::Diagnostic;
use crate::field::Coordinates;
use crate::model::environment::{Axis, Object, Role};
use crate::model::route::Told;
use crate::model::session::Session;

use super::space::plain;
use super::together::subject;
use super::{Timing, View};

/// What there is to know of one object.
#[derive(Clone, Debug)]
pub struct Info {
    object: Object,
    operations: usize,
    /// The ranges of the axes of space that a search found.
    found: Vec<(crate::field::Coordinate, [f64; 2])>,
    /// Why it cannot be shown as it is.
    told: Vec<Diagnostic>,
    products: Vec<[Coordinates; 2]>,
    /// The way to its boundary, where it has two or three axes of space.
    route: Option<Told>,
}

/// What there is to know of each object of a session, or of the one that is named.
///
/// # Errors
/// Messages for the user, of all objects that fail.
pub fn info(session: &mut Session, name: Option<&str>) -> Result<Vec<Info>, Vec<Diagnostic>> {
    let mut all = Vec::new();
    let mut told = Vec::new();
    let names = name.map_or_else(|| session.objects(), |name| vec![name.to_owned()]);
    for name in names {
        match of(session, &name) {
            Ok(info) => all.push(info),
            Err(mut errors) => told.append(&mut errors),
        }
    }
    if told.is_empty() { Ok(all) } else { Err(told) }
}

fn of(session: &mut Session, name: &str) -> Result<Info, Vec<Diagnostic>> {
    let object = session.object(Some(name))?;
    let operations = crate::field::operations(&session.graph, object.node);
    let products = session.cartesian(name);
    let (mut found, mut told) = (Vec::new(), Vec::new());
    let view = View { object: Some(name.to_owned()), ..View::default() };
    match subject(session, &view, &Timing::default()) {
        Ok(subject) => {
            let given = |c| object.axes.iter().any(|a| a.coordinate == c && a.range.is_some());
            found.extend(subject.axes.iter().filter(|a| !given(a.coordinate)).map(|a| (a.coordinate, a.range)));
        }
        Err(errors) if errors.iter().any(|e| e.code == "cancelled") => return Err(errors),
        Err(errors) => told = errors,
    }
    let route = match object.space().len() {
        2 | 3 => match session.route_of(&object) {
            Ok(route) => Some(route),
            Err(errors) if errors.iter().any(|e| e.code == "cancelled") => return Err(errors),
            Err(mut errors) => {
                told.append(&mut errors);
                None
            }
        },
        _ => None,
    };
    Ok(Info { object, operations, found, told, products, route })
}

impl Info {
    /// As JSON, with the keys that the manual lists.
    #[must_use]
    pub fn json(&self) -> Value {
        let object = &self.object;
        let names = |all: Coordinates| all.iter().map(|c| c.to_string()).collect::<Vec<_>>();
        let types: Map<String, Value> =
            object.axes.iter().map(|a| (a.coordinate.to_string(), json!(role(&a.role)))).collect();
        let given = object.axes.iter().filter_map(|a| Some((a.coordinate, [a.range?.0, a.range?.1])));
        let bounds: Map<String, Value> =
            given.chain(self.found.iter().copied()).map(|(c, range)| (c.to_string(), json!(range))).collect();
        let found: Vec<String> = self.found.iter().map(|(c, _)| c.to_string()).collect();
        let products: Vec<Value> = self
            .products
            .iter()
            .map(|&[a, b]| json!({ "left": names(a), "right": names(b), "shared": names(shared(a, b)) }))
            .collect();
        let (route, reason) = self.route();
        let told: Vec<&str> = self.told.iter().map(|told| told.title.as_str()).collect();
        json!({
            "name": &*object.name, "doc": object.doc.trim(), "coordinates": names(object.uses), "types": types,
            "bounds": bounds, "found": found, "route": route, "reason": reason, "operations": self.operations,
            "products": products, "errors": told, "centre": self.centre(), "equations": self.equations(),
            "broken_by": self.route.as_ref().and_then(|told| told.part.clone()),
        })
    }

    /// The centre of its rays, if it is a star.
    fn centre(&self) -> Option<&[f64]> {
        let star = self.route.as_ref()?.found.as_ref().ok()?;
        Some(&star.gauge.centre)
    }

    /// The ray forms and the boundary of a star; of what is none its ray form, if it has one.
    fn equations(&self) -> Vec<String> {
        match self.route.as_ref().map(|told| &told.found) {
            Some(Ok(star)) => star.equations.clone(),
            Some(Err(refusal)) => refusal.form.iter().map(|form| format!("f(c + t v) = {form}")).collect(),
            None => Vec::new(),
        }
    }

    /// How its boundary is found, and why so.
    fn route(&self) -> (&'static str, String) {
        match (&self.route, self.object.space().len()) {
            (Some(told), _) => (told.name(), told.reason()),
            (None, 1) => ("graph", "one axis of space: a graph, and intervals".into()),
            (None, 0) => ("none", "no axis of space".into()),
            (None, _) => ("none", "its centre makes no sense".into()),
        }
    }

    fn axis(&self, axis: &Axis) -> String {
        let c = axis.coordinate;
        let found = self.found.iter().find(|found| found.0 == c).map(|found| found.1);
        let range = match (axis.range, found) {
            (Some((lo, hi)), _) => format!(", {} to {}", plain(lo), plain(hi)),
            (None, Some([lo, hi])) => format!(", {} to {} (found)", plain(lo), plain(hi)),
            (None, None) => String::new(),
        };
        let steps = match (&axis.role, axis.delta) {
            (Role::T | Role::V | Role::W | Role::C, Some(delta)) => format!(" by {}", plain(delta)),
            _ => String::new(),
        };
        format!("{c} : {}{range}{steps}", role(&axis.role))
    }
}

impl fmt::Display for Info {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let object = &self.object;
        let kind = match object.space().len() {
            3 => "a solid",
            2 => "a plane figure",
            1 => "a function of one axis",
            _ => "a number",
        };
        let count = object.uses.iter().count();
        let plural = if count == 1 { "" } else { "s" };
        write!(f, "{}: {kind}, {count} coordinate{plural}, {} operations", object.name, self.operations)?;
        for line in object.doc.lines().map(str::trim).filter(|line| !line.is_empty()) {
            write!(f, "\n  {line}")?;
        }
        for axis in &object.axes {
            write!(f, "\n  {}", self.axis(axis))?;
        }
        if object.levels != [0.0] {
            let levels: Vec<String> = object.levels.iter().map(|&level| plain(level)).collect();
            write!(f, "\n  levels {}", levels.join(", "))?;
        }
        for &[a, b] in &self.products {
            let names = |all: Coordinates| all.iter().map(|c| c.to_string()).collect::<Vec<_>>().join(", ");
            write!(f, "\n  `@` joins {} with {}", names(a), names(b))?;
            match shared(a, b) {
                common if common.is_empty() => {}
                common => write!(f, "; both have {}, where it is `&`", names(common))?,
            }
        }
        match &self.route {
            Some(told) => told.lines().iter().try_for_each(|line| write!(f, "\n  {line}"))?,
            None => {
                let (route, reason) = self.route();
                write!(f, "\n  route {route}: {reason}")?;
            }
        }
        self.told.iter().try_for_each(|told| write!(f, "\n  not as it is: {}", told.title))
    }
}

fn shared(a: Coordinates, b: Coordinates) -> Coordinates {
    a.without(a.without(b))
}

/// A type in the words of the language.
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
