//! Where a smooth function crosses the edges of a grid: polynomials through the values at sample points and through what was evaluated on the
//! edges since. Many edges at a time; looks at numbers alone and never evaluates the function.
//!
//! On an edge t runs from 0 to 1, so that the sample points of its line lie at -1, 0, 1 and 2. The polynomials are in Newton's form: what each
//! further value adds is a product that vanishes at all earlier ones, and its factor tells how well the polynomial foresaw the value. That
//! is what decides whether an estimate is good enough; a crease, a step or a pole nearby makes the factor large.

#[cfg(not(debug_assertions))]
use multiversion::multiversion;

/// Least distance of the first estimate from the ends of its edge: a value right beside one that is known would say nothing new.
const EDGE: f64 = 1e-3;

/// The largest part of the slope that the factor of one evaluated value may be for the estimate behind it to count as found: the error is
/// about its square.
const FORESEEN: f64 = 1.5e-5;

/// Two bends of one curve are alike as long as they differ by less than this part of their sum.
const ALIKE: f64 = 0.7;

/// The cubic through the values at -1, 0, 1 and 2, of lower degree where an outer one is not known.
#[derive(Clone, Copy)]
struct Curve {
    start: f64,
    factors: [f64; 3],
    /// 1 where the value at -1 is known, else 0; the same for that at 2.
    known: [f64; 2],
}

impl Curve {
    /// Of two bends that differ much the smaller is that of the side without a crease, and the value beyond the crease is left out.
    #[inline(always)]
    fn through(a: f64, b: f64, c: f64, d: f64) -> Self {
        let before = 0.5 * (a - 2.0 * b + c);
        let after = 0.5 * (b - 2.0 * c + d);
        let differs = (before - after).abs() > ALIKE * (before.abs() + after.abs());
        let low = a.is_finite() && !(differs && d.is_finite() && before.abs() > after.abs());
        let high = d.is_finite() && !(differs && a.is_finite() && before.abs() <= after.abs());
        let second = if low { before } else { after };
        let second = if low || high { second } else { 0.0 };
        let third = if low && high { (d - 3.0 * c + 3.0 * b - a) / 6.0 } else { 0.0 };
        let known = [low, high].map(|known| if known { 1.0 } else { 0.0 });
        Self { start: b, factors: [c - b, second, third], known }
    }

    /// Its value and its slope.
    #[inline(always)]
    fn at(&self, t: f64) -> (f64, f64) {
        let [first, second, third] = self.factors;
        let value = self.start + t * first + t * (t - 1.0) * second + t * (t * t - 1.0) * third;
        (value, first + (2.0 * t - 1.0) * second + (3.0 * t * t - 1.0) * third)
    }

    /// The product that vanishes at the known values, and its slope.
    #[inline(always)]
    fn product(&self, t: f64) -> (f64, f64) {
        let [low, high] = self.known;
        let (inner, by_inner) = (t * (t - 1.0), 2.0 * t - 1.0);
        let (before, after) = (1.0 + low * t, 1.0 + high * (t - 3.0));
        let (outer, by_outer) = (before * after, low * after + high * before);
        (inner * outer, by_inner * outer + inner * by_outer)
    }
}

/// A place strictly between `inside` and `outside`: the estimate if it is there, else where the straight line between both values
/// vanishes, else their middle.
#[inline(always)]
fn between(estimate: f64, [inside, outside]: [f64; 2], [f_inside, f_outside]: [f64; 2]) -> f64 {
    let width = outside - inside;
    let part = (f_inside / (f_inside - f_outside)).clamp(EDGE, 1.0 - EDGE);
    let straight = inside + width * if part.is_nan() { 0.5 } else { part };
    if (estimate - inside) * (estimate - outside) < 0.0 { estimate } else { straight }
}

/// The first place to evaluate on each edge. `values` has the values at the sample points at -1, 0, 1 and 2 of each edge, by place; those at
/// -1 and 2 may be unknown (not finite).
#[cfg_attr(not(debug_assertions), multiversion(targets("x86_64+avx512f+avx512bw+avx512dq+avx512vl", "x86_64+avx2")))]
pub fn first(values: &[Vec<f64>; 4], out: &mut [f64]) {
    let n = out.len();
    let [a, b, c, d] = values.each_ref().map(|values| &values[..n]);
    for i in 0..n {
        let curve = Curve::through(a[i], b[i], c[i], d[i]);
        let straight = (b[i] / (b[i] - c[i])).clamp(EDGE, 1.0 - EDGE);
        let mut t = if straight.is_nan() { 0.5 } else { straight };
        for _ in 0..2 {
            let (value, slope) = curve.at(t);
            let next = t - value / slope;
            t = if (EDGE..=1.0 - EDGE).contains(&next) { next } else { t };
        }
        out[i] = t;
    }
}

