//! Pictures of a subject: rays for solids, filled plots for plane figures, graphs and maps by `charts`, sheets of all of them. One
//! camera and one range of values serve all frames and cells.

use crate::diagnostic::{Category, Diagnostic};
use crate::interrupt::Interrupt;
use crate::picture::Image;
use crate::picture::axes::{Axis, around, number};
use crate::picture::canvas::LARGEST;
use crate::picture::legend::solid_colour;
use crate::picture::palette::Palette;
use crate::picture::plot::{self, Fill, PAPER, Window, plot};
use crate::picture::raycast::Picture;
use crate::picture::sheet::{Heading, SheetError, compose};
use crate::picture::{Paint, View};
use crate::surface::sampler::Counters;
use crate::vm::{Demand, Shape};

use super::charts::{Chart, no_room};
use super::make::Workshop;
use super::solids::Solid;
use super::subject::{Place, Sequence, Subject};
use super::{Background, Options, PictureOptions};

/// Pixels along the longer side of a picture of a plane figure, where no size is given; in a sheet.
const PLOT_SIDE: [f64; 2] = [640.0, 240.0];
/// Size of a picture of a solid, where none is given; in a sheet.
const SOLID_SIZE: [[usize; 2]; 2] = [[640, 480], [240, 180]];
/// Size of a graph, where none is given; in a sheet.
const GRAPH_SIZE: [[usize; 2]; 2] = [[640, 400], [400, 240]];

/// Everything about a subject's pictures that is the same in all frames.
pub struct Artist<'a> {
    subject: &'a Subject,
    scene: Scene<'a>,
}

/// Plane figures with colours of their own.
struct Figures<'a> {
    all: Vec<(&'a Subject, Shape, Paint)>,
    window: Window,
    size: [usize; 2],
    ground: [u8; 4],
    axes: bool,
}

