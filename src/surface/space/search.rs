//! The search for the ends of an object, by intervals as far as they reach: the boxes that may hold some of it, farthest first. Rounds
//! nothing and evaluates points only to learn what is certainly inside.

use std::collections::BinaryHeap;
use std::sync::Arc;

use super::{BOX, FAR, FINE, Known, OVERHEAD, ROUGH, ROUNDS, SAMPLES};
use crate::interrupt::{Cancelled, Interrupt};
use crate::number::Interval;
use crate::number::rank::Ranked;
use crate::vm::interval::Boxes;
use crate::vm::{Points, Program};

/// Planes in which a point inside is looked for beyond those known, and steps in each: enough to halve a gap, and a step, down to rounding.
const PRESSES: usize = 24;
const STEPS: usize = 60;

/// A box that may hold some of the object.
struct Candidate {
    /// The function at its middle: of boxes that reach as far, that with the largest is next.
    score: f64,
    sides: Vec<[f64; 2]>,
    program: Arc<Program>,
}

/// When an end is known well enough.
#[derive(Clone, Copy)]
pub(super) enum Stop {
    /// As soon as it is finite.
    Finite,
    /// When the object is known to reach within so much of it.
    Within(f64),
    /// The same as a part of each axis.
    Part(f64),
}

/// What a search for one end says.
pub(super) enum Climb {
    /// Nothing lies beyond this coordinate.
    Reach(f64),
    /// Nothing lies anywhere.
    Nothing,
    /// The allowance was spent, and the end is still infinite.
    Open,
    /// A point of the object is far away.
    Endless,
}

pub(super) enum Ends {
    Closed,
    Open,
    Endless(Vec<(usize, bool)>),
    Nothing,
}

pub(super) struct Search<'a> {
    pub(super) program: Arc<Program>,
    /// Proved to hold the whole object.
    pub(super) outer: Vec<[f64; 2]>,
    /// The hull of the points that are known to be inside.
    pub(super) inner: Option<Vec<[f64; 2]>>,
    /// The largest value seen, and where.
    pub(super) best: Option<(f64, Vec<f64>)>,
    /// The sought inputs, and which of their ends are.
    pub(super) sought: Vec<(usize, [bool; 2])>,
    pub(super) spent: u64,
    pub(super) work: u64,
    pub(super) boxes: Boxes,
    pub(super) points: Points<f64>,
    pub(super) interrupt: &'a Interrupt,
}

impl<'a> Search<'a> {
    pub(super) fn new(program: Arc<Program>, known: &[Known], work: u64, interrupt: &'a Interrupt) -> Self {
        let range = |known: &Known| match *known {
            Known::Range(lo, hi) => [lo, hi],
            Known::Sought(lo, hi) => [lo.unwrap_or(f64::NEG_INFINITY), hi.unwrap_or(f64::INFINITY)],
        };
        let sought = known.iter().enumerate().filter_map(|(axis, known)| match known {
            Known::Range(..) => None,
            Known::Sought(lo, hi) => Some((axis, [lo.is_none(), hi.is_none()])),
        });
        Self {
            program,
            outer: known.iter().map(range).collect(),
            inner: None,
            best: None,
            sought: sought.collect(),
            spent: 0,
            work,
            boxes: Boxes::heeding(interrupt),
            points: Points::heeding(interrupt),
            interrupt,
        }
    }

    /// Whether nothing but a point is left.
    pub(super) fn is_point(&self) -> bool {
        self.sought.iter().all(|&(axis, _)| is_point(self.outer[axis]))
    }

    pub(super) fn left(&self) -> u64 {
        self.work.saturating_sub(self.spent)
    }

    /// The sought ends: the input, and whether the upper one.
    pub(super) fn ends(&self) -> Vec<(usize, bool)> {
        let both = |&(axis, sought): &(usize, [bool; 2])| [(axis, false, sought[0]), (axis, true, sought[1])];
        self.sought.iter().flat_map(both).filter(|end| end.2).map(|end| (end.0, end.1)).collect()
    }

