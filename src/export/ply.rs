//! Binary PLY, little-endian: vertices and normals in single precision, with colours if there are any, triangles by number. One object
//! a file. The same part gives the same bytes.

use std::io::{self, Write};

use super::{Part, fits_together, stream};

/// Writes a mesh.
///
/// # Errors
/// Those of the writer; `InvalidInput` for an empty mesh or arrays that do not fit together.
pub fn write(part: &Part<'_>, out: &mut impl Write) -> io::Result<()> {
    fits_together(part)?;
    out.write_all(header(part).as_bytes())?;
    let mesh = part.mesh;
    let vertices = |first: usize, positions: &[[f64; 3]], bytes: &mut Vec<u8>| {
        for (v, position) in (first..).zip(positions) {
            let normal = mesh.normals.get(v).into_iter().flatten();
            for number in position.iter().chain(normal) {
                bytes.extend_from_slice(&(*number as f32 + 0.0).to_le_bytes());
            }
            bytes.extend(part.colours.iter().flat_map(|colours| colours[v]));
        }
    };
    stream(&mesh.positions, vertices, out)?;
    let faces = |_: usize, triangles: &[[u32; 3]], bytes: &mut Vec<u8>| {
        for triangle in triangles {
            bytes.push(3);
            triangle.iter().for_each(|v| bytes.extend_from_slice(&v.to_le_bytes()));
        }
    };
    stream(&mesh.triangles, faces, out)?;
    out.flush()
}

fn header(part: &Part<'_>) -> String {
    let mesh = part.mesh;
    // A line's end within the name would begin another line of the header.
    let name: String = part.name.chars().filter(|c| !c.is_control()).collect();
    let numbers = if mesh.normals.is_empty() { &["x", "y", "z"][..] } else { &["x", "y", "z", "nx", "ny", "nz"] };
    let colours = if part.colours.is_some() { &["red", "green", "blue"][..] } else { &[] };
    let property =
        |kind: &str, names: &[&str]| names.iter().map(|n| format!("property {kind} {n}\n")).collect::<String>();
    format!(
        "ply\nformat binary_little_endian 1.0\ncomment {name}, written by yont; unit mm, Z up\nelement vertex {}\n{}{}\
         element face {}\nproperty list uchar uint vertex_indices\nend_header\n",
        mesh.positions.len(),
        property("float", numbers),
        property("uchar", colours),
        mesh.triangles.len(),
    )
}
