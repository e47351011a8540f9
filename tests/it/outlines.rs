//! POLYGON, CONTOURS and MEDIAL against exact tests of points, areas and fine samplings.

use std::f64::consts::TAU;

use yont::data::polygon::{Polygon, PolygonError, Step};
use yont::field::Coordinate;
use yont::interrupt::Interrupt;
use yont::limits::Limits;
use yont::model::Value;
use yont::syntax::Mode;
use yont::vm::{Demand, Points, Program};

use crate::conformance::Random;
use crate::session::{messages, session};

fn cases(default: usize) -> usize {
    std::env::var("YONT_CASES").ok().and_then(|n| n.parse().ok()).unwrap_or(default)
}

fn polygon(vertices: &[[f64; 2]]) -> Polygon {
    Polygon::new(vertices, &Interrupt::default()).unwrap_or_else(|why| panic!("{why}: {vertices:?}"))
}

/// The formula's value with min and max.
fn value(steps: &[Step], [x, y]: [f64; 2]) -> f64 {
    let mut stack = Vec::new();
    for step in steps {
        let next = match *step {
            Step::HalfPlane([a, b, c]) => a * x + b * y + c,
            Step::Both | Step::Either => {
                let (b, a): (f64, f64) = (stack.pop().expect("two operands"), stack.pop().expect("two operands"));
                if *step == Step::Both { a.min(b) } else { a.max(b) }
            }
        };
        stack.push(next);
    }
    assert_eq!(stack.len(), 1);
    stack[0]
}

/// The distance to the nearest edge, by plain geometry.
fn distance(corners: &[[f64; 2]], p: [f64; 2]) -> f64 {
    let edges = corners.iter().zip(corners.iter().cycle().skip(1));
    let from = |(a, b): (&[f64; 2], &[f64; 2])| {
        let (l, d) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
        let t = ((l[0] * d[0] + l[1] * d[1]) / (l[0] * l[0] + l[1] * l[1])).clamp(0.0, 1.0);
        (d[0] - t * l[0]).hypot(d[1] - t * l[1])
    };
    edges.map(from).fold(f64::INFINITY, f64::min)
}

/// Whether a point lies inside, by the angles under which it sees the edges: nothing is shared with the product.
fn winds(corners: &[[f64; 2]], p: [f64; 2]) -> bool {
    let angle = |v: &[f64; 2]| (v[1] - p[1]).atan2(v[0] - p[0]);
    let edges = corners.iter().zip(corners.iter().cycle().skip(1));
    let sum: f64 = edges
        .map(|(a, b)| {
            let d = angle(b) - angle(a);
            d - TAU * (d / TAU).round()
        })
        .sum();
    sum.abs() > 3.0
}

/// Random simple polygons: stars about a point, spirals, combs, stairs with vertices on straight edges, and random walks in x.
fn outline(random: &mut Random, kind: usize) -> Vec<[f64; 2]> {
    let n = 3 + (random.between(0.0, 1.0).powi(2) * 497.0) as usize;
    match kind % 5 {
        0 => (0..n)
            .map(|i| {
                let (a, r) = (TAU * i as f64 / n as f64, random.between(0.2, 1.0));
                [r * a.cos(), r * a.sin()]
            })
            .collect(),
        1 => {
            let half = n / 2 + 120;
            let arm = |i: usize, wide: f64| {
                let t = i as f64 / half as f64;
                let (a, r) = (5.0 * TAU * t, 0.1 + 0.8 * t + wide);
                [r * a.cos(), r * a.sin()]
            };
            let half_step = 0.03 + random.between(0.0, 0.03);
            (0..=half).map(|i| arm(i, 0.0)).chain((0..=half).rev().map(|i| arm(i, half_step))).collect()
        }
        2 => {
            let teeth = n / 4 + 1;
            let mut all = vec![[1.0, -1.0], [1.0, -0.8]];
            for i in (0..teeth).rev() {
                let x = |k: f64| -1.0 + 2.0 * (i as f64 + k) / teeth as f64;
                let top = random.between(-0.5, 1.0);
                all.extend([[x(0.9), -0.8], [x(0.8), top], [x(0.3), top], [x(0.1), -0.8]]);
            }
            all.push([-1.0, -0.8]);
            all.push([-1.0, -1.0]);
            all
        }
        3 => {
            let steps = n / 4 + 2;
            let mut all = Vec::new();
            for i in 0..steps {
                let (a, b) = (i as f64 / steps as f64, (i + 1) as f64 / steps as f64);
                all.extend([[a, a], [b, a], [b, 0.5 * (a + b)], [b, b]]);
            }
            all.extend([[0.5, 1.0], [0.0, 1.0], [0.0, 0.5]]);
            all
        }
        _ => {
            let half = n / 2 + 2;
            let lower: Vec<[f64; 2]> = (0..half).map(|i| [i as f64, random.between(-1.0, -0.01)]).collect();
            let upper = (0..half).rev().map(|i| [i as f64 + random.between(0.0, 0.4), random.between(0.01, 1.0)]);
            lower.iter().copied().chain(upper).collect()
        }
    }
}

