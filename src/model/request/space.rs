//! The modelling space of a subject: given by the script or the command line, else found. Makes nothing else.

use std::sync::Arc;

use crate::diagnostic::{Category, Diagnostic};
use crate::field::{Coordinate, NodeId};
use crate::model::environment::{self, Object, Role};
use crate::model::session::Session;
use crate::surface::space::{Known, Outcome, Proof, find};
use crate::vm::Demand;

use super::make::cancelled;
use super::subject::{Axis, Sequence, Subject};
use super::told::SIGN;

/// Searches that a session remembers.
const REMEMBERED: usize = 64;

/// A search that was done, so that it is not done again for the next output.
#[derive(Clone, Debug, PartialEq)]
pub struct Searched {
    node: NodeId,
    inputs: Vec<Coordinate>,
    known: Vec<Known>,
    found: Outcome,
}

/// Gives a subject its axes: with the ranges that are given, and where one is missing with what a search finds.
///
/// # Errors
/// One message: the object is empty, goes on without end, or the work was stopped.
pub(super) fn settle(session: &mut Session, subject: &mut Subject, object: &Object) -> Result<(), Diagnostic> {
    let space = object.space();
    let axis = |a: &&environment::Axis| {
        let (lo, hi) = a.range.unwrap_or((f64::NAN, f64::NAN));
        Axis { coordinate: a.coordinate, range: [lo, hi], order: order(&a.role) }
    };
    subject.axes = space.iter().map(axis).collect();
    if space.iter().all(|a| a.range.is_some()) {
        return Ok(());
    }
    let known: Vec<Known> = space.iter().map(|a| known(a)).chain(moving(subject)).collect();
    let (outcome, is_new) = search(session, subject, &known)?;
    match outcome {
        Outcome::Within(ranges, proof) => {
            for (axis, range) in subject.axes.iter_mut().zip(ranges) {
                axis.range = range;
            }
            let sought: Vec<Coordinate> = space.iter().filter(|a| a.range.is_none()).map(|a| a.coordinate).collect();
            if is_new || proof == Proof::Samples {
                subject.notes.push(found(subject, &sought, proof));
            }
            Ok(())
        }
        Outcome::Endless(ends) => Err(endless(subject, &ends)),
        Outcome::Point(place) => Err(point(subject, &place)),
        Outcome::Empty(is_proved, best) => Err(nowhere(subject, is_proved, best)),
    }
}

/// Which of X, Y and Z a role is.
fn order(role: &Role) -> usize {
    [Role::X, Role::Y, Role::Z].iter().position(|known| known == role).unwrap_or(2)
}

fn known(axis: &environment::Axis) -> Known {
    match axis.range {
        Some((lo, hi)) => Known::Range(lo, hi),
        None => Known::Sought(axis.ends.0, axis.ends.1),
    }
}

/// The ranges of the coordinates that are no axes: all frames, sections and cells of a sheet get one space.
fn moving(subject: &Subject) -> Vec<Known> {
    let several: Vec<&Sequence> = [&subject.time, &subject.columns, &subject.rows, &subject.colour]
        .into_iter()
        .flatten()
        .chain(&subject.groups)
        .collect();
    let range = |(c, value): &(Coordinate, f64)| {
        let values = several.iter().find(|s| s.coordinate == *c).map(|s| &s.values[..]).unwrap_or_default();
        let (lo, hi) = values.iter().fold((*value, *value), |(lo, hi), &v| (lo.min(v), hi.max(v)));
        Known::Range(lo, hi)
    };
    subject.fixed.iter().map(range).collect()
}

/// What the search finds, and whether it was not known before.
fn search(session: &mut Session, subject: &Subject, known: &[Known]) -> Result<(Outcome, bool), Diagnostic> {
    // The lowest level encloses the others.
    let node = subject.levels.first().map_or(subject.node, |level| level.node);
    let inputs = subject.inputs();
    let same = |s: &&Searched| s.node == node && s.inputs == inputs && s.known == known;
    if let Some(searched) = session.searched.iter().find(same) {
        return Ok((searched.found.clone(), false));
    }
    let shape = subject.shape_of(node, &session.graph, Demand::Sign, &session.limits)?;
    let found = find(Arc::clone(&shape.program), known, session.limits.search_operations, &session.interrupt)
        .map_err(|_| cancelled())?;
    if session.searched.len() >= REMEMBERED {
        session.searched.remove(0);
    }
    session.searched.push(Searched { node, inputs, known: known.to_vec(), found: found.clone() });
    Ok((found, true))
}

