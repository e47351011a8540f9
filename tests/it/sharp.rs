//! Sharp features: volumes of polyhedra against closed forms, crease vertices on both of their surfaces, and meshes that stay closed
//! 2-manifolds with the Euler characteristic that they had.

use std::sync::Arc;

use yont::host::Memory;
use yont::interrupt::Interrupt;
use yont::limits::Limits;
use yont::model::Session;
use yont::model::request::{self, Cells, View};
use yont::surface::measure::Integrals;
use yont::surface::sharp::{Sharpened, extract_as, outlines_as};
use yont::surface::{Extraction, Grid, Mesh, check};
use yont::syntax::Mode;
use yont::vm::{Demand, Shape};

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
    [false, true]
        .map(|sharp| extract_as(shape, grid, sharp, &Limits::default(), &Interrupt::default()).expect("a mesh"))
}

fn sharpened(extraction: &Extraction) -> &Sharpened {
    extraction.report.sharpened.as_ref().expect("it was to be sharp")
}

/// The sharp mesh, after it was held against the plain one: closed, with the same Euler characteristic but for the small balls that sampling
/// tore off, and the same vertices before the new.
fn verified(name: &str, shape: &Shape, grid: &Grid) -> Extraction {
    let [plain, sharp] = both(shape, grid);
    let [before, after] =
        [&plain, &sharp].map(|extraction| check(&extraction.mesh).unwrap_or_else(|fault| panic!("{name}: {fault}")));
    let torn = sharpened(&sharp).torn;
    assert_eq!((before.euler - 2 * torn as i64, before.components - torn), (after.euler, after.components), "{name}");
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
    ("wedge", "(x3+0.7) & (x1+1) & (x2+0.5) & (0.5-x2) & (0.6 - x1 - x3)", 0.5 * 2.3 * 2.3, 2),
    (
        "block with a square hole",
        "((1.1-ABS(x1)) & (0.9-ABS(x2)) & (0.7-ABS(x3))) \\ ((0.5-ABS(x1)) & (0.4-ABS(x2)))",
        1.4 * (2.2 * 1.8 - 0.8),
        0,
    ),
    ("tetrahedron", "(1 + x1 + x2 + x3) & (1 + x1 - x2 - x3) & (1 - x1 + x2 - x3) & (1 - x1 - x2 + x3)", 8.0 / 3.0, 2),
    (
        "steps",
        "MAX(MIN(1-ABS(x1), MIN(0.9-ABS(x2), 0.3-ABS(x3+0.4))), MIN(0.4-ABS(x1-0.2), MIN(0.5-ABS(x2), 0.6-ABS(x3))))",
        2.0 * 1.8 * 0.6 + 0.8 * 0.7,
        2,
    ),
];

#[test]
fn polyhedra_have_their_volume() {
    for &(name, text, volume, euler) in POLYHEDRA {
        let (shape, grid) = scripted(&format!("gob_p = {text}; gob_turned = g_turned(gob_p);{TURNED}"), 64);
        let sharp = verified(name, &shape, &grid);
        let [plain, _] = both(&shape, &grid);
        let [before, after] = [&plain, &sharp].map(|e| Integrals::of(&e.mesh).volume / volume - 1.0);
        let told = sharpened(&sharp);
        eprintln!("{name}: {before:+.2e} plain, {after:+.2e} sharp, {} cells, {:?} left", told.cells, told.plain);
        let (bound, left) = if name == "steps" { (2e-5, 2) } else { (1e-9, 0) };
        assert!(after.abs() < bound, "{name}: {before:e} plain, {after:e} sharp");
        assert!(told.left() <= left, "{name}: {told:?}");
        // Sampling tears thin edges, which are whole again.
        assert_eq!(check(&sharp.mesh).expect("closed").euler, euler, "{name}");
    }
}

