//! Reads the surface of an OBJ file: vertices and faces, and nothing else of it; other files that it names are never opened. Faces with
//! more corners are cut into triangles; vertices at the same place are one. Knows no disk.

use std::collections::HashMap;
use std::fmt;

use super::ears;

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

/// Vertices as a file gives them, each place once.
#[derive(Debug, Default)]
pub(super) struct Places {
    pub(super) positions: Vec<[f64; 3]>,
    known: HashMap<[u64; 3], u32>,
}

impl Places {
    /// The number of the vertex at a finite place.
    pub(super) fn number(&mut self, place: [f64; 3]) -> Result<u32, String> {
        let next = u32::try_from(self.positions.len()).map_err(|_| "more vertices than can be counted".to_owned())?;
        // Adding 0 makes -0 the same place as 0.
        let place = place.map(|c| c + 0.0);
        let number = *self.known.entry(place.map(f64::to_bits)).or_insert(next);
        if number == next {
            self.positions.push(place);
        }
        Ok(number)
    }
}

/// Reads the `v` and `f` lines of an OBJ file; others are passed over.
///
/// # Errors
/// The first line that makes no sense.
pub fn read(bytes: &[u8]) -> Result<Surface, ObjError> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let mut file = Reader::default();
    let mut whole: Vec<u8> = Vec::new();
    for (index, line) in bytes.split(|&b| b == b'\n').enumerate() {
        let line = line.strip_suffix(b"\r").unwrap_or(line);
        // A line that ends with a backslash goes on in the next.
        let (line, goes_on) = match line.strip_suffix(b"\\") {
            Some(line) => (line, true),
            None => (line, false),
        };
        whole.extend_from_slice(line);
        if goes_on {
            whole.push(b' ');
            continue;
        }
        file.line(&whole).map_err(|what| ObjError { line: index + 1, what })?;
        whole.clear();
    }
    if !whole.is_empty() {
        return Err(ObjError { line: file.lines + 1, what: "the file ends within a line".into() });
    }
    Ok(Surface { positions: file.places.positions, triangles: file.triangles })
}

#[derive(Default)]
struct Reader {
    places: Places,
    triangles: Vec<[u32; 3]>,
    /// The number of each vertex of the file among those that are different.
    numbers: Vec<u32>,
    lines: usize,
}

impl Reader {
    fn line(&mut self, line: &[u8]) -> Result<(), String> {
        self.lines += 1;
        let line = line.split(|&b| b == b'#').next().unwrap_or_default();
        if let Some(odd) = line.iter().find(|&&b| b < b' ' && b != b'\t' && b != b'\x0c' || b == b'\x7f') {
            return Err(format!(
                "a byte {odd:#04x} stands where text should be: this is no OBJ file, or it is damaged"
            ));
        }
        // Names of materials and groups may be in any encoding; numbers are in none.
        let line = String::from_utf8_lossy(line);
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => self.vertex(&words.collect::<Vec<_>>()),
            Some("f") => self.face(words),
            _ => Ok(()),
        }
    }

    fn vertex(&mut self, words: &[&str]) -> Result<(), String> {
        let [x, y, z, ..] = words else { return Err("a vertex needs three numbers".into()) };
        let mut place = [0.0; 3];
        for (to, word) in place.iter_mut().zip([x, y, z]) {
            *to = number(word)?;
        }
        self.numbers.push(self.places.number(place)?);
        Ok(())
    }

    fn face<'a>(&mut self, words: impl Iterator<Item = &'a str>) -> Result<(), String> {
        let corners = words.map(|word| corner(word, &self.numbers)).collect::<Result<Vec<u32>, String>>()?;
        if corners.len() < 3 {
            return Err("a face needs three corners".into());
        }
        ears::cut(&self.places.positions, &corners, &mut self.triangles);
        Ok(())
    }
}

/// A finite number.
pub(super) fn number(word: &str) -> Result<f64, String> {
    let value: f64 = word.parse().map_err(|_| format!("`{}` is not a number", shortened(word)))?;
    if value.is_finite() { Ok(value) } else { Err(format!("`{}` is not a finite number", shortened(word))) }
}

/// The first characters of a word, fit to be shown.
pub(super) fn shortened(word: &str) -> String {
    let mut all: String = word.chars().take(24).flat_map(char::escape_default).collect();
    if word.chars().count() > 24 {
        all.push_str("...");
    }
    all
}

/// A corner of a face: `7`, `7/1`, `7//2` or `-1`, the last vertex so far.
fn corner(word: &str, numbers: &[u32]) -> Result<u32, String> {
    let first = word.split('/').next().unwrap_or_default();
    let digits = first.strip_prefix(['-', '+']).unwrap_or(first);
    if digits.is_empty() || !digits.bytes().all(|b| b.is_ascii_digit()) {
        return Err(format!("`{}` is no corner of a face", shortened(word)));
    }
    let missing = || format!("there is no vertex {}: {} precede this face", shortened(first), numbers.len());
    let number: i64 = first.parse().map_err(|_| missing())?;
    let index = match number {
        0 => return Err("there is no vertex 0: they count from 1".into()),
        n if n < 0 => i64::try_from(numbers.len()).ok().and_then(|all| all.checked_add(n)).ok_or_else(missing)?,
        n => n - 1,
    };
    let found = usize::try_from(index).ok().and_then(|index| numbers.get(index));
    found.copied().ok_or_else(missing)
}
