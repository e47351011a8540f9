//! Finds where an object lies when nobody said: a box of any dimension that holds all of it, proved by intervals as far as they reach and
//! guessed from samples where they do not. Makes no mesh and knows no names of coordinates.
//!
//! Each end of the box is a search of its own: of the boxes that may hold some of the object the one that reaches farthest is split, until
//! none reaches farther than a point that is known to be inside. Intervals take infinite ends, so that the first box is the whole space.
//! Where they say nothing about infinity (a turned bar: both products of a large number and a sine of unknown sign), the search begins
//! at a huge bound.

use std::cmp::Ordering;
use std::collections::BinaryHeap;
use std::sync::Arc;

use super::sampler::Sampler;
use crate::interrupt::{Cancelled, Interrupt};
use crate::number::Interval;
use crate::vm::interval::Boxes;
use crate::vm::{Points, Program, Shape};

/// Where "far away" begins: an object with a point beyond it is taken for one without end.
const FAR: f64 = (1_u64 << 40) as f64;
/// Part of an axis to which an end is known when it is first narrowed, and at last.
const ROUGH: f64 = 1.0 / 8.0;
const FINE: f64 = 1.0 / 256.0;
/// Rounds of narrowing; each but the last takes at least a seventh off one axis.
const ROUNDS: usize = 400;
/// Work that a box costs besides its operations.
const OVERHEAD: u64 = 64;
/// Points at a time where intervals fail.
const SAMPLES: usize = 2048;

/// What is known of an input of the program.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Known {
    /// Its range, or its value twice.
    Range(f64, f64),
    /// Its range is sought; one end may be given.
    Sought(Option<f64>, Option<f64>),
}

/// How sure it is that nothing lies outside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Proof {
    /// Intervals show it for the whole space.
    Everywhere,
    /// Intervals show it as far as this coordinate.
    UpTo(f64),
    /// Samples found nothing outside; intervals could not decide.
    Samples,
}

/// What was found.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// The object lies in these ranges, one for each input; the sought ones are padded and rounded to short numbers.
    Within(Vec<[f64; 2]>, Proof),
    /// It has no end along these inputs: the input, and whether upwards.
    Endless(Vec<(usize, bool)>),
    /// It holds nothing but perhaps this point.
    Point(Vec<f64>),
    /// No point of it was found; whether intervals prove that there is none; where the function was largest.
    Empty(bool, Option<(f64, Vec<f64>)>),
}

/// Looks for the object of a program that asks for signs; `known` has an entry for each of its inputs. At most `work` operations are
/// spent (roughly), after which what is known by then is the answer.
///
/// # Errors
/// [`Cancelled`] soon after the interrupt was set.
pub fn find(program: Arc<Program>, known: &[Known], work: usize, interrupt: &Interrupt) -> Result<Outcome, Cancelled> {
    interrupt.begin(0);
    let mut search = Search::new(program, known, work as u64, interrupt);
    if search.sought.is_empty() {
        return Ok(Outcome::Within(search.outer, Proof::Everywhere));
    }
    let endless = match search.from_infinity()? {
        Ends::Nothing => return Ok(Outcome::Empty(true, search.best)),
        Ends::Endless(all) => return Ok(Outcome::Endless(all)),
        Ends::Open => true,
        Ends::Closed => false,
    };
    let narrowed = search.narrow()?;
    let mut proof = if endless { Proof::UpTo(FAR) } else { Proof::Everywhere };
    if !narrowed {
        return Ok(Outcome::Empty(true, search.best));
    }
    if search.is_point() {
        return Ok(Outcome::Point(search.outer.iter().map(|range| middle(*range)).collect()));
    }
    let far = search.far_ends();
    if !far.is_empty() || search.inner.is_none() {
        if let Some(ends) = search.from_samples()? {
            return Ok(Outcome::Endless(ends));
        }
        proof = Proof::Samples;
    }
    if search.inner.is_none() {
        return Ok(Outcome::Empty(false, search.best));
    }
    Ok(Outcome::Within(search.rounded(), proof))
}

