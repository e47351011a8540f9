//! Legends: a bar that tells which colour stands for which value. Computes no values.

use super::axes::{Axis, Look, PAPER, Ticks, number, ticks};
use super::canvas::{Area, Canvas, Pen};
use super::image::Image;
use super::palette::Palette;
use super::text::{self, Across, Upright};

/// What the colours of a picture mean.
#[derive(Clone, Debug, PartialEq)]
pub struct Legend {
    /// The coordinate or function whose values are shown, with the range that the bar shows.
    pub axis: Axis,
    /// The values at the palette's two ends.
    pub ends: [f64; 2],
    /// The colours.
    pub palette: Palette,
    /// Values between which the colour is one and the same; if empty it flows.
    pub levels: Vec<f64>,
}

impl Legend {
    /// A legend of colours that flow.
    #[must_use]
    pub fn new(name: impl Into<String>, lo: f64, hi: f64, palette: Palette) -> Self {
        let axis = Axis::new(name, lo, hi);
        Legend { ends: [axis.lo, axis.hi], axis, palette, levels: Vec::new() }
    }

    /// The colour of a value: between levels that of the band's middle.
    #[must_use]
    pub fn colour(&self, value: f64) -> [u8; 3] {
        let [lo, hi] = self.ends;
        if self.levels.is_empty() || value.is_nan() {
            return self.palette.colour((value - lo) / (hi - lo));
        }
        let above = self.levels.partition_point(|&level| level <= value);
        let from = above.checked_sub(1).map_or(self.axis.lo.min(self.levels[0]), |k| self.levels[k]);
        let to = self.levels.get(above).copied().unwrap_or(self.axis.hi.max(from));
        self.palette.colour((from + 0.5 * (to - from) - lo) / (hi - lo))
    }

    /// The columns that a bar in a picture of this look takes, with its numbers and name.
    #[must_use]
    pub fn width(&self, height: f32, look: Look) -> f32 {
        let ticks = self.ticks(height, look);
        let widest = ticks.labels.iter().map(|label| text::width(label, look.text)).fold(0., f32::max);
        look.text * (1.4 + 0.8 + if self.axis.name.is_empty() { 0.6 } else { 1.9 }) + widest
    }

    /// Draws the bar with its left edge at `left`, as high as the plot beside it, numbers and name at its right.
    pub fn draw(&self, canvas: &mut Canvas, left: f32, top: f32, bottom: f32, look: Look) {
        let size = look.text;
        let bar = Area { left, top, right: left + size * 1.4, bottom }.whole();
        for row in bar.top as usize..bar.bottom as usize {
            let part = f64::from(bar.bottom - row as f32 - 0.5) / f64::from(bar.height());
            let colour = self.colour(self.axis.lo + (self.axis.hi - self.axis.lo) * part);
            for column in bar.left as usize..bar.right as usize {
                canvas.pixel(column, row, colour);
            }
        }
        let pen = Pen::solid(look.ink, look.thin);
        canvas.frame(bar, &pen);
        let ticks = self.ticks(bar.height(), look);
        let mut widest = 0_f32;
        for (&value, label) in ticks.values.iter().zip(&ticks.labels) {
            let row = bar.bottom - self.axis.part(value) as f32 * bar.height();
            canvas.ruled([bar.right, row], [bar.right + size * 0.3, row], &pen);
            let beside = look.lettering(Across::Left, Upright::Middle);
            canvas.text(label, [bar.right + size * 0.55, row], &beside);
            widest = widest.max(text::width(label, size));
        }
        let above = look.lettering(Across::Left, Upright::Base);
        canvas.text(&ticks.factor(), [bar.left, bar.top - size * 0.5], &above);
        let name = text::Lettering { turn: 90., ..look.lettering(Across::Middle, Upright::Base) };
        let column = bar.right + size * 0.8 + widest + size * 1.2;
        canvas.text(&self.axis.name, [column, 0.5 * (bar.top + bar.bottom)], &name);
    }

    /// Numbers beside the bar: the levels if there is room for all, else round values.
    fn ticks(&self, height: f32, look: Look) -> Ticks {
        let most = ((height / (look.text * 1.7)) as usize).clamp(2, 25);
        let labels: Vec<String> = self.levels.iter().map(|&level| number(level)).collect();
        if self.levels.is_empty() || labels.len() > most || labels.iter().any(|label| label.contains('e')) {
            return ticks(self.axis.lo, self.axis.hi, most.min(11));
        }
        let kept = self.apart(height, look.text * 1.15);
        let values = kept.iter().map(|&k| self.levels[k]).collect();
        let labels = kept.iter().map(|&k| labels[k].clone()).collect();
        Ticks { values, labels: same_digits(labels), power: 0 }
    }

    /// The levels whose numbers have room, so many pixels each, ascending: 0 first, then the ends, then from the bottom up.
    fn apart(&self, height: f32, room: f32) -> Vec<usize> {
        let count = self.levels.len();
        let row = |k: usize| self.axis.part(self.levels[k]) as f32 * height;
        let first = (0..count).filter(|&k| self.levels[k] == 0.).chain(count.checked_sub(1)).chain(0..count);
        let mut kept: Vec<usize> = Vec::new();
        for k in first {
            if kept.iter().all(|&other| (row(k) - row(other)).abs() >= room) {
                kept.push(k);
            }
        }
        kept.sort_unstable();
        kept
    }
}

/// Numbers as they stand below each other: all with as many digits after the point.
fn same_digits(labels: Vec<String>) -> Vec<String> {
    let digits = |label: &str| label.split_once('.').map_or(0, |(_, after)| after.len());
    let most = labels.iter().map(|label| digits(label)).max().unwrap_or(0);
    let pad = |label: String| {
        let point = if most > 0 && !label.contains('.') { "." } else { "" };
        let zeros = "0".repeat(most - digits(&label));
        label + point + &zeros
    };
    labels.into_iter().map(pad).collect()
}