    /// The sought ends that still lie at the huge bound.
    pub(super) fn far_ends(&self) -> Vec<(usize, bool)> {
        let mut ends = self.ends();
        ends.retain(|&(axis, up)| self.outer[axis][usize::from(up)].abs() >= FAR);
        ends
    }

    /// Brings all ends from infinity to somewhere finite; each that is found may help with the others.
    pub(super) fn hem_in(&mut self) -> Result<Ends, Cancelled> {
        let mut endless = Vec::new();
        loop {
            let mut open = self.ends();
            open.retain(|&(axis, up)| self.outer[axis][usize::from(up)].is_infinite());
            if open.is_empty() {
                return Ok(Ends::Closed);
            }
            let before = open.len();
            let share = self.left() / (16 * before as u64);
            endless.clear();
            for (axis, up) in open {
                match self.climb(axis, up, Stop::Finite, share)? {
                    Climb::Reach(at) => self.outer[axis][usize::from(up)] = at,
                    Climb::Nothing => return Ok(Ends::Nothing),
                    Climb::Endless => endless.push((axis, up)),
                    Climb::Open => {}
                }
            }
            let still =
                self.ends().iter().filter(|&&(axis, up)| self.outer[axis][usize::from(up)].is_infinite()).count();
            if still == before {
                break;
            }
        }
        if !endless.is_empty() {
            return self.all_endless(endless).map(Ends::Endless);
        }
        for side in self.outer.iter_mut().flatten() {
            *side = side.clamp(-FAR, FAR);
        }
        Ok(Ends::Open)
    }

    /// Brings those ends from infinity to somewhere finite for which intervals can tell. Whether anything may be left.
    pub(super) fn bring_in(&mut self) -> Result<bool, Cancelled> {
        loop {
            let mut open = self.ends();
            open.retain(|&(axis, up)| self.outer[axis][usize::from(up)].is_infinite());
            let before = open.len();
            let share = self.left() / (64 * before.max(1) as u64);
            for &(axis, up) in &open {
                match self.climb(axis, up, Stop::Finite, share)? {
                    Climb::Reach(at) => self.outer[axis][usize::from(up)] = at,
                    Climb::Nothing => return Ok(false),
                    Climb::Open | Climb::Endless => {}
                }
            }
            open.retain(|&(axis, up)| self.outer[axis][usize::from(up)].is_infinite());
            if open.is_empty() || open.len() == before {
                return Ok(true);
            }
        }
    }

    /// An object without end in some directions: those too in which points far away say so.
    fn all_endless(&mut self, mut found: Vec<(usize, bool)>) -> Result<Vec<(usize, bool)>, Cancelled> {
        let mut open = self.ends();
        open.retain(|end| self.outer[end.0][usize::from(end.1)].is_infinite());
        let near = self.outer.iter().map(|side| side.map(|c| c.clamp(-FAR, FAR))).collect::<Vec<_>>();
        for (axis, up) in open {
            let mut sides = near.clone();
            sides[axis] = if up { [FAR, 2.0 * FAR] } else { [-2.0 * FAR, -FAR] };
            self.scatter(&sides, SAMPLES)?;
            let goes_on = |inner: &Vec<[f64; 2]>| inner[axis][usize::from(up)].abs() >= FAR;
            if self.inner.as_ref().is_some_and(goes_on) && !found.contains(&(axis, up)) {
                found.push((axis, up));
            }
        }
        found.sort_unstable();
        Ok(found)
    }