#[test]
fn vertices_of_creases_lie_on_both_surfaces() {
    // A cylinder cut by a plane across it: the new vertices are on both, but for those that are moved off a grid line.
    let script =
        format!("gob_c = (1.21 - x1**2 - x2**2) & (0.8 - x3) & (x3 + 0.9); gob_turned = g_turned(gob_c);{TURNED}");
    let (shape, grid) = scripted(&script, 64);
    let [plain, _] = both(&shape, &grid);
    let sharp = verified("cylinder", &shape, &grid);
    let cell = grid.cell().into_iter().fold(0.0, f64::max);
    let turn = |[x, y, z]: [f64; 3]| {
        let (c, s) = ([0.41_f64, 0.67, 1.13].map(f64::cos), [0.41_f64, 0.67, 1.13].map(f64::sin));
        let (x, z) = (c[2] * x + s[2] * z, c[2] * z - s[2] * x);
        let (y, z) = (c[1] * y + s[1] * z, c[1] * z - s[1] * y);
        [c[0] * x + s[0] * y, c[0] * y - s[0] * x, z]
    };
    let new = &sharp.mesh.positions[plain.mesh.positions.len()..];
    assert!(new.len() > 200, "{} vertices", new.len());
    for &place in new {
        let [x, y, z] = turn(place);
        let (side, end) = (x.hypot(y) - 1.1, (z - 0.8).abs().min((z + 0.9).abs()));
        assert!(side.abs().max(end) < 1.5e-6 * cell, "{place:?}: {side:e} and {end:e}");
    }
}

/// The CSG object of Fig. 6 of the 1995 paper, and the distances of a place from its surfaces.
const FIG_6: &str = "r_alpha = 1.;
    pob_block_3D(a0,b0,c0,a,b,c) = (x1-a0 & a0+a-x1) & (x2-b0 & b0+b-x2) & (x3-c0 & c0+c-x3);
    gob_bl1  = pob_block_3D(-9.,-8.,-9.,18.,16.,18.);
    gob_cyl1 = ((r1**2-x1**2-x3**2) & 10.5-x2) & x2+10.5;
    gob_cyl2 = r2**2-x1**2-x2**2;
    gob_bl2  = (x2+d1 & d1-x2) & (x3+d1 & d1-x3);
    gob_csg  = ((gob_bl1 | gob_cyl1) \\ gob_cyl2) \\ gob_bl2;
    r1 = 4.; r2 = 6.; d1 = 5.;
    x1min = -11.; x1max = 11.; x2min = -11.; x2max = 11.; x3min = -11.; x3max = 11.;";

fn from_fig_6([x, y, z]: [f64; 3]) -> Vec<f64> {
    let planes = [x.abs() - 9.0, y.abs() - 8.0, z.abs() - 9.0, y.abs() - 10.5, y.abs() - 5.0, z.abs() - 5.0];
    planes.into_iter().chain([x.hypot(z) - 4.0, x.hypot(y) - 6.0]).collect()
}

/// The distances of a place from the surfaces of the drilled, rounded part of `examples/40_sharp.geo`.
fn from_part([x, y, z]: [f64; 3]) -> Vec<f64> {
    let rounded = (x.abs() - 1.6).max(0.0).hypot((y.abs() - 0.8).max(0.0)) - 0.4;
    let planes = [z, z - 0.5, z - 1.4, y.abs() - 0.15, x + 1.7, x - 0.8, (y - 0.7).abs() - 0.25, (x + 1.1).abs() - 0.5];
    let slope = (1.55 + 0.6 * (x - 1.0) - z) / 1.36_f64.sqrt();
    let axis = (x - 0.8).hypot(y);
    planes.into_iter().chain([rounded, slope, axis - 0.8, axis - 0.45]).collect()
}

