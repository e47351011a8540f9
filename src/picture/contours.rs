//! Contour maps: lines of several levels with their values written into them, over a map in colour, within axes, as in \[P95\] Fig. 3.
//! Samples nothing: see [`Field`].

use super::axes::{Axis, GRID, INK, Look, PAPER, Plot, Surround, number, ticks};
use super::canvas::{Area, Canvas, Pen};
use super::image::Image;
use super::isolines::{Field, Isoline};
use super::legend::{Legend, Telling};
use super::palette::Palette;
use super::text::{self, Across, Lettering, Upright};

/// What a contour map shows.
#[derive(Clone, Debug, PartialEq)]
pub struct Map {
    /// Written above it.
    pub title: String,
    /// The two coordinates' names.
    pub names: [String; 2],
    /// What the values are called.
    pub value: String,
    /// The values that get a line, ascending.
    pub levels: Vec<f64>,
    /// The map below the lines; without it lines alone, dashed where the value is negative.
    pub palette: Option<Palette>,
    /// Whether the lines carry their values.
    pub labels: bool,
}

/// Levels at 1, 2 or 5 times a power of ten through the usual values of a field, 0 among them if it is a value.
#[must_use]
pub fn levels(field: &Field, most: usize) -> Vec<f64> {
    field.quiet_range().map_or_else(Vec::new, |[lo, hi]| if lo < hi { ticks(lo, hi, most).values } else { vec![] })
}

/// Draws the map, a unit as long upward as to the right. None if there is no memory for it.
#[must_use]
pub fn draw(field: &Field, map: &Map, width: usize, height: usize) -> Option<Image> {
    let mut canvas = Canvas::new(width, height, PAPER)?;
    let look = Look::of(width, height);
    let legend = map.palette.map(|palette| legend(field, map, palette));
    let side = legend.as_ref().map_or(0., |legend| legend.width(height as f32 * 0.8, look) + look.text);
    let room = Area { left: look.text * 0.4, top: 0., right: width as f32 - side, bottom: height as f32 };
    let surround = Surround { title: map.title.clone(), equal: true, bare: false };
    let (lo, hi) = (field.window.lo, field.window.hi);
    let x = Axis::new(map.names[0].clone(), lo[0], hi[0]);
    let y = Axis::new(map.names[1].clone(), lo[1], hi[1]);
    let plot = Plot::within(room, x, y, look, &surround);
    match &legend {
        Some(legend) => fill(&mut canvas, field, &plot, legend),
        None => plot.grid(&mut canvas),
    }
    canvas.clip(Some(plot.area));
    let mut taken = Vec::new();
    for &level in &map.levels {
        let stroke = stroke(map, legend.as_ref(), level, look);
        contour(&mut canvas, &field.lines(level), &plot, &stroke, &mut taken);
    }
    canvas.clip(None);
    plot.frame(&mut canvas, &surround);
    if let Some(legend) = &legend {
        legend.draw(&mut canvas, plot.area.right + look.text, plot.area.top, plot.area.bottom, look);
    }
    Some(canvas.image())
}

/// The colours of the bands. A diverging palette has its middle at 0, so that the two signs get its two halves.
fn legend(field: &Field, map: &Map, palette: Palette) -> Legend {
    let [mut lo, mut hi] = field.quiet_range().unwrap_or([0., 1.]);
    if let [first, .., last] = map.levels[..] {
        let step = (last - first) / (map.levels.len() - 1) as f64;
        (lo, hi) = (first - step, last + step);
    }
    let plain = Legend::new(map.value.clone(), lo, hi, palette);
    let (lo, hi) = (plain.axis.lo, plain.axis.hi);
    let both = palette == Palette::Diverging && lo < 0. && hi > 0.;
    let ends = if both { [lo.min(-hi), hi.max(-lo)] } else { [lo, hi] };
    Legend { ends, levels: map.levels.clone(), ..plain }
}

