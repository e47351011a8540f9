//! Pictures that move as APNG, in true colour, looping for ever. The same frames give the same bytes. Never seeks.

use super::refuse;
use crate::picture::image::Image;
use std::io::{self, Write};

/// Writes all frames; `delay` is how long each stays, in seconds. One frame alone is a plain PNG.
///
/// # Errors
/// `InvalidInput` if there is no frame, their sizes differ or `delay` is not above 0; what the writer fails with.
pub fn write(frames: &[Image], delay: f64, out: &mut impl Write) -> io::Result<()> {
    let first = frames.first().ok_or_else(|| refuse("an animation needs a frame"))?;
    if frames.iter().any(|frame| (frame.width, frame.height) != (first.width, first.height)) {
        return Err(unequal());
    }
    let mut encoder = Encoder::new(&mut *out, first.width, first.height, frames.len(), delay)?;
    frames.iter().try_for_each(|frame| encoder.frame(frame))?;
    encoder.finish()?;
    out.flush()
}

/// Writes frame by frame, for animations that should not be held in memory. The number of frames must be known at the start.
pub struct Encoder<W: Write> {
    png: png::Writer<W>,
    size: [usize; 2],
    missing: usize,
}

impl<W: Write> Encoder<W> {
    /// Begins a file of `count` frames of `delay` seconds each.
    ///
    /// # Errors
    /// `InvalidInput` for a picture without pixels, too large a one, no frame, or a delay that is not above 0; what the writer fails
    /// with.
    pub fn new(out: W, width: usize, height: usize, count: usize, delay: f64) -> io::Result<Self> {
        let side = |n: usize| u32::try_from(n).ok().filter(|&n| n > 0 && n < 1 << 31);
        let (Some(across), Some(down), Some(frames)) = (side(width), side(height), side(count)) else {
            return Err(refuse("an APNG has 1 to 2147483647 frames, and as many pixels along each side"));
        };
        let mut encoder = png::Encoder::new(out, across, down);
        encoder.set_color(png::ColorType::Rgba);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_compression(png::Compression::Balanced);
        if frames > 1 {
            let (numerator, denominator) = fraction(delay)?;
            encoder.set_animated(frames, 0).map_err(failed)?;
            encoder.set_frame_delay(numerator, denominator).map_err(failed)?;
        }
        Ok(Self { png: encoder.write_header().map_err(failed)?, size: [width, height], missing: count })
    }

    /// Adds a frame.
    ///
    /// # Errors
    /// `InvalidInput` if its size is another one or there are enough frames already; what the writer fails with.
    pub fn frame(&mut self, image: &Image) -> io::Result<()> {
        if [image.width, image.height] != self.size {
            return Err(unequal());
        }
        self.missing = self.missing.checked_sub(1).ok_or_else(|| refuse("the animation has all its frames already"))?;
        self.png.write_image_data(&image.rgba).map_err(failed)
    }

    /// Ends the file.
    ///
    /// # Errors
    /// `InvalidInput` if a frame is missing; what the writer fails with.
    pub fn finish(self) -> io::Result<()> {
        if self.missing > 0 {
            return Err(refuse(format!("the animation lacks {} of its frames", self.missing)));
        }
        self.png.finish().map_err(failed)
    }
}

fn unequal() -> io::Error {
    refuse("the frames of an animation must have one size")
}

/// A failed write stays what it was (a full disk, a closed pipe).
fn failed(error: png::EncodingError) -> io::Error {
    match error {
        png::EncodingError::IoError(error) => error,
        other => refuse(other.to_string()),
    }
}

/// Seconds as a fraction of 16-bit numbers: a whole number of frames a second is exact, other times are rounded to thousandths, long
/// ones more coarsely.
fn fraction(seconds: f64) -> io::Result<(u16, u16)> {
    const MOST: f64 = 65535.;
    if !(seconds > 0. && seconds.is_finite()) {
        return Err(refuse("a frame of an animation needs a time above 0"));
    }
    let rate = (1. / seconds).round();
    if (1. ..=MOST).contains(&rate) && (rate * seconds - 1.).abs() < 1e-9 {
        return Ok((1, rate as u16));
    }
    let denominator = [1000., 100., 10.].into_iter().find(|d| seconds * d <= MOST).unwrap_or(1.);
    Ok(((seconds * denominator).round().clamp(1., MOST) as u16, denominator as u16))
}
