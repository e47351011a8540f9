//! One file per format; each takes a writer and never seeks.

pub mod apng;
pub mod gif;
pub mod glb;
pub mod nrrd;
pub mod obj;
pub mod ply;
pub mod png;
pub mod quantise;
pub mod stl;
pub mod svg;
pub mod terminal;
pub mod threemf;

use crate::surface::mesh::Mesh;
use std::io;

/// What a writer answers when it is handed something that its format cannot hold.
fn refuse(words: impl Into<String>) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidInput, words.into())
}

/// Refuses a mesh whose arrays do not fit together, before anything of it is written.
fn fits_together(mesh: &Mesh, colours: Option<&[[u8; 3]]>) -> io::Result<()> {
    let count = mesh.positions.len();
    if mesh.triangles.is_empty() {
        return Err(refuse("there is no triangle to write"));
    }
    if mesh.triangles.iter().flatten().any(|&corner| corner as usize >= count) {
        return Err(refuse("a triangle names a vertex that the mesh does not have"));
    }
    if colours.is_some_and(|colours| colours.len() != count) {
        return Err(refuse(format!("{count} vertices need as many colours")));
    }
    if !mesh.positions.iter().flatten().all(|&x| (x as f32).is_finite()) {
        return Err(refuse("a vertex lies beyond the range of single precision"));
    }
    Ok(())
}
