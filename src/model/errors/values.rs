//! Messages about values: kinds, numbers, arrays, loops, limits.

use crate::builtins::Builtin;
use crate::diagnostic::Diagnostic;
use crate::field::region::{DEPTH, Refused};
use crate::field::{Coordinate, Coordinates};
use crate::number::Binary;
use crate::source::Span;
use crate::syntax::tree::{ChainOp, FoldOp};

use super::super::lower::{Fault, Lowered};
use super::super::value::{self, Scalar, Value};
use super::count;

/// What messages call an operand of a set operation or a truth.
pub fn operand_of(op: ChainOp) -> &'static str {
    match op {
        ChainOp::Or => "an operand of OR",
        ChainOp::And => "an operand of AND",
        ChainOp::Union => "an operand of `|`",
        ChainOp::Subtract => "an operand of `\\`",
        ChainOp::Intersect => "an operand of `&`",
        ChainOp::Product => "an operand of `@`",
        ChainOp::Add | ChainOp::Sub | ChainOp::Mul | ChainOp::Div => "an operand",
    }
}

/// What messages call an operand of a fold.
pub fn folded(op: FoldOp) -> &'static str {
    match op {
        FoldOp::Sum => "an operand of SUM",
        FoldOp::Product => "an operand of PRODUCT",
        FoldOp::Union => "an operand of UNION",
        FoldOp::Intersection => "an operand of INTERSECTION",
        FoldOp::Minimum => "an operand of MINIMUM",
        FoldOp::Maximum => "an operand of MAXIMUM",
        FoldOp::Array => "an element of ARRAY",
    }
}

/// Something that must be a number or a function of the coordinates.
pub fn needs_scalar(place: &str, value: &Value, span: Span) -> Diagnostic {
    let told = Diagnostic::error("needs-number", format!("{place} cannot be {}", value.kind())).at(span, value.kind());
    match value {
        Value::Array(_) => told.help("name an element with `[i]`, or fold it: SUM, MAXIMUM, UNION ..."),
        Value::Function(f) => told.help(format!("call it: `{}`", f.signature())),
        _ => told,
    }
}

/// Something that must be a number, the same at every point.
pub fn needs_number(place: &str, coordinates: Coordinates, span: Span) -> Diagnostic {
    Diagnostic::error("needs-constant", format!("{place} cannot depend on {}", list(coordinates)))
        .at(span, "differs from point to point")
}

/// Something that must be an array of numbers.
pub fn needs_numbers(place: &str, value: &Value, span: Span) -> Diagnostic {
    Diagnostic::error("needs-numbers", format!("{place} needs an array of numbers, not {}", value.kind()))
        .at(span, value.kind())
        .help("write it like `[0, 1, 2]`")
}

/// A COLOR that is neither red, green and blue nor one value.
pub fn bad_colour(value: &Value, span: Span) -> Diagnostic {
    let found = match value {
        Value::Array(a) if a.items().iter().all(|v| matches!(v, Value::Scalar(_))) => {
            format!("an array of {}", a.items().len())
        }
        Value::Array(_) => "an array of arrays".to_owned(),
        other => other.kind().to_owned(),
    };
    let title = format!("COLOR needs red, green and blue, or one value for the palette, not {found}");
    Diagnostic::error("bad-colour", title)
        .at(span, found)
        .help("write red, green and blue from 0 to 1, `COLOR = [1, 0.5, 0]`")
        .help("or a value and the range that the palette shows, `COLOR = x3 IN [-1, 1]`")
}

/// A part of a COLOR that is known to lie outside of 0 to 1.
pub fn colour_outside(v: f64, span: Span) -> Diagnostic {
    let help =
        if v > 1.0 && v <= 255.0 { "divide by 255: `[r, g, b]/255`" } else { "write `COLOR = [1, 0.5, 0]`, say" };
    Diagnostic::error(
        "bad-colour",
        format!("red, green and blue go from 0 to 1, and one of them is {}", value::number(v)),
    )
    .at(span, "")
    .help(help)
}

/// A range behind red, green and blue.
pub fn colour_with_range(span: Span) -> Diagnostic {
    Diagnostic::error("bad-colour", "red, green and blue are shown as they are; a range belongs to one value")
        .at(span, "")
        .help("leave out `IN [...]`, or give one value: `COLOR = x3 IN [-1, 1]`")
}

/// Something that must be a text.
pub fn needs_text(place: &str, value: &Value, span: Span) -> Diagnostic {
    Diagnostic::error("needs-text", format!("{place} must be a text in quotes, not {}", value.kind()))
        .at(span, value.kind())
}