#[test]
fn a_polygon_has_each_half_plane_once_and_no_wrong_sign() {
    let mut random = Random(7);
    let mut points = 0;
    for case in 0..cases(200) {
        let mut vertices = outline(&mut random, case);
        if case % 2 == 1 {
            vertices.reverse();
        }
        let polygon = polygon(&vertices);
        let corners = polygon.corners();
        let steps = polygon.formula(&Interrupt::default()).expect("not stopped");
        let planes = steps.iter().filter(|s| matches!(s, Step::HalfPlane(_))).count();
        assert_eq!((planes, steps.len()), (corners.len(), 2 * corners.len() - 1));
        let far = corners.iter().fold([[f64::MAX, f64::MIN]; 2], |b, c| {
            [[b[0][0].min(c[0]), b[0][1].max(c[0])], [b[1][0].min(c[1]), b[1][1].max(c[1])]]
        });
        for i in 0..1000 {
            let p: [f64; 2] = if i % 4 == 0 {
                // On the line of an edge, beyond its ends: where a formula with zeros inside would show them.
                let k = (random.between(0.0, corners.len() as f64) as usize).min(corners.len() - 1);
                let (a, b, t) = (corners[k], corners[(k + 1) % corners.len()], random.between(-3.0, 4.0));
                [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])]
            } else {
                far.map(|[lo, hi]| random.between(lo - 0.1, hi + 0.1))
            };
            if distance(&corners, p) < 1e-9 {
                continue;
            }
            let (f, inside) = (value(&steps, p), winds(&corners, p));
            assert!(f != 0.0 && (f > 0.0) == inside, "{p:?}: {f}, {inside}: {corners:?}");
            assert_eq!(polygon.contains(p), inside);
            points += 1;
        }
    }
    println!("{points} points, no wrong sign");
}

