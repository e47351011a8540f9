//! Places of strokes as they are typed: pixels, lines of pixels, points of space. Looks nothing up.

use crate::diagnostic::Diagnostic;

use super::errors::bad_place;
use super::{Place, Spot};

/// Reads `320,240`, `100,100..200,150..220,90` and `[0, 0, 1]`, as many as there are.
///
/// # Errors
/// What is no place.
pub fn places(text: &str) -> Result<Vec<Place>, Diagnostic> {
    let (mut rest, mut places) = (text.trim(), Vec::new());
    while !rest.is_empty() {
        let is_point = rest.starts_with('[');
        let end = if is_point { rest.find(']').map(|end| end + 1) } else { rest.find([' ', '\t', '[']) };
        let (word, after) = rest.split_at(end.unwrap_or(rest.len()));
        rest = after.trim_start();
        if is_point {
            let inner = word.trim_start_matches('[').trim_end_matches(']');
            places.push(Place::Point(numbers(inner).ok_or_else(|| bad_place(word))?));
            continue;
        }
        let pixels: Option<Vec<[f64; 2]>> = word.split("..").map(numbers).collect();
        match pixels.as_deref() {
            Some([pixel]) => places.push(Place::Pixel(*pixel)),
            Some(pixels) => places.extend(pixels.windows(2).map(|ends| Place::Line(ends[0], ends[1]))),
            None => return Err(bad_place(word)),
        }
    }
    if places.is_empty() { Err(bad_place(text)) } else { Ok(places) }
}

fn numbers<const N: usize>(text: &str) -> Option<[f64; N]> {
    let number = |word: &str| word.trim().parse().ok().filter(|v: &f64| v.is_finite());
    text.split(',').map(number).collect::<Option<Vec<f64>>>()?.try_into().ok()
}

impl Spot {
    /// The point and the normal in words.
    #[must_use]
    pub fn told(&self) -> String {
        let short = |v: [f64; 3], digits: usize| {
            let words: Vec<String> = v.iter().map(|v| super::tools::number(rounded(*v, digits))).collect();
            format!("[{}]", words.join(", "))
        };
        format!("point {}, normal {}", short(self.point, 9), short(self.normal, 6))
    }
}

/// Rounded to so many digits in all.
fn rounded(v: f64, digits: usize) -> f64 {
    format!("{v:.*e}", digits - 1).parse::<f64>().map_or(v, |v| v + 0.0)
}
