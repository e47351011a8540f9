//! A 2-D object as a filled picture: pixel (i, j) from the top left is the point `lo[0] + (i+1/2) (hi[0]-lo[0]) / W`,
//! `hi[1] - (j+1/2) (hi[1]-lo[1]) / H`. Draws no axes and writes no files.

use std::sync::Arc;

use rayon::prelude::*;

use super::image::Image;
use super::paint::Paint;
use super::palette::{Palette, bright, encode, linear};
use super::scale::Scale;
use crate::interrupt::{Cancelled, Interrupt};
use crate::number::Interval;
use crate::reuse::Digest;
use crate::surface::boxes::{Block, Lattice, Visitor, walk};
use crate::surface::memory::Left;
use crate::surface::sampler::{Counters, Sampler};
use crate::vm::{Program, Shape};

/// The part of the plane that is shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Window {
    /// The coordinates of the lower left corner.
    pub lo: [f64; 2],
    /// The coordinates of the upper right corner.
    pub hi: [f64; 2],
}

/// What is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fill {
    /// Black where the pixel's middle is inside, white elsewhere: exact, without smoothing.
    Mono,
    /// The inside in colour with a line along the boundary, smoothed.
    Solid(Palette),
    /// Bands of values, those outside paler, with a line along the boundary. Needs the values themselves.
    Bands(Palette),
}

impl Fill {
    /// What a palette stands for in a plot.
    #[must_use]
    pub fn of(palette: Palette) -> Self {
        match palette {
            Palette::Mono => Self::Mono,
            Palette::Plain => Self::Solid(palette),
            other => Self::Bands(other),
        }
    }

    /// Whether a program of [`crate::vm::Demand::Value`] is needed; else one of `Sign` does and is faster.
    #[must_use]
    pub fn needs_values(self) -> bool {
        matches!(self, Self::Bands(_))
    }
}

/// A plot and what it cost.
#[derive(Clone, Debug)]
pub struct Plot {
    /// The picture.
    pub image: Image,
    /// Evaluations, and points where the function was undefined.
    pub counters: Counters,
    /// Whether a sample is inside the object.
    pub met: bool,
}

impl Plot {
    fn bytes(&self) -> usize {
        self.image.rgba.len()
    }
}

/// The picture of a shape with two axes.
///
/// # Errors
/// [`Cancelled`] soon after the interrupt was set.
///
/// # Panics
/// If the shape has another number of axes.
pub fn plot(
    shape: &Shape,
    window: Window,
    size: [usize; 2],
    fill: Fill,
    interrupt: &Interrupt,
) -> Result<Plot, Cancelled> {
    assert_eq!(shape.dimension, 2, "a plot shows a space of two axes");
    let tell = |to: &mut Digest| {
        to.shown(&("plot", window, size, fill));
        shape.tell(to);
    };
    interrupt.whole("pictures", tell, Plot::bytes, || plotted(shape, window, size, fill, interrupt))
}

fn plotted(
    shape: &Shape,
    window: Window,
    size: [usize; 2],
    fill: Fill,
    interrupt: &Interrupt,
) -> Result<Plot, Cancelled> {
    if size.contains(&0) {
        return Ok(Plot { image: Image::new(size[0], size[1], [0; 3]), counters: Counters::default(), met: false });
    }
    match fill {
        Fill::Mono => {
            let pixels = Pixels { window, size };
            let places = pixels.places();
            let tasks = tasks(shape, &pixels, &places, interrupt)?;
            let mut image = Image { width: size[0], height: size[1], rgba: vec![0; 4 * size[0] * size[1]] };
            tasks.lay(&mut image.rgba, 4, |row, out| row.put([255; 4], [0, 0, 0, 255], out));
            Ok(Plot { image, met: tasks.met(), counters: tasks.counters })
        }
        Fill::Solid(palette) => {
            let fine = fineness(size);
            let pixels = Pixels { window, size: size.map(|n| n * fine) };
            let (signs, counters) = signs(shape, &pixels, interrupt)?;
            let paper = Paper { signs: &signs, size: pixels.size, fine };
            let (inside, outside) = (palette.colour(0.5).map(linear), PAPER.map(linear));
            let met = signs.iter().any(|&s| s);
            Ok(finish(size, counters, met, |i, j| paper.pixel(i, j, |inner| if inner { inside } else { outside })))
        }
        Fill::Bands(palette) => bands(shape, window, size, palette, interrupt),
    }
}

