//! Lettering with an embedded font, so that a picture is the same on every machine. Asks no system for fonts.
//!
//! DejaVu Sans (Bitstream Vera licence) comes whole from its crate; letters are outlines, filled by the same rasteriser as lines.

use std::sync::OnceLock;
use tiny_skia::{Path, PathBuilder, Transform};
use ttf_parser::{Face, GlyphId, OutlineBuilder};

/// The height of a capital letter and of a digit, as a part of the letter size.
pub const CAPITAL: f32 = 0.729;

/// Where a text lies about its point, across: at its left end, its middle or its right end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Across {
    /// The text begins at the point.
    Left,
    /// The text is centred on the point.
    Middle,
    /// The text ends at the point.
    Right,
}

/// Where a text lies about its point, along the height.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Upright {
    /// The tops of capitals touch the point's height.
    Top,
    /// Capitals are centred on the point.
    Middle,
    /// Letters stand on the point's height.
    Base,
}

/// How a text is set.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lettering {
    /// Size of the em square in pixels.
    pub size: f32,
    /// sRGB and opacity.
    pub colour: [u8; 4],
    /// Which point across is given.
    pub across: Across,
    /// Which height is given.
    pub upright: Upright,
    /// Turned by so many degrees counter-clockwise about the point.
    pub turn: f32,
}

/// Width in pixels of a text of one line.
#[must_use]
pub fn width(text: &str, size: f32) -> f32 {
    let Some(face) = face() else { return 0. };
    let mut pen = Pen::new(face, size);
    text.chars().for_each(|c| pen.advance(c));
    pen.x
}

/// The outlines of a text of one line at a point, if there is anything to see of it.
#[must_use]
pub fn outline(text: &str, at: [f32; 2], lettering: &Lettering) -> Option<Path> {
    let face = face()?;
    let size = lettering.size;
    let mut pen = Pen::new(face, size);
    let left = match lettering.across {
        Across::Left => 0.,
        Across::Middle => -0.5 * width(text, size),
        Across::Right => -width(text, size),
    };
    let base = match lettering.upright {
        Upright::Top => CAPITAL * size,
        Upright::Middle => 0.5 * CAPITAL * size,
        Upright::Base => 0.,
    };
    for c in text.chars() {
        pen.draw(c);
    }
    let path = pen.path.finish()?;
    // Upright letters stand on whole pixels: their feet are then sharp.
    let snap = |v: f32| if lettering.turn == 0. { v.round() } else { v };
    let place = Transform::from_translate(at[0], if lettering.turn == 0. { 0. } else { at[1] })
        .pre_rotate(-lettering.turn)
        .pre_translate(left, if lettering.turn == 0. { snap(at[1] + base) } else { base });
    path.transform(place)
}

/// The font, read once. It is embedded, so that reading can only fail if the crate were broken; then there is no lettering.
fn face() -> Option<&'static Face<'static>> {
    static FACE: OnceLock<Option<Face<'static>>> = OnceLock::new();
    FACE.get_or_init(|| Face::parse(dejavu::sans::regular(), 0).ok()).as_ref()
}

/// Sets one letter after the other.
struct Pen<'a> {
    face: &'a Face<'static>,
    scale: f32,
    x: f32,
    last: Option<GlyphId>,
    path: PathBuilder,
}

impl<'a> Pen<'a> {
    fn new(face: &'a Face<'static>, size: f32) -> Self {
        let scale = size / f32::from(face.units_per_em());
        Pen { face, scale, x: 0., last: None, path: PathBuilder::new() }
    }

    /// The letter's number in the font; unknown letters show as the font's empty box.
    fn glyph(&mut self, c: char) -> GlyphId {
        let glyph = self.face.glyph_index(c).unwrap_or(GlyphId(0));
        if let Some(last) = self.last.replace(glyph) {
            self.x += self.kern(last, glyph) * self.scale;
        }
        glyph
    }

    fn kern(&self, left: GlyphId, right: GlyphId) -> f32 {
        let tables = self.face.tables().kern.iter().flat_map(|table| table.subtables);
        let mut plain = tables.filter(|table| table.horizontal && !table.variable && !table.has_cross_stream);
        plain.find_map(|table| table.glyphs_kerning(left, right)).map_or(0., f32::from)
    }

    fn advance(&mut self, c: char) {
        let glyph = self.glyph(c);
        self.x += f32::from(self.face.glyph_hor_advance(glyph).unwrap_or(0)) * self.scale;
    }

    fn draw(&mut self, c: char) {
        let glyph = self.glyph(c);
        let face = self.face;
        face.outline_glyph(glyph, self);
        self.x += f32::from(face.glyph_hor_advance(glyph).unwrap_or(0)) * self.scale;
    }

    fn place(&self, x: f32, y: f32) -> (f32, f32) {
        (self.x + x * self.scale, -y * self.scale)
    }
}

impl OutlineBuilder for Pen<'_> {
    fn move_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.place(x, y);
        self.path.move_to(x, y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.place(x, y);
        self.path.line_to(x, y);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let ((x1, y1), (x, y)) = (self.place(x1, y1), self.place(x, y));
        self.path.quad_to(x1, y1, x, y);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        let ((x1, y1), (x2, y2), (x, y)) = (self.place(x1, y1), self.place(x2, y2), self.place(x, y));
        self.path.cubic_to(x1, y1, x2, y2, x, y);
    }

    fn close(&mut self) {
        self.path.close();
    }
}
