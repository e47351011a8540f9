//! Questions that programs ask of objects, as built-ins: answers against closed forms and numeric searches, and that they follow when an
//! object changes.

mod measured;
mod nearest;

use std::sync::Arc;

use yont::host::Memory;
use yont::interrupt::Interrupt;
use yont::limits::Limits;
use yont::model::request::{self, View};
use yont::model::value::Scalar;
use yont::model::{Event, Session, Value};
use yont::syntax::Mode;

use crate::session::messages;

const PI: f64 = std::f64::consts::PI;

fn asked(script: &str) -> Session {
    let mut session = Session::new(Arc::new(Memory::default()), Limits::default(), Interrupt::default());
    let outcome = session.input("script.geo", script, Mode::Script);
    assert!(outcome.accepted, "{script}: {}", messages(&outcome));
    session
}

/// The numbers of a value, those of arrays one after the other.
fn flat(value: &Value) -> Vec<f64> {
    match value {
        Value::Scalar(Scalar::Number(number)) => vec![*number],
        Value::Array(array) => array.items().iter().flat_map(flat).collect(),
        other => panic!("{other:?} is no number"),
    }
}

/// The value of an expression behind a script.
fn numbers(script: &str, expression: &str) -> Vec<f64> {
    let session = asked(&format!("{script}\nasked = {expression};"));
    flat(&session.value("asked").expect("it is defined").expect("it has a value"))
}

/// The code of the message that an expression gets.
fn refused(expression: &str) -> &'static str {
    let mut session = Session::new(Arc::new(Memory::default()), Limits::default(), Interrupt::default());
    let outcome = session.input("script.geo", &format!("asked = {expression};"), Mode::Script);
    assert!(!outcome.accepted, "{expression} was accepted");
    outcome.diagnostics.iter().find(|d| d.is_error()).expect("an error").code
}

/// Pairs of objects, and whether they meet.
const MEETING: &[(&str, &str, f64)] = &[
    ("1 - x1**2 - x2**2 - x3**2", "1 - (x1 - 2.000001)**2 - x2**2 - x3**2", 0.0),
    ("1 - x1**2 - x2**2 - x3**2", "1 - (x1 - 1.999999)**2 - x2**2 - x3**2", 1.0),
    ("pob_sphere([0, 0, 0], 1)", "pob_sphere([1, 1, 1]*(2 + 1e-6)/SQRT(3), 1)", 0.0),
    ("pob_sphere([0, 0, 0], 1)", "pob_sphere([1, 1, 1]*(2 - 1e-6)/SQRT(3), 1)", 1.0),
    ("pob_sphere([0, 0, 0], 1)", "pob_sphere([1, 2, 2]*2/3, 1)", 1.0),
    ("1e16 - x1**2 - x2**2", "1e16 - (x1 - 2.0001e8)**2 - x2**2", 0.0),
    ("1e-12 - x1**2 - x2**2", "1e-12 - (x1 - 1.9999e-6)**2 - x2**2", 1.0),
    ("pob_torus([0, 0, 0], 2, 0.5)", "pob_sphere([0, 0, 0], 1.4999)", 0.0),
    ("pob_torus([0, 0, 0], 2, 0.5)", "pob_sphere([0, 0, 0], 1.5001)", 1.0),
    (
        "tr_rotate(pob_box([0, 0, 0], [2, 2, 2]), [1, 1, 0], 1)",
        "tr_rotate(pob_box([2.01, 0, 0], [2, 2, 2]), [1, 1, 0], 1)",
        0.0,
    ),
    ("PROJECT(1 - (x1 - x4)**2 - x2**2, x4, 0, 3)", "1 - (x1 - 5)**2 - (x2 + 0.1)**2", 0.0),
    ("x1 - 5", "4 - x1", 0.0),
    ("x1 - x2", "x2 - x1 - 0.01", 0.0),
    ("-ABS(x1)", "-ABS(x2 - x1)", 1.0),
    ("SQRT(x1 - 1)", "1 - x1", 1.0),
    ("SQRT(x1 - 1)", "0.5 - x1", 0.0),
    ("IF x1 > 0 THEN x1 - 1 ELSE -1", "0.999 - x1", 0.0),
    ("FLOOR(x1) - 3", "2.9999 - x1", 0.0),
    ("x1*x2 - 1", "-x1*x2", 0.0),
    ("1 - x1**2 - x2**2 - x3**2 - x4**2", "0.9 - (x1 - 1)**2 - (x2 - 1)**2 - (x3 - 1)**2 - (x4 - 1)**2", 0.0),
    ("1 - x1**2 - x2**2 - x3**2 - x4**2", "1.1 - (x1 - 1)**2 - (x2 - 1)**2 - (x3 - 1)**2 - (x4 - 1)**2", 1.0),
    ("1", "x1", 1.0),
    ("-1", "x1", 0.0),
    ("IF x1 > 5 THEN LOG(-1 - x1**2) ELSE -1", "x1", 0.0),
];

#[test]
fn objects_meet_where_they_do() {
    for &(a, b, meet) in MEETING {
        assert_eq!(numbers("", &format!("INTERSECTS({a}, {b})")), [meet], "{a} and {b}");
        assert_eq!(numbers("", &format!("INTERSECTS({b}, {a})")), [meet], "{b} and {a}");
    }
}

#[test]
fn a_witness_belongs_to_both() {
    for &(a, b, meet) in MEETING {
        let pair = format!("WITNESS({a}, {b})");
        if meet == 0.0 {
            assert_eq!(refused(&pair), "no-witness", "{a} and {b}");
            continue;
        }
        // What touches does so within rounding.
        let values = numbers("", &format!("([({a} + 0*x1) AT (p), ({b} + 0*x1) AT (p)] WHERE p = {pair})"));
        assert!(values.iter().all(|value| *value >= -1e-15), "{a} and {b}: {values:?}");
    }
    assert_eq!(numbers("", "WITNESS(x3 - 5)")[..2], [0.0, 0.0]);
    assert_eq!(refused("WITNESS(-1 - x1**2)"), "no-witness");
}

