//! The environment section: geometric types, the modelling space, and what they make of an object. Draws nothing.

use std::sync::Arc;

use crate::diagnostic::Diagnostic;
use crate::field::{Coordinate, Coordinates, NodeId};
use crate::source::Span;
use crate::syntax::tree::{GeometricType, Name};

/// What a coordinate shows.
#[derive(Clone, Debug, PartialEq)]
pub enum Role {
    /// The first axis of space.
    X,
    /// The second.
    Y,
    /// The third.
    Z,
    /// Time: frames.
    T,
    /// Columns of a sheet.
    V,
    /// Rows of a sheet.
    W,
    /// Colour.
    C,
    /// A single section at this value.
    Constant(f64),
    /// A group of sections in one picture.
    Group(Vec<f64>),
}

/// A coordinate of an object with what is known of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Which.
    pub coordinate: Coordinate,
    /// What it shows.
    pub role: Role,
    /// Whether the type was declared, not taken by default.
    pub declared: bool,
    /// `x1min`, `x1max`, if both are given.
    pub range: Option<(f64, f64)>,
    /// Each of them, if it is given.
    pub ends: (Option<f64>, Option<f64>),
    /// `x1_delta`.
    pub delta: Option<f64>,
}

impl Axis {
    /// Whether it is an axis of space.
    #[must_use]
    pub fn is_space(&self) -> bool {
        matches!(self.role, Role::X | Role::Y | Role::Z)
    }

    /// The values that this coordinate takes one after the other: frames of T, columns and rows of V and W, sections of G and C; the
    /// single value of CONSTANT. Nothing for the axes of space, and where the range is missing. A negative delta counts backwards.
    /// What would take more than `limit` ends behind one more.
    #[must_use]
    pub fn steps(&self, limit: usize) -> Vec<f64> {
        match (&self.role, self.range) {
            (Role::Constant(value), _) => vec![*value],
            (Role::Group(values), _) => values.clone(),
            (Role::T | Role::V | Role::W, Some((lo, hi))) => steps(lo, hi, self.delta.unwrap_or(hi - lo), limit),
            // A spectrum is read off its legend: eight steps show it where none is given.
            (Role::C, Some((lo, hi))) => steps(lo, hi, self.delta.unwrap_or((hi - lo) / 8.0), limit),
            _ => Vec::new(),
        }
    }
}

/// From `lo` to `hi` by `delta`, both ends included where they are met; backwards for a negative one.
fn steps(lo: f64, hi: f64, delta: f64, limit: usize) -> Vec<f64> {
    if delta == 0.0 || !delta.is_finite() || hi < lo {
        return vec![lo];
    }
    // A hair of a step is forgiven, so that 0 to 1 by 0.1 has eleven steps.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    let turns = (((hi - lo) / delta.abs() + 1e-9).floor() as usize).min(limit);
    #[allow(clippy::cast_precision_loss)]
    let at = |k: usize| if delta > 0.0 { lo + k as f64 * delta } else { hi + k as f64 * delta };
    (0..=turns).map(at).collect()
}

/// An object, ready to be compiled.
#[derive(Clone, Debug)]
pub struct Object {
    /// Its name.
    pub name: Name,
    /// Its documentation; empty if there is none.
    pub doc: Arc<str>,
    /// Its defining function in the session's graph.
    pub node: NodeId,
    /// The coordinates that the function depends on.
    pub uses: Coordinates,
    /// Its coordinates, in ascending order: those that it uses, and the axes of space that were declared or have a range.
    pub axes: Vec<Axis>,
    /// The level of its boundary, or several: `gob_a : CONSTANT = 0.2`, `gob_a : G = [..]`; 0 if nothing was said.
    pub levels: Vec<f64>,
    /// `gob_a : CENTER = [0, 0, 0]`.
    pub center: Option<Vec<f64>>,
    /// `gob_a : COLOR = [1, 0.5, 0]`.
    pub colour: Option<Colour>,
}

