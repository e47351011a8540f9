//! Star and cube routes show one shape: every object of every example that the star route is taken for, by both routes. `--nocapture` shows the
//! table.

use yont::data::Context;
use yont::data::mesh;
use yont::data::obj::Surface;
use yont::field::Coordinate;
use yont::interrupt::Interrupt;
use yont::limits::Limits;
use yont::model::Session;
use yont::model::request::measured::Dimension;
use yont::model::request::subject::Subject;
use yont::model::request::{self, Cells, Options, View};
use yont::model::route::{Question, Star, star};
use yont::number::Leaf;
use yont::surface::contour::{Contour, outlines};
use yont::surface::measure::Integrals;
use yont::surface::star::mesh::{Space, following, outline_following};
use yont::surface::{Mesh, check, extract};
use yont::vm::{Demand, Points, Shape};

use crate::examples::{examples, loaded};

/// Cells along the longest side of the space.
const CELLS: usize = 48;

/// What the two routes show of an object.
struct Compared {
    /// The largest |f| at a vertex of the star route, as a share of its largest value at the centre and twice as far.
    residual: f64,
    /// How far a vertex of one route is from the boundary of the other, in cells: star from cubes, cubes from star.
    apart: [f64; 2],
    /// Volume, or area of a plane figure, by the star route and by cubes.
    inside: [f64; 2],
    /// What a strip of one cell along the boundary holds.
    strip: f64,
    vertices: [usize; 2],
}

/// The subject of a name and its star, if the free route would take it.
fn taken(session: &mut Session, name: &str) -> Option<(Subject, Shape, Star)> {
    let (limits, interrupt) = (Limits::default(), Interrupt::default());
    let view = View { object: Some(name.to_owned()), ..View::default() };
    let subject = request::subject(session, &view, &Options::default().timing).ok()?;
    if !(2..=3).contains(&subject.axes.len()) || !subject.levels.is_empty() {
        return None;
    }
    let axes: Vec<Coordinate> = subject.axes.iter().map(|axis| axis.coordinate).collect();
    let middle: Vec<f64> = subject.bounds().iter().map(|[lo, hi]| 0.5 * (lo + hi)).collect();
    let question = Question {
        node: subject.node,
        axes: &axes,
        fixed: &subject.fixed,
        centre: subject.centre.as_deref(),
        hint: Some(&middle),
        told: false,
    };
    let star = star(session.graph(), question, &limits, &interrupt).expect("nobody stops it").ok()?;
    let inside = star.gauge.centre.iter().zip(subject.bounds()).all(|(c, [lo, hi])| lo < *c && *c < hi);
    let shape = subject.shape(session.graph(), Demand::Sign, &limits).expect("a shape");
    inside.then_some((subject, shape, star))
}

fn residual<const N: usize>(session: &Session, subject: &Subject, star: &Star, at: &[[f64; N]]) -> f64 {
    let shape = subject.shape(session.graph(), Demand::Value, &Limits::default()).expect("a shape");
    let values = |by: f64| {
        let c = &star.gauge.centre;
        let mut columns: Vec<Vec<f64>> =
            (0..N).map(|d| at.iter().map(|p| c[d] + by * (p[d] - c[d])).collect()).collect();
        columns.extend(shape.fixed.iter().map(|&value| vec![value; at.len()]));
        let columns: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
        let mut out = vec![0.0; at.len()];
        Points::new().eval(&shape.program, &columns, &mut out);
        out
    };
    let sizes = [values(0.0), values(2.0)];
    let size = |k: usize| sizes.iter().map(|of| of[k].abs()).filter(|s| s.is_finite()).fold(1e-300, f64::max);
    values(1.0).iter().enumerate().map(|(k, f)| f.abs() / size(k)).fold(0.0, f64::max)
}

/// The largest distance of some points from the boundary of a mesh.
fn farthest(points: &[[f64; 3]], from: &Mesh) -> f64 {
    let surface = Surface { positions: from.positions.clone(), triangles: from.triangles.clone() };
    let context = Context { limits: &Limits::default(), interrupt: &Interrupt::default() };
    let (solid, _) = mesh::solid("a", surface, context).expect("a solid");
    points.iter().map(|p| solid.value(p).abs()).fold(0.0, f64::max)
}