#[test]
fn objects_include_each_other_where_they_do() {
    for (outer, inner, includes) in [
        ("pob_sphere([0, 0, 0], 2)", "pob_sphere([0.5, 0, 0], 1.49)", 1.0),
        ("pob_sphere([0, 0, 0], 2)", "pob_sphere([0.5, 0, 0], 1.50001)", 0.0),
        // Those that touch from within, at a point, in faces, everywhere.
        ("pob_sphere([0, 0, 0], 2)", "pob_sphere([1, 0, 0], 1)", 1.0),
        ("x1", "pob_sphere([1, 0, 0], 1)", 1.0),
        ("pob_box([0, 0, 0], [2, 2, 2])", "pob_box([0.5, 0, 0], [1, 1, 2])", 1.0),
        ("pob_block_3D(0, 0, 0, 3, 2, 2)", "pob_block_3D(0, 0, 0, 2, 2, 2)", 1.0),
        ("pob_torus([0, 0, 0], 2, 1)", "pob_torus([0, 0, 0], 2, 1)", 1.0),
        ("pob_sphere([0, 0, 0], 1) | pob_sphere([1, 0, 0], 1)", "pob_sphere([0.5, 0, 0], 0.8)", 1.0),
        ("pob_sphere([0, 0, 0], 1) | pob_sphere([1, 0, 0], 1)", "pob_sphere([0.5, 0, 0], 0.9)", 0.0),
        ("pob_sphere([0, 0, 0], 3) \\ pob_sphere([0, 0, 0], 1)", "pob_torus([0, 0, 0], 2, 0.9)", 1.0),
        ("pob_sphere([0, 0, 0], 3) \\ pob_sphere([0, 0, 0], 1)", "pob_torus([0, 0, 0], 2, 1.001)", 0.0),
        ("1 - x1**2", "-1 + 0*x1", 1.0),
        ("-1 + 0*x1", "1 - x1**2", 0.0),
        ("SQRT(x1)", "1 - (x1 - 2)**2", 1.0),
        ("SQRT(x1)", "1 - x1**2", 0.0),
    ] {
        assert_eq!(numbers("", &format!("INCLUDES({outer}, {inner})")), [includes], "{inner} in {outer}");
    }
}

#[test]
fn answers_follow_their_objects() {
    let mut session = asked("r = 1; gob_a = r - x1**2; f(g) = INTERSECTS(g, x1 - 2); meet = f(gob_a);");
    let meet = |session: &Session| flat(&session.value("meet").unwrap().unwrap());
    assert_eq!(meet(&session), [0.0]);
    assert!(session.input("", "r = 5", Mode::Prompt).accepted);
    assert_eq!(meet(&session), [1.0]);
    session.undo();
    assert_eq!(meet(&session), [0.0]);
}

#[test]
fn a_question_is_answered_once() {
    let mut session = asked("gob_a = 1 - x1**2 - x2**2; v = INTERSECTS(gob_a, gob_a AT (x1 = x1 - 2.0001));");
    session.interrupt().reset();
    let outcome = session.input("", "INTERSECTS(1 - x1**2 - x2**2, gob_a AT (x1 = x1 - 2.0001))", Mode::Prompt);
    assert!(matches!(&outcome.events[..], [Event::Value { text, .. }] if text == "0"), "{}", messages(&outcome));
    assert_eq!(session.interrupt().costs().kept.wholes, [("answers", 1)]);
}

#[test]
fn relations_of_unions_and_intersections_are_the_largest_and_the_least() {
    const SHAPES: &str = "gob_f = pob_sphere([0, 0, 0], 1); gob_g = pob_box([0.5, 0.25, 0], [1.5, 1.5, 1]);
        s(g) = rel_membership(g, [x1, x2, x3]);
        both = s(gob_f & gob_g) - MIN(s(gob_f), s(gob_g)); either = s(gob_f | gob_g) - MAX(s(gob_f), s(gob_g)); each = s(gob_f) + 10*s(gob_g);";
    let mut session = asked(SHAPES);
    // A third of the points lies on each boundary.
    let mut seed = 1_u64;
    let mut random = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 11) as f64 / (1_u64 << 53) as f64 * 2.6 - 1.3
    };
    let points: Vec<Vec<f64>> = (0..100_000)
        .map(|i| {
            let p = [random(), random(), random()];
            let length = p.iter().map(|c| c * c).sum::<f64>().sqrt();
            match i % 3 {
                0 => p.to_vec(),
                1 => p.iter().map(|c| c / length).collect(),
                _ => vec![1.25, p[1].clamp(-0.4, 0.9), p[2].clamp(-0.4, 0.4)],
            }
        })
        .collect();
    let mut values = |name: &str| {
        let view = View { object: Some(name.into()), ..View::default() };
        let sampled = request::sample(&mut session, &view, &points, false).expect("samples");
        sampled.iter().map(|sample| sample.value).collect::<Vec<f64>>()
    };
    let each = values("each");
    for kind in 0..3 {
        assert!(each.iter().filter(|s| **s % 10.0 == f64::from(kind)).count() > 5_000, "few points of kind {kind}");
        assert!(each.iter().filter(|s| (**s / 10.0).floor() == f64::from(kind)).count() > 5_000, "{kind}");
    }
    for name in ["both", "either"] {
        let wrong = values(name).iter().filter(|difference| **difference != 0.0).count();
        assert_eq!(wrong, 0, "{name} of {} points", points.len());
    }
}
