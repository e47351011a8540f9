//! The commands that are about texts and words: `check`, `fmt`, `doc`, `completions`, `man`.

use std::path::Path;

use clap::CommandFactory;

use crate::builtins;
use crate::host::{self, Disk, FileError, Host};
use crate::limits::Limits;
use crate::source::SourceMap;

use super::arguments::{Check, Cli, Doc, Fmt};
use super::console::Console;
use super::engine::Signals;
use super::session::{load, read_text};
use super::status::Status;

/// `yont check FILE...`: each file is read on its own, and everything wrong with it is told.
pub fn check(console: &Console, signals: &Signals, options: &Check) -> Result<Status, Status> {
    let mut status = Status::Done;
    for file in &options.files {
        status = status.or(match load(console, signals, file) {
            Ok(_) => Status::Done,
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
    let formatted = match crate::syntax::print::format(&mut sources, &file.display().to_string(), &text, &Limits::default()) {
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
