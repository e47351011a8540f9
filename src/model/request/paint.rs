//! From `gob_a : COLOR = ...` to colours at points. Draws nothing.

use crate::diagnostic::Diagnostic;
use crate::field::Graph;
use crate::limits::Limits;
use crate::model::environment::{Colour, Tint};
use crate::model::session::Session;
use crate::picture::paint::Paint;
use crate::picture::palette::Palette;
use crate::vm::Demand;

use super::charts::telling_palette;
use super::subject::{Place, Subject};
use super::{Timing, View, ask};

impl Subject {
    /// The colour that the program gives the object, if it does, at its first frame and sections; `palette` shows single values.
    ///
    /// # Errors
    /// If it depends on a coordinate that the object does not have, or its program would be too large.
    pub fn paint(&self, graph: &Graph, palette: Palette, limits: &Limits) -> Result<Option<Paint>, Diagnostic> {
        let Some(colour) = self.colouring else { return Ok(None) };
        let known = |c| self.axes.iter().any(|a| a.coordinate == c) || self.fixed.iter().any(|f| f.0 == c);
        for node in colour.of.nodes() {
            if let Some(c) = graph.coordinates(node).iter().find(|&c| !known(c)) {
                let title =
                    format!("the colour of `{}` depends on {c}, which `{}` does not have", self.name, self.name);
                return Err(Diagnostic::error("colour-coordinate", title)
                    .at(colour.place, "")
                    .help(format!("let the colour depend on the coordinates of `{}` alone", self.name))
                    .help(format!("or let the object have it: add `+ 0*{c}` to its definition")));
            }
        }
        self.tinted(colour, graph, palette, limits).map(Some)
    }

    fn tinted(&self, colour: Colour, graph: &Graph, palette: Palette, limits: &Limits) -> Result<Paint, Diagnostic> {
        let shape = |node| self.shape_of(node, graph, Demand::Value, limits);
        let number =
            |node| graph.number(node).filter(|v| !v.is_nan()).map(|v| (v.clamp(0.0, 1.0) * 255.0).round() as u8);
        Ok(match colour.of {
            Tint::Mix([r, g, b]) => match [r, g, b].map(number) {
                [Some(r), Some(g), Some(b)] => Paint::Plain([r, g, b]),
                _ => Paint::Mix(Box::new([shape(r)?, shape(g)?, shape(b)?])),
            },
            Tint::Scale(value, ends) => {
                Paint::Scale { shape: Box::new(shape(value)?), palette: telling_palette(palette), ends }
            }
        })
    }

    /// A paint at another place, another moment say.
    #[must_use]
    pub fn painted(&self, paint: &Paint, place: &Place) -> Paint {
        paint.map(|shape| self.placed(shape, place))
    }
}

/// The colours (sRGB, each component 0 to 1) of an object at points of its space, x, y and z of each; `None` if the program gives it
/// none. Time and the like stand at their first values.
///
/// # Errors
/// Messages for the user.
pub fn colours_at(
    session: &mut Session,
    view: &View,
    palette: Palette,
    points: &[[f64; 3]],
) -> Result<Option<Vec<[f64; 3]>>, Vec<Diagnostic>> {
    let subject = ask::subject(session, view, &Timing::default())?;
    let paint = subject.paint(&session.graph, palette, &session.limits).map_err(|d| vec![d])?;
    Ok(paint.map(|paint| colours_of(&paint, points)))
}

/// The colours of a paint at points of its space, x, y and z of each; a plane figure ignores z.
#[must_use]
pub fn colours_of(paint: &Paint, points: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let axes: [Vec<f64>; 3] = [0, 1, 2].map(|k| points.iter().map(|p| p[k]).collect());
    paint.at(&[&axes[0], &axes[1], &axes[2]])
}
