//! Boundaries by the star route: chosen where an object is proved to be a star and the route or the space allow it. Measures such objects too. Makes no search.

use crate::diagnostic::{Category, Diagnostic};
use crate::field::{Coordinate, Graph, NodeId};
use crate::interrupt::Interrupt;
use crate::limits::Limits;
use crate::model::route::{Question, Refusal, Star, point, star};
use crate::reuse::Digest;
use crate::surface::check::check;
use crate::surface::contour::Contour;
use crate::surface::figure::Figure;
use crate::surface::grid::Grid;
use crate::surface::marching::Report;
use crate::surface::measure::Measures;
use crate::surface::mesh::Mesh;
use crate::surface::sampler::Counters;
use crate::surface::star::measure::{Found, figure, solid};
use crate::surface::star::mesh::{Made, MeshError, Space, following, outline, outline_following, over};
use crate::vm::{Precision, Shape};

use super::ask::unmeasured;
use super::make::{Making, cancelled};
use super::subject::Subject;
use super::way::{Choice, Ready, Route};

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

    /// The star with its space, if the star route is to be taken. Where a centre or a guide was given in vain, that is told.
    fn placed(&mut self, node: NodeId, shape: &Shape, grid: &Grid) -> Result<Option<Placed>, Diagnostic> {
        let view = &self.options.view;
        let way = Way { route: view.route, centre: view.centre.as_deref() };
        let shop = (self.shop.graph, self.shop.limits, self.shop.interrupt);
        match placed(self.subject, (node, shape, grid), way, shop)? {
            Ok(placed) => Ok(Some(placed)),
            Err(refusal) => {
                let is_asked =
                    view.centre.is_some() || self.subject.centre.is_some() || view.guide != Choice::Following;
                let told = refusal.filter(|_| is_asked).map(|refusal| in_vain(&self.subject.name, &refusal));
                self.say(told);
                Ok(None)
            }
        }
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

/// The route that is asked for, and the centre that is given with it.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::model) struct Way<'a> {
    pub(in crate::model) route: Route,
    pub(in crate::model) centre: Option<&'a [f64]>,
}

/// The warning about an object that is shown by the other route although a centre or a guide was given.
fn in_vain(name: &str, refusal: &Refusal) -> Diagnostic {
    let title =
        format!("the centre or the guide is of no use: `{name}` is not known to be a star: {}", refusal.words());
    Diagnostic::warning("no-star", title).help("its boundary was sought by cells; `--route star` tells more")
}

/// A star with its space, if the star route is to be taken; else why not, unless it was not asked for.
fn placed(
    subject: &Subject,
    (node, shape, grid): (NodeId, &Shape, &Grid),
    Way { route, centre }: Way<'_>,
    (graph, limits, interrupt): (&Graph, &Limits, &Interrupt),
) -> Result<Result<Placed, Option<Refusal>>, Diagnostic> {
    if route == Route::Cubes {
        return Ok(Err(None));
    }
    let axes: Vec<Coordinate> = subject.axes.iter().map(|axis| axis.coordinate).collect();
    let others = subject.fixed.iter().map(|fixed| fixed.0);
    let fixed: Vec<(Coordinate, f64)> = others.zip(shape.fixed.iter().copied()).collect();
    let ranges: Vec<[f64; 2]> = subject.bounds();
    let middle: Vec<f64> = ranges.iter().map(|[lo, hi]| 0.5 * (lo + hi)).collect();
    let centre = centre.or(subject.centre.as_deref());
    if let Some(centre) = centre.filter(|centre| centre.len() != axes.len()) {
        let title = format!("the centre has {} numbers, and `{}` {} axes", centre.len(), subject.name, axes.len());
        let help = "give one number for each axis, in the order X, Y, Z";
        return Err(Diagnostic::error("wrong-centre", title).category(Category::Usage).help(help));
    }
    let told = route == Route::Star;
    let question = Question { node, axes: &axes, fixed: &fixed, centre, hint: Some(&middle), told };
    let star = match star(graph, question, limits, interrupt)? {
        Ok(star) => star,
        Err(refusal) if route == Route::Auto => return Ok(Err(Some(refusal))),
        Err(refusal) => return Err(refused(&subject.name, &refusal)),
    };
    let inside = star.gauge.centre.iter().zip(&ranges).all(|(c, [lo, hi])| lo < c && c < hi);
    if !inside {
        if route == Route::Auto {
            return Ok(Err(None));
        }
        let title = format!("the centre {} lies outside the modelling space", point(&star.gauge.centre));
        return Err(
            Diagnostic::error("wrong-centre", title).help("widen the space with --bounds, or name another centre")
        );
    }
    let length = SIDE * (0..axes.len()).map(|d| grid.cell()[d]).fold(0.0, f64::max);
    let most = (limits.memory_bytes / BYTES_PER_VERTEX).min(1 << 28);
    Ok(Ok(Placed { star, space: Space { ranges }, length, most }))
}

/// What rays tell of a star.
#[derive(Clone, Debug)]
pub(super) enum Along {
    /// In space.
    Solid(Found),
    /// In the plane.
    Plane(Box<Figure>),
}

/// What is measured of a star, and a line about the rays; nothing where they cannot measure it.
///
/// # Errors
/// If the route is asked for and cannot be taken.
pub(super) fn measured(
    subject: &Subject,
    (shape, grid): (&Shape, &Grid),
    way: Way<'_>,
    (graph, limits, interrupt): (&Graph, &Limits, &Interrupt),
) -> Result<Option<(Along, String)>, Diagnostic> {
    if shape.precision == Precision::Single {
        return Ok(None);
    }
    let Ok(placed) = placed(subject, (subject.node, shape, grid), way, (graph, limits, interrupt))? else {
        return Ok(None);
    };
    let gauge = &placed.star.gauge;
    let tell = |to: &mut Digest| {
        shape.tell(to);
        to.shown(&("rays", grid, &gauge.centre, limits.memory_bytes, limits.search_operations));
    };
    let make = || -> Result<Option<Along>, Diagnostic> {
        if subject.axes.len() == 3 {
            let found = solid(gauge, shape, grid, limits, interrupt).map_err(|error| unmeasured(&error))?;
            return Ok(found.map(Along::Solid));
        }
        let found = figure(gauge, shape, grid, interrupt).map_err(|error| unmeasured(&error.into()))?;
        Ok(found.map(|found| Along::Plane(Box::new(found))))
    };
    let found = interrupt.whole("measures", tell, |_| size_of::<Measures>(), make)?;
    if found.is_none() && way.route == Route::Star {
        let title = format!("`{}` is not measured along rays: the space cuts it, or it is too rough", subject.name);
        return Err(Diagnostic::error("not-measured", title)
            .category(Category::Result)
            .help("leave the route to `auto`: cells measure it"));
    }
    Ok(found.map(|found| {
        let points = match &found {
            Along::Solid(Found::All(all)) => all.report.samples,
            Along::Solid(Found::Integrals(found)) => found.points,
            Along::Plane(found) => found.report.samples,
        };
        (found, format!("star, {points} points on rays from {}", point(&gauge.centre)))
    }))
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