/// Colours the plot's pixels by the value at their middles; undefined ones stay hatched paper.
fn fill(canvas: &mut Canvas, field: &Field, plot: &Plot, legend: &Legend) {
    let area = plot.area;
    for row in area.top as usize..area.bottom as usize {
        for column in area.left as usize..area.right as usize {
            let value = field.value(plot.point(column, row));
            if !value.is_nan() {
                canvas.pixel(column, row, legend.colour(value));
            } else if (row + column) % 8 == 0 {
                canvas.pixel(column, row, [GRID[0], GRID[1], GRID[2]]);
            }
        }
    }
}

/// How the lines of one level are drawn, and what is written into them.
struct Stroke {
    pen: Pen,
    label: String,
    ink: [u8; 4],
}

/// The zero line is bold; negative levels are dashed where no colour tells the sign.
fn stroke(map: &Map, legend: Option<&Legend>, level: f64, look: Look) -> Stroke {
    let zero = level == 0.;
    // On dark colours ink could not be read.
    let dark = legend.is_some_and(|legend| lightness(legend.colour(level)) < 90.);
    let ink = if dark { PAPER } else { INK };
    let colour = if zero { INK } else { [ink[0], ink[1], ink[2], if legend.is_some() { 180 } else { 255 }] };
    let width = if zero { look.thick * 1.25 } else { look.thin * 1.1 };
    let dash = (level < 0. && legend.is_none()).then_some([look.text * 0.4, look.text * 0.25]);
    let label = if map.labels { number(level) } else { String::new() };
    Stroke { pen: Pen { colour, width, dash }, label, ink }
}

fn lightness([r, g, b]: [u8; 3]) -> f64 {
    0.3 * f64::from(r) + 0.6 * f64::from(g) + 0.1 * f64::from(b)
}

/// Where something is written already, and how long it is.
type Taken = Vec<([f32; 2], f32)>;

/// The lines of one level, with its value in each that has room for it.
fn contour(canvas: &mut Canvas, lines: &[Isoline], plot: &Plot, stroke: &Stroke, taken: &mut Taken) {
    let size = plot.look.text * 0.88;
    // Beside a dash a minus needs more room, or it would be one more of them.
    let margin = if stroke.pen.dash.is_some() { 2.4 } else { 1.4 };
    let room = text::width(&stroke.label, size) + size * margin;
    for line in lines {
        let track = Track::new(line, plot);
        let place = if stroke.label.is_empty() { None } else { track.place(room, taken) };
        let Some(place) = place else {
            canvas.line(&track.points, line.closed, &stroke.pen);
            continue;
        };
        for part in track.around(place, room) {
            canvas.line(&part, false, &stroke.pen);
        }
        let (middle, turn) = track.middle(place, room);
        taken.push((middle, room));
        let lettering = Lettering { size, colour: stroke.ink, across: Across::Middle, upright: Upright::Middle, turn };
        canvas.text(&stroke.label, middle, &lettering);
    }
}

/// Draws the lines of one level of several fields over one window, each in its own colour: a group of sections. None
/// if there is no field or no memory for the picture.
#[must_use]
pub fn group(fields: &[Field], telling: &Telling, level: f64, map: &Map, [width, height]: [usize; 2]) -> Option<Image> {
    let window = fields.first()?.window;
    let mut canvas = Canvas::new(width, height, PAPER)?;
    let look = Look::of(width, height);
    let surround = Surround { title: map.title.clone(), equal: true, bare: false };
    let right = width as f32 - telling.width(height as f32, look);
    let room = Area { left: look.text * 0.4, top: 0., right, bottom: height as f32 };
    let [x, y] = [0, 1].map(|d| Axis::new(map.names[d].clone(), window.lo[d], window.hi[d]));
    let plot = Plot::within(room, x, y, look, &surround);
    plot.grid(&mut canvas);
    canvas.clip(Some(plot.area));
    for (field, &colour) in fields.iter().zip(&telling.colours) {
        let stroke = Stroke { pen: Pen::solid(colour, look.thick), label: String::new(), ink: colour };
        contour(&mut canvas, &field.lines(level), &plot, &stroke, &mut Vec::new());
    }
    canvas.clip(None);
    plot.frame(&mut canvas, &surround);
    telling.draw(&mut canvas, plot.area, look);
    Some(canvas.image())
}

