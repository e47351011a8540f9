//! A picture as a smooth function: its brightness over the unit square, as a sheet of cubic B-splines with a coefficient for each pixel. So
//! the value stays between the brightness of the pixels around, and edges are a pixel or two wide.

use std::fmt;
use std::io::Cursor;
use std::sync::Arc;

use super::Sheet;
use crate::data::Context;

/// Why a file is no picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum HeightError {
    /// Not a PNG file.
    NotPng,
    /// A PNG file that is broken, and what the reader says.
    Broken(String),
    /// It would take more than the limit, in bytes.
    TooLarge {
        /// What it would take.
        bytes: usize,
        /// The limit.
        limit: usize,
    },
    /// Stopped by the user.
    Cancelled,
}

impl HeightError {
    /// What to do.
    #[must_use]
    pub fn help(&self) -> &'static str {
        match self {
            Self::NotPng => "save the picture as PNG",
            Self::Broken(_) => "the file is damaged or cut short: fetch it again, or save it anew",
            Self::TooLarge { .. } => "make the picture smaller first",
            Self::Cancelled => "",
        }
    }
}

impl fmt::Display for HeightError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotPng => f.write_str("this is not a PNG picture"),
            Self::Broken(what) => write!(f, "the picture cannot be read: {what}"),
            Self::TooLarge { bytes, limit } => write!(f, "the picture would take {bytes} bytes; the limit is {limit}"),
            Self::Cancelled => f.write_str("stopped"),
        }
    }
}

/// The brightness of the PNG picture in `bytes`, 0 to 1, over the unit square: the first argument from left to right, the second from the
/// bottom up. Colours count by how bright they look, transparent pixels as dark.
///
/// # Errors
/// See [`HeightError`].
pub fn sheet(name: &str, bytes: &[u8], context: Context<'_>) -> Result<Arc<Sheet>, HeightError> {
    if !bytes.starts_with(b"\x89PNG") {
        return Err(HeightError::NotPng);
    }
    let broken = |error: png::DecodingError| HeightError::Broken(error.to_string());
    let limit = context.limits.memory_bytes;
    let mut decoder = png::Decoder::new_with_limits(Cursor::new(bytes), png::Limits { bytes: limit });
    decoder.set_transformations(png::Transformations::EXPAND);
    let mut reader = decoder.read_info().map_err(broken)?;
    let (width, height) = (reader.info().width as usize, reader.info().height as usize);
    // Numbers for each pixel: what is read, its brightness, two differences, and bounds of these.
    let bytes = width.saturating_mul(height).saturating_mul(8 + 5 * 8);
    if bytes > limit {
        return Err(HeightError::TooLarge { bytes, limit });
    }
    let size = reader.output_buffer_size().ok_or(HeightError::TooLarge { bytes: usize::MAX, limit })?;
    let mut pixels = vec![0; size];
    let frame = reader.next_frame(&mut pixels).map_err(broken)?;
    let bright = brightness(&pixels[..frame.buffer_size()], frame.color_type, frame.bit_depth);
    if bright.len() != width * height {
        return Err(HeightError::Broken("it has fewer pixels than it says".into()));
    }
    // Two more coefficients on each side repeat those at the border.
    let mut coefficients = Vec::with_capacity((width + 4) * (height + 4));
    for j in 0..height + 4 {
        context.interrupt.tick().map_err(|_| HeightError::Cancelled)?;
        let row = height - 1 - j.saturating_sub(2).min(height - 1);
        coefficients.extend((0..width + 4).map(|i| bright[width * row + i.saturating_sub(2).min(width - 1)]));
    }
    let elements = [width + 1, height + 1];
    let inverse = [width as f64, height as f64];
    // The middle of the first pixel, half a pixel from the border, is where its own spline is highest: one element behind the first.
    let origin = inverse.map(|n| -0.5 / n);
    let domain = [width, height].map(|n| [0.5, n as f64 + 0.5]);
    Ok(Sheet::new(name, 3, elements, origin, inverse, domain, coefficients))
}

/// The brightness of each pixel, top row first.
fn brightness(pixels: &[u8], colour: png::ColorType, depth: png::BitDepth) -> Vec<f64> {
    let samples: Vec<f64> = match depth {
        png::BitDepth::Sixteen => {
            pixels.as_chunks::<2>().0.iter().map(|b| f64::from(u16::from_be_bytes(*b)) / 65_535.0).collect()
        }
        _ => pixels.iter().map(|b| f64::from(*b) / 255.0).collect(),
    };
    let luma = |c: &[f64]| (0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]).min(1.0);
    match colour {
        png::ColorType::GrayscaleAlpha => samples.as_chunks::<2>().0.iter().map(|c| c[0] * c[1]).collect(),
        png::ColorType::Rgb => samples.as_chunks::<3>().0.iter().map(|c| luma(c)).collect(),
        png::ColorType::Rgba => samples.as_chunks::<4>().0.iter().map(|c| luma(c) * c[3]).collect(),
        _ => samples,
    }
}
