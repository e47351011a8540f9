//! Distances and nearest points against closed forms and brute force, and curves in which boundaries meet.

use super::{flat, numbers, refused};

fn length(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}

#[test]
fn nearest_points_are_those_of_closed_forms() {
    let third = 1.0 / 3.0;
    for (object, point, nearest) in [
        ("pob_sphere([0, 0, 0], 1)", "[3, 4, 12]", vec![3.0 / 13.0, 4.0 / 13.0, 12.0 / 13.0]),
        ("pob_sphere([0, 0, 0], 1)", "[0.1, 0.2, 0]", vec![0.1, 0.2, 0.0]),
        ("~pob_sphere([0, 0, 0], 1)", "[0.1, 0, 0]", vec![1.0, 0.0, 0.0]),
        ("pob_sphere([0, 0, 0], 1) | pob_sphere([5, 0, 0], 1)", "[3, 0, 0]", vec![4.0, 0.0, 0.0]),
        // A corner, an edge and a face; from within, the nearest face.
        ("pob_box([0, 0, 0], [2, 2, 2])", "[3, 4, 5]", vec![1.0, 1.0, 1.0]),
        ("pob_box([0, 0, 0], [2, 2, 2])", "[3, 4, 0.5]", vec![1.0, 1.0, 0.5]),
        ("pob_box([0, 0, 0], [2, 2, 2])", "[0.2, 0.3, 7]", vec![0.2, 0.3, 1.0]),
        ("~pob_box([0, 0, 0], [2, 2, 2])", "[0.2, 0.3, 0.7]", vec![0.2, 0.3, 1.0]),
        ("1 - ABS(x1) - ABS(x2) - ABS(x3)", "[2, 0.1, 0]", vec![1.0, 0.0, 0.0]),
        ("1 - ABS(x1) - ABS(x2) - ABS(x3)", "[2, 2, 2]", vec![third, third, third]),
        ("pob_torus([0, 0, 0], 2, 0.5)", "[3, 4, 0]", vec![1.5, 2.0, 0.0]),
        ("1 - x1**2 - x2**2 & x1", "[-1, 3]", vec![0.0, 1.0]),
        ("1 - x1**2 - x2**2 & x1", "[-1, 0.3]", vec![0.0, 0.3]),
        ("1 - x1**2", "[5]", vec![1.0]),
        ("x3 - 2", "[1, 2, 0]", vec![1.0, 2.0, 2.0]),
        ("1 - x1**2 - x2**2", "[3, 4, 7]", vec![0.6, 0.8, 7.0]),
        ("30 - x1**2 - x2**2 - x3**2 - x4**2", "[2, 4, 6, 8]", vec![1.0, 2.0, 3.0, 4.0]),
    ] {
        let found = numbers("", &format!("CLOSEST({object}, {point})"));
        assert!(length(&found, &nearest) < 1e-9, "{object} from {point}: {found:?}");
        let distance = numbers("", &format!("DISTANCE({object}, {point})"))[0];
        let to = numbers("", point);
        assert!((distance - length(&nearest, &to)).abs() < 1e-9, "{object} from {point}: {distance}");
    }
}

/// The least distance over a surface of two parameters: a fine sampling, and smaller ones about the best of it.
fn searched(surface: impl Fn(f64, f64) -> [f64; 3], to: [f64; 3]) -> f64 {
    let (mut centre, mut reach, mut best) = ([0.0, 0.0], std::f64::consts::PI, f64::INFINITY);
    for _ in 0..40 {
        let mut next = centre;
        for i in -60..=60 {
            for j in -60..=60 {
                let at = [centre[0] + reach * f64::from(i) / 60.0, centre[1] + reach * f64::from(j) / 60.0];
                let distance = length(&surface(at[0], at[1]), &to);
                if distance < best {
                    (best, next) = (distance, at);
                }
            }
        }
        (centre, reach) = (next, reach * 0.3);
    }
    best
}

