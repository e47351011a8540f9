//! Real roots of polynomials of degree four at most within an interval, for several polynomials at once, coefficient by coefficient in rows:
//! in closed form up to degree two, above it between the extremes, which are the roots of the derivative. Finds each place where the sign
//! changes, whatever the coefficients are. Inlined into functions for each instruction set.

/// Roots of a polynomial of degree 4 at most.
pub const MOST: usize = 4;

/// Steps of a root search; every eighth halves the bracket.
const STEPS: usize = 128;

/// Newton's steps of this size end a root search: the error behind one is about its square.
const CLOSE: f64 = 1e-9;

/// Steps of the search for the first change of sign: beyond them roots are too near each other to be worth it.
const ROUNDS: usize = 8;

/// How much smaller a halving must be for the same.
const HALVED: f64 = 1e6;

/// What stands for a root that is not there.
const NONE: f64 = f64::INFINITY;

/// The places between `lo` and `hi` where each of the polynomials `c[0] + c[1] t + c[2] t^2 + ...` changes its sign, ascending but for the
/// missing ones, which are infinite; how many rows there are. A place where it touches zero may be among them. Leading coefficients may
/// vanish. Five coefficients at most: there are no roots of more.
#[inline(always)]
pub fn roots<const L: usize>(c: &[[f64; L]], lo: f64, hi: f64, out: &mut [[f64; L]; MOST]) -> usize {
    match c {
        [c, b] => {
            for i in 0..L {
                out[0][i] = within(-c[i] / b[i], lo, hi);
            }
            1
        }
        [c, b, a] => {
            let roots = quadratic([c, b, a]);
            for i in 0..L {
                let [s, t] = [within(roots[0][i], lo, hi), within(roots[1][i], lo, hi)];
                (out[0][i], out[1][i]) = if s < t { (s, t) } else { (t, s) };
            }
            2
        }
        [..] if c.len() <= MOST + 1 && c.len() > 3 && is_simple(c, lo, hi, &mut out[0]) => 1,
        [_, b, c2, c3] => {
            let stops = turns_of_cubic([b, c2, c3], lo, hi);
            sections(c, &stops, lo, hi, out, false);
            3
        }
        [_, b, c2, c3, c4] => {
            let mut slope = [[0.0; L]; 4];
            for i in 0..L {
                (slope[0][i], slope[1][i], slope[2][i], slope[3][i]) = (b[i], 2.0 * c2[i], 3.0 * c3[i], 4.0 * c4[i]);
            }
            let mut stops = [[0.0; L]; MOST];
            sections(&slope, &turns_of_cubic([&slope[1], &slope[2], &slope[3]], lo, hi), lo, hi, &mut stops, true);
            sections(c, &stops[..3], lo, hi, out, false);
            4
        }
        _ => 0,
    }
}

/// The first place between `lo` and `hi` where each of the polynomials changes its sign, infinite where there is none. `false` if some
/// were not found, as two may lie too near each other; a place where it touches zero may be among those that were.
#[inline(always)]
pub fn first<const L: usize>(c: &[[f64; L]], lo: f64, hi: f64, out: &mut [f64; L]) -> bool {
    match c {
        [c0, c1, c2, c3] => first_by_signs([c0, c1, c2, c3], lo, hi, out),
        [c0, c1, c2, c3, c4] => first_by_signs([c0, c1, c2, c3, c4], lo, hi, out),
        _ => {
            let mut all = [[NONE; L]; MOST];
            let count = roots(c, lo, hi, &mut all);
            *out = if count > 0 { all[0] } else { [NONE; L] };
            count > 0
        }
    }
}

/// The values of polynomials, each at its own place.
#[inline(always)]
pub fn value<const L: usize>(c: &[[f64; L]], t: &[f64; L]) -> [f64; L] {
    let mut sum = [0.0; L];
    for c in c.iter().rev() {
        for i in 0..L {
            sum[i] = sum[i] * t[i] + c[i];
        }
    }
    sum
}

