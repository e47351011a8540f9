//! Binary STL: triangles in single precision, each with its normal. Z is up, a unit is a millimetre. The same mesh gives the same bytes.

use std::io::{self, Write};

use crate::surface::mesh::{Mesh, cross, minus, unit};

/// What the first 80 bytes begin with; never `solid`, by which readers know the text form.
const TITLE: &[u8] = b"binary STL written by yont; unit mm, Z up";

/// Writes a mesh.
///
/// # Errors
/// Those of the writer; `InvalidInput` for more triangles than the format can count.
pub fn write(mesh: &Mesh, out: &mut impl Write) -> io::Result<()> {
    let count = u32::try_from(mesh.triangles.len())
        .map_err(|_| io::Error::new(io::ErrorKind::InvalidInput, "more triangles than STL can count"))?;
    let mut header = [0; 80];
    header[..TITLE.len()].copy_from_slice(TITLE);
    out.write_all(&header)?;
    out.write_all(&count.to_le_bytes())?;
    let mut buffer = Vec::with_capacity(50 * 1024);
    for chunk in mesh.triangles.chunks(1024) {
        buffer.clear();
        for &triangle in chunk {
            facet(mesh, triangle, &mut buffer);
        }
        out.write_all(&buffer)?;
    }
    out.flush()
}

/// 50 bytes: the normal of the rounded corners, the corners, no attributes.
fn facet(mesh: &Mesh, triangle: [u32; 3], buffer: &mut Vec<u8>) {
    let corners = mesh.corners(triangle).map(|p| p.map(|c| c as f32 + 0.0));
    let [a, b, c] = corners.map(|p| p.map(f64::from));
    let normal = unit(cross(minus(b, a), minus(c, a))).unwrap_or([0.0; 3]).map(|c| c as f32);
    for number in std::iter::once(normal).chain(corners).flatten() {
        buffer.extend_from_slice(&number.to_le_bytes());
    }
    buffer.extend_from_slice(&[0, 0]);
}
