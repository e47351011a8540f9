//! What can be wrong with a data file, in the user's words. Holds no bytes and no places in a script: the model adds those.

use std::fmt;

use crate::interrupt::Cancelled;

/// Why a file could not become a function. `Display` says what was found; [`DataError::help`] says what to do.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum DataError {
    /// Neither the name nor the first bytes tell what the file is.
    UnknownFormat,
    /// The name of a `.raw` file does not say its size and type.
    RawName {
        /// What is wrong with it.
        what: String,
    },
    /// A line of a header cannot be understood.
    Header {
        /// The line, counted from 1.
        line: usize,
        /// What was found.
        what: String,
    },
    /// A header ends without something that is needed.
    MissingField {
        /// The field's name.
        field: &'static str,
        /// A line that would do.
        example: &'static str,
    },
    /// The grid has more than three axes.
    Dimensions {
        /// How many it has.
        found: usize,
    },
    /// A legal file of a kind that is not read.
    Unsupported {
        /// What it has.
        what: String,
        /// What to do.
        help: String,
    },
    /// An axis without samples.
    EmptyAxis {
        /// The axis, counted from 1.
        axis: usize,
    },
    /// More than the limit.
    TooLarge {
        /// Bytes that it would take; `None` if not even that can be counted.
        bytes: Option<u128>,
        /// The limit.
        limit: usize,
    },
    /// Fewer data than the header promises.
    TooFew {
        /// What is counted: `bytes` or `numbers`.
        unit: &'static str,
        /// What the header promises.
        promised: u64,
        /// What is there.
        found: u64,
    },
    /// More data than the header promises.
    TooMany {
        /// What is counted: `bytes` or `numbers`.
        unit: &'static str,
        /// What the header promises.
        promised: u64,
    },
    /// A word that should be a number.
    NotANumber {
        /// The line, counted from 1.
        line: usize,
        /// The word, shortened.
        word: String,
    },
    /// A number that the type of the samples cannot hold.
    Sample {
        /// The line, counted from 1.
        line: usize,
        /// What was found.
        what: String,
    },
    /// Compressed data that are broken.
    Compression {
        /// `gzip` or `bzip2`.
        encoding: &'static str,
        /// What the decoder says.
        reason: String,
    },
    /// The file that a detached header names cannot be read.
    Detached {
        /// Its name as the header has it.
        file: String,
        /// Why.
        reason: String,
    },
    /// The axes of the grid do not span the space.
    FlatGrid,
    /// No sample is a number.
    NoValues,
    /// Stopped by the user.
    Cancelled,
}

impl DataError {
    /// What the user can do about it.
    #[must_use]
    pub fn help(&self) -> String {
        match self {
            Self::UnknownFormat => "use a .nrrd or .nhdr file, a raw file named like head_128x128x64_uint8.raw, or a text .dat".into(),
            Self::RawName { .. } => {
                "name it like head_128x128x64_uint8.raw: the samples along x1, x2 and x3, then int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32 or float64, then _be if its bytes are big-endian".into()
            }
            Self::Header { .. } | Self::NotANumber { .. } | Self::Sample { .. } => "mend that line, or write the file again".into(),
            Self::MissingField { field, example } => format!("add a line for `{field}`, for example `{example}`"),
            Self::Dimensions { .. } => "cut out the part that is wanted as a file of one to three axes".into(),
            Self::Unsupported { help, .. } => help.clone(),
            Self::EmptyAxis { .. } => "every axis needs at least one sample".into(),
            Self::TooLarge { .. } => "take fewer samples, or cut out the part that is wanted".into(),
            Self::TooFew { .. } => "the file is incomplete or its header is wrong: fetch it again, or correct the sizes or the type".into(),
            Self::TooMany { .. } => "correct the sizes or the type in the header; what precedes the samples can be passed over with `byte skip`".into(),
            Self::Compression { .. } => "the file is damaged or cut short: fetch it again".into(),
            Self::Detached { .. } => "put the file where the header says, beside the header".into(),
            Self::FlatGrid => "give each axis a direction of its own that is not zero".into(),
            Self::NoValues => "every sample is nan or infinite: check the type and the byte order".into(),
            Self::Cancelled => String::new(),
        }
    }
}

impl fmt::Display for DataError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::UnknownFormat => write!(f, "this is not a volume file of a known kind"),
            Self::RawName { what } => write!(f, "the name of a raw file must tell its size and type: {what}"),
            Self::Header { line, what } => write!(f, "line {line} of the header: {what}"),
            Self::MissingField { field, .. } => write!(f, "the header has no `{field}`"),
            Self::Dimensions { found } => write!(f, "the grid has {found} axes; one to three can be interpolated"),
            Self::Unsupported { what, .. } => write!(f, "{what}"),
            Self::EmptyAxis { axis } => write!(f, "axis {axis} has no samples"),
            Self::TooLarge { bytes: Some(bytes), limit } => {
                write!(f, "the data would take {bytes} bytes; the limit is {limit}")
            }
            Self::TooLarge { bytes: None, limit } => {
                write!(f, "the data would take more bytes than can be counted; the limit is {limit}")
            }
            Self::TooFew { unit, promised, found } => {
                write!(f, "the header promises {promised} {unit}, but there are only {found}")
            }
            Self::TooMany { unit, promised } => {
                write!(f, "there are more than the {promised} {unit} that the header promises")
            }
            Self::NotANumber { line, word } => write!(f, "line {line}: `{word}` is not a number"),
            Self::Sample { line, what } => write!(f, "line {line}: {what}"),
            Self::Compression { encoding, reason } => write!(f, "the {encoding} data are broken: {reason}"),
            Self::Detached { file, reason } => write!(f, "the header's data file `{file}` cannot be read: {reason}"),
            Self::FlatGrid => write!(f, "the axes of the grid do not span the space"),
            Self::NoValues => write!(f, "no sample of the data is a finite number"),
            Self::Cancelled => write!(f, "cancelled"),
        }
    }
}

impl std::error::Error for DataError {}

impl From<Cancelled> for DataError {
    fn from(_: Cancelled) -> Self {
        Self::Cancelled
    }
}
