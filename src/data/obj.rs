//! Reads the surface of an OBJ file: vertices and faces, and nothing else of it. Faces with more corners are cut into triangles from their
//! first; vertices at the same place are one. Knows no disk.

use std::collections::HashMap;
use std::fmt;

/// Triangles that meet at vertices.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Surface {
    /// The vertices.
    pub positions: Vec<[f64; 3]>,
    /// Three of them each, from 0.
    pub triangles: Vec<[u32; 3]>,
}

/// What is wrong with an OBJ file, and in which line, from 1.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ObjError {
    /// The line.
    pub line: usize,
    /// What is wrong.
    pub what: String,
}

impl fmt::Display for ObjError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}: {}", self.line, self.what)
    }
}

impl std::error::Error for ObjError {}

/// Reads the `v` and `f` lines of an OBJ file; others are passed over.
///
/// # Errors
/// The first line that makes no sense.
pub fn read(text: &str) -> Result<Surface, ObjError> {
    let mut surface = Surface::default();
    // The number of each vertex of the file among those that are different.
    let mut numbers: Vec<u32> = Vec::new();
    let mut known: HashMap<[u64; 3], u32> = HashMap::new();
    for (index, line) in text.lines().enumerate() {
        let wrong = |what: String| ObjError { line: index + 1, what };
        let mut words = line.split('#').next().unwrap_or_default().split_whitespace();
        match words.next() {
            Some("v") => {
                let all: Vec<f64> = words.take(3).filter_map(|word| word.parse().ok()).collect();
                let [x, y, z] = all[..] else { return Err(wrong("a vertex needs three numbers".into())) };
                if ![x, y, z].iter().all(|c| c.is_finite()) {
                    return Err(wrong("a vertex is not finite".into()));
                }
                let key = [x, y, z].map(|c| (c + 0.0).to_bits());
                let next = surface.positions.len() as u32;
                let number = *known.entry(key).or_insert(next);
                if number == next {
                    surface.positions.push([x, y, z]);
                }
                numbers.push(number);
            }
            Some("f") => {
                let corners = words.map(|word| corner(word, &numbers)).collect::<Result<Vec<u32>, String>>();
                let corners = corners.map_err(wrong)?;
                if corners.len() < 3 {
                    return Err(wrong("a face needs three corners".into()));
                }
                surface.triangles.extend((1..corners.len() - 1).map(|k| [corners[0], corners[k], corners[k + 1]]));
            }
            _ => {}
        }
    }
    Ok(surface)
}

/// A corner of a face: `7`, `7/1`, `7//2` or `-1`, the last vertex so far.
fn corner(word: &str, numbers: &[u32]) -> Result<u32, String> {
    let number: i64 =
        word.split('/').next().unwrap_or_default().parse().map_err(|_| format!("`{word}` is no corner"))?;
    let index = if number < 0 { numbers.len() as i64 + number } else { number - 1 };
    let found = usize::try_from(index).ok().and_then(|index| numbers.get(index));
    found.copied().ok_or_else(|| format!("there is no vertex {number}"))
}
