//! One file per format; each takes a writer and never seeks.

pub mod obj;
pub mod ply;
pub mod stl;
