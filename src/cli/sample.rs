//! `yont sample`: points from a text, values to a text. The numbers come from the model.

use std::io::{self, Write};
use std::path::Path;

use crate::host::{Disk, FileError, Host, Reason};
use crate::model::request::{self, Sampled, View};

use super::arguments::{Making, Sample};
use super::console::Console;
use super::engine::Signals;
use super::make::view;
use super::session::{self, read_text};
use super::status::Status;

/// `yont sample FILE --points P.tsv`.
///
/// # Errors
/// The status of what ended the command early.
pub fn sample(console: &Console, signals: &Signals, options: &Sample) -> Result<Status, Status> {
    let file = options.points.as_deref().unwrap_or(Path::new("-"));
    if file == Path::new("-") && options.program.file.as_deref() == Some(file) {
        return Err(console.usage("the program and the points cannot both come from standard input"));
    }
    let (mut session, _) = session::required(console, signals, &options.program)?;
    let text = read_text(file).map_err(|error| console.file_error(&error))?;
    let points = points(&text).map_err(|words| unread(console, file, &words))?;
    let making = Making { subject: options.subject.clone(), ..Making::default() };
    let sampled = {
        let _progress = console.progress(session.interrupt(), "points");
        request::sample(&mut session, &view(&making, &View::default()), &points, options.gradient)
    };
    match sampled {
        Ok(values) => put(console, options.output.as_deref(), &values),
        Err(diagnostics) => Ok(console.report(session.sources(), &diagnostics)),
    }
}

fn unread(console: &Console, file: &Path, words: &str) -> Status {
    console.file_error(&FileError::reading(file, Reason::Other(words.to_owned())))
}

fn put(console: &Console, file: Option<&Path>, values: &[Sampled]) -> Result<Status, Status> {
    match file.filter(|file| *file != Path::new("-")) {
        None => console.write(|out| write_values(out, values)).map(|()| Status::Done),
        Some(file) => match Disk.write_whole(file, &mut |out| write_values(out, values)) {
            Ok(()) => Ok(Status::Done),
            Err(error) => Ok(console.file_error(&error)),
        },
    }
}

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
pub fn write_values(out: &mut dyn Write, values: &[Sampled]) -> io::Result<()> {
    for sampled in values {
        write!(out, "{}", digits(sampled.value))?;
        for slope in &sampled.slope {
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
