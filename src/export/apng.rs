//! Pictures that move as APNG, in true colour. Writes front to back and never seeks.

use super::refuse;
use crate::picture::image::Image;
use std::io::{self, Write};

/// Writes frames of one size that follow each other at `fps` frames a second, for ever. One frame alone is a plain PNG.
///
/// # Errors
/// Those of the writer; `InvalidInput` when there is no frame, sizes differ, or `fps` is not above 0.
pub fn write(frames: &[Image], fps: f64, out: &mut impl Write) -> io::Result<()> {
    let Some(first) = frames.first() else {
        return Err(refuse("there is no frame to write"));
    };
    if frames.iter().any(|frame| (frame.width, frame.height) != (first.width, first.height)) {
        return Err(refuse("the frames differ in size"));
    }
    let size = |n: usize| u32::try_from(n).map_err(|_| refuse("the picture is too large for PNG"));
    let mut encoder = png::Encoder::new(&mut *out, size(first.width)?, size(first.height)?);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::Balanced);
    if frames.len() > 1 {
        let (numerator, denominator) = delay(fps)?;
        encoder.set_animated(size(frames.len())?, 0)?;
        encoder.set_frame_delay(numerator, denominator)?;
    }
    let mut writer = encoder.write_header()?;
    for frame in frames {
        writer.write_image_data(&frame.rgba)?;
    }
    writer.finish()?;
    out.flush()
}

/// The time of a frame as a fraction of seconds in 16-bit numbers.
fn delay(fps: f64) -> io::Result<(u16, u16)> {
    if !(fps > 0. && fps.is_finite()) {
        return Err(refuse("an animation needs more than 0 frames a second"));
    }
    let seconds = 1. / fps;
    // Thousandths are exact for the usual rates where the inverse is not; a slow rate needs a smaller denominator.
    let denominator = [1000., 100., 10., 1.].into_iter().find(|d| seconds * d <= 65535.).unwrap_or(1.);
    if fps.fract() == 0. && fps <= 65535. {
        return Ok((1, fps as u16));
    }
    Ok(((seconds * denominator).round().clamp(1., 65535.) as u16, denominator as u16))
}
