//! Decodes volumes and meshes from bytes into leaves, and polygons into formulas. Knows no disk: it gets bytes, and asks a callback for the file that a header names.
//!
//! Formats: NRRD ([`nrrd`]), raw files named `name_WxHxD_type.raw` ([`raw`]), text `.dat` files ([`text`]). A file that starts with
//! `NRRD` is an NRRD whatever its name. Nothing here panics on any bytes, and nothing takes more memory than the limits say: a
//! header is believed only as far as there are data.

mod ears;
pub mod error;
mod fingerprint;
pub mod interpolate;
pub mod mesh;
pub mod nrrd;
pub mod obj;
pub mod place;
pub mod polygon;
pub mod pyramid;
pub mod raw;
pub mod sheet;
pub mod stl;
pub mod stream;
pub mod text;
pub mod volume;

pub use error::DataError;
pub use interpolate::Interpolation;
pub use volume::{Placement, Samples, Volume};

use std::io;

use crate::interrupt::Interrupt;
use crate::limits::Limits;

/// Reads the file of that name, which a detached header gives, relative to the header.
pub type Fetch<'a> = &'a mut dyn FnMut(&str) -> io::Result<Vec<u8>>;

/// What decoding needs besides the bytes.
#[derive(Clone, Copy, Debug)]
pub struct Context<'a> {
    /// What bounds the size of the data.
    pub limits: &'a Limits,
    /// Asked while long data are decoded.
    pub interrupt: &'a Interrupt,
}

/// The volume in `bytes`, the content of the file `name` (a path or just its last part).
///
/// # Errors
/// See [`DataError`]: an unknown kind of file, a header or a name that cannot be understood, data that are broken, fewer or more than
/// promised, more than `Limits::data_bytes`.
pub fn decode(name: &str, bytes: &[u8], fetch: Fetch<'_>, context: Context<'_>) -> Result<Volume, DataError> {
    let last = name.rsplit(['/', '\\']).next().unwrap_or(name);
    let extension = last.rsplit_once('.').map_or(String::new(), |(_, e)| e.to_ascii_lowercase());
    match extension.as_str() {
        _ if bytes.starts_with(b"NRRD") => nrrd::decode(last, bytes, fetch, context),
        "nrrd" | "nhdr" => nrrd::decode(last, bytes, fetch, context),
        "raw" => raw::decode(last, bytes, context),
        "dat" | "txt" => text::decode(last, bytes, context),
        _ => Err(DataError::UnknownFormat),
    }
}
