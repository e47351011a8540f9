//! Messages about names, definitions, calls and bodies.

use std::sync::Arc;

use rustc_hash::FxHashSet;

use crate::builtins::{self, Builtin};
use crate::diagnostic::near::{Candidate, foreign, suggest};
use crate::diagnostic::{Diagnostic, Label};
use crate::field::Coordinate;
use crate::source::Span;
use crate::syntax::tree::{GeometricType, Name, Parameter, Statement, StatementKind};

use super::super::definition::Definition;
use super::super::state::State;
use super::super::value::Value;
use super::count;

/// A name that nothing defines; a note if the prompt may still be told. `places` are where it is read, the first one underlined;
/// `excused` are names of statements that failed, which may be meant all the same.
pub fn unknown_name(state: &State, name: &str, places: &[Span], note: bool, excused: &FxHashSet<Name>) -> Diagnostic {
    unknown_name_among(state, name, places, note, (excused, &FxHashSet::default()))
}

/// The same where other names are read as well, by statements that failed for one.
pub fn unknown_name_among(
    state: &State,
    name: &str,
    places: &[Span],
    note: bool,
    others: (&FxHashSet<Name>, &FxHashSet<&str>),
) -> Diagnostic {
    let told = not_defined(name, places, note);
    if name == "_" {
        return told.help("`_` is the value of the last expression at the prompt, and there is none yet");
    }
    if let Some(builtin) = builtins::find(name) {
        return told.help(format!("`{}` is a built-in function: {}", builtin.name, builtin.signature())).help(format!(
            "to pass it on as an argument, define a function of your own that calls `{}`",
            builtin.name
        ));
    }
    if let Some(help) = foreign(name) {
        return told.help(help);
    }
    let near = near(state, name, others);
    match &near[..] {
        [] if note => told,
        [] => told.help(format!("define it: `{name} = ...;`, above or below")),
        all => {
            let all: Vec<String> = all.iter().map(|n| format!("`{n}`")).collect();
            told.help(format!("did you mean {}?", all.join(" or ")))
        }
    }
}

/// The same without a suggestion.
pub fn not_defined(name: &str, places: &[Span], note: bool) -> Diagnostic {
    let told = if note {
        Diagnostic::note("unknown-name", format!("`{name}` is not defined yet"))
    } else {
        Diagnostic::error("unknown-name", format!("`{name}` is not defined"))
    };
    places.iter().enumerate().fold(told, |told, (i, place)| {
        if i == 0 { told.at(*place, "unknown name") } else { told.see(*place, "also read here") }
    })
}

/// The defined names that are nearest to `name`, names that nothing reads first.
fn near(state: &State, name: &str, (excused, read): (&FxHashSet<Name>, &FxHashSet<&str>)) -> Vec<String> {
    // Settings such as x1min are read by nothing, and are not more likely for that.
    let unread = |n: &Name| {
        let nobody = state.readers(n).next().is_none() && !read.contains(&**n);
        nobody && !super::super::environment::is_setting(n)
    };
    let user = state.names().map(|n| Candidate { name: n, preferred: unread(n) });
    let library = state.library().into_iter().flat_map(|library| library.names());
    let library = library.filter(|n| state.get(n).is_none()).map(|name| Candidate { name, preferred: false });
    let failed = excused.iter().map(|n| Candidate { name: n, preferred: false });
    let known = builtins::all().map(|b| Candidate { name: b.name, preferred: false });
    suggest(name, user.chain(failed).chain(library).chain(known)).into_iter().map(str::to_owned).collect()
}

/// Whether the place of a message is in the library, where the user has not written anything.
pub fn is_in_library(told: &Diagnostic) -> bool {
    let place = told.labels.iter().find(|label| label.primary).or(told.labels.first());
    place.is_some_and(|label| label.span.source.is_on_shelf())
}

