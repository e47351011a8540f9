//! Exit statuses, and the early end of a command.

use std::process::ExitCode;

use crate::diagnostic::{Category, Diagnostic};

/// How the program ends.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Status {
    /// 0: done.
    #[default]
    Done,
    /// 1: ran, and the result is a failure.
    Failed,
    /// 2: the command line.
    Usage,
    /// 3: an error in the program.
    Program,
    /// 4: a file could not be read or written.
    File,
    /// 130: Ctrl-C.
    Cancelled,
}

impl Status {
    /// The number that the shell sees.
    #[must_use]
    pub fn code(self) -> u8 {
        match self {
            Self::Done => 0,
            Self::Failed => 1,
            Self::Usage => 2,
            Self::Program => 3,
            Self::File => 4,
            Self::Cancelled => 130,
        }
    }

    /// The first failure of two.
    #[must_use]
    pub fn or(self, later: Self) -> Self {
        if self == Self::Done { later } else { self }
    }

    /// The status of a set of messages: that of a cancellation if there is one, else of the first error.
    #[must_use]
    pub fn of(diagnostics: &[Diagnostic]) -> Self {
        let errors = || diagnostics.iter().filter(|d| d.is_error());
        match errors().find(|d| d.category == Category::Cancelled).or_else(|| errors().next()) {
            Some(error) => Self::from(error.category),
            None => Self::Done,
        }
    }
}

impl From<Category> for Status {
    fn from(category: Category) -> Self {
        match category {
            Category::Result => Self::Failed,
            Category::Usage => Self::Usage,
            Category::Program => Self::Program,
            Category::File => Self::File,
            Category::Cancelled => Self::Cancelled,
        }
    }
}

impl From<Status> for ExitCode {
    fn from(status: Status) -> Self {
        Self::from(status.code())
    }
}