/// Plane figures of their own colours over each other, each smoothed and with a line along its boundary; of several, those below show a
/// little. `ground` is what is outside, with its opacity.
///
/// # Errors
/// [`Cancelled`] soon after the interrupt was set.
///
/// # Panics
/// If a shape has another number of axes than two.
pub fn figures(
    figures: &[(Shape, Paint)],
    window: Window,
    size: [usize; 2],
    ground: [u8; 4],
    interrupt: &Interrupt,
) -> Result<Plot, Cancelled> {
    assert!(figures.iter().all(|(shape, _)| shape.dimension == 2), "a plot shows a space of two axes");
    let tell = |to: &mut Digest| {
        to.shown(&("figures", window, size, ground));
        figures.iter().for_each(|(shape, paint)| {
            shape.tell(to);
            paint.tell(to);
        });
    };
    interrupt.whole("pictures", tell, Plot::bytes, || coloured(figures, window, size, ground, interrupt))
}

fn coloured(
    figures: &[(Shape, Paint)],
    window: Window,
    size: [usize; 2],
    ground: [u8; 4],
    interrupt: &Interrupt,
) -> Result<Plot, Cancelled> {
    let (mut counters, mut all) = (Counters::default(), Vec::new());
    let fine = fineness(size);
    let pixels = Pixels { window, size: size.map(|n| n * fine) };
    for (shape, _) in figures {
        let (signs, cost) = signs(shape, &pixels, interrupt)?;
        counters.add(cost);
        all.push(signs);
    }
    let met = all.iter().flatten().any(|&sign| sign);
    let papers: Vec<Paper<'_>> = all.iter().map(|signs| Paper { signs, size: pixels.size, fine }).collect();
    let middles = Pixels { window, size };
    let columns: Vec<f64> = (0..size[0]).map(|i| middles.column(i)).collect();
    let mut image = Image::new(size[0], size[1], [0; 3]);
    image.rgba.par_chunks_mut(4 * size[0].max(1)).enumerate().for_each(|(j, row)| {
        let rows = vec![middles.row(j); size[0]];
        let light = |(_, paint): &(Shape, Paint)| -> Vec<[f32; 3]> {
            paint.at(&[&columns, &rows]).into_iter().map(|colour| colour.map(bright)).collect()
        };
        let lights: Vec<Vec<[f32; 3]>> = figures.iter().map(light).collect();
        for (i, pixel) in row.chunks_exact_mut(4).enumerate() {
            pixel.copy_from_slice(&over(&papers, &lights, [i, j], ground));
        }
    });
    Ok(Plot { image, counters, met })
}

