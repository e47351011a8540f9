//! The way to a boundary as the user asks for it: the route, the guide shape, the centre; and what becomes of a guide's name. Makes no mesh.

use std::path::{Path, PathBuf};

use crate::data::obj;
use crate::diagnostic::{Category, Diagnostic};
use crate::field::{Coordinate, NodeId};
use crate::model::session::Session;
use crate::model::value::{Scalar, Value};
use crate::surface::star::guide::{Guide, LEVELS, Solid};
use crate::vm::{Demand, Points, Program};

/// Sides of a polygon at most, and steps around a surface of the user's.
const MOST: usize = 8192;

/// How the boundary is found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Route {
    /// By the star route where it is proved to be right, else by cubes.
    #[default]
    Auto,
    /// By the star route, or not at all.
    Star,
    /// By cubes, whatever the object is.
    Cubes,
}

impl Route {
    /// Their names.
    pub const NAMES: [&'static str; 3] = ["auto", "star", "cubes"];

    /// The route of that name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        match name {
            "auto" => Some(Self::Auto),
            "star" => Some(Self::Star),
            "cubes" => Some(Self::Cubes),
            _ => None,
        }
    }
}

/// The guide shape of the star route.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Choice {
    /// One that follows the shape at the resolution that is asked for.
    #[default]
    Following,
    /// A solid, subdivided so many times.
    Solid(Solid, usize),
    /// A regular polygon, for plane figures.
    Polygon(usize),
    /// A closed surface of triangles.
    File(PathBuf),
    /// The program's own surface: an array of three functions of x1, around, and x2, from pole to pole, both from 0 to 1; in so many steps.
    Named(String, usize),
}

impl Choice {
    /// Reads `following`, `sphere:5`, `icosahedron:4`, `polygon:64`, `shape.obj` or `name:64`.
    ///
    /// # Errors
    /// What is wrong, in words.
    pub fn read(text: &str) -> Result<Self, String> {
        if Path::new(text).extension().is_some_and(|e| e.eq_ignore_ascii_case("obj")) {
            return Ok(Self::File(text.into()));
        }
        if text == "following" {
            return Ok(Self::Following);
        }
        let (name, number) = text.split_once(':').map_or((text, None), |(name, number)| (name, Some(number)));
        let number = number.map(|n| n.parse::<usize>().map_err(|_| format!("`{n}` is no whole number"))).transpose()?;
        let within = |n: usize, least: usize, most: usize| {
            if (least..=most).contains(&n) {
                Ok(n)
            } else {
                Err(format!("{name} takes a number from {least} to {most}"))
            }
        };
        if let Some(solid) = Solid::from_name(name) {
            return Ok(Self::Solid(solid, within(number.unwrap_or(5), 0, LEVELS)?));
        }
        if name == "polygon" {
            return Ok(Self::Polygon(within(number.unwrap_or(64), 3, MOST)?));
        }
        let is_name = !name.is_empty() && name.chars().all(|c| c.is_alphanumeric() || c == '_');
        match number {
            Some(n) if is_name => Ok(Self::Named(name.into(), within(n, 8, MOST)?)),
            _ => Err(format!("`{text}` is no guide: expected {}", Self::FORMS)),
        }
    }

    /// What can be written.
    pub const FORMS: &'static str = "following, sphere:5, icosahedron:5, octahedron:5, cube:5, tetrahedron:5, polygon:64, a file.obj, or \
                                     NAME:64 of an array of three functions of x1 and x2";
}

impl std::fmt::Display for Choice {
    /// What [`Choice::read`] reads.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Following => f.write_str("following"),
            Self::Solid(solid, level) => write!(f, "{}:{level}", solid.name()),
            Self::Polygon(corners) => write!(f, "polygon:{corners}"),
            Self::File(path) => write!(f, "{}", path.display()),
            Self::Named(name, steps) => write!(f, "{name}:{steps}"),
        }
    }
}

/// A guide that is ready: directions and how they hang together.
#[derive(Clone, Debug, PartialEq)]
pub enum Ready {
    /// The one that follows the shape.
    Following,
    /// Of a solid.
    Solid(Guide),
    /// Of a plane figure.
    Polygon(Vec<[f64; 2]>),
}

