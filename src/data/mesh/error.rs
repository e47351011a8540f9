//! What can be wrong with a mesh, in the user's words. Holds no bytes and no places in a script: the model adds those.

use std::fmt;

use crate::interrupt::Cancelled;

use super::super::obj::ObjError;

/// Why a file could not become a solid. `Display` says what was found; [`MeshError::help`] says what to do.
#[derive(Clone, Debug, PartialEq)]
pub enum MeshError {
    /// Neither `.obj` nor `.stl`.
    UnknownFormat,
    /// A line of a text makes no sense.
    Line {
        /// The line, counted from 1.
        line: usize,
        /// What is wrong.
        what: String,
    },
    /// A binary STL whose length is not that of the triangles that it promises.
    Count {
        /// How many it promises.
        promised: u64,
        /// For how many there are bytes.
        found: u64,
    },
    /// An STL that ends before its first triangle.
    Truncated,
    /// A corner of a binary STL is not finite.
    Corner {
        /// The triangle, counted from 1.
        triangle: usize,
    },
    /// No triangle with an area.
    Empty,
    /// More vertices or triangles than 32 bits count.
    TooMany,
    /// It would take more than the limit.
    TooLarge {
        /// Bytes that it would take.
        bytes: usize,
        /// The limit.
        limit: usize,
    },
    /// Some edges do not have as many triangles on one side as on the other.
    Open {
        /// How many.
        open: usize,
        /// Of so many.
        edges: usize,
        /// The ends of one of them.
        at: [[f64; 3]; 2],
    },
    /// A surface with one side only, as Moebius' or Klein's.
    OneSided {
        /// The ends of an edge where it meets itself the wrong way round.
        at: [[f64; 3]; 2],
    },
    /// It holds nothing: its parts cancel.
    NoInside,
    /// Stopped by the user.
    Cancelled,
}

impl MeshError {
    /// What the user can do about it.
    #[must_use]
    pub fn help(&self) -> String {
        match self {
            Self::UnknownFormat => "use an .obj or .stl file".into(),
            Self::Line { .. } | Self::Corner { .. } => "mend it there, or write the file again".into(),
            Self::Count { .. } | Self::Truncated => "the file is damaged or cut short: fetch it again".into(),
            Self::Empty => "the file must hold triangles: `f` lines in an OBJ, facets in an STL".into(),
            Self::TooMany | Self::TooLarge { .. } => "simplify the mesh first".into(),
            Self::Open { .. } => "a solid needs a closed surface: fill the holes and join double vertices in the program that it comes from".into(),
            Self::OneSided { .. } => "a solid needs a surface with an inside: cut the surface there, or give it a thickness".into(),
            Self::NoInside => "a solid needs a surface that goes once around something".into(),
            Self::Cancelled => String::new(),
        }
    }
}

impl fmt::Display for MeshError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::UnknownFormat => write!(f, "this is not a mesh file of a known kind"),
            Self::Line { line, what } => write!(f, "line {line}: {what}"),
            Self::Count { promised, found } if found == promised => {
                write!(f, "the file promises {promised} triangles, and has bytes behind them")
            }
            Self::Count { promised, found } => {
                write!(f, "the file promises {promised} triangles, and has bytes for {found}")
            }
            Self::Truncated => write!(f, "the file ends before the first triangle"),
            Self::Corner { triangle } => write!(f, "a corner of triangle {triangle} is not finite"),
            Self::Empty => write!(f, "there is no triangle in it"),
            Self::TooMany => write!(f, "the mesh has more vertices or triangles than can be counted"),
            Self::TooLarge { bytes, limit } => write!(f, "the mesh would take {bytes} bytes; the limit is {limit}"),
            Self::Open { open, edges, at } => {
                write!(f, "the mesh is open: {open} of its {edges} edges miss a triangle, as that from {}", ends(at))
            }
            Self::OneSided { at } => {
                write!(
                    f,
                    "the mesh has no inside: its surface meets itself the wrong way round at the edge from {}",
                    ends(at)
                )
            }
            Self::NoInside => write!(f, "the mesh holds no space: its sides cancel"),
            Self::Cancelled => write!(f, "cancelled"),
        }
    }
}

/// Two places in words.
fn ends([a, b]: &[[f64; 3]; 2]) -> String {
    format!("{} to {}", place(*a), place(*b))
}

/// A place in words, six digits each.
pub(super) fn place([x, y, z]: [f64; 3]) -> String {
    let short = |c: f64| format!("{c:.5e}").parse::<f64>().unwrap_or(c);
    format!("({}, {}, {})", short(x), short(y), short(z))
}

impl std::error::Error for MeshError {}

impl From<Cancelled> for MeshError {
    fn from(_: Cancelled) -> Self {
        Self::Cancelled
    }
}

impl From<ObjError> for MeshError {
    fn from(error: ObjError) -> Self {
        Self::Line { line: error.line, what: error.what }
    }
}
