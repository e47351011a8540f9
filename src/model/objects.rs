//! From a name to an [`Object`]: its function, its coordinates with their types and ranges, its levels.

use crate::diagnostic::{Diagnostic, Severity};
use crate::field::Coordinate;
use crate::syntax::tree::Name;

use super::environment::{self, Axis, Colour, Object, Role, Tint};
use super::errors;
use super::session::{Session, UNNAMED};
use super::state::{Declared, Entry, Kept};
use super::value::{Scalar, Value};

/// A value that can be asked for, or the messages that say why not.
type Asked<T> = Result<T, Vec<Diagnostic>>;

impl Session {
    /// The object of that name, ready to be compiled; without a name the last `gob_` defined.
    ///
    /// # Errors
    /// Messages for the user: an unknown name, one that fails, one that is no object, types that contradict each other.
    pub fn object(&mut self, name: Option<&str>) -> Asked<Object> {
        self.object_given(name, &|_| false)
    }

    /// The same, where the asker gives some coordinates their values: those need no type and no range.
    pub(super) fn object_given(&mut self, name: Option<&str>, given: &dyn Fn(Coordinate) -> bool) -> Asked<Object> {
        let name = match name {
            Some(name) => Name::from(name),
            None => self.last_object().ok_or_else(|| vec![no_object()])?,
        };
        self.refresh(&name);
        let scalar = self.function(&name)?;
        let node = scalar.node(&mut self.graph);
        let uses = self.graph.coordinates(node);
        let mut told = Vec::new();
        let mut axes = Vec::new();
        for c in (1..=16).map(Coordinate) {
            match self.axis(c, uses.contains(c)) {
                Ok(Some(axis)) => axes.push(axis),
                Ok(None) if uses.contains(c) && !given(c) => told.push(environment::untyped(&name, c)),
                Ok(None) => {}
                Err(mut errors) => told.append(&mut errors),
            }
        }
        told.extend(roles_clash(&axes));
        let (levels, center) = self.levels(&name).unwrap_or_else(|mut errors| {
            told.append(&mut errors);
            Default::default()
        });
        let colour = self.colour(&name).unwrap_or_else(|mut errors| {
            told.append(&mut errors);
            None
        });
        if !told.is_empty() {
            return Err(told);
        }
        let doc = self.doc(&name).unwrap_or_default().into();
        Ok(Object { name, doc, node, uses, axes, levels, center, colour })
    }

    /// The names of all objects in the order of the text.
    #[must_use]
    pub fn objects(&self) -> Vec<String> {
        self.names().into_iter().filter(|n| n.starts_with("gob_")).collect()
    }

    /// The message about a name that nothing defines.
    pub(super) fn unknown(&self, name: &str) -> Diagnostic {
        errors::unknown_name(&self.state, name, &[], false, &Default::default())
    }

    fn last_object(&self) -> Option<Name> {
        self.state.program().iter().rev().find_map(|entry| {
            let Entry::Definition(definition) = entry else { return None };
            let gob = |n: &&Name| n.starts_with("gob_") && self.state.is_current_for(n, definition);
            definition.outputs.iter().rev().find(gob).cloned()
        })
    }

    fn function(&self, name: &Name) -> Asked<Scalar> {
        if let (UNNAMED, Some(node)) = (&**name, self.unnamed) {
            return Ok(Scalar::Node(node));
        }
        match self.value(name) {
            Some(Ok(Value::Scalar(scalar))) => Ok(scalar),
            Some(Ok(other)) => Err(vec![
                Diagnostic::error("not-an-object", format!("`{name}` is {}, not an object", other.kind()))
                    .help("an object is a function of the coordinates: `gob_ball = 1 - x1**2 - x2**2 - x3**2;`"),
            ]),
            Some(Err(told)) => Err(vec![severe(&told)]),
            None if self.is_defined(name) => {
                Err(vec![Diagnostic::error("never-assigned", format!("`{name}` has no value"))])
            }
            None => Err(vec![self.unknown(name)]),
        }
    }

    /// A number of the environment, if it is set.
    fn setting(&self, name: &str) -> Asked<Option<f64>> {
        match self.value(name) {
            None => Ok(None),
            Some(Ok(Value::Scalar(Scalar::Number(value)))) if value.is_finite() => Ok(Some(value)),
            Some(Ok(other)) => {
                let told = Diagnostic::error("bad-setting", format!("`{name}` must be a number, not {}", other.kind()));
                let place = self.state.get(name).map(|d| d.place());
                Err(vec![place.into_iter().fold(told, |told, span| told.at(span, ""))])
            }
            Some(Err(told)) => Err(vec![severe(&told)]),
        }
    }

