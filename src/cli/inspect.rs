//! `yont info` and `yont measure`: what the model knows of objects, as lines or as JSON.

use std::path::PathBuf;

use serde_json::{Map, Value, json};

use crate::host;
use crate::model::request::{self, Info};
use crate::model::{Session, settings};

use super::arguments::{self, Making};
use super::console::Console;
use super::engine::Signals;
use super::make::view;
use super::status::Status;
use super::way::Way;
use super::{config, session};

/// `yont info FILE`.
///
/// # Errors
/// The status of what ended the command early.
pub fn info(console: &Console, signals: &Signals, options: &arguments::Info) -> Result<Status, Status> {
    if options.paths {
        return paths(console, options.json);
    }
    let (mut session, _) = session::required(console, signals, &options.program)?;
    let found = {
        let _progress = console.progress(session.interrupt(), "looking for objects");
        request::info(&mut session, options.object.as_deref())
    };
    let all = match found {
        Ok(all) => all,
        Err(diagnostics) => return Ok(console.report(session.sources(), &diagnostics)),
    };
    if all.is_empty() && !options.json {
        console.note("nothing here is an object: the name of one begins with `gob_`");
    } else if options.json {
        let objects: Vec<Value> = all.iter().map(Info::json).collect();
        console.print(&json!({ "objects": objects }).to_string())?;
    } else {
        let texts: Vec<String> = all.iter().map(Info::to_string).collect();
        console.print(&texts.join("\n\n"))?;
    }
    Ok(Status::Done)
}

/// `yont info --paths`: where things lie, whether they are there yet or not.
fn paths(console: &Console, json: bool) -> Result<Status, Status> {
    let state = host::state_folder();
    let inside = |name: &str| state.as_ref().map(|folder| folder.join(name));
    let all = [("settings", config::file()), ("history", inside("history")), ("sessions", inside("sessions"))];
    let shown = |path: &Option<PathBuf>| path.as_ref().map(|path| path.display().to_string());
    if json {
        let all: Map<String, Value> = all.iter().map(|(name, path)| ((*name).into(), json!(shown(path)))).collect();
        console.print(&Value::Object(all).to_string())?;
        return Ok(Status::Done);
    }
    for (name, path) in &all {
        let words = shown(path).unwrap_or_else(|| "nowhere: there is no home folder".into());
        console.print(&format!("{name:<9} {words}"))?;
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
    let way = Way { along: options.along.clone(), ..Way::default() };
    let making = Making { subject, fineness, way, ..Making::default() };
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
        Ok(measured) => {
            let text = if json { measured.json().to_string() } else { measured.to_string() };
            console.print(&text)?;
            Ok(console.report(session.sources(), &measured.notes))
        }
        Err(diagnostics) => Ok(console.report(session.sources(), &diagnostics)),
    }
}
