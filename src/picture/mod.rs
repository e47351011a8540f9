//! Pictures of functions: cameras, ray casting, plots, palettes, animations. Knows no language and no files.

pub mod axes;
pub mod canvas;
pub mod graph;
pub mod image;
pub mod text;
