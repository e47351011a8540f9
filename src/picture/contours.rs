//! Contour maps: lines of several levels with their values written into them, over a map in colour, within axes, as in [P95] Fig. 3.
//! Samples nothing: see [`Field`].

use super::axes::{Axis, GRID, INK, Look, PAPER, Plot, Surround, number, ticks};
use super::canvas::{Area, Canvas, Pen};
use super::image::Image;
use super::isolines::{Field, Isoline};
use super::legend::Legend;
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
    lines(&mut canvas, field, map, &plot);
    canvas.clip(None);
    plot.frame(&mut canvas, &surround);
    if let Some(legend) = &legend {
        legend.draw(&mut canvas, plot.area.right + look.text, plot.area.top, plot.area.bottom, look);
    }
    Some(canvas.image())
}

/// The colours of the bands. Where 0 is a level the two signs get the palette's two halves, as a diverging palette wants it.
fn legend(field: &Field, map: &Map, palette: Palette) -> Legend {
    let [mut lo, mut hi] = field.quiet_range().unwrap_or([0., 1.]);
    if let (Some(&first), Some(&last)) = (map.levels.first(), map.levels.last()) {
        let step = if map.levels.len() > 1 { (last - first) / (map.levels.len() - 1) as f64 } else { 0. };
        (lo, hi) = (first - step, last + step);
    }
    if palette == Palette::Diverging && lo < 0. && hi > 0. {
        (lo, hi) = (lo.min(-hi), hi.max(-lo));
    }
    Legend { axis: Axis::new(map.value.clone(), lo, hi), palette, levels: map.levels.clone() }
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

/// All lines, the zero line bold, then values where they find room.
fn lines(canvas: &mut Canvas, field: &Field, map: &Map, plot: &Plot) {
    let look = plot.look;
    let mut taken: Vec<([f32; 2], f32)> = Vec::new();
    for &level in &map.levels {
        let zero = level == 0.;
        let colour = if map.palette.is_some() && !zero { [26, 26, 26, 190] } else { INK };
        let width = if zero { look.thick * 1.25 } else { look.thin * 1.1 };
        let dash = (level < 0. && map.palette.is_none()).then_some([look.text * 0.4, look.text * 0.25]);
        let pen = Pen { colour, width, dash };
        let label = number(level);
        let size = look.text * 0.82;
        let room = text::width(&label, size) + size * 0.7;
        for line in field.lines(level) {
            let pixels = Track::new(&line, plot);
            let place = if map.labels { pixels.place(room, &taken) } else { None };
            let Some(place) = place else {
                canvas.line(&pixels.points, line.closed, &pen);
                continue;
            };
            for part in pixels.around(place, room) {
                canvas.line(&part, false, &pen);
            }
            let (middle, turn) = pixels.middle(place, room);
            taken.push((middle, room));
            let lettering = Lettering { size, colour: INK, across: Across::Middle, upright: Upright::Middle, turn };
            canvas.text(&label, middle, &lettering);
        }
    }
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
    fn place(&self, room: f32, taken: &[([f32; 2], f32)]) -> Option<f32> {
        let length = self.length();
        if self.points.len() < 3 || length < room * 2.5 {
            return None;
        }
        let end = length - 1.25 * room;
        let tries = (0..64).map(|k| room * 0.25 + (end - room * 0.25) * k as f32 / 63.);
        let free = tries.filter(|&from| {
            let middle = self.middle(from, room).0;
            taken.iter().all(|&(other, width)| distance(middle, other) > 0.75 * (width + room))
        });
        let bend = |from: f32| {
            let chord = distance(self.at(from), self.at(from + room));
            let off_middle = (2. * (from + 0.5 * room) / length - 1.).abs();
            (1. - chord / room) + 0.004 * off_middle
        };
        let best = free.min_by(|&a, &b| bend(a).total_cmp(&bend(b)))?;
        // Along a sharp turn a straight text would leave the line.
        (bend(best) < 0.15).then_some(best)
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
