//! NRRD files, versions 1 to 5: attached and detached headers, raw, gzip, bzip2, text and hex data of every number type but blocks.
//!
//! Reads the geometry (`spacings`, `space directions`, `space origin`, `axis mins`), `line skip` and `byte skip` (-1 included); passes
//! over comments, key/value pairs and fields that do not matter to a function. The samples may lie in several files. Refuses in words:
//! more than three axes, axes of components, sample types `block`. See <https://teem.sourceforge.net/nrrd/format.html>.

mod header;

use std::io::{self, Read};

use flate2::read::MultiGzDecoder;

use super::error::DataError;
use super::stream::{self, NumberType};
use super::volume::{Samples, Volume};
use super::{Context, Fetch};
use header::{Encoding, Files, Header};

/// The volume in an NRRD file, or in the file that its header names.
///
/// # Errors
/// A header that cannot be understood or lacks a field, data that are broken or not as many as promised, a data file that cannot be
/// read, more than the limit.
pub fn decode(name: &str, bytes: &[u8], fetch: Fetch<'_>, context: Context<'_>) -> Result<Volume, DataError> {
    let header = Header::parse(bytes)?;
    let (size, placement) = header.grid()?;
    let count = stream::count(&size, header.kind()?, context)?;
    let samples = match &header.data_files {
        Some(files) => gathered(&header, files, count, fetch, context)?,
        None => samples(&header, &bytes[header.end..], count, context)?,
    };
    let size: Vec<usize> = size.iter().map(|&n| n as usize).collect();
    Volume::new(name, &size, placement, samples)
}

/// The samples of detached files, each of which holds as many of them.
fn gathered(
    header: &Header,
    files: &Files,
    count: usize,
    fetch: Fetch<'_>,
    context: Context<'_>,
) -> Result<Samples, DataError> {
    let number = files.count();
    if number == 0 {
        return Err(DataError::Header { line: header.lines, what: "`data file: LIST` lists no file".into() });
    }
    if !(count as u64).is_multiple_of(number) {
        let what = format!("{count} numbers cannot lie in {number} files of one size");
        return Err(DataError::Header { line: header.lines, what });
    }
    let each = (count as u64 / number) as usize;
    let mut all: Option<Samples> = None;
    for n in 0..number {
        context.interrupt.tick()?;
        let name = files.name(n);
        let unread =
            |error: io::Error| DataError::Detached { file: stream::shown(name.as_bytes()), reason: error.to_string() };
        let next = samples(header, &fetch(&name).map_err(unread)?, each, context)?;
        all = Some(match all {
            Some(before) => before.followed_by(next),
            None => next,
        });
    }
    all.ok_or(DataError::NoValues)
}

fn samples(header: &Header, payload: &[u8], count: usize, context: Context<'_>) -> Result<Samples, DataError> {
    let (kind, encoding) = (header.kind()?, header.encoding()?);
    let (payload, skipped) = skip_lines(payload, header.line_skip)?;
    let big_endian = match header.big_endian {
        Some(big) => big,
        None if kind.bytes() == 1 || encoding == Encoding::Text => false,
        None => return Err(DataError::MissingField { field: "endian", example: "endian: little" }),
    };
    let wrap = |error: io::Error| DataError::Compression { encoding: encoding.name(), reason: error.to_string() };
    let mut stream: Box<dyn Read + '_> = match encoding {
        Encoding::Text => return text(header, payload, skipped, kind, count, context),
        Encoding::Raw => Box::new(payload),
        Encoding::Gzip => Box::new(MultiGzDecoder::new(payload)),
        Encoding::Bzip2 => Box::new(bzip2::read::MultiBzDecoder::new(payload)),
        Encoding::Hex => Box::new(HexReader { digits: payload }),
    };
    if header.byte_skip == -1 {
        let bytes = stream::tail(&mut *stream, count * kind.bytes(), context, wrap)?;
        return stream::numbers(&mut &bytes[..], kind, big_endian, count, context, wrap);
    }
    let skip = u64::try_from(header.byte_skip).unwrap_or(0);
    if skip > context.limits.data_bytes as u64 {
        return Err(DataError::TooLarge { bytes: Some(u128::from(skip)), limit: context.limits.data_bytes });
    }
    stream::skip(&mut *stream, skip, context, wrap)?;
    stream::numbers(&mut *stream, kind, big_endian, count, context, wrap)
}

fn text(
    header: &Header,
    payload: &[u8],
    skipped: usize,
    kind: NumberType,
    count: usize,
    context: Context<'_>,
) -> Result<Samples, DataError> {
    let skip = usize::try_from(header.byte_skip).unwrap_or(0);
    let Some(text) = payload.get(skip..) else {
        let (promised, found) = (skip as u64, payload.len() as u64);
        return Err(DataError::TooFew { unit: "bytes to skip", promised, found });
    };
    let before = if header.data_files.is_some() { 0 } else { header.lines };
    stream::text_numbers(text, before + skipped + 1, kind, count, context)
}

/// What is left after `count` lines, and how many lines that were.
fn skip_lines(mut payload: &[u8], count: u64) -> Result<(&[u8], usize), DataError> {
    let mut found = 0;
    while found < count {
        let Some(end) = payload.iter().position(|&b| b == b'\n') else {
            return Err(DataError::TooFew { unit: "lines to skip", promised: count, found });
        };
        payload = &payload[end + 1..];
        found += 1;
    }
    Ok((payload, found as usize))
}

/// Bytes from pairs of hexadecimal digits; white space is passed over.
struct HexReader<'a> {
    digits: &'a [u8],
}

impl HexReader<'_> {
    fn digit(&mut self) -> io::Result<Option<u8>> {
        while let Some((&first, rest)) = self.digits.split_first() {
            self.digits = rest;
            if !first.is_ascii_whitespace() {
                let value = char::from(first).to_digit(16);
                let bad = || io::Error::new(io::ErrorKind::InvalidData, "a character is not a hexadecimal digit");
                return value.map(|v| Some(v as u8)).ok_or_else(bad);
            }
        }
        Ok(None)
    }
}

impl Read for HexReader<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        for (filled, byte) in buffer.iter_mut().enumerate() {
            let (Some(high), Some(low)) = (self.digit()?, self.digit()?) else { return Ok(filled) };
            *byte = high << 4 | low;
        }
        Ok(buffer.len())
    }
}
