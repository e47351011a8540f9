//! Messages about questions that are asked of objects: what could not be decided, and what there is not.

use crate::diagnostic::Diagnostic;
use crate::field::{Coordinate, NodeId};
use crate::source::Span;
use crate::surface::query::Near;
use crate::vm::CompileError;

use super::super::value;

/// A point in words: `x1 = 1, x3 = 0.5`.
fn place(axes: &[Coordinate], point: &[f64]) -> String {
    let short = |c: f64| value::number(format!("{c:.5e}").parse::<f64>().unwrap_or(c) + 0.0);
    axes.iter().zip(point).map(|(axis, &c)| format!("{axis} = {}", short(c))).collect::<Vec<_>>().join(", ")
}

/// A question that the search could not decide; `what` says what is open: "whether the objects meet".
pub fn undecided(name: &str, what: &str, (axes, near): (&[Coordinate], &Near), boxes: usize, span: Span) -> Diagnostic {
    let told = Diagnostic::error("undecided", format!("{name} cannot decide {what}")).at(span, "");
    let told = if near.distance > 0.0 && near.distance.is_finite() {
        told.fact(format!("near {} it is a matter of about {:.0e}", place(axes, &near.place), near.distance))
    } else {
        told.fact(format!("it is a matter of what happens near {}", place(axes, &near.place)))
    };
    let told =
        if near.is_spent { told.fact(format!("{boxes} boxes were looked at, which is the limit")) } else { told };
    told.help("objects that just touch cannot be told from objects that just miss each other: move, grow or shrink one by a little")
}

/// There is no point to show.
pub fn no_witness(of_two: bool, span: Span) -> Diagnostic {
    let (title, help) = if of_two {
        ("no point belongs to both objects: it is proved that there is none", "ask INTERSECTS first, which is 0 here")
    } else {
        ("no point belongs to this object: it is proved that it is empty", "is its sign turned? `~g` is the complement")
    };
    Diagnostic::error("no-witness", title).at(span, "").help(help)
}

/// An object too large to be asked about.
pub fn question_too_large(name: &str, error: CompileError, span: Span) -> Diagnostic {
    Diagnostic::error("too-large", format!("{name} cannot ask about this object: {error}"))
        .at(span, "")
        .help("make it of fewer parts")
}

/// A question about something that is not known yet: it stands in a loop that runs at each point, or under DIFF by a parameter.
pub fn question_varies(name: &str, _object: NodeId, span: Span) -> Diagnostic {
    Diagnostic::error(
        "needs-constant",
        format!("{name} cannot be asked here, where the object differs from point to point"),
    )
    .at(span, "")
    .help("ask outside of DIFF and of loops whose condition depends on coordinates")
}

fn list(axes: &[Coordinate]) -> String {
    axes.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ")
}

/// Something measured of an object of too many coordinates.
pub fn measure_dimension(name: &str, axes: &[Coordinate], span: Span) -> Diagnostic {
    let title = format!("{name} measures objects of one to three coordinates, and this one uses {}", list(axes));
    let last = axes.last().map(ToString::to_string).unwrap_or_default();
    Diagnostic::error("dimension", title)
        .at(span, "")
        .help(format!("take a section of it: `{name}(g AT ({last} = 0))`"))
}

/// Something measured of a number.
pub fn measure_of_number(name: &str, span: Span) -> Diagnostic {
    Diagnostic::error(
        "not-an-object",
        format!("{name} asks about an object, a function of the coordinates, and this is a number"),
    )
    .at(span, "a number")
}