fn solids(session: &Session, (subject, shape, star): &(Subject, Shape, Star)) -> Option<Compared> {
    let (limits, interrupt) = (Limits::default(), Interrupt::default());
    let grid = subject.grid(Cells::Along(CELLS), &limits).expect("a grid");
    let cell = grid.cell()[..3].iter().copied().fold(0.0, f64::max);
    let space = Space { ranges: subject.bounds() };
    let made = following(&star.gauge, &space, 1.15 * cell, 1 << 22, &interrupt).expect("a mesh");
    if made.cut.iter().flatten().any(|cut| *cut) {
        return None;
    }
    let (own, cubes) = (made.boundary, extract(shape, &grid, &limits, &interrupt).expect("a mesh").mesh);
    assert_eq!(check(&own).unwrap_or_else(|fault| panic!("{}: {fault}", subject.name)).euler, 2, "{}", subject.name);
    let of = [&own, &cubes].map(Integrals::of);
    Some(Compared {
        residual: residual(session, subject, star, &own.positions),
        apart: [farthest(&own.positions, &cubes) / cell, farthest(&cubes.positions, &own) / cell],
        inside: of.map(|of| of.volume),
        strip: of[0].area * cell,
        vertices: [&own, &cubes].map(|mesh| mesh.positions.len()),
    })
}

/// The length of a side.
fn side(line: &[[f64; 2]], k: usize) -> f64 {
    let ([a, b], [c, d]) = (line[k], line[(k + 1) % line.len()]);
    (c - a).hypot(d - b)
}

/// The largest distance of the points of some lines from others.
fn away(points: &[Vec<[f64; 2]>], from: &[Vec<[f64; 2]>]) -> f64 {
    let side = |p: [f64; 2], a: [f64; 2], b: [f64; 2]| {
        let (u, v) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
        let along = ((u[0] * v[0] + u[1] * v[1]) / (u[0] * u[0] + u[1] * u[1])).clamp(0.0, 1.0);
        let along = if along.is_nan() { 0.0 } else { along };
        (v[0] - along * u[0]).hypot(v[1] - along * u[1])
    };
    let nearest = |p: [f64; 2]| {
        let sides = from.iter().flat_map(|line| (0..line.len()).map(|k| (line[k], line[(k + 1) % line.len()])));
        sides.map(|(a, b)| side(p, a, b)).fold(f64::INFINITY, f64::min)
    };
    points.iter().flatten().map(|p| nearest(*p)).fold(0.0, f64::max)
}

fn figures(session: &Session, (subject, shape, star): &(Subject, Shape, Star)) -> Option<Compared> {
    let (limits, interrupt) = (Limits::default(), Interrupt::default());
    let grid = subject.grid(Cells::Along(CELLS), &limits).expect("a grid");
    let cell = grid.cell()[..2].iter().copied().fold(0.0, f64::max);
    let space = Space { ranges: subject.bounds() };
    let made = outline_following(&star.gauge, &space, 1.15 * cell, 1 << 22, &interrupt).expect("an outline");
    if made.cut.iter().flatten().any(|cut| *cut) {
        return None;
    }
    let squares = outlines(shape, &grid, &limits, &interrupt).expect("outlines");
    let own = Contour { lines: vec![made.boundary], report: squares.report.clone() };
    Some(Compared {
        residual: residual(session, subject, star, &own.lines[0]),
        apart: [away(&own.lines, &squares.lines) / cell, away(&squares.lines, &own.lines) / cell],
        inside: [&own, &squares].map(Contour::area),
        strip: (0..own.lines[0].len()).map(|k| side(&own.lines[0], k)).sum::<f64>() * cell,
        vertices: [&own, &squares].map(|contour| contour.lines.iter().map(Vec::len).sum()),
    })
}

#[test]
fn star_and_cube_routes_agree_on_every_example() {
    println!(
        "example                  object               residual  apart (cells)     volume or area, ratio - 1   vertices"
    );
    let (mut solid, mut plane) = (0, 0);
    for (file, text) in examples() {
        let (mut session, _) = loaded(&file, &text);
        for name in session.objects() {
            let Some(found) = taken(&mut session, &name) else { continue };
            let is_solid = found.0.axes.len() == 3;
            let compared = if is_solid { solids(&session, &found) } else { figures(&session, &found) };
            let Some(of) = compared else { continue };
            *(if is_solid { &mut solid } else { &mut plane }) += 1;
            println!(
                "{file:24} {name:20} {:8.1e}  {:5.2}  {:5.2}  {:14.6} {:10.1e}   {:7} {:7}",
                of.residual,
                of.apart[0],
                of.apart[1],
                of.inside[0],
                of.inside[0] / of.inside[1] - 1.0,
                of.vertices[0],
                of.vertices[1]
            );
            assert!(of.residual < 1e-12, "{file} {name}: a residual of {:e}", of.residual);
            // Cubes cut creases off, which the star route shows.
            assert!(of.apart[0] < 1.0 && of.apart[1] < 0.25, "{file} {name}: {:?} cells apart", of.apart);
            let more = (of.inside[0] - of.inside[1]).abs() / of.strip;
            assert!(more < 0.15, "{file} {name}: {more} of a cell along the boundary");
        }
    }
    assert!(solid >= 20 && plane >= 5, "{solid} solids and {plane} figures");
}

