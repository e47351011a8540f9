//! A small picture of an object and a line about it, for a terminal. The picture is that of a `.png`, only smaller.

use crate::diagnostic::Diagnostic;
use crate::picture::Image;

use super::make::Workshop;
use super::pictures::{Artist, view};
use super::space::plain;
use super::subject::{Axis, Subject};
use super::{Background, Options, Timing, View, together};
use crate::model::environment::Object;
use crate::model::session::Session;

/// Columns and rows of pixels below which letters beside a plot cannot be read; such pictures are made larger and shrunk.
const READABLE: [usize; 2] = [400, 260];
/// The smallest side of a picture of a solid or a figure.
const SMALLEST: usize = 8;

/// A picture of at most so many pixels across and down, of the first moment.
///
/// # Errors
/// Messages for the user: those of a `.png`.
pub fn preview(session: &mut Session, options: &Options, within: [usize; 2]) -> Result<Image, Vec<Diagnostic>> {
    session.turn();
    let subject = together::subject(session, &options.view, &options.timing)?;
    let seen = view(&options.picture).map_err(|told| vec![told])?;
    let subject = subject.cut(&options.cuts, &seen).map_err(|told| vec![told])?;
    let host = session.host.clone();
    let (graph, limits, interrupt) = (&session.graph, &session.limits, &session.interrupt);
    let shop = Workshop { graph, limits, interrupt, host: &*host, guide: super::way::Ready::Following };
    small(&shop, &subject, options, within).map_err(|told| vec![told])
}

fn small(shop: &Workshop<'_>, subject: &Subject, options: &Options, within: [usize; 2]) -> Result<Image, Diagnostic> {
    let mut options = options.clone();
    let [width, height] = size(subject, within, options.picture.axes);
    options.picture.size = Some((width, height));
    // A terminal has a ground of its own, and no way to let it through.
    options.picture.background = options.picture.background.filter(|ground| *ground != Background::Transparent);
    let mut moments = subject.moments();
    moments.truncate(1);
    let artist = Artist::new(shop, subject, &options, &moments)?;
    let picture = artist.picture(moments[0], shop.interrupt)?;
    if picture.hits == 0 {
        return Err(shop.nothing(subject, Some(moments[0]), None));
    }
    Ok(shrunk(picture.image, within))
}

/// Pixels of the picture, or of each picture of a sheet.
fn size(subject: &Subject, within: [usize; 2], axes: bool) -> [usize; 2] {
    let [across, down] = [&subject.columns, &subject.rows].map(|s| s.as_ref().map_or(1, |s| s.values.len()));
    let each = [within[0] / across, within[1] / down].map(|side| side.max(SMALLEST));
    let lettered = axes || subject.axes.len() == 1 || !subject.is_single() && subject.axes.len() == 2;
    match subject.bounds()[..] {
        _ if lettered => [each[0].max(READABLE[0]), each[1].max(READABLE[1])],
        [x, y] => fitted([x[1] - x[0], y[1] - y[0]], each),
        _ => fitted([4.0, 3.0], each),
    }
}

/// The largest size of those proportions within another.
fn fitted(sides: [f64; 2], within: [usize; 2]) -> [usize; 2] {
    let scale = (within[0] as f64 / sides[0]).min(within[1] as f64 / sides[1]);
    sides.map(|side| ((side * scale).round() as usize).max(SMALLEST))
}

/// The picture made smaller until it fits, each pixel the mean of those that it covers.
#[must_use]
pub fn shrunk(image: Image, within: [usize; 2]) -> Image {
    if image.width <= within[0] && image.height <= within[1] {
        return image;
    }
    let [width, height] = fitted([image.width as f64, image.height as f64], within);
    let range = |k: usize, side: usize, of: usize| (k * of / side)..((k + 1) * of / side).max(k * of / side + 1);
    let mut small = Image::new(width, height, [255; 3]);
    for j in 0..height {
        for i in 0..width {
            let (mut sum, mut count) = ([0u32; 3], 0);
            for y in range(j, height, image.height) {
                for x in range(i, width, image.width) {
                    let pixel = image.pixel(x, y);
                    (0..3).for_each(|k| sum[k] += u32::from(pixel[k]));
                    count += 1;
                }
            }
            small.set(i, j, sum.map(|s| (s / count.max(1)) as u8));
        }
    }
    small
}

/// One line about an object: its dimension, its coordinates, their bounds, the route to its boundary.
///
/// # Errors
/// Messages for the user: an unknown name, one that is no object.
pub fn headline(session: &mut Session, view: &View) -> Result<String, Vec<Diagnostic>> {
    let object = session.object_given(view.object.as_deref(), &|c| view.at.iter().any(|at| at.0 == c))?;
    Ok(match together::subject(session, view, &Timing::default()) {
        Ok(subject) => {
            let has_boundary = matches!(object.space().len(), 2 | 3);
            let route = if has_boundary { session.route_of(&object).ok() } else { None };
            line(&object, &subject.axes, "") + &route.map_or(String::new(), |route| format!("; route {}", route.name()))
        }
        Err(told) => line(&object, &[], told.first().map_or("", |told| told.code)),
    })
}

/// The line without the route; `space` is the modelling space where it is known, given or found, `trouble` the code of what is in the way.
fn line(object: &Object, space: &[Axis], trouble: &str) -> String {
    let names: Vec<String> = object.uses.iter().map(|c| c.to_string()).collect();
    let mut bounds: Vec<(String, (f64, f64))> = Vec::new();
    for axis in &object.axes {
        let known = space.iter().find(|known| known.coordinate == axis.coordinate).map(|known| known.range.into());
        let Some(range) = known.or(axis.range) else { continue };
        match bounds.iter_mut().find(|(_, known)| *known == range) {
            Some((names, _)) => *names += &format!(", {}", axis.coordinate),
            None => bounds.push((axis.coordinate.to_string(), range)),
        }
    }
    let bounds: Vec<String> =
        bounds.iter().map(|(names, (lo, hi))| format!("{names} from {} to {}", plain(*lo), plain(*hi))).collect();
    let bounds = match trouble {
        _ if !bounds.is_empty() => bounds.join("; "),
        "empty-object" => "empty".into(),
        "endless-object" => "without end".into(),
        _ => "no bounds yet".into(),
    };
    format!("{}: {}-D object of {}; {bounds}", object.name, names.len(), names.join(", "))
}
