//! Raw files whose names tell what they hold: `name_WxHxD_type.raw`, as the open volume collections name theirs. Reads no header.
//!
//! `W`, `H`, `D` are the samples along x1, x2, x3 (x1 fastest; `W` or `WxH` for one or two axes); the type is one of `int8 uint8 int16
//! uint16 int32 uint32 int64 uint64 float32 float64`, with `_be` or `_le` behind it for the byte order (little-endian without).
//! Spacing 1, origin 0.

use super::error::DataError;
use super::stream::{NumberType, count, numbers};
use super::volume::{Placement, Volume};
use super::{Context, stream};

/// What a name tells.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Name {
    /// Samples along each axis.
    pub size: Vec<u64>,
    /// The type of a sample.
    pub kind: NumberType,
    /// Whether the bytes of a sample stand from the most significant one.
    pub big_endian: bool,
}

impl Name {
    /// Reads the last part of a path.
    ///
    /// # Errors
    /// [`DataError::RawName`]: no size, no type, or one that is not known.
    pub fn parse(name: &str) -> Result<Self, DataError> {
        let wrong = |what: String| DataError::RawName { what };
        let stem = name.rsplit_once('.').map_or(name, |(stem, _)| stem);
        let mut parts: Vec<&str> = stem.split('_').collect();
        let big_endian = match parts.last().copied() {
            Some("be" | "big") => parts.pop().is_some(),
            Some("le" | "little") => parts.pop().is_none(),
            _ => false,
        };
        let (kind, big_endian) = parts
            .pop()
            .and_then(|word| number_type(word, big_endian))
            .ok_or_else(|| wrong(format!("`{}` does not end with a number type", stream::shown(stem.as_bytes()))))?;
        let size = parts.pop().unwrap_or_default();
        let size = sizes(size).ok_or_else(|| {
            wrong(format!("`{}` before the type is not a size like 128x128x64", stream::shown(size.as_bytes())))
        })?;
        Ok(Self { size, kind, big_endian })
    }
}

/// A type, perhaps with `le` or `be` right behind it.
fn number_type(word: &str, big_endian: bool) -> Option<(NumberType, bool)> {
    if let Some(kind) = NumberType::from_name(word) {
        return Some((kind, big_endian));
    }
    let (kind, order) = word.split_at_checked(word.len().checked_sub(2)?)?;
    let kind = NumberType::from_name(kind)?;
    match order {
        "be" => Some((kind, true)),
        "le" => Some((kind, false)),
        _ => None,
    }
}

/// `WxHxD`; digits that are too many for a number count as the largest one, so that the limit speaks.
fn sizes(word: &str) -> Option<Vec<u64>> {
    word.split(['x', 'X'])
        .map(|digits| {
            let plain = !digits.is_empty() && digits.bytes().all(|b| b.is_ascii_digit());
            plain.then(|| digits.parse().unwrap_or(u64::MAX))
        })
        .collect()
}

/// The volume in a raw file of that name.
///
/// # Errors
/// A name that does not tell, another number of bytes than it tells, more than the limit.
pub fn decode(name: &str, bytes: &[u8], context: Context<'_>) -> Result<Volume, DataError> {
    let told = Name::parse(name)?;
    let count = count(&told.size, told.kind, context)?;
    let unread = |error: std::io::Error| DataError::Unsupported { what: error.to_string(), help: String::new() };
    let samples = numbers(&mut &bytes[..], told.kind, told.big_endian, count, context, unread)?;
    let size: Vec<usize> = told.size.iter().map(|&n| n as usize).collect();
    Volume::new(name, &size, Placement::default(), samples)
}