    /// Takes off all ends what certainly holds nothing. Whether anything may be left.
    pub(super) fn narrow(&mut self) -> Result<bool, Cancelled> {
        let ends = self.ends();
        let mut last = false;
        for _ in 0..ROUNDS {
            let before = self.outer.clone();
            let share = if last { self.left() / ends.len() as u64 } else { self.left() / (8 * ends.len() as u64) };
            for &(axis, up) in &ends {
                match self.climb(axis, up, Stop::Part(if last { FINE } else { ROUGH }), share)? {
                    Climb::Reach(at) => self.outer[axis][usize::from(up)] = at,
                    Climb::Nothing => return Ok(false),
                    Climb::Open | Climb::Endless => {}
                }
            }
            if last || self.is_point() {
                break;
            }
            let shrank =
                |axis: &usize| width(self.outer[*axis]) < 0.85 * width(before[*axis]) && !is_point(self.outer[*axis]);
            last = !self.sought.iter().any(|(axis, _)| shrank(axis));
        }
        Ok(true)
    }

    /// Looks for one end of the object: how far it reaches along an axis.
    pub(super) fn climb(&mut self, axis: usize, up: bool, stop: Stop, allowance: u64) -> Result<Climb, Cancelled> {
        let sign = if up { 1.0 } else { -1.0 };
        let reach = |sides: &[[f64; 2]]| sign * sides[axis][usize::from(up)];
        let most = self.spent.saturating_add(allowance);
        let whole = self.outer.clone();
        let mut heap = BinaryHeap::new();
        let mut came = 0;
        let mut waiting = |item: Candidate| {
            came += 1;
            Ranked { rank: [reach(&item.sides), item.score], number: came, item }
        };
        heap.push(waiting(Candidate { score: 0.0, sides: whole, program: Arc::clone(&self.program) }));
        while let Some(Ranked { rank: [farthest, _], item: top, .. }) = heap.pop() {
            self.interrupt.tick()?;
            let known = self.inner.as_ref().map_or(f64::NEG_INFINITY, |inner| reach(inner));
            if known >= FAR && self.outer[axis][usize::from(up)].is_infinite() {
                return Ok(Climb::Endless);
            }
            let is_near = match stop {
                Stop::Finite => farthest.is_finite(),
                Stop::Within(length) => farthest - known <= length || top.sides.iter().all(|s| width(*s) <= length),
                Stop::Part(part) => {
                    let close = |(side, all): (&[f64; 2], &[f64; 2])| width(*side) <= part * width(*all);
                    farthest - known <= part * width(self.outer[axis]) || top.sides.iter().zip(&self.outer).all(close)
                }
            };
            if is_near || farthest <= known || (self.spent > most && farthest.is_finite()) {
                self.probe(&top.sides);
                if let Stop::Within(length) = stop {
                    self.press(&top.sides, (axis, up), length)?;
                }
                return Ok(Climb::Reach(sign * farthest.max(known)));
            }
            if self.spent > most {
                return Ok(Climb::Open);
            }
            for child in self.split(&top, axis, up) {
                let known = self.inner.as_ref().map_or(f64::NEG_INFINITY, |inner| reach(inner));
                if reach(&child.sides) > known {
                    heap.push(waiting(child));
                }
            }
        }
        let known = self.inner.as_ref().map(|inner| reach(inner));
        match known {
            Some(known) if known >= FAR && self.outer[axis][usize::from(up)].is_infinite() => Ok(Climb::Endless),
            Some(known) => Ok(Climb::Reach(sign * known)),
            None => Ok(Climb::Nothing),
        }
    }

    /// The parts of a box that may hold some of the object and are not wholly inside; what is inside goes to the inner hull.
    fn split(&mut self, of: &Candidate, axis: usize, up: bool) -> Vec<Candidate> {
        if let Some(near) = self.shortened(of, axis, up) {
            return near;
        }
        let mut parts = vec![of.sides.clone()];
        for axis in self.axes_to_split(&of.sides) {
            let at = middle(of.sides[axis]);
            let upper: Vec<_> = parts
                .iter_mut()
                .map(|lower| {
                    let mut upper = lower.clone();
                    (lower[axis][1], upper[axis][0]) = (at, at);
                    upper
                })
                .collect();
            parts.extend(upper);
        }
        self.examined(of, parts, (axis, up))
    }

