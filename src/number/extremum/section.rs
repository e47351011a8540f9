//! The highest value of a function of one variable between two numbers, and bounds of it.
//!
//! Samples, then the roots of the derivative between samples where it turns from rising to falling, then branch and bound: pieces whose
//! range lies below what is known fall away, the others are cut, until none is left or the budget is spent. Where the function
//! is continuous the range of its derivative tells that a piece only rises or falls, and bounds it more closely.

use super::AT_ONCE;
use crate::number::{Binary, Interval};

/// What the search asks of a function of one variable. At most [`AT_ONCE`] questions at a time.
pub trait Section {
    /// Values and derivatives at these places.
    fn slopes(&mut self, at: &[f64], values: &mut [f64], slopes: &mut [f64]);
    /// Ranges of the values and of the derivatives over these intervals.
    fn ranges(&mut self, over: &[Interval], values: &mut [Interval], slopes: &mut [Interval]);
    /// Whether the function is continuous wherever it is defined and finite.
    fn is_continuous(&self) -> bool;
}

/// Pieces to begin with; their ends are samples.
const PIECES: usize = 16;
/// Samples between two places, those included.
const SAMPLES: usize = 2 * PIECES + 1;
/// Peaks between samples whose tops are looked for.
const PEAKS: usize = 3;
/// Parts of the spread of the values by which a piece must be able to exceed what is known, to be looked into.
const TOLERANCE: f64 = 1e-9;
/// Parts of the largest value by which a place where the derivative vanishes may lie below another one, and still be preferred.
const ROUNDING: f64 = 2e-15;
/// Parts of the whole below which a piece is not cut.
const FINEST: f64 = 1e-11;

/// The place at `s`, from 0 to 1, between `lo` and `hi`.
#[inline]
#[must_use]
pub fn place(lo: f64, hi: f64, s: f64) -> f64 {
    if s == 1.0 { hi } else { (lo + s * (hi - lo)).min(hi) }
}

/// The best place so far.
#[derive(Clone, Copy)]
struct Best {
    at: f64,
    value: f64,
}

impl Best {
    fn offer(&mut self, at: f64, value: f64) {
        if value > self.value || (self.value.is_nan() && !value.is_nan()) {
            *self = Self { at, value };
        }
    }
}

/// A place between `lo` and `hi` where the function is highest, within rounding; `lo` where it is undefined throughout, NaN where
/// there is no such place. `budget` bounds the number of pieces that are looked into.
pub fn highest<S: Section + ?Sized>(section: &mut S, lo: f64, hi: f64, budget: usize) -> f64 {
    if !(lo <= hi && lo.is_finite() && hi.is_finite() && (hi - lo).is_finite()) {
        return f64::NAN;
    }
    let mut best = Best { at: lo, value: f64::NAN };
    if lo == hi {
        return lo;
    }
    let lowest = survey(section, lo, hi, &mut best);
    let mut search = Search { section, best, spread: best.value - lowest, whole: hi - lo };
    let mut pieces: Vec<[f64; 2]> =
        (0..PIECES).map(|i| [place(lo, hi, part(i)), place(lo, hi, part(i + 1))]).collect();
    let mut left = budget;
    while !pieces.is_empty() && left > 0 {
        let mut next = Vec::new();
        for batch in pieces.chunks(AT_ONCE) {
            let batch = &batch[..batch.len().min(left)];
            left -= batch.len();
            search.look_into(batch, &mut next);
        }
        pieces = next;
    }
    search.best.at
}

#[allow(clippy::cast_precision_loss)]
fn part(i: usize) -> f64 {
    i as f64 / PIECES as f64
}

/// Samples between two places and finds the tops of the highest peaks; the lowest value met.
fn survey<S: Section + ?Sized>(section: &mut S, lo: f64, hi: f64, best: &mut Best) -> f64 {
    #[allow(clippy::cast_precision_loss)]
    let at: [f64; SAMPLES] = std::array::from_fn(|i| place(lo, hi, i as f64 / (SAMPLES - 1) as f64));
    let (mut values, mut slopes) = ([0.0; SAMPLES], [0.0; SAMPLES]);
    section.slopes(&at, &mut values, &mut slopes);
    at.iter().zip(values).for_each(|(at, value)| best.offer(*at, value));
    let scale = values.iter().map(|v| v.abs()).filter(|v| v.is_finite()).fold(0.0, f64::max);
    let mut peaks: Vec<usize> = (0..SAMPLES - 1).filter(|&i| slopes[i] > 0.0 && slopes[i + 1] < 0.0).collect();
    peaks.sort_by(|&i, &j| {
        let top = |i: usize| values[i].max(values[i + 1]);
        top(j).total_cmp(&top(i)).then(i.cmp(&j))
    });
    for &i in peaks.iter().take(PEAKS) {
        climb(section, (at[i], slopes[i]), (at[i + 1], slopes[i + 1]), ROUNDING * scale, best);
    }
    values.iter().copied().fold(best.value, f64::min)
}

