//! Volumes, areas and moments against closed forms; how errors and costs change with the resolution; outlines of 2-D shapes.

use yont::interrupt::Interrupt;
use yont::limits::Limits;
use yont::model::Value;
use yont::model::request;
use yont::model::request::measured::Dimension;
use yont::model::value::Scalar;
use yont::number::Ternary;
use yont::surface::contour::{Contour, outlines};
use yont::surface::measure::Integrals;
use yont::surface::{Grid, Measures, Mesh, SurfaceError, extract, measure};
use yont::syntax::Mode;
use yont::vm::Demand;

use crate::solids::{Case, Ex, KNOWN, ball, shape_of};

const PI: f64 = std::f64::consts::PI;

fn measured(case: &Case, resolution: usize) -> Measures {
    measure(&case.shape(), &case.grid(resolution), &Limits::default(), &Interrupt::default())
        .unwrap_or_else(|error| panic!("{}: {error}", case.name))
}

fn known(name: &str) -> &'static Case {
    KNOWN.iter().find(|case| case.name == name).expect("a known solid")
}

#[test]
fn volumes_at_resolution_128_are_within_three_thousandths() {
    for case in KNOWN {
        let measures = measured(case, 128);
        let exact = case.volume.expect("known");
        let error = (measures.volume.value / exact - 1.0).abs();
        assert!(error < 0.003, "{}: {} instead of {exact}", case.name, measures.volume.value);
        assert_eq!(Some(measures.topology.euler), case.euler, "{}", case.name);
    }
}

#[test]
fn errors_of_smooth_solids_fall_with_the_square_of_the_cell() {
    for name in ["ball", "torus", "ellipsoid", "sheared ball"] {
        let (case, exact) = (known(name), known(name).volume.expect("known"));
        let error = |n| Integrals::of(&case.extract(n).mesh).volume - exact;
        for n in [32, 64] {
            let ratio = error(n) / error(2 * n);
            assert!((3.7..4.3).contains(&ratio), "{name}: errors at {n} and {} have the ratio {ratio}", 2 * n);
        }
    }
}

#[test]
fn estimates_hold_the_closed_forms() {
    for name in ["ball", "torus", "ellipsoid", "sheared ball", "Steinmetz solid"] {
        let case = known(name);
        let volume = measured(case, 64).volume;
        let error = (volume.value - case.volume.expect("known")).abs();
        assert!(error <= volume.error, "{name}: {error} above the estimate {}", volume.error);
        assert!(volume.error < 5e-3 * volume.value, "{name}: the estimate {} says nothing", volume.error);
    }
}

#[test]
fn moments_of_a_shifted_ellipsoid_are_the_closed_forms() {
    let (at, axes) = ([3.0, -2.0, 1.0], [0.9, 0.6, 0.4]);
    let field = |x: Ex, y: Ex, z: Ex| {
        ball((x - at[0]) * (1.0 / axes[0]), (y - at[1]) * (1.0 / axes[1]), (z - at[2]) * (1.0 / axes[2]))
    };
    let bounds: [[f64; 2]; 3] = std::array::from_fn(|d| [at[d] - 1.0, at[d] + 1.0]);
    let grid = Grid::new(&bounds, 100).expect("a grid");
    let measures =
        measure(&shape_of(field, 3, Demand::Sign), &grid, &Limits::default(), &Interrupt::default()).expect("a mesh");
    let mass = 4.0 / 3.0 * PI * axes[0] * axes[1] * axes[2];
    let squares = axes.map(|a| a * a);
    for d in 0..3 {
        assert!((measures.centroid[d].value - at[d]).abs() < 1e-4);
        let exact = mass / 5.0 * (squares[(d + 1) % 3] + squares[(d + 2) % 3]);
        assert!((measures.inertia[d][d].value / exact - 1.0).abs() < 5e-3, "{:?}", measures.inertia[d][d]);
        assert!(measures.inertia[d][(d + 1) % 3].value.abs() < 1e-4 * mass);
        let [lo, hi] = measures.bounds.expect("not empty")[d];
        assert!(lo.holds(at[d] - axes[d]) && hi.holds(at[d] + axes[d]), "{lo:?} {hi:?}");
        assert!(lo.error < 1e-3 && hi.error < 1e-3, "{lo:?} {hi:?}");
    }
}