/// Which colour belongs to which member of a group.
#[derive(Clone, Debug, PartialEq)]
pub struct Key {
    /// Name and colour of each.
    pub entries: Vec<(String, [u8; 4])>,
}

impl Key {
    /// The columns that the list takes.
    #[must_use]
    pub fn width(&self, look: Look) -> f32 {
        let widest = self.entries.iter().map(|(name, _)| text::width(name, look.text)).fold(0., f32::max);
        widest + look.text * 3.2
    }

    /// Draws the list from its top left corner down, a stretch of line before each name.
    pub fn draw(&self, canvas: &mut Canvas, [left, top]: [f32; 2], look: Look) {
        for (k, (name, colour)) in self.entries.iter().enumerate() {
            let row = top + look.text * (0.5 + 1.5 * k as f32);
            let line = [[left, row], [left + look.text * 1.6, row]];
            canvas.line(&line, false, &Pen::solid(*colour, look.thick));
            canvas.text(name, [left + look.text * 2.1, row], &look.lettering(Across::Left, Upright::Middle));
        }
    }
}

/// What tells the members of a group from each other.
#[derive(Clone, Debug, PartialEq)]
pub struct Telling {
    /// The members' colours.
    pub colours: Vec<[u8; 4]>,
    /// What explains them.
    pub means: Means,
}

/// What explains the colours of a group.
#[derive(Clone, Debug, PartialEq)]
pub enum Means {
    /// A list of names.
    Key(Key),
    /// A bar of values.
    Legend(Legend),
}

impl Telling {
    /// Each member has its own colour beside its name.
    #[must_use]
    pub fn names(names: impl IntoIterator<Item = String>) -> Self {
        Self::coloured(names, member_colour)
    }

    /// The same in the colours of solids.
    #[must_use]
    pub fn solids(names: impl IntoIterator<Item = String>) -> Self {
        Self::coloured(names, |k| {
            let [r, g, b] = solid_colour(k);
            [r, g, b, 255]
        })
    }

    fn coloured(names: impl IntoIterator<Item = String>, colour: impl Fn(usize) -> [u8; 4]) -> Self {
        let entries: Vec<_> = names.into_iter().enumerate().map(|(k, name)| (name, colour(k))).collect();
        Telling { colours: entries.iter().map(|entry| entry.1).collect(), means: Means::Key(Key { entries }) }
    }

    /// Each member has the colour of its value.
    #[must_use]
    pub fn values(values: impl IntoIterator<Item = f64>, legend: Legend) -> Self {
        let colour = |value| {
            let [r, g, b] = legend.colour(value);
            [r, g, b, 255]
        };
        Telling { colours: values.into_iter().map(colour).collect(), means: Means::Legend(legend) }
    }

    /// The columns that it takes at the right of a picture of that height.
    #[must_use]
    pub fn width(&self, height: f32, look: Look) -> f32 {
        match &self.means {
            Means::Key(key) => key.width(look),
            Means::Legend(legend) => legend.width(height * 0.8, look) + look.text,
        }
    }

    /// Draws it at the right of an area.
    pub fn draw(&self, canvas: &mut Canvas, area: Area, look: Look) {
        match &self.means {
            Means::Key(key) => key.draw(canvas, [area.right + look.text, area.top], look),
            Means::Legend(legend) => legend.draw(canvas, area.right + look.text, area.top, area.bottom, look),
        }
    }
}

/// The colours of a group's members in turn, told apart also by those who do not tell red from green.
#[must_use]
pub fn member_colour(k: usize) -> [u8; 4] {
    const COLOURS: [[u8; 3]; 8] = [
        [31, 119, 180],
        [230, 126, 20],
        [20, 145, 110],
        [200, 60, 60],
        [130, 95, 180],
        [120, 85, 60],
        [214, 100, 170],
        [105, 108, 120],
    ];
    let [r, g, b] = COLOURS[k % COLOURS.len()];
    [r, g, b, 255]
}

/// The colours of several solids in turn: lighter than those of lines, so that light and shade show on them.
#[must_use]
pub fn solid_colour(k: usize) -> [u8; 3] {
    const COLOURS: [[u8; 3]; 8] = [
        [104, 151, 205],
        [236, 168, 82],
        [104, 178, 134],
        [219, 118, 108],
        [160, 140, 206],
        [184, 150, 116],
        [224, 152, 192],
        [150, 156, 166],
    ];
    COLOURS[k % COLOURS.len()]
}

/// Puts what explains a picture's colours at its right; the picture stays as it is. `ground` is what it stands on, white
/// unless told. None if there is no memory for it.
#[must_use]
pub fn beside(image: &Image, telling: &Telling, ground: Option<[u8; 4]>) -> Option<Image> {
    let look = Look::of(image.width, image.height).on(ground.unwrap_or(PAPER));
    let height = image.height as f32;
    let (top, bottom) = ((height * 0.1).max(look.text), (height * 0.9).min(height - look.text));
    let gap = look.text;
    let own = match &telling.means {
        Means::Key(key) => key.width(look),
        Means::Legend(legend) => legend.width(bottom - top, look),
    };
    let mut canvas =
        Canvas::new((image.width as f32 + gap * 1.5 + own).ceil() as usize, image.height, ground.unwrap_or(PAPER))?;
    canvas.paste(image, 0, 0);
    let left = image.width as f32 + gap;
    match &telling.means {
        Means::Key(key) => key.draw(&mut canvas, [left, top], look),
        Means::Legend(legend) => legend.draw(&mut canvas, left, top, bottom, look),
    }
    Some(canvas.image())
}
