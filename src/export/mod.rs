//! One file per format; each takes a writer and never seeks.

pub mod gif;
pub mod nrrd;
pub mod obj;
pub mod ply;
pub mod png;
pub mod quantise;
pub mod stl;
