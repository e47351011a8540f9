//! What is asked of objects through a session: where they are, how large they are, what is wrong with them; and what the answers say.

use std::sync::Arc;

use expect_test::expect_file;
use yont::diagnostic::render::{Colour, human};
use yont::diagnostic::{Diagnostic, Severity};
use yont::host::{Disk, Memory};
use yont::interrupt::Interrupt;
use yont::limits::Limits;
use yont::model::Session;
use yont::model::request::measured::Dimension;
use yont::model::request::{self, Cells, Measured, Options, Output, Precision, Route, Timing, View};
use yont::surface::estimate::Estimate;
use yont::syntax::Mode;

use crate::session::messages;

const PI: f64 = std::f64::consts::PI;

fn opened(script: &str) -> Session {
    let mut session = Session::new(Arc::new(Memory::default()), Limits::default(), Interrupt::default());
    let outcome = session.input("script.geo", script, Mode::Script);
    assert!(outcome.accepted, "{script}: {}", messages(&outcome));
    session
}

fn measured(script: &str, resolution: usize) -> Result<Measured, Vec<Diagnostic>> {
    let view = View { cells: Cells::Along(resolution), ..View::default() };
    request::measure(&mut opened(script), &view)
}

/// The modelling space of a script's last object, found where it is not given.
fn space(script: &str) -> Result<Vec<[f64; 2]>, Vec<Diagnostic>> {
    let subject = request::subject(&mut opened(script), &View::default(), &Timing::default())?;
    Ok(subject.bounds())
}

/// Scripts without a modelling space, and where the object is on each axis.
const SPACES: &[(&str, &[[f64; 2]])] = &[
    ("gob_a = 4 - x1**2 - x2**2 - x3**2;", &[[-2.0, 2.0]; 3]),
    ("gob_a = 1e-12 - x1**2 - x2**2 - x3**2;", &[[-1e-6, 1e-6]; 3]),
    ("gob_a = 1e16 - x1**2 - x2**2 - x3**2;", &[[-1e8, 1e8]; 3]),
    ("gob_a = 1 - (x1-1000)**2 - (x2+1000)**2;", &[[999.0, 1001.0], [-1001.0, -999.0]]),
    ("gob_a = 3 - ABS(x1 - 5);", &[[2.0, 8.0]]),
    ("r = 2; gob_a = (r**2-x1**2-x2**2) & x3 & 5-x3;", &[[-2.0, 2.0], [-2.0, 2.0], [0.0, 5.0]]),
    ("gob_a = 0.25 - (SQRT(x1**2+x2**2) - 2)**2 - x3**2;", &[[-2.5, 2.5], [-2.5, 2.5], [-0.5, 0.5]]),
    ("gob_a = EXP(-SQRT(x1**2+x2**2+x3**2)) - EXP(-2);", &[[-2.0, 2.0]; 3]),
    (
        "gob_b = 0.5 - ABS(x1) & 0.3 - ABS(x2) & 0.9 - ABS(x3); gob_a = gob_b AT (x1*COS(x3) + x2*SIN(x3), x2*COS(x3) - x1*SIN(x3));",
        &[[-0.583, 0.583], [-0.583, 0.583], [-0.9, 0.9]],
    ),
    ("x1min = 0; x1max = 1; gob_a = 4 - x1**2 - x2**2 - x3**2;", &[[0.0, 1.0], [-2.0, 2.0], [-2.0, 2.0]]),
    ("x1min = 0; gob_a = 4 - x1**2 - x2**2;", &[[0.0, 2.0], [-2.0, 2.0]]),
    ("x4min=0;x4max=5; gob_a = 4 - (x1-x4)**2 - x2**2;", &[[-2.0, 7.0], [-2.0, 2.0]]),
    ("gob_a : G = [0, -5]; gob_a = 4 - x1**2 - x2**2;", &[[-3.0, 3.0], [-3.0, 3.0]]),
    (
        "gob_a = UNION(i = 1 TO 300, 0.01 - (x1 - RANDOM(1, i))**2 - (x2 - RANDOM(2, i))**2);",
        &[[-0.1, 1.1], [-0.1, 1.1]],
    ),
    ("gob_a = x1**2*x2**3 - (x1**2 + x2**2 - 1)**3;", &[[-1.139, 1.139], [-1.0, 1.237]]),
    ("gob_a = 9 - FLOOR(x1*x1) - x2**2;", &[[-3.162_277_660_168_379_5, 3.162_277_660_168_379_5], [-3.0, 3.0]]),
];

