//! `:formula` and `:explain`: the one expression of each object, read again, is the same function; what is told of names.

use std::fs;
use std::path::Path;
use std::sync::Arc;

use yont::field::{Coordinate, Graph, NodeId};
use yont::host::Disk;
use yont::interrupt::Interrupt;
use yont::limits::Limits;
use yont::model::{Session, Value};
use yont::number::Reals;
use yont::syntax::Mode;
use yont::vm::reference;

use crate::session::messages;

fn session() -> Session {
    Session::new(Arc::new(Disk), Limits::default(), Interrupt::default())
}

/// Values at points of a small cube about the origin, the same points each time.
fn values(graph: &Graph, node: NodeId) -> Vec<f64> {
    let mut state = 0x2545_f491_4f6c_dd1d_u64;
    let mut random = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1u64 << 53) as f64 * 6.0 - 3.0
    };
    (0..50)
        .map(|_| {
            let point: Vec<(Coordinate, f64)> = (1..=16).map(|c| (Coordinate(c), random())).collect();
            reference::eval(&mut Reals, graph, node, &point)
        })
        .collect()
}

fn object_values(session: &mut Session, name: &str) -> Vec<f64> {
    let Some(Ok(Value::Scalar(scalar))) = session.value(name) else { panic!("{name} is no object") };
    let node = scalar.node(session.graph_mut());
    values(session.graph(), node)
}

/// Each object of a session as one expression, read into a session that knows nothing else.
fn come_back(session: &mut Session, what: &str) -> usize {
    let names = session.objects();
    for name in &names {
        let formula = match session.formula(name, None) {
            // A loop or a search that runs at each point and a STAR of numbers are no expressions, and are refused in words.
            Err(told)
                if ["18_escape", "23_", "24_"].iter().any(|name| what.contains(name))
                    || told.iter().any(|d| d.title.contains("data without a file")) =>
            {
                assert!(told.iter().any(|d| d.code == "not-an-expression"), "{told:?}");
                continue;
            }
            formula => formula.unwrap_or_else(|told| panic!("{what}: {name}: {told:?}")),
        };
        let mut again = self::session();
        let outcome = again.input("formula", &formula.text, Mode::Script);
        assert!(outcome.accepted, "{what}: {name}: {}\n{}", messages(&outcome), formula.text);
        assert_eq!(again.names(), std::slice::from_ref(name), "{what}: it stands on nothing else");
        let pairs = object_values(session, name).into_iter().zip(object_values(&mut again, name));
        for (before, after) in pairs {
            let same = before.to_bits() == after.to_bits() || before.is_nan() && after.is_nan();
            let near = formula.rewritten && (before - after).abs() <= 1e-9 * (1.0 + before.abs());
            assert!(same || near, "{what}: {name}: {before} became {after}\n{}", formula.text);
        }
    }
    names.len()
}

#[test]
fn the_formula_of_every_example_is_the_same_function() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    let mut count = 0;
    for entry in fs::read_dir(folder).expect("a folder of examples").flatten() {
        let path = entry.path();
        if path.extension().is_some_and(|e| e == "geo") {
            let mut session = session();
            let text = fs::read_to_string(&path).expect("a text");
            let outcome = session.input(&path.display().to_string(), &text, Mode::Script);
            assert!(outcome.accepted, "{}", messages(&outcome));
            count += come_back(&mut session, &path.display().to_string());
        }
    }
    assert!(count > 20, "{count} objects");
}

#[test]
fn every_form_comes_back() {
    for program in [
        "gob_a = x1 - (x2 - (x3 - 1)) - -2;",
        "gob_a = -(x1*-2)/(x2/x3)/4 + 1e300*x1 - 1e-300;",
        "gob_a = (-x1)**3 + -x1**3 + 2**x1 + x1**0.5 + x1**-2 + POW(ABS(x1), 3) + (x1**2)**3;",
        "gob_a = IF x1 > 0 THEN (IF x2 > 0 THEN 1) ELSE IF x3 <= 1 THEN 2 ELSE x1;",
        "gob_a = (IF x1 > 0 THEN x2) | x3;",
        "gob_a = NOT (x1 < x2 AND NOT x3 = 1 OR x1 <> 2) + (0 <= x1 <= 1);",
        "gob_a = (x1 < (x2 | x3)) - ((x1 & x2) >= (x1 OR x2));",
        "gob_a = MAX(MIN(x1, x2, x3), MAX(x1, x2*2), MIN(x3, 1)) + HYPOT(x1, x2, x3) + ATAN2(x1, x2) + MOD(x1, 2);",
        "r_alpha = 1; gob_a = (x1 | x2) & x3 \\ (x1 & -x2);",
        "r_alpha = 0.5; gob_a = x1 \\ (x2 | x3) \\ ~x3 & (x1 \\ x2); gob_b = x1 @ x2 | 3;",
        "r_m = 2; gob_a = (x1 | x2) & (x3 \\ x1);",
        "r_m = 1; gob_a = x1 | x2; r_alpha = 0; gob_b = gob_a & x3; r_alpha = 0.25; gob_c = gob_b \\ gob_a | x2;",
        "r_alpha = x3/4; gob_a = x1 | x2 & 1;",
        "gob_s = SIN(x1)*COS(x2) + 3; gob_a = gob_s AT (x1 = gob_s + x2, x2 = gob_s*2) + gob_s;",
        "gob_a = (x1 + x2) AT (x1 = x2, x2 = x1) AT (x1 = x1**2);",
        "gob_a = x1; FOR i = 1 TO 400 DO gob_a = SIN(gob_a) + i;",
        "gob_a = x1; FOR i = 1 TO 3000 DO gob_a = MAX(gob_a, x1 - i);",
        "gob_a = x1; FOR i = 1 TO 3000 DO gob_a = gob_a & x1 + i;",
        "gob_a = x1; FOR i = 1 TO 60 DO gob_a = gob_a*gob_a - gob_a;",
        "gob_a = (TRUNC(x1) + FLOOR(x2) + CEIL(x3) + ROUND(x1*3)) * SIGN(x1) + CBRT(x1) + LERP(x1, x2, x3);",
        "gob_a = DIFF(EXP(SIN(x1*x2)), x1) + CLAMP(x1, -1, 1) + SMOOTHSTEP(0, 1, x2) + -0*x1;",
    ] {
        let mut session = session();
        let outcome = session.input("program", program, Mode::Script);
        assert!(outcome.accepted, "{program}: {}", messages(&outcome));
        assert!(come_back(&mut session, program) > 0);
    }
}