#[test]
fn crossing_edges_are_named() {
    let refused = |vertices: &[[f64; 2]]| Polygon::new(vertices, &Interrupt::default()).expect_err("refused");
    let bow = refused(&[[0.0, 0.0], [2.0, 2.0], [2.0, 0.0], [0.0, 2.0]]);
    assert_eq!(bow, PolygonError::Crossing { first: [1, 2], second: [3, 4], at: [1.0, 1.0] });
    let touching = refused(&[[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [2.0, 0.0], [0.0, 4.0]]);
    assert!(matches!(touching, PolygonError::Crossing { .. }), "{touching}");
    let spike = refused(&[[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [4.0, 8.0], [4.0, 2.0], [0.0, 4.0]]);
    assert!(matches!(spike, PolygonError::Crossing { .. }), "{spike}");
    assert_eq!(refused(&[[0.0, 0.0], [1.0, 1.0], [2.0, 2.0], [1.0, 1.0]]), PolygonError::TooFew(2));
    assert_eq!(refused(&[[0.0, 0.0], [f64::NAN, 1.0], [2.0, 0.0]]), PolygonError::NotFinite(2));
    let mut random = Random(3);
    for case in 0..cases(200) {
        let mut vertices = outline(&mut random, case);
        let n = vertices.len();
        // Two opposite vertices change places: nearly always the outline crosses itself, and if not it has a formula.
        vertices.swap(0, n / 2);
        match Polygon::new(&vertices, &Interrupt::default()) {
            Err(PolygonError::Crossing { first, second, at }) => {
                let edge = |[a, b]: [usize; 2]| vec![vertices[a - 1], vertices[b - 1]];
                assert!(
                    distance(&edge(first), at) < 1e-9 && distance(&edge(second), at) < 1e-9,
                    "{first:?} {second:?} {at:?}"
                );
            }
            Err(other) => panic!("{other}"),
            Ok(_) => {}
        }
    }
}

/// The values of `v` of a script at points.
fn values(script: &str, at: &[Vec<f64>]) -> Vec<f64> {
    let mut session = session();
    let outcome = session.input("outlines.geo", script, Mode::Script);
    assert!(outcome.accepted, "{script}\n{}", messages(&outcome));
    let Some(Ok(Value::Scalar(scalar))) = session.value("v") else { panic!("{script}: v is no scalar") };
    let node = scalar.node(session.graph_mut());
    let inputs: Vec<Coordinate> = (1..=at.len() as u8).map(Coordinate).collect();
    let program =
        Program::compile(session.graph_mut(), node, &inputs, Demand::Value, &Limits::default()).expect("small");
    let columns: Vec<&[f64]> = at.iter().map(Vec::as_slice).collect();
    let mut out = vec![0.0; at[0].len()];
    Points::<f64>::new().eval(&program, &columns, &mut out);
    out
}

fn scattered(random: &mut Random, axes: usize, count: usize, lo: f64, hi: f64) -> Vec<Vec<f64>> {
    (0..axes).map(|_| (0..count).map(|_| random.between(lo, hi)).collect()).collect()
}

#[test]
fn contours_hold_what_an_odd_number_of_them_holds() {
    let ring = |x: f64, y: f64, r: f64, n: usize| -> Vec<[f64; 2]> {
        (0..n).map(|i| TAU * i as f64 / n as f64).map(|a| [x + r * a.cos(), y + r * a.sin()]).collect()
    };
    let all = [
        ring(0.0, 0.0, 4.0, 9),
        ring(-1.5, 0.0, 1.8, 6),
        ring(-1.5, 0.2, 1.0, 5),
        ring(1.8, 0.4, 1.0, 8),
        ring(6.0, 0.0, 1.5, 3),
    ];
    let list: Vec<String> = all
        .iter()
        .map(|c| {
            format!(
                "[{:?}, {:?}]",
                c.iter().map(|v| v[0]).collect::<Vec<_>>(),
                c.iter().map(|v| v[1]).collect::<Vec<_>>()
            )
        })
        .collect();
    let mut random = Random(11);
    let at = scattered(&mut random, 2, 20_000, -5.0, 8.0);
    for system in ["r_alpha = 0;", "r_alpha = 1;", "r_m = 1;"] {
        let found = values(&format!("{system} v = CONTOURS([{}]);", list.join(", ")), &at);
        for (i, f) in found.into_iter().enumerate() {
            let p = [at[0][i], at[1][i]];
            let odd = all.iter().filter(|c| winds(c, p)).count() % 2 == 1;
            assert_eq!(f > 0.0, odd, "{p:?}: {f}");
        }
    }
}

#[test]
fn a_medial_body_is_the_union_of_its_balls() {
    let points = [[0.0, 0.0, 0.0], [4.0, 1.0, 0.0], [4.0, 4.0, 2.0], [4.2, 4.1, 2.0]];
    let radii = [1.0, 0.4, 0.9, 2.0];
    let edges = [[1, 2], [2, 3], [3, 4]];
    let mut random = Random(5);
    let at = scattered(&mut random, 3, 2_000, -2.0, 7.0);
    let found = values(&format!("v = MEDIAL({points:?}, {radii:?}, {edges:?});"), &at);
    for (i, f) in found.into_iter().enumerate() {
        let ball = |&[a, b]: &[usize; 2], t: f64| {
            let (a, b) = (a - 1, b - 1);
            let r = radii[a] + t * (radii[b] - radii[a]);
            let d = |axis: usize| at[axis][i] - points[a][axis] - t * (points[b][axis] - points[a][axis]);
            r * r - (0..3).map(|axis| d(axis) * d(axis)).sum::<f64>()
        };
        let fine = edges.iter().flat_map(|e| (0..=2000).map(move |k| ball(e, f64::from(k) / 2000.0)));
        let best = fine.fold(f64::NEG_INFINITY, f64::max);
        assert!(f >= best - 1e-12 && f <= best + 1e-5, "{f} {best}");
    }
}

#[test]
fn what_has_no_formula_says_why() {
    let told = |script: &str| {
        let mut session = session();
        let outcome = session.input("outlines.geo", script, Mode::Script);
        let asked = session.value("v").map(|v| v.is_err());
        (messages(&outcome), asked)
    };
    for (script, says) in [
        ("v = POLYGON([0, 2, 2, 0], [0, 2, 0, 2]);", "edge from vertex 1 to 2 meets that from vertex 3 to 4"),
        ("v = POLYGON([0, 2, 2], [0, 2]);", "3"),
        ("v = POLYGON([0, 1, x1], [0, 2, 0]);", "an array of numbers"),
        ("v = CONTOURS([[[0, 2, 2, 0], [0, 0, 2, 2]], [[1, 3, 3, 1], [1, 1, 3, 3]]]);", "contours 1 and 2 cross"),
        ("v = CONTOURS([[[0, 2], [0, 0]]]);", "contour 1"),
        ("v = MEDIAL([[0, 0], [1, 0]], [1, -1], [[1, 2]]);", "radius 2 is -1"),
        ("v = MEDIAL([[0, 0], [1, 0]], [1, 1], [[1, 3]]);", "edge 1"),
        ("v = MEDIAL([[0, 0], [1]], [1, 1], [[1, 2]]);", "one length"),
    ] {
        let (message, _) = told(script);
        assert!(message.contains(says), "{script}\n{message}");
    }
}
