//! Binary PLY, little-endian: vertices and normals in single precision, triangles by number. The same mesh gives the same bytes.

use std::io::{self, Write};

use crate::surface::mesh::Mesh;

/// Writes a mesh.
///
/// # Errors
/// Those of the writer.
pub fn write(mesh: &Mesh, out: &mut impl Write) -> io::Result<()> {
    writeln!(out, "ply\nformat binary_little_endian 1.0\ncomment written by yont; unit mm, Z up")?;
    writeln!(out, "element vertex {}", mesh.positions.len())?;
    for name in ["x", "y", "z", "nx", "ny", "nz"] {
        writeln!(out, "property float {name}")?;
    }
    writeln!(out, "element face {}\nproperty list uchar uint vertex_indices\nend_header", mesh.triangles.len())?;
    let mut buffer = Vec::new();
    let vertices: Vec<_> = mesh.positions.iter().zip(&mesh.normals).collect();
    for chunk in vertices.chunks(4096) {
        buffer.clear();
        for number in chunk.iter().flat_map(|(p, n)| p.iter().chain(n.iter())) {
            buffer.extend_from_slice(&(*number as f32 + 0.0).to_le_bytes());
        }
        out.write_all(&buffer)?;
    }
    for chunk in mesh.triangles.chunks(4096) {
        buffer.clear();
        for triangle in chunk {
            buffer.push(3);
            triangle.iter().for_each(|v| buffer.extend_from_slice(&v.to_le_bytes()));
        }
        out.write_all(&buffer)?;
    }
    out.flush()
}
