//! Pictures of solids: objects, their sections and levels in one space, with axes and what explains their colours. Draws no plane figures.

use crate::diagnostic::Diagnostic;
use crate::interrupt::Interrupt;
use crate::picture::Image;
use crate::picture::axes_space::behind;
use crate::picture::camera::Camera;
use crate::picture::extent::Extent;
use crate::picture::legend::{Legend, Telling, beside, solid_colour};
use crate::picture::palette::Palette;
use crate::picture::raycast::{GROUND, Picture, Space, Style, Thing, framed, render};
use crate::picture::{Paint, Projection};
use crate::vm::Demand;

use super::charts::{legend, no_room, telling_palette};
use super::make::Workshop;
use super::pictures::view;
use super::subject::{Member, Place, Subject};
use super::{Background, PictureOptions};

/// How much of what lies behind it a level hides where one looks straight at it, unless it is the innermost; so does a section if it is
/// one of several, and less if they are many.
const OPACITY: f32 = 0.4;

/// Objects of three axes before their camera.
pub struct Solid<'a> {
    subject: &'a Subject,
    parts: Vec<Part<'a>>,
    space: Space,
    /// The part of the space where the objects are.
    seen: Space,
    camera: Camera,
    style: Style,
    telling: Option<Telling>,
    /// What axes and legends stand on, where it was told.
    ground: Option<[u8; 4]>,
    /// The objects of several that are empty.
    missing: Vec<String>,
    axes: bool,
}

/// A section or a level of one of the objects.
struct Part<'a> {
    subject: &'a Subject,
    member: Member,
    paint: Paint,
    opacity: f32,
}

impl<'a> Solid<'a> {
    /// Sets up the camera so that it frames the objects at all the places.
    ///
    /// # Errors
    /// Unknown views, colours that make no sense, too large programs.
    pub fn new(
        shop: &Workshop<'_>,
        subject: &'a Subject,
        (picture, palette, size): (&PictureOptions, Palette, [usize; 2]),
        places: &[Place],
    ) -> Result<Self, Diagnostic> {
        let (mut parts, mut telling) = (Vec::new(), None);
        let several = !subject.beside.is_empty();
        for (k, one) in subject.all().enumerate() {
            let plain = if several { Paint::Plain(solid_colour(k)) } else { Paint::Plain(palette.solid()) };
            let told = add(&mut parts, one, (plain, palette), shop)?;
            telling = telling.or(told);
        }
        let bounds = subject.bounds();
        let end = |side: usize| [0, 1, 2].map(|k| bounds[k][side]);
        let space = Space { lo: end(0), hi: end(1) };
        let mut style = Style { size, palette, cuts: subject.cut, ..style(picture) };
        let ground = match picture.background {
            Some(Background::Colour([r, g, b])) => Some([r, g, b, 255]),
            Some(Background::Transparent) => Some([0; 4]),
            None => None,
        };
        if ground.is_none() && telling.is_some() {
            // A legend stands on paper, and so does what it explains.
            style.background = [[255; 3]; 2];
        }
        let (extent, missing) = extent(&parts, space, places, shop.interrupt)?;
        let seen = extent.bounds().map_or(space, |seen| loosened(seen, space));
        let mut view = view(picture)?;
        if picture.parallel == Some(true) && view.projection != Projection::Orthographic {
            view = view.level([0, 1, 2].map(|k| 0.5 * (seen.lo[k] + seen.hi[k])));
        }
        let camera = if picture.axes {
            // The numbers stand at the edges of the space, all of which must be seen.
            Camera::framing(&view, &Extent::whole(space), size[0] as f64 / size[1].max(1) as f64)
        } else {
            framed(&view, &extent, &style)
        };
        Ok(Self { subject, parts, space, seen, camera, style, telling, ground, missing, axes: picture.axes })
    }

    /// What stays the same while one object is worked on: its colour, where it is, the camera, and how it is drawn.
    pub fn stand(&self) -> Option<(Paint, Space, Camera, Style)> {
        let [part] = &self.parts[..] else { return None };
        Some((part.paint.clone(), self.seen, self.camera, self.style))
    }

    /// The picture at a place.
    ///
    /// # Errors
    /// If the work was stopped, or there is no memory for it.
    pub fn picture(&self, place: &Place, interrupt: &Interrupt) -> Result<Picture, Diagnostic> {
        let thing = |part: &Part<'_>| Thing {
            shape: part.subject.placed(&part.member.shape, place),
            paint: part.subject.painted(&part.paint, place),
            opacity: part.opacity,
        };
        let things: Vec<Thing> = self.parts.iter().map(thing).collect();
        let Picture { mut image, counters, hits } = render(&things, self.seen, &self.camera, &self.style, interrupt)?;
        let no_room = || no_room(self.style.size);
        if self.axes {
            let names = [0, 1, 2].map(|k| self.subject.axes[k].coordinate.to_string());
            image = behind(&image, &self.camera, self.space, &names, self.ground).ok_or_else(no_room)?;
        }
        Ok(Picture { image, counters, hits })
    }

    /// A picture, or a sheet of them, with what explains its colours at its right.
    ///
    /// # Errors
    /// If there is no memory for it.
    pub fn explained(&self, image: Image) -> Result<Image, Diagnostic> {
        let Some(telling) = &self.telling else { return Ok(image) };
        beside(&image, telling, self.ground).ok_or_else(|| no_room([image.width, image.height]))
    }

    /// Which of several objects are certainly empty at all the places.
    pub fn notes(&self) -> Vec<Diagnostic> {
        let note = |name: &String| {
            let title = format!("{name} is empty in the modelling space, and the picture shows the others");
            Diagnostic::warning("empty-section", title)
        };
        self.missing.iter().map(note).collect()
    }
}