/// The coefficients in the basis of Bernstein from `from` on, over `step`: there are at most as many roots as these change their sign, and
/// one exactly if they do once.
#[inline(always)]
fn bernstein<const N: usize, const L: usize>(c: [&[f64; L]; N], from: &[f64; L], step: &[f64; L]) -> [[f64; L]; N] {
    let mut all = c.map(|row| *row);
    // About the beginning, by synthetic division.
    for k in 0..N {
        for j in (k + 1..N).rev() {
            for i in 0..L {
                all[j - 1][i] += from[i] * all[j][i];
            }
        }
    }
    // In units of the step, divided by the binomial coefficients; then their sums as in Pascal's triangle.
    let mut unit = [1.0; L];
    let mut choices = 1.0;
    for (j, row) in all.iter_mut().enumerate().skip(1) {
        choices *= (N - j) as f64 / j as f64;
        for i in 0..L {
            unit[i] *= step[i];
            row[i] *= unit[i] / choices;
        }
    }
    for k in 1..N {
        for j in (k..N).rev() {
            let before = all[j - 1];
            all[j].iter_mut().zip(before).for_each(|(value, before)| *value += before);
        }
    }
    all
}

/// How often the signs change from row to row.
#[inline(always)]
fn changes<const N: usize, const L: usize>(rows: &[[f64; L]; N]) -> [f64; L] {
    let mut count = [0.0; L];
    for k in 1..N {
        for i in 0..L {
            count[i] += if (rows[k - 1][i] < 0.0) == (rows[k][i] < 0.0) { 0.0 } else { 1.0 };
        }
    }
    count
}

/// Whether none of the polynomials, of degree three or four, can have more than one root in the interval, and that.
#[inline(always)]
fn is_simple<const L: usize>(c: &[[f64; L]], lo: f64, hi: f64, out: &mut [f64; L]) -> bool {
    let (from, step) = ([lo; L], [hi - lo; L]);
    let (count, is_low) = match c {
        [c0, c1, c2, c3] => {
            let rows = bernstein([c0, c1, c2, c3], &from, &step);
            (changes(&rows), rows[0])
        }
        [c0, c1, c2, c3, c4] => {
            let rows = bernstein([c0, c1, c2, c3, c4], &from, &step);
            (changes(&rows), rows[0])
        }
        _ => return false,
    };
    if count.iter().any(|&n| n > 1.0) {
        return false;
    }
    *out = [NONE; L];
    if count.iter().any(|&n| n > 0.0) {
        let sign = is_low.map(|v| if v < 0.0 { 1.0 } else { -1.0 });
        let ends = count.map(|n| if n > 0.0 { hi } else { lo });
        let root = between(c, &sign, from, ends);
        for i in 0..L {
            out[i] = if count[i] > 0.0 { within(root[i], lo, hi) } else { NONE };
        }
    }
    true
}

