//! Searches along one ray: where samples change sign, where a maximum may lie between them, and the root in a bracket. Evaluates
//! nothing itself: each search says where it wants a value and takes it, so that many advance together.

/// Samples along a ray in a smallest box, both ends included, where it may pass close to the object.
pub(super) const SAMPLES: usize = 7;

/// The samples that are taken first.
pub(super) const ENDS: [usize; 2] = [0, 6];

/// Those and the one that is taken next.
pub(super) const COARSE: [usize; 3] = [0, 3, 6];

/// The other ones.
pub(super) const BETWEEN: [usize; 4] = [1, 2, 4, 5];

/// The part of a ray in a smallest box.
#[derive(Clone, Copy)]
pub(super) struct Segment {
    pub(super) ray: usize,
    pub(super) from: f64,
    pub(super) to: f64,
}

/// A stretch of a ray that begins outside and ends inside.
#[derive(Clone, Copy)]
pub(super) struct Bracket {
    pub(super) ray: usize,
    pub(super) outside: (f64, f64),
    pub(super) inside: (f64, f64),
    /// Which end moved last: 1 the inside one, -1 the outside one.
    pub(super) moved: i8,
    /// How many of the last steps left more than half of it.
    pub(super) slow: u8,
}

/// A stretch of a ray on which all samples are outside and the function may have a maximum inside.
#[derive(Clone, Copy)]
pub(super) struct Summit {
    pub(super) ray: usize,
    /// A place outside before the maximum, and its value.
    pub(super) before: (f64, f64),
    pub(super) lo: f64,
    pub(super) hi: f64,
    /// The inner places of the golden section and their values.
    pub(super) left: (f64, f64),
    pub(super) right: (f64, f64),
}

impl Segment {
    pub(super) fn at(&self, step: usize) -> f64 {
        match step {
            0 => self.from,
            s if s == SAMPLES - 1 => self.to,
            s => self.from + (self.to - self.from) * (s as f64 / (SAMPLES - 1) as f64),
        }
    }

    pub(super) fn bracket(&self, values: &[f64], outside: usize, inside: usize) -> Bracket {
        let place = |step: usize| (self.at(step), values[step]);
        Bracket { ray: self.ray, outside: place(outside), inside: place(inside), moved: 0, slow: 0 }
    }

    /// The stretch around the largest sample, if the slopes beside it let the function reach 0 there: where it is concave it stays
    /// below the lines through neighbouring samples.
    pub(super) fn summit(&self, values: &[f64]) -> Option<Summit> {
        let (top, reach) = reach(values)?;
        if reach < 0.0 {
            return None;
        }
        let (first, last) = (top.saturating_sub(1), (top + 1).min(SAMPLES - 1));
        let (lo, hi) = (self.at(first), self.at(last));
        let mut summit = Summit {
            ray: self.ray,
            before: (lo, values[first]),
            lo,
            hi,
            left: (hi - GOLDEN * (hi - lo), f64::NAN),
            right: (lo + GOLDEN * (hi - lo), f64::NAN),
        };
        summit.before.1 = if summit.before.1.is_nan() { f64::NEG_INFINITY } else { summit.before.1 };
        Some(summit)
    }
}

/// Which of three or more samples is the largest, and a number that a concave function through them does not exceed beside it (NaN if an
/// undefined sample leaves that open). On a concave stretch between two samples the function stays below the line through the two samples
/// before it and below the one through the two samples behind it.
fn reach(values: &[f64]) -> Option<(usize, f64)> {
    let top = (0..values.len()).filter(|&s| !values[s].is_nan()).max_by(|&a, &b| values[a].total_cmp(&values[b]))?;
    let line = |near: usize, far: usize| 2.0 * values[near] - values[far];
    let reach = match top {
        0 => line(1, 2),
        _ if top + 1 == values.len() => line(top - 1, top - 2),
        _ => line(top, top - 1).max(line(top, top + 1)),
    };
    Some((top, reach))
}

