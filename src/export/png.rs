//! PNG pictures. The same picture gives the same bytes. Never seeks.

use std::io::{self, Write};

use crate::picture::Image;

/// Writes the picture: a bit a pixel where all are black or white, else without an alpha channel where every pixel is opaque.
///
/// # Errors
/// `InvalidInput` for a picture without pixels; what the writer fails with.
pub fn write(image: &Image, out: &mut impl Write) -> io::Result<()> {
    let (Ok(width), Ok(height)) = (u32::try_from(image.width), u32::try_from(image.height)) else {
        return Err(io::Error::new(io::ErrorKind::InvalidInput, "the picture is too large for PNG"));
    };
    let pixels = image.rgba.as_chunks::<4>().0;
    let mut bytes = Vec::new();
    let (colour, depth, data) = if pixels.iter().all(|pixel| matches!(pixel, BLACK | WHITE)) {
        bytes.reserve(pixels.len() / 8 + image.height);
        for row in pixels.chunks(image.width.max(1)) {
            bytes.extend(row.chunks(8).map(eight));
        }
        (png::ColorType::Grayscale, png::BitDepth::One, &bytes)
    } else if pixels.iter().all(|pixel| pixel[3] == 255) {
        bytes.reserve(3 * pixels.len());
        pixels.iter().for_each(|[r, g, b, _]| bytes.extend([*r, *g, *b]));
        (png::ColorType::Rgb, png::BitDepth::Eight, &bytes)
    } else {
        (png::ColorType::Rgba, png::BitDepth::Eight, &image.rgba)
    };
    let mut encoder = png::Encoder::new(out, width, height);
    encoder.set_depth(depth);
    encoder.set_color(colour);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    let mut writer = encoder.write_header().map_err(failed)?;
    writer.write_image_data(data).map_err(failed)?;
    writer.finish().map_err(failed)
}

const BLACK: &[u8; 4] = &[0, 0, 0, 255];
const WHITE: &[u8; 4] = &[255; 4];

/// Up to eight black or white pixels as the bits of a byte, the first the highest.
fn eight(pixels: &[[u8; 4]]) -> u8 {
    pixels.iter().enumerate().fold(0, |byte, (at, pixel)| byte | (pixel[0] & 1) << (7 - at))
}

/// A failed write stays what it was (a full disk, a closed pipe).
fn failed(error: png::EncodingError) -> io::Error {
    match error {
        png::EncodingError::IoError(error) => error,
        other => io::Error::new(io::ErrorKind::InvalidInput, other.to_string()),
    }
}