impl Ready {
    /// The guide of that name.
    ///
    /// # Errors
    /// A message: a file that cannot be read, a surface that is not closed or not star-shaped.
    pub fn of(session: &Session, choice: &Choice) -> Result<Self, Diagnostic> {
        Ok(match choice {
            Choice::Following => Self::Following,
            Choice::Solid(solid, level) => {
                let bytes = 200 * solid.vertices(*level);
                if bytes > session.limits.memory_bytes {
                    let title = format!("`{}:{level}` would take more memory than there may be", solid.name());
                    return Err(Diagnostic::error("too-much-memory", title)
                        .category(Category::Result)
                        .help("each level less takes a quarter of it"));
                }
                Self::Solid(solid.guide(*level))
            }
            Choice::Polygon(corners) => Self::Polygon(crate::surface::star::mesh::circle(*corners)),
            Choice::File(path) => {
                let bytes = session.host.read(path, session.limits.data_bytes).map_err(|error| error.diagnostic())?;
                let name = path.display().to_string();
                let surface = obj::read(&bytes).map_err(|error| bad(&name, &error.to_string()))?;
                let guide = Guide::of_mesh(&surface.positions, &surface.triangles);
                Self::Solid(guide.map_err(|error| bad(&name, &error.to_string()))?)
            }
            Choice::Named(name, steps) => Self::Solid(named(session, name, *steps)?),
        })
    }
}

fn bad(name: &str, what: &str) -> Diagnostic {
    Diagnostic::error("bad-guide", format!("`{name}` is no guide shape: {what}"))
        .category(Category::Usage)
        .help("a guide is a closed surface that every ray from its middle meets once")
}

/// The surface of three functions of the program.
fn named(session: &Session, name: &str, steps: usize) -> Result<Guide, Diagnostic> {
    let missing = || {
        bad(name, "it is not an array of three functions of x1 and x2")
            .help("`ring = [COS(2*PI*x1)*SIN(PI*x2), SIN(2*PI*x1)*SIN(PI*x2), COS(PI*x2)];`")
    };
    let Some(Ok(Value::Array(array))) = session.value(name) else { return Err(missing()) };
    let mut graph = session.graph.clone();
    let nodes: Vec<NodeId> = array
        .items()
        .iter()
        .filter_map(
            |value| if let Value::Scalar(scalar) = value { Some(Scalar::node(*scalar, &mut graph)) } else { None },
        )
        .collect();
    let [_, _, _] = nodes[..] else { return Err(missing()) };
    let (around, along) = (steps, steps / 2);
    // The rings from pole to pole, closed in themselves: one more point around, which must be the first again.
    let mut places: Vec<[f64; 2]> = Vec::new();
    for k in 0..=along {
        places.extend((0..=around).map(|i| [i as f64 / around as f64, k as f64 / along as f64]));
    }
    let columns: [Vec<f64>; 2] = [0, 1].map(|d| places.iter().map(|p| p[d]).collect());
    let mut values = [vec![0.0; places.len()], vec![0.0; places.len()], vec![0.0; places.len()]];
    for (node, out) in nodes.iter().zip(&mut values) {
        let program = Program::compile(&graph, *node, &[Coordinate(1), Coordinate(2)], Demand::Value, &session.limits);
        let program = program.map_err(|_| missing())?;
        Points::new().eval(&program, &[&columns[0], &columns[1]], out);
    }
    let point = |k: usize, i: usize| [0, 1, 2].map(|d| values[d][k * (around + 1) + i]);
    let size = values.iter().flatten().fold(0.0_f64, |m, v| m.max(v.abs()));
    let apart = |a: [f64; 3], b: [f64; 3]| !(0..3).all(|d| (a[d] - b[d]).abs() <= 1e-9 * size);
    let is_open = (0..=along).any(|k| apart(point(k, 0), point(k, around)));
    let has_poles = (0..=around).all(|i| !apart(point(0, i), point(0, 0)) && !apart(point(along, i), point(along, 0)));
    if is_open || !has_poles {
        let what = if is_open {
            "it does not meet itself at x1 = 0 and x1 = 1"
        } else {
            "it has no poles at x2 = 0 and x2 = 1"
        };
        return Err(bad(name, what));
    }
    let mut positions = vec![point(0, 0)];
    for k in 1..along {
        positions.extend((0..around).map(|i| point(k, i)));
    }
    positions.push(point(along, 0));
    let last = positions.len() as u32 - 1;
    let at = |k: usize, i: usize| match k {
        0 => 0,
        k if k == along => last,
        k => (1 + (k - 1) * around + i % around) as u32,
    };
    let mut triangles = Vec::new();
    for k in 0..along {
        for i in 0..around {
            let [a, b, c, d] = [at(k, i), at(k, i + 1), at(k + 1, i), at(k + 1, i + 1)];
            triangles
                .extend([[a, c, b], [b, c, d]].into_iter().filter(|t| t[0] != t[1] && t[1] != t[2] && t[2] != t[0]));
        }
    }
    Guide::of_mesh(&positions, &triangles).map_err(|error| bad(name, &error.to_string()))
}
