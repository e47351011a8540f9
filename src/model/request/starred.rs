//! Boundaries by the star route: chosen where an object is proved to be a star and the route or the space allow it. Makes no search.

use crate::diagnostic::{Category, Diagnostic};
use crate::field::{Coordinate, NodeId};
use crate::model::route::{Question, Refusal, Star, point, star};
use crate::surface::check::check;
use crate::surface::contour::Contour;
use crate::surface::grid::Grid;
use crate::surface::marching::Report;
use crate::surface::mesh::Mesh;
use crate::surface::sampler::Counters;
use crate::surface::star::mesh::{Made, MeshError, Space, following, outline, outline_following, over};
use crate::vm::Shape;

use super::make::{Making, cancelled};
use super::way::{Ready, Route};

/// Bytes for each vertex of a mesh and what makes it.
const BYTES_PER_VERTEX: usize = 400;
/// The longest side of a triangle in cells: with it there are about as many vertices as cubes would give.
const SIDE: f64 = 1.15;

/// A star and the space that it is shown in.
struct Placed {
    star: Star,
    space: Space,
    length: f64,
    most: usize,
}

impl Making<'_> {
    /// The boundary of a solid by the star route; nothing where the other route is to be taken.
    pub(super) fn star_mesh(
        &mut self,
        node: NodeId,
        shape: &Shape,
        grid: &Grid,
    ) -> Result<Option<(Mesh, String, Report)>, Diagnostic> {
        let Some(placed) = self.placed(node, shape, grid)? else { return Ok(None) };
        let interrupt = self.shop.interrupt;
        let phase = interrupt.phase("star");
        let gauge = &placed.star.gauge;
        let made = match &self.shop.guide {
            Ready::Solid(guide) => over(gauge, &placed.space, guide, !self.is_bare(), interrupt),
            Ready::Following => following(gauge, &placed.space, placed.length, placed.most, interrupt),
            Ready::Polygon(_) => return Err(wrong_guide("a polygon", "a plane figure")),
        };
        let Some(made) = self.made(made)? else { return Ok(None) };
        drop(phase);
        let topology = match check(&made.boundary) {
            Ok(topology) => topology,
            Err(_) if self.options.view.route == Route::Auto => return Ok(None),
            Err(fault) => {
                let title = format!("the mesh of `{}` has a fault: {fault}", self.subject.name);
                return Err(Diagnostic::error("mesh-fault", title)
                    .category(Category::Result)
                    .help("nothing was written; another --guide or --resolution avoids it, or --route cubes"));
            }
        };
        let line = format!(
            "{} triangles, Euler characteristic {}, {} points on rays from {}",
            topology.triangles,
            topology.euler,
            made.points,
            point(&gauge.centre)
        );
        let report = report(&made);
        Ok(Some((made.boundary, line, report)))
    }

    /// The outline of a plane figure by the star route; nothing where the other route is to be taken.
    pub(super) fn star_outline(
        &mut self,
        node: NodeId,
        shape: &Shape,
        grid: &Grid,
    ) -> Result<Option<Contour>, Diagnostic> {
        let Some(placed) = self.placed(node, shape, grid)? else { return Ok(None) };
        let (gauge, interrupt) = (&placed.star.gauge, self.shop.interrupt);
        let made = match &self.shop.guide {
            Ready::Polygon(directions) => outline(gauge, &placed.space, directions, interrupt),
            Ready::Following => outline_following(gauge, &placed.space, placed.length, placed.most, interrupt),
            Ready::Solid(_) => return Err(wrong_guide("a solid", "a solid")),
        };
        let made = self.made(made)?;
        Ok(made.map(|made| Contour { report: report(&made), lines: vec![made.boundary] }))
    }

    /// The star with its space, if the star route is to be taken.
    fn placed(&self, node: NodeId, shape: &Shape, grid: &Grid) -> Result<Option<Placed>, Diagnostic> {
        let route = self.options.view.route;
        if route == Route::Cubes {
            return Ok(None);
        }
        let axes: Vec<Coordinate> = self.subject.axes.iter().map(|axis| axis.coordinate).collect();
        let others = self.subject.fixed.iter().map(|fixed| fixed.0);
        let fixed: Vec<(Coordinate, f64)> = others.zip(shape.fixed.iter().copied()).collect();
        let ranges: Vec<[f64; 2]> = self.subject.bounds();
        let middle: Vec<f64> = ranges.iter().map(|[lo, hi]| 0.5 * (lo + hi)).collect();
        let centre = self.options.view.centre.as_deref().or(self.subject.centre.as_deref());
        if let Some(centre) = centre.filter(|centre| centre.len() != axes.len()) {
            let title =
                format!("the centre has {} numbers, and `{}` {} axes", centre.len(), self.subject.name, axes.len());
            let help = "give one number for each axis, in the order X, Y, Z";
            return Err(Diagnostic::error("wrong-centre", title).category(Category::Usage).help(help));
        }
        let question = Question { node, axes: &axes, fixed: &fixed, centre, hint: Some(&middle) };
        let star = match star(self.shop.graph, question, self.shop.limits, self.shop.interrupt)? {
            Ok(star) => star,
            Err(_) if route == Route::Auto => return Ok(None),
            Err(refusal) => return Err(refused(&self.subject.name, &refusal)),
        };
        let inside = star.gauge.centre.iter().zip(&ranges).all(|(c, [lo, hi])| lo < c && c < hi);
        if !inside {
            if route == Route::Auto {
                return Ok(None);
            }
            let title = format!("the centre {} lies outside the modelling space", point(&star.gauge.centre));
            return Err(
                Diagnostic::error("wrong-centre", title).help("widen the space with --bounds, or name another centre")
            );
        }
        let length = SIDE * (0..axes.len()).map(|d| grid.cell()[d]).fold(0.0, f64::max);
        let most = (self.shop.limits.memory_bytes / BYTES_PER_VERTEX).min(1 << 28);
        Ok(Some(Placed { star, space: Space { ranges }, length, most }))
    }

    /// What was made, unless the route is free and the other one is better: it closes exactly what the space cuts.
    fn made<S>(&self, made: Result<Made<S>, MeshError>) -> Result<Option<Made<S>>, Diagnostic> {
        let free = self.options.view.route == Route::Auto;
        match made {
            Ok(made) if free && made.cut.iter().flatten().any(|cut| *cut) => Ok(None),
            Ok(made) => Ok(Some(made)),
            Err(MeshError::Cancelled) => Err(cancelled()),
            Err(_) if free => Ok(None),
            Err(MeshError::Memory) => {
                let title = format!("`{}` would take more memory than there may be", self.subject.name);
                Err(Diagnostic::error("too-much-memory", title).category(Category::Result).help("lower --resolution"))
            }
            Err(MeshError::Direction(v)) => {
                let title = format!("the gauge of `{}` overflows towards {}", self.subject.name, point(&v));
                Err(Diagnostic::error("no-star", title).help("leave the route to `auto`"))
            }
        }
    }
}

/// The message about an object for which the star route was asked and that is none.
fn refused(name: &str, refusal: &Refusal) -> Diagnostic {
    refusal.diagnostic(name, None)
}

fn wrong_guide(what: &str, of: &str) -> Diagnostic {
    Diagnostic::error("bad-guide", format!("{what} is a guide shape of {of}, which this is not"))
        .category(Category::Usage)
        .help("a solid has sphere:5 and others, a plane figure polygon:64")
}

fn report<S>(made: &Made<S>) -> Report {
    let counters = Counters { points: made.points, ..Counters::default() };
    Report { counters, samples: made.points, cut: made.cut, ..Report::default() }
}
