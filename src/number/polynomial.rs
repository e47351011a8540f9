//! Real roots of polynomials of degree four at most within an interval: in closed form up to degree two, above it between the extremes, which
//! are the roots of the derivative. Finds each place where the sign changes, whatever the coefficients are.

/// Roots of a polynomial of degree 4 at most.
pub const MOST: usize = 4;

/// Steps of a root search; every second leaves half of the bracket or less.
const STEPS: usize = 128;

/// The places between `lo` and `hi` where `c[0] + c[1] t + c[2] t^2 + ...` changes its sign, ascending; how many there are. A place where it
/// touches zero may be among them.
///
/// # Panics
/// If there are more than five coefficients.
pub fn roots(c: &[f64], lo: f64, hi: f64, out: &mut [f64; MOST]) -> usize {
    assert!(c.len() <= MOST + 1, "of degree four at most");
    let degree = c.iter().rposition(|v| *v != 0.0).unwrap_or(0);
    let mut count = 0;
    let mut keep = |t: f64| {
        if t > lo && t < hi && count < MOST {
            out[count] = t;
            count += 1;
        }
    };
    match degree {
        0 => {}
        1 => keep(-c[0] / c[1]),
        2 => {
            if let Some((a, b)) = quadratic(c[0], c[1], c[2]) {
                keep(a.min(b));
                keep(a.max(b));
            }
        }
        _ => {
            let mut slope = [0.0; MOST];
            (1..=degree).for_each(|k| slope[k - 1] = k as f64 * c[k]);
            let mut turns = [0.0; MOST];
            let found = roots(&slope[..degree], lo, hi, &mut turns);
            let mut from = (lo, value(&c[..=degree], lo));
            for &t in turns[..found].iter().chain([&hi]) {
                let to = (t, value(&c[..=degree], t));
                if (from.1 < 0.0) != (to.1 < 0.0) {
                    keep(between(&c[..=degree], &slope[..degree], from, to));
                }
                from = to;
            }
        }
    }
    count
}

/// The value of `c[0] + c[1] t + ...`.
#[inline]
#[must_use]
pub fn value(c: &[f64], t: f64) -> f64 {
    c.iter().rev().fold(0.0, |sum, c| sum * t + c)
}

/// The roots of `c + b t + a t^2`, without cancellation.
fn quadratic(c: f64, b: f64, a: f64) -> Option<(f64, f64)> {
    let inside = b * b - 4.0 * a * c;
    if inside.is_nan() || inside < 0.0 {
        return None;
    }
    let q = -0.5 * (b + inside.sqrt().copysign(b));
    Some(if q == 0.0 { (0.0, 0.0) } else { (q / a, c / q) })
}

/// The root between two places of different signs, where the polynomial is monotone: Newton's steps, halving where they lead astray.
fn between(c: &[f64], slope: &[f64], from: (f64, f64), to: (f64, f64)) -> f64 {
    let (mut lo, mut hi) = (from.0, to.0);
    let low_sign = from.1 < 0.0;
    let mut t = 0.5 * (lo + hi);
    for step in 0..STEPS {
        let here = value(c, t);
        if here == 0.0 {
            return t;
        }
        if (here < 0.0) == low_sign {
            lo = t;
        } else {
            hi = t;
        }
        let newton = t - here / value(slope, t);
        let middle = 0.5 * (lo + hi);
        let next = if newton > lo && newton < hi && step % 8 != 7 { newton } else { middle };
        if next == t || !(lo < middle && middle < hi) || (next - t).abs() < 1e-15 {
            return next;
        }
        t = next;
    }
    t
}