/// Moves a message from inside the library to the user's call that led there; where it arose is still shown, behind it.
pub fn place_at_call(told: &mut Diagnostic, name: &str, call: Span) {
    if is_in_library(told) {
        told.labels.iter_mut().for_each(|label| label.primary = false);
        let label = Label { span: call, text: format!("in this call of `{name}`"), primary: true };
        told.labels.insert(0, label);
        told.labels.truncate(3);
    }
}

/// A name that a statement which failed would have defined. Never told: the failure was.
pub fn excused(name: &str) -> Diagnostic {
    Diagnostic::note("excused", format!("`{name}` failed to be defined"))
}

/// A name that PRINT or an expression needs and that is defined only further down.
pub fn defined_later(name: &str, span: Span, place: Span) -> Diagnostic {
    Diagnostic::error("defined-later", format!("`{name}` is defined only further down"))
        .at(span, "not known yet here")
        .see(place, "defined here")
        .help("PRINT shows values as they are at its place: move it below the definition")
}

/// A name of a body that has no value yet.
pub fn read_before_assigned(name: &str, span: Span) -> Diagnostic {
    Diagnostic::error("read-before-assigned", format!("`{name}` is read before it has a value"))
        .at(span, "has no value yet")
        .help(format!("assign it first: `{name} = ...;` above"))
}

/// A loop or IF that might have defined a name and did not.
pub fn never_assigned(name: &str, span: Span, statement: Span) -> Diagnostic {
    Diagnostic::error("never-assigned", format!("`{name}` has no value"))
        .at(span, "read here")
        .see(statement, "no turn and no branch that was taken assigns it")
        .help(format!("define `{name}` above that statement"))
}

/// `a[i] = ...` without an array.
pub fn element_of_nothing(name: &str, span: Span) -> Diagnostic {
    Diagnostic::error("element-of-nothing", format!("`{name}` is not defined above, so it has no elements"))
        .at(span, "no array yet")
        .help(format!("define it first: `{name} = [...];` or `{name} = ARRAY(i = 1 TO n, 0);`"))
}

/// A definition that extends nothing: `s = s + 1` without an `s` above.
pub fn extends_nothing(name: &str, span: Span) -> Diagnostic {
    Diagnostic::error("extends-nothing", format!("`{name}` reads itself, and nothing above defines it"))
        .at(span, "not defined above")
        .help(format!("give it a first value above: `{name} = ...;`"))
}

/// Definitions that need each other.
pub fn circle(circle: &[&Arc<Definition>]) -> Diagnostic {
    let name = |d: &Definition| d.outputs.first().map_or_else(|| "the expression".to_owned(), ToString::to_string);
    let mut way: Vec<String> = circle.iter().map(|d| name(d)).collect();
    if let Some(first) = circle.first() {
        way.push(name(first));
    }
    let title = match circle {
        [one] => format!("`{}` is defined by itself", name(one)),
        _ => format!("these definitions go round in a circle: {}", shortened(&way)),
    };
    let mut told = Diagnostic::error("circle", title);
    for (i, definition) in circle.iter().enumerate().take(12) {
        let next = circle[(i + 1) % circle.len()];
        let read = definition.reads.iter().find(|(n, _)| next.outputs.contains(n));
        let (span, text) = match read {
            Some((n, span)) => (*span, format!("{} reads `{n}`", definition.title())),
            None => (definition.place(), String::new()),
        };
        told = if i == 0 { told.at(span, text) } else { told.see(span, text) };
    }
    told.help("give one of them a formula that does not need the others")
}

fn shortened(way: &[String]) -> String {
    if way.len() <= 14 {
        return way.join(" -> ");
    }
    format!("{} -> ... ({} more) -> {}", way[..6].join(" -> "), way.len() - 12, way[way.len() - 6..].join(" -> "))
}

/// The wrong number of arguments for a function of the user's.
pub fn wrong_count(signature: &str, takes: usize, given: usize, span: Span) -> Diagnostic {
    Diagnostic::error("wrong-count", format!("`{signature}` takes {}, not {given}", count(takes, "argument")))
        .at(span, format!("{} given", count(given, "argument")))
}