#[test]
fn a_modelling_space_is_found_that_holds_the_object_closely() {
    for (script, exact) in SPACES {
        let found = space(script).unwrap_or_else(|told| panic!("{script}: {told:?}"));
        assert_eq!(found.len(), exact.len(), "{script}");
        for ([lo, hi], [from, to]) in found.iter().zip(exact.iter()) {
            let room = 0.06 * (to - from) + 1e-12;
            let is_close = |found: f64, exact: f64| found == exact || (0.0..room).contains(&found);
            assert!(is_close(from - lo, 0.0) && is_close(hi - to, 0.0), "{script}: {lo} to {hi} for {from} to {to}");
        }
    }
}

#[test]
fn an_object_without_end_is_told_with_its_directions() {
    for (script, towards) in [
        ("gob_a = x3;", "+x3"),
        ("gob_a = -x3 & 1 - x1**2;", "-x3"),
        ("gob_a = 1 - x1**2 - x2**2 @ x3;", "+x3"),
        ("gob_a = SIN(x1)*COS(x2)+SIN(x2)*COS(x3)+SIN(x3)*COS(x1);", "-x1, +x1, -x2, +x2, -x3 and +x3"),
        ("gob_a = 0.01 - ABS(x3) & 100 - x1 + 0*x2;", "-x1, -x2 and +x2"),
        ("gob_a = SIN(x1);", "-x1 and +x1"),
    ] {
        let told = space(script).expect_err(script);
        assert!(told[0].title.contains(&format!("without end towards {towards}:")), "{script}: {}", told[0].title);
    }
}

#[test]
fn what_intervals_cannot_bound_ends_in_time() {
    let scripts = [
        "gob_a = SIN(1/(x1*x2*x3)) - 0.5;",
        "gob_a = (x1 - x1)*1e300 + (x2 - x2) + x3 - x3;",
        "gob_a = 1 - x1**2 - x2**2 - x3**2 + 0.2*SIN(1/(x1 - x1 + 0.001));",
        "gob_a = MOD(x1*x2, 0.37) - 0.36 & 100 - x1**2 - x2**2;",
    ];
    for script in scripts {
        let limits = Limits { search_operations: 300_000, ..Limits::default() };
        let mut session = Session::new(Arc::new(Memory::default()), limits, Interrupt::default());
        assert!(session.input("script.geo", script, Mode::Script).accepted, "{script}");
        match request::subject(&mut session, &View::default(), &Timing::default()) {
            Ok(subject) => assert!(subject.bounds().iter().all(|[lo, hi]| lo < hi), "{script}: {:?}", subject.bounds()),
            Err(told) => assert!(["endless-object", "empty-object"].contains(&told[0].code), "{script}: {told:?}"),
        }
    }
}

/// Solids with what is known of them: volume, area, and whether the boundary is smooth.
const SOLIDS: &[(&str, &str, f64, f64)] = &[
    ("ball", "gob_a = 1 - x1**2 - x2**2 - x3**2;", 4.0 / 3.0 * PI, 4.0 * PI),
    (
        "ball off the grid",
        "gob_a = 1.7**2 - (x1-.123)**2 - (x2+.456)**2 - (x3-.789)**2;",
        20.579_526_276_115_535,
        36.316_811_075_498_01,
    ),
    (
        "box",
        "gob_a = 0.81 - ABS(x1) & 0.62 - ABS(x2) & 0.53 - ABS(x3);",
        8.0 * 0.81 * 0.62 * 0.53,
        8.0 * (0.81 * 0.62 + 0.62 * 0.53 + 0.81 * 0.53),
    ),
    ("cube", "gob_a = 1 - ABS(x1) & 1 - ABS(x2) & 1 - ABS(x3);", 8.0, 24.0),
    (
        "torus",
        "gob_a = 0.3**2 - (SQRT(x1**2 + x2**2) - 0.8)**2 - x3**2;",
        2.0 * PI * PI * 0.8 * 0.09,
        4.0 * PI * PI * 0.8 * 0.3,
    ),
    ("spheroid", "gob_a = 1 - x1**2 - x2**2 - (x3/2)**2;", 8.0 / 3.0 * PI, 21.478_435_327_883_64),
    ("Steinmetz solid", "gob_a = 1 - x1**2 - x2**2 & 1 - x1**2 - x3**2;", 16.0 / 3.0, 16.0),
    ("cone", "gob_a = 1 - x3 - SQRT(x1**2 + x2**2) & x3;", PI / 3.0, PI * (1.0 + std::f64::consts::SQRT_2)),
    (
        "cylinder",
        "gob_a = 0.7**2 - x1**2 - x2**2 & 0.8 - ABS(x3);",
        PI * 0.49 * 1.6,
        2.0 * PI * 0.49 + 2.0 * PI * 0.7 * 1.6,
    ),
    ("octahedron", "gob_a = 1 - ABS(x1) - ABS(x2) - ABS(x3);", 4.0 / 3.0, 6.928_203_230_275_509),
    ("half a ball", "x3min = 0; gob_a = 1 - x1**2 - x2**2 - x3**2;", 2.0 / 3.0 * PI, 3.0 * PI),
    ("shell", "gob_a = (1 - x1**2 - x2**2 - x3**2) & (x1**2 + x2**2 + x3**2 - 0.25);", 7.0 / 6.0 * PI, 5.0 * PI),
];

