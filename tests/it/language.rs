//! The language, rule by rule: a script, a name in it, a point, and the value there.

use std::sync::Arc;

use yont::field::Coordinate;
use yont::host::Memory;
use yont::interrupt::Interrupt;
use yont::limits::Limits;
use yont::model::value::Scalar;
use yont::model::{Event, Outcome, Session, Value};
use yont::number::Reals;
use yont::syntax::Mode;
use yont::vm::reference;

use crate::session::messages;

const RAMP: &[u8] = b"NRRD0004\ntype: float\ndimension: 1\nsizes: 2\nspacings: 1\nencoding: ascii\n\n0 1\n";

fn session_with(files: &[(&str, &[u8])]) -> Session {
    Session::new(Arc::new(Memory::with(files)), Limits::default(), Interrupt::default())
}

/// The value of a name at a point (x1, x2, ...).
pub fn value_at(session: &Session, name: &str, point: &[f64]) -> f64 {
    match session.value(name) {
        Some(Ok(Value::Scalar(Scalar::Number(value)))) => value,
        Some(Ok(Value::Scalar(Scalar::Node(id)))) => {
            let point: Vec<(Coordinate, f64)> = (1..).map(Coordinate).zip(point.iter().copied()).collect();
            reference::eval(&mut Reals, session.graph(), id, &point)
        }
        Some(Ok(other)) => panic!("{name} is {}", other.show(session.graph())),
        Some(Err(told)) => panic!("{name}: {}", told.title),
        None => panic!("{name} has no value"),
    }
}

fn loaded(script: &str) -> Session {
    let mut session = session_with(&[("ramp.nrrd", RAMP)]);
    let outcome = session.input("test.geo", script, Mode::Script);
    assert!(outcome.accepted, "{script}\n{}", messages(&outcome));
    session
}

fn near(a: f64, b: f64) -> bool {
    a == b || a.is_nan() && b.is_nan() || (a - b).abs() <= 1e-14 * a.abs().max(b.abs())
}

/// Each case: the script, which defines `v`; the point; the value of `v` there.
fn check(cases: &[(&str, &[f64], f64)]) {
    for (script, point, expected) in cases {
        let found = value_at(&loaded(script), "v", point);
        assert!(near(found, *expected), "{script}\nat {point:?}: found {found}, expected {expected}");
    }
}

const NAN: f64 = f64::NAN;

#[test]
fn operators_bind_as_the_table_says() {
    check(&[
        ("v = 2**3**2;", &[], 512.0),
        ("v = -x1**2;", &[3.0], -9.0),
        ("v = 2**-1;", &[], 0.5),
        ("v = 7 - 2 - 1;", &[], 4.0),
        ("v = 8 / 2 * 3;", &[], 12.0),
        ("r_alpha = 1; v = x1-1 & 1+3-x1;", &[2.0], 1.0),
        ("r_alpha = 1; v = x1 | 0-x1 & 5;", &[2.0], 2.0),
        ("r_alpha = 1; v = 1 \\ 2;", &[], -2.0),
        ("r_alpha = 1; v = 3 @ 2;", &[], 2.0),
        ("r_alpha = 1; v = ~x1 + 1;", &[2.0], -1.0),
        ("v = 1 < x1 <= 3;", &[3.0], 1.0),
        ("v = 1 < x1 <= 3;", &[1.0], 0.0),
        ("v = NOT 1 > 2 AND 3 <> 4;", &[], 1.0),
        ("v = 0 OR 5 AND 0;", &[], 0.0),
        ("v = q + s WHERE q = 2, s = q*10;", &[], 22.0),
        ("v = (q WHERE q = x1) * 2;", &[4.0], 8.0),
        ("v = IF x1 > 0 THEN 1 ELSE IF x1 < 0 THEN -1 ELSE 0;", &[-3.0], -1.0),
        ("v = IF x1 > 0 THEN 1;", &[-3.0], NAN),
        ("v = 1e-3 + .5 + 2.;", &[], 2.501),
        ("v = pi;", &[], std::f64::consts::PI),
        ("v = Sin(0) + cOs(0);", &[], 1.0),
        ("height = 3; max = 4; v = height + max;", &[], 7.0),
        ("v = x1**0.5;", &[9.0], 3.0),
        ("v = (1 > 2) = 0;", &[], 1.0),
    ]);
}