/// The first change of sign of each polynomial, looked for in steps that halve where there may be several and double where there is none.
#[inline(always)]
fn first_by_signs<const N: usize, const L: usize>(c: [&[f64; L]; N], lo: f64, hi: f64, out: &mut [f64; L]) -> bool {
    let (mut from, mut step) = ([lo; L], [hi - lo; L]);
    // A closed bracket stays where there is no root.
    let (mut begin, mut end) = ([lo; L], [lo; L]);
    let (mut open, mut found) = ([1.0; L], [0.0; L]);
    let low = value(&c.map(|row| *row), &from).map(|v| if v < 0.0 { 1.0 } else { -1.0 });
    for _ in 0..ROUNDS {
        let rows = bernstein(c, &from, &step);
        let count = changes(&rows);
        let mut is_left = false;
        for i in 0..L {
            // Rounding may have hidden a root at the end of the step before.
            let jumped = (rows[0][i] < 0.0) != (low[i] > 0.0);
            let (is_open, to) = (open[i] > 0.0, from[i] + step[i]);
            let meets = is_open & (jumped | (count[i] == 1.0));
            let passes = is_open & !jumped & (count[i] == 0.0);
            begin[i] = if meets { from[i] } else { begin[i] };
            end[i] = if meets { if jumped { from[i] } else { to } } else { end[i] };
            found[i] = if meets { 1.0 } else { found[i] };
            let rest = hi - to;
            let is_last = rest <= 1e-14 * (hi - lo);
            open[i] = if meets | (passes & is_last) { 0.0 } else { open[i] };
            is_left |= open[i] > 0.0;
            let longer = if 2.0 * step[i] < rest { 2.0 * step[i] } else { rest };
            from[i] = if passes { to } else { from[i] };
            step[i] = if passes { longer } else { 0.5 * step[i] };
        }
        if !is_left {
            break;
        }
    }
    let root = between(&c.map(|row| *row), &low, begin, end);
    let mut is_whole = true;
    for i in 0..L {
        out[i] = if found[i] > 0.0 { within(root[i], lo, hi) } else { NONE };
        is_whole &= open[i] == 0.0;
    }
    is_whole
}

#[inline(always)]
fn within(t: f64, lo: f64, hi: f64) -> f64 {
    if t > lo && t < hi { t } else { NONE }
}

/// Where the slope of `c + b t + c2 t^2 + c3 t^3` vanishes, ascending, brought into the interval.
#[inline(always)]
fn turns_of_cubic<const L: usize>([b, c2, c3]: [&[f64; L]; 3], lo: f64, hi: f64) -> [[f64; L]; 2] {
    let double = c2.map(|c| 2.0 * c);
    let triple = c3.map(|c| 3.0 * c);
    let [s, t] = quadratic([b, &double, &triple]);
    let mut turns = [[hi; L]; 2];
    for i in 0..L {
        let [s, t] = [s[i], t[i]].map(|t| if t > lo && t < hi { t } else { hi });
        (turns[0][i], turns[1][i]) = if s < t { (s, t) } else { (t, s) };
    }
    turns
}

/// The roots of `c + b t + a t^2`, without cancellation; not finite where there are none.
#[inline(always)]
fn quadratic<const L: usize>([c, b, a]: [&[f64; L]; 3]) -> [[f64; L]; 2] {
    let mut roots = [[NONE; L]; 2];
    for i in 0..L {
        let q = -0.5 * (b[i] + (b[i] * b[i] - 4.0 * a[i] * c[i]).sqrt().copysign(b[i]));
        (roots[0][i], roots[1][i]) = (q / a[i], c[i] / q);
    }
    roots
}

/// The roots between places at which a polynomial may turn, ascending and within the interval: one at most in each section, one row a
/// section. Where there is none the row has the section's end if `fills`, else nothing.
#[inline(always)]
fn sections<const L: usize>(
    c: &[[f64; L]],
    stops: &[[f64; L]],
    lo: f64,
    hi: f64,
    out: &mut [[f64; L]; MOST],
    fills: bool,
) {
    let mut from = [lo; L];
    let mut low = value(c, &from);
    for (section, out) in out.iter_mut().enumerate().take(stops.len() + 1) {
        let to = stops.get(section).copied().unwrap_or([hi; L]);
        let high = value(c, &to);
        let (mut end, mut sign, mut crossed) = (from, [1.0; L], false);
        for i in 0..L {
            let crosses = (low[i] < 0.0) != (high[i] < 0.0);
            sign[i] = if low[i] < 0.0 { 1.0 } else { -1.0 };
            // A section without a root is a bracket that is closed already.
            end[i] = if crosses { to[i] } else { from[i] };
            crossed |= crosses;
        }
        *out = if fills { to } else { [NONE; L] };
        if crossed {
            let root = between(c, &sign, from, end);
            for i in 0..L {
                let crosses = (low[i] < 0.0) != (high[i] < 0.0);
                let root = if fills { root[i] } else { within(root[i], lo, hi) };
                out[i] = if crosses { root } else { out[i] };
            }
        }
        (from, low) = (to, high);
    }
}