    /// The half of a box that reaches less far, if nothing is in the other; or none of it, if all of the other is inside. A slab goes
    /// down so to a flat face or a summit, without being cut across.
    fn shortened(&mut self, of: &Candidate, axis: usize, up: bool) -> Option<Vec<Candidate>> {
        let [lo, hi] = of.sides[axis];
        let at = middle([lo, hi]);
        if !(lo < at && at < hi) {
            return None;
        }
        let half = |range| {
            let mut sides = of.sides.clone();
            sides[axis] = range;
            sides
        };
        let (near, far) = if up { (half([lo, at]), half([at, hi])) } else { (half([at, hi]), half([lo, at])) };
        let value = self.bounds(&of.program, std::slice::from_ref(&far))[0];
        if value.is_positive() {
            self.add_inside(&far);
            return Some(Vec::new());
        }
        (value.is_empty() || value.is_negative()).then(|| self.examined(of, vec![near], (axis, up)))
    }

    /// What is left of the parts of a box once intervals have looked at them.
    fn examined(&mut self, of: &Candidate, parts: Vec<Vec<[f64; 2]>>, end: (usize, bool)) -> Vec<Candidate> {
        let bounds = self.bounds(&of.program, &parts);
        let (mut open, count) = (Vec::new(), parts.len());
        for (lane, (sides, value)) in parts.into_iter().zip(bounds).enumerate() {
            if value.is_empty() || value.is_negative() {
                continue;
            }
            if value.is_positive() {
                self.add_inside(&sides);
                continue;
            }
            let length = of.program.work() as u64;
            // A shorter program costs about as much as two evaluations, and half a slab seldom has one.
            let shorter = (count > 1).then(|| self.boxes.specialise(&of.program, lane)).flatten();
            self.spent += if count > 1 { BOX * length } else { 0 };
            open.push((sides, shorter.map_or_else(|| Arc::clone(&of.program), Arc::new)));
        }
        open.into_iter().map(|(sides, program)| self.candidate(sides, program, end)).collect()
    }

    /// Up to three axes along which a box is long, as parts of the whole.
    fn axes_to_split(&self, sides: &[[f64; 2]]) -> Vec<usize> {
        let part = |axis: usize| {
            let whole = width(self.outer[axis]);
            let [lo, hi] = sides[axis];
            match () {
                () if lo >= hi => 0.0,
                () if whole.is_finite() => (hi - lo) / whole,
                // All of a line as if it were short: x / (1 + |x|).
                () => 0.5 * (squeezed(hi) - squeezed(lo)),
            }
        };
        let mut all: Vec<(f64, usize)> = (0..sides.len()).map(|axis| (part(axis), axis)).collect();
        all.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        let longest = all[0].0;
        // A box so small that its middle is its end is not split.
        let splits = |&(part, axis): &(f64, usize)| {
            let [lo, hi] = sides[axis];
            part > 0.25 * longest && lo < middle([lo, hi]) && middle([lo, hi]) < hi
        };
        all.into_iter().filter(splits).take(3).map(|(_, axis)| axis).collect()
    }

    fn bounds(&mut self, program: &Program, parts: &[Vec<[f64; 2]>]) -> Vec<Interval> {
        let axes = self.outer.len();
        let interval = |[lo, hi]: [f64; 2]| Interval::new(lo, hi);
        let columns: Vec<Vec<Interval>> =
            (0..axes).map(|axis| parts.iter().map(|sides| interval(sides[axis])).collect()).collect();
        let slices: Vec<&[Interval]> = columns.iter().map(Vec::as_slice).collect();
        let mut values = vec![Interval::EMPTY; parts.len()];
        self.boxes.eval(program, &slices, &mut values);
        self.spent += BOX * parts.len() as u64 * (program.work() as u64 + OVERHEAD);
        values
    }

