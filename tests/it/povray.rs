//! Scenes for POV-Ray: every operation as a function of its language, shared parts computed once, slopes that hold, and what is a mesh alone.

use yont::model::request::{self, Cells, Options, Output, Route, Timing};
use yont::syntax::Mode;

use crate::readback::{compare_functions, pov};

const SPACE: &str = "x1min = -2; x1max = 2; x2min = -2; x2max = 2; x3min = -2; x3max = 2;";

fn options() -> Options {
    let mut options = Options::default();
    (options.view.cells, options.view.route) = (Cells::Along(12), Route::Cubes);
    options
}

/// The scene that a script gives, with the checks of its functions.
fn scene(script: &str, options: &Options) -> (String, pov::Scene) {
    let mut session = crate::session::session();
    let outcome = session.input("a.geo", &format!("{script} {SPACE}"), Mode::Script);
    assert!(outcome.accepted, "{script}: {:?}", outcome.diagnostics);
    let output = Output::parse("a.pov", None).expect("an output");
    let output = Output { target: request::Target::Standard, ..output };
    let mut bytes = Vec::new();
    request::write(&mut session, &output, options, &mut bytes).unwrap_or_else(|told| panic!("{script}: {told:?}"));
    let scene = pov::read(&bytes);
    if options.view.beside.is_empty() {
        let subject = request::subject(&mut session, &options.view, &Timing::default()).expect("a subject");
        compare_functions(script, &scene, &subject, &mut session);
    }
    (String::from_utf8(bytes).expect("text"), scene)
}

/// Functions of the coordinates, each with a boundary in the space, that are formulas.
const FORMULAS: &[&str] = &[
    "1 - x1**2 - x2**2 - x3**2",
    "1 - x1**4 - x2**6 - ABS(x3)**3",
    "(1 - x1**2 - x2**2) | (0.5 - x2**2 - x3**2)",
    "(1 - x1**2 - x2**2) & (1.5 - x2**2 - x3**2)",
    "(1 - x1**2 - x2**2 & 1 - ABS(x3)) \\ (0.2 - x1**2 - x3**2)",
    "1.5 - SQRT(x1**2 + x2**2 + x3**2)",
    "1.5 - SQRT(x1**2 + 4*x2**2 + x3**2 + 0.01)",
    "0.5 - HYPOT(HYPOT(x1, x2) - 1, x3)",
    "x3 - SQRT(x1**2 + x2**2)",
    "1 - PNORM(PNORM(x1, x2, 5)/0.8, x3/0.8, 3)",
    "PNORM(1 + x1**2, 2 - x2, -2) - 0.9 - x3**2/9",
    "MIN(1 - x1, MAX(x2, x3), 1 + x1)",
    "SIN(2*x1)*COS(2*x2) + SIN(2*x2)*COS(2*x3) + SIN(2*x3)*COS(2*x1)",
    "EXP(-x1**2 - x2**2) - 0.5 + x3/9",
    "LOG(2.5 + x1) - x2**2 - x3**2 + LOG10(3 + x2)",
    "ASIN(x1/3) + ACOS(x2/3) + ATAN(x3) - 1",
    "SINH(x1/2) + COSH(x2/2) + TANH(x3) - 1.2",
    "ASINH(x1) + ACOSH(4 + x2) + ATANH(x3/3) - 2",
    "TAN(x1/2) + CBRT(x2 + 3) - 1 - x3**2",
    "(2.5 + x1)**(1 + x2/4) - 2 - x3**2",
    "SIN(3*ATAN2(x2, x1 + 5)) + 0.5 - x3**2",
    "IF x1 < 0 THEN 1 - x1**2 - x2**2 - x3**2 ELSE 1 - x2**2 - x3**2 - x1**2/4",
    "IF (x1 < 0 AND x2 >= 0 OR NOT x3 <= 0) THEN 1 - x1**2 ELSE 1 - x1**2 - 0*x2",
    "0.3 - (MOD(x1 + 2.2, 0.5) - 0.25)**2*0 - x2**2 - x3**2",
    "1 - x1**2 - x2**2 - x3**2 + 0*SIGN(x1 - 1.9)",
    "(1 - x1**2 - x2**2 - x3**2) AT (x1 + x2/3, x2*COS(x3) - x1*SIN(x3), x3)",
    "1e-3*(1 - x1**2 - x2**2 - x3**2)",
    "1e9 - 1e9*x1**2 - 3e8*x2**2 - 1e9*x3**2",
];

