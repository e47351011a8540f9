//! Pictures of solids: one boundary, or those of several levels that show through each other, with axes and a legend. Draws no plane figures.

use crate::diagnostic::Diagnostic;
use crate::interrupt::Interrupt;
use crate::picture::Image;
use crate::picture::axes_space::behind;
use crate::picture::camera::{Camera, View};
use crate::picture::extent::Extent;
use crate::picture::legend::{Legend, beside};
use crate::picture::palette::Palette;
use crate::picture::raycast::{Picture, Space, Style, framed, raycast};
use crate::surface::sampler::Counters;
use crate::vm::{Demand, Shape};

use super::PictureOptions;
use super::charts::{no_room, telling_palette};
use super::make::Workshop;
use super::pictures::usage;
use super::subject::{Member, Place, Subject};

/// How much of what lies behind it a level lets through, unless it is the innermost.
const OPACITY: f64 = 0.4;

/// A subject of three axes before its camera.
pub struct Solid<'a> {
    subject: &'a Subject,
    members: Vec<Member>,
    space: Space,
    camera: Camera,
    style: Style,
    legend: Option<Legend>,
    axes: bool,
}

impl<'a> Solid<'a> {
    /// Sets up the camera so that it frames the object at all the places.
    ///
    /// # Errors
    /// Unknown views, types that such a picture cannot show, too large programs.
    pub fn new(
        shop: &Workshop<'_>,
        subject: &'a Subject,
        (picture, palette, size): (&PictureOptions, Palette, [usize; 2]),
        places: &[Place],
    ) -> Result<Self, Diagnostic> {
        let shown = subject.shown_by("a picture of a solid", &["V", "W", "levels"]);
        shown.map_err(|told| {
            told.help("a .glb shows sections together; fixing an axis, --at x3=0, makes a plane picture of them")
        })?;
        let members = subject.members(shop.graph, Demand::Sign, shop.limits)?;
        let bounds = subject.bounds();
        let end = |side: usize| [0, 1, 2].map(|k| bounds[k][side]);
        let space = Space { lo: end(0), hi: end(1) };
        let transparent = picture.axes;
        let style = Style { size, supersample: picture.supersample, palette, transparent, ..Style::default() };
        let legend = (members.len() > 1).then(|| {
            let (lo, hi) = (members[0].value, members[members.len() - 1].value);
            Legend::new(subject.name.to_string(), lo, hi, telling_palette(palette))
        });
        let view = View::from_name(&picture.view).ok_or_else(|| {
            let names: Vec<&str> = View::NAMES.iter().map(|(name, ..)| *name).collect();
            usage("view", format!("no view is called `{}`", picture.view))
                .help(format!("choose one of {}, or azimuth,elevation in degrees: `30,20`", names.join(", ")))
        })?;
        let camera = if picture.axes {
            // The numbers stand at the edges of the space, all of which must be seen.
            Camera::framing(&view, &Extent::whole(space), size[0] as f64 / size[1].max(1) as f64)
        } else {
            // The lowest level encloses the others.
            let extent = extent(subject, &members[0].shape, space, places, shop.interrupt)?;
            framed(&view, &extent, &style)
        };
        Ok(Self { subject, members, space, camera, style, legend, axes: picture.axes })
    }

    /// The picture at a place.
    ///
    /// # Errors
    /// If the work was stopped, or there is no memory for it.
    pub fn picture(&self, place: &Place, interrupt: &Interrupt) -> Result<Picture, Diagnostic> {
        let (mut image, mut counters, mut hits): (Option<Image>, _, _) = (None, Counters::default(), 0);
        // From within: each level lies before those above it, wherever one looks from.
        for member in self.members.iter().rev() {
            let shape: Shape = self.subject.placed(&member.shape, place);
            let solid = self.legend.as_ref().map(|legend| legend.colour(member.value));
            let picture = raycast(&shape, self.space, &self.camera, &Style { solid, ..self.style }, interrupt)?;
            counters.add(picture.counters);
            hits += picture.hits;
            image = Some(match image {
                Some(within) => veil(&picture.image, within),
                None => picture.image,
            });
        }
        let [width, height] = self.style.size;
        let mut image = image.unwrap_or_else(|| Image::new(width, height, [255; 3]));
        let no_room = || no_room(self.style.size);
        if self.axes {
            let names = [0, 1, 2].map(|k| self.subject.axes[k].coordinate.to_string());
            image = behind(&image, &self.camera, self.space, &names).ok_or_else(no_room)?;
        }
        if let Some(legend) = &self.legend {
            image = beside(&image, legend).ok_or_else(no_room)?;
        }
        Ok(Picture { image, counters, hits })
    }
}

/// A hull of the object at all the places.
fn extent(
    subject: &Subject,
    shape: &Shape,
    space: Space,
    places: &[Place],
    interrupt: &Interrupt,
) -> Result<Extent, Diagnostic> {
    let mut all: Option<Extent> = None;
    for place in places {
        let here = Extent::of(&subject.placed(shape, place), space, interrupt)?;
        all = Some(match all {
            Some(all) => all.join(&here),
            None => here,
        });
    }
    Ok(all.unwrap_or_else(|| Extent::nothing(space, 3)))
}

/// Lays a picture over another so that the other shows through.
fn veil(over: &Image, mut under: Image) -> Image {
    for (to, from) in under.rgba.as_chunks_mut::<4>().0.iter_mut().zip(over.rgba.as_chunks::<4>().0) {
        let a = OPACITY * f64::from(from[3]) / 255.0;
        let b = f64::from(to[3]) / 255.0 * (1.0 - a);
        if a + b > 0.0 {
            for k in 0..3 {
                to[k] = ((a * f64::from(from[k]) + b * f64::from(to[k])) / (a + b)).round() as u8;
            }
            to[3] = ((a + b) * 255.0).round() as u8;
        }
    }
    under
}