fn solid(script: &str, resolution: usize) -> yont::surface::Measures {
    match measured(script, resolution).unwrap_or_else(|told| panic!("{script}: {told:?}")).of {
        Dimension::Solid(measures, _) => *measures,
        other => panic!("{script}: {other:?}"),
    }
}

#[test]
fn measured_volumes_and_areas_are_as_near_as_they_say() {
    let (mut held, mut all, mut worst) = (0, 0, 0.0_f64);
    for &(name, script, volume, area) in SOLIDS {
        for resolution in [24, 41, 64, 90] {
            let m = solid(script, resolution);
            for (what, found, exact) in [("volume", m.volume, volume), ("area", m.area, area)] {
                let error = (found.value - exact).abs();
                all += 1;
                held += usize::from(found.holds(exact));
                worst = worst.max(error / found.error);
                eprintln!(
                    "{name} at {resolution}: {what} {found:?}, {exact} missed by {error:.2e}, {:.2} of the estimate",
                    error / found.error
                );
                assert!(found.error < 0.15 * exact, "{name} at {resolution}: {what} {found:?} says little");
            }
        }
    }
    eprintln!("{held} of {all} within their estimates, at worst {worst:.2} times it");
    assert!(held * 100 >= all * 95 && worst < 2.0, "{held} of {all}, at worst {worst} times the estimate");
}

#[test]
fn bounding_boxes_are_bounds() {
    for (script, exact) in [
        (
            "gob_a = 1.7**2 - (x1-.123)**2 - (x2+.456)**2 - (x3-.789)**2;",
            [[-1.577, 1.823], [-2.156, 1.244], [-0.911, 2.489]],
        ),
        ("gob_a = 1 - x3 - SQRT(x1**2 + x2**2) & x3;", [[-1.0, 1.0], [-1.0, 1.0], [0.0, 1.0]]),
        ("gob_a = 0.3**2 - (SQRT(x1**2 + x2**2) - 0.8)**2 - x3**2;", [[-1.1, 1.1], [-1.1, 1.1], [-0.3, 0.3]]),
    ] {
        let bounds = solid(script, 32).bounds.expect("not empty");
        for (ends, exact) in bounds.iter().zip(exact) {
            for (end, exact) in ends.iter().zip(exact) {
                assert!(end.holds(exact) && end.error < 1e-3, "{script}: {end:?} for {exact}");
            }
        }
    }
}

/// In the spaces that are found, the faces lie as far behind a sample point on all three grids: the differences tell nothing.
#[test]
fn creases_that_lie_alike_on_all_grids_do_not_pass_for_exact() {
    let script = "gob_a = (1 - x1**2) & (1 - x2**2) & (1 - x3**2);";
    for resolution in [32, 64, 128] {
        let m = solid(script, resolution);
        assert!(m.volume.holds(8.0) && m.area.holds(24.0), "{:?} {:?}", m.volume, m.area);
        assert!(m.inertia[0][0].holds(16.0 / 3.0) && m.area.error < 0.1 * 24.0, "{:?}", m.inertia);
    }
    let cone = solid("gob_a = (1 - x3 - SQRT(x1**2 + x2**2)) & x3;", 128);
    assert!(cone.area.holds(PI * (1.0 + 2.0_f64.sqrt())) && cone.volume.holds(PI / 3.0), "{:?}", cone.area);
    for resolution in [16, 32, 64, 128] {
        let Dimension::Plane(square) = measured("gob_a = (1 - x1**2) & (1 - x2**2);", resolution).expect("a square").of
        else {
            panic!("a plane figure")
        };
        assert!(square.area.holds(4.0) && square.perimeter.holds(8.0), "{:?} {:?}", square.area, square.perimeter);
    }
}

