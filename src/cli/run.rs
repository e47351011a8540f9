//! `yont FILE -o OUT`: runs a program, tells what it printed, and makes what was asked for.

use crate::diagnostic::{Category, Diagnostic};
use crate::model::Event;
use crate::model::request::Output;

use super::Prompt;
use super::arguments::Run;
use super::console::Console;
use super::engine::Signals;
use super::status::Status;
use super::{make, mistakes, session, show};

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
    let idle = idle(&run, &outputs, empty);
    if let failed @ (Status::Failed | Status::Program) = console.report(session.sources(), &idle) {
        return Ok(failed);
    }
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
    if let Some(twice) = run.output.iter().enumerate().find(|(k, text)| run.output[..*k].contains(text)) {
        return Err(console.usage(&format!("`-o {}` is given twice", twice.1)));
    }
    if run.format.is_some() && !run.output.iter().any(|text| text == "-") {
        return Err(console.usage("--format is for `-o -`; the extension of a file decides its format"));
    }
    Ok(outputs)
}

/// Warnings for options that change nothing of what is asked for.
fn idle(run: &Run, outputs: &[Output], empty: bool) -> Vec<Diagnostic> {
    if outputs.is_empty() && (empty || run.interactive || show::drawing(run.making.display.images).is_some()) {
        return Vec::new();
    }
    let mut options = mistakes::without_effect(&run.making, outputs);
    // What holds for every run need not serve in each.
    options.retain(|option| !run.settings.iter().any(|setting| option.trim_start_matches('-') == setting));
    let warning = |option: &&str| {
        let title = match outputs {
            [] => format!("{option} has no effect: nothing is made"),
            [one] => format!("{option} has no effect on a .{}", one.format.extension()),
            _ => format!("{option} has no effect on any of these files"),
        };
        let told = Diagnostic::warning("no-effect", title).category(Category::Usage);
        if outputs.is_empty() { told.help("-o OUT says what to make, as in -o picture.png") } else { told }
    };
    options.iter().map(warning).collect()
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
