//! What is known of a definition without evaluating it: its form, unknown names, calls in bodies, loops that cannot step.

use rustc_hash::{FxHashMap, FxHashSet};

use crate::builtins::{self, Meaning};
use crate::diagnostic::Diagnostic;
use crate::source::Span;
use crate::syntax::tree::{Body, Expr, GeometricType, Ident, Name, Statement, StatementKind};

use super::definition::Definition;
use super::errors;
use super::names::{self, Names};
use super::state::State;

/// Unknown names of one input for which near ones are looked for, each among all names; the rest is told without.
const SUGGESTED: usize = 20;

/// The names that a statement would define.
#[must_use]
pub fn defines(statement: &Statement) -> Vec<Name> {
    match &statement.kind {
        StatementKind::Define { name, .. } | StatementKind::Element { name, .. } => vec![name.name.clone()],
        _ => names::assigned(std::slice::from_ref(statement)),
    }
}

/// What is wrong with a statement by itself.
#[must_use]
pub fn form(statement: &Statement) -> Option<Diagnostic> {
    match &statement.kind {
        StatementKind::Define { name, parameters: Some(parameters), body, .. } => {
            if let Some(builtin) = builtins::find(&name.name) {
                return Some(errors::taken_by_builtin(builtin, &name.name, name.span));
            }
            if name.name.starts_with("gob_") {
                return Some(errors::gob_with_parameters(&name.name, name.span));
            }
            if names::is_system(&name.name) {
                return Some(errors::system_with_parameters(&name.name, name.span));
            }
            let mut seen = FxHashSet::default();
            let twice = parameters.iter().find(|p| !seen.insert(p.name.name.clone()));
            twice
                .map(|p| errors::parameter_twice(&p.name.name, p.name.span))
                .or_else(|| loops_in(body))
                .or_else(|| without_result(name, body))
        }
        StatementKind::Define { body, .. } => loops_in(body),
        StatementKind::Type { subject, kind } => type_form(&subject.name, subject.span, kind),
        _ => governed(statement),
    }
}

/// What is wrong with a loop or an IF before it runs.
fn governed(statement: &Statement) -> Option<Diagnostic> {
    let inner = match &statement.kind {
        StatementKind::If { then, otherwise, .. } => {
            misplaced(then).or_else(|| misplaced(otherwise.as_deref().unwrap_or_default()))
        }
        StatementKind::While { body, .. } | StatementKind::For { body, .. } => misplaced(body),
        _ => None,
    };
    inner.or_else(|| loops(std::slice::from_ref(statement)))
}

/// Settings of the system of R-functions behind which their block ends, so that they change nothing.
pub fn lost_settings(block: &[Statement], told: &mut Vec<Diagnostic>) {
    for (i, statement) in block.iter().enumerate() {
        match &statement.kind {
            StatementKind::Define { name, .. } if names::is_system(&name.name) && i + 1 == block.len() => {
                told.push(errors::setting_is_lost(&name.name, name.span));
            }
            StatementKind::If { then, otherwise, .. } => {
                lost_settings(then, told);
                lost_settings(otherwise.as_deref().unwrap_or_default(), told);
            }
            StatementKind::While { body, .. }
            | StatementKind::For { body, .. }
            | StatementKind::Define { body: Body::Block(body), .. } => lost_settings(body, told),
            _ => {}
        }
    }
}

/// The first statement of a block that stands only at the top of a program.
fn misplaced(block: &[Statement]) -> Option<Diagnostic> {
    block.iter().find_map(|statement| match &statement.kind {
        StatementKind::Define { body: Body::Block(block), .. } => misplaced(block),
        StatementKind::If { .. } | StatementKind::While { .. } | StatementKind::For { .. } => governed(statement),
        StatementKind::Define { .. } | StatementKind::Element { .. } | StatementKind::Failed { .. } => None,
        _ => Some(errors::not_in_a_body(statement)),
    })
}

/// A body that assigns to other names only. Whether it always assigns to its own shows when it is called.
fn without_result(own: &Ident, body: &Body) -> Option<Diagnostic> {
    match body {
        Body::Block(block) if !names::assigned(block).contains(&own.name) => {
            Some(errors::no_result(&own.name, own.span))
        }
        _ => None,
    }
}

fn loops_in(body: &Body) -> Option<Diagnostic> {
    match body {
        Body::Block(block) => misplaced(block).or_else(|| loops(block)),
        Body::Expression(_) => None,
    }
}

