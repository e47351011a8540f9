//! Axes: ticks at 1, 2 or 5 times a power of ten, numbers, names, grid lines, and the room that they need. Draws no function.

use super::canvas::{Area, Canvas, LARGEST, Pen};
use super::image::Image;
use super::text::{self, Across, Lettering, Upright};

/// Paper, ink and grid of all plots.
pub const PAPER: [u8; 4] = [255, 255, 255, 255];
/// Frames, ticks, letters.
pub const INK: [u8; 4] = [26, 26, 26, 255];
/// Lines behind the data.
pub const GRID: [u8; 4] = [225, 225, 225, 255];

/// One axis: its name and the range that it shows.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// The coordinate as the user writes it, or what the numbers count.
    pub name: String,
    /// The smallest number.
    pub lo: f64,
    /// The largest number.
    pub hi: f64,
}

impl Axis {
    /// An axis. A range without extent or that is not finite is widened to one that can be drawn.
    #[must_use]
    pub fn new(name: impl Into<String>, lo: f64, hi: f64) -> Self {
        let bound = |v: f64| if v.is_nan() { 0. } else { v.clamp(-1e300, 1e300) };
        let (lo, hi) = (bound(lo).min(bound(hi)), bound(lo).max(bound(hi)));
        let least = lo.abs().max(hi.abs()).max(1e-300) * 1e-9;
        let (lo, hi) = if hi - lo < least {
            let half = if lo == 0. && hi == 0. { 1. } else { 0.5 * lo.abs().max(hi.abs()) };
            (lo - half, hi + half)
        } else {
            (lo, hi)
        };
        Axis { name: name.into(), lo, hi }
    }

    /// Where a number lies: 0 at the smallest, 1 at the largest.
    #[must_use]
    pub fn part(&self, value: f64) -> f64 {
        (value - self.lo) / (self.hi - self.lo)
    }
}

/// The marks of an axis.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ticks {
    /// Where the marks lie, ascending.
    pub values: Vec<f64>,
    /// What is written at each.
    pub labels: Vec<String>,
    /// The power of ten by which all labels are to be multiplied; 0 where they stand for themselves.
    pub power: i32,
}

impl Ticks {
    /// `x10^n` in small raised figures, or nothing where the labels stand for themselves.
    #[must_use]
    pub fn factor(&self) -> String {
        if self.power == 0 {
            return String::new();
        }
        let raised = |c: char| match c {
            '-' => '⁻',
            c => ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'][c.to_digit(10).unwrap_or(0) as usize],
        };
        format!("×10{}", self.power.to_string().chars().map(raised).collect::<String>())
    }
}

/// The ticks of a range: the smallest step of 1, 2 or 5 times a power of ten that needs at most `most` marks, at least 2.
#[must_use]
pub fn ticks(lo: f64, hi: f64, most: usize) -> Ticks {
    let Axis { lo, hi, .. } = Axis::new("", lo, hi);
    let wanted = (hi - lo) / most.clamp(2, 100) as f64;
    let mut exponent = wanted.log10().floor() as i32;
    let mut leading = 1_i64;
    while scaled(leading, exponent) < wanted {
        (leading, exponent) = match leading {
            1 => (2, exponent),
            2 => (5, exponent),
            _ => (1, exponent + 1),
        };
    }
    let step = scaled(leading, exponent);
    // The slack keeps marks on the ends of the range, which rounding may have pushed just beyond.
    let (first, last) = ((lo / step - 1e-9).ceil() as i64, (hi / step + 1e-9).floor() as i64);
    let counts: Vec<i64> = (first..=last).take(2 * most.max(2)).map(|k| k.saturating_mul(leading)).collect();
    let largest = counts.iter().map(|&k| scaled(k, exponent).abs()).fold(0., f64::max);
    let power = if largest >= 1e5 || (largest > 0. && largest < 1e-3) { largest.log10().floor() as i32 } else { 0 };
    // A lone 0 has no digits behind the point.
    let decimals = if largest > 0. { (power - exponent).max(0) as usize } else { 0 };
    let label = |&k: &i64| signed(format!("{:.decimals$}", scaled(k, exponent - power)));
    Ticks {
        values: counts.iter().map(|&k| scaled(k, exponent)).collect(),
        labels: counts.iter().map(label).collect(),
        power,
    }
}

/// `k * 10^exponent`, correctly rounded: read as the decimal number that it is.
fn scaled(k: i64, exponent: i32) -> f64 {
    format!("{k}e{exponent}").parse().unwrap_or(f64::NAN)
}

/// With a true minus sign, and without one before a zero.
fn signed(text: String) -> String {
    match text.strip_prefix('-') {
        Some(digits) if digits.chars().all(|c| c == '0' || c == '.') => digits.to_owned(),
        Some(digits) => format!("−{digits}"),
        None => text,
    }
}

