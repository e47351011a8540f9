//! Lp norms: exact cases, digits that neither overflow nor underflow, slopes against difference quotients, and the language's forms.

use yont::number::{Dual, Ternary};

use crate::conformance::Random;
use crate::session::{messages, session};
use crate::stdlib::worth;

const INF: f64 = f64::INFINITY;

fn norm(a: f64, b: f64, p: f64) -> f64 {
    Ternary::Norm.real(a, b, p)
}

#[test]
fn norms_that_are_known() {
    let known = [
        (3.0, 4.0, 2.0, 5.0),
        (3.0, -4.0, 1.0, 7.0),
        (6.0, 12.0, -1.0, 4.0),
        (3.0, 4.0, INF, 4.0),
        (3.0, 4.0, -INF, 3.0),
        (4.0, 9.0, 0.5, 25.0),
        (0.0, 5.0, 3.0, 5.0),
        (0.0, 5.0, -3.0, 0.0),
        (0.0, 0.0, 2.0, 0.0),
        (INF, 5.0, 2.0, INF),
        (INF, 5.0, -2.0, 5.0),
        (INF, INF, -2.0, INF),
        (INF, INF, INF, INF),
        (1e300, 1e300, 1000.0, 1e300 * 2f64.powf(1e-3)),
        (1e-300, 1e-300, 1000.0, 1e-300 * 2f64.powf(1e-3)),
        (1e300, 1e-300, -1000.0, 1e-300),
        (1e10, 1e10, 32.0, 1e10 * 2f64.powf(1.0 / 32.0)),
    ];
    for (a, b, p, value) in known {
        let got = norm(a, b, p);
        let close = got == value || (got / value - 1.0).abs() < 1e-14;
        assert!(close && norm(b, a, p) == got, "the {p}-norm of {a} and {b} is {got}, not {value}");
    }
    for (a, b, p) in [(1.0, 2.0, 0.0), (f64::NAN, 1.0, 2.0), (1.0, f64::NAN, -2.0), (1.0, 2.0, f64::NAN)] {
        assert!(norm(a, b, p).is_nan(), "{a}, {b}, {p}");
    }
}

#[test]
fn slopes_are_those_of_difference_quotients() {
    let mut random = Random(5);
    for p in [-40.0, -3.0, -1.0, 0.4, 1.0, 2.0, 7.5, 1000.0] {
        for _ in 0..200 {
            let (a, b) = (random.between(-3.0, 3.0), random.between(-3.0, 3.0));
            let apart = (a.abs() / b.abs()).ln().abs();
            if a.abs() < 0.1 || b.abs() < 0.1 || apart * f64::abs(p) < 1e-2 {
                continue;
            }
            let number = |value: f64, at: usize| Dual::<3>::variable(value, at);
            let got = Ternary::Norm.dual(number(a, 0), number(b, 1), number(p, 2));
            let h = 1e-6 / f64::abs(p).max(1.0);
            let quotient = |f: &dyn Fn(f64) -> f64| (f(h) - f(-h)) / (2.0 * h);
            let wanted =
                [quotient(&|h| norm(a + h, b, p)), quotient(&|h| norm(a, b + h, p)), quotient(&|h| norm(a, b, p + h))];
            assert_eq!(got.value, norm(a, b, p));
            for (slope, wanted) in got.slope.iter().zip(wanted) {
                let room = 1e-4 * (1.0 + wanted.abs());
                assert!((slope - wanted).abs() < room, "p = {p} at {a}, {b}: {slope}, not {wanted}");
            }
        }
    }
}

#[test]
fn what_the_language_says_of_norms() {
    let cases = [
        ("PNORM([3, 4], 2);", "5"),
        ("PNORM(2, 3, 6, 2);", "7"),
        ("PNORM([-7], 3);", "7"),
        ("PNORM([2, 9, 4], INFINITY);", "9"),
        ("PNORM([2, 9, 4], -infinity);", "2"),
        ("DIFF(PNORM(x1, x2, 2), x1) AT (3, 4);", "0.6"),
        ("DIFF(PNORM(x1, x2, INFINITY), x2) AT (3, -4);", "-1"),
        ("(PNORM(x1, x2, x3) AT (1, 1, 2))**2 - 2 < 1e-15;", "1"),
        ("pob_lp(fn_lp_and([fn_strip([1, 0], 0), fn_strip([0, 1], 0)], 1000), 1) AT (1, 0.5);", "0"),
        ("fn_lp_and([x1, x2], 1000) AT (1e-200, 1e-201);", "1e-200"),
        ("fn_lp_or([x1, x2], 1000) AT (1e200, 1e199);", "1e199"),
        ("fn_face19([1, 0], 0.5, [0.1, 0], 0.01) AT (0.6, 3);", "1"),
        ("fn_lp_each([x1, x2], [-2, 4]) AT (2, 0);", "0.7071067811865475"),
        ("tr_ricci_union(1 - ABS(x1), 1 - ABS(x2), INFINITY) AT (3, 2);", "-1"),
        ("1 - tr_morph_star(1 - ABS(x1), 1 - ABS(x2), 1) AT (3, 2);", "3"),
    ];
    for (program, value) in cases {
        let got = worth(&mut session(), program);
        let close = |a: &str, b: &str| match (a.parse::<f64>(), b.parse::<f64>()) {
            (Ok(a), Ok(b)) => a == b || (a - b).abs() < 1e-12 * b.abs(),
            _ => false,
        };
        assert!(close(&got, value), "{program} is {got}, not {value}");
    }
    for (program, code) in [
        ("a = PNORM(1, 2, 0);", "zero-norm"),
        ("a = PNORM(1, 2);", "wrong-kind"),
        ("a = PNORM([[1], 2], 2);", "wrong-kind"),
        ("INFINITY = 3;", "reserved-name"),
    ] {
        let outcome = session().input("a", program, yont::syntax::Mode::Script);
        assert!(messages(&outcome).contains(code), "{program}: {}", messages(&outcome));
    }
}
