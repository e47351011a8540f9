//! Elementary functions against an oracle of 192 bits, and at the points where they are exact.

use std::f64::consts::FRAC_PI_2;

use astro_float::{BigFloat, Consts, RoundingMode};
use yont::number::{Binary, Unary, functions};

use super::{Random, UNARY};

pub(super) const BITS: usize = 192;
pub(super) const RM: RoundingMode = RoundingMode::None;

/// The oracle misreads subnormal numbers: they are given to it scaled.
pub(super) fn big(x: f64) -> BigFloat {
    if x.abs() >= f64::MIN_POSITIVE {
        return BigFloat::from_f64(x, BITS);
    }
    let scale = 2f64.powi(200);
    BigFloat::from_f64(x * scale, BITS).div(&BigFloat::from_f64(scale, BITS), BITS, RM)
}

/// The nearest double, about.
pub(super) fn small(x: &BigFloat) -> f64 {
    let Some((words, _, sign, exponent, _)) = x.as_raw_parts() else { return f64::NAN };
    let top = *words.last().expect("a mantissa has words") as f64 / 2f64.powi(64);
    let half = exponent / 2;
    let size = top * 2f64.powi(half) * 2f64.powi(exponent - half);
    if sign == astro_float::Sign::Neg { -size } else { size }
}

/// How far `value` is from `exact`, in units in the last place.
pub(super) fn ulps(value: f64, exact: &BigFloat) -> f64 {
    let near = small(exact);
    let unit = (near.abs().next_up() - near.abs()).max(f64::from_bits(1));
    small(&big(value).sub(exact, BITS, RM)).abs() / unit
}

fn oracle(op: Unary, x: f64, cc: &mut Consts) -> BigFloat {
    let a = big(x);
    let third = || big(1.0).div(&big(3.0), BITS, RM);
    match op {
        Unary::Sqrt => a.sqrt(BITS, RM),
        Unary::Cbrt if x < 0.0 => a.neg().pow(&third(), BITS, RM, cc).neg(),
        Unary::Cbrt => a.pow(&third(), BITS, RM, cc),
        Unary::Exp => a.exp(BITS, RM, cc),
        Unary::Log => a.ln(BITS, RM, cc),
        Unary::Log10 => a.log10(BITS, RM, cc),
        Unary::Sin => a.sin(BITS, RM, cc),
        Unary::Cos => a.cos(BITS, RM, cc),
        Unary::Tan => a.tan(BITS, RM, cc),
        Unary::Asin => a.asin(BITS, RM, cc),
        Unary::Acos => a.acos(BITS, RM, cc),
        Unary::Atan => a.atan(BITS, RM, cc),
        Unary::Sinh => a.sinh(BITS, RM, cc),
        Unary::Cosh => a.cosh(BITS, RM, cc),
        Unary::Tanh => a.tanh(BITS, RM, cc),
        Unary::Asinh => a.asinh(BITS, RM, cc),
        Unary::Acosh => a.acosh(BITS, RM, cc),
        Unary::Atanh => a.atanh(BITS, RM, cc),
        Unary::Powi(n) => (0..n.unsigned_abs()).fold(big(1.0), |all, _| {
            let next = all.mul(&a, BITS, RM);
            if n < 0 { all.div(&a, BITS, RM) } else { next }
        }),
        other => panic!("{other:?} is exact"),
    }
}

/// Where each function is sampled: evenly from .0 to .1, and with evenly distributed exponents over the same.
fn samples(op: Unary) -> &'static [(f64, f64)] {
    match op {
        Unary::Asin | Unary::Acos | Unary::Atanh => &[(-1.0, 1.0), (0.4, 0.6), (-1e-9, 1e-9), (0.99, 1.0)],
        Unary::Acosh => &[(1.0, 1.01), (1.0, 3.0), (1.0, 1e10)],
        Unary::Log | Unary::Log10 | Unary::Sqrt => &[(0.99, 1.01), (0.5, 2.0), (0.0, 1e5), (0.0, 1e300), (0.0, 1e-305)],
        Unary::Exp | Unary::Sinh | Unary::Cosh => &[(-1.0, 1.0), (-30.0, 30.0), (-700.0, 709.0), (-1e-9, 1e-9)],
        Unary::Sin | Unary::Cos | Unary::Tan => &[(-1.0, 1.0), (-10.0, 10.0), (-1e3, 1e3), (-1e6, 1e6), (1e6, 1e9)],
        Unary::Powi(_) => &[(-2.0, 2.0), (-1e3, 1e3)],
        _ => &[(-1.0, 1.0), (-3.0, 3.0), (-50.0, 50.0), (-1e10, 1e10)],
    }
}

