//! What is wrong with the arguments of STAR.

use crate::diagnostic::Diagnostic;
use crate::number::star::AXES;
use crate::source::Span;

use super::super::value::{self, Value};

const WHAT: &str = "STAR takes an array of polyhedra; a polyhedron is an array of half-spaces, and [a, b, c] is a*x1 + b*x2 + c*x3 <= 1";

fn bad(title: String, at: Span, label: &str) -> Diagnostic {
    Diagnostic::error("bad-star", title).at(at, label).help(WHAT)
}

/// A parameter that is not above 0.
pub fn star_exponent(p: f64, at: Span) -> Diagnostic {
    Diagnostic::error("bad-star", format!("a blending parameter of STAR is above 0, and this is {}", value::number(p)))
        .at(at, "")
        .help("1 or 2 is very smooth, 32 nearly sharp, INFINITY sharp")
}

/// Not one parameter for each polyhedron.
pub fn star_parameters(polyhedra: usize, parameters: usize, at: Span) -> Diagnostic {
    let title = format!("there are {polyhedra} polyhedra and {parameters} local blending parameters");
    Diagnostic::error("bad-star", title).at(at, "").help("give one number for all of them, or one for each")
}

/// Something that is no array of half-spaces.
pub fn star_kind(what: &str, found: &Value, at: Span) -> Diagnostic {
    bad(format!("{what} is {}", found.kind()), at, "")
}

/// A half-space that is no array.
pub fn star_row(i: usize, j: usize, found: &Value, at: Span) -> Diagnostic {
    bad(format!("half-space {} of polyhedron {} is {}", j + 1, i + 1, found.kind()), at, "")
}

/// A half-space of another length than those before, or of too many coordinates.
pub fn star_length((i, j): (usize, usize), length: Option<usize>, found: usize, at: Span) -> Diagnostic {
    let wanted = match length {
        Some(n) if n != found => format!("the others have {n}"),
        _ => format!("1 to {AXES} are possible"),
    };
    bad(format!("half-space {} of polyhedron {} has {found} coefficients; {wanted}", j + 1, i + 1), at, "")
}

/// A coefficient that is infinite or undefined.
pub fn star_coefficient(i: usize, j: usize, at: Span) -> Diagnostic {
    bad(format!("half-space {} of polyhedron {} has a coefficient that is not finite", j + 1, i + 1), at, "")
        .fact("the boundary of such a half-space would go through the origin, which must be inside")
}

/// No polyhedra, or one without half-spaces.
pub fn star_empty(i: Option<usize>, at: Span) -> Diagnostic {
    let title = i.map_or("there is no polyhedron".to_owned(), |i| format!("polyhedron {} has no half-space", i + 1));
    bad(title, at, "")
}
