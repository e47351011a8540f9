//! Reads the surface of an STL file, binary or text. Normals, colours and names are passed over; corners at the same place become one
//! vertex. Knows no disk, and believes a count only as far as there are bytes.

use super::mesh::error::MeshError;
use super::obj::{Places, Surface, number, shortened};

/// Bytes before the triangles: a text and their number.
const HEADER: usize = 84;
/// Bytes of a triangle: its normal, three corners and two bytes of anything.
const RECORD: usize = 50;

/// The surface in the bytes of an STL file.
///
/// # Errors
/// [`MeshError::Line`] for text that makes no sense, [`MeshError::Count`] when there are fewer or more triangles than promised,
/// [`MeshError::Truncated`] for a file that ends before it begins, [`MeshError::Corner`] for a corner that is not finite.
pub fn read(bytes: &[u8]) -> Result<Surface, MeshError> {
    let promised = bytes.get(HEADER - 4..HEADER).map(|n| u64::from(u32::from_le_bytes([n[0], n[1], n[2], n[3]])));
    let exact = promised.is_some_and(|n| n * RECORD as u64 + HEADER as u64 == bytes.len() as u64);
    if !exact && is_text(bytes) {
        return text(bytes);
    }
    let Some(promised) = promised else { return Err(MeshError::Truncated) };
    let found = (bytes.len() - HEADER) / RECORD;
    if !exact {
        return Err(MeshError::Count { promised, found: found as u64 });
    }
    binary(&bytes[HEADER..])
}

/// Whether it says so: a binary header may begin with `solid` as well, but then no `facet` or `endsolid` follows.
fn is_text(bytes: &[u8]) -> bool {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let start = bytes.trim_ascii_start();
    let has = |word: &[u8]| start.windows(word.len()).take(4_000).any(|w| w.eq_ignore_ascii_case(word));
    let first = start.get(..5).is_some_and(|word| word.eq_ignore_ascii_case(b"solid"));
    first && (has(b"facet") || has(b"endsolid") || start.len() < HEADER)
}

fn binary(records: &[u8]) -> Result<Surface, MeshError> {
    let mut places = Places::default();
    let mut triangles = Vec::with_capacity(records.len() / RECORD);
    for (index, record) in records.chunks_exact(RECORD).enumerate() {
        let mut corners = [0; 3];
        for (k, corner) in corners.iter_mut().enumerate() {
            let place: [f64; 3] = std::array::from_fn(|axis| {
                let at = 12 + 12 * k + 4 * axis;
                f64::from(f32::from_le_bytes([record[at], record[at + 1], record[at + 2], record[at + 3]]))
            });
            if !place.iter().all(|c| c.is_finite()) {
                return Err(MeshError::Corner { triangle: index + 1 });
            }
            *corner = places.number(place).map_err(|_| MeshError::TooMany)?;
        }
        triangles.push(corners);
    }
    Ok(Surface { positions: places.positions, triangles })
}

/// The words of a text with their lines.
struct Words<'a> {
    lines: std::iter::Enumerate<std::str::Lines<'a>>,
    words: std::str::SplitWhitespace<'a>,
    line: usize,
}

impl<'a> Words<'a> {
    fn next(&mut self) -> Option<&'a str> {
        loop {
            if let Some(word) = self.words.next() {
                return Some(word);
            }
            let (index, line) = self.lines.next()?;
            self.line = index + 1;
            self.words = line.split_whitespace();
        }
    }

    fn wrong(&self, what: String) -> MeshError {
        MeshError::Line { line: self.line, what }
    }

    fn need(&mut self, wanted: &str) -> Result<(), MeshError> {
        match self.next() {
            Some(word) if word.eq_ignore_ascii_case(wanted) => Ok(()),
            Some(word) => Err(self.wrong(format!("`{}` stands where `{wanted}` should", shortened(word)))),
            None => Err(self.wrong(format!("the file ends where `{wanted}` should stand"))),
        }
    }

    fn place(&mut self) -> Result<[f64; 3], MeshError> {
        let mut place = [0.0; 3];
        for to in &mut place {
            let word = self.next().ok_or_else(|| self.wrong("the file ends within a triangle".into()))?;
            *to = number(word).map_err(|what| self.wrong(what))?;
        }
        Ok(place)
    }

    /// Passes over the rest of a line: the name of a solid.
    fn skip_line(&mut self) {
        self.words = "".split_whitespace();
    }
}

fn text(bytes: &[u8]) -> Result<Surface, MeshError> {
    let text = String::from_utf8_lossy(bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes));
    let mut words = Words { lines: text.lines().enumerate(), words: "".split_whitespace(), line: 1 };
    let (mut places, mut triangles) = (Places::default(), Vec::new());
    let is = |word: &str, wanted: &str| word.eq_ignore_ascii_case(wanted);
    while let Some(word) = words.next() {
        if !is(word, "solid") {
            return Err(words.wrong(format!("`{}` stands where `solid` should", shortened(word))));
        }
        words.skip_line();
        loop {
            match words.next() {
                Some(word) if is(word, "facet") => triangles.push(facet(&mut words, &mut places)?),
                Some(word) if is(word, "endsolid") => break,
                Some(word) => {
                    let what = format!("`{}` stands where `facet` or `endsolid` should", shortened(word));
                    return Err(words.wrong(what));
                }
                None => return Err(words.wrong("the file ends before `endsolid`".into())),
            }
        }
        words.skip_line();
    }
    Ok(Surface { positions: places.positions, triangles })
}

fn facet(words: &mut Words<'_>, places: &mut Places) -> Result<[u32; 3], MeshError> {
    words.need("normal")?;
    // The normal follows from the corners; many programs write nan or 0 0 0 here.
    for _ in 0..3 {
        words.next();
    }
    words.need("outer")?;
    words.need("loop")?;
    let mut corners = [0; 3];
    for corner in &mut corners {
        words.need("vertex")?;
        let place = words.place()?;
        *corner = places.number(place).map_err(|_| MeshError::TooMany)?;
    }
    words.need("endloop")?;
    words.need("endfacet")?;
    Ok(corners)
}
