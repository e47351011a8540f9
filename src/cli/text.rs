//! The commands that are about texts and words: `check`, `fmt`, `doc`, `completions`, `man`.

use std::path::Path;

use clap::CommandFactory;

use crate::builtins;
use crate::diagnostic::near::{Candidate, suggest};
use crate::host::{Disk, Host};
use crate::limits::Limits;
use crate::model::settings;
use crate::source::SourceMap;
use crate::syntax::print::format;

use super::arguments::{Check, Cli, Doc, Fmt, Program};
use super::console::Console;
use super::engine::Signals;
use super::session::{self, read_text};
use super::status::Status;

/// `yont check FILE...`: each file is read on its own, and everything wrong with it is told.
pub fn check(console: &Console, signals: &Signals, options: &Check) -> Result<Status, Status> {
    let mut status = Status::Done;
    for file in &options.files {
        let program = Program { file: Some(file.clone()), ..Program::default() };
        status = status.or(match session::open(console, signals, &program) {
            Ok((session, _)) => console.report(session.sources(), &settings::check(&session)),
            Err(failed) => failed,
        });
    }
    Ok(status)
}

/// `yont fmt FILE...`.
pub fn fmt(console: &Console, options: &Fmt) -> Result<Status, Status> {
    let mut status = Status::Done;
    for file in &options.files {
        status = status.or(fmt_one(console, file, options.check)?);
    }
    Ok(status)
}

fn fmt_one(console: &Console, file: &Path, check: bool) -> Result<Status, Status> {
    let text = match read_text(file) {
        Ok(text) => text,
        Err(error) => return Ok(console.file_error(&error)),
    };
    let mut sources = SourceMap::default();
    let id = sources.add(session::name(file), text.as_str());
    let formatted = match format(&sources, id, &Limits::default()) {
        Ok(formatted) => formatted,
        Err(diagnostics) => return Ok(console.report(&sources, &diagnostics)),
    };
    if file == Path::new("-") && !check {
        console.write(|out| out.write_all(formatted.as_bytes()))?;
    } else if formatted != text {
        if check {
            console.note(&format!("{} is not formatted", file.display()));
            return Ok(Status::Failed);
        }
        if let Err(error) = Disk.write_whole(file, &mut |out| out.write_all(formatted.as_bytes())) {
            return Ok(console.file_error(&error));
        }
    }
    Ok(Status::Done)
}

/// `yont doc [NAME]`.
pub fn doc(console: &Console, signals: &Signals, options: &Doc) -> Result<Status, Status> {
    let Some(name) = &options.name else {
        console.print(&overview())?;
        return Ok(Status::Done);
    };
    if let Some(file) = &options.file {
        let program = Program { file: Some(file.clone()), ..Program::default() };
        let (session, _) = session::open(console, signals, &program)?;
        if let Some(words) = session.doc(name) {
            console.print(&words)?;
            return Ok(Status::Done);
        }
    }
    match builtins::find(name) {
        Some(builtin) => console.print(&explain(builtin)).map(|()| Status::Done),
        None => Ok(console.usage(&unknown(name))),
    }
}

fn unknown(name: &str) -> String {
    let upper = name.to_uppercase();
    match near(&upper, builtins::all().flat_map(builtins::Builtin::names)) {
        Some(other) => format!("there is no built-in function `{name}`; did you mean `{other}`?"),
        None => format!("there is no built-in function `{name}`; `yont doc` lists them"),
    }
}

/// The name that is nearest to one which means nothing.
#[must_use]
pub fn near<'a>(name: &str, names: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    suggest(name, names.map(|name| Candidate { name, preferred: false })).first().copied()
}

/// All built-in functions by subject, one a line.
fn overview() -> String {
    let width = builtins::all().map(|builtin| builtin.signature().chars().count()).max().unwrap_or(0);
    let mut lines: Vec<String> = Vec::new();
    let mut subject = None;
    for builtin in builtins::all() {
        if subject != Some(builtin.subject) {
            let gap = if subject.is_some() { "\n" } else { "" };
            lines.push(format!("{gap}{}:", builtin.subject));
            subject = Some(builtin.subject);
        }
        let first = builtin.doc.split(['.', ';']).next().unwrap_or(builtin.doc);
        lines.push(format!("  {:width$}  {first}", builtin.signature()));
    }
    lines.join("\n")
}

/// What there is to say of a built-in function.
#[must_use]
pub fn explain(builtin: &builtins::Builtin) -> String {
    let (source, value) = builtin.example;
    format!("{}\n    {}\n    {source} is {value}", builtin.signature(), builtin.doc)
}

/// `yont completions SHELL`.
pub fn completions(console: &Console, shell: clap_complete::Shell) -> Result<Status, Status> {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut Cli::command(), "yont", &mut script);
    console.write(|out| out.write_all(&script)).map(|()| Status::Done)
}

/// `yont man`.
pub fn man(console: &Console) -> Result<Status, Status> {
    let mut page = Vec::new();
    // Writing to memory does not fail.
    let _ = clap_mangen::Man::new(Cli::command()).render(&mut page);
    console.write(|out| out.write_all(&page)).map(|()| Status::Done)
}
