//! Numbers from streams of bytes: types, byte order, and reading with a bound, so that no header and no compressed bomb decides how
//! much memory is taken. Knows no file format.

use std::io::{self, Read};

use super::Context;
use super::error::DataError;
use super::volume::Samples;

/// The number types of the formats.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NumberType {
    /// Signed byte.
    Int8,
    /// Unsigned byte.
    Uint8,
    /// Two bytes, signed.
    Int16,
    /// Two bytes, unsigned.
    Uint16,
    /// Four bytes, signed.
    Int32,
    /// Four bytes, unsigned.
    Uint32,
    /// Eight bytes, signed.
    Int64,
    /// Eight bytes, unsigned.
    Uint64,
    /// IEEE single precision.
    Float32,
    /// IEEE double precision.
    Float64,
}

impl NumberType {
    /// Bytes of one number.
    #[must_use]
    pub fn bytes(self) -> usize {
        match self {
            Self::Int8 | Self::Uint8 => 1,
            Self::Int16 | Self::Uint16 => 2,
            Self::Int32 | Self::Uint32 | Self::Float32 => 4,
            Self::Int64 | Self::Uint64 | Self::Float64 => 8,
        }
    }

    /// Bytes of one number in memory, as [`Samples`] holds it.
    #[must_use]
    pub fn stored(self) -> usize {
        match self {
            Self::Uint8 => 1,
            Self::Int8 | Self::Int16 | Self::Uint16 | Self::Float32 => 4,
            _ => 8,
        }
    }

    /// Whether numbers of this type can be that one: whole and within its range, or anything for floating point.
    #[must_use]
    pub fn holds(self, value: f64) -> bool {
        let (lo, hi) = match self {
            Self::Int8 => (-128.0, 127.0),
            Self::Uint8 => (0.0, 255.0),
            Self::Int16 => (-32_768.0, 32_767.0),
            Self::Uint16 => (0.0, 65_535.0),
            Self::Int32 => (f64::from(i32::MIN), f64::from(i32::MAX)),
            Self::Uint32 => (0.0, f64::from(u32::MAX)),
            Self::Int64 => (i64::MIN as f64, i64::MAX as f64),
            Self::Uint64 => (0.0, u64::MAX as f64),
            Self::Float32 | Self::Float64 => return true,
        };
        value.fract() == 0.0 && (lo..=hi).contains(&value)
    }

    /// What messages call it.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::Int8 => "a signed byte",
            Self::Uint8 => "an unsigned byte",
            Self::Int16 => "a signed 16-bit number",
            Self::Uint16 => "an unsigned 16-bit number",
            Self::Int32 => "a signed 32-bit number",
            Self::Uint32 => "an unsigned 32-bit number",
            Self::Int64 => "a signed 64-bit number",
            Self::Uint64 => "an unsigned 64-bit number",
            Self::Float32 => "a number of single precision",
            Self::Float64 => "a number of double precision",
        }
    }

    /// The type of that name, in any of the spellings of NRRD and of file names.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Some(match name.to_ascii_lowercase().as_str() {
            "signed char" | "int8" | "int8_t" => Self::Int8,
            "uchar" | "unsigned char" | "uint8" | "uint8_t" => Self::Uint8,
            "short" | "short int" | "signed short" | "signed short int" | "int16" | "int16_t" => Self::Int16,
            "ushort" | "unsigned short" | "unsigned short int" | "uint16" | "uint16_t" => Self::Uint16,
            "int" | "signed int" | "int32" | "int32_t" => Self::Int32,
            "uint" | "unsigned int" | "uint32" | "uint32_t" => Self::Uint32,
            "longlong"
            | "long long"
            | "long long int"
            | "signed long long"
            | "signed long long int"
            | "int64"
            | "int64_t" => Self::Int64,
            "ulonglong" | "unsigned long long" | "unsigned long long int" | "uint64" | "uint64_t" => Self::Uint64,
            "float" | "float32" => Self::Float32,
            "double" | "float64" => Self::Float64,
            _ => return None,
        })
    }

    /// An empty list for `count` numbers of this type.
    fn room(self) -> Samples {
        match self.stored() {
            1 => Samples::Bytes(Vec::new()),
            4 => Samples::Singles(Vec::new()),
            _ => Samples::Doubles(Vec::new()),
        }
    }

    fn push(self, big_endian: bool, bytes: &[u8], into: &mut Samples) {
        match into {
            Samples::Bytes(all) => all.extend_from_slice(bytes),
            Samples::Singles(all) => all.extend(bytes.chunks_exact(self.bytes()).map(|b| self.single(big_endian, b))),
            Samples::Doubles(all) => all.extend(bytes.chunks_exact(self.bytes()).map(|b| self.double(big_endian, b))),
        }
    }

    fn single(self, big_endian: bool, bytes: &[u8]) -> f32 {
        match self {
            Self::Int8 => f32::from(bytes[0] as i8),
            Self::Int16 => f32::from(u16_of(big_endian, bytes) as i16),
            Self::Uint16 => f32::from(u16_of(big_endian, bytes)),
            _ => f32::from_bits(u32_of(big_endian, bytes)),
        }
    }

    fn double(self, big_endian: bool, bytes: &[u8]) -> f64 {
        match self {
            Self::Int32 => f64::from(u32_of(big_endian, bytes) as i32),
            Self::Uint32 => f64::from(u32_of(big_endian, bytes)),
            Self::Int64 => u64_of(big_endian, bytes) as i64 as f64,
            Self::Uint64 => u64_of(big_endian, bytes) as f64,
            _ => f64::from_bits(u64_of(big_endian, bytes)),
        }
    }
}