/// A pixel of figures over each other.
fn over(papers: &[Paper<'_>], lights: &[Vec<[f32; 3]>], [i, j]: [usize; 2], ground: [u8; 4]) -> [u8; 4] {
    let line = LINE.map(linear);
    let cover = if papers.len() > 1 { COVER } else { 1.0 };
    let [r, g, b, a] = ground;
    let (below, opacity) = ([r, g, b].map(linear), f32::from(a) / 255.0);
    let (mut sum, mut all, mut count) = ([0.0_f32; 3], 0.0_f32, 0.0_f32);
    let fine = papers.first().map_or(1, |paper| paper.fine);
    for y in j * fine..(j + 1) * fine {
        for x in i * fine..(i + 1) * fine {
            let (mut light, mut covered, mut bare) = (below.map(|v| v * opacity), opacity, true);
            for (paper, lights) in papers.iter().zip(lights) {
                let (colour, part) = match (paper.on_line(x, y), paper.signs[y * paper.size[0] + x]) {
                    (true, _) => (line, 1.0),
                    (false, true) => (lights[i], if bare { 1.0 } else { cover }),
                    (false, false) => continue,
                };
                bare = false;
                (0..3).for_each(|k| light[k] = part * colour[k] + (1.0 - part) * light[k]);
                covered = part + (1.0 - part) * covered;
            }
            (0..3).for_each(|k| sum[k] += light[k]);
            all += covered;
            count += 1.0;
        }
    }
    let [r, g, b] = sum.map(|v| encode(v / all.max(f32::MIN_POSITIVE)));
    [r, g, b, (255.0 * all / count).round() as u8]
}

/// How much a figure hides of those below it.
const COVER: f32 = 0.8;

/// The colour of what is outside.
pub const PAPER: [u8; 3] = [0xf7, 0xf8, 0xfa];
/// The colour of the line along the boundary.
const LINE: [u8; 3] = [0x1c, 0x2c, 0x44];

/// Samples along each side of a pixel; one for pictures so large that nobody sees it and the samples would fill the memory.
fn fineness(size: [usize; 2]) -> usize {
    if size[0].saturating_mul(size[1]) <= 1 << 24 { 3 } else { 1 }
}

fn finish(size: [usize; 2], counters: Counters, met: bool, colour: impl Fn(usize, usize) -> [u8; 3] + Sync) -> Plot {
    let mut image = Image::new(size[0], size[1], [0; 3]);
    image.rgba.par_chunks_mut(4 * size[0].max(1)).enumerate().for_each(|(j, row)| {
        for (i, pixel) in row.chunks_exact_mut(4).enumerate() {
            pixel[..3].copy_from_slice(&colour(i, j));
        }
    });
    Plot { image, counters, met }
}

/// Middles of pixels as sample points.
struct Pixels {
    window: Window,
    size: [usize; 2],
}

impl Pixels {
    fn column(&self, i: usize) -> f64 {
        let Window { lo, hi } = self.window;
        lo[0] + (i as f64 + 0.5) * (hi[0] - lo[0]) / self.size[0] as f64
    }

    fn row(&self, j: usize) -> f64 {
        let Window { lo, hi } = self.window;
        hi[1] - (j as f64 + 0.5) * (hi[1] - lo[1]) / self.size[1] as f64
    }
}

impl Pixels {
    fn places(&self) -> Places {
        Places {
            columns: (0..self.size[0]).map(|i| self.column(i)).collect(),
            rows: (0..self.size[1]).map(|j| self.row(j)).collect(),
        }
    }
}

impl Lattice for Pixels {
    fn counts(&self) -> [usize; 3] {
        [self.size[0], self.size[1], 1]
    }

    fn leaf(&self) -> [usize; 3] {
        [LEAF, LEAF, 1]
    }

    fn task(&self) -> [usize; 3] {
        let side = if self.size.iter().any(|&n| n > LARGE) { 4 * BAND } else { BAND };
        [side, side, 1]
    }

    fn tell(&self, to: &mut Digest) -> bool {
        to.shown(&("pixels", self.window, self.size));
        true
    }

    fn bounds(&self, block: &Block, out: &mut [Interval]) {
        // Each step of the formulas is monotone in the index, rounding included, so the ends bound what lies between.
        out[0] = Interval::new(self.column(block.from[0]), self.column(block.to[0] - 1));
        out[1] = Interval::new(self.row(block.to[1] - 1), self.row(block.from[1]));
    }
}

/// Samples along each side of a smallest box: the bits of a [`Word`].
const LEAF: usize = 16;

/// Samples along each side of a task; in large pictures 4 times as many.
const BAND: usize = 64;

/// Pictures longer than that are large.
const LARGE: usize = 2048;

/// The coordinates of the sample points, by column and by row.
struct Places {
    columns: Vec<f64>,
    rows: Vec<f64>,
}

/// The signs of neighbouring samples of a row, the first one lowest: 1 where it is inside.
type Word = u16;

/// The signs of one task's samples, row by row.
struct Signs<'a> {
    places: &'a Places,
    block: Block,
    /// What all samples are, as long as `inside` is empty.
    all: bool,
    inside: Arc<Vec<Word>>,
    columns: [Vec<f64>; 2],
    values: Vec<f64>,
}

/// Signs of neighbouring samples.
enum Row<'a> {
    Same(bool),
    Each(&'a [Word]),
}

impl Row<'_> {
    /// Puts what stands for inside and what stands for outside, `N` items each, for each sample.
    fn put<T: Copy + Default, const N: usize>(&self, outside: [T; N], inside: [T; N], out: &mut [T]) {
        let same = |out: &mut [T], one: [T; N]| out.as_chunks_mut::<N>().0.fill(one);
        match *self {
            Self::Same(all) => same(out, if all { inside } else { outside }),
            Self::Each(words) => {
                for (word, out) in words.iter().zip(out.chunks_mut(LEAF * N)) {
                    match *word {
                        0 => same(out, outside),
                        Word::MAX => same(out, inside),
                        word => {
                            let samples = out.as_chunks_mut::<N>().0.iter_mut().enumerate();
                            samples.for_each(|(k, one)| *one = if word >> k & 1 == 1 { inside } else { outside });
                        }
                    }
                }
            }
        }
    }
}

