//! Intervals hold every value that the points compute, and their ranges are no wider than they must be.

use yont::number::interval::{next_down, next_up};
use yont::number::{Binary, Interval, Ternary, Unary};

use super::{Random, UNARY};

const INF: f64 = f64::INFINITY;

/// A box, sometimes a point, sometimes with undefined values.
fn range(random: &mut Random) -> Interval {
    let (a, b) = (random.any(), random.any());
    let near = match random.bits() % 8 {
        0 => a,
        1 => a + a.abs() * 1e-15,
        2 | 3 => a + random.unit(),
        _ => b,
    };
    let near = if near.is_nan() { a } else { near };
    match random.bits() % 32 {
        0 => Interval::EMPTY,
        1 | 2 => Interval::new(a.min(near), a.max(near)).or_undefined(true),
        _ => Interval::new(a.min(near), a.max(near)),
    }
}

/// A value of the box: its ends, its zero, its whole numbers, or any.
fn member(random: &mut Random, of: Interval) -> f64 {
    if of.is_empty() || (of.undefined && random.once_in(4)) {
        return f64::NAN;
    }
    let inside = random.within(of.lo.max(f64::MIN / 4.0), of.hi.min(f64::MAX / 4.0));
    let scaled = inside * 2f64.powf(-60.0 * random.unit());
    let picks = [of.lo, of.hi, 0.0, -0.0, inside.round(), scaled, inside, inside];
    let pick = random.one_of(&picks);
    if of.contains(pick) { pick } else { of.lo }
}

const BOXES: usize = 20_000;

#[test]
fn unary_ranges_hold_the_points() {
    let mut random = Random(10);
    for &op in UNARY.iter() {
        for _ in 0..BOXES {
            let a = range(&mut random);
            let over = op.interval(a);
            assert!(!over.lo.is_nan() && !over.hi.is_nan(), "{op:?} of {a:?} is {over:?}");
            for _ in 0..5 {
                let x = member(&mut random, a);
                assert!(over.contains(op.real(x)), "{op:?} of {a:?} is {over:?} without {:?} at {x:?}", op.real(x));
            }
        }
    }
}

#[test]
fn binary_ranges_hold_the_points() {
    let mut random = Random(11);
    for &op in Binary::ALL {
        for _ in 0..BOXES {
            let (a, b) = (range(&mut random), range(&mut random));
            let over = op.interval(a, b);
            assert!(!over.lo.is_nan() && !over.hi.is_nan(), "{op:?} of {a:?}, {b:?} is {over:?}");
            for _ in 0..5 {
                let (x, y) = (member(&mut random, a), member(&mut random, b));
                let value = op.real(x, y);
                assert!(over.contains(value), "{op:?} of {a:?}, {b:?} is {over:?} without {value:?} at {x:?}, {y:?}");
            }
        }
    }
}

/// The third operand: alpha in or out of range, m, or any number.
fn parameter(random: &mut Random, op: Ternary) -> Interval {
    let (lo, hi) = match op {
        Ternary::Union | Ternary::Intersection => (-1.0, 1.0),
        Ternary::UnionSmooth | Ternary::IntersectionSmooth => (0.0, 4.0),
        Ternary::Norm => (-3.0, 12.0),
        Ternary::Select => return range(random),
    };
    let (a, b) = (random.within(lo, hi), random.within(lo, hi));
    match random.bits() % 8 {
        0 => range(random),
        1 => Interval::new(a.min(b), a.max(b)),
        2 => Interval::point(a),
        3 => Interval::point(hi),
        _ => Interval::point(random.one_of(&[0.0, 1.0])),
    }
}