/// The roots in brackets within which the polynomials are monotone: Newton's steps, halving where they lead astray. `sign` is 1 where the
/// lower end is negative.
#[inline(always)]
fn between<const L: usize>(c: &[[f64; L]], sign: &[f64; L], mut lo: [f64; L], mut hi: [f64; L]) -> [f64; L] {
    let mut t = [0.0; L];
    for i in 0..L {
        t[i] = 0.5 * (lo[i] + hi[i]);
    }
    for step in 0..STEPS {
        let (mut here, mut slope) = ([0.0; L], [0.0; L]);
        for c in c.iter().rev() {
            for i in 0..L {
                slope[i] = slope[i] * t[i] + here[i];
                here[i] = here[i] * t[i] + c[i];
            }
        }
        let mut moves = false;
        for i in 0..L {
            let is_low = here[i] * sign[i] < 0.0;
            lo[i] = if is_low { t[i] } else { lo[i] };
            hi[i] = if is_low { hi[i] } else { t[i] };
            let (newton, middle) = (t[i] - here[i] / slope[i], 0.5 * (lo[i] + hi[i]));
            let follows = (newton > lo[i]) & (newton < hi[i]) & (step % 8 != 7);
            let next = if follows { newton } else { middle };
            let next = if here[i] == 0.0 { t[i] } else { next };
            let change = (next - t[i]).abs() * if follows { 1.0 } else { HALVED };
            let change = if (lo[i] < middle) & (middle < hi[i]) { change } else { 0.0 };
            moves |= change >= CLOSE;
            t[i] = next;
        }
        if !moves {
            break;
        }
    }
    t
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers from 0 to 1 without a pattern.
    fn scattered() -> impl FnMut() -> f64 {
        let mut state = 0x2545_f491_4f6c_dd1d_u64;
        move || {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            (state >> 11) as f64 / (1_u64 << 53) as f64
        }
    }

    #[test]
    fn the_first_root_is_that_of_the_factors() {
        let mut next = scattered();
        let (mut found, mut left) = (0, 0);
        for case in 0..20_000 {
            let degree = 3 + case % 2;
            // Two of the roots near each other, in every second polynomial.
            let mut zeros: Vec<f64> = (0..degree).map(|_| 3.0 * next() - 1.5).collect();
            if case % 4 < 2 {
                zeros[1] = zeros[0] + 10.0_f64.powf(-5.0 * next());
            }
            // Some at places where steps of a search end.
            if case % 8 < 4 {
                zeros[0] = [-0.5, 0.0, 0.25][case % 3];
            }
            let mut c = vec![[1.0; 1]];
            for zero in &zeros {
                c.push([0.0]);
                for k in (0..c.len()).rev() {
                    c[k][0] = if k > 0 { c[k - 1][0] } else { 0.0 } - zero * c[k][0];
                }
            }
            let expected = zeros.iter().copied().filter(|z| z.abs() < 1.0).fold(f64::INFINITY, f64::min);
            let mut out = [0.0];
            if first(&c, -1.0, 1.0, &mut out) {
                found += 1;
                assert!((out[0] - expected).abs() < 1e-7 || out[0] == expected, "{zeros:?}: {} {expected}", out[0]);
            } else {
                left += 1;
            }
            let mut all = [[0.0]; MOST];
            let count = roots(&c, -1.0, 1.0, &mut all);
            let least = all[..count].iter().fold(f64::INFINITY, |least, root| least.min(root[0]));
            assert!((least - expected).abs() < 1e-7 || least == expected, "{zeros:?}: {least} {expected}");
        }
        assert!(left < found / 4, "{left} of {found}");
    }
}
