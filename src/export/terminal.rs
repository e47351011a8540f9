//! Pictures for terminals: half blocks in true or 256 colours, and the inline pictures of kitty, iTerm2 and sixel terminals. Asks no
//! terminal what it can; that is for who chooses. Never seeks.

use std::io::{self, Write};

use super::png;
use super::quantise::Histogram;
use crate::picture::Image;

/// Bytes of base64 that one command of the kitty protocol may carry.
const CHUNK: usize = 4096;
/// Colours of a sixel picture.
const COLOURS: usize = 256;

/// How a picture is drawn on a terminal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Drawing {
    /// Two pixels a character, in any colour.
    TrueHalves,
    /// Two pixels a character, in the 256 colours of xterm.
    Halves,
    /// The graphics protocol of kitty.
    Kitty,
    /// The inline images of iTerm2.
    Iterm,
    /// Sixel graphics.
    Sixel,
}

/// Draws a picture where the cursor stands, and ends the line.
///
/// # Errors
/// Those of `out`.
pub fn write(image: &Image, drawing: Drawing, out: &mut dyn Write) -> io::Result<()> {
    match drawing {
        Drawing::TrueHalves => halves(image, &true_colour, out),
        Drawing::Halves => halves(image, &indexed, out),
        Drawing::Kitty => kitty(image, out),
        Drawing::Iterm => iterm(image, out),
        Drawing::Sixel => sixel(image, out),
    }
}

/// Upper half blocks: the foreground is the upper pixel, the background the lower one.
fn halves(image: &Image, colour: &dyn Fn(Pixel) -> String, out: &mut dyn Write) -> io::Result<()> {
    for j in (0..image.height).step_by(2) {
        let (mut above, mut below) = (None, None);
        for i in 0..image.width {
            let top = opaque(image, i, j);
            let bottom = (j + 1 < image.height).then(|| opaque(image, i, j + 1));
            if above != Some(top) {
                write!(out, "\x1b[38;{}m", colour(top))?;
                above = Some(top);
            }
            if below != bottom
                && let Some(bottom) = bottom
            {
                write!(out, "\x1b[48;{}m", colour(bottom))?;
                below = Some(bottom);
            }
            write!(out, "\u{2580}")?;
        }
        writeln!(out, "\x1b[0m")?;
    }
    Ok(())
}

type Pixel = [u8; 3];

/// A pixel over white.
fn opaque(image: &Image, i: usize, j: usize) -> Pixel {
    let [r, g, b, a] = image.pixel(i, j);
    let over = |c: u8| ((u32::from(c) * u32::from(a) + 255 * (255 - u32::from(a)) + 127) / 255) as u8;
    [r, g, b].map(over)
}

fn true_colour([r, g, b]: Pixel) -> String {
    format!("2;{r};{g};{b}")
}

fn indexed(colour: Pixel) -> String {
    format!("5;{}", nearest(colour))
}

/// The nearest of xterm's 256 colours that every terminal shows alike: the cube of 6 x 6 x 6, and 24 greys.
fn nearest(colour: Pixel) -> u8 {
    const STEPS: [u8; 6] = [0, 95, 135, 175, 215, 255];
    let distance = |other: Pixel| -> u32 { (0..3).map(|k| u32::from(colour[k].abs_diff(other[k])).pow(2)).sum() };
    let step = |c: u8| (0..6u8).min_by_key(|&s| STEPS[usize::from(s)].abs_diff(c)).unwrap_or(0);
    let [r, g, b] = colour.map(step);
    let cube = distance([r, g, b].map(|s| STEPS[usize::from(s)]));
    let mean = colour.iter().map(|&c| u32::from(c)).sum::<u32>() / 3;
    let grey = (mean.saturating_sub(3) / 10).min(23) as u8;
    if distance([8 + 10 * grey; 3]) < cube { 232 + grey } else { 16 + 36 * r + 6 * g + b }
}