enum Scene<'a> {
    Solid(Box<Solid<'a>>),
    Plane { shape: Shape, window: Window, size: [usize; 2], fill: Fill, axes: bool },
    Figures(Figures<'a>),
    Chart(Chart<'a>),
}

impl<'a> Artist<'a> {
    /// Compiles the subject and sets up the camera so that it frames the object at all the moments.
    ///
    /// # Errors
    /// Unknown views and palettes, sizes out of bounds, subjects without axes, types that no picture shows, too large programs.
    pub fn new(
        shop: &Workshop<'_>,
        subject: &'a Subject,
        options: &Options,
        moments: &[f64],
    ) -> Result<Self, Diagnostic> {
        let _phase = shop.interrupt.phase("compile");
        let picture = &options.picture;
        let palette = Palette::from_name(&picture.palette).ok_or_else(|| {
            let names: Vec<&str> = Palette::NAMES.iter().map(|(name, _)| *name).collect();
            usage("palette", format!("no palette is called `{}`", picture.palette))
                .help(format!("choose one of {}", names.join(", ")))
        })?;
        let bounds = subject.bounds();
        let size = size(picture, subject, shop)?;
        let cells = subject.cells(0.0).len() as u64;
        subject.within_memory(picture_bytes(size, picture.supersample, subject).saturating_mul(cells), shop.limits)?;
        let places: Vec<Place> = moments.iter().flat_map(|&moment| subject.cells(moment)).collect();
        let scene = match bounds.as_slice() {
            [_] => Scene::Chart(Chart::graph(shop, subject, &places, (palette, size))?),
            [_, _] if !subject.all().all(Subject::is_single) => {
                Scene::Chart(Chart::map(shop, subject, (palette, size))?)
            }
            [_, _]
                if subject.all().any(|one| one.colouring.is_some() || one.name != subject.name)
                    || picture.background.is_some() =>
            {
                Scene::Figures(Figures::new(shop, subject, (picture, palette, size))?)
            }
            [x, y] => {
                let fill = Fill::of(palette);
                let demand = if fill.needs_values() { Demand::Value } else { Demand::Sign };
                let shape = subject.shape(shop.graph, demand, shop.limits)?;
                let window = Window { lo: [x[0], y[0]], hi: [x[1], y[1]] };
                Scene::Plane { shape, window, size, fill, axes: picture.axes }
            }
            [_, _, _] => Scene::Solid(Box::new(Solid::new(shop, subject, (picture, palette, size), &places)?)),
            _ => {
                let title = format!("`{}` has {} axes here; a picture shows one to three", subject.name, bounds.len());
                return Err(Diagnostic::error("dimension", title).help(
                    "give a coordinate the type of an axis and a range, as in `x1 : X; x1min = -1; x1max = 1;`",
                ));
            }
        };
        Ok(Self { subject, scene })
    }

    /// The picture at a moment: a sheet where coordinates show as its columns or rows.
    ///
    /// # Errors
    /// If the work was stopped, or the sheet is too large.
    pub fn picture(&self, moment: f64, interrupt: &Interrupt) -> Result<Picture, Diagnostic> {
        let _phase = interrupt.phase("picture");
        let subject = self.subject;
        let time = subject.time.as_ref().map(|time| format!("{} = {}", time.coordinate, number(moment)));
        if subject.columns.is_none() && subject.rows.is_none() {
            let place = subject.cells(moment).swap_remove(0);
            let cell = self.cell(&place, &time.unwrap_or_default(), interrupt)?;
            return Ok(Picture { image: self.explained(cell.image)?, ..cell });
        }
        let (mut images, mut counters, mut hits) = (Vec::new(), Counters::default(), 0);
        for place in subject.cells(moment) {
            let cell = self.cell(&place, "", interrupt)?;
            counters.add(cell.counters);
            hits += cell.hits;
            images.push(cell.image);
        }
        let title = std::iter::once(subject.name.to_string()).chain(subject.held()).chain(time);
        let title = title.collect::<Vec<_>>().join(", ");
        let sheet = compose(&images, &heading(&subject.columns), &heading(&subject.rows), &title);
        let image = self.explained(sheet.map_err(|error| too_large(&error))?)?;
        Ok(Picture { image, counters, hits })
    }

    /// What is said of options that this picture does not heed, and of objects that it does not show.
    pub fn notes(&self, options: &Options) -> Vec<Diagnostic> {
        match &self.scene {
            Scene::Solid(solid) => solid.notes(),
            Scene::Chart(_) if options.picture.background.is_some() => {
                vec![Diagnostic::note("white-paper", "graphs and maps stand on white paper, whatever the background")]
            }
            _ => Vec::new(),
        }
    }

    /// One legend serves all pictures of a sheet of solids.
    fn explained(&self, image: Image) -> Result<Image, Diagnostic> {
        match &self.scene {
            Scene::Solid(solid) => solid.explained(image),
            _ => Ok(image),
        }
    }

    fn cell(&self, place: &Place, title: &str, interrupt: &Interrupt) -> Result<Picture, Diagnostic> {
        match &self.scene {
            Scene::Solid(solid) => solid.picture(place, interrupt),
            Scene::Chart(chart) => chart.picture(place, title, interrupt),
            Scene::Figures(figures) => self.figures(figures, place, title, interrupt),
            Scene::Plane { shape, window, size, fill, axes } => {
                let plot = plot(&self.subject.placed(shape, place), *window, *size, *fill, interrupt)?;
                let image = if *axes { self.with_axes(&plot.image, title)? } else { plot.image };
                Ok(Picture { image, counters: plot.counters, hits: u64::from(plot.met) })
            }
        }
    }

    fn figures(
        &self,
        figures: &Figures<'_>,
        place: &Place,
        title: &str,
        interrupt: &Interrupt,
    ) -> Result<Picture, Diagnostic> {
        let Figures { all, window, size, ground, axes } = figures;
        let placed =
            |(one, shape, paint): &(&Subject, Shape, Paint)| (one.placed(shape, place), one.painted(paint, place));
        let placed: Vec<(Shape, Paint)> = all.iter().map(placed).collect();
        let plot = plot::figures(&placed, *window, *size, *ground, interrupt)?;
        let image = if *axes { self.with_axes(&plot.image, title)? } else { plot.image };
        Ok(Picture { image, counters: plot.counters, hits: u64::from(plot.met) })
    }

    fn with_axes(&self, image: &Image, title: &str) -> Result<Image, Diagnostic> {
        let [x, y] = [0, 1].map(|k| {
            let axis = self.subject.axes[k];
            Axis::new(axis.coordinate.to_string(), axis.range[0], axis.range[1])
        });
        around(image, &x, &y, title).ok_or_else(|| no_room([image.width, image.height]))
    }
}

impl<'a> Figures<'a> {
    fn new(
        shop: &Workshop<'_>,
        subject: &'a Subject,
        (picture, palette, size): (&PictureOptions, Palette, [usize; 2]),
    ) -> Result<Self, Diagnostic> {
        let [x, y] = [0, 1].map(|k| subject.axes[k].range);
        let mut all = Vec::new();
        for (k, one) in subject.all().enumerate() {
            let shape = one.shape(shop.graph, Demand::Sign, shop.limits)?;
            let plain = if subject.beside.is_empty() { palette.colour(0.5) } else { solid_colour(k) };
            let paint = one.paint(shop.graph, palette, shop.limits)?.unwrap_or(Paint::Plain(plain));
            all.push((one, shape, paint));
        }
        let ground = match picture.background {
            Some(Background::Colour([r, g, b])) => [r, g, b, 255],
            Some(Background::Transparent) => [0; 4],
            None => [PAPER[0], PAPER[1], PAPER[2], 255],
        };
        let window = Window { lo: [x[0], y[0]], hi: [x[1], y[1]] };
        Ok(Self { all, window, size, ground, axes: picture.axes })
    }
}

/// From where a solid is seen.
///
/// # Errors
/// An unknown view.
pub(super) fn view(picture: &PictureOptions) -> Result<View, Diagnostic> {
    let view = View::from_name(&picture.view).ok_or_else(|| {
        let names: Vec<&str> = View::NAMES.iter().map(|(name, ..)| *name).collect();
        usage("view", format!("no view is called `{}`", picture.view))
            .help(format!("choose one of {}, or azimuth,elevation in degrees: `30,20`", names.join(", ")))
    })?;
    Ok(match picture.parallel {
        Some(false) => view.central(),
        _ => view,
    })
}

fn heading(sequence: &Option<Sequence>) -> Heading {
    sequence.as_ref().map_or_else(Heading::default, |sequence| Heading {
        name: sequence.coordinate.to_string(),
        values: sequence.values.clone(),
    })
}

fn too_large(error: &SheetError) -> Diagnostic {
    usage("picture-size", error.to_string()).help("give each picture a smaller --size, or the coordinate a larger step")
}

/// The size of a picture, or of each picture of a sheet.
///
/// # Errors
/// A size out of bounds.
pub(super) fn size(picture: &PictureOptions, subject: &Subject, shop: &Workshop<'_>) -> Result<[usize; 2], Diagnostic> {
    let counts = [&subject.columns, &subject.rows].map(|s| s.as_ref().map_or(1, |s| s.values.len()));
    let in_sheet = usize::from(counts != [1, 1]);
    let size = match (picture.size, subject.bounds().as_slice()) {
        (Some((width, height)), _) => [width, height],
        (None, [x, y]) => {
            let (width, height) = (x[1] - x[0], y[1] - y[0]);
            let scale = PLOT_SIDE[in_sheet] / width.max(height);
            [width, height].map(|side| ((side * scale).round() as usize).max(1))
        }
        (None, [_]) => GRAPH_SIZE[in_sheet],
        (None, _) => SOLID_SIZE[in_sheet],
    };
    let most = shop.limits.picture_side;
    if size.iter().any(|&side| side == 0 || side > most) {
        let title = format!("a picture cannot be {} x {} pixels", size[0], size[1]);
        return Err(usage("picture-size", title).help(format!("each side has 1 to {most} pixels")));
    }
    // Known before the work is done, not after it.
    let sheet = [0, 1].map(|k| size[k].saturating_mul(counts[k]));
    if in_sheet == 1 && sheet.iter().any(|&side| side > LARGEST) {
        return Err(too_large(&SheetError::TooLarge { size: sheet }));
    }
    Ok(size)
}

/// What a picture takes while it is made: its samples, its bytes twice, and of several objects what each ray met.
fn picture_bytes(size: [usize; 2], supersample: usize, subject: &Subject) -> u64 {
    let pixels = size[0] as u64 * size[1] as u64;
    let parts: u64 = subject.all().map(|one| (one.sections().len() * one.levels.len().max(1)) as u64).sum();
    let met = if parts > 1 && subject.axes.len() == 3 { 48 * parts } else { 0 };
    pixels.saturating_mul(8 + 2 * (supersample.min(4) * supersample.min(4)) as u64 + met)
}

pub(super) fn usage(code: &'static str, title: String) -> Diagnostic {
    Diagnostic::error(code, title).category(Category::Usage)
}
