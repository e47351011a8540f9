//! Pictures of a subject: rays for solids, filled plots for plane figures. One camera serves all frames.

use crate::diagnostic::{Category, Diagnostic};
use crate::interrupt::Interrupt;
use crate::picture::animation::Frames;
use crate::picture::camera::{Camera, View};
use crate::picture::extent::Extent;
use crate::picture::palette::Palette;
use crate::picture::plot::{Fill, Window, plot};
use crate::picture::raycast::{Picture, Space, Style, framed, raycast};
use crate::vm::{Demand, Shape};

use super::make::Workshop;
use super::subject::Subject;
use super::{Options, PictureOptions};

/// Pixels along the longer side of a picture of a plane figure, where no size is given.
const PLOT_SIDE: f64 = 640.0;
/// Size of a picture of a solid, where none is given.
const SOLID_SIZE: [usize; 2] = [640, 480];

/// Everything about a subject's pictures that is the same in all frames.
pub struct Artist<'a> {
    subject: &'a Subject,
    shape: Shape,
    scene: Scene,
}

enum Scene {
    Solid { space: Space, camera: Camera, style: Style },
    Plane { window: Window, size: [usize; 2], fill: Fill },
}

impl<'a> Artist<'a> {
    /// Compiles the subject and sets up the camera so that it frames the object at all the moments.
    ///
    /// # Errors
    /// Unknown views and palettes, sizes out of bounds, subjects that are neither solids nor plane figures, too large programs.
    pub fn new(
        shop: &Workshop<'_>,
        subject: &'a Subject,
        options: &Options,
        moments: &[f64],
    ) -> Result<Self, Diagnostic> {
        let picture = &options.picture;
        let palette = Palette::from_name(&picture.palette).ok_or_else(|| {
            let names: Vec<&str> = Palette::NAMES.iter().map(|(name, _)| *name).collect();
            usage("palette", format!("no palette is called `{}`", picture.palette))
                .help(format!("choose one of {}", names.join(", ")))
        })?;
        let bounds = subject.bounds();
        let size = size(picture, &bounds, shop)?;
        subject.within_memory(picture_bytes(size, picture.supersample), shop.limits)?;
        match bounds.as_slice() {
            [x, y] => {
                let fill = Fill::of(palette);
                let demand = if fill.needs_values() { Demand::Value } else { Demand::Sign };
                let shape = subject.shape(shop.graph, demand, shop.limits)?;
                let window = Window { lo: [x[0], y[0]], hi: [x[1], y[1]] };
                Ok(Self { subject, shape, scene: Scene::Plane { window, size, fill } })
            }
            [x, y, z] => {
                let shape = subject.shape(shop.graph, Demand::Sign, shop.limits)?;
                let space = Space { lo: [x[0], y[0], z[0]], hi: [x[1], y[1], z[1]] };
                let style = Style { size, supersample: picture.supersample, palette, ..Style::default() };
                let camera = camera(subject, &shape, space, &style, (picture, moments), shop.interrupt)?;
                Ok(Self { subject, shape, scene: Scene::Solid { space, camera, style } })
            }
            _ => {
                let title = format!("`{}` has {} axes here; a picture shows two or three", subject.name, bounds.len());
                Err(Diagnostic::error("dimension", title)
                    .help("give the missing coordinate a range, as in `x2min = -1; x2max = 1;`"))
            }
        }
    }

    /// The picture at a moment.
    ///
    /// # Errors
    /// If the work was stopped.
    pub fn picture(&self, moment: f64, interrupt: &Interrupt) -> Result<Picture, Diagnostic> {
        let shape = self.subject.at(&self.shape, moment);
        match &self.scene {
            Scene::Solid { space, camera, style } => Ok(raycast(&shape, *space, camera, style, interrupt)?),
            Scene::Plane { window, size, fill } => {
                let plot = plot(&shape, *window, *size, *fill, interrupt)?;
                Ok(Picture { image: plot.image, counters: plot.counters, hits: u64::from(plot.met) })
            }
        }
    }
}

fn camera(
    subject: &Subject,
    shape: &Shape,
    space: Space,
    style: &Style,
    (picture, moments): (&PictureOptions, &[f64]),
    interrupt: &Interrupt,
) -> Result<Camera, Diagnostic> {
    let view = View::from_name(&picture.view).ok_or_else(|| {
        let names: Vec<&str> = View::NAMES.iter().map(|(name, ..)| *name).collect();
        usage("view", format!("no view is called `{}`", picture.view))
            .help(format!("choose one of {}, or azimuth,elevation in degrees: `30,20`", names.join(", ")))
    })?;
    let input = subject.time.as_ref().and_then(|t| subject.fixed.iter().position(|f| f.0 == t.coordinate));
    let extent = match input {
        Some(input) => Frames { shape, input, values: moments, space }.extent(interrupt)?,
        None => Extent::of(shape, space, interrupt)?,
    };
    Ok(framed(&view, &extent, style))
}

fn size(picture: &PictureOptions, bounds: &[[f64; 2]], shop: &Workshop<'_>) -> Result<[usize; 2], Diagnostic> {
    let size = match (picture.size, bounds) {
        (Some((width, height)), _) => [width, height],
        (None, [x, y]) => {
            let (width, height) = (x[1] - x[0], y[1] - y[0]);
            let scale = PLOT_SIDE / width.max(height);
            [width, height].map(|side| ((side * scale).round() as usize).max(1))
        }
        (None, _) => SOLID_SIZE,
    };
    let most = shop.limits.picture_side;
    if size.iter().any(|&side| side == 0 || side > most) {
        let title = format!("a picture cannot be {} x {} pixels", size[0], size[1]);
        return Err(usage("picture-size", title).help(format!("each side has 1 to {most} pixels")));
    }
    Ok(size)
}

/// What a picture takes while it is made: its samples, and its bytes twice.
fn picture_bytes(size: [usize; 2], supersample: usize) -> u64 {
    let pixels = (size[0] * size[1]) as u64;
    pixels * (8 + 2 * (supersample * supersample) as u64)
}

fn usage(code: &'static str, title: String) -> Diagnostic {
    Diagnostic::error(code, title).category(Category::Usage)
}