/// A number for a label: shortest digits up to six, a true minus sign.
#[must_use]
pub fn number(value: f64) -> String {
    if !value.is_finite() {
        return signed(value.to_string());
    }
    let short: f64 = format!("{value:.5e}").parse().unwrap_or(value);
    let size = short.abs();
    let plain = size == 0. || (1e-4..1e6).contains(&size);
    signed(if plain { short.to_string() } else { format!("{short:e}") })
}

/// Sizes that follow from the picture's: all text and lines grow with it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Look {
    /// Letter size in pixels.
    pub text: f32,
    /// Width of frames and ticks in pixels.
    pub thin: f32,
    /// Width of curves in pixels.
    pub thick: f32,
    /// The colour of letters and lines.
    pub ink: [u8; 4],
}

impl Look {
    /// The sizes for a picture of so many pixels.
    #[must_use]
    pub fn of(width: usize, height: usize) -> Self {
        let text = (width.min(height).min(LARGEST) as f32 / 36.).clamp(9., 64.);
        Look { text, thin: (text / 13.).round().max(1.), thick: text / 6.8, ink: INK }
    }

    /// The same sizes with an ink that stands out from a ground; on one that lets all through the usual one.
    #[must_use]
    pub fn on(self, [r, g, b, a]: [u8; 4]) -> Self {
        let bright = 2 * u32::from(r) + 5 * u32::from(g) + u32::from(b);
        if a > 0 && bright < 8 * 110 { Look { ink: PAPER, ..self } } else { self }
    }

    /// Lettering of this size in ink.
    #[must_use]
    pub fn lettering(&self, across: Across, upright: Upright) -> Lettering {
        Lettering { size: self.text, colour: self.ink, across, upright, turn: 0. }
    }
}

/// A field of the picture that shows two axes.
#[derive(Clone, Debug)]
pub struct Plot {
    /// The axis to the right.
    pub x: Axis,
    /// The axis upward.
    pub y: Axis,
    /// The pixels between the axes.
    pub area: Area,
    /// Sizes of letters and lines.
    pub look: Look,
    x_ticks: Ticks,
    y_ticks: Ticks,
}

/// What a plot shows beside its data.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Surround {
    /// Written above the middle.
    pub title: String,
    /// Whether one unit is as long upward as to the right.
    pub equal: bool,
    /// Whether the numbers and the name of the lower axis are left out, as in all but the lowest of stacked plots.
    pub bare: bool,
}

impl Plot {
    /// Finds the area between the axes within `room`, so that numbers, names and title have their places around it.
    #[must_use]
    pub fn within(room: Area, x: Axis, y: Axis, look: Look, surround: &Surround) -> Self {
        let text = look.text;
        let mut area = room;
        area.top += text * if surround.title.is_empty() { 0.6 } else { 2.0 };
        area.right -= text * 1.2;
        if !surround.bare {
            area.bottom -= look.below(&x);
        }
        let mut y_ticks = upward_ticks(&y, area.height(), look);
        if y_ticks.power != 0 {
            area.top = area.top.max(room.top + text * 1.8);
        }
        area.left += look.beside(&y, &y_ticks);
        if surround.equal {
            area = equal(area, &x, &y);
            y_ticks = upward_ticks(&y, area.height(), look);
        }
        let area = area.whole();
        let x_ticks = sideways_ticks(&x, area.width(), look);
        Plot { x, y, area, look, x_ticks, y_ticks }
    }

    /// The pixel of a point.
    #[must_use]
    pub fn at(&self, x: f64, y: f64) -> [f32; 2] {
        let across = f64::from(self.area.left) + self.x.part(x) * f64::from(self.area.width());
        let up = f64::from(self.area.bottom) - self.y.part(y) * f64::from(self.area.height());
        [across.clamp(-1e5, 1e5) as f32, up.clamp(-1e5, 1e5) as f32]
    }

    /// The point at a pixel's middle.
    #[must_use]
    pub fn point(&self, column: usize, row: usize) -> [f64; 2] {
        let across = (column as f64 + 0.5 - f64::from(self.area.left)) / f64::from(self.area.width());
        let up = (f64::from(self.area.bottom) - row as f64 - 0.5) / f64::from(self.area.height());
        [self.x.lo + across * (self.x.hi - self.x.lo), self.y.lo + up * (self.y.hi - self.y.lo)]
    }

    /// Grid lines, to be drawn before the data.
    pub fn grid(&self, canvas: &mut Canvas) {
        let pen = Pen::solid(GRID, self.look.thin);
        for &x in &self.x_ticks.values {
            let [column, _] = self.at(x, self.y.lo);
            canvas.ruled([column, self.area.top], [column, self.area.bottom], &pen);
        }
        for &y in &self.y_ticks.values {
            let [_, row] = self.at(self.x.lo, y);
            canvas.ruled([self.area.left, row], [self.area.right, row], &pen);
        }
    }

