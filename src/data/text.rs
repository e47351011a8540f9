//! Text volumes, `.dat`: a header of a few words, then the samples. Reads ASCII only.
//!
//! ```text
//! # a ball of 3 x 2 samples            a comment, up to the end of its line; anywhere
//! 3 2                                  samples along x1, x2, x3: one to three whole numbers on the first line
//! spacing 0.5 0.5                      optional: the distance of samples along each axis (1 without)
//! origin -0.5 -0.25                    optional: where the first sample lies (0 without)
//! 0 1 0                                the samples, x1 fastest, apart by white space or commas, in lines of any length
//! 2 3 2
//! ```
//!
//! The samples are doubles; `nan` is undefined. Fewer or more of them than the size says are an error, never padded or dropped.

use super::Context;
use super::error::DataError;
use super::stream::{NumberType, count, number, shown, text_numbers};
use super::volume::{Placement, Volume};

/// The volume in a text.
///
/// # Errors
/// A header that cannot be understood, a word that is no number, fewer or more numbers than the size says, more than the limit.
pub fn decode(name: &str, bytes: &[u8], context: Context<'_>) -> Result<Volume, DataError> {
    let mut lines = Lines { rest: bytes, line: 0 };
    let (line, words) = lines.next_words().ok_or(DataError::MissingField { field: "size", example: "64 64 32" })?;
    let size = size(line, &words)?;
    let total = count(&size, NumberType::Float64, context)?;
    let (mut origin, mut spacing) = ([0.0; 3], [1.0; 3]);
    loop {
        let before = (lines.rest, lines.line);
        let Some((line, words)) = lines.next_words() else { break };
        match words[0].to_ascii_lowercase().as_slice() {
            b"spacing" => spacing = vector(line, &words, size.len(), 1.0)?,
            b"origin" => origin = vector(line, &words, size.len(), 0.0)?,
            _ => {
                (lines.rest, lines.line) = before;
                break;
            }
        }
    }
    let samples = text_numbers(lines.rest, lines.line + 1, NumberType::Float64, total, context)?;
    let size: Vec<usize> = size.iter().map(|&n| n as usize).collect();
    Volume::new(name, &size, Placement::aligned(origin, spacing), samples)
}

/// The lines of a text, comments and empty ones passed over.
struct Lines<'a> {
    rest: &'a [u8],
    line: usize,
}

impl<'a> Lines<'a> {
    /// The next line that has words, with its number.
    fn next_words(&mut self) -> Option<(usize, Vec<&'a [u8]>)> {
        while !self.rest.is_empty() {
            let end = self.rest.iter().position(|&b| b == b'\n');
            let (row, rest) = match end {
                Some(end) => (&self.rest[..end], &self.rest[end + 1..]),
                None => (self.rest, &self.rest[self.rest.len()..]),
            };
            self.rest = rest;
            self.line += 1;
            let row = row.split(|&b| b == b'#').next().unwrap_or(row);
            // A header has at most four words; a row of samples that is taken for one may have millions.
            let words = row.split(|&b| b.is_ascii_whitespace() || b == b',').filter(|word| !word.is_empty()).take(5);
            let words: Vec<_> = words.collect();
            if !words.is_empty() {
                return Some((self.line, words));
            }
        }
        None
    }
}

/// One to three whole numbers, perhaps after the word `size`.
fn size(line: usize, words: &[&[u8]]) -> Result<Vec<u64>, DataError> {
    let words = if words[0].eq_ignore_ascii_case(b"size") { &words[1..] } else { words };
    let whole = |word: &&[u8]| {
        let digits = word.iter().all(u8::is_ascii_digit);
        let text = std::str::from_utf8(word).ok().filter(|_| digits)?;
        Some(text.parse().unwrap_or(u64::MAX))
    };
    let size: Option<Vec<u64>> = words.iter().map(whole).collect();
    match size {
        Some(size) if (1..=3).contains(&size.len()) => Ok(size),
        Some(size) if size.len() > 3 => Err(DataError::Dimensions { found: size.len() }),
        _ => {
            let what = "the first line must be the size, one to three whole numbers such as `64 64 32`".into();
            Err(DataError::Header { line, what })
        }
    }
}

/// A number for each axis after the keyword.
fn vector(line: usize, words: &[&[u8]], dimension: usize, fill: f64) -> Result<[f64; 3], DataError> {
    let name = shown(words[0]);
    if words.len() != dimension + 1 {
        let what = format!("`{name}` needs one number for each of the {dimension} axes");
        return Err(DataError::Header { line, what });
    }
    let mut result = [fill; 3];
    for (value, word) in result.iter_mut().zip(&words[1..]) {
        let parsed = number(word).filter(|v| v.is_finite());
        *value = parsed.ok_or_else(|| DataError::NotANumber { line, word: shown(word) })?;
    }
    Ok(result)
}