/// Something measured of an object that goes on without end.
pub fn measure_endless(name: &str, axes: &[Coordinate], ends: &[(usize, bool)], span: Span) -> Diagnostic {
    let words: Vec<String> =
        ends.iter().map(|&(axis, up)| format!("{}{}", if up { '+' } else { '-' }, axes[axis])).collect();
    let cut = ends.first().map_or(axes[0], |end| axes[end.0]);
    Diagnostic::error(
        "endless-object",
        format!("{name} cannot measure this object, which goes on without end towards {}", words.join(", ")),
    )
    .at(span, "")
    .help(format!("cut it: `g & (10 - ABS({cut}))`, say"))
    .help("inside is where the function is >= 0: if it is written with inside negative, put `-` before it")
}

/// Something that an empty object does not have.
pub fn measure_of_nothing(name: &str, span: Span) -> Diagnostic {
    Diagnostic::error("empty-object", format!("{name} has no answer for an object that is empty, or a point at most"))
        .at(span, "")
        .help("inside is where the function is >= 0: if it is written with inside negative, put `-` before it")
}

/// An object of which no point was found, though there may be some.
pub fn measure_unknown(name: &str, span: Span) -> Diagnostic {
    Diagnostic::error("empty-object", format!("{name} found no point of this object, and no proof that it is empty"))
        .at(span, "")
        .help("cut it down to where it lies: `g & (10 - ABS(x1))`, say")
}

/// Something that objects of that many coordinates do not have.
pub fn measure_missing(name: &str, axes: usize, span: Span) -> Diagnostic {
    let (what, help) = match axes {
        1 => (
            "an object of one coordinate",
            "VOLUME is its length, BOUNDS where it ends, COMPONENTS how many intervals it has",
        ),
        2 => (
            "this plane figure",
            "AREA, PERIMETER, CENTROID, INERTIA, COMPONENTS, GENUS and MEAN_CURVATURE are measured of one",
        ),
        _ => ("this solid", "no part of its boundary is smooth enough, or it has none of that"),
    };
    Diagnostic::error("not-measured", format!("{name} is not known of {what}")).at(span, "").help(help)
}

/// A number of cells that makes no sense.
pub fn bad_cells(cells: f64, most: usize, span: Span) -> Diagnostic {
    Diagnostic::error("resolution", format!("{} cells along the longest side", value::number(cells)))
        .at(span, "")
        .help(format!("a whole number between 1 and {most} is possible"))
}

/// The uncertainty of something that has none.
pub fn no_uncertainty(span: Span) -> Diagnostic {
    Diagnostic::error(
        "no-uncertainty",
        "UNCERTAINTY is that of a question which it holds, and this is none with an estimated answer",
    )
    .at(span, "")
    .help("write `UNCERTAINTY(VOLUME(g))`, with AREA, CENTROID, INERTIA, BOUNDS or a curvature alike")
}

/// A point with fewer numbers than the object has coordinates.
pub fn short_point(name: &str, needs: usize, given: usize, span: Span) -> Diagnostic {
    Diagnostic::error("short-point", format!("the point of {name} has {given} numbers, and the object uses x{needs}"))
        .at(span, "")
        .help(format!("give {needs} numbers, 0 for coordinates that do not matter"))
}

/// A point at infinity, or undefined.
pub fn point_not_finite(name: &str, span: Span) -> Diagnostic {
    Diagnostic::error("infinite", format!("the point of {name} has a coordinate that is not finite"))
        .at(span, "")
        .help("give a point by numbers")
}

/// Curves of objects of one coordinate, or of four.
pub fn curve_dimension(axes: usize, span: Span) -> Diagnostic {
    Diagnostic::error(
        "dimension",
        format!("CURVE is of two solids or two plane figures, and these use {axes} coordinates together"),
    )
    .at(span, "")
    .help("take sections by AT, or ask INTERSECTS and WITNESS, which take any number")
}

/// No curves for a reason of the grid or the boundary.
pub fn no_curve(why: &str, span: Span) -> Diagnostic {
    Diagnostic::error("not-measured", format!("CURVE found no answer: {why}"))
        .at(span, "")
        .help("another number of cells, as in `CURVE(g1, g2, 200)`, usually has one")
}