/// The farthest reach of an object within ranges, one for each input of its program: for each input the bounds between which its lowest
/// and its highest coordinate lie. `None` if there is no point in it. `work` as for [`find`].
///
/// # Errors
/// [`Cancelled`] soon after the interrupt was set.
#[allow(clippy::type_complexity)]
pub fn reach(
    program: Arc<Program>,
    ranges: &[(f64, f64)],
    part: f64,
    work: usize,
    interrupt: &Interrupt,
) -> Result<Option<Vec<[[f64; 2]; 2]>>, Cancelled> {
    let known: Vec<Known> = ranges.iter().map(|&(lo, hi)| Known::Sought(Some(lo), Some(hi))).collect();
    let mut search = Search::new(program, &known, work as u64, interrupt);
    let moves = (0..ranges.len()).filter(|&axis| ranges[axis].0 < ranges[axis].1);
    let ends: Vec<(usize, bool)> = moves.flat_map(|axis| [(axis, false), (axis, true)]).collect();
    let longest = ranges.iter().map(|(lo, hi)| hi - lo).fold(0.0, f64::max);
    let share = search.left() / ends.len().max(1) as u64;
    for &(axis, up) in &ends {
        match search.climb(axis, up, Stop::Within(part * longest), share)? {
            Climb::Reach(at) => search.outer[axis][usize::from(up)] = at,
            Climb::Nothing if search.inner.is_none() => return Ok(None),
            Climb::Nothing | Climb::Open | Climb::Endless => {}
        }
    }
    let outer = search.outer;
    Ok(search.inner.map(|inner| {
        inner.iter().zip(&outer).map(|(inner, outer)| [[outer[0], inner[0]], [inner[1], outer[1]]]).collect()
    }))
}

/// The faces of a space beyond which a 3-D shape goes on, as far as some points of each face tell: lower and upper for each axis.
#[must_use]
pub fn cut(shape: &Shape, bounds: &[[f64; 2]], interrupt: &Interrupt) -> [[bool; 2]; 3] {
    const SIDE: usize = 48;
    let mut sampler = Sampler::new(shape).heeding(interrupt);
    let mut is_cut = |axis: usize, at: f64| {
        let place = |k: usize, d: usize| match d {
            _ if d == axis => at,
            _ => {
                let step = if d == (axis + 1) % 3 { k % SIDE } else { k / SIDE };
                bounds[d][0] + (bounds[d][1] - bounds[d][0]) * (step as f64 + 0.5) / SIDE as f64
            }
        };
        let columns = [0, 1, 2].map(|d| (0..SIDE * SIDE).map(|k| place(k, d)).collect::<Vec<f64>>());
        let mut values = vec![0.0; SIDE * SIDE];
        sampler.values(&shape.program, &columns.each_ref().map(Vec::as_slice), &mut values);
        values.iter().any(|&value| value > 0.0)
    };
    let mut cut = [[false; 2]; 3];
    for (axis, (cut, bounds)) in cut.iter_mut().zip(bounds).enumerate() {
        *cut = [is_cut(axis, bounds[0]), is_cut(axis, bounds[1])];
    }
    cut
}

/// A box that may hold some of the object.
struct Candidate {
    /// How far it reaches in the direction of the search.
    reach: f64,
    /// The function at its middle: of boxes that reach as far, that with the largest is next.
    score: f64,
    /// Which came first, for the rest.
    number: u64,
    sides: Vec<[f64; 2]>,
    program: Arc<Program>,
}

impl Candidate {
    fn order(&self) -> (f64, f64, std::cmp::Reverse<u64>) {
        (self.reach, self.score, std::cmp::Reverse(self.number))
    }
}

impl PartialEq for Candidate {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}
impl Eq for Candidate {}
impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for Candidate {
    fn cmp(&self, other: &Self) -> Ordering {
        let (a, b) = (self.order(), other.order());
        a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.cmp(&b.2))
    }
}

/// When an end is known well enough.
#[derive(Clone, Copy)]
enum Stop {
    /// As soon as it is finite.
    Finite,
    /// When the object is known to reach within so much of it.
    Within(f64),
    /// The same as a part of each axis.
    Part(f64),
}