#[test]
fn ternary_ranges_hold_the_points() {
    let mut random = Random(12);
    for &op in Ternary::ALL {
        for _ in 0..2 * BOXES {
            let (a, b, c) = (range(&mut random), range(&mut random), parameter(&mut random, op));
            let over = op.interval(a, b, c);
            assert!(!over.lo.is_nan() && !over.hi.is_nan(), "{op:?} of {a:?}, {b:?}, {c:?} is {over:?}");
            for _ in 0..5 {
                let (x, y, z) = (member(&mut random, a), member(&mut random, b), member(&mut random, c));
                let value = op.real(x, y, z);
                let at = (x, y, z);
                assert!(over.contains(value), "{op:?} of {a:?}, {b:?}, {c:?} is {over:?} without {value:?} at {at:?}");
            }
        }
    }
}

/// `got` holds `want` and is wider by some units in the last place at most.
fn check(what: &str, got: Interval, want: Interval) {
    let near = |a: f64, b: f64| a == b || (a - b).abs() <= 4e-15 * b.abs().max(1e-300);
    assert!(near(got.lo, want.lo) && near(got.hi, want.hi), "{what}: {got:?}, not {want:?}");
    assert!(got.lo <= want.lo && got.hi >= want.hi, "{what}: {got:?} lacks some of {want:?}");
    assert_eq!(got.undefined, want.undefined, "{what}: {got:?}");
}

#[test]
fn unary_ranges_are_tight() {
    use std::f64::consts::PI;
    let i = Interval::new;
    let cases = [
        (Unary::Neg, i(1.0, 2.0), i(-2.0, -1.0)),
        (Unary::Abs, i(-1.0, 2.0), i(0.0, 2.0)),
        (Unary::Sqrt, i(4.0, 9.0), i(2.0, 3.0)),
        (Unary::Sqrt, i(-4.0, 9.0), i(0.0, 3.0).or_undefined(true)),
        (Unary::Sqrt, i(-4.0, -1.0), Interval::EMPTY),
        (Unary::Log, i(0.0, 1.0), i(-INF, 0.0)),
        (Unary::Log, i(-1.0, 1.0), i(-INF, 0.0).or_undefined(true)),
        (Unary::Exp, i(-INF, 0.0), i(0.0, 1.0)),
        (Unary::Sin, i(0.0, 1.0), i(0.0, 1f64.sin())),
        (Unary::Sin, i(1.0, 2.0), i(1f64.sin(), 1.0)),
        (Unary::Sin, i(4.0, 5.0), i(-1.0, 4f64.sin())),
        (Unary::Sin, i(-100.0, 1.0), i(-1.0, 1.0)),
        (Unary::Cos, i(-1.0, 0.5), i(1f64.cos(), 1.0)),
        (Unary::Cos, i(3.0, 3.5), i(-1.0, 3.5f64.cos())),
        (Unary::Cos, i(1001.0, 1001.5), i(1001.5f64.cos(), 1001f64.cos())),
        (Unary::Tan, i(-1.0, 1.0), i(-(1f64.tan()), 1f64.tan())),
        (Unary::Tan, i(1.0, 2.0), Interval::WHOLE),
        (Unary::Acos, i(-1.0, 1.0), i(0.0, PI)),
        (Unary::Cosh, i(-1.0, 0.5), i(1.0, 1f64.cosh())),
        (Unary::Floor, i(-0.5, 1.5), i(-1.0, 1.0)),
        (Unary::Sign, i(-0.5, 0.0), i(-1.0, 0.0)),
        (Unary::Not, i(1.0, 2.0), i(0.0, 0.0)),
        (Unary::Not, i(0.0, 2.0), i(0.0, 1.0)),
        (Unary::Not, Interval::EMPTY, i(1.0, 1.0)),
        (Unary::Powi(2), i(-1.0, 2.0), i(0.0, 4.0)),
        (Unary::Powi(3), i(-1.0, 2.0), i(-1.0, 8.0)),
        (Unary::Powi(-2), i(-1.0, 2.0), i(0.25, INF)),
        (Unary::Powi(-1), i(2.0, 4.0), i(0.25, 0.5)),
        (Unary::Powi(0), i(-1.0, 2.0), i(1.0, 1.0)),
        (Unary::Exp, Interval::EMPTY, Interval::EMPTY),
    ];
    for (op, a, want) in cases {
        check(&format!("{op:?} of {a:?}"), op.interval(a), want);
    }
}

