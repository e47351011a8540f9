//! Scenes for POV-Ray: the meshes of a moment, with the functions of those objects that are formulas, before the camera and in the light of
//! a picture. Finds no boundary.

use std::collections::BTreeSet;

use crate::diagnostic::Diagnostic;
use crate::export::pov::{Formula, Scene, Thing};
use crate::field::Coordinate;
use crate::model::environment::{Colour, Tint};
use crate::model::povray::{self, Functions, Reason};
use crate::picture::camera::Camera;
use crate::picture::legend::solid_colour;
use crate::picture::palette::Palette;
use crate::picture::raycast::{GROUND, Style};
use crate::picture::shade::Lights;
use crate::picture::{Paint, Projection};

use super::Background;
use super::boundaries::Body;
use super::make::{Making, cancelled};
use super::pictures::view;
use super::subject::Subject;

/// Width by height of the picture for which the camera is set up.
const ASPECT: f64 = 4.0 / 3.0;

impl Making<'_> {
    /// The scene of the bodies at a moment.
    pub(super) fn scene<'b>(&mut self, bodies: &'b [Body], moment: f64) -> Result<Scene<'b>, Diagnostic> {
        let picture = &self.options.picture;
        let palette = Palette::from_name(&picture.palette).unwrap_or_default();
        let mut helpers = BTreeSet::new();
        let mut things = Vec::with_capacity(bodies.len());
        for (k, body) in bodies.iter().enumerate() {
            let one = self.subject.all().nth(body.place).unwrap_or(self.subject);
            let plain = if bodies.len() > 1 { solid_colour(body.place) } else { palette.solid() };
            let colour = match self.shown(one, palette)? {
                Some(Paint::Plain(colour)) => colour,
                _ => plain,
            };
            let formula = match self.formula(one, moment, k + 1, &mut helpers) {
                Err(Reason::Cancelled) => return Err(cancelled()),
                other => other.map_err(|reason| reason.to_string()),
            };
            // What is everywhere of one colour needs no list of colours.
            let part = body.part();
            let one_colour = part.colours.is_some_and(|all| all.iter().all(|c| *c == colour));
            let colours = part.colours.filter(|_| !one_colour);
            things.push(Thing { part: crate::export::Part { colours, ..part }, colour, formula });
        }
        let points: Vec<[f64; 3]> = bodies.iter().flat_map(|body| body.mesh.positions.iter().copied()).collect();
        let mut view = view(picture)?;
        if picture.parallel == Some(true) && view.projection != Projection::Orthographic {
            let range = |k: usize| self.subject.axes[k].range;
            view = view.level([0, 1, 2].map(|k| 0.5 * (range(k)[0] + range(k)[1])));
        }
        let camera = Camera::framing(&view, &points, ASPECT);
        let fill = if picture.fill { 1.0 } else { 0.0 };
        Ok(Scene {
            name: &bodies[0].name,
            helpers: povray::helpers(&helpers),
            things,
            camera,
            aspect: (ASPECT * 1e4).round() / 1e4,
            lights: Lights::new(&camera, picture.light.map(|angles| angles.map(f64::to_radians)), fill),
            fill,
            shadow: if picture.shadow { Style::default().shadow } else { 0.0 },
            background: match picture.background {
                Some(Background::Colour(colour)) => Some(colour),
                Some(Background::Transparent) => None,
                // The mean of what is brighter above.
                None => Some(std::array::from_fn(|k| GROUND[0][k] / 2 + GROUND[1][k] / 2)),
            },
        })
    }

    fn shown(&self, one: &Subject, palette: Palette) -> Result<Option<Paint>, Diagnostic> {
        one.paint(self.shop.graph, palette, self.shop.limits)
    }

    /// The function of an object.
    fn formula(
        &self,
        one: &Subject,
        moment: f64,
        number: usize,
        helpers: &mut BTreeSet<&'static str>,
    ) -> Result<Formula, Reason> {
        let _phase = self.shop.interrupt.phase("formula");
        let (graph, limits) = (self.shop.graph, self.shop.limits);
        let mut fixed = one.fixed.clone();
        for (coordinate, value) in &mut fixed {
            if one.time.as_ref().is_some_and(|time| time.coordinate == *coordinate) {
                *value = moment;
            }
        }
        let axes: [Coordinate; 3] = std::array::from_fn(|k| one.axes[k].coordinate);
        let place = povray::Place { graph, axes, fixed };
        let [lo, hi] = [0, 1].map(|end| std::array::from_fn(|k| one.axes[k].range[end]));
        let prefix = format!("Yont_{number}");
        let found = povray::isosurface(&place, one.node, &prefix, (lo, hi), limits, self.shop.interrupt)?;
        let mut declarations = found.functions.declarations;
        helpers.extend(found.functions.helpers);
        let colours = match one.colouring {
            Some(Colour { of: Tint::Mix(nodes), .. }) if nodes.iter().any(|node| graph.number(*node).is_none()) => {
                let (Functions { declarations: more, helpers: called }, values) =
                    povray::colours(&place, nodes, &prefix, limits)?;
                declarations += &more;
                helpers.extend(called);
                Some(values)
            }
            // A palette is a table of colours, and no formula.
            Some(Colour { of: Tint::Scale(..), .. }) => return Err(Reason::Palette),
            _ => None,
        };
        let (gradient, within) = (found.steepness.most, found.steepness.within);
        Ok(Formula { declarations, name: found.name, lo, hi, gradient, within, colours })
    }
}