#[test]
fn r_functions_follow_the_system_in_force() {
    check(&[
        ("v = 3 | 4;", &[], 12.0),
        ("v = 3 & 4;", &[], 2.0),
        ("v = 3 \\ -4;", &[], 2.0),
        ("r_alpha = 1; v = 3 | 4;", &[], 4.0),
        ("r_m = 1; v = 3 | 4;", &[], 60.0),
        ("r_m = 2; r_m = 0; v = 3 | 4;", &[], 12.0),
        ("r_alpha = 1; r_m = 1; v = 3 | 4;", &[], 60.0),
        ("r_m = 1; r_alpha = 1; v = 3 | 4;", &[], 4.0),
        ("r_alpha = 1; a = 3 | 4; r_alpha = 0; v = a;", &[], 4.0),
        ("r_alpha = 1; f(p) = p | 4; r_alpha = 0; v = f(3);", &[], 4.0),
        ("r_alpha = k; v = 3 | 4; k = 1;", &[], 4.0),
        ("r_alpha = 0.5; v = r_alpha; r_alpha = 1;", &[], 0.5),
        ("f(p) = BEGIN r_alpha = 1; f = p | 4; END; v = f(3) + (3 | 4);", &[], 16.0),
        ("r_alpha = x1; v = 3 | 4;", &[0.0], 12.0),
        ("r_alpha = 1; v = UNION([1, 5, 2]) + INTERSECTION(i = 1 TO 3, i);", &[], 6.0),
    ]);
}

#[test]
fn definitions_are_late_bound_and_statements_extend_what_is_above() {
    check(&[
        ("v = r1 + 1; r1 = 4;", &[], 5.0),
        ("r1 = 4; v = r1; r1 = 5;", &[], 5.0),
        ("v = 1; v = v + 1; v = v * 10;", &[], 20.0),
        ("v = b; v = v + 1; b = 5;", &[], 6.0),
        ("a = [1, 2, 3]; a[2] = 7; v = SUM(a);", &[], 11.0),
        ("a = [[1, 2], [3, 4]]; a[2, 1] = 10; v = a[2][1] + a[1, 2];", &[], 12.0),
        ("i = 1; s = b; WHILE (i <= 8) DO BEGIN s = s + i; i = i + 1; END; i = 5; v = s + i/100; b = 0;", &[], 36.05),
        ("i = 1; WHILE (i <= 8) DO i = i + 1; v = i;", &[], 9.0),
        ("s = 0; FOR i = 1 TO 3 DO s = s*10 + i; v = s;", &[], 123.0),
        ("s = 0; FOR i = 3 TO 1 STEP -1 DO s = s*10 + i; v = s;", &[], 321.0),
        ("s = 0; FOR i = 3 TO 1 DO s = s + 1; v = s;", &[], 0.0),
        ("s = 0; FOR i = 0 TO 1 STEP 0.1 DO s = s + 1; v = s;", &[], 11.0),
        ("i = 7; s = 0; FOR i = 1 TO 3 DO s = s + i; v = i;", &[], 7.0),
        ("s = 1; IF (c) THEN s = 2; ELSE s = 3; v = s; c = 0;", &[], 3.0),
        ("s = 1; IF (x1 > 0) THEN s = 2; v = s;", &[-1.0], 1.0),
        ("IF (x1 > 0) THEN s = 2; v = s;", &[-1.0], NAN),
        ("IF (x1 > 0) THEN s = 2; ELSE BEGIN s = 3; s = s + x1; END; v = s;", &[-1.0], 2.0),
        ("a = ARRAY(i = 1 TO 3, 0); FOR i = 1 TO 3 DO a[i] = i*i; v = a[3] + LEN(a);", &[], 12.0),
        // An escape-time loop: its condition differs from point to point.
        ("n = 0; z = x1; WHILE (n < 50 AND z < 100) DO BEGIN z = z*z; n = n + 1; END; v = n;", &[2.0], 3.0),
        ("n = 0; z = x1; WHILE (n < 50 AND z < 100) DO BEGIN z = z*z; n = n + 1; END; v = n;", &[0.5], 50.0),
    ]);
}

