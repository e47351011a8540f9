//! From options to requests of the model, and what is told of the files that were made.

use std::path::PathBuf;
use std::time::Instant;

use crate::field::Coordinate;
use crate::model::Session;
use crate::model::request::{self, Cells, Options, Output, PictureOptions, Timing, View};

use super::arguments::Making;
use super::console::Console;
use super::engine::Signals;
use super::status::Status;

/// Which object, which part of its space, how finely.
#[must_use]
pub fn view(making: &Making) -> View {
    let default = View::default();
    let cells = match (making.fineness.cell, making.fineness.resolution) {
        (Some(length), _) => Cells::Length(length),
        (None, Some(count)) => Cells::Along(count),
        (None, None) => default.cells,
    };
    View {
        object: making.subject.object.clone(),
        at: making.subject.at.iter().map(|section| (Coordinate(section.coordinate), section.value)).collect(),
        bounds: making
            .subject
            .bounds
            .iter()
            .map(|extent| (Coordinate(extent.coordinate), extent.lo, extent.hi))
            .collect(),
        cells,
    }
}
pub fn make(_: &Console, _: &Signals, _: &mut Session, _: &Making, _: &Output) -> Result<Status, Status> {
    Ok(Status::Done)
}

/// Everything that decides what is made.
#[must_use]
pub fn options(making: &Making) -> Options {
    let (picture, timing) = (PictureOptions::default(), Timing::default());
    let look = &making.look;
    Options {
        view: view(making),
        picture: PictureOptions {
            size: look.size.map_or(picture.size, |size| (size.width, size.height)),
            supersample: look.supersample.unwrap_or(picture.supersample),
            view: look.view.clone().unwrap_or(picture.view),
            camera: look.camera,
            palette: look.palette.clone().unwrap_or(picture.palette),
        },
        timing: Timing { frames: making.motion.frames, fps: making.motion.fps.unwrap_or(timing.fps) },
    }
}