    /// A box that is still to be split, with the value at its middle. The point below that at the end that reaches less far is looked at
    /// as well: flat faces often lie there.
    fn candidate(&mut self, sides: Vec<[f64; 2]>, program: Arc<Program>, (axis, up): (usize, bool)) -> Candidate {
        let mut columns: Vec<[f64; 2]> = sides.iter().map(|side| [middle(*side); 2]).collect();
        let end = sides[axis][usize::from(!up)];
        if end.is_finite() {
            columns[axis][1] = end;
        }
        let slices: Vec<&[f64]> = columns.iter().map(<[f64; 2]>::as_slice).collect();
        let mut values = [0.0; 2];
        self.points.eval(&program, &slices, &mut values);
        self.spent += BOX * program.work() as u64;
        for (k, &value) in values.iter().enumerate() {
            let point: Vec<f64> = columns.iter().map(|column| column[k]).collect();
            self.learn(value, &point);
        }
        let [value, _] = values;
        let score = if value.is_nan() { f64::NEG_INFINITY } else { value };
        Candidate { score, sides, program }
    }

    /// Looks at the corners of a box and the points between them: a tip often lies there, which the middle misses.
    fn probe(&mut self, sides: &[[f64; 2]]) {
        let moving: Vec<usize> = (0..sides.len()).filter(|&axis| width(sides[axis]) > 0.0).collect();
        if moving.len() > 4 || sides.iter().any(|side| !width(*side).is_finite()) {
            return;
        }
        let count = 3_usize.pow(moving.len() as u32);
        let mut columns: Vec<Vec<f64>> = sides.iter().map(|side| vec![side[0]; count]).collect();
        for (k, &axis) in moving.iter().enumerate() {
            let [lo, hi] = sides[axis];
            let choices = [lo, 0.5 * lo + 0.5 * hi, hi];
            columns[axis] = (0..count).map(|i| choices[i / 3_usize.pow(k as u32) % 3]).collect();
        }
        let slices: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
        let mut values = vec![0.0; count];
        let program = Arc::clone(&self.program);
        self.points.eval(&program, &slices, &mut values);
        self.spent += BOX * program.work() as u64;
        for (i, &value) in values.iter().enumerate() {
            let point: Vec<f64> = columns.iter().map(|column| column[i]).collect();
            self.learn(value, &point);
        }
    }

    /// Brings the points that are known to be inside nearer to an end that boxes alone did not reach closely: in planes across the axis,
    /// between the farthest point and the farthest box, it looks for a point inside by going up from the middle of that box.
    fn press(&mut self, sides: &[[f64; 2]], (axis, up): (usize, bool), length: f64) -> Result<(), Cancelled> {
        let sign = if up { 1.0 } else { -1.0 };
        let Some(inner) = &self.inner else { return Ok(()) };
        let (mut known, mut far) = (sign * inner[axis][usize::from(up)], sign * sides[axis][usize::from(up)]);
        let mut point: Vec<f64> = sides.iter().map(|side| middle(*side)).collect();
        for _ in 0..PRESSES {
            if far - known <= length {
                break;
            }
            self.interrupt.tick()?;
            let at = 0.5 * known + 0.5 * far;
            point[axis] = sign * at;
            if self.ascend(&mut point, axis) { known = at } else { far = at }
        }
        Ok(())
    }

