//! `yont info` and `yont measure`: what the model knows of objects, as lines or as JSON.

use serde_json::{Value, json};

use crate::model::request::{self, Info};
use crate::model::{Session, settings};

use super::arguments::{self, Making};
use super::console::Console;
use super::engine::Signals;
use super::make::view;
use super::session;
use super::status::Status;

/// `yont info FILE`.
///
/// # Errors
/// The status of what ended the command early.
pub fn info(console: &Console, signals: &Signals, options: &arguments::Info) -> Result<Status, Status> {
    let (mut session, _) = session::required(console, signals, &options.program)?;
    if let Some(name) = &options.object
        && let Err(diagnostics) = session.object(Some(name))
    {
        return Ok(console.report(session.sources(), &diagnostics));
    }
    let all = match request::info(&mut session) {
        Ok(all) => all,
        Err(diagnostics) => return Ok(console.report(session.sources(), &diagnostics)),
    };
    let wanted = |info: &&Info| options.object.as_ref().is_none_or(|name| info.json()["name"] == **name);
    let wanted: Vec<&Info> = all.iter().filter(wanted).collect();
    if options.json {
        let objects: Vec<Value> = wanted.into_iter().map(Info::json).collect();
        console.print(&json!({ "objects": objects }).to_string())?;
    } else {
        wanted.into_iter().try_for_each(|info| console.print(&info.to_string()))?;
    }
    Ok(Status::Done)
}

/// `yont measure FILE`.
///
/// # Errors
/// The status of what ended the command early.
pub fn measure(console: &Console, signals: &Signals, options: &arguments::Measure) -> Result<Status, Status> {
    let (mut session, _) = session::required(console, signals, &options.program)?;
    let (subject, fineness) = (options.subject.clone(), options.fineness.clone());
    let making = Making { subject, fineness, ..Making::default() };
    measure_one(console, &mut session, &making, options.json)
}

/// Measures an object of a session.
///
/// # Errors
/// The status of a broken standard output.
pub fn measure_one(console: &Console, session: &mut Session, making: &Making, json: bool) -> Result<Status, Status> {
    let measured = {
        let _progress = console.progress(session.interrupt(), "measuring");
        settings::defaults(session).and_then(|defaults| request::measure(session, &view(making, &defaults.view)))
    };
    match measured {
        Ok(measured) if json => console.print(&measured.json().to_string()).map(|()| Status::Done),
        Ok(measured) => console.print(&measured.to_string()).map(|()| Status::Done),
        Err(diagnostics) => Ok(console.report(session.sources(), &diagnostics)),
    }
}
