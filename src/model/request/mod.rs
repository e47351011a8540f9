//! What can be asked of an object of a session: a mesh, a picture, frames, a sampled field, values, measures. One meaning for the command
//! line and the prompt, which only read options and show results.

mod ask;
mod boundaries;
mod charts;
pub mod fields;
mod info;
mod make;
pub mod measured;
pub mod output;
pub mod paint;
mod pictures;
mod preview;
mod solids;
mod space;
pub mod subject;
mod told;

pub use crate::vm::Precision;
pub use ask::{measure, sample, sampling, subject, write};
pub use fields::{Sampled, Sampling};
pub(super) use info::role;
pub use info::{Info, info};
pub use make::{Written, cancelled};
pub use measured::Measured;
pub use output::{FORMATS, Format, Kind, Output, Target};
pub use paint::{colours_at, colours_of};
pub use preview::{headline, preview};
pub(super) use space::Searched;
pub use subject::{Sequence, Subject};

pub use crate::field::Coordinate;

/// How finely a boundary is searched.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cells {
    /// Cells along the longest side of the modelling space.
    Along(usize),
    /// Length of a cell's edge.
    Length(f64),
}

/// Which object, which section of it, over which space, how finely.
#[derive(Clone, Debug, PartialEq)]
pub struct View {
    /// The object's name; the last `gob_` defined if none is given.
    pub object: Option<String>,
    /// Sections: `x4 = 0.5`. Wins over the script's types.
    pub at: Vec<(Coordinate, f64)>,
    /// Ranges of coordinates. Wins over the script's.
    pub bounds: Vec<(Coordinate, f64, f64)>,
    /// Cells; 128 along the longest side unless told.
    pub cells: Cells,
    /// The numbers that points are computed with.
    pub precision: Precision,
}

impl Default for View {
    fn default() -> Self {
        Self {
            object: None,
            at: Vec::new(),
            bounds: Vec::new(),
            cells: Cells::Along(128),
            precision: Precision::Double,
        }
    }
}

/// How a picture is made.
#[derive(Clone, Debug, PartialEq)]
pub struct PictureOptions {
    /// Width and height in pixels, of each picture of a sheet; one that suits the object unless told.
    pub size: Option<(usize, usize)>,
    /// Samples along each side of a pixel.
    pub supersample: usize,
    /// A named view (`iso`, `front`, `top` ...), or azimuth and elevation in degrees: `30,20`.
    pub view: String,
    /// The palette's name.
    pub palette: String,
    /// Whether axes with numbers stand around a picture of two or three axes; graphs and contour maps always have them.
    pub axes: bool,
}

impl Default for PictureOptions {
    fn default() -> Self {
        Self { size: None, supersample: 2, view: "default".into(), palette: "plain".into(), axes: false }
    }
}

/// How an animation or a numbered series runs.
#[derive(Clone, Debug, PartialEq)]
pub struct Timing {
    /// Number of frames over T; the script's `x4_delta` unless told.
    pub frames: Option<usize>,
    /// Frames a second in an animation.
    pub fps: f64,
}

impl Default for Timing {
    fn default() -> Self {
        Self { frames: None, fps: 4.0 }
    }
}

/// Everything that decides an output's bytes besides its [`Output`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Options {
    /// Of what.
    pub view: View,
    /// If it is a picture.
    pub picture: PictureOptions,
    /// If it moves.
    pub timing: Timing,
    /// An axis that is cut into slices, and where.
    pub slices: Option<Sequence>,
}