/// Mean and Gaussian curvature: least, largest, integral.
#[test]
fn curvatures_are_those_of_closed_forms() {
    let near = |found: Estimate, exact: f64, what: &str| {
        let error = (found.value - exact).abs();
        assert!(found.holds(exact) || error < 1e-6 * exact.abs().max(1.0), "{what}: {found:?} for {exact}");
        assert!(found.error < 0.1 * exact.abs().max(1.0), "{what}: {found:?} for {exact} says little");
    };
    let (outer, inner) = (1.0 / 0.3, 1.0 / 0.3);
    for (script, mean, gauss) in [
        ("gob_a = 4 - (x1-1)**2 - x2**2 - x3**2;", [0.5, 0.5, 8.0 * PI], [0.25, 0.25, 4.0 * PI]),
        (
            "gob_a = 0.3**2 - (SQRT(x1**2 + x2**2) - 0.8)**2 - x3**2;",
            [0.5 * (inner - 2.0), 0.5 * (outer + 1.0 / 1.1), 2.0 * PI * PI * 0.8],
            [-2.0 * inner, outer / 1.1, 0.0],
        ),
        ("gob_a = 0.7**2 - x1**2 - x2**2 & 0.8 - ABS(x3);", [0.0, 0.5 / 0.7, PI * 1.6], [0.0, 0.0, 0.0]),
    ] {
        let [found_mean, found_gauss] = solid(script, 64).curvature.expect("smooth parts");
        for (found, exact) in [(found_mean, mean), (found_gauss, gauss)] {
            near(found.least, exact[0], script);
            near(found.largest, exact[1], script);
            near(found.integral, exact[2], script);
        }
    }
}

#[test]
fn plane_figures_and_intervals_are_measured() {
    let Dimension::Plane(ring) =
        measured("gob_a = (1 - x1**2 - x2**2) & (x1**2 + x2**2 - 0.36);", 64).expect("a ring").of
    else {
        panic!("a plane figure")
    };
    assert!(ring.area.holds(PI * 0.64) && ring.perimeter.holds(3.2 * PI), "{ring:?}");
    assert!((ring.inertia[0][0].value - PI / 4.0 * (1.0 - 0.6_f64.powi(4))).abs() < 1e-3, "{:?}", ring.inertia);
    assert_eq!((ring.components, ring.holes), (1, 1));
    let bend = ring.curvature.expect("smooth");
    assert!((bend.least.value + 1.0 / 0.6).abs() < 1e-6 && (bend.largest.value - 1.0).abs() < 1e-6, "{bend:?}");
    assert!(bend.integral.value.abs() < 1e-2, "the hole turns the other way: {bend:?}");
    let Dimension::Line(line) = measured("gob_a = SIN(x1) - 0.5 & x1 & 10 - x1;", 1).expect("intervals").of else {
        panic!("a line")
    };
    assert_eq!(line.intervals.len(), 2);
    assert!(line.length.holds(2.0 * 2.0 * PI / 3.0) && line.length.error < 1e-9, "{line:?}");
}

/// Each script of `examples/geometry` with what is said when a mesh, or an outline, is made of it at 32 cells; `UPDATE_EXPECT=1` writes
/// the messages anew.
#[test]
fn each_kind_of_message_about_geometry() {
    let mut found = String::new();
    for (path, text) in super::diagnostics::scripts("examples/geometry") {
        let name = path.rsplit('/').next().unwrap();
        let mut session = Session::new(Arc::new(Disk), Limits::default(), Interrupt::default());
        assert!(session.input(&path, &text, Mode::Script).accepted, "{name}");
        let mut options = Options::default();
        options.view.cells = Cells::Along(32);
        options.view.route = Route::Cubes;
        let format = if text.contains("x3") { "stl" } else { "svg" };
        let output = Output::parse("-", yont::model::request::Format::by_extension(format)).unwrap();
        let told = match request::write(&mut session, &output, &options, &mut Vec::new()) {
            Ok(written) => written.notes,
            Err(told) => told,
        };
        assert!(!told.is_empty(), "{name}: nothing was said");
        found += &format!("=== {name}\n{text}--- messages\n");
        for diagnostic in &told {
            assert!(!diagnostic.help.is_empty() || !diagnostic.notes.is_empty(), "{name}: {diagnostic:?}");
            found += &human(diagnostic, session.sources(), Colour::Plain);
        }
    }
    expect_file!["diagnostics/geometry.txt"].assert_eq(&found);
}