fn list(coordinates: Coordinates) -> String {
    let named = coordinates.iter().filter(|c| usize::from(c.0) <= Coordinate::NAMED);
    let names: Vec<String> = named.map(|c| c.to_string()).collect();
    if names.is_empty() { "what DIFF varies".to_owned() } else { names.join(", ") }
}

/// A `gob_` is a number or a function of the coordinates.
///
/// # Errors
/// If the value is something else.
pub fn check_object(name: &str, value: &Value, span: Span) -> Lowered<()> {
    match value {
        Value::Array(_) | Value::Text(_) | Value::Function(_) if name.starts_with("gob_") => {
            let title = format!("`{name}` is an object, a function of the coordinates, and cannot be {}", value.kind());
            Err(Diagnostic::error("not-an-object", title)
                .at(span, value.kind())
                .help("a name without `gob_` may hold anything")
                .into())
        }
        _ => Ok(()),
    }
}

/// Arithmetic on a text or a function.
pub fn no_arithmetic(value: &Value, span: Span) -> Diagnostic {
    let told = Diagnostic::error("no-arithmetic", format!("{} has no arithmetic", value.kind())).at(span, value.kind());
    match value {
        Value::Function(f) => told.help(format!("call it: `{}`", f.signature())),
        _ => told,
    }
}

/// Arrays of two lengths in one operation.
pub fn lengths_differ(a: usize, b: usize, at: Span, bt: Span) -> Diagnostic {
    Diagnostic::error("lengths-differ", format!("an array of {a} and one of {b} cannot be combined by element"))
        .at(bt, count(b, "element"))
        .see(at, count(a, "element"))
}

/// A text or a function in an array.
pub fn not_an_element(value: &Value, span: Span) -> Diagnostic {
    Diagnostic::error("not-an-element", format!("{} cannot be an element of an array", value.kind())).at(span, "")
}

/// An index on something that is no array.
pub fn not_an_array(value: &Value, span: Span) -> Diagnostic {
    Diagnostic::error("not-an-array", format!("{} has no elements", value.kind())).at(span, "not an array")
}

/// An index out of range or not whole.
pub fn bad_index(i: f64, length: usize, span: Span) -> Diagnostic {
    let shown = value::number(i);
    let title = if i.fract() == 0.0 {
        format!("there is no element {shown}: the array has {}", count(length, "element"))
    } else {
        format!("an index must be a whole number, not {shown}")
    };
    Diagnostic::error("bad-index", title).at(span, format!("is {shown}")).help(format!("indices go from 1 to {length}"))
}

/// An array without elements where one is needed.
pub fn empty_array(span: Span) -> Diagnostic {
    Diagnostic::error("empty-array", "this array has no elements").at(span, "")
}

/// A vector of another length.
pub fn needs_length(n: usize, given: usize, span: Span) -> Diagnostic {
    Diagnostic::error("needs-length", format!("a vector of length {n} is needed here, not of {given}")).at(span, "")
}

/// A fold without operands.
pub fn empty_fold(op: FoldOp, span: Span) -> Diagnostic {
    let name = folded(op).rsplit(' ').next().unwrap_or_default();
    Diagnostic::error("empty-fold", format!("{name} of nothing has no value"))
        .at(span, "no operand")
        .help("only an empty SUM (0) and an empty PRODUCT (1) have one")
}

/// ARRAY without an index.
pub fn array_needs_index(builtin: &Builtin, span: Span) -> Diagnostic {
    Diagnostic::error("wrong-kind", "ARRAY needs an index")
        .at(span, "")
        .help(format!("write `{}`", builtin.signature()))
}

/// Branches of an IF on a coordinate that cannot be chosen between.
pub fn branches_differ(a: &Value, b: &Value, span: Span) -> Diagnostic {
    let title = match (a, b) {
        (Value::Array(a), Value::Array(b)) => {
            format!("the branches are arrays of {} and {} elements", a.items().len(), b.items().len())
        }
        _ => format!("one branch is {} and the other {}", a.kind(), b.kind()),
    };
    Diagnostic::error("branches-differ", title)
        .at(span, "the condition differs from point to point")
        .help("both branches must be of one kind")
}

/// An operation as the user would write it.
pub fn operation(op: Binary, a: Scalar, b: Scalar) -> String {
    let sign = match op {
        Binary::Add => " + ",
        Binary::Sub => " - ",
        Binary::Mul => "*",
        Binary::Div => "/",
        Binary::Pow => "**",
        _ => " ",
    };
    format!("{}{sign}{}", factor(a), factor(b))
}

fn factor(s: Scalar) -> String {
    let shown = shown(s);
    if shown.starts_with('-') { format!("({shown})") } else { shown }
}

fn shown(s: Scalar) -> String {
    s.number().map_or_else(|| "...".to_owned(), value::number)
}