#[test]
fn functions_keep_their_error_bounds() {
    let mut cc = Consts::new().expect("constants fit in memory");
    let mut random = Random(1);
    for &op in UNARY.iter().filter(|&&op| functions::error(op) > 0.0) {
        let mut worst = (0.0, 0.0);
        for &(lo, hi) in samples(op) {
            for turn in 0..1500 {
                let even = random.within(lo, hi);
                let scaled = random.one_of(&[lo, hi]) * 2f64.powf(-20.0 * random.unit());
                let x = if turn % 4 == 0 && (lo..=hi).contains(&scaled) { scaled } else { even };
                // Next to zeros and extrema the reduction loses most.
                let quarter = (even / FRAC_PI_2).round() * FRAC_PI_2;
                let x = if turn % 4 == 1 && quarter.abs() <= hi { quarter } else { x };
                let error = ulps(op.real(x), &oracle(op, x, &mut cc));
                worst = if error > worst.0 { (error, x) } else { worst };
            }
        }
        eprintln!("{op:?}: {:.3} units in the last place at {:?}", worst.0, worst.1);
        assert!(worst.0 <= functions::error(op), "{op:?} is off by {} at {:?}", worst.0, worst.1);
    }
}

#[test]
fn powers_and_angles_keep_their_error_bounds() {
    let mut cc = Consts::new().expect("constants fit in memory");
    let mut random = Random(2);
    let mut worst = [(0.0, 0.0, 0.0); 3];
    for _ in 0..8000 {
        let (size, exponent) = (2f64.powf(random.within(-30.0, 30.0)), random.within(-20.0, 20.0));
        let near_one = random.within(0.9, 1.1);
        let (x, y) = random.one_of(&[(size, exponent), (near_one, 200.0 * exponent), (size, exponent.round())]);
        let exact = [
            big(x).pow(&big(y), BITS, RM, &mut cc),
            big(x).div(&big(y.abs()), BITS, RM).atan(BITS, RM, &mut cc),
            big(x).mul(&big(x), BITS, RM).add(&big(y).mul(&big(y), BITS, RM), BITS, RM).sqrt(BITS, RM),
        ];
        let value = [Binary::Pow.real(x, y), Binary::Atan2.real(x, y.abs()), Binary::Hypot.real(x, y)];
        for i in 0..3 {
            let error = ulps(value[i], &exact[i]);
            worst[i] = if error > worst[i].0 { (error, x, y) } else { worst[i] };
        }
    }
    for (op, worst) in [Binary::Pow, Binary::Atan2, Binary::Hypot].into_iter().zip(worst) {
        eprintln!("{op:?}: {worst:?}");
        assert!(worst.0 <= functions::error2(op), "{op:?} is off by {worst:?}");
    }
}

/// The same number, NaN equal to NaN and -0 apart from 0.
fn same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan())
}

