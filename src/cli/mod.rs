//! The command line: options in, requests to the model, results and exit statuses out. Computes nothing.

pub mod arguments;
pub mod config;
pub mod console;
pub mod engine;
pub mod inspect;
pub mod make;
pub mod mistakes;
pub mod progress;
pub mod run;
pub mod sample;
pub mod session;
pub mod show;
pub mod status;
pub mod text;
pub mod values;
mod way;
pub mod words;

use std::ffi::OsString;
use std::time::Instant;

use clap::error::ErrorKind;
use clap::{CommandFactory, Parser};

use crate::model::Session;

use arguments::{Cli, Command, Making, Run};
use console::Console;
use engine::Signals;
use status::Status;

/// What a prompt needs.
#[derive(Debug)]
pub struct Prompt {
    /// How it talks.
    pub console: Console,
    /// What Ctrl-C does.
    pub signals: Signals,
    /// The program so far.
    pub session: Session,
    /// The options so far.
    pub making: Making,
}

/// The whole program: `arguments` as the shell gives them, `prompt` for a run without a program.
pub fn main(arguments: impl IntoIterator<Item = OsString>, prompt: fn(Prompt) -> Status) -> Status {
    let arguments: Vec<OsString> = arguments.into_iter().collect();
    let read = match Cli::try_parse_from(&arguments).and_then(unmixed) {
        Ok(cli) => cli,
        Err(error) => {
            let error = mistakes::explained(error, &arguments);
            // Help that nobody reads any more is no error either.
            let _ = error.print();
            return if error.use_stderr() { Status::Usage } else { Status::Done };
        }
    };
    let cli = if read.common.no_config { Ok(read) } else { config::applied(read, arguments) };
    match cli {
        Ok(cli) => engine::run(cli.common.threads, move |signals| timed(cli, signals, prompt)),
        Err(refused) => refused,
    }
}

/// Refuses options of a run in front of a command: they would do nothing.
fn unmixed(cli: Cli) -> Result<Cli, clap::Error> {
    if cli.command.is_some() && cli.run != Run::default() {
        let words = "what stands before a command is only -j, --timings, -q, -v, --color, --diagnostics and -W; \
                     a program and its options stand after it";
        return Err(Cli::command().error(ErrorKind::ArgumentConflict, words));
    }
    Ok(cli)
}

fn timed(cli: Cli, signals: &Signals, prompt: fn(Prompt) -> Status) -> Status {
    let console = Console::new(&cli.common);
    let start = Instant::now();
    let status = dispatch(cli, &console, signals, prompt).unwrap_or_else(|ended| ended);
    let costs = signals.interrupt.costs();
    costs.phases.iter().for_each(|(name, time)| console.timing(name, *time));
    if !costs.kept.is_nothing() {
        console.timed(&format!("kept from before: {}", costs.kept));
    }
    console.timing("all", start.elapsed());
    status
}

/// An `Err` is an early end, an `Ok` a late one; both are statuses.
fn dispatch(cli: Cli, console: &Console, signals: &Signals, prompt: fn(Prompt) -> Status) -> Result<Status, Status> {
    match cli.command {
        None => run::run(console, signals, cli.run, prompt),
        Some(Command::Run(run)) => run::run(console, signals, *run, prompt),
        Some(Command::Info(info)) => inspect::info(console, signals, &info),
        Some(Command::Measure(measure)) => inspect::measure(console, signals, &measure),
        Some(Command::Sample(sample)) => sample::sample(console, signals, &sample),
        Some(Command::Check(check)) => text::check(console, signals, &check),
        Some(Command::Fmt(fmt)) => text::fmt(console, &fmt),
        Some(Command::Doc(doc)) => text::doc(console, signals, &doc),
        Some(Command::Completions { shell }) => text::completions(console, shell),
        Some(Command::Man) => text::man(console),
    }
}
