//! One file per format; each takes a writer and never seeks.

pub mod apng;
pub mod gif;
pub mod glb;
pub mod nrrd;
pub mod obj;
pub mod ply;
pub mod png;
pub mod pov;
pub mod quantise;
pub mod stl;
pub mod svg;
pub mod terminal;
pub mod threemf;

use std::io::{self, Write};

use rayon::prelude::*;

use crate::surface::mesh::Mesh;

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
    if mesh.triangles.par_iter().any(|triangle| triangle.iter().any(|&corner| corner as usize >= count)) {
        return Err(refuse("a triangle names a vertex that the mesh does not have"));
    }
    if colours.is_some_and(|colours| colours.len() != count) {
        return Err(refuse(format!("{count} vertices need as many colours")));
    }
    if !mesh.positions.par_iter().all(|p| p.iter().all(|&x| (x as f32).is_finite())) {
        return Err(refuse("a vertex lies beyond the range of single precision"));
    }
    Ok(())
}

/// Items that are turned to bytes together.
const PIECE: usize = 4096;

/// Writes what `make` appends for the items, which it is handed with the number of the first of them. While some are written, threads make
/// the bytes of those behind; the bytes do not depend on how many threads there are.
fn stream<T: Sync>(
    items: &[T],
    make: impl Fn(usize, &[T], &mut Vec<u8>) + Sync,
    out: &mut impl Write,
) -> io::Result<()> {
    let length = PIECE * rayon::current_num_threads();
    let fill = |first: usize, items: &[T], pieces: &mut Vec<Vec<u8>>| {
        pieces.resize_with(items.len().div_ceil(PIECE), Vec::new);
        pieces.par_iter_mut().zip(items.par_chunks(PIECE)).enumerate().for_each(|(n, (piece, items))| {
            piece.clear();
            make(first + n * PIECE, items, piece);
        });
    };
    let (mut ready, mut next) = (Vec::new(), Vec::new());
    for (n, items) in items.chunks(length).enumerate() {
        rayon::in_place_scope(|scope| {
            scope.spawn(|_| fill(n * length, items, &mut next));
            ready.iter().try_for_each(|piece: &Vec<u8>| out.write_all(piece))
        })?;
        std::mem::swap(&mut ready, &mut next);
    }
    ready.iter().try_for_each(|piece| out.write_all(piece))
}
