//! Sharp features: volumes of polyhedra against closed forms, crease vertices on both of their surfaces, and meshes that stay closed
//! 2-manifolds with the Euler characteristic that they had.

use std::sync::Arc;

use yont::host::Memory;
use yont::interrupt::Interrupt;
use yont::limits::Limits;
use yont::model::Session;
use yont::model::request::{self, Cells, View};
use yont::surface::measure::Integrals;
use yont::surface::mesh::minus;
use yont::surface::sharp::{Sharpened, extract_as};
use yont::surface::{Extraction, Grid, Mesh, check};
use yont::syntax::Mode;
use yont::vm::{Demand, Points, Shape};

use crate::examples::{examples, loaded};
use crate::session::messages;

/// Coordinates turned off the axes, and a space about the origin whose sample points lie anywhere.
const TURNED: &str = "
    c1 = COS(0.41); s1 = SIN(0.41); c2 = COS(0.67); s2 = SIN(0.67); c3 = COS(1.13); s3 = SIN(1.13);
    g_turned((gob/pob) g) = ((g AT (x1 = c1*x1 + s1*x2, x2 = c1*x2 - s1*x1)) AT (x2 = c2*x2 + s2*x3, x3 = c2*x3 - s2*x2))
        AT (x1 = c3*x1 + s3*x3, x3 = c3*x3 - s3*x1);
    x1min = -2.03; x1max = 2.11; x2min = -2.07; x2max = 2.01; x3min = -2.05; x3max = 2.02;";

fn subject_of(session: &mut Session, resolution: usize) -> (Shape, Grid) {
    let view = View { cells: Cells::Along(resolution), ..View::default() };
    let subject = request::subject(session, &view, &Default::default()).unwrap_or_else(|told| panic!("{told:?}"));
    let shape = subject.shape(session.graph(), Demand::Sign, &Limits::default()).expect("small");
    (shape, subject.grid(view.cells, &Limits::default()).expect("a grid"))
}

fn scripted(script: &str, resolution: usize) -> (Shape, Grid) {
    let mut session = Session::new(Arc::new(Memory::default()), Limits::default(), Interrupt::default());
    let outcome = session.input("solid.geo", script, Mode::Script);
    assert!(outcome.accepted, "{script}: {}", messages(&outcome));
    subject_of(&mut session, resolution)
}

fn both(shape: &Shape, grid: &Grid) -> [Extraction; 2] {
    [false, true].map(|sharp| {
        extract_as(shape, grid, sharp, &Limits::default(), &Interrupt::default()).expect("a mesh")
    })
}

fn sharpened(extraction: &Extraction) -> &Sharpened {
    extraction.report.sharpened.as_ref().expect("it was to be sharp")
}

/// The sharp mesh, after it was held against the plain one: closed, with the same Euler characteristic and the same vertices before the new.
fn verified(name: &str, shape: &Shape, grid: &Grid) -> Extraction {
    let [plain, sharp] = both(shape, grid);
    let [before, after] = [&plain, &sharp]
        .map(|extraction| check(&extraction.mesh).unwrap_or_else(|fault| panic!("{name}: {fault}")));
    assert_eq!((before.euler, before.components), (after.euler, after.components), "{name}");
    let known = plain.mesh.positions.len();
    assert_eq!(sharp.mesh.positions[..known], plain.mesh.positions, "{name}: the old vertices stay");
    assert_eq!(sharp.mesh.normals[..known], plain.mesh.normals, "{name}: and their normals");
    assert_eq!(sharp.mesh.positions.len() - known, sharpened(&sharp).vertices, "{name}");
    assert_eq!(sharp.mesh.normals.len(), sharp.mesh.positions.len(), "{name}");
    sharp
}

const CUBE: &str = "(1 - ABS(x1)) & (1 - ABS(x2)) & (1 - ABS(x3))";

/// Name, definition, volume, Euler characteristic.
const POLYHEDRA: &[(&str, &str, f64, i64)] = &[
    ("cube", CUBE, 8.0, 2),
    ("cube of half-spaces", "(x1+1) & (1-x1) & (x2+1) & (1-x2) & (x3+1) & (1-x3)", 8.0, 2),
    ("octahedron", "1.5 - ABS(x1) - ABS(x2) - ABS(x3)", 4.5, 2),
    ("wedge", "(x3+0.7) & (x1+1) & (x2+1) & (1-x2) & (0.6 - x1 - x3)", 2.0 * 0.5 * 2.3 * 2.3, 2),
    ("block with a square hole", "((1.1-ABS(x1)) & (0.9-ABS(x2)) & (0.7-ABS(x3))) \\ ((0.5-ABS(x1)) & (0.4-ABS(x2)))", 1.4 * (2.2 * 1.8 - 0.8), 0),
    ("tetrahedron", "(1 + x1 + x2 + x3) & (1 + x1 - x2 - x3) & (1 - x1 + x2 - x3) & (1 - x1 - x2 + x3)", 8.0 / 3.0, 2),
    ("steps", "MAX(MIN(1-ABS(x1), MIN(0.9-ABS(x2), 0.3-ABS(x3+0.4))), MIN(0.4-ABS(x1-0.2), MIN(0.5-ABS(x2), 0.6-ABS(x3))))", 2.0 * 1.8 * 0.6 + 0.8 * 0.7, 2),
];

#[test]
fn polyhedra_have_their_volume() {
    for &(name, text, volume, euler) in POLYHEDRA {
        let (shape, grid) = scripted(&format!("gob_p = {text}; gob_turned = g_turned(gob_p);{TURNED}"), 64);
        let sharp = verified(name, &shape, &grid);
        let error = Integrals::of(&sharp.mesh).volume / volume - 1.0;
        let told = sharpened(&sharp);
        eprintln!("{name}: relative error {error:+.2e}, {} cells sharp, {:?} plain", told.cells, told.plain);
        assert!(error.abs() < 1e-7, "{name}: {error:e}");
        assert_eq!(told.left(), 0, "{name}");
        assert_eq!(check(&sharp.mesh).expect("closed").euler, euler, "{name}");
    }
}