    /// Frame, ticks, numbers, names and title, to be drawn after the data.
    pub fn frame(&self, canvas: &mut Canvas, surround: &Surround) {
        let (area, look, text) = (self.area, self.look, self.look.text);
        let pen = Pen::solid(INK, look.thin);
        canvas.frame(area, &pen);
        let tick = text * 0.35;
        for (x, label) in self.x_ticks.values.iter().zip(&self.x_ticks.labels) {
            let [column, _] = self.at(*x, self.y.lo);
            canvas.ruled([column, area.bottom], [column, area.bottom + tick], &pen);
            if !surround.bare {
                let lettering = look.lettering(Across::Middle, Upright::Top);
                canvas.text(label, [column, area.bottom + tick + text * 0.3], &lettering);
            }
        }
        for (y, label) in self.y_ticks.values.iter().zip(&self.y_ticks.labels) {
            let [_, row] = self.at(self.x.lo, *y);
            canvas.ruled([area.left - tick, row], [area.left, row], &pen);
            canvas.text(label, [area.left - tick - text * 0.3, row], &look.lettering(Across::Right, Upright::Middle));
        }
        self.names(canvas, surround);
    }

    fn names(&self, canvas: &mut Canvas, surround: &Surround) {
        let (area, look, text) = (self.area, self.look, self.look.text);
        let middle = 0.5 * (area.left + area.right);
        let centred = look.lettering(Across::Middle, Upright::Base);
        if !surround.bare {
            let row = area.bottom + look.below(&self.x) - text * 0.45;
            canvas.text(&self.x.name, [middle, row], &centred);
            let right = look.lettering(Across::Right, Upright::Base);
            canvas.text(&self.x_ticks.factor(), [area.right, row], &right);
        }
        let side = Lettering { turn: 90., ..centred };
        let column = area.left - look.beside(&self.y, &self.y_ticks) + text * 1.35;
        canvas.text(&self.y.name, [column, 0.5 * (area.top + area.bottom)], &side);
        let left = look.lettering(Across::Left, Upright::Base);
        canvas.text(&self.y_ticks.factor(), [area.left, area.top - text * 0.5], &left);
        let title = Lettering { size: text * 1.15, ..centred };
        canvas.text(&surround.title, [middle, area.top - text * 0.65], &title);
    }
}

impl Look {
    /// Height below the area for ticks, numbers and name.
    fn below(&self, axis: &Axis) -> f32 {
        self.text * if axis.name.is_empty() { 1.9 } else { 3.2 }
    }

    /// Width at the left of the area for ticks, numbers and name.
    fn beside(&self, axis: &Axis, ticks: &Ticks) -> f32 {
        let widest = ticks.labels.iter().map(|label| text::width(label, self.text)).fold(0., f32::max);
        widest + self.text * if axis.name.is_empty() { 1.2 } else { 2.4 }
    }
}

/// As many ticks as fit above each other.
fn upward_ticks(axis: &Axis, height: f32, look: Look) -> Ticks {
    ticks(axis.lo, axis.hi, ((height / (look.text * 2.6)) as usize).clamp(2, 12))
}

/// As many ticks as have their numbers beside each other with room between.
fn sideways_ticks(axis: &Axis, width: f32, look: Look) -> Ticks {
    let fits = |ticks: &Ticks| {
        let widest = ticks.labels.iter().map(|label| text::width(label, look.text)).fold(0., f32::max);
        (widest + look.text * 1.4) * ticks.values.len().saturating_sub(1) as f32 <= width
    };
    (2..=12).rev().map(|most| ticks(axis.lo, axis.hi, most)).find(fits).unwrap_or_default()
}

/// The largest part of the area, in its middle, where a unit is as long in both directions.
fn equal(area: Area, x: &Axis, y: &Axis) -> Area {
    let (across, up) = ((x.hi - x.lo) as f32, (y.hi - y.lo) as f32);
    let unit = (area.width() / across).min(area.height() / up);
    let (width, height) = (unit * across, unit * up);
    if !(width >= 8. && height >= 8.) {
        return area; // So long and thin that nothing could be seen of it.
    }
    let left = area.left + 0.5 * (area.width() - width);
    let top = area.top + 0.5 * (area.height() - height);
    Area { left, top, right: left + width, bottom: top + height }
}

/// Puts axes around a picture that fills the ranges of both, pixel for pixel as it is.
#[must_use]
pub fn around(image: &Image, x: &Axis, y: &Axis, title: &str) -> Option<Image> {
    let look = Look::of(image.width, image.height);
    let surround = Surround { title: title.to_owned(), ..Surround::default() };
    let y_ticks = upward_ticks(y, image.height as f32, look);
    let left = look.beside(y, &y_ticks).ceil();
    let top = (look.text * if title.is_empty() && y_ticks.power == 0 { 1. } else { 2. }).ceil();
    let area = Area { left, top, right: left + image.width as f32, bottom: top + image.height as f32 };
    let size = [area.right + look.text * 1.6, area.bottom + look.below(x)].map(|v| v.ceil() as usize);
    let mut canvas = Canvas::new(size[0], size[1], PAPER)?;
    canvas.paste(image, left as usize, top as usize);
    let x_ticks = sideways_ticks(x, area.width(), look);
    Plot { x: x.clone(), y: y.clone(), area, look, x_ticks, y_ticks }.frame(&mut canvas, &surround);
    Some(canvas.image())
}
