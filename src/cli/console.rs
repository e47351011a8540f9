//! Standard output and standard error: results to the one, messages to the other, colours only where they are wanted.

use std::io::{self, IsTerminal, Write};
use std::path::Path;
use std::time::Duration;

use crate::diagnostic::render::{self, Colour};
use crate::diagnostic::{Category, Diagnostic, Severity};
use crate::host::{Doing, FileError, Reason, reason, variable};
use crate::interrupt::Interrupt;
use crate::source::SourceMap;

use super::arguments::{Common, Rendering, When};
use super::progress::Progress;
use super::status::Status;

/// How this run talks.
#[derive(Clone, Debug)]
pub struct Console {
    rendering: Rendering,
    colour: bool,
    quiet: bool,
    verbose: bool,
    timings: bool,
    strict: bool,
}

impl Console {
    /// What the options say.
    #[must_use]
    pub fn new(common: &Common) -> Self {
        Self {
            rendering: common.diagnostics,
            colour: coloured(common.color, io::stderr().is_terminal()),
            quiet: common.quiet,
            verbose: common.verbose,
            timings: common.timings,
            strict: common.strict,
        }
    }

    /// Whether messages are coloured.
    #[must_use]
    pub fn colour(&self) -> bool {
        self.colour
    }

    /// Writes a result to standard output, with a line break.
    ///
    /// # Errors
    /// The status to end with: done when the reader has gone, that of a file when the output cannot be written.
    pub fn print(&self, text: &str) -> Result<(), Status> {
        self.write(|out| writeln!(out, "{text}"))
    }

    /// Writes to standard output whatever `content` writes.
    ///
    /// # Errors
    /// As [`Console::print`].
    pub fn write(&self, content: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), Status> {
        let mut out = io::BufWriter::new(io::stdout().lock());
        match content(&mut out).and_then(|()| out.flush()) {
            Ok(()) => Ok(()),
            Err(error) => {
                // What is still in the buffer would fail again when it is dropped.
                let _ = out.into_parts();
                self.broken_output(&error)
            }
        }
    }

    fn broken_output(&self, error: &io::Error) -> Result<(), Status> {
        match reason(error) {
            Reason::Closed => Err(Status::Done),
            reason => {
                let path = Path::new("standard output").to_path_buf();
                self.file_error(&FileError { path, doing: Doing::Writing, reason });
                Err(Status::File)
            }
        }
    }

    /// Writes a line to standard error, unless it is to be quiet.
    pub fn note(&self, text: &str) {
        if !self.quiet {
            self.say(text);
        }
    }

    /// Whether notes are told: what nobody asked for.
    #[must_use]
    pub fn notes(&self) -> bool {
        !self.quiet
    }

    /// Whether to tell what a result cost.
    #[must_use]
    pub fn costs(&self) -> bool {
        self.verbose || self.timings
    }

    /// Tells how long `what` took, with `--timings`.
    pub fn timing(&self, what: &str, time: Duration) {
        self.timed(&format!("{what}: {:.3} s", time.as_secs_f64()));
    }

    /// Tells something about what the work cost, with `--timings`.
    pub fn timed(&self, words: &str) {
        if self.timings {
            self.say(words);
        }
    }

    /// Refuses what was asked for at the prompt.
    pub fn refuse(&self, words: &str) -> Status {
        self.report(&SourceMap::default(), &[Diagnostic::error("command", words).category(Category::Usage)])
    }

    /// Writes a line to standard error with `-v`.
    pub fn detail(&self, text: &str) {
        if self.verbose {
            self.say(text);
        }
    }

    /// Tells of a file that could not be read or written.
    pub fn file_error(&self, error: &FileError) -> Status {
        self.report(&SourceMap::default(), &[error.diagnostic()])
    }

    /// Tells what is wrong with the command line.
    pub fn usage(&self, words: &str) -> Status {
        let diagnostic = Diagnostic::error("usage", words).category(Category::Usage);
        self.report(&SourceMap::default(), &[diagnostic.help("`yont --help` shows all options")])
    }

    /// Shows diagnostics and gives the status that they make.
    pub fn report(&self, sources: &SourceMap, diagnostics: &[Diagnostic]) -> Status {
        for diagnostic in diagnostics.iter().filter(|d| !self.quiet || d.is_error()) {
            self.say(self.rendered(sources, diagnostic).trim_end());
        }
        let warned = self.strict && diagnostics.iter().any(|d| d.severity == Severity::Warning);
        Status::of(diagnostics).or(if warned { Status::Program } else { Status::Done })
    }

    fn rendered(&self, sources: &SourceMap, diagnostic: &Diagnostic) -> String {
        match self.rendering {
            Rendering::Human => {
                render::human(diagnostic, sources, if self.colour { Colour::Ansi } else { Colour::Plain })
            }
            Rendering::Short => render::short(diagnostic, sources),
            Rendering::Json => render::json(diagnostic, sources),
        }
    }

    /// A progress bar for `what`, where one can be seen.
    #[must_use]
    pub fn progress(&self, interrupt: &Interrupt, what: &str) -> Progress {
        Progress::watch(interrupt, what, !self.quiet && io::stderr().is_terminal())
    }

    // Standard error that cannot be written leaves nobody to tell.
    fn say(&self, text: &str) {
        let _ = writeln!(io::stderr().lock(), "{text}");
    }
}

fn coloured(when: When, terminal: bool) -> bool {
    match when {
        When::Always => true,
        When::Never => false,
        When::Auto => terminal && variable("NO_COLOR").is_none(),
    }
}
