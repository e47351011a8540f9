//! Animated GIF: frames of one size that loop for ever. One palette for all frames, so that what does not move does not flicker.
//! The same frames give the same bytes. Never seeks.

use std::io::{self, Write};

use super::quantise::{Histogram, Palette};
use crate::picture::Image;

/// Writes all frames with one palette; `delay` is how long each stays, in seconds.
///
/// # Errors
/// `InvalidInput` if there is no frame or their sizes differ; what the writer fails with.
pub fn write(frames: &[Image], delay: f64, out: &mut impl Write) -> io::Result<()> {
    let first = frames.first().ok_or_else(|| invalid("an animation needs a frame"))?;
    let mut histogram = Histogram::default();
    frames.iter().for_each(|frame| histogram.add(frame));
    let mut encoder = Encoder::new(out, first.width, first.height, delay, Some(histogram.palette(256)))?;
    frames.iter().try_for_each(|frame| encoder.frame(frame))
}

/// Writes frame by frame, for animations that should not be held in memory.
pub struct Encoder<W: Write> {
    gif: gif::Encoder<W>,
    palette: Option<Palette>,
    size: (u16, u16),
    delay: u16,
}

impl<W: Write> Encoder<W> {
    /// Begins a file. Without a palette each frame gets its own.
    ///
    /// # Errors
    /// `InvalidInput` for a picture without pixels or with a side above 65,535; what the writer fails with.
    pub fn new(out: W, width: usize, height: usize, delay: f64, palette: Option<Palette>) -> io::Result<Self> {
        let side = |n: usize| u16::try_from(n).ok().filter(|&n| n > 0);
        let (Some(width), Some(height)) = (side(width), side(height)) else {
            return Err(invalid("a GIF has 1 to 65535 pixels along each side"));
        };
        let shared = palette.as_ref().map(|p| p.colours.concat()).unwrap_or_default();
        let mut gif = gif::Encoder::new(out, width, height, &shared).map_err(failed)?;
        gif.set_repeat(gif::Repeat::Infinite).map_err(failed)?;
        let delay = (delay * 100.0).round().clamp(1.0, f64::from(u16::MAX)) as u16;
        Ok(Self { gif, palette, size: (width, height), delay })
    }

    /// Adds a frame.
    ///
    /// # Errors
    /// `InvalidInput` if its size is another one; what the writer fails with.
    pub fn frame(&mut self, image: &Image) -> io::Result<()> {
        let (width, height) = self.size;
        if (image.width, image.height) != (usize::from(width), usize::from(height)) {
            return Err(invalid("the frames of an animation must have one size"));
        }
        let (buffer, palette) = match &self.palette {
            Some(shared) => (shared.indices(image), None),
            None => {
                let mut histogram = Histogram::default();
                histogram.add(image);
                let own = histogram.palette(256);
                (own.indices(image), Some(own.colours.concat()))
            }
        };
        let frame =
            gif::Frame { delay: self.delay, width, height, palette, buffer: buffer.into(), ..gif::Frame::default() };
        self.gif.write_frame(&frame).map_err(failed)
    }
}

fn invalid(what: &str) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidInput, what)
}

/// A failed write stays what it was (a full disk, a closed pipe).
fn failed(error: gif::EncodingError) -> io::Error {
    match error {
        gif::EncodingError::Io(error) => error,
        other => io::Error::new(io::ErrorKind::InvalidInput, other.to_string()),
    }
}
