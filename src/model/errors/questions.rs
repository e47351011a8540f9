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
    let told = if near.is_spent { told.fact(format!("{boxes} boxes were looked at, which is the limit")) } else { told };
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
    Diagnostic::error("needs-constant", format!("{name} cannot be asked here, where the object differs from point to point"))
        .at(span, "")
        .help("ask outside of DIFF and of loops whose condition depends on coordinates")
}
