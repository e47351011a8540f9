//! R-functions: signs, exactness, error and undefined operands.

use astro_float::BigFloat;
use yont::number::{Ternary, Unary};

use super::Random;
use super::functions::{BITS, RM, big, small};

const SYSTEMS: &[f64] = &[1.0, 0.0, 0.5, -0.5, -0.999, 0.999_999];

/// Widely scaled, equal, opposite, nearly equal and zero pairs.
fn pair(random: &mut Random) -> (f64, f64) {
    let scaled = |random: &mut Random| random.within(-1.0, 1.0) * 2f64.powf(random.within(-1000.0, 1000.0));
    let a = scaled(random);
    let b = match random.bits() % 8 {
        0 => a,
        1 => -a,
        2 => -a * (1.0 + 1e-14 * random.unit()),
        3 => a * random.within(-1e-16, 1e-16),
        4 => 0.0,
        5 => a * random.within(-3.0, 3.0),
        _ => scaled(random),
    };
    if random.once_in(2) { (a, b) } else { (b, a) }
}

/// The union by the quadratic equation that it solves, in 192 bits without cancellation.
fn exact(f: f64, g: f64, alpha: f64) -> BigFloat {
    let (f, g, a) = (big(f), big(g), big(alpha));
    let sum = f.add(&g, BITS, RM);
    let difference = f.sub(&g, BITS, RM);
    let twice = big(2.0).mul(&f.mul(&g, BITS, RM), BITS, RM);
    let skew = big(1.0).sub(&a, BITS, RM).mul(&twice, BITS, RM);
    let root = difference.mul(&difference, BITS, RM).add(&skew, BITS, RM).sqrt(BITS, RM);
    if sum.is_negative() {
        return twice.div(&sum.sub(&root, BITS, RM), BITS, RM);
    }
    sum.add(&root, BITS, RM).div(&big(1.0).add(&a, BITS, RM), BITS, RM)
}

#[test]
fn unions_keep_their_error_bound() {
    let mut random = Random(20);
    let mut worst = (0.0, 0.0, 0.0, 0.0);
    for _ in 0..60_000 {
        let (f, g) = pair(&mut random);
        let alpha = random.one_of(SYSTEMS);
        let (value, exact) = (Ternary::Union.real(f, g, alpha), exact(f, g, alpha));
        let near = small(&exact);
        if near.abs() < f64::MIN_POSITIVE || near.is_infinite() {
            continue;
        }
        let error = small(&big(value).sub(&exact, BITS, RM).div(&exact, BITS, RM)).abs();
        worst = if error > worst.0 { (error, f, g, alpha) } else { worst };
    }
    eprintln!("the worst relative error of a union: {worst:?}");
    assert!(worst.0 < 4.6e-16, "{worst:?}");
}

fn sign(x: f64) -> f64 {
    Unary::Sign.real(x)
}

#[test]
fn signs_are_those_of_max_and_min() {
    let mut random = Random(21);
    for _ in 0..100_000 {
        let (f, g) = if random.once_in(4) { (random.any(), random.any()) } else { pair(&mut random) };
        let alpha = random.one_of(SYSTEMS);
        let m = random.one_of(&[0.0, 1.0, 2.0, 3.0, 8.0]);
        let (most, least) = (sign(f.max(g)), sign(f.min(g)));
        for (op, parameter, want) in [
            (Ternary::Union, alpha, most),
            (Ternary::Intersection, alpha, least),
            (Ternary::UnionSmooth, m, most),
            (Ternary::IntersectionSmooth, m, least),
        ] {
            let value = op.real(f, g, parameter);
            assert_eq!(sign(value), want, "{op:?} of {f:?}, {g:?} with {parameter} is {value:?}");
            let (f, g) = (f as f32, g as f32);
            let want = if want == most { sign(f.max(g).into()) } else { want };
            let want = if op == Ternary::Intersection || op == Ternary::IntersectionSmooth {
                sign(f.min(g).into())
            } else {
                want
            };
            let single = op.single(f, g, parameter as f32);
            assert_eq!(sign(single.into()), want, "{op:?} of the singles {f:?}, {g:?} with {parameter} is {single:?}");
        }
    }
}

#[test]
fn alpha_one_is_max_and_min_exactly() {
    let mut random = Random(22);
    for _ in 0..20_000 {
        let (f, g) = (random.any(), random.any());
        assert_eq!(Ternary::Union.real(f, g, 1.0), f.max(g));
        assert_eq!(Ternary::Intersection.real(f, g, 1.0), f.min(g));
    }
}

#[test]
fn values_of_the_paper() {
    let third = 1.0 / 3.0;
    let cases = [
        (Ternary::Union, 3.0, 4.0, 0.0, 12.0),
        (Ternary::Intersection, 3.0, 4.0, 0.0, 2.0),
        (Ternary::Union, 1.0, 1.0, 0.5, 2.0),
        (Ternary::Union, 1.0, 1.0, -0.5, (2.0 + 3f64.sqrt()) / 0.5),
        (Ternary::UnionSmooth, 3.0, 4.0, 1.0, 60.0),
        (Ternary::UnionSmooth, 3.0, 4.0, 2.0, 300.0),
        (Ternary::UnionSmooth, 3.0, 4.0, 0.0, 12.0),
        (Ternary::IntersectionSmooth, 3.0, 4.0, 1.0, 10.0),
        (Ternary::Union, third, -2.0 * third, 0.0, third * (5f64.sqrt() - 1.0)),
    ];
    for (op, f, g, parameter, want) in cases {
        let value = op.real(f, g, parameter);
        assert!(
            (value - want).abs() <= 1e-15 * want.abs(),
            "{op:?} of {f}, {g} with {parameter} is {value:?}, not {want:?}"
        );
    }
}

#[test]
fn undefined_operands_and_parameters() {
    const NAN: f64 = f64::NAN;
    for op in [Ternary::Union, Ternary::UnionSmooth] {
        assert_eq!((op.real(NAN, -3.0, 1.0), op.real(2.0, NAN, 1.0)), (-3.0, 2.0));
        assert!(op.real(NAN, NAN, 1.0).is_nan() && op.real(1.0, 2.0, NAN).is_nan());
    }
    for op in [Ternary::Intersection, Ternary::IntersectionSmooth] {
        assert!(op.real(NAN, -3.0, 1.0).is_nan() && op.real(2.0, NAN, 1.0).is_nan() && op.real(1.0, 2.0, NAN).is_nan());
    }
    for alpha in [-1.0, -1.5, 1.0f64.next_up(), f64::INFINITY] {
        assert!(Ternary::Union.real(1.0, 2.0, alpha).is_nan() && Ternary::Intersection.real(1.0, 2.0, alpha).is_nan());
    }
    assert!(Ternary::UnionSmooth.real(1.0, 2.0, -1.0).is_nan());
    assert_eq!(Ternary::Select.real(NAN, 1.0, 2.0), 2.0);
}
