//! The commands for carving: `:carve`, `:tool`, `:cut`, `:raise`, `:pick`. They read places and options; the model does the work.

use std::path::PathBuf;

use crate::cli::arguments::Making;
use crate::cli::make::options;
use crate::cli::show;
use crate::diagnostic::Diagnostic;
use crate::model::carving::{Carving, Drawn, Place, TOOLS, Way, places};
use crate::model::settings;

use super::Repl;
use super::commands::{Flow, unquoted};

/// What is being carved, and where its picture goes.
#[derive(Debug)]
pub struct Work {
    carving: Carving,
    /// The file; without one the picture is shown in the terminal.
    file: Option<PathBuf>,
    making: Making,
    /// Whether it was told already that the workpiece is gone.
    lost: bool,
}

/// `:carve NAME [FILE.png] [OPTION...]`
pub fn carve(repl: &mut Repl, argument: &str) -> Flow {
    let (words, given) =
        argument.split_once(" --").map_or((argument, ""), |(words, _)| (words, &argument[words.len()..]));
    let (name, file) = words.trim().split_once(char::is_whitespace).unwrap_or((words.trim(), ""));
    let file = Some(unquoted(file.trim())).filter(|file| !file.is_empty()).map(PathBuf::from);
    if let Some(file) =
        file.as_deref().filter(|file| !file.extension().is_some_and(|end| end.eq_ignore_ascii_case("png")))
    {
        return repl.refuse(&format!(":carve draws into a .png, not into `{}`", file.display()));
    }
    let making = match repl.looking_at(name).with(given) {
        Ok(making) => making,
        Err(words) => return repl.refuse(&words),
    };
    let begun = {
        let _progress = repl.console.progress(repl.session.interrupt(), "picture");
        settings::defaults(&repl.session)
            .and_then(|defaults| Carving::begin(&mut repl.session, &options(&making, defaults)))
    };
    let (mut carving, notes) = match begun {
        Ok(begun) => begun,
        Err(told) => return failed(repl, &told),
    };
    repl.console.report(repl.session.sources(), &notes);
    if making.look.occlusion.is_some_and(|occlusion| occlusion.is_on()) {
        repl.console
            .note("the picture of a workpiece has no occlusion, which would reach beyond a stroke; :render has it");
    }
    if let Some(work) = &repl.work {
        carving.hold(work.carving.tool().clone());
    }
    let [width, height] = [carving.image().width, carving.image().height];
    let tool = carving.tool().told();
    let count = carving.count();
    let strokes = if count == 0 { String::new() } else { format!(" with {count} strokes") };
    repl.console
        .note(&format!("{}{strokes} on a picture of {width} x {height} pixels; the tool is {tool}", carving.name()));
    repl.work = Some(Work { carving, file, making, lost: false });
    match picture(repl) {
        Flow::Go => Flow::Changed,
        other => other,
    }
}

/// `:tool [NAME [SIZE...] [SETTING...]]`
pub fn tool(repl: &mut Repl, words: &str) -> Flow {
    if words.is_empty() {
        let mut lines: Vec<String> = TOOLS
            .iter()
            .map(|kind| {
                let sizes: Vec<String> = kind.sizes.iter().map(|size| format!("[{}]", size.0)).collect();
                let usage = format!("{} {}", kind.name, sizes.join(" "));
                format!("{usage:36} {}", kind.what)
            })
            .collect();
        lines.push(format!("{:36} a solid of your own about the origin", "gob_NAME [SIZE], or an expression"));
        lines.push(
            "then depth=LENGTH into the surface, blend=LENGTH to round the edge, turn=DEGREES about the normal".into(),
        );
        lines.extend(repl.work.as_ref().map(|work| format!("in hand: {}", work.carving.tool().told())));
        return repl.show(&lines.join("\n"));
    }
    let Some(work) = &mut repl.work else { return no_workpiece(repl) };
    if let Err(told) = work.carving.take(&mut repl.session, words) {
        return failed(repl, &told);
    }
    let told = work.carving.tool().told();
    repl.changed(&format!("the tool is {told}"))
}