impl Signs<'_> {
    fn width(&self) -> usize {
        self.block.to[0] - self.block.from[0]
    }

    /// Words of a row.
    fn words(&self) -> usize {
        self.width().div_ceil(LEAF)
    }

    fn row(&self, j: usize) -> Row<'_> {
        let (words, from) = (self.words(), (j - self.block.from[1]) * self.words());
        match self.inside.get(from..from + words) {
            Some(row) => Row::Each(row),
            None => Row::Same(self.all),
        }
    }

    /// The words of a box in a row.
    fn part(&mut self, block: &Block, j: usize) -> &mut [Word] {
        let words = self.words();
        if self.inside.is_empty() {
            let all = if self.all { Word::MAX } else { 0 };
            self.inside = Arc::new(vec![all; words * (self.block.to[1] - self.block.from[1])]);
        }
        let start = (j - self.block.from[1]) * words + (block.from[0] - self.block.from[0]) / LEAF;
        &mut Arc::make_mut(&mut self.inside)[start..start + (block.to[0] - block.from[0]).div_ceil(LEAF)]
    }
}

impl Visitor for Signs<'_> {
    fn uniform(&mut self, block: &Block, inside: bool) {
        if *block == self.block {
            self.all = inside;
        } else if inside {
            (block.from[1]..block.to[1]).for_each(|j| self.part(block, j).fill(Word::MAX));
        }
    }

    fn leaf(&mut self, block: &Block, program: &Program, sampler: &mut Sampler) {
        let [mut xs, mut ys] = std::mem::take(&mut self.columns);
        let count = block.points() as usize;
        for coordinates in [&mut xs, &mut ys] {
            coordinates.clear();
            coordinates.reserve(count);
        }
        let columns = &self.places.columns[block.from[0]..block.to[0]];
        for &y in &self.places.rows[block.from[1]..block.to[1]] {
            xs.extend_from_slice(columns);
            ys.resize(xs.len(), y);
        }
        let mut values = std::mem::take(&mut self.values);
        values.resize(xs.len(), 0.0);
        sampler.values(program, &[&xs, &ys], &mut values);
        for (j, values) in (block.from[1]..block.to[1]).zip(values.chunks_exact(columns.len())) {
            let bits = values.iter().enumerate().map(|(k, &v)| Word::from(v >= 0.0) << k);
            self.part(block, j)[0] = bits.fold(0, |word, bit| word | bit);
        }
        self.values = values;
        self.columns = [xs, ys];
    }

    fn keep(&mut self) -> Option<Left> {
        let bytes = self.inside.capacity() * size_of::<Word>();
        Some(Left { what: Arc::new((self.all, self.inside.clone())), bytes })
    }

    fn recall(&mut self, left: &Left) -> bool {
        let Some((all, inside)) = left.what.downcast_ref::<(bool, Arc<Vec<Word>>)>() else { return false };
        (self.all, self.inside) = (*all, inside.clone());
        true
    }
}

/// The signs of all samples, task by task.
struct Tasks<'a> {
    all: Vec<Signs<'a>>,
    width: usize,
    counters: Counters,
}

impl Tasks<'_> {
    /// Whether a sample is inside.
    fn met(&self) -> bool {
        self.all
            .iter()
            .any(|task| if task.inside.is_empty() { task.all } else { task.inside.iter().any(|&word| word != 0) })
    }

    /// Lays each row of each task where it belongs in a picture of `per` items a sample.
    fn lay<T: Send>(&self, out: &mut [T], per: usize, put: impl Fn(Row<'_>, &mut [T]) + Sync) {
        let mut bands: Vec<Vec<&Signs<'_>>> = Vec::new();
        bands.resize_with(out.len().div_ceil(BAND * self.width * per), Vec::new);
        for task in &self.all {
            let meets = task.block.from[1] / BAND..task.block.to[1].div_ceil(BAND);
            bands[meets].iter_mut().for_each(|band| band.push(task));
        }
        out.par_chunks_mut(BAND * self.width * per).zip(bands).enumerate().for_each(|(band, (rows, tasks))| {
            let first = band * BAND;
            let last = first + rows.len() / (self.width * per);
            for task in tasks {
                for j in task.block.from[1].max(first)..task.block.to[1].min(last) {
                    let at = ((j - first) * self.width + task.block.from[0]) * per;
                    put(task.row(j), &mut rows[at..at + task.width() * per]);
                }
            }
        });
    }
}

/// Which pixels' middles are inside, row by row from the top: what [`Fill::Mono`] paints black.
///
/// # Errors
/// [`Cancelled`] soon after the interrupt was set.
///
/// # Panics
/// If the shape has another number of axes than two, or a side is 0.
pub fn inside(
    shape: &Shape,
    window: Window,
    size: [usize; 2],
    interrupt: &Interrupt,
) -> Result<(Vec<bool>, Counters), Cancelled> {
    assert_eq!(shape.dimension, 2, "a plot shows a space of two axes");
    assert!(!size.contains(&0), "a picture has pixels");
    signs(shape, &Pixels { window, size }, interrupt)
}