/// A line in pixels with the way run up to each of its points; a closed line ends where it began.
struct Track {
    points: Vec<[f32; 2]>,
    way: Vec<f32>,
}

impl Track {
    fn new(line: &Isoline, plot: &Plot) -> Self {
        let mut points: Vec<[f32; 2]> = line.points.iter().map(|p| plot.at(p[0], p[1])).collect();
        if line.closed {
            points.push(points[0]);
        }
        let mut way = vec![0.];
        for pair in points.windows(2) {
            way.push(way[way.len() - 1] + distance(pair[0], pair[1]));
        }
        Track { points, way }
    }

    fn length(&self) -> f32 {
        self.way[self.way.len() - 1]
    }

    /// The point after so many pixels of way.
    fn at(&self, way: f32) -> [f32; 2] {
        let k = self.way.partition_point(|&w| w < way).clamp(1, self.way.len() - 1);
        let (from, to) = (self.way[k - 1], self.way[k]);
        let part = if to > from { ((way - from) / (to - from)).clamp(0., 1.) } else { 0. };
        std::array::from_fn(|d| self.points[k - 1][d] + part * (self.points[k][d] - self.points[k - 1][d]))
    }

    /// The start of the straightest stretch of length `room`, away from the ends and from what is written already.
    fn place(&self, room: f32, taken: &Taken) -> Option<f32> {
        let length = self.length();
        if self.points.len() < 3 || length < room * 2.5 {
            return None;
        }
        let (first, last) = (0.25 * room, length - 1.25 * room);
        let tries = (0..64).map(|k| first + (last - first) * k as f32 / 63.);
        let free = tries.filter(|&from| {
            let middle = self.middle(from, room).0;
            taken.iter().all(|&(other, width)| distance(middle, other) > 0.75 * (width + room))
        });
        let straightness = |from: f32, to: f32| {
            let (from, to) = (from.max(0.), to.min(length));
            1. - distance(self.at(from), self.at(to)) / (to - from)
        };
        // What lies just before and behind counts too, and among equals the one nearest to the middle is best.
        let rank = |from: f32| {
            let off_middle = (2. * (from + 0.5 * room) / length - 1.).abs();
            straightness(from, from + room)
                + 0.5 * straightness(from - 0.6 * room, from + 1.6 * room)
                + 0.004 * off_middle
        };
        let best = free.min_by(|&a, &b| rank(a).total_cmp(&rank(b)))?;
        // Along a sharp turn a straight text would leave the line.
        (straightness(best, best + room) < 0.15).then_some(best)
    }

    /// Middle of the stretch and the text's turn in degrees, never upside down.
    fn middle(&self, from: f32, room: f32) -> ([f32; 2], f32) {
        let (a, b) = (self.at(from), self.at(from + room));
        let turn = (a[1] - b[1]).atan2(b[0] - a[0]).to_degrees();
        let turn = if turn > 90. {
            turn - 180.
        } else if turn <= -90. {
            turn + 180.
        } else {
            turn
        };
        ([0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])], turn)
    }

    /// The line without the stretch.
    fn around(&self, from: f32, room: f32) -> [Vec<[f32; 2]>; 2] {
        let to = from + room;
        let before = self.way.partition_point(|&w| w < from);
        let after = self.way.partition_point(|&w| w <= to);
        let mut first = self.points[..before].to_vec();
        first.push(self.at(from));
        let mut second = vec![self.at(to)];
        second.extend_from_slice(&self.points[after..]);
        [first, second]
    }
}

fn distance(a: [f32; 2], b: [f32; 2]) -> f32 {
    ((a[0] - b[0]).powi(2) + (a[1] - b[1]).powi(2)).sqrt()
}
