//! From options to requests of the model, and what is told of the files that were made.

use std::io::BufWriter;
use std::time::Instant;

use crate::field::Coordinate;
use crate::model::request::{
    self, Cells, Options, Output, PictureOptions, Route, Sequence, Target, Timing, View, Written,
};
use crate::model::{Session, settings};

use super::arguments::{Making, Rays, Switch};
use super::console::Console;
use super::status::Status;

/// Which object, which part of its space, how finely; options win over what the program sets.
#[must_use]
pub fn view(making: &Making, default: &View) -> View {
    let cells = match (making.fineness.cell, making.fineness.resolution) {
        (Some(length), _) => Cells::Length(length),
        (None, Some(count)) => Cells::Along(count),
        (None, None) => default.cells,
    };
    View {
        object: making.subject.object.first().cloned(),
        beside: making.subject.object.iter().skip(1).cloned().collect(),
        at: making.subject.at.iter().map(|section| (Coordinate(section.coordinate), section.value)).collect(),
        bounds: making
            .subject
            .bounds
            .iter()
            .map(|extent| (Coordinate(extent.coordinate), extent.lo, extent.hi))
            .collect(),
        cells,
        precision: making.fineness.precision.unwrap_or_default().into(),
        route: making.way.along.route.as_deref().and_then(Route::from_name).unwrap_or(default.route),
        guide: making.way.guide.clone().unwrap_or_else(|| default.guide.clone()),
        centre: making.way.along.center.as_ref().map(|centre| centre.0.clone()),
        sharp: making.fineness.sharp.map_or(default.sharp, Switch::is_on),
    }
}

/// Makes one output and tells what was made.
///
/// # Errors
/// The status of a broken standard error or output.
pub fn make(console: &Console, session: &mut Session, making: &Making, output: &Output) -> Result<Status, Status> {
    let words = match &output.target {
        Target::Standard => "standard output".into(),
        Target::File(path) => path.display().to_string(),
        Target::Series { before, after } => format!("{before}{{n}}{after}"),
    };
    let begun = Instant::now();
    let made = {
        let _progress = console.progress(session.interrupt(), &words);
        let mut standard = BufWriter::new(std::io::stdout().lock());
        settings::defaults(session)
            .and_then(|defaults| request::write(session, output, &options(making, defaults), &mut standard))
    };
    console.timing(&words, begun.elapsed());
    let written = match made {
        Ok(written) => written,
        Err(diagnostics) => return Ok(console.report(session.sources(), &diagnostics)),
    };
    if !matches!(output.target, Target::Standard) {
        tell(console, &written);
    }
    Ok(console.report(session.sources(), &written.notes))
}

/// One line a file; what each cost with `-v` or `--timings`.
fn tell(console: &Console, written: &Written) {
    for (at, file) in written.files.iter().enumerate() {
        console.note(&match written.lines.get(at) {
            Some(line) if console.costs() => format!("{}: {line}", file.display()),
            _ => file.display().to_string(),
        });
    }
}

/// Everything that decides what is made; options win over what the program sets.
#[must_use]
pub fn options(making: &Making, defaults: Options) -> Options {
    let Options { view: own, picture, timing, .. } = defaults;
    let look = &making.look;
    let camera = look.camera.as_ref().map(ToString::to_string);
    Options {
        view: view(making, &own),
        picture: PictureOptions {
            size: look.size.map(|size| (size.width, size.height)).or(picture.size),
            supersample: look.supersample.unwrap_or(picture.supersample),
            view: camera.or_else(|| look.view.clone()).unwrap_or(picture.view),
            parallel: look.projection.map(|projection| projection == Rays::Orthographic).or(picture.parallel),
            light: look.light.or(picture.light),
            fill: look.fill.map_or(picture.fill, Switch::is_on),
            shadow: if look.no_shadow { false } else { look.shadow.map_or(picture.shadow, Switch::is_on) },
            occlusion: look.occlusion.map_or(picture.occlusion, Switch::is_on),
            background: look.background.map(|ground| ground.0).or(picture.background),
            palette: look.palette.clone().unwrap_or(picture.palette),
            axes: look.axes || picture.axes,
        },
        timing: Timing { frames: making.motion.frames.or(timing.frames), fps: making.motion.fps.unwrap_or(timing.fps) },
        slices: look.slices.map(|s| Sequence { coordinate: Coordinate(s.coordinate), values: s.places() }),
        cuts: look.cut.iter().map(|cut| cut.0).collect(),
    }
}