/// Whether the first samples, all outside, leave it open that the ray meets the object between them: it does if one of them
/// is near to it or a concave function could come near, near by how much the samples differ.
pub(super) fn is_open(values: &[f64; SAMPLES]) -> bool {
    let coarse = COARSE.map(|step| values[step]);
    let spread =
        coarse.iter().fold(f64::NEG_INFINITY, |a, &b| a.max(b)) - coarse.iter().fold(f64::INFINITY, |a, &b| a.min(b));
    coarse.iter().any(|v| v.is_nan())
        || reach(&coarse).is_some_and(|(top, reach)| reach.max(coarse[top]) + spread >= 0.0)
}

/// Fewer rays tell too little about how much the function changes in a box.
const ENOUGH: usize = 16;

/// Whether rays through a box, by the samples at their ends and in the middle of every `stride`-th (of none if that is 0), are so far
/// outside everywhere that nothing is to be looked for between them: by more than twice what the function changes from any of the
/// samples to any other.
pub(super) fn is_far(samples: &[[f64; SAMPLES]], stride: usize) -> bool {
    let middles = samples.iter().step_by(stride.max(1)).map(|values| values[COARSE[1]]).filter(|_| stride > 0);
    let known = || samples.iter().flat_map(|values| ENDS.map(|step| values[step])).chain(middles.clone());
    let (least, most) = known().fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), v| (lo.min(v), hi.max(v)));
    samples.len() >= ENOUGH && known().all(f64::is_finite) && most < -2.0 * (most - least)
}

/// The golden section.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

impl Summit {
    /// The inner place whose value is not known yet.
    pub(super) fn fresh(&self) -> (f64, f64) {
        if self.left.1.is_nan() { self.left } else { self.right }
    }

    /// Takes the values of the places that were asked for; an undefined one counts as far outside.
    pub(super) fn learn(&mut self, values: &[f64]) {
        let mut values = values.iter().map(|&v| if v.is_nan() { f64::NEG_INFINITY } else { v });
        for place in [&mut self.left, &mut self.right] {
            if place.1.is_nan() {
                place.1 = values.next().unwrap_or(f64::NEG_INFINITY);
            }
        }
    }

    /// From outside to the first inner place that is inside.
    pub(super) fn bracket(&self) -> Option<Bracket> {
        let inside = [self.left, self.right].into_iter().find(|place| place.1 >= 0.0)?;
        Some(Bracket { ray: self.ray, outside: self.before, inside, moved: 0, slow: 0 })
    }

    pub(super) fn narrow(&mut self) {
        if self.left.1 >= self.right.1 {
            self.hi = self.right.0;
            self.right = self.left;
            self.left = (self.hi - GOLDEN * (self.hi - self.lo), f64::NAN);
        } else {
            self.lo = self.left.0;
            self.left = self.right;
            self.right = (self.lo + GOLDEN * (self.hi - self.lo), f64::NAN);
        }
    }
}

impl Bracket {
    pub(super) fn width(&self) -> f64 {
        (self.inside.0 - self.outside.0).abs()
    }

    /// The next place: regula falsi, nudged to the middle by `nudge` so that both ends close in on the root; after two slow steps the
    /// middle itself.
    pub(super) fn estimate(&self, nudge: f64) -> f64 {
        let part = self.outside.1 / (self.outside.1 - self.inside.1);
        if self.slow >= 2 || !part.is_finite() {
            return 0.5 * (self.outside.0 + self.inside.0);
        }
        let off = (nudge / self.width()).clamp(1e-4, 0.5);
        let part = if part < 0.5 { (part + off).min(0.5) } else { (part - off).max(0.5) };
        self.outside.0 + part * (self.inside.0 - self.outside.0)
    }

    /// Illinois: the end that stays twice loses half its weight.
    pub(super) fn learn(&mut self, depth: f64, value: f64) {
        let width = self.width();
        let now = if value >= 0.0 { 1 } else { -1 };
        if now == self.moved {
            let stays = if now > 0 { &mut self.outside } else { &mut self.inside };
            stays.1 *= 0.5;
        }
        if now > 0 {
            self.inside = (depth, value);
        } else {
            self.outside = (depth, value);
        }
        self.moved = now;
        self.slow = if self.slow < 2 && self.width() > 0.5 * width { self.slow + 1 } else { 0 };
    }
}