#[test]
fn formulas_are_as_short_as_they_may_be() {
    let mut session = session();
    let program = "{ r } r = 2; a = [r, [r**2, -1]]; pob_b(c) = r**2 - (x1-c)**2; b = pob_b; u = 1/3;
        gob_a = pob_b(1) \\ pob_b(0); gob_l = a[1]*x1 | x2 \\ ~x3; t = \"word\";";
    let outcome = session.input("program", program, Mode::Prompt);
    assert!(outcome.accepted, "{}", messages(&outcome));
    for (name, expected) in [
        ("gob_a", "gob_a = 4 - (x1 - 1)**2 \\ (4 - x1**2);"),
        ("gob_l", "gob_l = (x1*2 | x2) & x3;"),
        ("a", "a = [2, [4, -1]];"),
        ("u", "u = 0.3333333333333333;"),
        ("t", "t = \"word\";"),
    ] {
        let formula = session.formula(name, None).unwrap_or_else(|told| panic!("{name}: {told:?}"));
        assert_eq!((&*formula.text, formula.rewritten), (expected, false));
    }
    for (name, words) in [("pob_b", "pob_b(c)"), ("gob_n", "gob_n")] {
        let told = session.formula(name, None).expect_err(name);
        assert!(told[0].title.contains(words), "{told:?}");
    }
}

#[test]
fn what_is_told_of_names() {
    let mut session = session();
    let program = "r = 2;\n{ A bead }\ngob_bead = gob_ball \\ gob_hole;
        r_alpha = 0.5; gob_ball = r**2 - x1**2 - x2**2 - x3**2 | -9; gob_hole = 1 - x1**2 - x2**2;
        gob_box = (1 - x1**2) @ (1 - x2**2); gob_odd = (1 - x1**2) @ (x1 - x2 - 20) AT (x3 = 1);
        gob_log = LOG(x1) + 9; gob_full = 99 - x1*x2*x4; gob_level = x1*x2; gob_level : CONSTANT = 0.25;
        x1min = -3; x1max = 3; x2min = -3; x2max = 3; x3min = -3; x3max = 3; x4min = 0; x4max = 1; x4 : T; x2 : Y;";
    let outcome = session.input("beads.geo", program, Mode::Script);
    assert!(outcome.accepted, "{}", messages(&outcome));
    let cases: &[(&str, &[&str])] = &[
        ("r", &["r = 2", "(beads.geo:1)", "read by: gob_ball, gob_bead"]),
        (
            "gob_bead",
            &[
                "object of x1, x2, x3",
                "A bead",
                "x1 : X by default, from -3 to 3",
                "x2 : Y, from",
                "a solid",
                "route cubes",
                "gob_bead: r_alpha = 0",
                "gob_ball: r_alpha = 0.5 (beads.geo:4)",
                "reads: gob_ball, gob_hole",
            ],
        ),
        ("gob_box", &["x3 : Z by default", "share no coordinate"]),
        ("gob_odd", &["sides share x1", "empty"]),
        ("gob_log", &["perhaps undefined"]),
        ("gob_full", &["x4 : T, from 0 to 1", "fills the whole space"]),
        ("gob_level", &["at the level 0.25"]),
    ];
    for (name, expected) in cases {
        let told = session.explain(name).unwrap_or_else(|told| panic!("{name}: {told:?}"));
        for words in *expected {
            assert!(told.contains(words), "{name}: no {words:?} in\n{told}");
        }
    }
    assert!(session.explain("gob_bad").is_err());
    // What a failed input had found of others is forgotten with it.
    let before = session.explain("gob_box").expect("a product");
    assert!(!session.input("beads.geo", "gob_box = gob_ball @ gob_hole; r = (;", Mode::Prompt).accepted);
    assert!(!session.input("beads.geo", "gob_box = gob_ball @ gob_hole; a = 1/(r - 2);", Mode::Prompt).accepted);
    assert_eq!(session.explain("gob_box").expect("a product"), before);
}