/// A call as the user would write it.
pub fn applied(name: &str, arguments: &[Scalar]) -> String {
    let all: Vec<String> = arguments.iter().map(|a| shown(*a)).collect();
    format!("{name}({})", all.join(", "))
}

/// A result that is undefined or infinite though its operands are numbers is an error at once.
///
/// # Errors
/// If it is.
pub fn check_defined(operands: &[Scalar], result: Scalar, what: impl FnOnce() -> String, span: Span) -> Lowered<()> {
    let Scalar::Number(value) = result else { return Ok(()) };
    let finite = |s: &Scalar| s.number().is_some_and(f64::is_finite);
    if value.is_finite() || !operands.iter().all(finite) {
        return Ok(());
    }
    let what = what();
    let told = if value.is_nan() {
        Diagnostic::error("undefined", format!("{what} is undefined")).at(span, "has no real value")
    } else if what.contains("/0") || what.ends_with("/(-0)") {
        Diagnostic::error("division-by-zero", format!("{what} divides by zero")).at(span, "division by zero")
    } else {
        Diagnostic::error("infinite", format!("{what} is infinite or too large for a number")).at(span, "not finite")
    };
    Err(Fault::from(told))
}

/// A function of the coordinates divided by a number that is 0.
pub fn divides_by_zero(span: Span, divisor: Span) -> Diagnostic {
    Diagnostic::error("division-by-zero", "this divides by zero at every point")
        .at(divisor, "is 0")
        .see(span, "")
        .help("the divisor is the same at every point: is a parameter 0 that should not be?")
}

/// A space that ends where it begins, or before.
pub fn no_extent(c: Coordinate, (lo, lo_at): (f64, Option<Span>), (hi, hi_at): (f64, Option<Span>)) -> Diagnostic {
    let title = format!("the modelling space has no extent along {c}: {} to {}", value::number(lo), value::number(hi));
    let told = Diagnostic::error("no-extent", title);
    let told = hi_at.into_iter().fold(told, |told, span| told.at(span, format!("is {}", value::number(hi))));
    let told = lo_at.into_iter().fold(told, |told, span| told.see(span, format!("is {}", value::number(lo))));
    told.help(format!("{c}min must be below {c}max"))
}

/// A setting at the end of a block, with which it ends.
pub fn setting_is_lost(name: &str, span: Span) -> Diagnostic {
    Diagnostic::warning(
        "setting-is-lost",
        format!("`{name}` changes nothing here: it is set for the rest of its block only"),
    )
    .at(span, "the block ends here")
    .help(format!("set it outside: `{name} = IF ... THEN ... ELSE ...;`"))
}

/// `r_alpha` or `r_m` out of range.
pub fn bad_system(name: &str, value: &Value, span: Span) -> Diagnostic {
    let shown = match value {
        Value::Scalar(Scalar::Number(n)) => value::number(*n),
        other => other.kind().to_owned(),
    };
    let told = Diagnostic::error("bad-system", format!("`{name}` cannot be {shown}")).at(span, "");
    if name == super::super::names::R_ALPHA {
        told.help("-1 < r_alpha <= 1; 1 is max and min, 0 the form without corners but where both vanish")
    } else {
        told.help("r_m is a whole number: 1, 2, ... for so many continuous derivatives, 0 for off")
    }
}

/// Too many turns.
pub fn too_many_turns(limit: usize, span: Span) -> Diagnostic {
    Diagnostic::error("too-many-turns", format!("loops, folds and calls took more than {limit} turns"))
        .at(span, "")
        .help("a WHILE ends when its body makes the condition false: does it ever?")
        .help("the limit holds for one input as a whole")
}

/// A graph that has grown too large.
pub fn too_many_nodes(limit: usize, span: Span) -> Diagnostic {
    Diagnostic::error("too-many-nodes", format!("the expressions of this session have more than {limit} operations"))
        .at(span, "")
}

/// A loop on a coordinate that nothing ends.
pub fn unbounded_loop(coordinates: Coordinates, turns: usize, span: Span) -> Diagnostic {
    Diagnostic::error(
        "unbounded-loop",
        format!("this loop depends on {} and nothing ends it within {turns} turns", list(coordinates)),
    )
    .at(span, "")
    .help("count its turns and bound them: `WHILE (n < 100 AND ...) DO BEGIN ... n = n + 1; END`")
}

/// A FOR or a fold without end.
pub fn endless(span: Span) -> Diagnostic {
    Diagnostic::error("endless", "this would never end").at(span, "").help("bounds must be finite and STEP not 0")
}

/// Calls nested too deep.
pub fn too_many_calls(name: &str, limit: usize, span: Span) -> Diagnostic {
    Diagnostic::error("too-many-calls", format!("calls of `{name}` are nested deeper than {limit}"))
        .at(span, "")
        .help("does the recursion end? Its condition must not depend on a coordinate")
}

