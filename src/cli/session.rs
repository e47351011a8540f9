//! From a program's place to a session that has read it.

use std::path::Path;
use std::sync::Arc;

use crate::host::{self, Disk, FileError, Host};
use crate::limits::Limits;
use crate::model::{Event, Outcome, Session};
use crate::syntax::Mode;

use super::arguments::Program;
use super::console::Console;
use super::engine::Signals;
use super::status::Status;

/// A session that knows nothing yet.
#[must_use]
pub fn fresh(signals: &Signals) -> Session {
    Session::new(Arc::new(Disk), Limits::default(), signals.interrupt.clone())
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

/// A session that has read `program`: its file, then its code, then its definitions of the command line.
///
/// # Errors
/// The status of the first failure; its messages have been told.
pub fn open(console: &Console, signals: &Signals, program: &Program) -> Result<(Session, Vec<Event>), Status> {
    let mut session = fresh(signals);
    let mut events = Vec::new();
    if let Some(file) = &program.file {
        let text = read_text(file).map_err(|error| console.file_error(&error))?;
        events.extend(feed(console, &mut session, &name(file), &text)?);
    }
    for code in &program.code {
        events.extend(feed(console, &mut session, "-e", code)?);
    }
    for assignment in &program.define {
        let outcome = session.set(&assignment.name, &assignment.expression);
        finish(console, &session, outcome)?;
    }
    Ok((session, events))
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

fn feed(console: &Console, session: &mut Session, name: &str, text: &str) -> Result<Vec<Event>, Status> {
    let outcome = session.input(name, text, Mode::Script);
    finish(console, session, outcome)
}

fn finish(console: &Console, session: &Session, outcome: Outcome) -> Result<Vec<Event>, Status> {
    match console.report(session.sources(), &outcome.diagnostics) {
        Status::Done => Ok(outcome.events),
        failed => Err(failed),
    }
}