#[test]
fn binary_ranges_are_tight() {
    let i = Interval::new;
    let maybe = i(1.0, 2.0).or_undefined(true);
    let cases = [
        (Binary::Add, i(1.0, 2.0), i(3.0, 4.0), i(4.0, 6.0)),
        (Binary::Add, i(-INF, 0.0), i(0.0, INF), Interval::WHOLE.or_undefined(true)),
        (Binary::Sub, i(1.0, 2.0), i(3.0, 4.0), i(-3.0, -1.0)),
        (Binary::Mul, i(-1.0, 2.0), i(3.0, 4.0), i(-4.0, 8.0)),
        (Binary::Mul, i(0.0, 2.0), i(3.0, INF), i(0.0, INF).or_undefined(true)),
        (Binary::Div, i(1.0, 2.0), i(4.0, 8.0), i(0.125, 0.5)),
        (Binary::Div, i(1.0, 2.0), i(-1.0, 1.0), Interval::WHOLE),
        (Binary::Div, i(-1.0, 2.0), i(-1.0, 1.0), Interval::WHOLE.or_undefined(true)),
        (Binary::Min, i(0.0, 3.0), maybe, i(0.0, 2.0).or_undefined(true)),
        (Binary::Max, i(0.0, 3.0), maybe, i(0.0, 3.0)),
        (Binary::Max, i(0.0, 0.5), i(1.0, 2.0), i(1.0, 2.0)),
        (Binary::Max, i(0.0, 0.5), Interval::EMPTY, i(0.0, 0.5)),
        (Binary::Max, maybe, Interval::EMPTY, maybe),
        (Binary::Pow, i(1.0, 4.0), i(0.5, 0.5), i(1.0, 2.0)),
        (Binary::Pow, i(-2.0, 3.0), i(2.0, 2.0), i(0.0, 9.0)),
        (Binary::Pow, i(-2.0, 3.0), i(3.0, 3.0), i(-8.0, 27.0)),
        (Binary::Pow, i(-2.0, 4.0), i(0.5, 0.5), i(0.0, 2.0).or_undefined(true)),
        (Binary::Atan2, i(1.0, 1.0), i(-1.0, 1.0), i(1f64.atan2(1.0), 1f64.atan2(-1.0))),
        (Binary::Hypot, i(-3.0, 1.0), i(-4.0, -1.0), i(1.0, 5.0)),
        (Binary::Mod, i(7.25, 7.5), i(2.0, 2.0), i(1.25, 1.5)),
        (Binary::Less, i(0.0, 1.0), i(2.0, 3.0), i(1.0, 1.0)),
        (Binary::Less, i(0.0, 1.0), i(1.0, 3.0), i(0.0, 1.0)),
        (Binary::Less, i(1.0, 2.0), i(0.0, 1.0), i(0.0, 0.0)),
        (Binary::LessEqual, i(0.0, 1.0), i(1.0, 3.0), i(1.0, 1.0)),
        (Binary::LessEqual, i(0.0, 1.0), i(3.0, 4.0).or_undefined(true), i(0.0, 1.0)),
        (Binary::Equal, i(1.0, 1.0), i(1.0, 1.0), i(1.0, 1.0)),
        (Binary::Equal, i(0.0, 1.0), Interval::EMPTY, i(0.0, 0.0)),
        (Binary::NotEqual, i(0.0, 1.0), i(2.0, 3.0), i(1.0, 1.0)),
        (Binary::And, i(1.0, 2.0), i(-2.0, -1.0), i(1.0, 1.0)),
        (Binary::And, i(1.0, 2.0), maybe, i(0.0, 1.0)),
        (Binary::Or, i(1.0, 2.0), Interval::EMPTY, i(1.0, 1.0)),
    ];
    for (op, a, b, want) in cases {
        check(&format!("{op:?} of {a:?}, {b:?}"), op.interval(a, b), want);
    }
}

