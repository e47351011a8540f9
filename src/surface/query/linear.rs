//! Functions over a box as their value at a point and the ranges of their derivatives. All bounds are rounded outward. Evaluates nothing.

use crate::number::{Binary, Interval};

/// A condition over a box: `value + slopes * (x - centre)` holds its function there, which is not to be negative.
pub(super) struct Linear {
    /// The value at the centre.
    pub(super) value: Interval,
    /// The derivative by each axis over the box.
    pub(super) slopes: Vec<Interval>,
    /// What rounding makes of a boundary. A point that is to be outside of an object must be so by more than that: so objects whose boundaries
    /// touch from within include each other.
    noise: f64,
    outside: bool,
}

impl Linear {
    /// The form about a centre, of a condition that asks for the inside or for the outside.
    pub(super) fn new(value: Interval, slopes: Vec<Interval>, centre: &[[f64; 2]], outside: bool) -> Self {
        let rounding = slopes.iter().zip(centre).map(|(slope, c)| 4.0 * f64::EPSILON * slope.largest() * c[0].abs());
        let noise = rounding.sum::<f64>() + 4.0 * (value.hi - value.lo);
        Self { value, slopes, noise, outside }
    }

    /// Whether the bounds are worth anything.
    pub(super) fn is_usable(&self) -> bool {
        let finite = |i: &Interval| i.lo.is_finite() && i.hi.is_finite() && !i.undefined;
        finite(&self.value) && self.slopes.iter().all(finite)
    }

    /// How much the function may change within the box along each axis.
    pub(super) fn change(&self, axis: usize, [lo, hi]: [f64; 2]) -> f64 {
        0.5 * (hi - lo) * self.slopes[axis].largest()
    }

    /// The slope in the middle of its range.
    fn slope(&self, axis: usize) -> f64 {
        0.5 * self.slopes[axis].lo + 0.5 * self.slopes[axis].hi
    }
}

fn plus(a: Interval, b: Interval) -> Interval {
    Binary::Add.interval(a, b)
}

fn times(a: Interval, b: Interval) -> Interval {
    Binary::Mul.interval(a, b)
}

/// What a box is about its centre, along one axis.
fn about([lo, hi]: [f64; 2], centre: f64) -> Interval {
    Binary::Sub.interval(Interval::new(lo, hi), Interval::point(centre))
}

/// The bounds of a weighted sum of conditions over a box.
fn sum(parts: &[(f64, &Linear)], sides: &[[f64; 2]], centre: &[f64]) -> Interval {
    let weighted = |part: &dyn Fn(&Linear) -> Interval| {
        let each = parts.iter().map(|(weight, linear)| times(Interval::point(*weight), part(linear)));
        each.reduce(plus).unwrap_or(Interval::EMPTY)
    };
    let mut all = weighted(&|linear| linear.value);
    for (axis, (&side, &centre)) in sides.iter().zip(centre).enumerate() {
        all = plus(all, times(weighted(&|linear| linear.slopes[axis]), about(side, centre)));
    }
    all
}

/// Whether weights show that two conditions cannot hold together anywhere in a box; of one alone, that it holds nowhere.
pub(super) fn excludes(a: &Linear, b: &Linear, sides: &[[f64; 2]], centre: &[f64]) -> bool {
    // The weights at which the slopes cancel best.
    let (mut cross, mut square) = (0.0, 0.0);
    for (axis, side) in sides.iter().enumerate() {
        let width = side[1] - side[0];
        let (of_a, of_b) = (width * a.slope(axis), width * b.slope(axis));
        cross += of_b * (of_b - of_a);
        square += (of_a - of_b) * (of_a - of_b);
    }
    let best = (cross / square).clamp(0.0, 1.0);
    let fails = |weight: f64| {
        let bounds = sum(&[(weight, a), (1.0 - weight, b)], sides, centre);
        let noise = weight * a.noise + (1.0 - weight) * b.noise;
        bounds.hi < 0.0 || ((a.outside || b.outside) && bounds.hi <= noise)
    };
    !best.is_nan() && best > 0.0 && best < 1.0 && fails(best)
}

/// Whether the condition fails all over a box.
pub(super) fn fails(a: &Linear, sides: &[[f64; 2]], centre: &[f64]) -> bool {
    let bounds = sum(&[(1.0, a)], sides, centre);
    bounds.hi < 0.0 || (a.outside && bounds.hi <= a.noise)
}

/// Takes off a box what certainly fails the condition. Whether anything is left.
pub(super) fn contract(a: &Linear, sides: &mut [[f64; 2]], centre: &[f64]) -> bool {
    let terms: Vec<f64> = (0..sides.len()).map(|k| times(a.slopes[k], about(sides[k], centre[k])).hi).collect();
    for axis in 0..sides.len() {
        // What the others give at most; the own term must make up for it where that is negative.
        let mut rest = Interval::point(a.value.hi);
        for (other, &term) in terms.iter().enumerate() {
            if other != axis {
                rest = plus(rest, Interval::point(term));
            }
        }
        let need = -rest.hi;
        let Interval { lo, hi, .. } = a.slopes[axis];
        // slope * t >= need, for some slope of the range: a bound of t on the side where the slope's sign is known.
        let bound = |steep: f64, flat: f64| if need > 0.0 { need / steep } else { need / flat };
        let room = |t: f64| t.abs() * 1e-14 + f64::MIN_POSITIVE;
        if lo > 0.0 {
            let least = bound(hi, lo);
            let from = centre[axis] + (least - room(least));
            sides[axis][0] = sides[axis][0].max(from - from.abs() * 1e-15);
        } else if hi < 0.0 {
            let most = bound(lo, hi);
            let to = centre[axis] + (most + room(most));
            sides[axis][1] = sides[axis][1].min(to + to.abs() * 1e-15);
        }
        if sides[axis][0] > sides[axis][1] {
            return false;
        }
    }
    true
}