/// The wrong number of arguments for a built-in function.
pub fn wrong_builtin_count(builtin: &Builtin, given: usize, span: Span) -> Diagnostic {
    Diagnostic::error("wrong-count", format!("`{}` takes {}, not {given}", builtin.signature(), builtin.arity()))
        .at(span, format!("{} given", count(given, "argument")))
        .fact(builtin.doc)
}

/// An argument of another kind than the parameter was declared with.
pub fn wrong_kind(signature: &str, parameter: &Parameter, value: &Value, span: Span) -> Diagnostic {
    let kind = parameter.kind.as_ref().map_or("", |(_, words)| words);
    Diagnostic::error("wrong-kind", format!("`{}` of `{signature}` cannot be {}", parameter.name.name, value.kind()))
        .at(span, value.kind())
        .see(parameter.name.span, format!("declared as ({kind})"))
}

/// An argument of a kind that a built-in has no use for.
pub fn wrong_builtin_kind(builtin: &Builtin, value: &Value, wanted: &str, span: Span) -> Diagnostic {
    Diagnostic::error("wrong-kind", format!("`{}` needs {wanted} here, not {}", builtin.signature(), value.kind()))
        .at(span, value.kind())
        .fact(builtin.doc)
}

/// `PNORM(a, b, 0)`
pub fn no_zero_norm(p: Span) -> Diagnostic {
    Diagnostic::error("zero-norm", "there is no p-norm with p = 0")
        .at(p, "is 0")
        .help("p > 0 joins values above the largest, p < 0 below the smallest; with p = INFINITY or -INFINITY it is just that one")
}

/// A call of something that is neither a function nor an object.
pub fn not_callable(name: &str, value: &Value, span: Span) -> Diagnostic {
    let told = Diagnostic::error(
        "not-callable",
        format!("`{name}` is {}: it has no parameters and uses no coordinates", value.kind()),
    )
    .at(span, "called like a function");
    match value {
        Value::Array(_) => told.help(format!("an element is written with square brackets: `{name}[1]`")),
        _ => told.help("a product is written with `*`"),
    }
}

/// A body that never assigns to its own name.
pub fn no_result(name: &str, span: Span) -> Diagnostic {
    Diagnostic::error("no-result", format!("the body of `{name}` never assigns its value"))
        .at(span, "has no value")
        .help(format!("end the body with `{name} = ...;`"))
}

/// A statement that only stands at the top of a program.
pub fn not_in_a_body(statement: &Statement) -> Diagnostic {
    let what = match &statement.kind {
        StatementKind::Type { .. } => "a geometric type",
        StatementKind::Include { .. } => "INCLUDE",
        StatementKind::Print { .. } => "PRINT",
        _ => "an expression by itself",
    };
    Diagnostic::error("not-in-a-body", format!("{what} cannot stand inside a loop, a branch or a body"))
        .at(statement.span, "move it outside")
        .help("a loop or a branch only assigns: give the value a name and use it below")
}

/// `x8 : G;`
pub fn type_without_value(subject: &str, span: Span, kind: &GeometricType) -> Diagnostic {
    let (word, example) = match kind {
        GeometricType::Group(_) => ("G", "[0, 1, 2]"),
        GeometricType::Center(_) => ("CENTER", "[0, 0, 0]"),
        GeometricType::Color(..) => ("COLOR", "[1, 0.5, 0]"),
        _ => ("CONSTANT", "0.5"),
    };
    Diagnostic::error("type-without-value", format!("{word} of `{subject}` has no value"))
        .at(span, "")
        .help(format!("write `{subject} : {word} = {example};`"))
}

/// Two arguments of AT for one coordinate.
pub fn coordinate_twice(c: Coordinate, span: Span) -> Diagnostic {
    Diagnostic::error("coordinate-twice", format!("{c} is given twice")).at(span, "for the second time")
}

