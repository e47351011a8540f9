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

/// A mesh as a file holds it: alone, one of several objects, a member of a group, or a frame.
#[derive(Clone, Copy, Debug)]
pub struct Part<'a> {
    /// What it is called.
    pub name: &'a str,
    /// What is seen.
    pub mesh: &'a Mesh,
    /// One sRGB colour for each vertex.
    pub colours: Option<&'a [[u8; 3]]>,
    /// sRGB and opacity of the whole, for formats with materials.
    pub tint: [u8; 4],
}

impl<'a> Part<'a> {
    /// A mesh without a colour, opaque.
    #[must_use]
    pub fn of(name: &'a str, mesh: &'a Mesh) -> Self {
        Part { name, mesh, colours: None, tint: [255; 4] }
    }
}

/// What a writer answers when it is handed something that its format cannot hold.
fn refuse(words: impl Into<String>) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidInput, words.into())
}

/// Refuses a mesh whose arrays do not fit together, before anything of it is written.
fn fits_together(part: &Part<'_>) -> io::Result<()> {
    let Part { mesh, colours, .. } = *part;
    let count = mesh.positions.len();
    if !mesh.normals.is_empty() && mesh.normals.len() != count {
        return Err(refuse(format!("{count} vertices need as many normals, or none")));
    }
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