/// The note that tells what was found, in the words of the option that sets it.
fn found(subject: &Subject, sought: &[Coordinate], proof: Proof) -> Diagnostic {
    let told: Vec<String> = subject
        .axes
        .iter()
        .filter(|axis| sought.contains(&axis.coordinate))
        .map(|Axis { coordinate: c, range: [lo, hi], .. }| format!("{c}={}:{}", plain(*lo), plain(*hi)))
        .collect();
    let title = format!("the modelling space of `{}` was found: {}", subject.name, told.join(","));
    let help = "--bounds sets another, as do x1min, x1max and so on in the script";
    match proof {
        Proof::Everywhere => Diagnostic::note("space-found", title).help(help),
        Proof::UpTo(far) => Diagnostic::note("space-found", title)
            .help(help)
            .fact(format!("nothing lies outside as far as {far:.0e}; beyond that nothing is known")),
        Proof::Samples => Diagnostic::warning("space-guessed", title)
            .help(help)
            .fact("by samples: intervals could not show that nothing lies outside"),
    }
}

/// An object that has no end.
fn endless(subject: &Subject, ends: &[(usize, bool)]) -> Diagnostic {
    let coordinate = |axis: usize| subject.axes[axis].coordinate;
    let words: Vec<String> =
        ends.iter().map(|&(axis, up)| format!("{}{}", if up { '+' } else { '-' }, coordinate(axis))).collect();
    let towards = match words.split_last() {
        Some((last, rest)) if !rest.is_empty() => format!("{} and {last}", rest.join(", ")),
        _ => words.concat(),
    };
    let mut axes: Vec<Coordinate> = ends.iter().map(|end| coordinate(end.0)).collect();
    axes.dedup();
    let lines: Vec<String> = axes.iter().map(|c| format!("{c}min = -10; {c}max = 10;")).collect();
    let options: Vec<String> = axes.iter().map(|c| format!("{c}=-10:10")).collect();
    let title = format!("`{}` goes on without end towards {towards}: say which part of it to show", subject.name);
    let told = Diagnostic::error("endless-object", title)
        .help(format!("add to the script: {}", lines.join(" ")))
        .help(format!("or on the command line: --bounds {}", options.join(",")));
    let all = ends.len() == 2 * subject.axes.len();
    here(if all { told.help(SIGN) } else { told }, subject)
}

/// An object that is a point at most.
fn point(subject: &Subject, place: &[f64]) -> Diagnostic {
    let title = format!("`{}` has no extent: all of it lies in one point, if it is not empty", subject.name);
    let told = Diagnostic::error("no-thickness", title)
        .category(Category::Result)
        .fact(format!("the point is {}", at(subject, place)))
        .help("its function reaches 0 there at most; a solid has points where it is > 0");
    here(told, subject)
}

/// An object of which no point was found anywhere.
fn nowhere(subject: &Subject, is_proved: bool, best: Option<(f64, Vec<f64>)>) -> Diagnostic {
    let name = &subject.name;
    let mut told = if is_proved {
        let title = format!("`{name}` is empty: its function is negative or undefined everywhere");
        Diagnostic::error("empty-object", title).fact("intervals over the whole space prove it")
    } else {
        let title = format!("`{name}` seems to be empty: no point was found where its function is >= 0");
        Diagnostic::error("empty-object", title).help("if there is something, say where: --bounds x1=LO:HI")
    };
    if let Some((value, place)) = &best {
        told = told.fact(format!("the largest value found is {} at {}", short(*value), at(subject, place)));
    }
    here(told.help(SIGN).category(Category::Result), subject)
}

/// A place in words: `x1 = 0.5, x2 = 1`.
pub(super) fn at(subject: &Subject, place: &[f64]) -> String {
    let inputs = subject.inputs();
    inputs.iter().zip(place).map(|(c, value)| format!("{c} = {}", short(*value))).collect::<Vec<_>>().join(", ")
}

/// A message with the place of the object's definition.
pub(super) fn here(told: Diagnostic, subject: &Subject) -> Diagnostic {
    match subject.span {
        Some(span) => told.at(span, "this object"),
        None => told,
    }
}

/// A number in a few digits.
pub(super) fn short(value: f64) -> String {
    let rounded = format!("{value:.4e}").parse().unwrap_or(value);
    plain(if rounded == 0.0 { 0.0 } else { rounded })
}

/// The shorter way to write a number.
pub(super) fn plain(value: f64) -> String {
    let (plain, scientific) = (value.to_string(), format!("{value:e}"));
    if scientific.len() < plain.len() { scientific } else { plain }
}
