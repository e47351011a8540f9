//! A closed mesh as a function of x1, x2, x3: the distance to the nearest triangle, positive inside. Inside is where the mesh goes round
//! the point, counted exactly along a ray; the nearest triangle is found in a tree of boxes. Never opens a file.

mod cross;
pub mod error;
mod solid;
mod topology;
mod tree;
mod triangle;
mod vector;

use std::sync::Arc;

pub use error::MeshError;
pub use solid::Solid;
pub use topology::Mended;

use super::Context;
use super::obj::{self, Surface};
use super::stl;

/// What is worth telling of a mesh that is no error.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Noted {
    /// What was mended.
    pub mended: Mended,
    /// Pairs of triangles that cross each other, and the place of one of them in words.
    pub crossings: Option<(usize, String)>,
}

/// The solid within the mesh in `bytes`, the content of the file `name` (a path or just its last part).
///
/// # Errors
/// See [`MeshError`]: an unknown kind of file, one that is broken, a mesh that does not close, more than `Limits::memory_bytes`.
pub fn decode(name: &str, bytes: &[u8], context: Context<'_>) -> Result<(Arc<Solid>, Noted), MeshError> {
    let last = name.rsplit(['/', '\\']).next().unwrap_or(name);
    let extension = last.rsplit_once('.').map_or(String::new(), |(_, e)| e.to_ascii_lowercase());
    let surface = match extension.as_str() {
        "obj" => obj::read(bytes)?,
        "stl" => stl::read(bytes)?,
        _ => return Err(MeshError::UnknownFormat),
    };
    solid(last, surface, context)
}

/// The solid within a surface.
///
/// # Errors
/// As for [`decode`].
pub fn solid(name: &str, surface: Surface, context: Context<'_>) -> Result<(Arc<Solid>, Noted), MeshError> {
    let bytes = surface.triangles.len().saturating_mul(solid::BYTES);
    if bytes > context.limits.memory_bytes {
        return Err(MeshError::TooLarge { bytes, limit: context.limits.memory_bytes });
    }
    if surface.triangles.len() > 1 << 30 {
        return Err(MeshError::TooMany);
    }
    let (solid, mended) = Solid::new(name, surface, context.interrupt)?;
    let crossings = cross::crossings(&solid, context.interrupt)?;
    Ok((Arc::new(solid), Noted { mended, crossings }))
}
