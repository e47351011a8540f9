//! A sheet to draw lines, areas, letters and pictures on, antialiased. Knows nothing of what they mean.

use super::image::Image;
use super::text::{self, Lettering};
use tiny_skia::{
    Color, FillRule, LineCap, LineJoin, Mask, Paint, PathBuilder, Pixmap, PremultipliedColorU8, Rect, Stroke,
    StrokeDash, Transform,
};

/// Coordinates beyond this many pixels are drawn as if they lay here: far outside, but safe for the rasteriser.
const FAR: f32 = 30_000.;

/// The largest side of a sheet in pixels.
pub const LARGEST: usize = 16_384;

/// A rectangle of pixels, `bottom` being the larger number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Area {
    /// Smallest column.
    pub left: f32,
    /// Smallest row.
    pub top: f32,
    /// Largest column.
    pub right: f32,
    /// Largest row.
    pub bottom: f32,
}

impl Area {
    /// Columns from left to right.
    #[must_use]
    pub fn width(&self) -> f32 {
        self.right - self.left
    }

    /// Rows from top to bottom.
    #[must_use]
    pub fn height(&self) -> f32 {
        self.bottom - self.top
    }

    /// The corners, clockwise from the top left.
    #[must_use]
    pub fn corners(&self) -> [[f32; 2]; 4] {
        [[self.left, self.top], [self.right, self.top], [self.right, self.bottom], [self.left, self.bottom]]
    }

    /// The same, each edge on a whole pixel.
    #[must_use]
    pub fn whole(self) -> Self {
        Area { left: self.left.round(), top: self.top.round(), right: self.right.round(), bottom: self.bottom.round() }
    }
}

/// How a line is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pen {
    /// sRGB and opacity.
    pub colour: [u8; 4],
    /// Width in pixels.
    pub width: f32,
    /// Lengths of a dash and of the gap after it, in pixels.
    pub dash: Option<[f32; 2]>,
}

impl Pen {
    /// A solid line.
    #[must_use]
    pub fn solid(colour: [u8; 4], width: f32) -> Self {
        Pen { colour, width, dash: None }
    }
}

/// The sheet.
#[derive(Clone, Debug)]
pub struct Canvas {
    pixmap: Pixmap,
    clip: Option<Mask>,
}

impl Canvas {
    /// A sheet of one colour. Sides are kept between 1 and [`LARGEST`] pixels; none if there is no memory for it.
    #[must_use]
    pub fn new(width: usize, height: usize, ground: [u8; 4]) -> Option<Self> {
        let side = |n: usize| n.clamp(1, LARGEST) as u32;
        let mut pixmap = Pixmap::new(side(width), side(height))?;
        let [r, g, b, a] = ground;
        pixmap.fill(Color::from_rgba8(r, g, b, a));
        Some(Canvas { pixmap, clip: None })
    }

    /// Everything drawn from now on stays inside the area, or nowhere restricted.
    pub fn clip(&mut self, area: Option<Area>) {
        self.clip = area.and_then(|area| {
            let mut mask = Mask::new(self.pixmap.width(), self.pixmap.height())?;
            let rect = Rect::from_ltrb(area.left, area.top, area.right, area.bottom)?;
            mask.fill_path(&PathBuilder::from_rect(rect), FillRule::Winding, true, Transform::identity());
            Some(mask)
        });
    }

    /// Fills the inside of a closed line.
    pub fn fill(&mut self, points: &[[f32; 2]], colour: [u8; 4]) {
        if let Some(path) = polyline(points, true) {
            self.pixmap.fill_path(&path, &paint(colour), FillRule::EvenOdd, Transform::identity(), self.clip.as_ref());
        }
    }

    /// Draws a line through the points, and back to the first if `closed`.
    pub fn line(&mut self, points: &[[f32; 2]], closed: bool, pen: &Pen) {
        let Some(path) = polyline(points, closed) else { return };
        let cap = if pen.dash.is_some() { LineCap::Butt } else { LineCap::Round };
        let dash = pen.dash.and_then(|[on, off]| StrokeDash::new(vec![on, off], 0.));
        let stroke = Stroke { width: pen.width, line_cap: cap, line_join: LineJoin::Round, dash, ..Stroke::default() };
        self.pixmap.stroke_path(&path, &paint(pen.colour), &stroke, Transform::identity(), self.clip.as_ref());
    }

