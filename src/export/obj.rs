//! Wavefront OBJ: vertices and normals as text, in the shortest digits that read back the same
//! (in single precision for normals). Objects under their names; colours behind the vertices, as most readers know them. The same
//! parts give the same bytes.

use std::io::{self, Write};

use super::{Part, fits_together, refuse, stream};

/// Writes meshes, each as an object of its own.
///
/// # Errors
/// Those of the writer; `InvalidInput` without a part, for an empty mesh or arrays that do not fit together.
pub fn write(parts: &[Part<'_>], out: &mut impl Write) -> io::Result<()> {
    if parts.is_empty() {
        return Err(refuse("there is no mesh to write"));
    }
    parts.iter().try_for_each(fits_together)?;
    out.write_all(b"# OBJ written by yont; unit mm, Z up\n")?;
    // Numbers of vertices, and of normals, go on from object to object.
    let (mut first, mut first_normal) = (1, 1);
    for part in parts {
        object(part, first, first_normal, out)?;
        first += part.mesh.positions.len() as u64;
        first_normal += part.mesh.normals.len() as u64;
    }
    out.flush()
}

/// One object, whose first vertex and normal have these numbers.
fn object(part: &Part<'_>, first: u64, first_normal: u64, out: &mut impl Write) -> io::Result<()> {
    let mesh = part.mesh;
    writeln!(out, "o {}", word(part.name))?;
    let positions = |first: usize, positions: &[[f64; 3]], text: &mut Vec<u8>| {
        for (n, p) in (first..).zip(positions) {
            vector(text, "v", p.map(|c| number(c + 0.0)));
            if let Some(colours) = part.colours {
                vector(text, "", colours[n].map(share));
            }
            text.push(b'\n');
        }
    };
    stream(&mesh.positions, positions, out)?;
    let normals = |_: usize, normals: &[[f64; 3]], text: &mut Vec<u8>| {
        for n in normals {
            vector(text, "vn", n.map(|c| (c as f32 + 0.0).to_string()));
            text.push(b'\n');
        }
    };
    stream(&mesh.normals, normals, out)?;
    let smooth = !mesh.normals.is_empty();
    let faces = |_: usize, triangles: &[[u32; 3]], text: &mut Vec<u8>| {
        for triangle in triangles {
            text.push(b'f');
            for &v in triangle {
                // Writing to memory cannot fail.
                let _ = write!(text, " {}", first + u64::from(v));
                if smooth {
                    let _ = write!(text, "//{}", first_normal + u64::from(v));
                }
            }
            text.push(b'\n');
        }
    };
    stream(&mesh.triangles, faces, out)
}

fn vector(text: &mut Vec<u8>, keyword: &str, [x, y, z]: [String; 3]) {
    let _ = write!(text, "{keyword} {x} {y} {z}");
}

/// Without an exponent where that is not long.
fn number(c: f64) -> String {
    match c.abs() {
        0.0 | 1e-5..1e16 => c.to_string(),
        _ => format!("{c:e}"),
    }
}

/// A byte of a colour as a part of 1, to four digits: enough to find the byte again.
fn share(byte: u8) -> String {
    ((f64::from(byte) / 255.0 * 1e4).round() / 1e4).to_string()
}

/// A name as one word, since readers disagree on names with spaces.
fn word(name: &str) -> String {
    let plain = |c: char| if c.is_whitespace() || c.is_control() { '_' } else { c };
    if name.is_empty() { "object".to_owned() } else { name.chars().map(plain).collect() }
}