#[test]
fn creases_of_drilled_solids_lie_on_both_surfaces() {
    type Distances = fn([f64; 3]) -> Vec<f64>;
    let part = examples().into_iter().find(|(name, _)| name.contains("40_sharp")).expect("the example").1;
    for (name, script, distances) in [("Fig. 6", FIG_6, from_fig_6 as Distances), ("part", &part, from_part)] {
        let (shape, grid) = scripted(script, 64);
        let sharp = verified(name, &shape, &grid);
        let [plain, _] = both(&shape, &grid);
        let told = sharpened(&sharp);
        assert!(told.cells > 500 && told.left() == 0, "{name}: {told:?}");
        let cell = grid.cell().into_iter().fold(0.0, f64::max);
        let mut worst = 0.0_f64;
        for &place in &sharp.mesh.positions[plain.mesh.positions.len()..] {
            let mut from: Vec<f64> = distances(place).into_iter().map(f64::abs).collect();
            from.sort_by(f64::total_cmp);
            worst = worst.max(from[1]);
        }
        eprintln!("{name}: {} cells sharp, crease vertices within {:.1e} of a cell", told.cells, worst / cell);
        assert!(worst < 1e-6 * cell, "{name}: {worst:e}");
    }
}

/// Name, definition, corners.
const FIGURES: &[(&str, &str, &[[f64; 2]])] = &[
    (
        "turned square",
        "(1 - ABS(0.8*x1 + 0.6*x2)) & (1 - ABS(0.8*x2 - 0.6*x1))",
        &[[0.2, 1.4], [1.4, -0.2], [-0.2, -1.4], [-1.4, 0.2]],
    ),
    ("square by MAX", "1 - MAX(ABS(x1), ABS(x2))", &[[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]]),
    (
        "star",
        "POLYGON([0,0.35,1.42,0.55,0.9,0,-0.9,-0.55,-1.4,-0.35], [1.5,0.47,0.43,-0.2,-1.25,-0.6,-1.25,-0.2,0.45,0.45])",
        &[
            [0.0, 1.5],
            [0.35, 0.47],
            [1.42, 0.43],
            [0.55, -0.2],
            [0.9, -1.25],
            [0.0, -0.6],
            [-0.9, -1.25],
            [-0.55, -0.2],
            [-1.4, 0.45],
            [-0.35, 0.45],
        ],
    ),
    ("needle", "POLYGON([-1.3, 1.7, -1.2], [-0.2, 0.03, 0.1])", &[[-1.3, -0.2], [1.7, 0.03], [-1.2, 0.1]]),
    (
        "chamfered",
        "(1 - ABS(x1)) & (1 - ABS(x2)) & (1.95 - x1 - x2)",
        &[[1.0, 0.95], [0.95, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]],
    ),
    ("ring", "(1.5 - ABS(x1) - ABS(x2)) \\ (0.5 - MAX(x1, -x1, x2, -x2))", &[[1.5, 0.0], [0.5, 0.5], [-0.5, 0.5]]),
];

#[test]
fn outlines_have_their_corners() {
    for &(name, text, corners) in FIGURES {
        for resolution in [23, 40, 101] {
            let space = "x1min = -2.03; x1max = 2.11; x2min = -2.07; x2max = 2.01;";
            let (shape, grid) = scripted(&format!("gob_f = {text}; {space}"), resolution);
            let [plain, sharp] = [false, true].map(|sharp| {
                outlines_as(&shape, &grid, sharp, &Limits::default(), &Interrupt::default()).expect("outlines")
            });
            let told = sharp.report.sharpened.as_ref().expect("it was to be sharp");
            let count = |lines: &[Vec<[f64; 2]>]| lines.iter().map(Vec::len).sum::<usize>();
            eprintln!("{name} at {resolution}: {told:?}");
            assert_eq!(told.left(), 0, "{name} at {resolution}: {told:?}");
            if told.torn == 0 {
                assert_eq!(count(&plain.lines) + told.vertices, count(&sharp.lines), "{name} at {resolution}");
            }
            for [x, y] in corners {
                let far = |&[a, b]: &[f64; 2]| (a - x).hypot(b - y);
                let nearest = sharp.lines.iter().flatten().map(far).fold(f64::INFINITY, f64::min);
                assert!(nearest < 1e-9, "{name} at {resolution}: {nearest:e} from [{x}, {y}]");
            }
            if name != "ring" {
                let sides = corners.iter().zip(corners.iter().cycle().skip(1));
                let area = 0.5 * sides.map(|([a, b], [c, d])| a * d - b * c).sum::<f64>().abs();
                assert!((sharp.area() / area - 1.0).abs() < 1e-9, "{name} at {resolution}: {} {area}", sharp.area());
            }
        }
    }
}