#[test]
fn distances_are_those_of_brute_force() {
    let torus = |u: f64, v: f64| {
        let across = 2.0 + 0.5 * v.cos();
        [across * u.cos(), across * u.sin(), 0.5 * v.sin()]
    };
    let ellipsoid = |u: f64, v: f64| [3.0 * v.cos() * u.cos(), 2.0 * v.cos() * u.sin(), v.sin()];
    for to in [[3.0, 4.0, 1.0], [0.1, 0.2, 1.5], [-4.0, 0.3, -2.0]] {
        let [a, b, c] = to;
        for (object, exact) in [
            ("pob_torus([0, 0, 0], 2, 0.5)", searched(torus, to)),
            ("pob_ellipsoid([0, 0, 0], 3, 2, 1)", searched(ellipsoid, to)),
        ] {
            let found = numbers("", &format!("DISTANCE({object}, [{a}, {b}, {c}])"))[0];
            assert!((found - exact).abs() < 1e-9, "{object} from {to:?}: {found} instead of {exact}");
            let error = numbers("", &format!("UNCERTAINTY(DISTANCE({object}, [{a}, {b}, {c}]))"))[0];
            assert!(error < 1e-6 * exact, "{object} from {to:?}: proved to {error}");
        }
    }
}

#[test]
fn distances_that_make_no_sense_are_refused() {
    for (question, code) in [
        ("DISTANCE(-1 - x1**2, [0])", "empty-object"),
        ("DISTANCE(1 - x1**2 - x2**2, [5])", "short-point"),
        ("DISTANCE(1 - x1**2, [INFINITY])", "infinite"),
        ("DISTANCE(1 - x1**2, [x2])", "needs-constant"),
        ("DISTANCE(1 - x1**2, 3)", "needs-numbers"),
        ("CURVE(1 - x1**2, 2 - x1)", "dimension"),
        ("CURVE(1 - x1**2 - x2**2 - x3**2, 1 - x4**2)", "dimension"),
        ("CURVE(1 - x1**2 - x2**2, 1 - x1**2 + 0*x3)", "endless-object"),
    ] {
        assert_eq!(refused(question), code, "{question}");
    }
}

/// The polylines of a CURVE.
fn curve(objects: &str) -> Vec<Vec<Vec<f64>>> {
    let session = super::asked(&format!("asked = CURVE({objects});"));
    let yont::model::Value::Array(lines) = session.value("asked").expect("a value").expect("asked") else {
        panic!("no array")
    };
    let points = |line: &yont::model::Value| match line {
        yont::model::Value::Array(points) => points.items().iter().map(flat).collect::<Vec<_>>(),
        other => panic!("{other:?} is no polyline"),
    };
    lines.items().iter().map(points).collect()
}

#[test]
fn the_curves_of_two_cylinders_lie_on_both() {
    // Of one radius they meet in two ellipses that cross, else in two loops.
    for (radius, loops) in [(1.0_f64, 1..=4), (0.7, 2..=2)] {
        let lines = curve(&format!("1 - x1**2 - x2**2, {radius}**2 - x2**2 - x3**2"));
        assert!(loops.contains(&lines.len()), "{} curves for radius {radius}", lines.len());
        for line in &lines {
            assert!(line.len() > 100, "{} points", line.len());
            for p in line {
                let off = [p[0].hypot(p[1]) - 1.0, p[1].hypot(p[2]) - radius];
                assert!(off.iter().all(|off| off.abs() < 1e-9), "{p:?} is off by {off:?}");
            }
        }
        if radius < 1.0 {
            let around = |line: &Vec<Vec<f64>>| line.windows(2).map(|pair| length(&pair[0], &pair[1])).sum::<f64>();
            assert!(lines.iter().all(|line| line.first() == line.last()), "they close");
            assert!(lines.iter().all(|line| (4.0..5.0).contains(&around(line))), "of their length");
        }
    }
}

#[test]
fn the_outlines_of_two_discs_meet_in_two_points() {
    let mut points: Vec<Vec<f64>> = curve("1 - x1**2 - x2**2, 1 - (x1 - 1)**2 - x2**2").concat();
    points.sort_by(|a, b| a[1].total_cmp(&b[1]));
    assert_eq!(points.len(), 2);
    for (point, sign) in points.iter().zip([-1.0, 1.0]) {
        assert!(length(point, &[0.5, sign * 0.75_f64.sqrt()]) < 1e-12, "{point:?}");
    }
    assert!(curve("1 - x1**2 - x2**2, 1 - (x1 - 3)**2 - x2**2").is_empty());
}