/// More than sixteen coordinates.
pub fn too_many_coordinates(n: usize, span: Span) -> Diagnostic {
    Diagnostic::error("too-many-coordinates", format!("AT takes at most 16 coordinates, not {n}")).at(span, "")
}

/// `name = value` among the arguments of something that takes no settings.
pub fn stray_setting(name: &str, span: Span) -> Diagnostic {
    Diagnostic::error("stray-setting", format!("`{name} = ...` is no setting of this function"))
        .at(span, "")
        .help("a comparison needs parentheses here: `(a = b)`")
}

/// AT on something that uses no coordinates.
pub fn at_without_coordinates(span: Span) -> Diagnostic {
    Diagnostic::warning("at-without-coordinates", "AT changes nothing here: the value uses no coordinates").at(span, "")
}

/// A loop whose condition never changes.
pub fn loop_never_steps(reads: &[Name], assigns: &[Name], condition: Span, statement: Span) -> Diagnostic {
    let list = |names: &[Name]| names.iter().map(|n| format!("`{n}`")).collect::<Vec<_>>().join(", ");
    let told = Diagnostic::error("loop-never-steps", "the condition of this loop reads nothing that its body assigns")
        .at(condition, if reads.is_empty() { "reads no name".to_owned() } else { format!("reads {}", list(reads)) })
        .see(
            statement,
            if assigns.is_empty() { "assigns nothing".to_owned() } else { format!("assigns {}", list(assigns)) },
        );
    match reads.first() {
        Some(i) => told
            .help(format!("put the step into the body: `BEGIN ... {i} = {i} + 1; END`"))
            .help(format!("and start it above: `{i} = 1;`")),
        None => told.help("use FOR for a fixed number of turns"),
    }
}

/// A name that a built-in function has.
pub fn taken_by_builtin(builtin: &Builtin, name: &str, span: Span) -> Diagnostic {
    Diagnostic::error(
        "builtin-name",
        format!("`{name}` with parameters is a built-in function: {}", builtin.signature()),
    )
    .at(span, "choose another name")
}

/// `gob_` with parameters.
pub fn gob_with_parameters(name: &str, span: Span) -> Diagnostic {
    let rest = name.strip_prefix("gob_").unwrap_or(name);
    Diagnostic::error("gob-with-parameters", format!("`{name}` has parameters, and a gob_ has none"))
        .at(span, "")
        .help(format!("a primitive with parameters is a `pob_{rest}`, an operation on objects a `tr_{rest}`"))
}

/// `r_alpha(p) = ...` and the like.
pub fn system_with_parameters(name: &str, span: Span) -> Diagnostic {
    Diagnostic::error(
        "system-with-parameters",
        format!("`{name}` sets the system of R-functions and has no parameters"),
    )
    .at(span, "")
}

/// A name that is no setting and looks like one.
pub fn nearly_setting(name: &str, setting: &str, span: Span) -> Diagnostic {
    Diagnostic::warning("nearly-setting", format!("`{name}` bounds nothing: the setting is written `{setting}`"))
        .at(span, "")
        .help(format!("write `{setting} = ...;`"))
}

/// A name defined twice with a reader between.
pub fn redefined(name: &str, first: Span, reader: Span, second: Span) -> Diagnostic {
    Diagnostic::warning("redefined", format!("`{name}` is defined twice, and is read in between"))
        .at(second, "this definition counts, also for the reader above")
        .see(reader, "read here")
        .see(first, "first defined here")
        .help("give one of them another name, if both are meant")
}

/// A parameter name that stands twice.
pub fn parameter_twice(name: &str, span: Span) -> Diagnostic {
    Diagnostic::error("parameter-twice", format!("the parameter `{name}` stands twice")).at(span, "for the second time")
}

/// A definition of an earlier input that no longer works.
pub fn broken(definition: &Definition, cause: &Diagnostic) -> Diagnostic {
    let mut told = Diagnostic::note("broken", format!("{} no longer works: {}", definition.title(), cause.title));
    told.labels.clone_from(&cause.labels);
    told.fact("it fails when it is asked for")
}