/// The top between a place where the function rises and one where it falls: a root of the derivative, bracketed. Eight places at a
/// time: about where the secant meets zero, and evenly spread.
///
/// A place where the derivative vanishes is preferred to others of the bracket that are higher by `slack`.
fn climb<S: Section + ?Sized>(
    section: &mut S,
    rising: (f64, f64),
    falling: (f64, f64),
    slack: f64,
    best: &mut Best,
) {
    let ((mut a, mut rise), (mut b, mut fall)) = (rising, falling);
    for _ in 0..40 {
        let width = b - a;
        let secant = a + width * (rise / (rise - fall));
        let secant = if secant > a && secant < b { secant } else { a + 0.5 * width };
        let mut at = [
            secant,
            secant - 1e-3 * width,
            secant + 1e-3 * width,
            secant - 1e-6 * width,
            secant + 1e-6 * width,
            a + 0.25 * width,
            a + 0.5 * width,
            a + 0.75 * width,
        ]
        .map(|t| t.clamp(a, b));
        at.sort_by(f64::total_cmp);
        let (mut values, mut slopes) = ([0.0; 8], [0.0; 8]);
        section.slopes(&at, &mut values, &mut slopes);
        at.iter().zip(values).for_each(|(at, value)| best.offer(*at, value));
        if slopes.iter().any(|slope| slope.is_nan()) {
            return;
        }
        // The bracket shrinks to the first place from which the function no longer rises, and the one before it.
        let turn = slopes.iter().position(|slope| *slope <= 0.0);
        if let Some(i) = turn {
            (b, fall) = (at[i], slopes[i]);
            if i > 0 {
                (a, rise) = (at[i - 1], slopes[i - 1]);
            }
        } else {
            (a, rise) = (at[7], slopes[7]);
        }
        let flat = fall == 0.0 || b - a <= 2.0 * f64::EPSILON * a.abs().max(b.abs()) || b - a >= width;
        if flat {
            break;
        }
    }
    // Where values no longer differ the derivative still tells the place.
    let (at, mut values, mut slopes) = ([a, b], [0.0; 2], [0.0; 2]);
    section.slopes(&at, &mut values, &mut slopes);
    let i = usize::from(slopes[1].abs() <= slopes[0].abs());
    let near = (rising.0..=falling.0).contains(&best.at) && best.value - values[i] <= slack;
    if near || values[i] > best.value {
        *best = Best { at: at[i], value: values[i] };
    }
}

struct Search<'a, S: ?Sized> {
    section: &'a mut S,
    best: Best,
    /// From the lowest to the highest value known.
    spread: f64,
    whole: f64,
}

impl<S: Section + ?Sized> Search<'_, S> {
    /// Looks into some pieces; what cannot be left aside is cut and put on the list.
    fn look_into(&mut self, pieces: &[[f64; 2]], next: &mut Vec<[f64; 2]>) {
        let count = pieces.len();
        let (mut over, mut middle) = ([Interval::EMPTY; AT_ONCE], [0.0; AT_ONCE]);
        for (i, [a, b]) in pieces.iter().enumerate() {
            over[i] = Interval::new(*a, *b);
            middle[i] = a + 0.5 * (b - a);
        }
        let (mut ranges, mut rates) = ([Interval::EMPTY; AT_ONCE], [Interval::EMPTY; AT_ONCE]);
        self.section.ranges(&over[..count], &mut ranges[..count], &mut rates[..count]);
        let (mut values, mut slopes) = ([0.0; AT_ONCE], [0.0; AT_ONCE]);
        self.section.slopes(&middle[..count], &mut values[..count], &mut slopes[..count]);
        let known = self.best.value;
        for (i, [a, b]) in pieces.iter().copied().enumerate() {
            if values[i] > known + self.tolerance() {
                // A peak that the samples missed.
                survey(self.section, a, b, &mut self.best);
            }
            self.best.offer(middle[i], values[i]);
        }
        for (i, [a, b]) in pieces.iter().copied().enumerate() {
            let (range, rate) = (ranges[i], rates[i]);
            let smooth = self.section.is_continuous() && !range.undefined && !rate.undefined;
            if smooth && (rate.lo > 0.0 || rate.hi < 0.0) {
                self.end(if rate.lo > 0.0 { b } else { a });
                continue;
            }
            let mut top = range.hi;
            if smooth && rate.largest().is_finite() && !values[i].is_nan() {
                let reach = rate.largest() * (b - a) * (0.5 + 1e-9);
                top = top.min(values[i] + reach + ROUNDING * values[i].abs());
            }
            let exceeds = !range.is_empty() && (self.best.value.is_nan() || top > self.best.value + self.tolerance());
            if exceeds && b - a > FINEST * self.whole.max(a.abs()) {
                let cuts = [0.0, 0.25, 0.5, 0.75, 1.0].map(|s| place(a, b, s));
                next.extend(cuts.windows(2).map(|pair| [pair[0], pair[1]]));
            }
        }
    }

    fn tolerance(&self) -> f64 {
        let spread = if self.spread.is_finite() { self.spread } else { 0.0 };
        TOLERANCE * spread.max(if self.best.value.is_finite() { self.best.value.abs() } else { 0.0 })
    }

    /// The end of a piece over which the function only rises or falls.
    fn end(&mut self, at: f64) {
        let (mut value, mut slope) = ([0.0], [0.0]);
        self.section.slopes(&[at], &mut value, &mut slope);
        self.best.offer(at, value[0]);
    }
}

