//! `yont sample`: points from a text, values to a text, as they come: neither is ever held as a whole. The numbers come from the model.

use std::io::{self, BufRead, Write};
use std::path::Path;

use crate::diagnostic::Diagnostic;
use crate::host::{self, Disk, FileError, Host, Reason};
use crate::model::Session;
use crate::model::request::{self, Sampled, View};

use super::arguments::{Fineness, Making, Sample};
use super::console::Console;
use super::engine::Signals;
use super::make::view;
use super::session;
use super::status::Status;

/// Points that are read, and values that are written, at a time.
const BATCH: usize = 1 << 14;
/// Bytes of the longest line that is read as a point.
const LONGEST: u64 = 1 << 16;

/// Why the values end early.
enum Stop {
    /// The points cannot be read.
    Points(FileError),
    /// The object has no values there.
    Told(Vec<Diagnostic>),
    /// The values cannot be written.
    Output(io::Error),
}

/// `yont sample FILE --points P.tsv`.
///
/// # Errors
/// The status of what ended the command early.
pub fn sample(console: &Console, signals: &Signals, options: &Sample) -> Result<Status, Status> {
    let file = options.points.as_deref().unwrap_or(Path::new("-"));
    let is_standard = file == Path::new("-");
    if is_standard && options.program.file.as_deref() == Some(file) {
        return Err(console.usage("the program and the points cannot both come from standard input"));
    }
    let (mut session, _) = session::required(console, signals, &options.program)?;
    let fineness = Fineness { precision: Some(options.precision), ..Fineness::default() };
    let making = Making { subject: options.subject.clone(), fineness, ..Making::default() };
    let view = view(&making, &View::default());
    let input: Box<dyn BufRead> = if is_standard {
        Box::new(io::stdin().lock())
    } else {
        host::lines(file).map_err(|error| console.file_error(&error))?
    };
    let name = if is_standard { Path::new("standard input") } else { file };
    let mut points = Points::new(input, name);
    let mut pour = |session: &mut Session, out: &mut dyn Write| {
        let _progress = console.progress(session.interrupt(), "points");
        pour(session, &view, options.gradient, &mut points, out)
    };
    match options.output.as_deref().filter(|file| *file != Path::new("-")) {
        None => {
            let mut stop = None;
            console.write(|out| after(pour(&mut session, out), &mut stop))?;
            Ok(told(console, &session, stop))
        }
        Some(file) => {
            let mut stop = None;
            let written = Disk.write_whole(file, &mut |out| match after(pour(&mut session, out), &mut stop) {
                // What is not whole is not written.
                Ok(()) if stop.is_some() => Err(io::Error::other("stopped")),
                result => result,
            });
            match (written, stop) {
                (Err(error), None) => Ok(console.file_error(&error)),
                (_, stop) => Ok(told(console, &session, stop)),
            }
        }
    }
}

/// Errors of the output are the output's; others wait to be told.
fn after(poured: Result<(), Stop>, stop: &mut Option<Stop>) -> io::Result<()> {
    match poured {
        Ok(()) => Ok(()),
        Err(Stop::Output(error)) => Err(error),
        Err(other) => {
            *stop = Some(other);
            Ok(())
        }
    }
}

fn told(console: &Console, session: &Session, stop: Option<Stop>) -> Status {
    match stop {
        None | Some(Stop::Output(_)) => Status::Done,
        Some(Stop::Points(error)) => console.file_error(&error),
        Some(Stop::Told(diagnostics)) => console.report(session.sources(), &diagnostics),
    }
}

/// From points to values, batch by batch.
fn pour(
    session: &mut Session,
    view: &View,
    gradient: bool,
    points: &mut Points,
    out: &mut dyn Write,
) -> Result<(), Stop> {
    let mut batch = points.batch().map_err(Stop::Points)?;
    let width = points.width.unwrap_or(16);
    let mut sampling = request::sampling(session, view, width, gradient).map_err(Stop::Told)?;
    while !batch.is_empty() {
        let values =
            sampling.values(&batch, session.interrupt()).map_err(|_| Stop::Told(vec![request::cancelled()]))?;
        write_values(out, &values).map_err(Stop::Output)?;
        batch = points.batch().map_err(Stop::Points)?;
    }
    Ok(())
}

/// Reads points, one a line: numbers apart by white space or commas. A first line without numbers is a header, which may name the
/// coordinates; empty lines and lines that start with `#` are passed over.
struct Points<'a> {
    input: Box<dyn BufRead + 'a>,
    name: &'a Path,
    /// The line that was read last.
    number: u64,
    /// Numbers of a point, once there is one.
    width: Option<usize>,
    is_begun: bool,
}