#[test]
fn functions_have_their_own_scope() {
    check(&[
        ("f(p, q) = p - q; v = f(5, 3);", &[], 2.0),
        ("fact(n) = IF n <= 1 THEN 1 ELSE n*fact(n - 1); v = fact(5);", &[], 120.0),
        ("f(n) = BEGIN s = 0; FOR i = 1 TO n DO s = s + i; f = s; END; v = f(4);", &[], 10.0),
        ("v = BEGIN t = 3; v = t*t; END;", &[], 9.0),
        ("f(t) = t + k; k = 10; v = (f(1) WHERE k = 100);", &[], 11.0),
        ("f(n) = BEGIN f = 1; IF n > 1 THEN f = n*f(n - 1); END; v = f(4);", &[], 24.0),
        ("twice(g, t) = g(g(t)); h(t) = t*3; v = twice(h, 2);", &[], 18.0),
        ("f(n) = BEGIN g(t) = t + n; f = g(10); END; v = f(5);", &[], 15.0),
        ("f((gob/pob) g1, (real) a1,) = g1*a1; v = f(x1, 2);", &[4.0], 8.0),
        ("f((array) a) = SUM(a); v = f([1, 2]);", &[], 3.0),
        ("f((text) k) = INTERPOLATE(k, \"ramp.nrrd\", x1); v = f(\"trilinear\");", &[0.25], 0.25),
        ("f(n) = BEGIN g(t) = IF t <= 0 THEN 0 ELSE n + g(t - 1); f = g(4); END; v = f(5);", &[], 20.0),
        ("f(t) = t**2; g = f; v = g(3);", &[], 9.0),
        ("b = 2; f(b) = b + c; c = b; v = f(10);", &[], 12.0),
        (
            "even(n) = IF n <= 0 THEN 1 ELSE odd(n - 1); odd(n) = IF n <= 0 THEN 0 ELSE even(n - 1); v = even(7);",
            &[],
            0.0,
        ),
        (
            "v = even(6); odd(n) = IF n <= 0 THEN 0 ELSE even(n - 1); even(n) = IF n <= 0 THEN 1 ELSE odd(n - 1);",
            &[],
            1.0,
        ),
    ]);
}

#[test]
fn at_maps_the_whole_object() {
    check(&[
        ("g = x1 + 10*x2; v = g AT (x2, x1);", &[1.0, 2.0], 12.0),
        ("g = x1 + 10*x2; v = g AT (x2 = 5);", &[1.0, 2.0], 51.0),
        ("g = x1 + 10*x2; v = g(7);", &[1.0, 2.0], 27.0),
        ("g = x1 + 10*x2; v = g(x2 = 7);", &[1.0, 2.0], 71.0),
        ("g = x1 + 10*x2; v = g AT ([7, 8]);", &[], 87.0),
        ("v = x1**2 AT (x1 = 3);", &[2.0], 4.0),
        ("v = (x1**2) AT (x1 = 3);", &[2.0], 9.0),
        ("f(p) = p AT (x1 = x1 + 1); v = f(x1*2);", &[3.0], 8.0),
        ("a = [x1, 2*x1] AT (x1 = 5); v = SUM(a);", &[], 15.0),
        ("g = x1; h = g AT (x1 = x1*2); v = h AT (x1 = x1 + 1);", &[3.0], 8.0),
    ]);
}

#[test]
fn arrays_folds_and_derivatives() {
    check(&[
        ("v = SUM(i = 1 TO 4, i**2);", &[], 30.0),
        ("v = SUM(i = 1 TO 0, i) + PRODUCT(i = 1 TO 0, i);", &[], 1.0),
        ("v = MAXIMUM([1, 9, 3]) - MINIMUM(i = 2 TO 5, i);", &[], 7.0),
        ("v = SUM([1, 2, 3]*2 + [1, 1, 1]);", &[], 15.0),
        ("v = DOT([1, 2, 3], [4, 5, 6]) + NORM([3, 4]);", &[], 37.0),
        ("v = CROSS([1, 0, 0], [0, 1, 0])[3] + JOIN([1], [2, 3])[3];", &[], 4.0),
        ("v = MAX(1, 5, 3) + MIN([4, 2]);", &[], 7.0),
        ("v = SQRT([4, 9])[2];", &[], 3.0),
        ("a = [10, 20, 30]; v = a[x1];", &[2.0], 20.0),
        ("a = [10, 20, 30]; v = a[x1];", &[2.5], NAN),
        ("a = [10, 20, 30]; v = a[x1];", &[4.0], NAN),
        ("v = RANDOM(1, 5) = RANDOM(1, 5) AND RANDOM(1, 5) <> RANDOM(1, 6);", &[], 1.0),
        ("v = DIFF(x1**3, x1);", &[2.0], 12.0),
        ("v = GRAD(x1*x2)[1];", &[2.0, 7.0], 7.0),
        ("v = DIFF(s, r1); s = r1**2*x1; r1 = 3;", &[5.0], 30.0),
        ("f(t) = DIFF(t**2*x1, t); v = f(3);", &[5.0], 30.0),
        ("v = INTERPOLATE(\"trilinear\", \"ramp.nrrd\", x1);", &[0.75], 0.75),
        ("v = SUM(ARRAY(i = 1 TO 3, ARRAY(j = 1 TO 2, i*j))[3]);", &[], 9.0),
    ]);
}

