//! The header of an NRRD file: lines `field: value` up to an empty one. Reads no samples.

use super::super::error::DataError;
use super::super::stream::{NumberType, number, shown};
use super::super::volume::Placement;

/// How the samples are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    Raw,
    Gzip,
    Bzip2,
    Text,
    Hex,
}

impl Encoding {
    fn from_name(name: &str) -> Option<Self> {
        Some(match name.to_ascii_lowercase().as_str() {
            "raw" => Self::Raw,
            "gzip" | "gz" => Self::Gzip,
            "bzip2" | "bz2" => Self::Bzip2,
            "txt" | "text" | "ascii" => Self::Text,
            "hex" => Self::Hex,
            _ => return None,
        })
    }

    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Raw => "raw",
            Self::Gzip => "gzip",
            Self::Bzip2 => "bzip2",
            Self::Text => "text",
            Self::Hex => "hex",
        }
    }
}

/// What the lines say. Fields of axes keep one entry for each axis; `None` where the header has `nan` or `none`.
#[derive(Debug, Default)]
pub(super) struct Header {
    kind: Option<NumberType>,
    encoding: Option<Encoding>,
    pub(super) big_endian: Option<bool>,
    dimension: Option<usize>,
    sizes: Option<Vec<u64>>,
    spacings: Option<Vec<Option<f64>>>,
    mins: Option<Vec<Option<f64>>>,
    maxs: Option<Vec<Option<f64>>>,
    cell_centred: Option<Vec<bool>>,
    directions: Option<Vec<Option<Vec<f64>>>>,
    origin: Option<Vec<f64>>,
    pub(super) line_skip: u64,
    pub(super) byte_skip: i64,
    kinds: Option<Vec<String>>,
    pub(super) data_files: Option<Files>,
    /// Whether the lines that follow are names of files.
    is_list: bool,
    /// Where the data begin.
    pub(super) end: usize,
    /// Lines of the header, the empty one included.
    pub(super) lines: usize,
}

/// Where a detached header says that the samples are.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Files {
    /// In the files of these names, one after the other.
    Named(Vec<String>),
    /// In files whose names are numbered.
    Series(Series),
}

/// `before`, a number of at least `width` digits (zeros before it), `after`; the numbers are `first`, `first + step` and so on.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Series {
    before: String,
    after: String,
    width: usize,
    first: i64,
    step: i64,
    count: u64,
}

impl Files {
    pub(super) fn count(&self) -> u64 {
        match self {
            Self::Named(names) => names.len() as u64,
            Self::Series(series) => series.count,
        }
    }

    /// The name of file `n`, counted from 0.
    pub(super) fn name(&self, n: u64) -> String {
        match self {
            Self::Named(names) => names.get(n as usize).cloned().unwrap_or_default(),
            Self::Series(Series { before, after, width, first, step, .. }) => {
                let number = first.saturating_add(step.saturating_mul(n as i64));
                format!("{before}{number:0width$}{after}")
            }
        }
    }
}

/// A header is text of a few lines; what goes on longer is none.
const LONGEST: usize = 1 << 20;

impl Header {
    pub(super) fn parse(bytes: &[u8]) -> Result<Self, DataError> {
        let mut header = Self::default();
        let mut at = 0;
        while at < bytes.len() {
            if at > LONGEST {
                return Err(bad(header.lines + 1, "the header does not end; an empty line must stand before the data"));
            }
            let end = bytes[at..].iter().position(|&b| b == b'\n').map_or(bytes.len(), |end| at + end);
            let line = bytes[at..end].strip_suffix(b"\r").unwrap_or(&bytes[at..end]);
            at = (end + 1).min(bytes.len());
            header.lines += 1;
            if header.lines == 1 {
                magic(line)?;
            } else if line.is_empty() {
                break;
            } else if let Some(Files::Named(names)) = header.data_files.as_mut().filter(|_| header.is_list) {
                names.push(String::from_utf8_lossy(line).trim().to_owned());
            } else {
                header.line(header.lines, line)?;
            }
        }
        header.end = at;
        if header.lines == 0 {
            return Err(bad(1, "the file is empty"));
        }
        Ok(header)
    }