/// The first loop whose condition reads nothing that its body assigns.
fn loops(block: &[Statement]) -> Option<Diagnostic> {
    block.iter().find_map(|statement| match &statement.kind {
        StatementKind::While { condition, body } => {
            never_steps(condition, body, statement.span).or_else(|| loops(body))
        }
        StatementKind::For { body, .. } => loops(body),
        StatementKind::If { then, otherwise, .. } => {
            loops(then).or_else(|| loops(otherwise.as_deref().unwrap_or_default()))
        }
        StatementKind::Define { body, .. } => loops_in(body),
        _ => None,
    })
}

fn never_steps(condition: &Expr, body: &[Statement], span: Span) -> Option<Diagnostic> {
    let reads: Vec<Name> = names::of_expression(condition).reads.into_iter().map(|(n, _)| n).collect();
    let assigns = names::assigned(body);
    let steps = reads.iter().any(|n| assigns.contains(n));
    (!steps).then(|| errors::loop_never_steps(&reads, &assigns, condition.span, span))
}

fn type_form(subject: &str, span: Span, kind: &GeometricType) -> Option<Diagnostic> {
    let coordinate = super::environment::coordinate(subject).is_some();
    if let GeometricType::Constant(None)
    | GeometricType::Group(None)
    | GeometricType::Center(None)
    | GeometricType::Color(None, _) = kind
    {
        return Some(errors::type_without_value(subject, span, kind));
    }
    let fits = match kind {
        GeometricType::Constant(_) | GeometricType::Group(_) => true,
        GeometricType::Center(_) | GeometricType::Color(..) => !coordinate,
        _ => coordinate,
    };
    (!fits).then(|| {
        let title = if coordinate {
            let word = if matches!(kind, GeometricType::Color(..)) { "COLOR" } else { "CENTER" };
            format!("`{subject}` is a coordinate, and {word} belongs to an object")
        } else {
            format!("`{subject}` is no coordinate; an object's types are CONSTANT, G, CENTER and COLOR")
        };
        Diagnostic::error("bad-type", title).at(span, "")
    })
}

/// The unknown names of an expression that is evaluated where it stands.
#[must_use]
pub fn unknown(
    state: &State,
    said: &Names,
    excused: &FxHashSet<Name>,
    later: &FxHashMap<Name, Span>,
) -> Vec<Diagnostic> {
    let meant = |n: &Name| excused.contains(n) || later.contains_key(n);
    let missing = said.reads.iter().filter(|(n, _)| state.get(n).is_none() && (meant(n) || !state.is_library(n)));
    missing
        .map(|(name, span)| match later.get(name) {
            _ if excused.contains(name) => errors::excused(name),
            Some(place) => errors::defined_later(name, *span, *place),
            None => errors::unknown_name(state, name, &[*span], false, excused),
        })
        .collect()
}

/// One message for each name among those read that nothing defines.
#[must_use]
pub fn unknown_names<'r>(
    state: &State,
    reads: impl Iterator<Item = (&'r Name, Span)>,
    excused: &FxHashSet<Name>,
    note: bool,
) -> Vec<Diagnostic> {
    let mut order: Vec<&Name> = Vec::new();
    let mut places: FxHashMap<&Name, Vec<Span>> = FxHashMap::default();
    let mut read: FxHashSet<&str> = FxHashSet::default();
    for (name, span) in reads {
        read.insert(name);
        if state.find(name).is_none() && !excused.contains(name) {
            let places = places.entry(name).or_insert_with(|| {
                order.push(name);
                Vec::new()
            });
            if places.len() < 4 {
                places.push(span);
            }
        }
    }
    let told = order.into_iter().enumerate().map(|(i, name)| {
        if i < SUGGESTED {
            errors::unknown_name_among(state, name, &places[name], note, (excused, &read))
        } else {
            errors::not_defined(name, &places[name], note)
        }
    });
    told.collect()
}

/// Calls inside a function's body, which nothing has evaluated yet.
#[must_use]
pub fn bodies(state: &State, definition: &Definition, said: &Names) -> Vec<Diagnostic> {
    if !definition.is_function() {
        return Vec::new();
    }
    let mut told = Vec::new();
    for (name, span, given) in &said.calls {
        let Some(StatementKind::Define { parameters: Some(p), .. }) = state.find(name).map(|d| &d.statement.kind)
        else {
            continue;
        };
        if p.len() != *given {
            let parameters: Vec<&str> = p.iter().map(|p| &*p.name.name).collect();
            let signature = format!("{name}({})", parameters.join(", "));
            told.push(errors::wrong_count(&signature, p.len(), *given, *span));
        }
    }
    for (name, span, given) in &said.builtins {
        let Some(builtin) = builtins::find(name) else { continue };
        let one_array = matches!(builtin.meaning, Meaning::Fold(_)) && *given == 1;
        if !one_array && !builtin.arity().admits(*given) {
            told.push(errors::wrong_builtin_count(builtin, *given, *span));
        }
    }
    told
}