/// Each case: the script, and what the code and title of its first message must contain.
fn fails(cases: &[(&str, &str)]) {
    for (script, expected) in cases {
        let mut session = session_with(&[]);
        let outcome: Outcome = session.input("test.geo", script, Mode::Script);
        let found = messages(&outcome);
        assert!(!outcome.accepted, "{script}\nwas accepted: {found}");
        assert!(found.lines().next().unwrap_or("").contains(expected), "{script}\nfound {found}\nexpected {expected}");
        assert_eq!(session.names(), [""; 0], "{script}");
        let placed = outcome.diagnostics.iter().all(|d| !d.labels.is_empty());
        assert!(placed, "{script}: a message without a place");
    }
}

#[test]
fn what_can_be_known_is_an_error_at_once() {
    fails(&[
        ("v = SQRT(-1);", "undefined: SQRT(-1) is undefined"),
        ("v = 1/0;", "division-by-zero: 1/0 divides by zero"),
        ("v = LOG(0);", "infinite: LOG(0)"),
        ("a = [1, 2]; v = a[9];", "bad-index: there is no element 9: the array has 2 elements"),
        ("a = [1, 2]; v = a[1.5];", "bad-index: an index must be a whole number, not 1.5"),
        ("a = [1, 2]; a[3] = 1;", "bad-index: there is no element 3"),
        ("v = MAXIMUM(i = 1 TO 0, i);", "empty-fold"),
        ("v = [1, 2] + [1, 2, 3];", "lengths-differ"),
        ("v = [1, 2] | 3;", "needs-number: an operand of `|` cannot be an array"),
        ("v = nope;", "unknown-name: `nope` is not defined"),
        ("v = SIN(1, 2);", "wrong-count"),
        ("f(p) = SIN(p, 2);", "wrong-count"),
        ("f(p) = p; g(q) = f(q, q);", "wrong-count: `f(p)` takes 1 argument, not 2"),
        ("f(p) = p; v = f(1, 2);", "wrong-count: `f(p)` takes 1 argument, not 2"),
        ("f((real) p) = p; v = f([1]);", "wrong-kind: `p` of `f(p)` cannot be an array"),
        ("v = 3; w = v(2);", "not-callable"),
        ("a = b; b = c; c = a;", "circle: these definitions go round in a circle: a -> b -> c -> a"),
        ("a = 1; b = a; a = a + b;", "circle"),
        ("v = v + 1;", "extends-nothing"),
        ("a[1] = 2;", "element-of-nothing"),
        ("i = 1; WHILE (i <= 8) DO s = 1;", "loop-never-steps"),
        ("i = 1; WHILE (i > 0) DO i = i + 1;", "too-many-turns"),
        ("i = 1; WHILE (x1 > 0) DO x = 1;", "loop-never-steps"),
        (
            "z = x1; i = 0; WHILE (z < 9) DO BEGIN z = z + RANDOM(1, i)/1e6; i = i + 1; END;",
            "unbounded-loop: this loop depends on x1",
        ),
        ("f(n) = f(n + 1); v = f(1);", "too-many-calls"),
        ("f(n) = BEGIN s = n; END; v = f(1);", "no-result"),
        ("f(n) = BEGIN s = n; END;", "no-result"),
        ("f(n) = g(n); g(n) = f(n + 1); v = f(1);", "too-many-calls"),
        ("f(n) = g(n); g(n) = f(n) + a; a = f(1);", "circle: these definitions go round in a circle: f -> g -> a -> f"),
        ("f(n) = BEGIN s = s + n; f = s; END; s = 1; v = f(1);", "read-before-assigned: `s`"),
        ("f(n) = n; v = f + 1;", "no-arithmetic"),
        ("gob_a(n) = n;", "gob-with-parameters"),
        ("max(a, b) = a;", "builtin-name"),
        ("r_alpha = 2; v = 1 | 2;", "bad-system: `r_alpha` cannot be 2"),
        ("r_m = 1.5;", "bad-system: `r_m` cannot be 1.5"),
        ("FOR i = 1 TO x1 DO s = i;", "needs-constant: a bound of FOR cannot depend on x1"),
        ("PRINT a; a = 1;", "defined-later: `a` is defined only further down"),
        ("b = a; PRINT b; a = 1;", "defined-later: `a` is defined only further down"),
        ("v = INTERPOLATE(\"trilinear\", \"teapot.dat\", x1, x2, x3);", "cannot-read: cannot read `teapot.dat`"),
        ("INCLUDE \"nope.geo\";", "cannot-read"),
        ("r1 = 4 IN [8, 1];", "empty-range"),
        ("r1 = 4 IN [1, 8] STEP 0;", "bad-step: the STEP of a range cannot be 0"),
        ("x1 : CENTER = [0];", "bad-type"),
        ("f(p, p) = p;", "parameter-twice"),
        ("gob_a = [1, 2];", "not-an-object: `gob_a`"),
        ("i = 1; WHILE (i <= 8) DO s = s + j;", "loop-never-steps"),
    ]);
}