#[test]
fn ranges_of_set_operations_are_those_of_their_corners() {
    let mut random = Random(13);
    let i = Interval::new;
    for _ in 0..BOXES {
        let (a, b) = (random.within(-3.0, 3.0), random.within(-3.0, 3.0));
        let (c, d) = (a + random.unit(), b + random.unit());
        let alpha = random.one_of(&[1.0, 0.0, 0.5, -0.9]);
        for op in [Ternary::Union, Ternary::Intersection] {
            let want = i(op.real(a, b, alpha), op.real(c, d, alpha));
            check(&format!("{op:?}"), op.interval(i(a, c), i(b, d), Interval::point(alpha)), want);
        }
    }
    let truth = |lo, hi| i(lo, hi);
    for (condition, want) in
        [(truth(1.0, 2.0), i(5.0, 6.0)), (truth(0.0, 0.0), i(7.0, 8.0)), (truth(0.0, 1.0), i(5.0, 8.0))]
    {
        check("select", Ternary::Select.interval(condition, i(5.0, 6.0), i(7.0, 8.0)), want);
    }
}

/// `mathematics.md` 1: R(-2, 1) = 2.76 > R(-1, 1) = 2 for m = 1; and dense samples reach the ends of the range.
#[test]
fn ranges_of_smooth_unions_are_reached() {
    let mut random = Random(16);
    let i = Interval::new;
    let union = |f, g, m| Ternary::UnionSmooth.real(f, g, m);
    assert!((union(-2.0, 1.0, 1.0) - 2.764).abs() < 1e-3 && (union(-1.0, 1.0, 1.0) - 2.0).abs() < 1e-12);
    for _ in 0..300 {
        let (a, b, m) = (random.within(-3.0, 3.0), random.within(-3.0, 3.0), random.one_of(&[1.0, 2.0, 3.0]));
        let (over_a, over_b) = (i(a, a + 3.0 * random.unit()), i(b, b + 3.0 * random.unit()));
        let range = Ternary::UnionSmooth.interval(over_a, over_b, Interval::point(m));
        let at = |of: Interval, k: i32| (of.lo + (of.hi - of.lo) * f64::from(k) / 60.0).min(of.hi);
        let values =
            (0..=60).flat_map(|j| (0..=60).map(move |k| (j, k))).map(|(j, k)| union(at(over_a, j), at(over_b, k), m));
        let reached = values.fold(Interval::EMPTY, |all, v| all.hull(Interval::point(v)));
        let room = 2e-3 * (range.hi - range.lo);
        let what = format!("{over_a:?}, {over_b:?}, m = {m}: {range:?} of which {reached:?} is reached");
        assert!(range.lo <= reached.lo && reached.hi <= range.hi, "{what}");
        assert!(range.lo >= reached.lo - room && range.hi <= reached.hi + room, "{what}");
    }
}

#[test]
fn neighbours_are_the_next_numbers() {
    let mut random = Random(14);
    for _ in 0..10_000 {
        let x = random.any();
        let (up, down) = if x == 0.0 { (x, x) } else { (x.next_up(), x.next_down()) };
        assert_eq!((next_up(x), next_down(x)), (up, down), "beside {x:?}");
    }
}

#[test]
fn single_precision_stays_within_the_widened_range() {
    let mut random = Random(15);
    for &op in Binary::ALL {
        for _ in 0..2_000 {
            let x = random.within(-10.0, 10.0) as f32;
            let y = random.within(-10.0, 10.0) as f32;
            let point = |a: f32| Interval::point(f64::from(a));
            let single = f64::from(op.single(x, y));
            let over = op.interval(point(x), point(y)).widen_single(if op == Binary::Mod { 64.0 } else { 1.0 });
            let room =
                if op == Binary::Mod { over.hull(Interval::new(y.min(0.0).into(), y.max(0.0).into())) } else { over };
            assert!(room.contains(single), "{op:?} of {x:?}, {y:?} is {single:?}, not in {over:?}");
        }
    }
}