/// The next place on each edge, after one value there (places, values), and whether the boundary is there as good as surely.
#[cfg_attr(not(debug_assertions), multiversion(targets("x86_64+avx512f+avx512bw+avx512dq+avx512vl", "x86_64+avx2")))]
pub fn second(values: &[Vec<f64>; 4], [t, value]: [&[f64]; 2], out: &mut [f64], found: &mut [bool]) {
    let n = out.len();
    let [a, b, c, d] = values.each_ref().map(|values| &values[..n]);
    let (t, value, found) = (&t[..n], &value[..n], &mut found[..n]);
    for i in 0..n {
        let curve = Curve::through(a[i], b[i], c[i], d[i]);
        let (foreseen, slope) = curve.at(t[i]);
        let (product, by_product) = curve.product(t[i]);
        let factor = (value[i] - foreseen) / product;
        let slope = slope + factor * by_product;
        let mut estimate = t[i] - value[i] / slope;
        let (low, by_low) = curve.at(estimate);
        let (product, by_product) = curve.product(estimate);
        estimate -= (low + factor * product) / (by_low + factor * by_product);
        let (inside, f_inside) = if value[i] >= 0.0 {
            (t[i], value[i])
        } else if b[i] >= 0.0 {
            (0.0, b[i])
        } else {
            (1.0, c[i])
        };
        let (outside, f_outside) =
            if value[i] >= 0.0 { if b[i] >= 0.0 { (1.0, c[i]) } else { (0.0, b[i]) } } else { (t[i], value[i]) };
        out[i] = between(estimate, [inside, outside], [f_inside, f_outside]);
        found[i] = out[i] == estimate && value[i] != 0.0 && factor.abs() <= FORESEEN * slope.abs();
    }
}

/// The place on each edge after two values there, and whether the boundary is there as good as surely: within `tolerance`, as far as
/// the polynomials tell.
#[cfg_attr(not(debug_assertions), multiversion(targets("x86_64+avx512f+avx512bw+avx512dq+avx512vl", "x86_64+avx2")))]
pub fn third(
    values: &[Vec<f64>; 4],
    [t, value]: [&[f64]; 2],
    [u, last]: [&[f64]; 2],
    tolerance: &[f64],
    out: &mut [f64],
    found: &mut [bool],
) {
    let n = out.len();
    let [a, b, c, d] = values.each_ref().map(|values| &values[..n]);
    let (t, value, tolerance, found) = (&t[..n], &value[..n], &tolerance[..n], &mut found[..n]);
    let (u, last) = (&u[..n], &last[..n]);
    for i in 0..n {
        let curve = Curve::through(a[i], b[i], c[i], d[i]);
        let factor = (value[i] - curve.at(t[i]).0) / curve.product(t[i]).0;
        let ((foreseen, slope), (product, by_product)) = (curve.at(u[i]), curve.product(u[i]));
        let further = u[i] - t[i];
        let next = (last[i] - (foreseen + factor * product)) / (product * further);
        let slope = slope + factor * by_product + next * (by_product * further + product);
        let shift = last[i] / slope;
        out[i] = u[i] - shift;
        // The bracket: the root lies beyond the last place as seen from the side whose sign it has.
        let rising = b[i] < 0.0 || b[i].is_nan();
        let below = rising == (last[i] >= 0.0);
        let (low, high) = if below { (0.0, u[i]) } else { (u[i], 1.0) };
        let other = t[i] > low && t[i] < high;
        let other_below = rising == (value[i] >= 0.0);
        let (low, high) = match other {
            true if other_below => (low, high.min(t[i])),
            true => (low.max(t[i]), high),
            false => (low, high),
        };
        let error = next.abs() * further.abs() * shift.abs();
        let is_small = error <= 0.25 * tolerance[i] * slope.abs() && shift.abs() <= EDGE;
        found[i] = is_small && last[i] != 0.0 && out[i] > low && out[i] < high;
    }
}
