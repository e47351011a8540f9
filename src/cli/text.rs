//! The commands that are about texts and words: `check`, `fmt`, `doc`, `completions`, `man`.

use std::path::Path;

use clap::CommandFactory;

use crate::builtins;
use crate::diagnostic::near::{Candidate, suggest};
use crate::host::{Disk, Host};
use crate::limits::Limits;
use crate::model::library::{Entry, Library};
use crate::model::settings;
use crate::source::SourceMap;
use crate::syntax::print::format;

use super::arguments::{Check, Cli, Doc, Fmt, Program};
use super::console::Console;
use super::engine::Signals;
use super::session::{self, read_text};
use super::status::Status;
use super::words;

/// `yont check FILE...`: each file is read on its own, and everything wrong with it is told.
pub fn check(console: &Console, signals: &Signals, options: &Check) -> Result<Status, Status> {
    let mut status = Status::Done;
    for file in &options.files {
        let program = Program { file: Some(file.clone()), no_prelude: options.no_prelude, ..Program::default() };
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
    let library = (!options.no_prelude).then(Library::shared);
    let Some(name) = &options.name else {
        console.print(&overview(library))?;
        return Ok(Status::Done);
    };
    let mut names = Vec::new();
    if let Some(file) = &options.file {
        let program = Program { file: Some(file.clone()), no_prelude: options.no_prelude, ..Program::default() };
        let (session, _) = session::open(console, signals, &program)?;
        if session.is_defined(name) {
            let doc = session.doc(name).unwrap_or_else(|| "No comment stands right above its definition.".into());
            let doc: Vec<String> = doc.lines().map(|line| format!("    {}", line.trim())).collect();
            console.print(&format!("{}\n{}", session.describe(name), doc.join("\n")))?;
            return Ok(Status::Done);
        }
        names = session.names();
    }
    match known(name, library) {
        Some(told) => console.print(&told).map(|()| Status::Done),
        None => {
            names.extend(library.into_iter().flat_map(Library::names).map(str::to_owned));
            Ok(console.refuse(&unknown(name, &names, options.file.is_some())))
        }
    }
}

/// What there is to say of a name of the library, a built-in function or a word of the language; nothing if it is none.
#[must_use]
pub fn known(name: &str, library: Option<&Library>) -> Option<String> {
    let entry = library.and_then(|library| library.entry(name)).map(|entry| explain_entry(&entry));
    entry.or_else(|| builtins::find(name).map(explain)).or_else(|| words::explain(name))
}

fn unknown(name: &str, names: &[String], with_file: bool) -> String {
    let known = builtins::all().flat_map(builtins::Builtin::names).chain(words::WORDS.iter().map(|word| word.0));
    let known = known.map(|known: &str| known);
    match near(name, names.iter().map(String::as_str).chain(known)) {
        Some(other) => format!("there is nothing called `{name}`; did you mean `{other}`?"),
        None if with_file => format!("neither the program nor the language has a `{name}`"),
        None => {
            format!("the language has no `{name}`; `yont doc` lists its functions, --file FILE adds those of a program")
        }
    }
}

/// The name that is nearest to one which means nothing.
#[must_use]
pub fn near<'a>(name: &str, names: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    suggest(name, names.map(|name| Candidate { name, preferred: false })).first().copied()
}

/// All names of the library and all built-in functions by subject, one a line.
fn overview(library: Option<&Library>) -> String {
    let mut lines: Vec<String> = Vec::new();
    for (subject, names) in library.map(Library::subjects).unwrap_or_default() {
        let entries: Vec<Entry> = names.iter().filter_map(|name| library?.entry(name)).collect();
        let width = entries.iter().map(|entry| entry.signature.chars().count()).max().unwrap_or(0);
        lines.push(format!("{subject}:"));
        lines.extend(entries.iter().map(|entry| format!("  {:width$}  {}", entry.signature, first(&entry.text))));
        lines.push(String::new());
    }
    let width = builtins::all().map(|builtin| builtin.signature().chars().count()).max().unwrap_or(0);
    let mut subject = None;
    for builtin in builtins::all() {
        if subject != Some(builtin.subject) {
            let gap = if subject.is_some() { "\n" } else { "" };
            lines.push(format!("{gap}{}:", builtin.subject));
            subject = Some(builtin.subject);
        }
        lines.push(format!("  {:width$}  {}", builtin.signature(), first(builtin.doc)));
    }
    lines.join("\n")
}

/// The first sentence of a text, or its first half.
fn first(text: &str) -> &str {
    let end = [". ", "; "].iter().filter_map(|end| text.find(end)).min();
    text[..end.unwrap_or(text.len())].trim_end_matches('.')
}

/// What there is to say of a name of the library.
fn explain_entry(entry: &Entry) -> String {
    let (source, value) = &entry.example;
    let from = [entry.source.as_str(), &entry.file].into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>();
    format!("{}\n    {}\n    {source} is {value}\n    {}", entry.signature, entry.text, from.join(", "))
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
    let command = Cli::command();
    let mut page = Vec::new();
    // Writing to memory does not fail.
    let _ = clap_mangen::Man::new(command.clone()).render(&mut page);
    let sections: String = command.get_subcommands().map(|sub| man_section(sub.clone())).collect();
    page.extend(sections.bytes());
    console.write(|out| out.write_all(&page)).map(|()| Status::Done)
}

/// A section about a command of its own: what it does, how it is called, its options.
fn man_section(command: clap::Command) -> String {
    let name = format!("yont {}", command.get_name());
    let about = command.get_about().map(ToString::to_string).unwrap_or_default();
    let man = clap_mangen::Man::new(command.bin_name(name.clone()).disable_help_flag(true));
    let mut parts = Vec::new();
    // As above.
    let _ = man.render_synopsis_section(&mut parts).and_then(|()| man.render_options_section(&mut parts));
    let parts = String::from_utf8_lossy(&parts).replace(".SH ", ".SS ");
    format!(".SH {}\n{about}.\n{parts}", name.to_uppercase())
}
