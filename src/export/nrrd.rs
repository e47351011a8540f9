//! NRRD volumes: a field sampled on a grid, attached header, raw or gzip. The same samples give the same bytes. Never seeks.

use std::io::{self, Write};

use flate2::{Compression, GzBuilder};

/// The samples of a [`Field`], x1 fastest.
#[derive(Clone, Copy, Debug)]
pub enum Samples<'a> {
    /// Written as `uint8`.
    Bytes(&'a [u8]),
    /// Written as little-endian `float`.
    Singles(&'a [f32]),
}

/// How the samples are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Encoding {
    /// As they are.
    Raw,
    /// Compressed; without a time stamp, so that the bytes depend on the samples alone.
    Gzip,
}

/// Samples on a grid of one to three axes.
#[derive(Clone, Copy, Debug)]
pub struct Field<'a> {
    /// What was sampled.
    pub name: &'a str,
    /// Samples along each axis.
    pub size: &'a [usize],
    /// World coordinates of the first sample, one for each axis.
    pub origin: &'a [f64],
    /// Distance of neighbours along each axis.
    pub spacing: &'a [f64],
    /// The samples.
    pub samples: Samples<'a>,
}

/// Writes the field.
///
/// # Errors
/// `InvalidInput` if the lengths do not fit each other; what the writer fails with.
pub fn write(field: &Field<'_>, encoding: Encoding, out: &mut impl Write) -> io::Result<()> {
    let axes = field.size.len();
    let count = match field.samples {
        Samples::Bytes(all) => all.len(),
        Samples::Singles(all) => all.len(),
    };
    let fits =
        field.size.iter().product::<usize>() == count && field.origin.len() == axes && field.spacing.len() == axes;
    if !fits || !(1..=3).contains(&axes) {
        return Err(io::Error::new(io::ErrorKind::InvalidInput, "the samples do not fit the grid"));
    }
    out.write_all(header(field, encoding).as_bytes())?;
    match encoding {
        Encoding::Raw => payload(field.samples, out),
        Encoding::Gzip => {
            let mut gzip = GzBuilder::new().mtime(0).write(&mut *out, Compression::default());
            payload(field.samples, &mut gzip)?;
            gzip.finish().map(drop)
        }
    }
}

/// The header, its empty line included. Numbers in the shortest digits that read back the same.
fn header(field: &Field<'_>, encoding: Encoding) -> String {
    let axes = field.size.len();
    // A line's end within the name would begin another line of the header.
    let name: String = field.name.chars().filter(|c| !c.is_control()).collect();
    let kind = match field.samples {
        Samples::Bytes(_) => "uint8",
        Samples::Singles(_) => "float",
    };
    let direction = |axis: usize| {
        let entries: Vec<_> = (0..axes).map(|k| if k == axis { field.spacing[axis] } else { 0.0 }).collect();
        format!("({})", joined(&entries, ","))
    };
    let directions: Vec<_> = (0..axes).map(direction).collect();
    let encoding = match encoding {
        Encoding::Raw => "raw",
        Encoding::Gzip => "gzip",
    };
    format!(
        "NRRD0004\ncontent: {name}\ntype: {kind}\ndimension: {axes}\nspace dimension: {axes}\nsizes: {}\nspace directions: {}\n\
         space origin: ({})\nspace units:{}\nkinds:{}\nendian: little\nencoding: {encoding}\n\n",
        joined(field.size, " "),
        directions.join(" "),
        joined(field.origin, ","),
        " \"mm\"".repeat(axes),
        " domain".repeat(axes),
    )
}

fn joined<T: ToString>(items: &[T], separator: &str) -> String {
    items.iter().map(T::to_string).collect::<Vec<_>>().join(separator)
}

fn payload(samples: Samples<'_>, out: &mut impl Write) -> io::Result<()> {
    match samples {
        Samples::Bytes(all) => out.write_all(all),
        Samples::Singles(all) => all.chunks(4096).try_for_each(|chunk| {
            let bytes: Vec<u8> = chunk.iter().flat_map(|v| v.to_le_bytes()).collect();
            out.write_all(&bytes)
        }),
    }
}