/// The colour of an object, which may differ from point to point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Colour {
    /// What it is made of.
    pub of: Tint,
    /// The statement that says it.
    pub place: Span,
}

/// What a colour is made of, as nodes of the session's graph.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Tint {
    /// Red, green and blue, each 0 to 1.
    Mix([NodeId; 3]),
    /// A value that a palette shows, from the first of two numbers to the second.
    Scale(NodeId, [f64; 2]),
}

impl Tint {
    /// The nodes.
    #[must_use]
    pub fn nodes(&self) -> Vec<NodeId> {
        match self {
            Self::Mix(mix) => mix.to_vec(),
            Self::Scale(value, _) => vec![*value],
        }
    }
}

impl Object {
    /// The axes of space in the order X, Y, Z.
    #[must_use]
    pub fn space(&self) -> Vec<&Axis> {
        let order = |role: &Role| [Role::X, Role::Y, Role::Z].iter().position(|r| r == role);
        let mut axes: Vec<&Axis> = self.axes.iter().filter(|a| a.is_space()).collect();
        axes.sort_by_key(|a| order(&a.role));
        axes
    }
}

/// The number of a coordinate's name: 4 for `x4` and `X4`.
#[must_use]
pub fn coordinate(name: &str) -> Option<u8> {
    let digits = name.strip_prefix(['x', 'X'])?;
    let number: u8 = digits.parse().ok()?;
    ((1..=16).contains(&number) && !digits.starts_with(['0', '+'])).then_some(number)
}

/// Whether the name is a setting of the environment (`x1min`, `x4_delta`): read by the tool, not by definitions.
#[must_use]
pub fn is_setting(name: &str) -> bool {
    let rest = name.strip_suffix("min").or_else(|| name.strip_suffix("max")).or_else(|| name.strip_suffix("_delta"));
    rest.is_some_and(|c| c.starts_with('x') && coordinate(c).is_some())
}

/// The setting that a name was probably meant to be: `x1min` for `x1_min` and `X1Min`.
#[must_use]
pub fn nearly_setting(name: &str) -> Option<String> {
    if is_setting(name) {
        return None;
    }
    let plain: String = name.chars().filter(|c| *c != '_').collect::<String>().to_ascii_lowercase();
    let (c, end) = ["min", "max", "delta"].iter().find_map(|end| Some((plain.strip_suffix(end)?, *end)))?;
    let c = Coordinate(coordinate(c)?);
    Some(if end == "delta" { format!("{c}_delta") } else { format!("{c}{end}") })
}

/// The type that a coordinate has if nothing was declared.
#[must_use]
pub fn default_role(c: Coordinate) -> Option<Role> {
    match c.0 {
        1 => Some(Role::X),
        2 => Some(Role::Y),
        3 => Some(Role::Z),
        4 => Some(Role::T),
        _ => None,
    }
}

/// A declared type as a role; the numbers come from its expression.
#[must_use]
pub fn role(kind: &GeometricType, numbers: &[f64]) -> Option<Role> {
    Some(match kind {
        GeometricType::X => Role::X,
        GeometricType::Y => Role::Y,
        GeometricType::Z => Role::Z,
        GeometricType::T => Role::T,
        GeometricType::V => Role::V,
        GeometricType::W => Role::W,
        GeometricType::C => Role::C,
        GeometricType::Constant(_) => Role::Constant(numbers.first().copied().unwrap_or(0.0)),
        GeometricType::Group(_) => Role::Group(numbers.to_vec()),
        GeometricType::Center(_) | GeometricType::Color(..) => return None,
    })
}

/// A coordinate that shows nothing and has no range.
#[must_use]
pub fn untyped(name: &str, c: Coordinate) -> Diagnostic {
    Diagnostic::error("untyped-coordinate", format!("`{name}` uses {c}, which has no geometric type and no range"))
        .help(format!("say what it shows: `{c} : CONSTANT = 0;` for a section, or `{c} : T;` with {c}min, {c}max and {c}_delta for frames"))
        .help(format!("or on the command line: --at {c}=0"))
}