#[test]
fn every_operation_is_a_function_of_the_same_values_and_its_slope_holds() {
    for formula in FORMULAS {
        for system in ["r_alpha = 0;", "r_alpha = 0.5;", "r_alpha = -0.3;", "r_alpha = 1;", "r_m = 2;"] {
            if system != "r_alpha = 0;" && !formula.contains(['|', '&', '\\']) {
                continue;
            }
            let (text, scene) = scene(&format!("{system} gob_a = {formula};"), &options());
            assert_eq!(
                scene.isosurfaces.len(),
                1,
                "{system} {formula} is a formula:\n{}",
                &text[..text.len().min(3000)]
            );
        }
    }
}

#[test]
fn shared_parts_are_computed_once_and_long_chains_do_not_nest() {
    // Each step reads the one before twice: without sharing there were 2^60 terms.
    let steps: String =
        (1..=60).map(|k| format!("f{k} = f{0}*SIN(f{0})/2 + f{0}/3 + x{1}/9;", k - 1, k % 3 + 1)).collect();
    let (text, scene) = self::scene(&format!("f0 = x1; {steps} gob_a = 0.1 - f60 - x2**2 - x3**2;"), &options());
    assert_eq!(scene.isosurfaces.len(), 1);
    assert_eq!(text.matches("sin(").count(), 60);
    let balls = "gob_a = UNION(k = 1 TO 400, 0.2 - (x1 - SIN(k))**2 - (x2 - COS(3*k))**2 - (x3 - SIN(7*k))**2);";
    let deepest = |text: &str| {
        let declared = text.lines().filter(|line| line.starts_with("#declare") || line.starts_with("  "));
        let mut deepest = (0i32, 0i32);
        for c in declared.flat_map(|line| line.chars()) {
            deepest.0 += i32::from(c == '(') - i32::from(c == ')');
            deepest.1 = deepest.1.max(deepest.0);
        }
        deepest.1
    };
    let (text, scene) = self::scene(balls, &options());
    assert_eq!(scene.isosurfaces.len(), 1);
    assert!(deepest(&text) < 60, "{} brackets", deepest(&text));
}

#[test]
fn what_is_no_formula_is_a_mesh_alone_and_says_why() {
    let cases = [
        ("gob_a = PROJECT(1 - x1**2 - x2**2 - x3**2 - x5**2, x5, 0, 1);", "(PROJECT)"),
        ("gob_a = OFFSET_BALL(1 - x1**2 - x2**2 - x3**2, 0.1);", "(OFFSET_BALL)"),
        (
            "gob_a = STAR([[[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]]], 4, 4);",
            "is data, which is no formula",
        ),
        ("r = x1; WHILE (r < 3) DO r = r + 1 + x2**2; gob_a = 9 - r - x3**2;", "a loop that runs at each point"),
        ("gob_a = SQRT(x1) - x2**2 - x3**2;", "may be undefined"),
        ("gob_a = FLOOR(x1*2) - x2 - x3;", "no bound was found"),
        ("gob_a = CBRT(x1) - x2/9;", "no bound was found"),
        ("gob_a = 1.2 - PNORM(x1, x2, 0.7) - x3**2;", "no bound was found"),
        ("gob_a = 1 - x1**2 - x2**2 - x3**2; gob_a : COLOR = x1 IN [-1, 1];", "a palette"),
    ];
    for (script, why) in cases {
        let (text, scene) = scene(script, &options());
        let comment =
            text.lines().find(|line| line.contains("a mesh alone, since")).unwrap_or_else(|| panic!("{script}"));
        assert!(scene.isosurfaces.is_empty() && comment.contains(why), "{script}: {comment}");
    }
}