#[test]
fn as_printed_is_explained_error_by_error() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/data/models/as-printed.txt");
    let Ok(text) = std::fs::read_to_string(path) else {
        eprintln!("skipped: {path} is missing");
        return;
    };
    // Mended step by step; each step must show the errors that were hidden before.
    let mut session = session_with(&[]);
    let outcome = session.input("as-printed.txt", &text, Mode::Script);
    let found = messages(&outcome);
    let helps = |outcome: &Outcome| -> String {
        outcome.diagnostics.iter().flat_map(|d| d.help.clone()).collect::<Vec<_>>().join("\n")
    };
    assert!(found.contains("`p_block_3D` is not defined"), "{found}");
    assert!(helps(&outcome).contains("`pob_block_3D`"), "{}", helps(&outcome));
    assert!(found.contains("teapot.dat"), "{found}");
    let text = text
        .replace("r_alpha = 1.\n", "r_alpha = 1.;\n")
        .replace("(r1**2-x1**2-x3**2) & 10.5-x2)", "((r1**2-x1**2-x3**2) & 10.5-x2)")
        .replace("SIN(-1+x2/c2)**2", "SIN(-1+x2/c2))**2")
        .replace("COS(-1+x2/c2)**2) )", "COS(-1+x2/c2))**2 )")
        .replace("(x3-pz[i])**2);", "(x3-pz[i])**2));");
    let outcome = session.input("as-printed.txt", &text, Mode::Script);
    let (found, helps) = (messages(&outcome), helps(&outcome));
    assert!(found.contains("`c1` is not defined") && found.contains("`c2` is not defined"), "{found}");
    assert!(helps.contains("`e1`") && helps.contains("`e2`"), "{helps}");
    assert!(found.contains("loop-never-steps"), "{found}");
    assert!(found.contains("`i` is not defined"), "{found}");
}

#[test]
fn an_object_at_a_point_and_a_derivative_by_a_parameter_are_numbers() {
    let cases = [
        ("v = x1**2 - x2; PRINT v(3, 4), v AT (x1 = 3, x2 = 1);", "5 8"),
        ("v = (x1 - x2) AT (x2, x1); PRINT v AT (5, 3);", "-2"),
        ("v = x1 AT (x1 = x1 + 1) AT (x1 = 2*x1); PRINT v(5);", "11"),
        ("r = 3; PRINT DIFF(r**2, r), DIFF(x1**3, x1) AT (2);", "6 12"),
        ("v = IF x1 > 0 THEN x1; PRINT v(1), v(-1);", "1 undefined"),
        (
            "v = SQRT(x1); PRINT (v | 2) AT (-1), MAX(v, 2) AT (-1), (v & 2) AT (-1), (v > 0) AT (-1);",
            "2 2 undefined 0",
        ),
        ("v = x1 | x2; r_alpha = 1; w = x1 | x2; PRINT v(3, 4), w(3, 4);", "12 4"),
        ("z = 0; n = 0; WHILE (z < 4 AND n < 9) DO BEGIN z = z**2 + x1; n = n + 1; END; PRINT n(2), z(2);", "2 6"),
        ("a = [10, 20]; v = a[x1]; PRINT v(2), v(1.5);", "20 undefined"),
        ("v = INTERPOLATE(\"trilinear\", \"ramp.nrrd\", x1); PRINT v(0.5), v(2);", "0.5 0"),
    ];
    for (script, expected) in cases {
        let mut session = session_with(&[("ramp.nrrd", RAMP)]);
        let outcome = session.input("test.geo", script, Mode::Script);
        assert_eq!(
            outcome.events.last(),
            Some(&Event::Printed(expected.to_owned())),
            "{script}\n{}",
            messages(&outcome)
        );
    }
}

#[test]
fn what_is_wrong_in_a_body_is_told_once_though_it_is_called() {
    for script in [
        "f(p) = SIN(p, 2); v = f(1);",
        "f(p) = p; g(q) = f(q, q); v = g(1); w = g(2);",
        "f(n) = BEGIN s = n; END; v = f(1);",
    ] {
        let outcome = session_with(&[]).input("s.geo", script, Mode::Script);
        assert_eq!(outcome.diagnostics.len(), 1, "{script}: {}", messages(&outcome));
    }
}