#[test]
fn areas_are_those_of_closed_forms() {
    let area = |name: &str| measured(known(name), 96).area.value;
    assert!((area("ball") / (4.0 * PI) - 1.0).abs() < 2e-3);
    assert!((area("torus") / (4.0 * PI * PI * 0.8 * 0.3) - 1.0).abs() < 2e-3);
    assert!((area("the whole space") / (2.0 * (2.0 + 4.0 + 8.0)) - 1.0).abs() < 1e-12);
}

#[test]
fn nothing_has_no_volume_and_no_bounds() {
    let empty = shape_of(|x, _, _| x.constant(-1.0), 3, Demand::Sign);
    let grid = Grid::new(&[[-1.0, 1.0]; 3], 16).expect("a grid");
    let measures = measure(&empty, &grid, &Limits::default(), &Interrupt::default()).expect("an empty mesh is closed");
    assert_eq!((measures.volume.value, measures.bounds, measures.topology.components), (0.0, None, 0));
    assert_eq!(Integrals::of(&Mesh::default()), Integrals::default());
}

#[test]
fn evaluations_grow_like_the_surface() {
    for name in ["ball", "torus", "ellipsoid", "sheared ball", "Steinmetz solid"] {
        let points = |n| known(name).extract(n).report.counters.points as f64;
        let counts = [64, 128, 256].map(points);
        for pair in counts.windows(2) {
            assert!(pair[1] / pair[0] <= 4.6, "{name}: {counts:?}");
        }
    }
}

fn outline(field: fn(Ex, Ex) -> Ex, half: [f64; 2], resolution: usize) -> Contour {
    let shape = shape_of(|x, y, _| field(x, y), 2, Demand::Sign);
    let grid = Grid::new(&half.map(|h| [-h, h]), resolution).expect("a grid");
    outlines(&shape, &grid, &Limits::default(), &Interrupt::default()).expect("outlines")
}