/// `:cut PLACE...`
pub fn cut(repl: &mut Repl, argument: &str) -> Flow {
    strokes(repl, Way::Cut, argument)
}

/// `:raise PLACE...`
pub fn raise(repl: &mut Repl, argument: &str) -> Flow {
    strokes(repl, Way::Raise, argument)
}

fn strokes(repl: &mut Repl, way: Way, argument: &str) -> Flow {
    let places = match places(argument) {
        Ok(places) => places,
        Err(told) => return failed(repl, &[told]),
    };
    let Some(work) = &mut repl.work else { return no_workpiece(repl) };
    let made = {
        let _progress = repl.console.progress(repl.session.interrupt(), "strokes");
        work.carving.strokes(&mut repl.session, way, &places)
    };
    let (spots, drawn) = match made {
        Ok(made) => made,
        Err(told) => return failed(repl, &told),
    };
    let beyond = if way == Way::Raise { work.carving.beyond(spots.len()) } else { None };
    let notes: Vec<Diagnostic> = beyond.into_iter().collect();
    let count = work.carving.count();
    let many = if spots.len() == 1 { "a stroke".to_owned() } else { format!("{} strokes", spots.len()) };
    let told = format!("{many}, {count} in all; {}", words(drawn));
    repl.console.report(repl.session.sources(), &notes);
    repl.console.note(&told);
    match picture(repl) {
        Flow::Go => Flow::Changed,
        other => other,
    }
}

fn words(drawn: Drawn) -> String {
    match drawn {
        Drawn::Same => "nothing that is seen has changed".into(),
        Drawn::Part(pixels) => format!("{pixels} pixels drawn anew"),
        Drawn::Whole => "drawn anew".into(),
    }
}

/// `:pick PLACE`
pub fn pick(repl: &mut Repl, argument: &str) -> Flow {
    let place = match places(argument) {
        Ok(places) => match places[..] {
            [place @ (Place::Pixel(_) | Place::Point(_))] => place,
            _ => return repl.refuse(":pick tells of one place: a pixel X,Y or a point [x1, x2, x3]"),
        },
        Err(told) => return failed(repl, &[told]),
    };
    let Some(work) = &mut repl.work else { return no_workpiece(repl) };
    match work.carving.pick(&mut repl.session, place) {
        Ok(spot) => repl.show(&spot.told()),
        Err(told) => failed(repl, &told),
    }
}

/// Brings the picture to what an input made of the workpiece: an undo, say, or another definition.
pub fn follow(repl: &mut Repl) {
    let Some(work) = &mut repl.work else { return };
    let before = (work.carving.hits(), work.lost);
    match work.carving.follow(&mut repl.session) {
        Ok(Drawn::Same) => work.lost = false,
        Ok(drawn) => {
            work.lost = false;
            repl.console.note(&format!("{}: {}", work.carving.name(), words(drawn)));
            let _ = picture(repl);
        }
        Err(told) => {
            work.lost = true;
            if !before.1 {
                repl.console.report(repl.session.sources(), &told);
            }
        }
    }
}

/// Writes the picture into its file, or shows it.
fn picture(repl: &mut Repl) -> Flow {
    let Some(work) = &repl.work else { return Flow::Go };
    if work.carving.hits() == 0 {
        repl.console.note(&format!("nothing of {} is left in the picture; :undo brings it back", work.carving.name()));
    }
    if let Some(file) = &work.file {
        return match work.carving.write(&repl.session, file) {
            Ok(()) => Flow::Go,
            Err(told) => failed(repl, &[told]),
        };
    }
    let shown = show::image(&repl.console, &work.making, work.carving.image());
    repl.ended(shown)
}

fn no_workpiece(repl: &Repl) -> Flow {
    repl.refuse("there is no workpiece yet: `:carve NAME` takes one, and shows it")
}

fn failed(repl: &Repl, told: &[Diagnostic]) -> Flow {
    Flow::Failed(repl.console.report(repl.session.sources(), told))
}