    /// Moves a point across the axis to higher values, with ever shorter steps, until it is inside. Whether it is.
    fn ascend(&mut self, point: &mut Vec<f64>, across: usize) -> bool {
        let moving: Vec<usize> = (0..point.len()).filter(|&k| k != across && width(self.outer[k]) > 0.0).collect();
        let program = Arc::clone(&self.program);
        let mut best = f64::NEG_INFINITY;
        let mut step = 1.0 / 64.0;
        for _ in 0..STEPS {
            let mut places = vec![point.clone()];
            for &k in &moving {
                for way in [-step, step] {
                    let mut place = point.clone();
                    let [lo, hi] = self.outer[k];
                    place[k] = (place[k] + way * (hi - lo)).clamp(lo, hi);
                    places.push(place);
                }
            }
            let columns: Vec<Vec<f64>> = (0..point.len()).map(|k| places.iter().map(|p| p[k]).collect()).collect();
            let slices: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
            let mut values = vec![0.0; places.len()];
            self.points.eval(&program, &slices, &mut values);
            self.spent += BOX * program.work() as u64;
            let top =
                (0..values.len()).filter(|&i| !values[i].is_nan()).max_by(|&i, &j| values[i].total_cmp(&values[j]));
            let Some(top) = top else { return false };
            self.learn(values[top], &places[top]);
            let is_better = values[top] > best;
            best = best.max(values[top]);
            point.clone_from(&places[top]);
            if best >= 0.0 {
                return true;
            }
            // The point itself is the first of its neighbours, so that no step up leaves it where it is.
            if top == 0 || !is_better {
                step *= 0.5;
            }
        }
        false
    }

    pub(super) fn learn(&mut self, value: f64, point: &[f64]) {
        if self.best.as_ref().is_none_or(|(best, _)| value > *best) && !value.is_nan() {
            self.best = Some((value, point.to_vec()));
        }
        if value >= 0.0 {
            let sides: Vec<[f64; 2]> = point.iter().map(|&c| [c, c]).collect();
            self.add_inside(&sides);
        }
    }

    fn add_inside(&mut self, sides: &[[f64; 2]]) {
        match &mut self.inner {
            None => self.inner = Some(sides.to_vec()),
            Some(inner) => {
                for (all, side) in inner.iter_mut().zip(sides) {
                    *all = [all[0].min(side[0]), all[1].max(side[1])];
                }
            }
        }
    }
}

pub(super) fn width([lo, hi]: [f64; 2]) -> f64 {
    hi - lo
}

/// Whether a range is so short that it is one point to a user.
pub(super) fn is_point([lo, hi]: [f64; 2]) -> bool {
    hi - lo <= 1e-9 * (1.0 + lo.abs().max(hi.abs()))
}

pub(in crate::surface) fn squeezed(x: f64) -> f64 {
    if x.is_infinite() { x.signum() } else { x / (1.0 + x.abs()) }
}

/// Where a range is split: at 0 if it lies well within, else in the middle, on a scale of powers where the range is long.
pub(in crate::surface) fn middle([lo, hi]: [f64; 2]) -> f64 {
    if lo < 0.0 && hi > 0.0 {
        let balanced = lo.is_infinite() || hi.is_infinite() || lo.abs().min(hi) >= 0.25 * (hi - lo);
        return if balanced { 0.0 } else { 0.5 * lo + 0.5 * hi };
    }
    if lo < 0.0 {
        return -middle([-hi, -lo].map(|c| c + 0.0));
    }
    if hi.is_infinite() {
        return (2.0 * lo).max(1.0);
    }
    if hi > 16.0 * lo.max(1.0) {
        return lo.max(1.0).sqrt() * hi.sqrt();
    }
    0.5 * lo + 0.5 * hi
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_range_is_split_within() {
        let inf = f64::INFINITY;
        for (range, at) in [
            ([-inf, inf], 0.0),
            ([0.0, inf], 1.0),
            ([-inf, -8.0], -16.0),
            ([0.0, 1.0], 0.5),
            ([-3.0, 1.0], 0.0),
            ([-1e-9, 1.0], 0.5 - 0.5e-9),
            ([16.0, 1024.0], 128.0),
            ([-1024.0, -16.0], -128.0),
        ] {
            assert_eq!(middle(range), at, "{range:?}");
        }
        assert_eq!(middle([0.0, 0.0]), 0.0);
    }
}
