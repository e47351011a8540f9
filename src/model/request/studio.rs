//! A solid that stands still to be worked on: its place before the camera, for a picture that is redrawn in part. Draws nothing.

use crate::diagnostic::Diagnostic;
use crate::field::{Coordinate, NodeId};
use crate::model::carving::errors;
use crate::model::session::{Session, UNNAMED};
use crate::picture::palette::Palette;
use crate::picture::raycast::{Space, Style};
use crate::picture::{Camera, Paint};
use crate::syntax::tree::Name;
use crate::vm::Precision;

use super::make::Workshop;
use super::pictures::{size, usage, view};
use super::solids::Solid;
use super::{Options, together};

/// How much room there is around a workpiece whose space was found, for what is added to it, as a part of its longest side.
const ROOM: f64 = 0.25;

/// A workpiece before its camera.
#[derive(Debug)]
pub struct Studio {
    /// Its name.
    pub name: Name,
    /// Its function.
    pub node: NodeId,
    /// The coordinates of its programs: x1, x2, x3, then those that are held.
    pub inputs: Vec<Coordinate>,
    /// The values of those.
    pub fixed: Vec<f64>,
    /// The numbers that points are computed with.
    pub precision: Precision,
    /// Its colour.
    pub paint: Paint,
    /// The part of space that is shown.
    pub space: Space,
    /// Where it is seen from.
    pub camera: Camera,
    /// How it is drawn.
    pub style: Style,
    /// What there is to say of it.
    pub notes: Vec<Diagnostic>,
}

/// Sets an object up to be worked on.
///
/// # Errors
/// Messages for the user: an object that is no solid of x1, x2, x3, and those of a picture.
pub fn studio(session: &mut Session, options: &Options) -> Result<Studio, Vec<Diagnostic>> {
    session.turn();
    let subject = together::subject(session, &options.view, &options.timing)?;
    let one = |told: Diagnostic| vec![told];
    if subject.name.as_ref() == UNNAMED || !session.is_defined(&subject.name) {
        return Err(one(errors::no_name(&subject.name)));
    }
    let axes: Vec<String> = subject.axes.iter().map(|axis| axis.coordinate.to_string()).collect();
    if axes != ["x1", "x2", "x3"] {
        return Err(one(errors::not_solid(&subject.name, &axes)));
    }
    let object = session.object_given(Some(&subject.name), &|c| options.view.at.iter().any(|at| at.0 == c))?;
    let what = match () {
        () if !subject.beside.is_empty() => Some("several objects are named"),
        () if subject.time.is_some() => Some("it moves"),
        () if subject.columns.is_some() || subject.rows.is_some() => Some("it is a sheet of pictures"),
        () if !subject.is_single() || options.slices.is_some() => Some("it is several sections or levels"),
        () if object.levels != [0.0] => Some("its boundary is at another level than 0"),
        () => None,
    };
    if let Some(what) = what {
        return Err(one(errors::not_one(&subject.name, what)));
    }
    let subject = subject.cut(&options.cuts, &view(&options.picture).map_err(one)?).map_err(one)?;
    let given = |c: Coordinate| {
        options.view.bounds.iter().any(|bounds| bounds.0 == c)
            || options.cuts.iter().any(|cut| cut.coordinate == c)
            || object.axes.iter().any(|axis| axis.coordinate == c && axis.range.is_some())
    };
    let mut picture = options.picture.clone();
    picture.axes = false;
    let palette = Palette::from_name(&picture.palette)
        .ok_or_else(|| one(usage("palette", format!("no palette is called `{}`", picture.palette))))?;
    let host = session.host.clone();
    let (graph, limits, interrupt) = (&session.graph, &session.limits, &session.interrupt);
    let shop = Workshop { graph, limits, interrupt, host: &*host, guide: super::way::Ready::Following };
    let size = size(&picture, &subject, &shop).map_err(one)?;
    let place = subject.cells(0.0);
    let solid = Solid::new(&shop, &subject, (&picture, palette, size), &place).map_err(one)?;
    let (paint, seen, camera, style) =
        solid.stand().ok_or_else(|| one(errors::not_one(&subject.name, "it is several")))?;
    let longest = (0..3).map(|k| seen.hi[k] - seen.lo[k]).fold(0.0, f64::max);
    let end = |k: usize, up: bool| {
        let [lo, hi] = subject.axes[k].range;
        let (end, room) = if up { (seen.hi[k], ROOM * longest) } else { (seen.lo[k], -ROOM * longest) };
        if given(subject.axes[k].coordinate) { (end + room).clamp(lo, hi) } else { end + room }
    };
    let space = Space { lo: [0, 1, 2].map(|k| end(k, false)), hi: [0, 1, 2].map(|k| end(k, true)) };
    Ok(Studio {
        name: subject.name.clone(),
        node: subject.node,
        inputs: subject.inputs(),
        fixed: subject.fixed.iter().map(|f| f.1).collect(),
        precision: subject.precision,
        paint: subject.painted(&paint, &place[0]),
        space,
        camera,
        style,
        notes: subject.notes,
    })
}
