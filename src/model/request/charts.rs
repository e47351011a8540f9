//! Pictures with axes of their own: graphs of one axis, contour maps and groups of sections of two. Casts no rays, fills no figures.

use crate::diagnostic::Diagnostic;
use crate::field::Coordinate;
use crate::interrupt::Interrupt;
use crate::picture::Image;
use crate::picture::axes::Axis;
use crate::picture::contours::{self, Map};
use crate::picture::graph::{self, Curve, Graph};
use crate::picture::isolines::Field;
use crate::picture::legend::{Legend, Telling};
use crate::picture::palette::Palette;
use crate::picture::plot::Window;
use crate::picture::raycast::Picture;
use crate::surface::sampler::Counters;
use crate::vm::{Demand, Shape};

use super::make::Workshop;
use super::subject::{Member, Place, Subject};

/// Samples of a curve at least; a wider picture takes one for each column.
const LEAST_SAMPLES: usize = 400;

/// A picture of a subject of one or two axes, the same in all frames and cells but for the values of the coordinates that change.
pub struct Chart<'a> {
    subject: &'a Subject,
    members: Vec<(&'a Subject, Member)>,
    telling: Option<Telling>,
    size: [usize; 2],
    kind: Kind,
}

enum Kind {
    /// One axis: curves over it, within these values.
    Curves { range: [f64; 2] },
    /// Two axes: lines of the function's own levels.
    Levels { shape: Shape, palette: Option<Palette> },
    /// Two axes: the boundaries of sections.
    Sections,
}

impl<'a> Chart<'a> {
    /// The graph of a subject of one axis; `places` are all those that will be shown, so that one range of values serves them.
    ///
    /// # Errors
    /// If the work was stopped, or a program is too large.
    pub fn graph(
        shop: &Workshop<'_>,
        subject: &'a Subject,
        places: &[Place],
        (palette, size): (Palette, [usize; 2]),
    ) -> Result<Self, Diagnostic> {
        let members = members(shop, subject)?;
        let telling = (members.len() > 1).then(|| telling(subject, &members, palette));
        let kind = Kind::Curves { range: [0.0; 2] };
        let mut chart = Self { subject, members, telling, size, kind };
        let mut all: Option<[f64; 2]> = None;
        for place in places {
            for curve in chart.curves(place, shop.interrupt)?.0 {
                let [lo, hi] = curve.values;
                all = Some(all.map_or([lo, hi], |[a, b]| [a.min(lo), b.max(hi)]));
            }
        }
        let curve = Curve { values: all.unwrap_or_default(), ..Curve::default() };
        chart.kind = Kind::Curves { range: Graph { curve, ..Graph::default() }.value_range() };
        Ok(chart)
    }

    /// The contour map of a subject of two axes and several levels, or its sections in one picture.
    ///
    /// # Errors
    /// If a program is too large.
    pub fn map(
        shop: &Workshop<'_>,
        subject: &'a Subject,
        (palette, size): (Palette, [usize; 2]),
    ) -> Result<Self, Diagnostic> {
        let members = members(shop, subject)?;
        let telling = Some(telling(subject, &members, palette));
        let sections = !subject.groups.is_empty() || subject.colour.is_some() || !subject.beside.is_empty();
        let kind = if subject.levels.is_empty() || sections {
            Kind::Sections
        } else {
            let shape = subject.shape(shop.graph, Demand::Value, shop.limits)?;
            // The house's own palette tells inside from outside; a map in its paper and ink is lines alone.
            Kind::Levels { shape, palette: (palette != Palette::Plain).then_some(palette) }
        };
        Ok(Self { subject, members, telling, size, kind })
    }

    /// The picture at a place.
    ///
    /// # Errors
    /// If the work was stopped, or there is no memory for it.
    pub fn picture(&self, place: &Place, title: &str, interrupt: &Interrupt) -> Result<Picture, Diagnostic> {
        let (image, counters, hits) = match &self.kind {
            Kind::Curves { range } => {
                let (curves, counters) = self.curves(place, interrupt)?;
                let hits = curves.iter().map(|curve| curve.runs.len() as u64).sum();
                (self.draw_curves(curves, *range, title), counters, hits)
            }
            Kind::Levels { shape, palette } => {
                let (field, counters) = self.field(&self.subject.placed(shape, place), interrupt)?;
                let map = self.frame(title, *palette);
                let hits = map.levels.iter().map(|&level| field.lines(level).len() as u64).sum();
                (contours::draw(&field, &map, self.size[0], self.size[1]), counters, hits)
            }
            Kind::Sections => self.sections(place, title, interrupt)?,
        };
        let image = image.ok_or_else(|| no_room(self.size))?;
        Ok(Picture { image, counters, hits })
    }

