//! From a program's place to a session that has read it.

use std::path::Path;
use std::sync::Arc;

use crate::diagnostic::Diagnostic;
use crate::host::{self, Disk, FileError, Host};
use crate::limits::Limits;
use crate::model::environment::is_setting;
use crate::model::settings;
use crate::model::{Event, Outcome, Session};
use crate::syntax::Mode;

use super::arguments::Program;
use super::console::Console;
use super::engine::Signals;
use super::mistakes;
use super::status::Status;
use super::text::near;

/// A session in which the user has defined nothing yet, with the library or without.
#[must_use]
pub fn fresh(signals: &Signals, no_prelude: bool) -> Session {
    let start = if no_prelude { Session::bare } else { Session::new };
    start(Arc::new(Disk), Limits::default(), signals.interrupt.clone())
}

/// The text of a program; `-` is standard input.
///
/// # Errors
/// [`FileError`] when it cannot be read, is too large or is not text.
pub fn read_text(file: &Path) -> Result<String, FileError> {
    let limit = Limits::default().source_bytes;
    if file == Path::new("-") {
        let name = Path::new("standard input");
        return host::text(name, host::read_stream(name, &mut std::io::stdin().lock(), limit)?);
    }
    host::text(file, Disk.read(file, limit)?)
}

/// What messages call a file.
#[must_use]
pub fn name(file: &Path) -> String {
    if file == Path::new("-") { "<standard input>".into() } else { file.display().to_string() }
}

/// A session that has read `program`: its definitions of the command line, which win, then its file, then its code.
///
/// # Errors
/// The status of the first failure; its messages have been told.
pub fn open(console: &Console, signals: &Signals, program: &Program) -> Result<(Session, Vec<Event>), Status> {
    let mut session = fresh(signals, program.no_prelude);
    let mut events = Vec::new();
    for assignment in &program.define {
        let mut outcome = session.set(&assignment.name, &assignment.expression);
        // What its expression reads is defined by the program that follows.
        outcome.diagnostics.retain(Diagnostic::is_error);
        finish(console, &session, outcome)?;
    }
    if let Some(file) = &program.file {
        let text = read_text(file).map_err(|error| unread_program(console, file, &error))?;
        events.extend(feed(console, &mut session, &name(file), &text, Mode::Script)?);
    }
    for code in &program.code {
        events.extend(feed(console, &mut session, "-e", code, Mode::Code)?);
    }
    let unread: Vec<Diagnostic> = program.define.iter().filter_map(|define| unread(&session, &define.name)).collect();
    match console.report(session.sources(), &unread) {
        Status::Done => Ok((session, events)),
        failed => Err(failed),
    }
}

/// Tells of a program that could not be read, and of what its name may have been meant to be.
pub fn unread_program(console: &Console, file: &Path, error: &FileError) -> Status {
    let told = error.diagnostic();
    let missing = error.reason == host::Reason::Missing;
    let tip = file.to_str().filter(|_| missing).and_then(mistakes::other_command);
    let near = tip.or_else(|| Some(format!("did you mean `{}`?", mistakes::other_file(file).filter(|_| missing)?)));
    console
        .report(&Default::default(), &[near.into_iter().fold(told, |told, tip| Diagnostic { help: vec![tip], ..told })])
}

/// A warning for a definition of the command line that changes nothing: most likely its name is misspelt.
fn unread(session: &Session, name: &str) -> Option<Diagnostic> {
    let serves = name.starts_with("gob_") || is_system(name) || is_setting(name) || settings::is_setting(name);
    if serves || session.deps(name).is_some_and(|deps| !deps.readers.is_empty()) {
        return None;
    }
    let names: Vec<String> = session.names().into_iter().filter(|other| other != name).collect();
    let warning = Diagnostic::warning("unread-define", format!("-D {name}: nothing reads `{name}`"));
    Some(match near(name, names.iter().map(String::as_str)) {
        Some(other) => warning.help(format!("did you mean `{other}`?")),
        None => warning,
    })
}

/// The names that no definition needs to read: they choose the R-functions.
fn is_system(name: &str) -> bool {
    name == "r_alpha" || name == "r_m"
}

/// Like [`open`], with an error of usage when no program is named.
///
/// # Errors
/// As [`open`].
pub fn required(console: &Console, signals: &Signals, program: &Program) -> Result<(Session, Vec<Event>), Status> {
    if program.file.is_none() && program.code.is_empty() {
        return Err(console.usage("no program: name a file, `-` for standard input, or -e 'CODE'"));
    }
    open(console, signals, program)
}

fn feed(console: &Console, session: &mut Session, name: &str, text: &str, mode: Mode) -> Result<Vec<Event>, Status> {
    let outcome = session.input(name, text, mode);
    finish(console, session, outcome)
}

fn finish(console: &Console, session: &Session, outcome: Outcome) -> Result<Vec<Event>, Status> {
    match console.report(session.sources(), &outcome.diagnostics) {
        Status::Done => Ok(outcome.events),
        failed => Err(failed),
    }
}