/// Which samples are inside, row by row.
fn signs(shape: &Shape, pixels: &Pixels, interrupt: &Interrupt) -> Result<(Vec<bool>, Counters), Cancelled> {
    let places = pixels.places();
    let tasks = tasks(shape, pixels, &places, interrupt)?;
    let mut all = vec![false; pixels.size[0] * pixels.size[1]];
    tasks.lay(&mut all, 1, |row, out| row.put([false], [true], out));
    Ok((all, tasks.counters))
}

fn tasks<'a>(
    shape: &Shape,
    pixels: &Pixels,
    places: &'a Places,
    interrupt: &Interrupt,
) -> Result<Tasks<'a>, Cancelled> {
    let visitor = |block: &Block| Signs {
        places,
        block: *block,
        all: false,
        inside: Arc::default(),
        columns: [Vec::new(), Vec::new()],
        values: Vec::new(),
    };
    let done = walk(pixels, shape, visitor, interrupt)?;
    Ok(Tasks { all: done.visitors, width: pixels.size[0], counters: done.counters })
}

/// Samples that become smoothed pixels with a line where neighbours differ.
struct Paper<'a> {
    signs: &'a [bool],
    size: [usize; 2],
    fine: usize,
}

impl Paper<'_> {
    fn pixel(&self, i: usize, j: usize, colour: impl Fn(bool) -> [f32; 3]) -> [u8; 3] {
        let fine = self.fine;
        let line = LINE.map(linear);
        let mut sum = [0.0_f32; 3];
        for y in j * fine..(j + 1) * fine {
            for x in i * fine..(i + 1) * fine {
                let light = if self.on_line(x, y) { line } else { colour(self.signs[y * self.size[0] + x]) };
                (0..3).for_each(|k| sum[k] += light[k]);
            }
        }
        sum.map(|v| encode(v / (fine * fine) as f32))
    }

    /// Whether a sample about half a line's width away is on the other side.
    fn on_line(&self, x: usize, y: usize) -> bool {
        const AROUND: [(isize, isize); 8] = [(2, 0), (-2, 0), (0, 2), (0, -2), (1, 1), (1, -1), (-1, 1), (-1, -1)];
        let here = self.signs[y * self.size[0] + x];
        self.fine > 1
            && AROUND.iter().any(|&(dx, dy)| {
                let (Some(x), Some(y)) = (x.checked_add_signed(dx), y.checked_add_signed(dy)) else { return false };
                x < self.size[0] && y < self.size[1] && self.signs[y * self.size[0] + x] != here
            })
    }
}

/// The values at all pixels, coloured in about a dozen bands of a round width.
fn bands(
    shape: &Shape,
    window: Window,
    size: [usize; 2],
    palette: Palette,
    interrupt: &Interrupt,
) -> Result<Plot, Cancelled> {
    let pixels = Pixels { window, size };
    let (values, counters) = values(shape, &pixels, interrupt)?;
    let signs: Vec<bool> = values.iter().map(|&v| v >= 0.0).collect();
    let scale = Scale::new(&values);
    let line = LINE.map(linear);
    let met = signs.iter().any(|&s| s);
    Ok(finish(size, counters, met, |i, j| {
        let at = j * size[0] + i;
        let right = i + 1 < size[0] && signs[at] != signs[at + 1];
        let below = j + 1 < size[1] && signs[at] != signs[at + size[0]];
        let light = if right || below { line } else { scale.light(values[at], palette) };
        light.map(encode)
    }))
}

fn values(shape: &Shape, pixels: &Pixels, interrupt: &Interrupt) -> Result<(Vec<f64>, Counters), Cancelled> {
    let columns: Vec<f64> = (0..pixels.size[0]).map(|i| pixels.column(i)).collect();
    let mut all = vec![0.0; pixels.size[0] * pixels.size[1]];
    interrupt.begin(all.len() as u64);
    let rows: Vec<Counters> = all
        .par_chunks_mut(pixels.size[0].max(1))
        .enumerate()
        .map_init(
            || (Sampler::new(shape).heeding(interrupt), vec![0.0; columns.len()]),
            |(sampler, rows), (j, out)| {
                interrupt.tick()?;
                rows.fill(pixels.row(j));
                sampler.values(&shape.program, &[&columns, rows], out);
                interrupt.advance(out.len() as u64);
                Ok(sampler.take_counters())
            },
        )
        .collect::<Result<_, Cancelled>>()?;
    interrupt.tick()?;
    let mut counters = Counters::default();
    rows.into_iter().for_each(|row| counters.add(row));
    Ok((all, counters))
}