    fn sections(
        &self,
        place: &Place,
        title: &str,
        interrupt: &Interrupt,
    ) -> Result<(Option<Image>, Counters, u64), Diagnostic> {
        let (mut fields, mut counters) = (Vec::new(), Counters::default());
        for (one, member) in &self.members {
            let (field, cost) = self.field(&one.placed(&member.shape, place), interrupt)?;
            counters.add(cost);
            fields.push(field);
        }
        let hits = fields.iter().filter(|field| field.values.iter().any(|&v| v >= 0.0)).count();
        let map = self.frame(title, None);
        let telling = self.telling.as_ref();
        let image = telling.and_then(|telling| contours::group(&fields, telling, 0.0, &map, self.size));
        Ok((image, counters, hits as u64))
    }

    fn curves(&self, place: &Place, interrupt: &Interrupt) -> Result<(Vec<Curve>, Counters), Diagnostic> {
        let [lo, hi] = self.subject.axes[0].range;
        let count = self.size[0].max(LEAST_SAMPLES);
        let (mut curves, mut counters) = (Vec::new(), Counters::default());
        for (one, member) in &self.members {
            let (curve, cost) = graph::of(&one.placed(&member.shape, place), lo, hi, count, interrupt)?;
            counters.add(cost);
            curves.push(curve);
        }
        Ok((curves, counters))
    }

    fn draw_curves(&self, mut curves: Vec<Curve>, range: [f64; 2], title: &str) -> Option<Image> {
        let [lo, hi] = self.subject.axes[0].range;
        let axis = Axis::new(self.subject.axes[0].coordinate.to_string(), lo, hi);
        // Several functions are told apart by the key.
        let name = if self.subject.beside.is_empty() { self.subject.name.to_string() } else { String::new() };
        let graph = Graph { title: title.into(), name, range: Some(range), curve: Curve::default() };
        match &self.telling {
            Some(telling) => graph::group(&curves, telling, &graph, &axis, self.size),
            None => {
                let curve = curves.pop().unwrap_or_default();
                graph::stack(&[Graph { curve, ..graph }], &axis, self.size[0], self.size[1])
            }
        }
    }

    /// Values at about every pixel.
    fn field(&self, shape: &Shape, interrupt: &Interrupt) -> Result<(Field, Counters), Diagnostic> {
        let [x, y] = [0, 1].map(|k| self.subject.axes[k].range);
        let window = Window { lo: [x[0], y[0]], hi: [x[1], y[1]] };
        Ok(Field::of(shape, window, self.size[0] + 1, self.size[1] + 1, interrupt)?)
    }

    fn frame(&self, title: &str, palette: Option<Palette>) -> Map {
        Map {
            title: title.into(),
            names: [0, 1].map(|k| self.subject.axes[k].coordinate.to_string()),
            value: self.subject.name.to_string(),
            levels: self.subject.levels.iter().map(|level| level.value).collect(),
            palette,
            labels: true,
        }
    }
}

/// The sections and levels of all objects.
fn members<'a>(shop: &Workshop<'_>, subject: &'a Subject) -> Result<Vec<(&'a Subject, Member)>, Diagnostic> {
    let mut all = Vec::new();
    for one in subject.all() {
        for member in one.members(shop.graph, Demand::Value, shop.limits)? {
            all.push((one, member));
        }
    }
    Ok(all)
}

/// How members are told apart: those of type C by a spectrum, others by names.
fn telling(subject: &Subject, members: &[(&Subject, Member)], palette: Palette) -> Telling {
    let name = |(one, member): &(&Subject, Member)| match (&subject.beside[..], member.label.as_str()) {
        ([], label) => label.to_owned(),
        (_, "") => one.name.to_string(),
        (_, label) => format!("{}, {label}", one.name),
    };
    match &subject.colour {
        Some(colour) if subject.beside.is_empty() => {
            Telling::values(members.iter().map(|m| m.1.value), legend(colour.coordinate, &colour.values, palette))
        }
        _ => Telling::names(members.iter().map(name)),
    }
}

/// What the colours of a coordinate's values mean; the house's own palette has no colours to tell values by, the spectrum does.
pub fn legend(coordinate: Coordinate, values: &[f64], palette: Palette) -> Legend {
    let (lo, hi) = values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), &v| (lo.min(v), hi.max(v)));
    Legend::new(coordinate.to_string(), lo, hi, telling_palette(palette))
}

/// The palette that tells values: the one asked for, or the spectrum.
pub fn telling_palette(palette: Palette) -> Palette {
    if palette == Palette::Plain { Palette::Spectrum } else { palette }
}

/// A picture for which there is no memory.
pub fn no_room(size: [usize; 2]) -> Diagnostic {
    let title = format!("there is no memory for a picture of {} x {} pixels", size[0], size[1]);
    Diagnostic::error("too-much-memory", title)
        .category(crate::diagnostic::Category::Result)
        .help("ask for a smaller one with --size")
}
