//! Wavefront OBJ: vertices and normals as text, in the shortest digits that read back the same
//! (in single precision for normals). The same mesh gives the same bytes.

use std::fmt::Write as _;
use std::io::{self, Write};

use crate::surface::mesh::Mesh;

/// Writes a mesh.
///
/// # Errors
/// Those of the writer.
pub fn write(mesh: &Mesh, out: &mut impl Write) -> io::Result<()> {
    out.write_all(b"# OBJ written by yont; unit mm, Z up\n")?;
    lines(&mesh.positions, out, |text, p| vector(text, "v", p.map(|c| number(c + 0.0))))?;
    lines(&mesh.normals, out, |text, n| vector(text, "vn", n.map(|c| (c as f32 + 0.0).to_string())))?;
    lines(&mesh.triangles, out, |text, triangle| {
        let [a, b, c] = triangle.map(|v| u64::from(v) + 1);
        let _ = writeln!(text, "f {a}//{a} {b}//{b} {c}//{c}");
    })?;
    out.flush()
}

/// A line for each item, handed on some thousands at a time.
fn lines<T>(items: &[T], out: &mut impl Write, line: impl Fn(&mut String, &T)) -> io::Result<()> {
    let mut text = String::new();
    for chunk in items.chunks(4096) {
        text.clear();
        chunk.iter().for_each(|item| line(&mut text, item));
        out.write_all(text.as_bytes())?;
    }
    Ok(())
}

fn vector(text: &mut String, keyword: &str, [x, y, z]: [String; 3]) {
    // Writing to a string cannot fail.
    let _ = writeln!(text, "{keyword} {x} {y} {z}");
}

/// Without an exponent where that is not long.
fn number(c: f64) -> String {
    match c.abs() {
        0.0 | 1e-5..1e16 => c.to_string(),
        _ => format!("{c:e}"),
    }
}