/// Gamma of a quarter and of three quarters, which the volume of `x^4 + y^4 + z^4 <= 1` has.
const GAMMA: [f64; 2] = [3.625_609_908_221_908, 1.225_416_702_465_177_6];

/// Stars, whether creases are to be shown as they are, the route that measures them, and in closed form volume, surface, a coordinate of the
/// centre and an entry of the inertia.
fn closed_forms() -> Vec<(&'static str, bool, &'static str, [f64; 4])> {
    let pi = std::f64::consts::PI;
    // An ellipsoid of revolution with half axes 1, 1, 2.
    let e = 0.75_f64.sqrt();
    let spheroid = 2.0 * pi * (1.0 + 2.0 / e * e.asin());
    let quartic = GAMMA[0].powi(3) / 8.0 / (0.75 * GAMMA[1]);
    vec![
        ("1 - x1^2 - x2^2 - x3^2", true, "star", [4.0 / 3.0 * pi, 4.0 * pi, 0.0, 8.0 / 15.0 * pi]),
        (
            "4 - (x1 - 30)^2 - x2^2 - (x3 + 5)^2",
            false,
            "star",
            [32.0 / 3.0 * pi, 16.0 * pi, 30.0, 32.0 / 3.0 * pi * 8.0 / 5.0],
        ),
        ("1 - x1^2 - x2^2 - x3^2/4", true, "star", [8.0 / 3.0 * pi, spheroid, 0.0, 8.0 / 3.0 * pi]),
        ("1 - x1^4 - x2^4 - x3^4", true, "star", [quartic, f64::NAN, 0.0, f64::NAN]),
        ("1 - ABS(x1) & 1 - ABS(x2) & 1 - ABS(x3)", true, "star", [8.0, 24.0, 0.0, 16.0 / 3.0]),
        ("1 - x1 & 1 + x1 & 1 - x2 & 0.3 + x2 & 1 - x3 & 1 + x3", true, "cubes", [5.2, 18.4, 0.0, f64::NAN]),
        ("1 - x1 & 1 + x1 & 1 - x2 & 0.3 + x2 & 1 - x3 & 1 + x3", false, "star", [5.2, 18.4, 0.0, f64::NAN]),
        ("1 - x1^2 - x2^2", true, "star", [pi, 2.0 * pi, 0.0, pi / 4.0]),
        ("1 - x1 & 0.5 + x1 & 1 - x2 & 0.3 + x2", true, "star", [1.95, 5.6, 0.25, 1.95 * 1.69 / 12.0]),
    ]
}

#[test]
fn measures_along_rays_are_the_closed_forms() {
    for (text, sharp, route, exact) in closed_forms() {
        let (mut session, _) = loaded("a.geo", &format!("gob_a = {text};"));
        let view = View { sharp, cells: Cells::Along(64), ..View::default() };
        let measured = request::measure(&mut session, &view).unwrap_or_else(|e| panic!("{text}: {e:?}"));
        assert_eq!(measured.route.split(',').next(), Some(route), "{text}");
        let found = match &measured.of {
            Dimension::Solid(m, _) => [m.volume, m.area, m.centroid[0], m.inertia[0][0]],
            Dimension::Plane(f) => [f.area, f.perimeter, f.centroid[0], f.inertia[0][0]],
            Dimension::Line(_) => panic!("{text} is no line"),
        };
        println!("{text}: {}", measured.route);
        for (found, exact) in found.iter().zip(exact).filter(|(_, exact)| !exact.is_nan()) {
            println!("    {exact:.12} {:9.1e} {:9.1e}", found.value - exact, found.error);
            assert!(found.holds(exact), "{text}: {found:?}, not {exact}");
            let rough = if sharp { 1e-7 } else { 1e-2 };
            assert!(found.error < rough * exact.abs().max(1.0), "{text}: {found:?} says little");
        }
    }
}
