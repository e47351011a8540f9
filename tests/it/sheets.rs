//! SCATTER, HEIGHT and FIT: against surfaces and parameters that are known, bounds, and bad input.

use std::sync::Arc;

use yont::data::Context;
use yont::data::sheet::Sheet;
use yont::data::sheet::height::{self, HeightError};
use yont::data::sheet::scatter::{self, ScatterError};
use yont::host::Memory;
use yont::interrupt::Interrupt;
use yont::limits::Limits;
use yont::model::{Event, Session};
use yont::number::{Interval, Leaf};
use yont::syntax::Mode;

use crate::conformance::Random;
use crate::session::messages;

fn scattered(points: &[[f64; 2]], values: &[f64], smooth: f64, n: [usize; 2]) -> Result<Arc<Sheet>, ScatterError> {
    let limits = Limits { memory_bytes: 100 << 20, ..Limits::default() };
    scatter::sheet(points, values, smooth, n, Context { limits: &limits, interrupt: &Interrupt::default() })
}

fn surface([x, y]: [f64; 2]) -> f64 {
    (6.0 * x).sin() * (5.0 * y).cos() + x * y
}

fn cloud(count: usize) -> (Vec<[f64; 2]>, Vec<f64>) {
    let mut random = Random(11);
    let mut points: Vec<[f64; 2]> = vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
    points.extend((4..count).map(|_| [random.between(0.0, 1.0), random.between(0.0, 1.0)]));
    let values = points.iter().map(|p| surface(*p)).collect();
    (points, values)
}

