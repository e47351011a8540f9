//! Pictures of functions: cameras, ray casting, plots, palettes, animations. Knows no language and no files.
//!
//! [`raycast`] shows a 3-D object in the light, [`plot`] a 2-D object as a filled picture, [`animation`] frames over a parameter.
//! [`field`] samples one for a volume file. Each takes a compiled [`crate::vm::Shape`] and gives an [`Image`]; the same input gives the
//! same bytes for any number of threads.

pub mod animation;
pub mod axes;
pub mod axes_space;
mod brush;
pub mod camera;
pub mod canvas;
pub mod contours;
pub mod easel;
pub mod extent;
pub mod field;
mod frustum;
pub mod graph;
pub mod image;
pub mod isolines;
pub mod legend;
mod occlusion;
pub mod paint;
pub mod palette;
pub mod plot;
pub mod raycast;
pub mod rays;
mod scale;
pub mod screen;
mod search;
pub mod shade;
pub mod shadow;
pub mod sheet;
pub mod text;

pub use camera::{Camera, Projection, View};
pub use image::Image;
pub use paint::Paint;
pub use palette::Palette;