/// What a search for one end says.
enum Climb {
    /// Nothing lies beyond this coordinate.
    Reach(f64),
    /// Nothing lies anywhere.
    Nothing,
    /// The allowance was spent, and the end is still infinite.
    Open,
    /// A point of the object is far away.
    Endless,
}

enum Ends {
    Closed,
    Open,
    Endless(Vec<(usize, bool)>),
    Nothing,
}

struct Search<'a> {
    program: Arc<Program>,
    /// Proved to hold the whole object.
    outer: Vec<[f64; 2]>,
    /// The hull of the points that are known to be inside.
    inner: Option<Vec<[f64; 2]>>,
    /// The largest value seen, and where.
    best: Option<(f64, Vec<f64>)>,
    /// The sought inputs, and which of their ends are.
    sought: Vec<(usize, [bool; 2])>,
    spent: u64,
    work: u64,
    count: u64,
    boxes: Boxes,
    points: Points<f64>,
    interrupt: &'a Interrupt,
}

impl<'a> Search<'a> {
    fn new(program: Arc<Program>, known: &[Known], work: u64, interrupt: &'a Interrupt) -> Self {
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
            count: 0,
            boxes: Boxes::new(),
            points: Points::new(),
            interrupt,
        }
    }

    /// Whether nothing but a point is left.
    fn is_point(&self) -> bool {
        self.sought.iter().all(|&(axis, _)| is_point(self.outer[axis]))
    }

    fn left(&self) -> u64 {
        self.work.saturating_sub(self.spent)
    }

    /// The sought ends: the input, and whether the upper one.
    fn ends(&self) -> Vec<(usize, bool)> {
        let both = |&(axis, sought): &(usize, [bool; 2])| [(axis, false, sought[0]), (axis, true, sought[1])];
        self.sought.iter().flat_map(both).filter(|end| end.2).map(|end| (end.0, end.1)).collect()
    }

    /// The sought ends that still lie at the huge bound.
    fn far_ends(&self) -> Vec<(usize, bool)> {
        let mut ends = self.ends();
        ends.retain(|&(axis, up)| self.outer[axis][usize::from(up)].abs() >= FAR);
        ends
    }

    /// Brings all ends from infinity to somewhere finite; each that is found may help with the others.
    fn from_infinity(&mut self) -> Result<Ends, Cancelled> {
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
    fn narrow(&mut self) -> Result<bool, Cancelled> {
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
    fn climb(&mut self, axis: usize, up: bool, stop: Stop, allowance: u64) -> Result<Climb, Cancelled> {
        let sign = if up { 1.0 } else { -1.0 };
        let reach = |sides: &[[f64; 2]]| sign * sides[axis][usize::from(up)];
        let most = self.spent.saturating_add(allowance);
        let whole = self.outer.clone();
        let mut heap = BinaryHeap::new();
        heap.push(Candidate {
            reach: reach(&whole),
            score: 0.0,
            number: 0,
            sides: whole,
            program: Arc::clone(&self.program),
        });
        while let Some(top) = heap.pop() {
            self.interrupt.tick()?;
            let known = self.inner.as_ref().map_or(f64::NEG_INFINITY, |inner| reach(inner));
            if known >= FAR && self.outer[axis][usize::from(up)].is_infinite() {
                return Ok(Climb::Endless);
            }
            let is_near = match stop {
                Stop::Finite => top.reach.is_finite(),
                Stop::Within(length) => top.reach - known <= length || top.sides.iter().all(|s| width(*s) <= length),
                Stop::Part(part) => {
                    let close = |(side, all): (&[f64; 2], &[f64; 2])| width(*side) <= part * width(*all);
                    top.reach - known <= part * width(self.outer[axis]) || top.sides.iter().zip(&self.outer).all(close)
                }
            };
            if is_near || top.reach <= known || (self.spent > most && top.reach.is_finite()) {
                return Ok(Climb::Reach(sign * top.reach.max(known)));
            }
            if self.spent > most {
                return Ok(Climb::Open);
            }
            for child in self.split(&top, axis, up) {
                let known = self.inner.as_ref().map_or(f64::NEG_INFINITY, |inner| reach(inner));
                let reach = reach(&child.sides);
                if reach > known {
                    heap.push(Candidate { reach, ..child });
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
        let mut open = Vec::new();
        for (lane, (sides, value)) in parts.into_iter().zip(bounds).enumerate() {
            if value.is_empty() || value.is_negative() {
                continue;
            }
            if value.is_positive() {
                self.add_inside(&sides);
                continue;
            }
            let program = self.boxes.specialise(&of.program, lane).map_or_else(|| Arc::clone(&of.program), Arc::new);
            open.push((sides, program));
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
        self.spent += parts.len() as u64 * (program.len() as u64 + OVERHEAD);
        values
    }

    /// A box that is still to be split, with the value at its middle. The point below that at the end that reaches less far is looked at
    /// as well: flat faces often lie there.
    fn candidate(&mut self, sides: Vec<[f64; 2]>, program: Arc<Program>, (axis, up): (usize, bool)) -> Candidate {
        let mut point: Vec<f64> = sides.iter().map(|side| middle(*side)).collect();
        let value = self.value(&program, &point);
        point[axis] = sides[axis][usize::from(!up)];
        if point[axis].is_finite() {
            self.value(&program, &point);
        }
        self.count += 1;
        let score = if value.is_nan() { f64::NEG_INFINITY } else { value };
        Candidate { reach: 0.0, score, number: self.count, sides, program }
    }

    fn value(&mut self, program: &Program, point: &[f64]) -> f64 {
        let columns: Vec<[f64; 1]> = point.iter().map(|&c| [c]).collect();
        let slices: Vec<&[f64]> = columns.iter().map(<[f64; 1]>::as_slice).collect();
        let mut value = [0.0];
        self.points.eval(program, &slices, &mut value);
        self.spent += program.len() as u64;
        self.learn(value[0], point);
        value[0]
    }

    fn learn(&mut self, value: f64, point: &[f64]) {
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

    /// Where intervals fail: points at all scales, then about what they found. Gives the directions in which it goes on, if it does.
    fn from_samples(&mut self) -> Result<Option<Vec<(usize, bool)>>, Cancelled> {
        let ends = self.ends();
        let whole = self.outer.clone();
        let sought: Vec<usize> = self.sought.iter().map(|s| s.0).collect();
        for power in -8..=20 {
            let size = f64::from(power).exp2();
            let scaled: Vec<[f64; 2]> = (0..whole.len())
                .map(|axis| match sought.contains(&axis) {
                    true => [(-size).clamp(whole[axis][0], whole[axis][1]), size.clamp(whole[axis][0], whole[axis][1])],
                    false => whole[axis],
                })
                .collect();
            self.scatter(&scaled, SAMPLES)?;
        }
        let far = f64::from(1 << 18);
        let inner = self.inner.clone();
        let goes_on: Vec<(usize, bool)> = ends
            .iter()
            .copied()
            .filter(|&(axis, up)| inner.as_ref().is_some_and(|inner| inner[axis][usize::from(up)].abs() > far))
            .collect();
        if !goes_on.is_empty() {
            return Ok(Some(goes_on));
        }
        for _ in 0..3 {
            let Some(inner) = self.inner.clone() else { return Ok(None) };
            let wider = |axis: usize| {
                let room = 0.5 * width(inner[axis]);
                [(inner[axis][0] - room).max(whole[axis][0]), (inner[axis][1] + room).min(whole[axis][1])]
            };
            let around: Vec<[f64; 2]> = (0..whole.len()).map(wider).collect();
            self.scatter(&around, 8 * SAMPLES)?;
        }
        let Some(inner) = &self.inner else { return Ok(None) };
        // What lies between the outermost points and the end of the object is not known: room for some of it.
        for (axis, up) in ends {
            let room = width(inner[axis]) / 8.0;
            let side = &mut self.outer[axis][usize::from(up)];
            *side = if up { side.min(inner[axis][1] + room) } else { side.max(inner[axis][0] - room) };
        }
        Ok(None)
    }

    /// Evaluates points spread evenly over a box, always the same ones.
    fn scatter(&mut self, sides: &[[f64; 2]], count: usize) -> Result<(), Cancelled> {
        self.interrupt.tick()?;
        // Steps of the golden ratio's relatives fill a box of any dimension evenly (Roberts 2018).
        let root = (0..64).fold(2.0, |root: f64, _| (1.0 + root).powf(1.0 / (sides.len() as f64 + 1.0)));
        let columns: Vec<Vec<f64>> = sides
            .iter()
            .zip(1..)
            .map(|([lo, hi], power)| {
                let step = root.powi(-power);
                (0..count).map(|i| lo + (hi - lo) * (0.5 + step * (i + 1) as f64).fract()).collect()
            })
            .collect();
        let slices: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
        let mut values = vec![0.0; count];
        let program = Arc::clone(&self.program);
        self.points.eval(&program, &slices, &mut values);
        self.spent += count as u64 * program.len() as u64;
        for (i, &value) in values.iter().enumerate() {
            if value >= 0.0 || self.best.as_ref().is_none_or(|(best, _)| value > *best) {
                let point: Vec<f64> = columns.iter().map(|column| column[i]).collect();
                self.learn(value, &point);
            }
        }
        Ok(())
    }

    /// The outer box with some room, its sought ends rounded outward to short numbers.
    fn rounded(&self) -> Vec<[f64; 2]> {
        let longest = self.sought.iter().map(|&(axis, _)| width(self.outer[axis])).fold(0.0, f64::max);
        let mut ranges = self.outer.clone();
        for &(axis, [lower, upper]) in &self.sought {
            let [lo, hi] = self.outer[axis];
            // A sheet without thickness still gets some room.
            let unit = Unit::of((hi - lo).max(longest / 100.0) / 50.0);
            if lower {
                ranges[axis][0] = -unit.above(-lo);
            }
            if upper {
                ranges[axis][1] = unit.above(hi);
            }
        }
        ranges
    }
}

/// A short step: 1, 2 or 5 times a power of ten.
struct Unit {
    mantissa: f64,
    power: i32,
}

impl Unit {
    /// The shortest that is not smaller than `size`.
    fn of(size: f64) -> Self {
        let power = size.log10().floor();
        let rest = size / 10_f64.powf(power);
        let mantissa = [1.0, 2.0, 5.0].into_iter().find(|m| rest <= m * (1.0 + 1e-9)).unwrap_or(10.0);
        Self { mantissa, power: power as i32 }
    }

    /// The first multiple that leaves some room above `value`.
    fn above(&self, value: f64) -> f64 {
        let step = self.mantissa * 10_f64.powi(self.power);
        let count = (value / step + 0.2).ceil();
        // Whole numbers and quotients by powers of ten are as short as they look.
        let digits = count * self.mantissa;
        if self.power >= 0 { digits * 10_f64.powi(self.power) } else { digits / 10_f64.powi(-self.power) }
    }
}

fn width([lo, hi]: [f64; 2]) -> f64 {
    hi - lo
}

/// Whether a range is so short that it is one point to a user.
fn is_point([lo, hi]: [f64; 2]) -> bool {
    hi - lo <= 1e-9 * (1.0 + lo.abs().max(hi.abs()))
}

fn squeezed(x: f64) -> f64 {
    if x.is_infinite() { x.signum() } else { x / (1.0 + x.abs()) }
}

/// Where a range is split: at 0 if it lies well within, else in the middle, on a scale of powers where the range is long.
fn middle([lo, hi]: [f64; 2]) -> f64 {
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

    #[test]
    fn ends_are_short_numbers_with_room() {
        for (size, value, end) in
            [(4.0, 2.0, 2.1), (4.0, 2.01, 2.1), (2.0, 1.0, 1.05), (0.02, -0.37, -0.3695), (1e6, 5e5, 520_000.0)]
        {
            assert_eq!(Unit::of(size / 50.0).above(value), end, "{value} of {size}");
        }
    }
}