#[test]
fn the_error_of_scatter_falls_as_the_grid_is_refined() {
    let (points, values) = cloud(8_000);
    let error = |n: usize| {
        let sheet = scattered(&points, &values, 0.0, [n, n]).expect("a sheet");
        let places = (0..=40).flat_map(|i| (0..=40).map(move |j| [f64::from(i) / 40.0, f64::from(j) / 40.0]));
        let squares: Vec<f64> = places.map(|p| (sheet.value(&p) - surface(p)).powi(2)).collect();
        (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
    };
    let errors = [4, 8, 16, 32].map(error);
    // Quadratic splines: the error falls with the third power of the elements' size.
    for pair in errors.windows(2) {
        assert!(pair[1] < pair[0] / 5.0, "{errors:?}");
    }
    assert!(errors[3] < 1e-4, "{errors:?}");
}

#[test]
fn scatter_keeps_planes_and_ignores_units_and_smooths_noise() {
    let (points, _) = cloud(50);
    let plane = |p: &[f64; 2]| 3.0 - 2.0 * p[0] + 0.5 * p[1];
    let values: Vec<f64> = points.iter().map(plane).collect();
    for smooth in [0.0, 1e-6, 1.0] {
        let sheet = scattered(&points, &values, smooth, [7, 12]).expect("a sheet");
        for p in [[0.1, 0.9], [0.5, 0.5], [0.99, 0.01]] {
            assert!((sheet.value(&p) - plane(&p)).abs() < 1e-6, "{smooth}: {p:?} {}", sheet.value(&p));
        }
    }
    // A thousand times as wide and a million times as high is the same function.
    let mut random = Random(2);
    let values: Vec<f64> = points.iter().map(|p| surface(*p) + random.between(-0.1, 0.1)).collect();
    let wide: Vec<[f64; 2]> = points.iter().map(|p| p.map(|c| 1e3 * c + 1e4)).collect();
    let high: Vec<f64> = values.iter().map(|v| 1e6 * v).collect();
    let (one, other) = (scattered(&points, &values, 1e-5, [9, 9]), scattered(&wide, &high, 1e-5, [9, 9]));
    let (one, other) = (one.expect("a sheet"), other.expect("a sheet"));
    for p in [[0.2, 0.3], [0.7, 0.6]] {
        assert!((one.value(&p) - 1e-6 * other.value(&p.map(|c| 1e3 * c + 1e4))).abs() < 1e-8);
    }
    // Much smoothness leaves the plane that fits best.
    let smooth = scattered(&points, &values, 1e3, [9, 9]).expect("a sheet");
    let bend = smooth.value(&[0.0, 0.0]) - 2.0 * smooth.value(&[0.5, 0.5]) + smooth.value(&[1.0, 1.0]);
    assert!(bend.abs() < 1e-3, "{bend}");
}

#[test]
fn points_that_make_no_surface() {
    let (points, values) = cloud(20);
    let with = |k: usize, p: [f64; 2], v: f64| {
        let (mut points, mut values) = (points.clone(), values.clone());
        (points[k], values[k]) = (p, v);
        scattered(&points, &values, 1e-6, [4, 4]).map(|_| ())
    };
    assert_eq!(with(5, points[9], values[9]), Ok(()), "the same point twice is one point");
    assert_eq!(with(5, points[9], 7.0), Err(ScatterError::Coincident([6, 10])));
    assert_eq!(with(5, [f64::NAN, 0.0], 7.0), Err(ScatterError::NotFinite(6)));
    assert_eq!(with(5, [0.5, 0.5], f64::INFINITY), Err(ScatterError::NotFinite(6)));
    assert_eq!(with(5, [1e300, 0.5], 1.0), Err(ScatterError::NotFinite(6)));
    let made = |points: &[[f64; 2]], n: usize| scattered(points, &vec![1.0; points.len()], 1e-6, [n, n]).map(|_| ());
    assert_eq!(made(&points[..2], 4), Err(ScatterError::TooFew(2)));
    assert_eq!(made(&[], 4), Err(ScatterError::TooFew(0)));
    assert_eq!(made(&[[0.1, 0.2], [0.2, 0.4], [0.3, 0.6], [0.4, 0.8]], 4), Err(ScatterError::Flat));
    assert_eq!(made(&[[1.0, 2.0]; 5], 4), Err(ScatterError::Flat));
    assert_eq!(made(&[[1.0, 2.0], [1.0, 3.0], [1.0, 5.0]], 4), Err(ScatterError::Flat));
    assert!(matches!(made(&points, 5_000), Err(ScatterError::TooLarge { .. })));
    assert!(matches!(made(&points, usize::MAX), Err(ScatterError::TooLarge { .. })));
    assert_eq!(made(&points, 1), Ok(()));
}

/// Gray picture of 8 bits.
fn png(width: u32, height: u32, colour: png::ColorType, data: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(colour);
    encoder.set_depth(png::BitDepth::Eight);
    let mut writer = encoder.write_header().expect("memory");
    writer.write_image_data(data).expect("memory");
    writer.finish().expect("memory");
    bytes
}

fn picture(bytes: &[u8]) -> Result<Arc<Sheet>, HeightError> {
    let limits = Limits { memory_bytes: 16 << 20, ..Limits::default() };
    height::sheet("a.png", bytes, Context { limits: &limits, interrupt: &Interrupt::default() })
}

#[test]
fn a_picture_lies_over_the_unit_square_the_right_way_up() {
    let ramp: Vec<u8> = (0..20).flat_map(|j| (0..30).map(move |i| (5 * i + 2 * (19 - j)) as u8)).collect();
    let sheet = picture(&png(30, 20, png::ColorType::Grayscale, &ramp)).expect("a picture");
    // A ramp stays a ramp within: pixel i has its middle at (i + 1/2)/30.
    for (x, y) in [(0.5, 0.5), (0.2, 0.8), (0.9, 0.1)] {
        let right = (5.0 * (30.0 * x - 0.5) + 2.0 * (20.0 * y - 0.5)) / 255.0;
        assert!((sheet.value(&[x, y]) - right).abs() < 1e-12, "{x} {y}: {} {right}", sheet.value(&[x, y]));
    }
    assert_eq!(sheet.value(&[-3.0, 0.5]), sheet.value(&[0.0, 0.5]));
    assert_eq!(sheet.value(&[0.5, f64::INFINITY]), sheet.value(&[0.5, 1.0]));
    assert!(sheet.value(&[f64::NAN, 0.5]).is_nan());
    // Colours by how bright they look, transparent ones as dark.
    let bright = |colour, data: &[u8]| picture(&png(1, 1, colour, data)).expect("a picture").value(&[0.3, 0.7]);
    assert!((bright(png::ColorType::Rgb, &[0, 255, 0]) - 0.7152).abs() < 1e-12);
    assert!((bright(png::ColorType::Rgba, &[255, 255, 255, 51]) - 0.2).abs() < 1e-12);
    assert!((bright(png::ColorType::GrayscaleAlpha, &[255, 0])).abs() < 1e-12);
}

#[test]
fn sheets_have_bounds_and_slopes() {
    let mut random = Random(8);
    let noise: Vec<u8> = (0..24 * 17).map(|_| random.below(256) as u8).collect();
    let (points, values) = cloud(300);
    let sheets = [
        picture(&png(24, 17, png::ColorType::Grayscale, &noise)).expect("a picture"),
        scattered(&points, &values, 1e-7, [13, 9]).expect("a sheet"),
    ];
    for sheet in sheets {
        for _ in 0..500 {
            let wide = 10_f64.powf(random.between(-4.0, 0.5));
            let over: Vec<Interval> = (0..2)
                .map(|_| {
                    let lo = random.between(-0.5, 1.2);
                    Interval::new(lo, lo + wide * random.between(0.0, 1.0))
                })
                .collect();
            let bounds = sheet.bounds(&over);
            let slopes = [0, 1].map(|axis| sheet.slope_bounds(axis, &over));
            for _ in 0..20 {
                let p = [random.between(over[0].lo, over[0].hi), random.between(over[1].lo, over[1].hi)];
                let mut slope = [0.0; 2];
                let value = sheet.gradient(&p, &mut slope);
                assert!(value == sheet.value(&p) && bounds.contains(value), "{p:?} {value} {bounds:?}");
                for axis in 0..2 {
                    assert!(slopes[axis].contains(slope[axis]), "{p:?} {slope:?} {slopes:?}");
                    let step = |h: f64| {
                        let mut q = p;
                        q[axis] += h;
                        sheet.value(&q)
                    };
                    let steep = slopes[axis].hi.abs().max(slopes[axis].lo.abs()).max(1.0);
                    let near = (p[axis] * (1.0 - p[axis])).abs() < 1e-5;
                    assert!(near || (slope[axis] - (step(1e-6) - step(-1e-6)) / 2e-6).abs() < 0.01 * steep);
                }
            }
        }
        let whole = [Interval::WHOLE; 2];
        let bounds = sheet.bounds(&whole);
        assert!(bounds.lo.is_finite() && bounds.hi.is_finite() && !bounds.undefined);
    }
}

#[test]
fn broken_pictures() {
    let whole = png(8, 8, png::ColorType::Grayscale, &[7; 64]);
    assert_eq!(picture(b"").map(|_| ()), Err(HeightError::NotPng));
    assert_eq!(picture(b"GIF89a").map(|_| ()), Err(HeightError::NotPng));
    for end in [4, 20, 33, 50, whole.len() - 13] {
        assert!(matches!(picture(&whole[..end]), Err(HeightError::Broken(_))), "{end}");
    }
    let mut large = whole.clone();
    large[16..24].copy_from_slice(&[0x7f, 0xff, 0xff, 0xff, 0x7f, 0xff, 0xff, 0xff]);
    assert!(picture(&large).is_err());
    for at in 8..whole.len() {
        let mut damaged = whole.clone();
        damaged[at] ^= 0x15;
        if let Ok(sheet) = picture(&damaged) {
            assert!((0.0..=1.0).contains(&sheet.value(&[0.5, 0.5])));
        }
    }
}

/// The numbers that a script prints.
fn printed(script: &str) -> Result<Vec<f64>, String> {
    let mut session = Session::new(Arc::new(Memory::default()), Limits::default(), Interrupt::default());
    let outcome = session.input("a.geo", script, Mode::Script);
    let text = outcome.events.iter().find_map(|event| match event {
        Event::Printed(text) if outcome.accepted => Some(text.clone()),
        _ => None,
    });
    let text = text.ok_or_else(|| messages(&outcome))?;
    let numbers = text.split(|c: char| !"0123456789.e-+".contains(c)).filter(|word| !word.is_empty());
    Ok(numbers.map(|word| word.parse().unwrap_or_else(|_| panic!("{text}"))).collect())
}

#[test]
fn fit_finds_the_parameters_that_made_the_points() {
    let noisy = "e(i, k) = 0.001*(RANDOM(k, i) - 0.5);";
    let cases = [
        // A ball by its centre and radius; the value is a distance.
        (
            "P = ARRAY(i = 1 TO 200, [1 + 2*COS(i)*SIN(3*i) + e(i, 1), 2 + 2*SIN(i)*SIN(3*i) + e(i, 2), -1 + 2*COS(3*i) + e(i, 3)]);
             r(q, p) = NORM(p - [q[1], q[2], q[3]]) - q[4]; s = [0, 0, 0, 1];",
            vec![1.0, 2.0, -1.0, 2.0],
            2e-4,
        ),
        // An ellipse by its centre and half axes, an object of the library.
        (
            "P = ARRAY(i = 1 TO 300, [0.5 + 3*COS(i) + e(i, 1), -0.2 + SIN(i) + e(i, 2)]);
             r(q, p) = pob_ellipse([q[1], q[2]], q[3], q[4]) AT (p); s = [0, 0, 2.5, 0.8];",
            vec![0.5, -0.2, 3.0, 1.0],
            2e-4,
        ),
        // The blend of two half-planes by its height and reach: on exact points to rounding.
        (
            "f(q) = tr_bl_uni(-x1, -x2, q[1], q[2], q[3]);
             P = ARRAY(i = 1 TO 81, [MOD(i, 9)/4 - 1, FLOOR(i/9)/4 - 1]);
             r(q, p) = (f(q) AT (p)) - (f([0.4, 0.9, 1.3]) AT (p)); s = [1, 0.5, 0.7];",
            vec![0.4, 0.9, 1.3],
            1e-9,
        ),
        // Several residuals a point: a circle of two coordinates at once, exponentials, one parameter.
        ("P = ARRAY(i = 1 TO 30, [i/10, EXP(-1.7*i/10), 2*EXP(-1.7*i/10)]); r(q, p) = [EXP(-q[1]*p[1]) - p[2], 2*EXP(-q[1]*p[1]) - p[3]]; s = [0.1];", vec![1.7], 1e-12),
        // Rosenbrock's valley, in which steps along the slope go astray.
        ("P = [[1]]; r(q, p) = [10*(q[2] - q[1]**2), p[1] - q[1]]; s = [-1.2, 1];", vec![1.0, 1.0], 1e-9),
        // A start that is the answer.
        ("P = [[1], [2]]; r(q, p) = q[1]*p[1] - 3*p[1]; s = [3];", vec![3.0], 0.0),
    ];
    for (script, right, room) in cases {
        let found =
            printed(&format!("{noisy} {script} PRINT FIT(r, s, P);")).unwrap_or_else(|why| panic!("{why}: {script}"));
        assert_eq!(found.len(), right.len());
        for (found, right) in found.iter().zip(&right) {
            assert!((found - right).abs() <= room, "{found} instead of {right}: {script}");
        }
    }
    // The mean of the points is the least even where the residuals stay large, and the result follows what it is made of.
    assert_eq!(
        printed("c = 1; r(q, p) = q[1] - c*p[1]; v = FIT(r, [9], [[1], [2], [6]]); c = 2; PRINT v;"),
        Ok(vec![6.0])
    );
}

#[test]
fn fits_that_cannot_be() {
    let cases = [
        ("r(q, p) = EXP(-q[1]) + p[1]; v = FIT(r, [0], [[0], [0]]);", "no-fit: FIT found no least: it ended at ["),
        (
            "r(q, p) = SQRT(q[1] - p[1]); v = FIT(r, [0], [[-1], [2]]);",
            "bad-fit: the residual or its derivative is not finite at the start, at point 2",
        ),
        (
            "r(q, p) = q[1] - p[1]; v = FIT(r, [0, 1], [[1], [2]]);",
            "bad-fit: the residual does not depend on parameter 2 at the start",
        ),
        (
            "r(q, p) = q[1] - p[1]*q[2]; v = FIT(r, [0, 1], [[1]]);",
            "bad-fit: 2 parameters cannot be found from 1 residuals",
        ),
        (
            "r(q, p) = q[1] - x1; v = FIT(r, [0], [[1]]);",
            "bad-fit: the residual depends on x1, which has no value here",
        ),
        ("r(q, p) = q[1] - p[1]; v = FIT(r, [0], [[1/x1]]);", "wrong-kind: "),
        ("r(q) = q[1]; v = FIT(r, [0], [[1]]);", "wrong-count: "),
        ("v = FIT(3, [0], [[1]]);", "wrong-kind: "),
        ("r(q, p) = q[1]; v = FIT(r, [], [[1]]);", ""),
        ("r(q, p) = q[1]; v = FIT(r, [0], []);", ""),
        ("r(q, p) = q[3]; v = FIT(r, [0], [[1]]);", "bad-index: "),
    ];
    for (script, message) in cases {
        let told = printed(&format!("{script} PRINT v;")).expect_err(script);
        assert!(told.starts_with(message), "{script}: {told}");
    }
}

#[test]
fn reliefs_of_sheets_on_any_solid() {
    // A bump of height 0.1 on the side of a ball, a cylinder and a mesh-like solid, and nothing elsewhere.
    let bump = "P = ARRAY(i = 1 TO 441, [MOD(i, 21)/10 - 1, FLOOR((i - 1)/21)/10 - 1]);
        V = ARRAY(i = 1 TO 441, IF NORM(P[i]) < 0.35 THEN 0.1 ELSE 0);
        bump = SCATTER(P, V, 1e-9, 30, 30, x2, x3);";
    let solids = [
        ("pob_sphere([0, 0, 0], 1)", 1.0),
        ("pob_cylinder([0, 0, -2], [0, 0, 2], 1)", 1.0),
        ("pob_box([0, 0, 0], [2, 2, 2])", 1.0),
        ("1 - x1**4 - x2**4 - x3**4", 1.0),
    ];
    for (solid, at) in solids {
        let script = format!(
            "{bump} gob_a = tr_relief({solid}, IF x1 > 0 THEN bump ELSE 0);
             PRINT gob_a({}, 0, 0), gob_a({}, 0, 0), gob_a({}, 0, 0), gob_a({}, 0, 0);",
            at + 0.095,
            at + 0.105,
            -at - 0.001,
            -at + 0.001
        );
        let signs: Vec<f64> =
            printed(&script).unwrap_or_else(|why| panic!("{why}")).iter().map(|v| v.signum()).collect();
        assert_eq!(signs, [1.0, -1.0, -1.0, 1.0], "{solid}");
    }
}

#[test]
fn solids_through_sections_branch_where_these_do() {
    let script = "s1 = pob_circle([0, 0], 1); s2 = pob_circle([-1, 0], 0.5) | pob_circle([1, 0], 0.5);
        gob_a = tr_reconstruct([s1, s2, s2], [0, 1, 2]);
        PRINT gob_a(0, 0, 0.1), gob_a(0, 0, 1), gob_a(1, 0, 1), gob_a(1, 0, 2.1), gob_a(0.99, 0, 0.001), gob_a(1, 0, 1.999);";
    let signs: Vec<f64> = printed(script).unwrap_or_else(|why| panic!("{why}")).iter().map(|v| v.signum()).collect();
    assert_eq!(signs, [1.0, -1.0, 1.0, -1.0, 1.0, 1.0]);
    // Two different numbers of sections and places are refused.
    assert!(printed("s = pob_circle([0, 0], 1); gob_a = tr_reconstruct([s], [0, 1]); PRINT gob_a(0, 0, 0);").is_err());
}