#[test]
fn exact_points_and_ends() {
    use std::f64::consts::{E, PI, SQRT_2};
    const INF: f64 = f64::INFINITY;
    const NAN: f64 = f64::NAN;
    let cases = [
        (Unary::Exp, 0.0, 1.0),
        (Unary::Exp, 1.0, E),
        (Unary::Exp, -INF, 0.0),
        (Unary::Exp, INF, INF),
        (Unary::Exp, -745.2, 0.0),
        (Unary::Exp, -745.1, 5e-324),
        (Unary::Exp, 709.8, INF),
        (Unary::Log, 1.0, 0.0),
        (Unary::Log, 0.0, -INF),
        (Unary::Log, -0.0, -INF),
        (Unary::Log, -1.0, NAN),
        (Unary::Log, INF, INF),
        (Unary::Log10, 1.0, 0.0),
        (Unary::Log10, 1e-310, -310.0),
        (Unary::Sin, 0.0, 0.0),
        (Unary::Sin, -0.0, -0.0),
        (Unary::Sin, FRAC_PI_2, 1.0),
        (Unary::Sin, INF, NAN),
        (Unary::Cos, 0.0, 1.0),
        (Unary::Cos, PI, -1.0),
        (Unary::Tan, -0.0, -0.0),
        (Unary::Asin, 1.0, FRAC_PI_2),
        (Unary::Asin, -0.0, -0.0),
        (Unary::Asin, 1.000_000_1, NAN),
        (Unary::Acos, 1.0, 0.0),
        (Unary::Acos, -1.0, PI),
        (Unary::Acos, 0.0, FRAC_PI_2),
        (Unary::Acos, -1.5, NAN),
        (Unary::Atan, INF, FRAC_PI_2),
        (Unary::Atan, -0.0, -0.0),
        (Unary::Sinh, -0.0, -0.0),
        (Unary::Sinh, -INF, -INF),
        (Unary::Cosh, 0.0, 1.0),
        (Unary::Cosh, -INF, INF),
        (Unary::Acosh, -15.0, NAN),
        (Unary::Acosh, 1.0, 0.0),
        (Unary::Atanh, -1.0, -INF),
        (Unary::Atanh, 1.5, NAN),
        (Unary::Asinh, -0.0, -0.0),
        (Unary::Asinh, -INF, -INF),
        (Unary::Tanh, INF, 1.0),
        (Unary::Tanh, -1e3, -1.0),
        (Unary::Cbrt, 27.0, 3.0),
        (Unary::Cbrt, -8.0, -2.0),
        (Unary::Sqrt, -0.0, -0.0),
        (Unary::Sqrt, -1.0, NAN),
        (Unary::Round, 2.5, 3.0),
        (Unary::Round, -2.5, -3.0),
        (Unary::Round, 0.499_999_999_999_999_94, 0.0),
        (Unary::Sign, -3.0, -1.0),
        (Unary::Not, 0.0, 1.0),
        (Unary::Powi(-2), 0.5, 4.0),
    ];
    for (op, x, value) in cases {
        assert!(same(op.real(x), value), "{op:?} at {x:?} gives {:?}, not {value:?}", op.real(x));
    }
    for op in UNARY.iter().filter(|&&op| op != Unary::Not) {
        assert!(op.real(NAN).is_nan(), "{op:?} of an undefined number is defined");
    }
    for n in -300..=300 {
        assert_eq!(Unary::Log10.real(format!("1e{n}").parse().expect("a number")), f64::from(n));
        assert_eq!(Binary::Pow.real(2.0, f64::from(n)), 2f64.powi(n));
    }
    assert_eq!(Binary::Pow.real(2.0, 0.5), SQRT_2);
}

#[test]
fn powers_at_the_ends_are_those_of_ieee() {
    const INF: f64 = f64::INFINITY;
    let special =
        [0.0, -0.0, 1.0, -1.0, 0.5, -0.5, 2.0, -2.0, 3.0, -3.0, INF, -INF, 1e300, -1e300, 5e-324, -5e-324, 1e-310];
    for x in special {
        for y in special {
            for (value, expected, name) in [
                (Binary::Pow.real(x, y), libm::pow(x, y), "pow"),
                (Binary::Atan2.real(x, y), libm::atan2(x, y), "atan2"),
                (Binary::Hypot.real(x, y), libm::hypot(x, y), "hypot"),
            ] {
                let close = (value - expected).abs() <= 4e-16 * expected.abs() + 1e-323
                    && value.is_sign_negative() == expected.is_sign_negative();
                assert!(same(value, expected) || close, "{name}({x:?}, {y:?}) gives {value:?}, not {expected:?}");
            }
        }
        for op in [Binary::Pow, Binary::Atan2, Binary::Hypot, Binary::Mod, Binary::Min] {
            assert!(op.real(x, f64::NAN).is_nan() && op.real(f64::NAN, x).is_nan(), "{op:?} with {x}");
        }
        assert_eq!(Binary::Max.real(x, f64::NAN), x);
        assert_eq!(Binary::Max.real(f64::NAN, x), x);
        for op in [Binary::Less, Binary::LessEqual, Binary::Equal, Binary::NotEqual, Binary::And] {
            assert_eq!(op.real(x, f64::NAN), 0.0);
        }
    }
}