fn array<const N: usize>(big_endian: bool, bytes: &[u8]) -> [u8; N] {
    let mut result = [0; N];
    result.copy_from_slice(&bytes[..N]);
    if big_endian {
        result.reverse();
    }
    result
}

fn u16_of(big_endian: bool, bytes: &[u8]) -> u16 {
    u16::from_le_bytes(array(big_endian, bytes))
}

fn u32_of(big_endian: bool, bytes: &[u8]) -> u32 {
    u32::from_le_bytes(array(big_endian, bytes))
}

fn u64_of(big_endian: bool, bytes: &[u8]) -> u64 {
    u64::from_le_bytes(array(big_endian, bytes))
}

/// The product of the sizes, if the numbers fit the limit both in the file and in memory.
///
/// # Errors
/// More than three axes, an empty one, more than `Limits::data_bytes`.
pub fn count(size: &[u64], kind: NumberType, context: Context<'_>) -> Result<usize, DataError> {
    if size.is_empty() || size.len() > 3 {
        return Err(DataError::Dimensions { found: size.len() });
    }
    if let Some(axis) = size.iter().position(|&n| n == 0) {
        return Err(DataError::EmptyAxis { axis: axis + 1 });
    }
    let limit = context.limits.data_bytes;
    let bytes = size
        .iter()
        .try_fold(1_u128, |product, &n| product.checked_mul(u128::from(n)))
        .and_then(|product| product.checked_mul(kind.bytes().max(kind.stored()) as u128));
    match bytes {
        Some(bytes) if bytes <= limit as u128 => Ok(size.iter().product::<u64>() as usize),
        _ => Err(DataError::TooLarge { bytes, limit }),
    }
}

/// Exactly `count` numbers from a stream; the memory grows only as bytes arrive. `wrap` gives a name to a failure of the stream.
///
/// # Errors
/// A stream that ends before or goes on after the numbers, or fails; an interrupt.
pub fn numbers(
    stream: &mut dyn Read,
    kind: NumberType,
    big_endian: bool,
    count: usize,
    context: Context<'_>,
    wrap: impl Fn(io::Error) -> DataError,
) -> Result<Samples, DataError> {
    let mut samples = kind.room();
    let promised = count * kind.bytes();
    let mut buffer = vec![0; (1 << 16).min(promised)];
    let mut found = 0;
    while found < promised {
        context.interrupt.tick()?;
        let want = buffer.len().min(promised - found);
        let got = fill(stream, &mut buffer[..want]).map_err(&wrap)?;
        kind.push(big_endian, &buffer[..got], &mut samples);
        found += got;
        if got < want {
            return Err(DataError::TooFew { unit: "bytes", promised: promised as u64, found: found as u64 });
        }
    }
    match fill(stream, &mut [0]).map_err(&wrap)? {
        0 => Ok(samples),
        _ => Err(DataError::TooMany { unit: "bytes", promised: promised as u64 }),
    }
}

