//! The prompt: reads inputs, gives them to the session, shows what comes back. Computes nothing.

mod asks;
mod carve;
pub mod commands;
pub mod helper;
pub mod history;
mod listen;
pub mod look;

use std::io::IsTerminal;
use std::time::{Duration, Instant};

use rustyline::error::ReadlineError;
use rustyline::history::MemHistory;
use rustyline::{ColorMode, Config, Editor};

use crate::cli::Prompt;
use crate::cli::arguments::Making;
use crate::cli::console::Console;
use crate::cli::engine::Signals;
use crate::cli::make::view;
use crate::cli::run::tell;
use crate::cli::sample::digits;
use crate::cli::show;
use crate::cli::status::Status;
use crate::host::{FileError, state_folder};
use crate::interrupt::Costs;
use crate::model::library::Library;
use crate::model::request::headline;
use crate::model::{Event, Session, settings};
use crate::syntax::Mode;
use crate::syntax::scan::{Scanner, TokenKind};

use commands::Flow;
use helper::Assistant;
use history::{HISTORY, Lost, Memory};
use listen::Inputs;

/// One prompt and what it knows.
#[derive(Debug)]
pub struct Repl {
    session: Session,
    console: Console,
    signals: Signals,
    making: Making,
    memory: Memory,
    lost: Option<Lost>,
    inputs: usize,
    /// The last value, as an expression: what `_` stands for.
    last: Option<String>,
    /// What the last input took.
    costs: Option<(Duration, Costs)>,
    /// Comments that were typed as inputs of their own: they document what comes next.
    comments: String,
    /// What is being carved.
    work: Option<carve::Work>,
}

/// Runs the prompt until the user leaves, or, without a terminal, until the input ends.
pub fn start(prompt: Prompt) -> Status {
    let terminal = std::io::stdin().is_terminal();
    let memory = Memory::in_folder(if terminal { state_folder() } else { None });
    let Prompt { session, console, signals, making, .. } = prompt;
    let (lost, last, costs, comments, work) = Default::default();
    let repl = Repl { session, console, signals, making, memory, lost, inputs: 0, last, costs, comments, work };
    if terminal { repl.converse() } else { repl.listen() }
}

impl Repl {
    /// With a terminal: a banner, a prompt, and nothing that fails ends it.
    fn converse(mut self) -> Status {
        self.signals.at_prompt();
        self.console.note(&format!("Yont {}. `:help` for help, Ctrl-D to leave.", env!("CARGO_PKG_VERSION")));
        self.lost = self.memory.lost();
        if let Some(lost) = &self.lost {
            let count = lost.inputs.len();
            self.console.note(&format!("A session ended without being left; `:recover` runs its {count} inputs."));
        }
        let mut editor = match self.editor() {
            Ok(editor) => editor,
            Err(error) => {
                self.console.note(&format!("no line editing: {error}"));
                return self.listen();
            }
        };
        loop {
            match editor.readline("yont> ") {
                Ok(line) if line.trim().is_empty() => {}
                Ok(line) => {
                    // The editor's own history only refuses what is already there.
                    let _ = editor.add_history_entry(line.as_str());
                    let typed = self.memory.typed(&line);
                    self.remember(typed);
                    if self.take(&line) == Flow::Leave {
                        break;
                    }
                    if let Some(assistant) = editor.helper_mut() {
                        assistant.names = self.all_names();
                    }
                }
                Err(ReadlineError::Interrupted) => {}
                Err(ReadlineError::Eof) => break,
                Err(error) => {
                    self.console.note(&format!("the terminal is gone: {error}"));
                    return Status::File;
                }
            }
        }
        self.memory.left();
        Status::Done
    }

    fn editor(&self) -> rustyline::Result<Editor<Assistant, MemHistory>> {
        let colour = self.console.colour();
        let mode = if colour { ColorMode::Enabled } else { ColorMode::Disabled };
        let config = Config::builder().max_history_size(HISTORY)?.color_mode(mode).build();
        let history = MemHistory::with_config(&config);
        let mut editor = Editor::with_history(config, history)?;
        editor.set_helper(Some(Assistant { names: self.all_names(), colour }));
        for input in self.memory.history() {
            // The editor's own history only refuses what is already there.
            let _ = editor.add_history_entry(input);
        }
        Ok(editor)
    }

    /// Without a terminal: no banner and no prompt; the first error decides the status.
    fn listen(mut self) -> Status {
        let mut status = Status::Done;
        let mut inputs = Inputs::of_standard_input();
        loop {
            let input = match inputs.next() {
                Ok(Some(input)) => input,
                Ok(None) => return status,
                Err(error) => return status.or(self.console.file_error(&error)),
            };
            match self.take(&input) {
                Flow::Leave => return status,
                Flow::Failed(Status::Cancelled) => return Status::Cancelled,
                Flow::Failed(failed) => status = status.or(failed),
                Flow::Go | Flow::Changed => {}
            }
        }
    }

    /// One input, and what it costs.
    fn take(&mut self, input: &str) -> Flow {
        self.signals.interrupt.reset();
        let begun = Instant::now();
        let flow = self.answer(input);
        let asks_for_time = commands::called(input.trim()).is_some_and(|command| command.name == "time");
        if !input.trim().is_empty() && !asks_for_time {
            self.costs = Some((begun.elapsed(), self.signals.interrupt.costs()));
        }
        flow
    }

