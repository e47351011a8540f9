//! PNG pictures of eight bits a channel. The same picture gives the same bytes. Never seeks.

use std::io::{self, Write};

use crate::picture::Image;

/// Writes the picture; without an alpha channel where every pixel is opaque.
///
/// # Errors
/// `InvalidInput` for a picture without pixels; what the writer fails with.
pub fn write(image: &Image, out: &mut impl Write) -> io::Result<()> {
    let (Ok(width), Ok(height)) = (u32::try_from(image.width), u32::try_from(image.height)) else {
        return Err(io::Error::new(io::ErrorKind::InvalidInput, "the picture is too large for PNG"));
    };
    let opaque = image.rgba.chunks_exact(4).all(|pixel| pixel[3] == 255);
    let mut encoder = png::Encoder::new(out, width, height);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_color(if opaque { png::ColorType::Rgb } else { png::ColorType::Rgba });
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    let mut writer = encoder.write_header().map_err(failed)?;
    if opaque {
        let rgb: Vec<u8> = image.rgba.chunks_exact(4).flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect();
        writer.write_image_data(&rgb).map_err(failed)?;
    } else {
        writer.write_image_data(&image.rgba).map_err(failed)?;
    }
    writer.finish().map_err(failed)
}

/// A failed write stays what it was (a full disk, a closed pipe).
fn failed(error: png::EncodingError) -> io::Error {
    match error {
        png::EncodingError::IoError(error) => error,
        other => io::Error::new(io::ErrorKind::InvalidInput, other.to_string()),
    }
}