    /// One line: a comment, a key/value pair `key:=value`, or a field.
    fn line(&mut self, line: usize, bytes: &[u8]) -> Result<(), DataError> {
        if bytes[0] == b'#' {
            return Ok(());
        }
        let text = String::from_utf8_lossy(bytes);
        let Some((field, value)) = text.split_once(':') else {
            return Err(bad(line, format!("`{}` is neither a field, `name: value`, nor a comment", shown(bytes))));
        };
        if value.starts_with('=') {
            return Ok(());
        }
        self.field(line, &field.trim().to_ascii_lowercase(), value.trim())
    }

    fn field(&mut self, line: usize, field: &str, value: &str) -> Result<(), DataError> {
        let unknown = |what: &str| bad(line, format!("`{}` is not {what}", shown(value.as_bytes())));
        match field {
            "type" if value.eq_ignore_ascii_case("block") => return Err(blocks()),
            "type" => self.kind = Some(NumberType::from_name(value).ok_or_else(|| unknown("a number type"))?),
            "encoding" => {
                let help = "an encoding that is read: raw, gzip, bzip2, text, hex";
                self.encoding = Some(Encoding::from_name(value).ok_or_else(|| unknown(help))?);
            }
            "endian" => {
                self.big_endian = Some(match value.to_ascii_lowercase().as_str() {
                    "big" => true,
                    "little" => false,
                    _ => return Err(unknown("`little` or `big`")),
                });
            }
            "dimension" => self.dimension = Some(value.parse().map_err(|_| unknown("a number of axes"))?),
            "sizes" => self.sizes = Some(list(value, size).ok_or_else(|| unknown("a list of sizes"))?),
            "spacings" => self.spacings = Some(list(value, maybe).ok_or_else(|| unknown("a list of numbers"))?),
            "axis mins" | "axismins" => {
                self.mins = Some(list(value, maybe).ok_or_else(|| unknown("a list of numbers"))?)
            }
            "axis maxs" | "axismaxs" => {
                self.maxs = Some(list(value, maybe).ok_or_else(|| unknown("a list of numbers"))?)
            }
            "centers" | "centerings" => {
                self.cell_centred = Some(value.split_whitespace().map(|w| w.eq_ignore_ascii_case("cell")).collect());
            }
            "space directions" => {
                self.directions = Some(vectors(value).ok_or_else(|| unknown("a list of vectors like (1,0,0)"))?);
            }
            "space origin" => {
                self.origin = Some(vector(value).ok_or_else(|| unknown("a point like (0,0,0)"))?);
            }
            "line skip" | "lineskip" => self.line_skip = value.parse().map_err(|_| unknown("a number of lines"))?,
            "byte skip" | "byteskip" => {
                self.byte_skip =
                    value.parse().ok().filter(|&n| n >= -1).ok_or_else(|| unknown("a number of bytes, or -1"))?;
            }
            "kinds" => self.kinds = Some(value.split_whitespace().map(str::to_owned).collect()),
            "data file" | "datafile" => {
                self.is_list = value.split_whitespace().next() == Some("LIST");
                self.data_files = Some(if self.is_list { Files::Named(Vec::new()) } else { data_files(line, value)? });
            }
            _ => {}
        }
        Ok(())
    }

    pub(super) fn kind(&self) -> Result<NumberType, DataError> {
        self.kind.ok_or(DataError::MissingField { field: "type", example: "type: float" })
    }

    pub(super) fn encoding(&self) -> Result<Encoding, DataError> {
        self.encoding.ok_or(DataError::MissingField { field: "encoding", example: "encoding: raw" })
    }