/// Name, field, half sizes of the space, outlines, Euler characteristic, area, perimeter.
type Plane = (&'static str, fn(Ex, Ex) -> Ex, [f64; 2], usize, i64, f64, f64);

#[test]
fn outlines_have_the_area_and_the_length_of_closed_forms() {
    let cases: &[Plane] = &[
        ("disc", |x, y| 1.0 - (x.squared() + y.squared()), [1.2; 2], 1, 1, PI, 2.0 * PI),
        (
            "ring",
            |x, y| 0.04 - ((x.squared() + y.squared()).sqrt() - 0.8).squared(),
            [1.2, 1.1],
            2,
            0,
            PI * (1.0 - 0.36),
            PI * 3.2,
        ),
        ("the whole space", |x, _| x.constant(0.0), [1.0, 0.5], 1, 1, 2.0, 6.0),
        ("half of it", |x, _| x, [1.0; 2], 1, 1, 2.0, 6.0),
        ("quadrants that touch in a point", |x, y| x * y, [1.0; 2], 1, 1, 2.0, 8.0),
        ("strip", |_, y| 0.3 - y.abs(), [1.0; 2], 1, 1, 1.2, 5.2),
        (
            "disc cut at its right",
            |x, y| (1.0 - (x.squared() + y.squared())).ternary(Ternary::Intersection, &(1.0 - y.abs()), 1.0),
            [0.5, 1.2],
            1,
            1,
            PI / 3.0 + 0.75_f64.sqrt(),
            2.0 * PI / 3.0 + 4.0 * 0.75_f64.sqrt(),
        ),
        ("nothing", |x, _| x.constant(-1.0), [1.0; 2], 0, 0, 0.0, 0.0),
    ];
    for &(name, field, half, lines, euler, area, perimeter) in cases {
        let contour = outline(field, half, 200);
        assert_eq!((contour.lines.len(), contour.euler()), (lines, euler), "{name}");
        assert!((contour.area() - area).abs() < 2e-3, "{name}: area {} instead of {area}", contour.area());
        let length = contour.perimeter();
        assert!((length - perimeter).abs() < 0.03, "{name}: perimeter {length} instead of {perimeter}");
    }
}

#[test]
fn outlines_are_closed_and_their_sides_stay_in_their_cells() {
    let fields: [fn(Ex, Ex) -> Ex; 2] = [
        |x, y| (x.clone() * 7.0).sin() * (y.clone() * 5.0).cos() + (x * y * 3.0).sin(),
        |x, y| ((x * 12.9898 + y * 78.233) * 43_758.5).sin(),
    ];
    for (field, resolution) in fields.iter().flat_map(|f| [1, 2, 7, 8, 9, 50, 133].map(|n| (f, n))) {
        let contour = outline(*field, [3.0, 2.0], resolution);
        let cell = 6.0 / resolution as f64;
        let mut points: Vec<[u64; 2]> = Vec::new();
        for line in &contour.lines {
            assert!(line.len() > 2, "a closed line has at least three points");
            for (a, b) in line.iter().zip(line.iter().cycle().skip(1)) {
                assert!((a[0] - b[0]).hypot(a[1] - b[1]) <= 1.5 * cell, "a side longer than a cell's diagonal");
            }
            points.extend(line.iter().map(|p| p.map(f64::to_bits)));
        }
        let count = points.len();
        points.sort_unstable();
        points.dedup();
        assert_eq!(points.len(), count, "each point once, at {resolution}");
        assert!(contour.area() >= 0.0 && contour.area() <= 24.0);
    }
}

#[test]
fn a_solid_has_no_outline() {
    let grid = Grid::new(&[[-1.0, 1.0]; 2], 8).expect("a grid");
    let solid = shape_of(ball, 3, Demand::Sign);
    assert_eq!(
        outlines(&solid, &grid, &Limits::default(), &Interrupt::default()).err(),
        Some(SurfaceError::Dimension(3, 2))
    );
    let plane = shape_of(|x, _, _| x, 2, Demand::Sign);
    let space = Grid::new(&[[-1.0, 1.0]; 3], 8).expect("a grid");
    assert_eq!(
        extract(&plane, &space, &Limits::default(), &Interrupt::default()).err(),
        Some(SurfaceError::Dimension(2, 3))
    );
}

/// Name, script, volume, Euler characteristic, whether it is smooth.
type Text = (&'static str, &'static str, f64, i64, bool);

const SPACE: &str = "x1min = -1.4; x1max = 1.4; x2min = -1.3; x2max = 1.3; x3min = -1.2; x3max = 1.2;";

/// The known solids as texts.
const TEXTS: &[Text] = &[
    ("ball", "gob_g = 1 - x1**2 - x2**2 - x3**2;", 4.0 / 3.0 * PI, 2, true),
    (
        "box",
        "pob_box(a, b, c) = (a - x1 & a + x1) & (b - x2 & b + x2) & (c - x3 & c + x3); gob_g = pob_box(0.81, 0.62, 0.53);",
        8.0 * 0.81 * 0.62 * 0.53,
        2,
        false,
    ),
    ("torus", "gob_g = 0.3**2 - (SQRT(x1**2 + x2**2) - 0.8)**2 - x3**2;", 2.0 * PI * PI * 0.8 * 0.09, 0, true),
    ("ellipsoid", "gob_g = 1 - x1**2 - (x2/0.8)**2 - (x3/0.6)**2;", 4.0 / 3.0 * PI * 0.48, 2, true),
    ("Steinmetz solid", "gob_g = 1 - x1**2 - x2**2 & 1 - x1**2 - x3**2;", 16.0 / 3.0, 2, false),
    ("capped cylinder", "gob_g = 0.7**2 - x1**2 - x2**2 & 0.8**2 - x3**2;", PI * 0.49 * 1.6, 2, false),
    (
        "twisted bar",
        "tr_twist(g, k) = g AT (x1*COS(k*x3) + x2*SIN(k*x3), x2*COS(k*x3) - x1*SIN(k*x3));
         gob_bar = 0.5 - ABS(x1) & 0.3 - ABS(x2) & 0.9 - ABS(x3); gob_g = tr_twist(gob_bar, 1.5);",
        8.0 * 0.5 * 0.3 * 0.9,
        2,
        false,
    ),
    (
        "sheared ball",
        "gob_ball = 1 - x1**2 - x2**2 - x3**2; gob_g = gob_ball AT (x1 = x1 - 0.5*x3);",
        4.0 / 3.0 * PI,
        2,
        true,
    ),
];

/// Volume, Euler characteristic and evaluated points of a script's object.
fn of_text(script: &str, resolution: usize) -> (f64, i64, u64) {
    let mut session = crate::session::session();
    let outcome = session.input("solid.geo", &format!("{script}\n{SPACE}"), Mode::Script);
    assert!(outcome.accepted, "{script}\n{}", crate::session::messages(&outcome));
    let view = request::View { cells: request::Cells::Along(resolution), ..request::View::default() };
    let measured = request::measure(&mut session, &view).unwrap_or_else(|told| panic!("{script}\n{told:?}"));
    let Dimension::Solid(measures, _) = measured.of else { panic!("{script} is no solid") };
    (measures.volume.value, measures.topology.euler, measures.report.counters.points)
}

#[test]
fn scripts_measure_as_their_closed_forms_and_cost_as_their_surface() {
    for &(name, script, volume, euler, smooth) in TEXTS {
        let found = [64, 128].map(|resolution| of_text(script, resolution));
        let errors = found.map(|(value, ..)| value / volume - 1.0);
        let growth = found[1].2 as f64 / found[0].2 as f64;
        eprintln!(
            "{name}: volume {:.6}, {:+.6} % of {volume:.6}, Euler characteristic {}, {growth:.2} times the points",
            found[1].0,
            100.0 * errors[1],
            found[1].1
        );
        assert!(errors[1].abs() < 0.003, "{name}: {} instead of {volume}", found[1].0);
        assert_eq!(found.map(|f| f.1), [euler; 2], "{name}");
        assert!(growth <= 4.6, "{name}: {found:?}");
        assert!(!smooth || errors[1].abs() < 2e-5, "{name}: extrapolated, errors {errors:?}");
    }
}

/// [P95] 5 tells of 0.2e-15 at a boundary point of one of many spheres joined by (4).
#[test]
fn the_union_of_ten_thousand_spheres_is_zero_on_their_boundaries() {
    let script = "n = 10000; r = 0.1;
        gob_all = UNION(i = 1 TO n, r**2 - (x1 - 10*RANDOM(1, i))**2 - (x2 - 10*RANDOM(2, i))**2 - (x3 - 10*RANDOM(3, i))**2);
        c = ARRAY(i = 1 TO n, ARRAY(k = 1 TO 3, 10*RANDOM(k, i)));";
    let mut session = crate::session::session();
    let outcome = session.input("spheres.geo", script, Mode::Script);
    assert!(outcome.accepted, "{}", crate::session::messages(&outcome));
    let Some(Ok(Value::Array(rows))) = session.value("c") else { panic!("c is an array") };
    let number = |value: &Value| match value {
        Value::Scalar(Scalar::Number(n)) => *n,
        other => panic!("{other:?}"),
    };
    let centres: Vec<Vec<f64>> = rows
        .items()
        .iter()
        .map(|row| match row {
            Value::Array(row) => row.items().iter().map(number).collect(),
            other => panic!("{other:?}"),
        })
        .collect();
    // The points of the first two hundred spheres in some direction that lie in no other sphere.
    let points: Vec<Vec<f64>> = (0..200)
        .map(|i| {
            let (a, b) = (i as f64, 0.5 + i as f64 * 0.7);
            let way = [a.sin() * b.cos(), a.sin() * b.sin(), a.cos()];
            (0..3).map(|d| centres[i][d] + 0.1 * way[d]).collect::<Vec<f64>>()
        })
        .enumerate()
        .filter(|(i, p)| {
            let within = |c: &Vec<f64>| (0..3).map(|d| (p[d] - c[d]).powi(2)).sum::<f64>() < 0.1001_f64.powi(2);
            centres.iter().enumerate().all(|(j, c)| *i == j || !within(c))
        })
        .map(|(_, p)| p)
        .collect();
    assert!(points.len() > 50, "{} points are on the boundary of the union", points.len());
    let values = request::sample(&mut session, &request::View::default(), &points, false).expect("values");
    let worst = values.iter().map(|s| s.value.abs()).fold(0.0, f64::max);
    let mean = values.iter().map(|s| s.value.abs()).sum::<f64>() / values.len() as f64;
    eprintln!("{} boundary points of {} spheres: at most {worst:e}, {mean:e} on average", points.len(), centres.len());
    assert!(worst < 1e-14, "{worst:e}");
}
