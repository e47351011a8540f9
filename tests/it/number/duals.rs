//! Derivatives against difference quotients, and at the points where the language settles them.

use yont::number::{Binary, Dual, Ternary, Unary};

use super::{Random, UNARY};

type One = Dual<1>;

/// The derivative of `f` at 0 by a central difference of fourth order, and how far it may be trusted.
fn quotient(f: impl Fn(f64) -> f64, scale: f64) -> (f64, f64) {
    let h = 1e-3 * scale;
    let slope = |h: f64| (8.0 * (f(h) - f(-h)) - (f(2.0 * h) - f(-2.0 * h))) / (12.0 * h);
    let (coarse, fine) = (slope(h), slope(h / 2.0));
    let size = f(0.0).abs() + f(h).abs();
    (fine, 2.0 * (coarse - fine).abs() + 1e-14 * size / h + 1e-9 * fine.abs())
}

/// Whether the operation is smooth near the point: the difference quotient says so by itself.
fn check(what: &str, dual: One, f: impl Fn(f64) -> f64, scale: f64) -> bool {
    let value = f(0.0);
    assert!(
        dual.value.to_bits() == value.to_bits() || (dual.value.is_nan() && value.is_nan()),
        "{what}: value {dual:?}"
    );
    let (slope, room) = quotient(f, scale);
    if !slope.is_finite() || room > 1e-4 * slope.abs() + 1e-6 {
        return false;
    }
    assert!((dual.slope[0] - slope).abs() <= 4.0 * room, "{what}: {:?}, not {slope:?} +- {room:?}", dual.slope[0]);
    true
}

fn towards(value: f64, slope: f64) -> One {
    Dual { value, slope: [slope] }
}

#[test]
fn derivatives_agree_with_difference_quotients() {
    let mut random = Random(30);
    for &op in UNARY.iter() {
        let checked = (0..500).filter(|_| {
            let (x, d) = (random.within(-2.5, 2.5), random.within(-1.0, 1.0));
            check(&format!("{op:?} at {x:?}"), op.dual(towards(x, d)), |h| op.real(x + d * h), 1.0)
        });
        assert!(checked.count() > 50, "{op:?} was hardly checked");
    }
    for &op in Binary::ALL {
        let checked = (0..500).filter(|_| {
            let (x, y) = (random.within(-2.5, 2.5), random.within(-2.5, 2.5));
            // Many steps of MOD within the difference would look smooth.
            let y = y.abs().max(0.3).copysign(y);
            let (d, e) = (random.within(-1.0, 1.0), random.within(-1.0, 1.0));
            let dual = op.dual(towards(x, d), towards(y, e));
            check(&format!("{op:?} at {x:?}, {y:?}"), dual, |h| op.real(x + d * h, y + e * h), 1.0)
        });
        assert!(checked.count() > 50, "{op:?} was hardly checked");
    }
    for &op in Ternary::ALL {
        let checked = (0..1500).filter(|_| {
            let (x, y, z) = (random.within(-2.5, 2.5), random.within(-2.5, 2.5), random.within(-0.9, 3.0));
            let (d, e) = (random.within(-1.0, 1.0), random.within(-1.0, 1.0));
            let f = if random.once_in(2) { 0.0 } else { random.within(-1.0, 1.0) };
            let dual = op.dual(towards(x, d), towards(y, e), towards(z, f));
            let what = format!("{op:?} at {x:?}, {y:?}, {z:?}");
            check(&what, dual, |h| op.real(x + d * h, y + e * h, z + f * h), 0.3)
        });
        assert!(checked.count() > 150, "{op:?} was hardly checked");
    }
}

#[test]
fn the_taken_branch_decides() {
    let (x, y) = (Dual::<2>::variable(1.0, 0), Dual::<2>::variable(1.0, 1));
    let c = Dual::constant;
    let zero = Dual::<2>::variable(0.0, 0);
    let half = Unary::Powi(2).dual(Dual::<2>::variable(0.5f64.sqrt(), 0)).slope[0];
    let cases = [
        ("max on a tie", Binary::Max.dual(x, y), [1.0, 0.0]),
        ("min on a tie", Binary::Min.dual(x, y), [1.0, 0.0]),
        ("abs at 0", Unary::Abs.dual(zero), [1.0, 0.0]),
        ("a step", Unary::Floor.dual(x), [0.0, 0.0]),
        ("a comparison", Binary::Less.dual(x, y), [0.0, 0.0]),
        ("if", Ternary::Select.dual(c(0.0), x, y), [0.0, 1.0]),
        ("if undefined", Ternary::Select.dual(c(f64::NAN), x, y), [0.0, 1.0]),
        ("union where both vanish", Ternary::Union.dual(zero, Dual::<2>::variable(0.0, 1), c(0.0)), [1.0, 1.0]),
        ("union where both vanish, another alpha", Ternary::Union.dual(zero, c(0.0), c(0.5)), [1.0 / 1.5, 0.0]),
        ("smooth union where both vanish", Ternary::UnionSmooth.dual(zero, c(0.0), c(1.0)), [0.0, 0.0]),
        ("union as max on a tie", Ternary::Union.dual(x, y, c(1.0)), [1.0, 0.0]),
        ("intersection as min on a tie", Ternary::Intersection.dual(x, y, c(1.0)), [1.0, 0.0]),
        ("union with an undefined operand", Ternary::Union.dual(c(f64::NAN), y, c(0.0)), [0.0, 1.0]),
        ("union with minus infinity", Ternary::Union.dual(c(f64::NEG_INFINITY), y, c(0.0)), [0.0, 1.0]),
        ("a power of a constant", Binary::Pow.dual(c(0.0), c(0.5)), [0.0, 0.0]),
        ("the square root of a constant", Unary::Sqrt.dual(c(0.0)), [0.0, 0.0]),
        ("a square", Unary::Powi(2).dual(Dual::variable(0.5f64.sqrt(), 0)), [half, 0.0]),
        ("x**y at x = 0", Binary::Pow.dual(zero, Dual::<2>::variable(2.0, 1)), [0.0, 0.0]),
    ];
    for (what, dual, slope) in cases {
        assert_eq!(dual.slope, slope, "{what}: {dual:?}");
    }
}
