//! The file of settings: options that hold for every run, one a line, as at the prompt's `:set`. What the command line says wins.

use std::ffi::OsString;
use std::path::PathBuf;

use clap::parser::ValueSource;
use clap::{Arg, ArgMatches, Command, CommandFactory, FromArgMatches, Parser};

use crate::diagnostic::{Category, Diagnostic};
use crate::host::{Disk, Host, Reason, settings_folder, text};
use crate::limits::Limits;
use crate::source::{SourceMap, Span};

use super::arguments::{self, Cli, words_of};
use super::console::Console;
use super::status::Status;
use super::text::near;

/// Options that belong to one program or one run, and would make no sense for all of them.
const OF_ONE_RUN: [&str; 12] = [
    "evaluate",
    "define",
    "output",
    "format",
    "interactive",
    "exit-status",
    "object",
    "at",
    "bounds",
    "slices",
    "no-config",
    "help",
];

/// One line of the file.
struct Setting {
    name: String,
    value: Option<String>,
    span: Span,
}

/// Where the settings are looked for.
#[must_use]
pub fn file() -> Option<PathBuf> {
    settings_folder().map(|folder| folder.join("config"))
}

/// The command line with the settings of the file in front of its options.
///
/// # Errors
/// The status of a file that cannot be read or says something that is no setting; it has been told.
pub fn applied(cli: Cli, arguments: Vec<OsString>) -> Result<Cli, Status> {
    let console = Console::new(&cli.common);
    let Some(path) = file() else { return Ok(cli) };
    let limit = Limits::default().source_bytes;
    let words = match Disk.read(&path, limit).and_then(|bytes| text(&path, bytes)) {
        Ok(words) => words,
        Err(error) if error.reason == Reason::Missing => return Ok(cli),
        Err(error) => return Err(console.file_error(&error)),
    };
    let mut sources = SourceMap::default();
    let id = sources.add(path.display().to_string(), words.as_str());
    let settings = settings(&words, |start, end| Span::new(id, start, end));
    let told: Vec<Diagnostic> = settings.iter().filter_map(wrong).collect();
    if !told.is_empty() {
        return Err(console.report(&sources, &told));
    }
    with(&arguments, &settings).map_err(|error| console.report(&sources, &[refusal(words_of(error))]))
}

/// The lines that are neither empty nor comments.
fn settings(words: &str, span: impl Fn(usize, usize) -> Span) -> Vec<Setting> {
    let mut all = Vec::new();
    let mut at = 0;
    for line in words.split_inclusive('\n') {
        let plain = line.split('#').next().unwrap_or_default().trim();
        let start = at + line.find(plain).unwrap_or(0);
        at += line.len();
        if plain.is_empty() {
            continue;
        }
        let (name, value) = match plain.split_once(|c: char| c == '=' || c.is_whitespace()) {
            Some((name, value)) => (name, Some(value.trim().trim_start_matches('=').trim().to_owned())),
            None => (plain, None),
        };
        let name = name.trim_start_matches('-').to_owned();
        all.push(Setting { name, value, span: span(start, start + plain.len()) });
    }
    all
}

fn command() -> Command {
    let mut command = Cli::command();
    command.build();
    command
}

/// The options that may be set.
fn known(command: &Command) -> impl Iterator<Item = &Arg> {
    let allowed = |argument: &&Arg| argument.get_long().is_some_and(|name| !OF_ONE_RUN.contains(&name));
    command.get_arguments().filter(allowed).filter(|argument| argument.get_long() != Some("version"))
}

fn refusal(title: String) -> Diagnostic {
    Diagnostic::error("settings", title)
        .category(Category::Usage)
        .help("--no-config starts without the file of settings")
}

/// Why a line is no setting.
fn wrong(setting: &Setting) -> Option<Diagnostic> {
    let command = command();
    let name = &setting.name;
    let Some(argument) = known(&command).find(|argument| argument.get_long() == Some(name)) else {
        let told = refusal(format!("`{name}` is no setting")).at(setting.span, "");
        return Some(if OF_ONE_RUN.contains(&&**name) {
            told.fact(format!("--{name} belongs to one run"))
        } else {
            match near(name, known(&command).filter_map(Arg::get_long)) {
                Some(other) => told.help(format!("did you mean `{other}`?")),
                None => told.help("settings are the options of `yont --help` without their dashes"),
            }
        });
    };
    let takes = argument.get_action().takes_values();
    let title = match (&setting.value, takes) {
        (None, true) => format!("`{name}` needs a value"),
        (Some(_), false) => format!("`{name}` is on where it stands; it takes no value"),
        _ => match Cli::try_parse_from([OsString::from("yont"), word(setting)]) {
            Ok(_) => return None,
            Err(error) => words_of(error),
        },
    };
    Some(refusal(title).at(setting.span, ""))
}

fn word(setting: &Setting) -> OsString {
    match &setting.value {
        Some(value) => format!("--{}={value}", setting.name).into(),
        None => format!("--{}", setting.name).into(),
    }
}

/// Reads the command line anew with those settings that its command knows and that it says nothing else about.
fn with(arguments: &[OsString], settings: &[Setting]) -> Result<Cli, clap::Error> {
    let matches = Cli::command().try_get_matches_from(arguments)?;
    let whole = command();
    let (level, given, at) = match matches.subcommand() {
        Some((name, inner)) => {
            let at = arguments.iter().skip(1).position(|word| word == name).map_or(1, |at| at + 2);
            (whole.find_subcommand(name).unwrap_or(&whole), inner, at)
        }
        None => (&whole, &matches, 1),
    };
    let fitting: Vec<&Setting> = settings.iter().filter(|setting| fits(level, given, &setting.name)).collect();
    let mut all = arguments.to_vec();
    all.splice(at..at, fitting.iter().map(|setting| word(setting)));
    let mut cli = Cli::from_arg_matches(&Cli::command().try_get_matches_from(all)?)?;
    let run = if let Some(arguments::Command::Run(run)) = &mut cli.command { run } else { &mut cli.run };
    run.settings = fitting.iter().map(|setting| setting.name.clone()).collect();
    Ok(cli)
}

/// Whether a command has that option, and nothing on the command line says it or excludes it.
fn fits(level: &Command, given: &ArgMatches, name: &str) -> bool {
    let Some(argument) = level.get_arguments().find(|argument| argument.get_long() == Some(name)) else { return false };
    let said = |other: &Arg| {
        let id = other.get_id().as_str();
        given.ids().any(|known| known.as_str() == id) && given.value_source(id) == Some(ValueSource::CommandLine)
    };
    let excludes = |a: &Arg, b: &Arg| level.get_arg_conflicts_with(a).iter().any(|c| c.get_id() == b.get_id());
    !level.get_arguments().any(|other| {
        said(other) && (other.get_id() == argument.get_id() || excludes(argument, other) || excludes(other, argument))
    })
}