fn kitty(image: &Image, out: &mut dyn Write) -> io::Result<()> {
    let text = base64(&encoded(image)?);
    let mut chunks = text.as_bytes().chunks(CHUNK).peekable();
    let mut keys = "a=T,f=100,q=2,";
    while let Some(chunk) = chunks.next() {
        write!(out, "\x1b_G{keys}m={};", u8::from(chunks.peek().is_some()))?;
        out.write_all(chunk)?;
        write!(out, "\x1b\\")?;
        keys = "";
    }
    writeln!(out)
}

fn iterm(image: &Image, out: &mut dyn Write) -> io::Result<()> {
    let bytes = encoded(image)?;
    let (width, height) = (image.width, image.height);
    let keys = format!("inline=1;size={};width={width}px;height={height}px", bytes.len());
    writeln!(out, "\x1b]1337;File={keys}:{}\x07", base64(&bytes))
}

fn encoded(image: &Image) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    png::write(image, &mut bytes)?;
    Ok(bytes)
}

fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for three in bytes.chunks(3) {
        let whole = three.iter().fold(0, |whole, &byte| whole << 8 | usize::from(byte)) << (8 * (3 - three.len()));
        let letter = |k: usize| char::from(LETTERS[whole >> (18 - 6 * k) & 63]);
        (0..4).for_each(|k| text.push(if k <= three.len() { letter(k) } else { '=' }));
    }
    text
}

/// Bands of six rows; in each, a line of runs for every colour that occurs in it.
fn sixel(image: &Image, out: &mut dyn Write) -> io::Result<()> {
    let mut histogram = Histogram::default();
    histogram.add(image);
    let palette = histogram.palette(COLOURS);
    let indices = palette.indices(image);
    let (width, height) = (image.width, image.height);
    write!(out, "\x1bP0;1;0q\"1;1;{width};{height}")?;
    for (n, colour) in palette.colours.iter().enumerate() {
        let [r, g, b] = colour.map(|c| (u32::from(c) * 100 + 127) / 255);
        write!(out, "#{n};2;{r};{g};{b}")?;
    }
    for top in (0..height).step_by(6) {
        let rows = 6.min(height - top);
        let band = &indices[top * width..(top + rows) * width];
        let mut present = [false; COLOURS];
        band.iter().for_each(|&n| present[usize::from(n)] = true);
        for n in (0..=u8::MAX).filter(|&n| present[usize::from(n)]) {
            write!(out, "#{n}")?;
            let column = |i: usize| (0..rows).fold(0, |bits, k| bits | u8::from(band[k * width + i] == n) << k);
            runs((0..width).map(column), out)?;
            write!(out, "$")?;
        }
        write!(out, "-")?;
    }
    writeln!(out, "\x1b\\")
}

/// Sixels, equal ones counted.
fn runs(mut sixels: impl Iterator<Item = u8>, out: &mut dyn Write) -> io::Result<()> {
    let mut open = sixels.next().map(|bits| (bits, 1));
    while let Some((bits, count)) = open {
        match sixels.next() {
            Some(next) if next == bits => open = Some((bits, count + 1)),
            next => {
                let letter = char::from(b'?' + bits);
                if count > 3 {
                    write!(out, "!{count}{letter}")?;
                } else {
                    (0..count).try_for_each(|_| write!(out, "{letter}"))?;
                }
                open = next.map(|bits| (bits, 1));
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_is_that_of_the_rfc() {
        let cases = [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v"), ("foob", "Zm9vYg=="), ("fooba", "Zm9vYmE=")];
        for (plain, expected) in cases {
            assert_eq!(base64(plain.as_bytes()), expected);
        }
    }

    #[test]
    fn the_nearest_colours_are_the_exact_ones_where_there_are_such() {
        let cases = [([0, 0, 0], 16), ([255, 255, 255], 231), ([255, 0, 0], 196), ([95, 135, 175], 67), ([128, 128, 128], 244)];
        for (colour, expected) in cases {
            assert_eq!(nearest(colour), expected, "{colour:?}");
        }
    }

    #[test]
    fn equal_sixels_are_counted() {
        let mut out = Vec::new();
        runs([0, 0, 63, 1, 1, 1, 1].into_iter(), &mut out).expect("room");
        assert_eq!(out, b"??~!4@");
    }
}