    /// One input: a command, a question, or a piece of program.
    fn answer(&mut self, input: &str) -> Flow {
        let trimmed = input.trim();
        let documented = std::mem::take(&mut self.comments) + input;
        let flow = match question(trimmed) {
            _ if trimmed.is_empty() => return Flow::Go,
            _ if trimmed.starts_with(':') => commands::run(self, trimmed),
            Some((name, false)) => commands::doc(self, name),
            Some((name, true)) => commands::definition(self, name),
            None if is_comment(trimmed) => {
                self.comments = documented.trim_end().to_owned() + "\n";
                return Flow::Go;
            }
            None if !self.session.is_defined(first_word(trimmed)) && commands::without_colon(trimmed).is_some() => {
                let meant = commands::without_colon(trimmed).unwrap_or_default();
                self.refuse(&format!("commands begin with a colon: `{meant}`"))
            }
            None => {
                self.inputs += 1;
                let name = format!("<input {}>", self.inputs);
                self.feed(&name, &documented, Mode::Prompt)
            }
        };
        if flow == Flow::Changed {
            carve::follow(self);
            let kept = self.memory.accepted(if trimmed.starts_with(':') { trimmed } else { &documented });
            self.remember(kept);
        }
        flow
    }

    fn feed(&mut self, name: &str, text: &str, mode: Mode) -> Flow {
        let text = &self.with_last(text);
        let outcome = self.session.input(name, text, mode);
        if outcome.accepted
            && let Some(Event::Value { text: shown, number, .. }) = outcome.events.last()
        {
            self.last = Some(last_value(text, shown, *number));
        }
        let status = self.console.report(self.session.sources(), &outcome.diagnostics);
        match self.told_events(&outcome.events, mode) {
            Ok(_) if outcome.accepted => Flow::Changed,
            Ok(_) => Flow::Failed(status),
            Err(Status::Done) => Flow::Leave,
            Err(failed) => Flow::Failed(failed),
        }
    }

    /// Tells what an input did; an object that was typed shows itself.
    fn told_events(&mut self, events: &[Event], mode: Mode) -> Result<(), Status> {
        for event in events {
            match event {
                Event::Value { object: Some(name), text, .. } if mode == Mode::Prompt => {
                    self.show_object(name, text)?
                }
                other => tell(&self.console, std::slice::from_ref(other), false).map(drop)?,
            }
        }
        Ok(())
    }

    fn show_object(&mut self, name: &str, otherwise: &str) -> Result<(), Status> {
        let making = self.looking_at(name);
        let told = settings::defaults(&self.session)
            .and_then(|defaults| headline(&mut self.session, &view(&making, &defaults.view)));
        match told {
            Ok(line) => self.console.print(&line)?,
            Err(_) => self.console.print(otherwise)?,
        }
        show::glance(&self.console, &mut self.session, &making)
    }

    /// The options, with another object if one is named.
    fn looking_at(&self, name: &str) -> Making {
        let mut making = self.making.clone();
        if !name.is_empty() {
            making.subject.object = vec![name.to_owned()];
        }
        making
    }

    /// The text with each `_` replaced by the last value.
    fn with_last(&self, text: &str) -> String {
        let Some(last) = &self.last else { return text.to_owned() };
        let (mut result, mut end) = (String::new(), 0);
        for token in Scanner::new(text, 0, text.len()).filter(|token| token.text(text) == "_") {
            result += &text[end..token.start];
            result += last;
            end = token.end;
        }
        result + &text[end..]
    }

    /// The user's names, then those of the library.
    fn all_names(&self) -> Vec<String> {
        let mut names = self.session.names();
        names.extend(self.session.library().into_iter().flat_map(Library::names).map(str::to_owned));
        names
    }

    /// A disk that keeps no history is told of once; the prompt goes on.
    fn remember(&mut self, kept: Result<(), FileError>) {
        if let Err(error) = kept {
            self.console.note(&format!("{error}; this session keeps no history"));
            self.memory = Memory::default();
        }
    }

    fn show(&self, text: &str) -> Flow {
        self.ended(self.console.print(text).map(|()| Status::Done))
    }

    fn told(&self, text: &str) -> Flow {
        self.console.note(text);
        Flow::Go
    }

    fn changed(&self, text: &str) -> Flow {
        self.console.note(text);
        Flow::Changed
    }

    fn refuse(&self, words: &str) -> Flow {
        Flow::Failed(self.console.refuse(words))
    }

    fn ended(&self, result: Result<Status, Status>) -> Flow {
        match result {
            Ok(Status::Done) => Flow::Go,
            // Nobody reads standard output any more.
            Err(Status::Done) => Flow::Leave,
            Ok(failed) | Err(failed) => Flow::Failed(failed),
        }
    }
}

fn first_word(text: &str) -> &str {
    text.split(|c: char| !c.is_alphanumeric() && c != '_').next().unwrap_or_default()
}

/// Whether a text holds comments and nothing else.
fn is_comment(text: &str) -> bool {
    Scanner::new(text, 0, text.len()).all(|token| token.kind == TokenKind::Comment)
}

/// A value as an expression: a number by its digits, anything else by what was typed, which means the same again.
fn last_value(typed: &str, shown: &str, number: Option<f64>) -> String {
    let single = typed.trim().trim_end_matches(';');
    match number {
        Some(number) if number.is_finite() => format!("({})", digits(number)),
        _ if single.contains(';') => format!("({shown})"),
        _ if single.chars().all(|c| c.is_alphanumeric() || c == '_') => single.to_owned(),
        _ => format!("({single})"),
    }
}

/// `NAME?` and `NAME??`: the name, and whether its definition is asked for.
fn question(input: &str) -> Option<(&str, bool)> {
    let (name, whole) = match input.strip_suffix("??") {
        Some(name) => (name, true),
        None => (input.strip_suffix('?')?, false),
    };
    let name = name.trim();
    (!name.is_empty() && name.chars().all(|c| c.is_alphanumeric() || c == '_')).then_some((name, whole))
}
