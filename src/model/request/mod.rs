//! What can be asked of an object of a session: a mesh, a picture, frames, a sampled field, values, measures. One meaning for the command
//! line and the prompt, which only read options and show results.

mod ask;
mod boundaries;
mod charts;
mod cuts;
pub mod fields;
mod info;
mod make;
pub mod measured;
pub mod output;
pub mod paint;
mod pictures;
mod povray;
mod preview;
mod solids;
mod space;
mod starred;
mod studio;
pub mod subject;
mod together;
mod told;
pub mod way;

pub use crate::vm::Precision;
pub(in crate::model) use ask::dimension;
pub use ask::{measure, sample, sampling, write};
pub use fields::{Sampled, Sampling};
pub(super) use info::role;
pub use info::{Info, info};
pub use make::{Written, cancelled};
pub use measured::Measured;
pub use output::{FORMATS, Format, Kind, Output, Target};
pub use paint::{colours_at, colours_of};
pub use preview::{headline, preview, shrunk};
pub(super) use space::Searched;
pub(in crate::model) use starred::Way;
pub(super) use studio::{Studio, studio};
pub use subject::{Sequence, Subject};
pub use together::subject;
pub use way::{Choice, Route};

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
    /// Further objects that stand in the same picture.
    pub beside: Vec<String>,
    /// Sections: `x4 = 0.5`. Wins over the script's types.
    pub at: Vec<(Coordinate, f64)>,
    /// Ranges of coordinates. Wins over the script's.
    pub bounds: Vec<(Coordinate, f64, f64)>,
    /// Cells; 128 along the longest side unless told.
    pub cells: Cells,
    /// The numbers that points are computed with.
    pub precision: Precision,
    /// How the boundary is found.
    pub route: Route,
    /// The guide shape of the star route.
    pub guide: Choice,
    /// The centre of the star route, a number for each axis. Wins over the script's.
    pub centre: Option<Vec<f64>>,
    /// Whether creases and corners are in meshes and outlines as they are, not beveled.
    pub sharp: bool,
}

impl Default for View {
    fn default() -> Self {
        Self {
            object: None,
            beside: Vec::new(),
            at: Vec::new(),
            bounds: Vec::new(),
            cells: Cells::Along(128),
            precision: Precision::Double,
            route: Route::Auto,
            guide: Choice::Following,
            centre: None,
            sharp: false,
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
    /// A named view (`iso`, `front`, `top` ...), azimuth and elevation in degrees, `30,20`, or the place of the eye, `4,-5,3`.
    pub view: String,
    /// Whether all rays are parallel; by default in named views, not in others.
    pub parallel: Option<bool>,
    /// Where the key light stands, as azimuth and elevation in degrees; at the camera's left shoulder unless told.
    pub light: Option<[f64; 2]>,
    /// Whether there is a second, weaker light.
    pub fill: bool,
    /// Whether the key light throws shadows.
    pub shadow: bool,
    /// Whether hollows and corners get less light from the sky.
    pub occlusion: bool,
    /// What stands behind the object; a soft light grey unless told.
    pub background: Option<Background>,
    /// The palette's name.
    pub palette: String,
    /// Whether axes with numbers stand around a picture of two or three axes; graphs and contour maps always have them.
    pub axes: bool,
}

impl Default for PictureOptions {
    fn default() -> Self {
        Self {
            size: None,
            supersample: 2,
            view: "default".into(),
            parallel: None,
            light: None,
            fill: true,
            shadow: true,
            occlusion: false,
            background: None,
            palette: "plain".into(),
            axes: false,
        }
    }
}

/// What stands behind an object.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Background {
    /// One colour, sRGB.
    Colour([u8; 3]),
    /// Nothing: PNG and APNG keep that.
    Transparent,
}

impl Background {
    /// The names of colours.
    pub const NAMES: &'static str = "white, black, grey";

    /// A background by its name in any case: a colour, `#rrggbb`, `#rgb`, or `transparent`.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        let name = name.to_ascii_lowercase();
        let digit = |d: &u8| char::from(*d).to_digit(16).map(|d| d as u8);
        let colour = match name.as_str() {
            "transparent" | "none" => return Some(Self::Transparent),
            "white" => [255; 3],
            "black" => [0; 3],
            "grey" | "gray" => [128; 3],
            _ => {
                let digits: Vec<u8> = name.strip_prefix('#')?.as_bytes().iter().map(digit).collect::<Option<_>>()?;
                match digits[..] {
                    [r, g, b] => [r, g, b].map(|d| 17 * d),
                    [a, b, c, d, e, f] => [16 * a + b, 16 * c + d, 16 * e + f],
                    _ => return None,
                }
            }
        };
        Some(Self::Colour(colour))
    }
}

/// A plane at right angles to an axis that cuts a solid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cut {
    /// The axis.
    pub coordinate: Coordinate,
    /// Where the plane stands.
    pub value: f64,
    /// The half that stays; the one away from the camera unless told.
    pub keep: Option<Half>,
}

/// A side of a cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Half {
    /// Where the coordinate is less.
    Below,
    /// Where it is more.
    Above,
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
    /// Planes that cut a solid, which is capped there.
    pub cuts: Vec<Cut>,
}