impl<'a> Points<'a> {
    fn new(input: Box<dyn BufRead + 'a>, name: &'a Path) -> Self {
        Self { input, name, number: 0, width: None, is_begun: false }
    }

    /// The next points; none at the end.
    ///
    /// # Errors
    /// With the number of the line that is no point, or has another number of numbers than the first.
    fn batch(&mut self) -> Result<Vec<Vec<f64>>, FileError> {
        let mut batch = Vec::new();
        let mut line = Vec::new();
        while batch.len() < BATCH {
            line.clear();
            self.number += 1;
            let count = io::Read::take(&mut self.input, LONGEST).read_until(b'\n', &mut line);
            match count {
                Ok(0) => break,
                Ok(count) if count as u64 == LONGEST => return Err(self.failed("is longer than any point".into())),
                Ok(_) => {}
                Err(error) => return Err(FileError::reading(self.name, host::reason(&error))),
            }
            let text = std::str::from_utf8(&line).map_err(|_| self.failed("is not text".into()))?;
            let text = if self.number == 1 { text.trim_start_matches('\u{feff}') } else { text }.trim();
            if !text.is_empty() && !text.starts_with('#') {
                batch.extend(self.point(text)?);
            }
        }
        Ok(batch)
    }

    fn point(&mut self, text: &str) -> Result<Option<Vec<f64>>, FileError> {
        let words = || text.split(|c: char| c.is_whitespace() || c == ',').filter(|word| !word.is_empty());
        let is_first = !std::mem::replace(&mut self.is_begun, true);
        match words().map(str::parse).collect::<Result<Vec<f64>, _>>() {
            Ok(point) => {
                let (width, here) = (*self.width.get_or_insert(point.len()), point.len());
                if width != here {
                    return Err(self.failed(format!("has {here} numbers, but the first point has {width}")));
                }
                Ok(Some(point))
            }
            Err(_) if is_first => self.header(&words().collect::<Vec<_>>()).map(|()| None),
            Err(_) => Err(self.failed(format!("is not a point: `{text}`"))),
        }
    }

    /// A header that names coordinates must name them in their order.
    fn header(&self, words: &[&str]) -> Result<(), FileError> {
        let number = |word: &&str| word.trim_matches('"').strip_prefix(['x', 'X'])?.parse::<usize>().ok();
        let named: Option<Vec<usize>> = words.iter().map(number).collect();
        match named {
            Some(named) if !named.iter().copied().eq(1..=words.len()) => {
                Err(self.failed("names other coordinates than x1, x2, ... in this order".into()))
            }
            _ => Ok(()),
        }
    }

    fn failed(&self, what: String) -> FileError {
        FileError::reading(self.name, Reason::Other(format!("line {} {what}", self.number)))
    }
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

    fn points(text: &str) -> Result<Vec<Vec<f64>>, String> {
        let mut points = Points::new(Box::new(text.as_bytes()), Path::new("points"));
        points.batch().map_err(|error| error.to_string())
    }

    #[test]
    fn points_are_read() {
        let text = "x1, x2\n1,2\n\n# note\n 3e0\t-4 \r\n5 , 6";
        assert_eq!(points(text), Ok(vec![vec![1.0, 2.0], vec![3.0, -4.0], vec![5.0, 6.0]]));
        assert_eq!([points(""), points("x1\n")], [Ok(vec![]), Ok(vec![])]);
        assert_eq!(points("\u{feff}1 nan").map(|points| points[0][0]), Ok(1.0));
        for (text, words) in [
            ("1 2\nx y", "line 2 is not a point: `x y`"),
            ("1 2\n3", "line 2 has 1 numbers, but the first point has 2"),
            ("# a\n\nx2 x1\n1 2", "line 3 names other coordinates"),
            (&" ".repeat(1 << 17), "line 1 is longer"),
        ] {
            assert!(points(text).is_err_and(|told| told.contains(words)), "{words}");
        }
    }

    #[test]
    fn many_points_come_in_batches() {
        let text = "1 2\n".repeat(BATCH + 5);
        let mut points = Points::new(Box::new(text.as_bytes()), Path::new("points"));
        let mut count = || points.batch().map(|batch| batch.len()).ok();
        assert_eq!([count(), count(), count()], [Some(BATCH), Some(5), Some(0)]);
    }

    #[test]
    fn digits_read_back() {
        for value in [0.1, 1.0 / 3.0, 1e300, 5e-324, -0.0, f64::INFINITY, 123456.0] {
            assert_eq!(digits(value).parse::<f64>().map(f64::to_bits), Ok(value.to_bits()));
        }
        assert_eq!([digits(f64::NAN), digits(1e300), digits(0.5)], ["nan", "1e300", "0.5"]);
    }
}