    fn axis(&self, c: Coordinate, used: bool) -> Asked<Option<Axis>> {
        let lo = self.setting(&format!("{c}min"))?;
        let hi = self.setting(&format!("{c}max"))?;
        let delta = self.setting(&format!("{c}_delta"))?;
        let range = lo.zip(hi);
        if let Some((lo, hi)) = range
            && lo >= hi
        {
            let place = |end: &str| self.state.get(&format!("{c}{end}")).map(|d| d.place());
            return Err(vec![errors::no_extent(c, (lo, place("min")), (hi, place("max")))]);
        }
        let declared = self.declared_role(&c.to_string())?;
        let is_declared = declared.is_some();
        let role = match declared.or_else(|| environment::default_role(c)) {
            Some(role) => role,
            None => match lo {
                Some(lo) => Role::Constant(lo),
                None => return Ok(None),
            },
        };
        let axis = Axis { coordinate: c, role, declared: is_declared, range, ends: (lo, hi), delta };
        let is_given = is_declared || lo.is_some() || hi.is_some();
        let shown = used || axis.is_space() && is_given;
        Ok(shown.then_some(axis))
    }

    fn declared_role(&self, subject: &str) -> Asked<Option<Role>> {
        let Some(declared) = self.state.declared(subject) else { return Ok(None) };
        let numbers = self.type_numbers(subject)?;
        Ok(environment::role(&declared.kind, &numbers))
    }

    /// The numbers behind the type that a coordinate or an object was declared with.
    fn type_numbers(&self, subject: &str) -> Asked<Vec<f64>> {
        let value = self.state.declared(subject).map(|declared| self.type_value(declared));
        Ok(value.transpose()?.flatten().map_or_else(Vec::new, |value| numbers(&value)))
    }

    /// What the expression of a declared type is worth.
    fn type_value(&self, declared: &Declared) -> Asked<Option<Value>> {
        match self.state.kept(declared.definition.id) {
            Some(Kept::One(value)) => Ok(Some(value.clone())),
            Some(Kept::Failed(told)) => Err(vec![severe(told)]),
            _ => Ok(None),
        }
    }

    /// The levels of an object's boundary, and its centre.
    #[allow(clippy::type_complexity)]
    fn levels(&self, name: &str) -> Asked<(Vec<f64>, Option<Vec<f64>>)> {
        let levels = match self.state.declared(name) {
            Some(_) => self.type_numbers(name)?,
            None => vec![0.0],
        };
        let center = self.state.declared_center(name).map(|declared| self.type_value(declared)).transpose()?;
        Ok((levels, center.flatten().map(|value| numbers(&value))))
    }

    /// `gob_a : COLOR = ...`, as nodes of the graph.
    fn colour(&mut self, name: &str) -> Asked<Option<Colour>> {
        let Some(declared) = self.state.declared_colour(name).cloned() else { return Ok(None) };
        let Some(Value::Array(array)) = self.type_value(&declared)? else { return Ok(None) };
        let scalar = |value: &Value| if let Value::Scalar(scalar) = value { Some(*scalar) } else { None };
        let mix = match array.items() {
            [r, g, b] => [r, g, b].map(scalar),
            [value, ..] => [scalar(value), None, None],
            [] => return Ok(None),
        };
        let graph = &mut self.graph;
        let mut node = |scalar: Option<Scalar>| scalar.map(|scalar| scalar.node(graph));
        let whole = declared.definition.statement.span;
        let place = declared.kind.expressions().next().map_or(whole, |e| e.span);
        let of = match (mix.map(&mut node), array.items()) {
            ([Some(r), Some(g), Some(b)], _) => Tint::Mix([r, g, b]),
            ([Some(value), ..], [_, range]) => Tint::Scale(value, [0, 1].map(|k| numbers(range)[k])),
            _ => return Ok(None),
        };
        Ok(Some(Colour { of, place }))
    }
}

/// A message that was a note when it was found, as the error that it is for who asks.
pub(super) fn severe(told: &Diagnostic) -> Diagnostic {
    Diagnostic { severity: Severity::Error, ..told.clone() }
}

fn numbers(value: &Value) -> Vec<f64> {
    match value {
        Value::Scalar(Scalar::Number(n)) => vec![*n],
        Value::Array(array) => array.items().iter().flat_map(numbers).collect(),
        _ => Vec::new(),
    }
}

/// Two coordinates that show the same.
fn roles_clash(axes: &[Axis]) -> Option<Diagnostic> {
    let unique = |role: &Role| !matches!(role, Role::Constant(_) | Role::Group(_));
    axes.iter().enumerate().find_map(|(i, a)| {
        let b = axes[..i].iter().find(|b| b.role == a.role && unique(&a.role))?;
        let (first, second) = (b.coordinate, a.coordinate);
        Some(
            Diagnostic::error("types-clash", format!("{first} and {second} have the same geometric type {:?}", a.role))
                .help(format!("give one of them another: `{second} : CONSTANT = 0;`")),
        )
    })
}

fn no_object() -> Diagnostic {
    Diagnostic::error("no-object", "nothing here is an object")
        .help("define one: `gob_ball = 1 - x1**2 - x2**2 - x3**2;`, or name one with --object")
}