#[test]
fn smooth_solids_stay_as_they_are() {
    for text in [
        "1 - x1**2 - x2**2 - x3**2",
        "SIN(3*x1) + COS(2*x2) - x3",
        "0.5 - SQRT(MAX(ABS(x1)-1, 0)**2 + MAX(ABS(x2)-0.8, 0)**2 + MAX(ABS(x3)-0.6, 0)**2)",
    ] {
        let (shape, grid) = scripted(&format!("gob_s = {text};{TURNED}"), 40);
        let [plain, sharp] = both(&shape, &grid);
        assert_eq!(plain.mesh, sharp.mesh, "{text}: {:?}", sharp.report.sharpened);
    }
}

/// Whole numbers that look random.
fn noise(seed: u64) -> impl FnMut(u64) -> u64 {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) + 1;
    move |below| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) % below
    }
}

/// Blocks, balls and cylinders, some of them aligned and with common faces, joined at random.
fn random_script(seed: u64) -> String {
    let mut pick = noise(seed);
    let mut text = format!("r_alpha = {};\ngob_0 = 1.2 - ABS(x1) - ABS(x2)/2 - ABS(x3);\n", pick(2));
    for k in 1..6 {
        let [a, b, c] = std::array::from_fn(|_| pick(9) as f64 * 0.25 - 1.0);
        let size = pick(4) as f64 * 0.17 + 0.2;
        let part = match pick(4) {
            0 => format!("{size} - SQRT((x1-({a}))**2 + (x2-({b}))**2 + (x3-({c}))**2)"),
            1 => format!("({size} - ABS(x1-({a})) & {size} - ABS(x2-({b})) & {size} - ABS(x3-({c})))"),
            2 => format!("({size}**2 - (x1-({a}))**2 - (x3-({c}))**2 & {size} - ABS(x2-({b})))"),
            _ => format!("IF x1 > ({a}) THEN {size} - ABS(x2-({b})) ELSE {size} - ABS(x2-({b})) + x1 - ({a})"),
        };
        let join = ["|", "&", "\\", "|"][pick(4) as usize];
        text += &format!("g_{k} = {part};\ngob_{k} = gob_{} {join} g_{k};\n", k - 1);
    }
    let last = if pick(2) == 0 { "gob_last = g_turned(gob_5);" } else { "gob_last = gob_5;" };
    format!("{text}{last}{TURNED}")
}

#[test]
fn random_solids_stay_closed_with_the_euler_characteristic_that_they_had() {
    for seed in 0..200 {
        let (shape, grid) = scripted(&random_script(seed), 20);
        verified(&format!("solid {seed}"), &shape, &grid);
    }
}

#[test]
fn examples_stay_closed_with_the_euler_characteristic_that_they_had() {
    for (name, text) in examples() {
        let (mut session, _) = loaded(&name, &text);
        let Ok(subject) = request::subject(&mut session, &View::default(), &Default::default()) else { continue };
        if subject.axes.len() == 3 {
            let (shape, grid) = subject_of(&mut session, 24);
            verified(&name, &shape, &grid);
        }
    }
}

#[test]
fn any_number_of_threads_gives_the_same_bytes() {
    let (shape, grid) = scripted(&random_script(3), 40);
    let meshes: Vec<Mesh> = [1, 3]
        .into_iter()
        .map(|threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
            pool.install(|| both(&shape, &grid)[1].mesh.clone())
        })
        .collect();
    assert!(meshes[0] == meshes[1]);
}
