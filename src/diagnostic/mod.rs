//! Errors, warnings and notes as data. Renderings stand beside; nothing here prints.

pub mod near;
pub mod render;

use crate::source::Span;

/// How grave a diagnostic is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// Worth knowing; nothing is wrong.
    Note,
    /// Probably not what was meant; the work goes on.
    Warning,
    /// The input or the work failed.
    Error,
}

/// What failed, which decides the exit status.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Category {
    /// Ran, and the result is a failure: an empty object. Exit status 1.
    Result,
    /// The command line. Exit status 2.
    Usage,
    /// The program. Exit status 3.
    Program,
    /// A file could not be read or written. Exit status 4.
    File,
    /// Ctrl-C. Exit status 130.
    Cancelled,
}

/// A place in a source text and what is to be said of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Label {
    /// The place.
    pub span: Span,
    /// A few words; may be empty.
    pub text: String,
    /// Whether this is the place of the error itself (`^^^`) or one that explains it (`---`).
    pub primary: bool,
}

/// One message to the user.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// A stable name of the kind of message, in kebab case: `unknown-name`. One golden test for each.
    pub code: &'static str,
    /// How grave.
    pub severity: Severity,
    /// What failed.
    pub category: Category,
    /// What was found, in the user's words; one line, no full stop.
    pub title: String,
    /// Where; the first primary label is the place of the message.
    pub labels: Vec<Label>,
    /// What to do, one suggestion each.
    pub help: Vec<String>,
    /// Facts that explain, one each.
    pub notes: Vec<String>,
}

impl Diagnostic {
    /// An error in the program.
    #[must_use]
    pub fn error(code: &'static str, title: impl Into<String>) -> Self {
        Self {
            code,
            severity: Severity::Error,
            category: Category::Program,
            title: title.into(),
            labels: Vec::new(),
            help: Vec::new(),
            notes: Vec::new(),
        }
    }

    /// A warning.
    #[must_use]
    pub fn warning(code: &'static str, title: impl Into<String>) -> Self {
        Self { severity: Severity::Warning, ..Self::error(code, title) }
    }

    /// A note.
    #[must_use]
    pub fn note(code: &'static str, title: impl Into<String>) -> Self {
        Self { severity: Severity::Note, ..Self::error(code, title) }
    }

    /// The same message in another category.
    #[must_use]
    pub fn category(mut self, category: Category) -> Self {
        self.category = category;
        self
    }

    /// Adds the place of the message.
    #[must_use]
    pub fn at(mut self, span: Span, text: impl Into<String>) -> Self {
        self.labels.push(Label { span, text: text.into(), primary: true });
        self
    }

    /// Adds a place that explains.
    #[must_use]
    pub fn see(mut self, span: Span, text: impl Into<String>) -> Self {
        self.labels.push(Label { span, text: text.into(), primary: false });
        self
    }

    /// Adds a suggestion.
    #[must_use]
    pub fn help(mut self, text: impl Into<String>) -> Self {
        self.help.push(text.into());
        self
    }

    /// Adds a fact.
    #[must_use]
    pub fn fact(mut self, text: impl Into<String>) -> Self {
        self.notes.push(text.into());
        self
    }

    /// Whether this is an error.
    #[must_use]
    pub fn is_error(&self) -> bool {
        self.severity == Severity::Error
    }
}