/// Ordinary objects get no warning, whatever the resolution.
#[test]
fn ordinary_objects_give_no_false_alarm() {
    for &(name, script, ..) in SOLIDS {
        for resolution in [9, 16, 33, 64] {
            let notes = measured(script, resolution).unwrap_or_else(|told| panic!("{name}: {told:?}")).notes;
            let loud: Vec<_> = notes.iter().filter(|note| note.severity > Severity::Note).collect();
            assert!(loud.is_empty(), "{name} at {resolution}: {loud:?}");
        }
    }
}

/// Single precision gives the same object but for its last digits, and never fails where double precision does not.
#[test]
fn single_precision_is_a_preview_of_the_same_object() {
    let wild = "gob_a = IF x1*7 - FLOOR(x1*7) < 0.5 THEN 1 - x1**2 - x2**2 - x3**2 ELSE 0.7 - MAX(ABS(x1), ABS(x2), ABS(x3)); ";
    let scripts = SOLIDS.iter().map(|solid| solid.1).chain([wild]);
    for script in scripts {
        let at = |precision| {
            // Rays are measured in double precision alone.
            let route = request::Route::Cubes;
            let view = View { cells: Cells::Along(40), precision, route, ..View::default() };
            let measured =
                request::measure(&mut opened(script), &view).unwrap_or_else(|told| panic!("{script}: {told:?}"));
            let Dimension::Solid(solid, _) = measured.of else { panic!("{script}") };
            (solid.volume.value, solid.topology.components, measured.notes.iter().any(|n| n.code == "single-precision"))
        };
        let (double, single) = (at(Precision::Double), at(Precision::Single));
        assert!((double.0 - single.0).abs() < 2e-3 * double.0, "{script}: {double:?} {single:?}");
        assert_eq!((double.2, single.2), (false, true), "{script}");
    }
    let value = |precision| {
        let view = View { precision, ..View::default() };
        request::sample(&mut opened("gob_a = x1/3;"), &view, &[vec![1.0]], false).expect("a value")[0].value
    };
    assert_eq!(value(Precision::Double), 1.0 / 3.0);
    assert_eq!(value(Precision::Single), f64::from(1.0_f32 / 3.0));
}

#[test]
fn info_tells_ranges_found_and_given_and_what_products_share() {
    let script = "{ A bar }\ngob_bar = 1 - x1**2 - x2**2 @ x3 & 2 - x3;
        gob_odd = 1 - x1**2 - x2**2 @ x2 + x3;
        x1min = -3; x1max = 3;";
    let all = request::info(&mut opened(script), None).expect("two objects");
    let bar = all[0].json();
    assert_eq!(bar["name"], "gob_bar");
    assert_eq!(bar["doc"], "A bar");
    assert_eq!(bar["route"], "star");
    assert_eq!(bar["bounds"]["x1"], serde_json::json!([-3.0, 3.0]), "given");
    assert_eq!(bar["bounds"]["x3"], serde_json::json!([-0.05, 2.05]), "found");
    assert_eq!(bar["found"], serde_json::json!(["x2", "x3"]));
    assert_eq!(bar["products"][0]["shared"], serde_json::json!([]));
    let odd = all[1].json();
    assert_eq!(odd["products"][0]["shared"], serde_json::json!(["x2"]));
    assert!(odd["errors"][0].as_str().is_some_and(|told| told.contains("without end towards +x3")), "{odd}");
    let text = all[1].to_string();
    assert!(text.contains("both have x2"), "{text}");
}

/// With next to no work allowed, the space is a guess, and that is said.
#[test]
fn a_space_beyond_the_work_allowed_is_guessed() {
    for (search_operations, code) in [(300_000_000, "space-found"), (2_000, "space-guessed")] {
        let limits = Limits { search_operations, ..Limits::default() };
        let mut session = Session::new(Arc::new(Memory::default()), limits, Interrupt::default());
        assert!(session.input("script.geo", SOLIDS[1].1, Mode::Script).accepted);
        let subject = request::subject(&mut session, &View::default(), &Timing::default()).expect("a space");
        assert_eq!(subject.notes[0].code, code);
        for ([lo, hi], [from, to]) in subject.bounds().iter().zip([[-1.577, 1.823], [-2.156, 1.244], [-0.911, 2.489]]) {
            assert!(*lo < from && *hi > to, "{code}: {lo} to {hi}");
        }
    }
}