#[test]
fn a_pole_far_from_the_boundary_is_cut_off() {
    let (text, scene) = scene("gob_a = 1/(x1**2 + x2**2 + x3**2) - 1;", &options());
    assert_eq!(scene.isosurfaces.len(), 1);
    assert!(text.contains("function { min(") && scene.isosurfaces[0].1.max_gradient < 20.0, "{text}");
}

#[test]
fn a_scene_of_several_objects_has_their_colours_and_the_camera_of_a_picture() {
    let script = "gob_a = 1 - (x1 + 1)**2 - x2**2 - x3**2; gob_b = 0.8 - (x1 - 1)**2 - x2**2 - x3**2;
        gob_a : COLOR = [1, 0.5, 0]; gob_b : COLOR = [0.5 + x1/4, 0.25, x3**2/4];";
    let mut options = options();
    (options.view.object, options.view.beside) = (Some("gob_a".into()), vec!["gob_b".into()]);
    let (_, scene) = scene(script, &options);
    assert_eq!((scene.read.meshes.len(), scene.isosurfaces.len()), (2, 2));
    assert_eq!(scene.read.colours[0], vec![[255, 128, 0]]);
    let (_, b) = &scene.isosurfaces[1];
    for (at, colour) in scene.read.meshes[1].1.positions.iter().zip(&scene.read.colours[1]) {
        let wanted = [0.5 + at[0] / 4.0, 0.25, at[2] * at[2] / 4.0].map(|c| (255.0 * c).round());
        assert!((0..3).all(|k| (f64::from(colour[k]) - wanted[k]).abs() <= 1.0), "{colour:?}, not {wanted:?}");
        let light = scene.colour(b, *at);
        let bright = |v: f64| if v <= 0.04045 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) };
        let must = [0.5 + at[0] / 4.0, 0.25, at[2] * at[2] / 4.0].map(bright);
        assert!((0..3).all(|k| (light[k] - must[k]).abs() < 1e-9), "{light:?}, not {must:?}");
    }
    // All that is seen lies within a picture of 4 to 3: with this camera the place (u, v) is a part of right and up.
    let [eye, forward, right, up] = scene.camera;
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    for p in scene.read.meshes.iter().flat_map(|(_, mesh)| &mesh.positions) {
        let towards = std::array::from_fn(|k| p[k] - eye[k]);
        let depth = dot(towards, forward);
        let [u, v] = [right, up].map(|axis| dot(towards, axis) / dot(axis, axis) / depth);
        assert!(depth > 0.0 && u.abs() < 0.5 * 4.0 / 3.0 && v.abs() < 0.5, "{p:?} is at {u}, {v}");
    }
    let turn = std::array::from_fn(|k| right[(k + 1) % 3] * up[(k + 2) % 3] - right[(k + 2) % 3] * up[(k + 1) % 3]);
    assert!(dot(turn, forward) < 0.0, "the picture is no mirror image");
}

#[test]
fn sections_and_moments_are_numbers_in_the_functions() {
    let script =
        "gob_a = 1 + x4/4 - x1**2 - x5*x2**2 - x3**2; x5 : CONSTANT = 2; x4min = 0; x4max = 1; x4_delta = 0.5;";
    for at in [0.0, 1.0] {
        let mut options = options();
        options.view.at = vec![(request::Coordinate(4), at)];
        let (_, scene) = scene(script, &options);
        let value = scene.value(&scene.isosurfaces[0].1, [0.5, 0.25, 0.0]);
        assert!((value + 1.0 + at / 4.0 - 0.25 - 0.125).abs() < 1e-12, "{value} at {at}");
    }
}