/// Passes over `count` bytes of a stream.
///
/// # Errors
/// As [`numbers`]; a stream that ends before.
pub fn skip(
    stream: &mut dyn Read,
    count: u64,
    context: Context<'_>,
    wrap: impl Fn(io::Error) -> DataError,
) -> Result<(), DataError> {
    let mut buffer = vec![0; 1 << 16];
    let mut left = count;
    while left > 0 {
        context.interrupt.tick()?;
        let want = left.min(buffer.len() as u64) as usize;
        let got = fill(stream, &mut buffer[..want]).map_err(&wrap)?;
        left -= got as u64;
        if got < want {
            return Err(DataError::TooFew { unit: "bytes to skip", promised: count, found: count - left });
        }
    }
    Ok(())
}

/// The last `count` bytes of a stream that may be longer, but not longer than the limit.
///
/// # Errors
/// As [`numbers`]; more than `Limits::data_bytes`.
pub fn tail(
    stream: &mut dyn Read,
    count: usize,
    context: Context<'_>,
    wrap: impl Fn(io::Error) -> DataError,
) -> Result<Vec<u8>, DataError> {
    let limit = context.limits.data_bytes;
    let mut all = Vec::new();
    let mut buffer = vec![0; 1 << 16];
    loop {
        context.interrupt.tick()?;
        let got = fill(stream, &mut buffer).map_err(&wrap)?;
        if all.len() + got > limit {
            return Err(DataError::TooLarge { bytes: Some((all.len() + got) as u128), limit });
        }
        all.extend_from_slice(&buffer[..got]);
        if got < buffer.len() {
            break;
        }
    }
    if all.len() < count {
        return Err(DataError::TooFew { unit: "bytes", promised: count as u64, found: all.len() as u64 });
    }
    Ok(all.split_off(all.len() - count))
}

/// Reads until the buffer is full or the stream ends; how many bytes came.
fn fill(stream: &mut dyn Read, buffer: &mut [u8]) -> io::Result<usize> {
    let mut filled = 0;
    while filled < buffer.len() {
        match stream.read(&mut buffer[filled..]) {
            Ok(0) => break,
            Ok(got) => filled += got,
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Err(error) => return Err(error),
        }
    }
    Ok(filled)
}

/// Numbers written as text, apart by white space or commas; `#` begins a comment up to the end of its line. `line` is the number of
/// the first line, for messages.
///
/// # Errors
/// A word that is not a number, fewer or more than `count` numbers, an interrupt.
pub fn text_numbers(
    text: &[u8],
    line: usize,
    kind: NumberType,
    count: usize,
    context: Context<'_>,
) -> Result<Samples, DataError> {
    let mut samples = kind.room();
    for (offset, row) in text.split(|&b| b == b'\n').enumerate() {
        context.interrupt.tick()?;
        let row = row.split(|&b| b == b'#').next().unwrap_or(row);
        let words = row.split(|&b| b.is_ascii_whitespace() || b == b',').filter(|word| !word.is_empty());
        for word in words {
            if samples.len() == count {
                return Err(DataError::TooMany { unit: "numbers", promised: count as u64 });
            }
            let value = number(word).ok_or_else(|| DataError::NotANumber { line: line + offset, word: shown(word) })?;
            if !kind.holds(value) {
                let what = format!("`{}` does not fit {}", shown(word), kind.words());
                return Err(DataError::Sample { line: line + offset, what });
            }
            match &mut samples {
                Samples::Bytes(all) => all.push(value as u8),
                Samples::Singles(all) => all.push(value as f32),
                Samples::Doubles(all) => all.push(value),
            }
        }
    }
    if samples.len() < count {
        return Err(DataError::TooFew { unit: "numbers", promised: count as u64, found: samples.len() as u64 });
    }
    Ok(samples)
}

/// A number written as text; `nan` and infinities too.
#[must_use]
pub fn number(word: &[u8]) -> Option<f64> {
    std::str::from_utf8(word).ok()?.parse().ok()
}

/// A word as messages show it: printable and short.
#[must_use]
pub fn shown(word: &[u8]) -> String {
    let text: String = String::from_utf8_lossy(&word[..word.len().min(64)]).chars().take(24).collect();
    let mut text: String = text.chars().map(|c| if c.is_control() { '?' } else { c }).collect();
    if word.len() > text.len() {
        text.push_str("...");
    }
    text
}
