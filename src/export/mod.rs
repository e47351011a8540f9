//! One file per format; each takes a writer and never seeks.

pub mod gif;
pub mod nrrd;
pub mod png;
pub mod quantise;