#[test]
fn common_angles_take_the_common_way() {
    let mut random = Random(3);
    for _ in 0..10_000 {
        let x = random.within(-1e6, 1e6);
        assert_eq!(functions::sin(x), functions::sin_near(x));
        assert_eq!(functions::cos(x), functions::cos_near(x));
        assert_eq!(functions::tan(x), functions::tan_near(x));
    }
    assert_eq!(functions::sin(1e22), libm::sin(1e22));
}

#[test]
fn blocks_give_the_same_bits_as_single_numbers() {
    let mut random = Random(5);
    for &op in UNARY.iter() {
        for length in [0, 1, 15, 16, 100] {
            let a: Vec<f64> = (0..length).map(|_| if random.once_in(9) { f64::NAN } else { random.any() }).collect();
            let narrow: Vec<f32> = a.iter().map(|&a| a as f32).collect();
            let (mut out, mut narrow_out) = (vec![7.0; length + 1], vec![7.0; length + 1]);
            op.map(&a, &mut out);
            op.map(&narrow, &mut narrow_out);
            for i in 0..length {
                assert!(same(out[i], op.real(a[i])), "{op:?} of {:?} in a block is {:?}", a[i], out[i]);
                assert!(
                    same(narrow_out[i].into(), op.single(narrow[i]).into()),
                    "{op:?} of {:?} in a block",
                    narrow[i]
                );
            }
            assert_eq!((out[length], narrow_out[length]), (7.0, 7.0));
        }
    }
}

#[test]
fn singles_are_the_doubles_rounded() {
    let mut random = Random(4);
    for &op in UNARY.iter().filter(|op| !matches!(op, Unary::Powi(_))) {
        let mut worst = (0.0, 0.0);
        for _ in 0..40_000 {
            let (wide, narrow) = (random.any() as f32, random.within(-20.0, 20.0) as f32);
            let x = if random.once_in(4) { wide } else { narrow };
            let (single, double) = (op.single(x), op.real(f64::from(x)));
            if same(f64::from(single), f64::from(double as f32)) {
                continue;
            }
            let error = units(single, double);
            worst = if error > worst.0 || error.is_nan() { (error, x) } else { worst };
        }
        let bound = if matches!(op, Unary::Exp | Unary::Log) { 1.0 } else { 0.52 };
        eprintln!("single {op:?}: {worst:?}");
        assert!(worst.0 <= bound, "{op:?} of singles is off by {worst:?}");
    }
}

/// How far a single is from a double, in units in its last place; an infinite one stands for the largest.
fn units(single: f32, double: f64) -> f64 {
    let size = single.abs().min(f32::MAX);
    let unit = if size < f32::MAX { size.next_up() - size } else { size - size.next_down() };
    (f64::from(single.clamp(-f32::MAX, f32::MAX)) - double).abs() / f64::from(unit)
}

/// Every single within the range of a function, a step of bits apart: `YONT_CASES` at or above 2^32 takes them all.
#[test]
fn singles_that_are_computed_as_such_keep_their_bounds() {
    let cases = std::env::var("YONT_CASES").ok().and_then(|text| text.parse().ok()).unwrap_or(1_u64 << 20);
    let step = ((1_u64 << 32) / cases.max(1)).max(1) as usize;
    for (op, bound) in [(Unary::Exp, 1.0), (Unary::Log, 0.9)] {
        let mut worst = (0.0, 0.0);
        for bits in (0..=u32::MAX).step_by(step) {
            let x = f32::from_bits(bits);
            let (single, double) = (op.single(x), op.real(f64::from(x)));
            if same(f64::from(single), f64::from(double as f32)) {
                continue;
            }
            let error = units(single, double);
            worst = if error > worst.0 || error.is_nan() { (error, x) } else { worst };
        }
        assert!(worst.0 <= bound, "{op:?} of singles is off by {worst:?}");
    }
}
