//! `yont FILE -o OUT`: runs a program, tells what it printed, and makes what was asked for.

use crate::model::Event;
use crate::model::request::Output;

use super::Prompt;
use super::arguments::Run;
use super::console::Console;
use super::engine::Signals;
use super::status::Status;
use super::{make, session, show};

/// Runs a program, or the prompt when there is none.
///
/// # Errors
/// The status of what ended the run early.
pub fn run(console: &Console, signals: &Signals, run: Run, prompt: fn(Prompt) -> Status) -> Result<Status, Status> {
    let outputs = outputs(console, &run)?;
    let empty = run.program.file.is_none() && run.program.code.is_empty();
    if empty && !outputs.is_empty() {
        return Err(console.usage("no program: name a file, `-` for standard input, or -e 'CODE'"));
    }
    let (mut session, events) = session::open(console, signals, &run.program)?;
    let value = tell(console, &events, !outputs.is_empty())?;
    if outputs.is_empty() && !empty && !run.interactive && console.notes() && !session.objects().is_empty() {
        show::glance(console, &mut session, &run.making)?;
    }
    let mut status = Status::Done;
    for output in &outputs {
        status = status.or(make::make(console, &mut session, &run.making, output)?);
    }
    if run.exit_status && value == Some(0.0) {
        status = status.or(Status::Failed);
    }
    if !empty && !run.interactive {
        return Ok(status);
    }
    Ok(prompt(Prompt { console: console.clone(), signals: signals.clone(), session, making: run.making }))
}

fn outputs(console: &Console, run: &Run) -> Result<Vec<Output>, Status> {
    let outputs: Result<Vec<_>, _> = run.output.iter().map(|text| Output::parse(text, run.format)).collect();
    let outputs = outputs.map_err(|words| console.usage(&words))?;
    if run.format.is_some() && !run.output.iter().any(|text| text == "-") {
        return Err(console.usage("--format is for `-o -`; the extension of a file decides its format"));
    }
    Ok(outputs)
}

/// Tells what a program did: what it printed and the values of its expressions, and, unless files were asked for, each
/// object that it defined. Gives the value of the last expression, if that is a number.
///
/// # Errors
/// As [`Console::print`].
pub fn tell(console: &Console, events: &[Event], quiet: bool) -> Result<Option<f64>, Status> {
    let mut last = None;
    for event in events {
        match event {
            Event::Defined(line) if quiet => console.detail(line),
            Event::Defined(line) | Event::Printed(line) => console.print(line)?,
            Event::Value { text, number, .. } => {
                console.print(text)?;
                last = *number;
            }
        }
    }
    Ok(last)
}