    /// Sizes and place of the grid, all fields of axes checked against the dimension.
    pub(super) fn grid(&self) -> Result<(Vec<u64>, Placement), DataError> {
        let dimension =
            self.dimension.ok_or(DataError::MissingField { field: "dimension", example: "dimension: 3" })?;
        let sizes =
            self.sizes.as_ref().ok_or(DataError::MissingField { field: "sizes", example: "sizes: 64 64 32" })?;
        self.only_directions()?;
        if dimension == 0 || dimension > 3 {
            return Err(DataError::Dimensions { found: dimension });
        }
        let lengths = [
            ("sizes", Some(sizes.len())),
            ("spacings", self.spacings.as_ref().map(Vec::len)),
            ("axis mins", self.mins.as_ref().map(Vec::len)),
            ("axis maxs", self.maxs.as_ref().map(Vec::len)),
            ("centers", self.cell_centred.as_ref().map(Vec::len)),
            ("space directions", self.directions.as_ref().map(Vec::len)),
            ("kinds", self.kinds.as_ref().map(Vec::len)),
        ];
        for (field, length) in lengths {
            if length.is_some_and(|length| length != dimension) {
                let length = length.unwrap_or(0);
                return Err(bad(self.lines, format!("`{field}` has {length} entries for {dimension} axes")));
            }
        }
        Ok((sizes.clone(), self.placement(dimension, sizes)?))
    }

    /// Refuses axes along which one does not move: components of colours and vectors, lists.
    fn only_directions(&self) -> Result<(), DataError> {
        let moves =
            |kind: &str| ["domain", "space", "time", "none", "???"].iter().any(|k| kind.eq_ignore_ascii_case(k));
        let kinds = self.kinds.iter().flatten().enumerate();
        if let Some((axis, kind)) = kinds.into_iter().find(|(_, kind)| !moves(kind)) {
            let kind = shown(kind.as_bytes());
            let what = format!("axis {} of the grid holds the components of a {kind}", axis + 1);
            return Err(DataError::Unsupported { what, help: ONE_COMPONENT.into() });
        }
        match self.directions.iter().flatten().position(Option::is_none) {
            Some(axis) => Err(no_direction(axis)),
            None => Ok(()),
        }
    }

    fn placement(&self, dimension: usize, sizes: &[u64]) -> Result<Placement, DataError> {
        let mut placement = Placement::default();
        for axis in 0..dimension {
            let at = |list: &Option<Vec<Option<f64>>>| list.as_ref().and_then(|list| list[axis]);
            let cell = self.cell_centred.as_ref().is_some_and(|list| list[axis]);
            let (min, max) = (at(&self.mins), at(&self.maxs));
            let steps = if cell { sizes[axis] as f64 } else { sizes[axis] as f64 - 1.0 };
            let from_ends = min.zip(max).filter(|_| steps > 0.0).map(|(min, max)| (max - min) / steps);
            let spacing = at(&self.spacings).or(from_ends).unwrap_or(1.0);
            placement.directions[axis][axis] = spacing;
            placement.origin[axis] = min.map_or(0.0, |min| if cell { min + 0.5 * spacing } else { min });
        }
        if let Some(directions) = &self.directions {
            for (axis, direction) in directions.iter().enumerate() {
                let direction = direction.as_ref().ok_or_else(|| no_direction(axis))?;
                placement.directions[axis] = within(direction, dimension)?;
            }
        }
        if let Some(origin) = &self.origin {
            placement.origin = [0.0; 3];
            for (to, from) in placement.origin.iter_mut().zip(origin).take(dimension) {
                *to = *from;
            }
        }
        let flat = placement.origin.iter().chain(placement.directions.iter().flatten()).any(|v| !v.is_finite());
        if flat { Err(DataError::FlatGrid) } else { Ok(placement) }
    }
}

/// The first coordinates of a direction, if the others are zero.
fn within(direction: &[f64], dimension: usize) -> Result<[f64; 3], DataError> {
    if direction.len() < dimension || direction.iter().skip(dimension).any(|&v| v != 0.0) {
        return Err(DataError::FlatGrid);
    }
    let mut result = [0.0; 3];
    result[..dimension].copy_from_slice(&direction[..dimension]);
    Ok(result)
}