/// Expressions nested too deep during evaluation.
pub fn too_deep(limit: usize, span: Span) -> Diagnostic {
    Diagnostic::error("too-deep", "calls within brackets are nested too deep to be evaluated")
        .at(span, "")
        .fact(format!("calls may be nested {limit} deep where their bodies are simple"))
}

/// Too many elements.
pub fn array_too_large(limit: usize, span: Span) -> Diagnostic {
    Diagnostic::error("array-too-large", format!("an array may have at most {limit} elements")).at(span, "")
}

/// Too many levels.
pub fn array_too_deep(limit: u16, span: Span) -> Diagnostic {
    Diagnostic::error("array-too-deep", format!("arrays may be nested at most {limit} deep")).at(span, "")
}

/// An index on a coordinate into a large array.
pub fn too_many_choices(limit: usize, span: Span) -> Diagnostic {
    Diagnostic::error("too-many-choices", format!("an index on a coordinate chooses among at most {limit} elements"))
        .at(span, "")
}

/// A range whose bounds are in the wrong order.
pub fn empty_range(lo: f64, hi: f64, span: Span) -> Diagnostic {
    Diagnostic::error("empty-range", format!("no number lies between {} and {}", value::number(lo), value::number(hi)))
        .at(span, "")
}

/// A step of a range that does not lead from its smallest to its largest value.
pub fn bad_step(step: f64, span: Span) -> Diagnostic {
    Diagnostic::error("bad-step", format!("the STEP of a range cannot be {}", value::number(step)))
        .at(span, "")
        .help("a range goes from its smallest to its largest value: write a STEP above 0, or leave it out")
}

/// A value outside its own range.
pub fn outside_range(name: &str, v: f64, lo: f64, hi: f64, span: Span) -> Diagnostic {
    let (v, lo, hi) = (value::number(v), value::number(lo), value::number(hi));
    Diagnostic::warning("outside-range", format!("`{name}` is {v}, outside its range [{lo}, {hi}]")).at(span, "")
}

/// A range on something that is no number.
pub fn range_needs_number(name: &str, value: &Value, span: Span) -> Diagnostic {
    Diagnostic::error("range-needs-number", format!("only a number has a range, and `{name}` is {}", value.kind()))
        .at(span, "")
}

/// The second argument of DIFF.
pub fn bad_variable(span: Span) -> Diagnostic {
    Diagnostic::error("bad-variable", "the second argument of DIFF is a coordinate or a name")
        .at(span, "")
        .help("for example `DIFF(gob_a, x1)` or `DIFF(gob_a, r1)`")
}

/// Derivatives and loops within each other, too many levels deep.
pub fn too_many_variables(span: Span) -> Diagnostic {
    Diagnostic::error("too-many-variables", "loops and derivatives are nested too deep here").at(span, "")
}

/// The second argument of PROJECT.
pub fn project_needs_coordinate(span: Span) -> Diagnostic {
    Diagnostic::error("bad-variable", "the second argument of PROJECT is a coordinate")
        .at(span, "")
        .help("for example `PROJECT(gob_a, x4, 0, 1)`")
}

/// A bound of PROJECT that depends on what is projected away.
pub fn bound_depends(over: Coordinate, span: Span) -> Diagnostic {
    Diagnostic::error("bound-depends", format!("a bound of PROJECT cannot depend on {over}, which it projects away"))
        .at(span, format!("depends on {over}"))
        .help("bounds may depend on parameters and on the other coordinates")
}

/// A section without end.
pub fn endless_section(span: Span) -> Diagnostic {
    Diagnostic::error("endless", "a bound of PROJECT must be a finite number").at(span, "")
}

/// An offset without end.
pub fn endless_offset(span: Span) -> Diagnostic {
    Diagnostic::error("endless", "the distance of OFFSET_BALL must be a finite number").at(span, "")
}

/// A search that cannot be made part of the graph.
pub fn refused_search(name: &str, why: Refused, span: Span) -> Diagnostic {
    let title = match why {
        Refused::TooLarge(limit) => format!("what {name} searches takes more than {limit} operations"),
        Refused::TooMany => format!("what {name} searches reads too many values that do not change with it"),
        Refused::TooDeep => format!("searches and loops lie within each other more than {DEPTH} levels deep"),
    };
    Diagnostic::error("search-too-large", title).at(span, "").help("make it of fewer or simpler parts")
}

/// A built-in that needs coordinates.
pub fn no_coordinates(name: &str, span: Span) -> Diagnostic {
    Diagnostic::error("no-coordinates", format!("{name} needs a function of the coordinates, and this is a number"))
        .at(span, "")
}