/// Adds the sections and levels of an object; what explains their colours, if there are several and the program gives it none.
fn add<'a>(
    parts: &mut Vec<Part<'a>>,
    subject: &'a Subject,
    (plain, palette): (Paint, Palette),
    shop: &Workshop<'_>,
) -> Result<Option<Telling>, Diagnostic> {
    let members = subject.members(shop.graph, Demand::Sign, shop.limits)?;
    let own = subject.paint(shop.graph, palette, shop.limits)?;
    let telling = (members.len() > 1 && own.is_none()).then(|| telling(subject, &members, palette));
    let count = members.len();
    // Of levels, the highest lies within the others and is what a cut shows: it comes first.
    for (k, member) in members.into_iter().enumerate().rev() {
        let paint = match (&own, &telling) {
            // Its colours may depend on the coordinates that tell the sections apart.
            (Some(own), _) => subject.painted(own, &member.place),
            (None, Some(telling)) => opaque(telling.colours[k]),
            (None, None) => plain.clone(),
        };
        // Nothing is to be seen through the innermost.
        let innermost = k + 1 == count && subject.groups.is_empty() && subject.colour.is_none();
        let opacity = if innermost { 1.0 } else { (1.4 / count as f32).min(OPACITY) };
        parts.push(Part { subject, member, paint, opacity });
    }
    Ok(telling)
}

fn opaque([r, g, b, _]: [u8; 4]) -> Paint {
    Paint::Plain([r, g, b])
}

/// How the sections and levels of a solid are told apart: by a bar of colours, or where no one number tells them by their names.
fn telling(subject: &Subject, members: &[Member], palette: Palette) -> Telling {
    let values = || members.iter().map(|m| m.value);
    match (&subject.colour, &subject.levels[..]) {
        (Some(colour), _) => Telling::values(values(), legend(colour.coordinate, &colour.values, palette)),
        (None, [first, .., last]) if subject.groups.is_empty() => {
            let legend = Legend::new(subject.name.to_string(), first.value, last.value, telling_palette(palette));
            Telling::values(values(), legend)
        }
        _ => Telling::solids(members.iter().map(|m| m.label.clone())),
    }
}

/// Everything about a picture's look that options say.
fn style(picture: &PictureOptions) -> Style {
    let background = match picture.background {
        Some(Background::Colour(colour)) => [colour; 2],
        _ => GROUND,
    };
    Style {
        supersample: picture.supersample,
        light: picture.light.map(|angles| angles.map(f64::to_radians)),
        fill: if picture.fill { 1.0 } else { 0.0 },
        shadow: if picture.shadow { Style::default().shadow } else { 0.0 },
        occlusion: picture.occlusion,
        background,
        // Axes stand behind the objects, and their faces on a ground of their own.
        transparent: picture.axes || picture.background == Some(Background::Transparent),
        ..Style::default()
    }
}

/// A hull of all objects at all the places, and which of several have none.
fn extent(
    parts: &[Part<'_>],
    space: Space,
    places: &[Place],
    interrupt: &Interrupt,
) -> Result<(Extent, Vec<String>), Diagnostic> {
    let (mut all, mut missing) = (Extent::nothing(space, 3), Vec::new());
    for part in parts {
        let mut own = Extent::nothing(space, 3);
        for place in places {
            own = own.join(&Extent::of(&part.subject.placed(&part.member.shape, place), space, interrupt)?);
        }
        if own.is_empty() && parts.len() > 1 {
            let label = &part.member.label;
            let of = if label.is_empty() { String::new() } else { format!(" at {label}") };
            missing.push(format!("{}{of}", part.subject.name));
        }
        all = all.join(&own);
    }
    Ok((all, missing))
}

/// A box a little larger than a hull, within the space: a face of the object that lies in the hull's own is none of the space's.
fn loosened(hull: Space, space: Space) -> Space {
    let more = |k: usize| (space.hi[k] - space.lo[k]) / 128.0;
    Space {
        lo: std::array::from_fn(|k| (hull.lo[k] - more(k)).max(space.lo[k])),
        hi: std::array::from_fn(|k| (hull.hi[k] + more(k)).min(space.hi[k])),
    }
}