fn bad(line: usize, what: impl Into<String>) -> DataError {
    DataError::Header { line, what: what.into() }
}

fn blocks() -> DataError {
    DataError::Unsupported {
        what: "samples of type `block` are not numbers".into(),
        help: "write the file again with a number type".into(),
    }
}

fn no_direction(axis: usize) -> DataError {
    DataError::Unsupported {
        what: format!("axis {} of the grid is no direction of space", axis + 1),
        help: ONE_COMPONENT.into(),
    }
}

const ONE_COMPONENT: &str = "cut out one component (a colour, a moment) as a file of its own";

fn magic(line: &[u8]) -> Result<(), DataError> {
    match line.strip_prefix(b"NRRD000") {
        Some([b'1'..=b'5']) => Ok(()),
        Some(_) => Err(DataError::Unsupported {
            what: format!("`{}` is not a version of NRRD that is read (NRRD0001 to NRRD0005)", shown(line)),
            help: "write the file again as NRRD0005 or below".into(),
        }),
        None => Err(bad(1, "an NRRD file starts with `NRRD0005` or the like")),
    }
}

/// One file, or a numbered series `pattern first last step`, perhaps with the number of axes of each file behind it, which the number of
/// files tells as well.
fn data_files(line: usize, value: &str) -> Result<Files, DataError> {
    let words: Vec<&str> = value.split_whitespace().collect();
    let bounds: Option<Vec<i64>> = words.iter().skip(1).map(|word| word.parse().ok()).collect();
    match (bounds.as_deref(), words.first()) {
        (Some([first, last, step] | [first, last, step, _]), Some(pattern)) if pattern.contains('%') => {
            let unknown = || bad(line, format!("`{}` is not a series of files", shown(value.as_bytes())));
            series(pattern, [*first, *last, *step]).map(Files::Series).ok_or_else(unknown)
        }
        (_, None) => Err(bad(line, "`data file` names no file")),
        _ => Ok(Files::Named(vec![value.to_owned()])),
    }
}

/// A pattern with one `%d`, which may have a width: `slice%03d.raw`.
fn series(pattern: &str, [first, last, step]: [i64; 3]) -> Option<Series> {
    let (before, rest) = pattern.split_once('%')?;
    let (width, after) = rest.split_once('d')?;
    let width = if width.is_empty() { 0 } else { width.parse().ok().filter(|w| *w <= 64)? };
    let steps = last.checked_sub(first)?.checked_div(step).filter(|steps| *steps >= 0)?;
    let count = steps as u64 + 1;
    Some(Series { before: before.to_owned(), after: after.to_owned(), width, first, step, count })
}

fn list<T>(value: &str, item: impl Fn(&str) -> Option<T>) -> Option<Vec<T>> {
    value.split_whitespace().map(item).collect()
}

/// Digits; too many for a number count as the largest one, so that the limit speaks.
fn size(word: &str) -> Option<u64> {
    word.bytes().all(|b| b.is_ascii_digit()).then(|| word.parse().unwrap_or(u64::MAX))
}

/// A number, or unknown.
fn maybe(word: &str) -> Option<Option<f64>> {
    number(word.as_bytes()).map(|v| Some(v).filter(|v| !v.is_nan()))
}

/// `(a,b,c)`.
fn vector(value: &str) -> Option<Vec<f64>> {
    let inner = value.trim().strip_prefix('(')?.strip_suffix(')')?;
    inner.split(',').map(|word| number(word.trim().as_bytes())).collect()
}

/// Vectors or `none`, apart by white space, which may also stand within the brackets.
fn vectors(value: &str) -> Option<Vec<Option<Vec<f64>>>> {
    let mut all = Vec::new();
    let mut rest = value.trim();
    while !rest.is_empty() {
        if let Some(after) = rest.strip_prefix("none") {
            all.push(None);
            rest = after.trim_start();
        } else {
            let end = rest.find(')')? + 1;
            all.push(Some(vector(&rest[..end])?));
            rest = rest[end..].trim_start();
        }
    }
    Some(all)
}