/// Over a box: the range of the highest value and that of its place, from `lo` to `hi`, which may vary over the box.
///
/// `section` must answer [`Section::ranges`] for the whole box.
pub fn bounds<S: Section + ?Sized>(section: &mut S, lo: Interval, hi: Interval) -> [Interval; 2] {
    let sometimes = lo.undefined || hi.undefined || lo.hi > hi.lo || !(hi.hi - lo.lo).is_finite();
    if lo.is_empty() || hi.is_empty() || lo.lo > hi.hi {
        return [Interval::EMPTY; 2];
    }
    if !(hi.hi - lo.lo).is_finite() {
        let whole = Interval::WHOLE.or_undefined(true);
        return [whole, whole];
    }
    let at = |s: f64| placed(lo, hi, s);
    let mut over = [Interval::EMPTY; AT_ONCE];
    let (mut values, mut rates) = ([Interval::EMPTY; AT_ONCE], [Interval::EMPTY; AT_ONCE]);
    // Below: it is no less than at each sample of the search.
    for (i, over) in over.iter_mut().take(PIECES + 1).enumerate() {
        *over = at(part(i));
    }
    section.ranges(&over[..=PIECES], &mut values[..=PIECES], &mut rates[..=PIECES]);
    let samples = &values[..=PIECES];
    let floor = samples.iter().map(|v| if v.undefined { f64::NEG_INFINITY } else { v.lo }).fold(f64::NEG_INFINITY, f64::max);
    let undefined = samples.iter().all(|v| v.undefined);
    // Above: no more than over all pieces; those that reach the floor are looked at again, more closely.
    let mut pieces: Vec<[f64; 2]> = (0..PIECES).map(|i| [part(i), part(i + 1)]).collect();
    let mut largest = samples.iter().map(|v| v.largest()).fold(0.0, f64::max);
    let (mut top, mut low, mut where_) = (f64::NEG_INFINITY, f64::INFINITY, Interval::EMPTY);
    for round in 0..3 {
        (top, low, where_) = (f64::NEG_INFINITY, f64::INFINITY, Interval::EMPTY);
        let count = pieces.len();
        for (over, [s, t]) in over.iter_mut().zip(&pieces) {
            *over = at(*s).hull(at(*t));
        }
        section.ranges(&over[..count], &mut values[..count], &mut rates[..count]);
        let mut kept = Vec::new();
        for (i, piece) in pieces.iter().enumerate() {
            let value = values[i];
            if round == 0 && !value.is_empty() {
                largest = largest.max(value.largest());
            }
            if value.is_empty() || value.hi < floor {
                continue;
            }
            top = top.max(value.hi);
            low = low.min(value.lo);
            where_ = if where_.is_empty() { over[i] } else { where_.hull(over[i]) };
            kept.push(*piece);
        }
        let cut = AT_ONCE / kept.len().max(1);
        if cut < 2 || round == 2 {
            break;
        }
        #[allow(clippy::cast_precision_loss)]
        let cuts = |[s, t]: [f64; 2]| (0..cut).map(move |i| {
            let step = |i: usize| s + (t - s) * i as f64 / cut as f64;
            [step(i), if i + 1 == cut { t } else { step(i + 1) }]
        });
        pieces = kept.into_iter().flat_map(cuts).collect();
        if pieces.is_empty() {
            break;
        }
    }
    if top == f64::NEG_INFINITY && floor == f64::NEG_INFINITY && low > top {
        return [Interval::EMPTY; 2];
    }
    // The search may prefer a place that lies lower by rounding.
    let bottom = if undefined { low } else { floor.max(low) };
    let bottom = if largest.is_finite() { bottom - 2.0 * ROUNDING * largest } else { low };
    let value = Interval::new(bottom, top.max(bottom)).or_undefined(undefined || sometimes);
    [value, where_.clip(lo.lo, hi.hi).or_undefined(sometimes)]
}

/// The range of a place over a box, as the points compute it.
fn placed(lo: Interval, hi: Interval, s: f64) -> Interval {
    if s == 1.0 {
        return hi;
    }
    let width = Binary::Sub.interval(hi, lo);
    let step = Binary::Mul.interval(Interval::point(s), width);
    let at = Binary::Add.interval(lo, step);
    let at = Binary::Min.interval(at, hi);
    at.clip(lo.lo, hi.hi).or_undefined(false)
}
