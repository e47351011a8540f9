//! Binary STL: triangles in single precision, each with its normal. Z is up, a unit is a millimetre. Neither colours nor
//! more than one object. The same part gives the same bytes.

use std::io::{self, Write};

use super::{Part, fits_together, stream};
use crate::surface::mesh::{Mesh, cross, minus, unit};

/// The first 80 bytes: what wrote it and of what. They never begin with `solid`, by which readers know the text form.
fn title(name: &str) -> [u8; 80] {
    let mut title = [0; 80];
    // Readers expect ASCII there.
    let name = name.chars().map(|c| if c.is_ascii_graphic() || c == ' ' { c } else { '?' });
    let text = "binary STL written by yont; unit mm, Z up; ".chars().chain(name);
    title.iter_mut().zip(text).for_each(|(byte, c)| *byte = c as u8);
    title
}

/// Writes a mesh; colours have no place in it.
///
/// # Errors
/// Those of the writer; `InvalidInput` for an empty mesh and for more triangles than the format can count.
pub fn write(part: &Part<'_>, out: &mut impl Write) -> io::Result<()> {
    fits_together(part)?;
    let mesh = part.mesh;
    let count = u32::try_from(mesh.triangles.len())
        .map_err(|_| io::Error::new(io::ErrorKind::InvalidInput, "more triangles than STL can count"))?;
    out.write_all(&title(part.name))?;
    out.write_all(&count.to_le_bytes())?;
    stream(
        &mesh.triangles,
        |_, triangles, bytes| triangles.iter().for_each(|&triangle| bytes.extend_from_slice(&facet(mesh, triangle))),
        out,
    )?;
    out.flush()
}

/// 50 bytes: the normal of the rounded corners, the corners, no attributes.
fn facet(mesh: &Mesh, triangle: [u32; 3]) -> [u8; 50] {
    let corners = mesh.corners(triangle).map(|p| p.map(|c| c as f32 + 0.0));
    let [a, b, c] = corners.map(|p| p.map(f64::from));
    let normal = unit(cross(minus(b, a), minus(c, a))).unwrap_or([0.0; 3]).map(|c| c as f32);
    let mut bytes = [0; 50];
    let numbers = std::iter::once(normal).chain(corners).flatten();
    bytes.chunks_exact_mut(4).zip(numbers).for_each(|(bytes, number)| bytes.copy_from_slice(&number.to_le_bytes()));
    bytes
}