    /// A straight line along a row or a column, set on the pixel grid so that it is sharp.
    pub fn ruled(&mut self, from: [f32; 2], to: [f32; 2], pen: &Pen) {
        let half = if (pen.width.round() as i32) % 2 == 1 { 0.5 } else { 0. };
        let snap = |p: [f32; 2]| p.map(|v| (v - half).round() + half);
        let Some(path) = polyline(&[snap(from), snap(to)], false) else { return };
        let dash = pen.dash.and_then(|[on, off]| StrokeDash::new(vec![on, off], 0.));
        let stroke = Stroke { width: pen.width.round().max(1.), line_cap: LineCap::Butt, dash, ..Stroke::default() };
        self.pixmap.stroke_path(&path, &paint(pen.colour), &stroke, Transform::identity(), self.clip.as_ref());
    }

    /// The edge of an area, sharp on the pixel grid.
    pub fn frame(&mut self, area: Area, pen: &Pen) {
        let half = if (pen.width.round() as i32) % 2 == 1 { 0.5 } else { 0. };
        let corners = area.corners().map(|p| p.map(|v| (v - half).round() + half));
        let Some(path) = polyline(&corners, true) else { return };
        let stroke = Stroke { width: pen.width.round().max(1.), ..Stroke::default() };
        self.pixmap.stroke_path(&path, &paint(pen.colour), &stroke, Transform::identity(), self.clip.as_ref());
    }

    /// A filled circle.
    pub fn dot(&mut self, at: [f32; 2], radius: f32, colour: [u8; 4]) {
        if let Some(path) = PathBuilder::from_circle(at[0], at[1], radius) {
            self.pixmap.fill_path(&path, &paint(colour), FillRule::Winding, Transform::identity(), self.clip.as_ref());
        }
    }

    /// A text of one line.
    pub fn text(&mut self, text: &str, at: [f32; 2], lettering: &Lettering) {
        if let Some(path) = text::outline(text, at, lettering) {
            let paint = paint(lettering.colour);
            self.pixmap.fill_path(&path, &paint, FillRule::Winding, Transform::identity(), self.clip.as_ref());
        }
    }

    /// Replaces one opaque pixel; nothing happens outside the sheet.
    pub fn pixel(&mut self, column: usize, row: usize, [r, g, b]: [u8; 3]) {
        let (width, height) = (self.pixmap.width() as usize, self.pixmap.height() as usize);
        if column < width && row < height {
            let colour = Color::from_rgba8(r, g, b, 255).premultiply().to_color_u8();
            self.pixmap.pixels_mut()[row * width + column] = colour;
        }
    }

    /// Lays a picture on the sheet with its top left corner at a pixel; transparent pixels let the ground through.
    pub fn paste(&mut self, image: &Image, column: usize, row: usize) {
        let (width, height) = (self.pixmap.width() as usize, self.pixmap.height() as usize);
        let across = image.width.min(width.saturating_sub(column));
        for j in 0..image.height.min(height.saturating_sub(row)) {
            let from = &image.rgba[4 * j * image.width..][..4 * across];
            let to = &mut self.pixmap.pixels_mut()[(row + j) * width + column..][..across];
            for (to, from) in to.iter_mut().zip(from.as_chunks::<4>().0) {
                *to = over(*from, *to);
            }
        }
    }

    /// The finished picture.
    #[must_use]
    pub fn image(self) -> Image {
        let (width, height) = (self.pixmap.width() as usize, self.pixmap.height() as usize);
        Image { width, height, rgba: self.pixmap.take_demultiplied() }
    }
}

/// One pixel with its own opacity above another.
fn over([r, g, b, a]: [u8; 4], below: PremultipliedColorU8) -> PremultipliedColorU8 {
    let (a, rest) = (u32::from(a), 255 - u32::from(a));
    let mix = |top: u8, under: u8| ((u32::from(top) * a + u32::from(under) * rest + 127) / 255) as u8;
    let alpha = mix(255, below.alpha());
    let [r, g, b] = [(r, below.red()), (g, below.green()), (b, below.blue())].map(|(t, u)| mix(t, u).min(alpha));
    PremultipliedColorU8::from_rgba(r, g, b, alpha).unwrap_or(below)
}

fn paint([r, g, b, a]: [u8; 4]) -> Paint<'static> {
    let mut paint = Paint { anti_alias: true, ..Paint::default() };
    paint.set_color_rgba8(r, g, b, a);
    paint
}

fn polyline(points: &[[f32; 2]], closed: bool) -> Option<tiny_skia::Path> {
    let mut path = PathBuilder::with_capacity(points.len() + 1, points.len());
    for (i, &[x, y]) in points.iter().enumerate() {
        let (x, y) = (x.clamp(-FAR, FAR), y.clamp(-FAR, FAR));
        if i == 0 { path.move_to(x, y) } else { path.line_to(x, y) }
    }
    if closed {
        path.close();
    }
    path.finish()
}
