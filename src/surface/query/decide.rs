//! Branch and bound: whether some point of a space meets all conditions. Knows nothing of objects but their conditions.

use std::collections::BinaryHeap;
use std::sync::Arc;

use super::climb::climb;
use super::linear::{Linear, contract, excludes, fails};
use super::{Conditions, Near, Verdict};
use crate::interrupt::{Cancelled, Interrupt};
use crate::number::rank::Ranked;
use crate::number::{Interval, Unary};
use crate::surface::space::{FAR, middle, squeezed};
use crate::vm::{Boxes, Gradients, Points, Program};

/// Units in the last place of the coordinates within which objects that touch cannot be told from objects that just miss each other.
const ULPS: f64 = 4.0;

/// Boxes for which the derivatives of a longer program than that are not made yet: intervals alone decide most questions soon.
const PLAIN: usize = 300;
const LONG: usize = 100;
/// How far from the origin that is asked in a space without end.
const NEAR: f64 = 1e3;

/// A box that may hold a point that meets all conditions.
struct Part {
    /// How near its middle comes to that, in changes of the conditions within the box.
    score: f64,
    sides: Vec<[f64; 2]>,
    /// The conditions that are not met all over it.
    open: Vec<Open>,
    /// The axes along which it is to be split.
    along: Vec<usize>,
}

/// A condition that is neither met nor failed all over a box.
struct Open {
    number: usize,
    /// The program that is right inside.
    program: Arc<Program>,
    /// Whether its function changes over the box without jumps, as far as is known.
    is_smooth: bool,
}

struct Search<'a> {
    conditions: &'a mut Conditions,
    space: &'a [[f64; 2]],
    boxes: Boxes,
    points: Points<f64>,
    gradients: Gradients,
    interrupt: &'a Interrupt,
    heap: BinaryHeap<Ranked<1, Part>>,
    count: usize,
    /// The point to which a climb came nearest, and how near.
    best: Option<(f64, Vec<f64>)>,
    found: Option<Vec<f64>>,
}

/// Decides whether a point of a space, whose ends may be infinite, meets all conditions; looks at no more than `most` boxes. What is farther
/// than 10^12 from the origin and not decided by intervals alone is not looked at. A point at which rounding hides whether the conditions are met
/// meets those that ask for the inside, and not those that ask for the outside.
///
/// # Errors
/// [`Cancelled`] soon after the interrupt was set.
pub fn decide(
    conditions: &mut Conditions,
    space: &[[f64; 2]],
    most: usize,
    interrupt: &Interrupt,
) -> Result<Verdict, Cancelled> {
    if conditions.contradict() {
        return Ok(Verdict::Never);
    }
    let near = match conditions.together(space, most, interrupt)? {
        None => return Ok(Verdict::Never),
        Some(near) => near,
    };
    let mut search = Search {
        conditions,
        space: &near,
        boxes: Boxes::heeding(interrupt),
        points: Points::heeding(interrupt),
        gradients: Gradients::heeding(interrupt),
        interrupt,
        heap: BinaryHeap::new(),
        count: 0,
        best: None,
        found: None,
    };
    let verdict = search.run(most);
    // What was evaluated after the interrupt was set means nothing.
    interrupt.tick()?;
    verdict
}

impl Search<'_> {
    fn run(&mut self, most: usize) -> Result<Verdict, Cancelled> {
        let open = self.conditions.all.iter().enumerate().map(|(number, c)| Open {
            number,
            program: Arc::clone(&c.value),
            is_smooth: false,
        });
        let open = open.collect();
        let whole = Part { score: 0.0, sides: self.space.to_vec(), open, along: Vec::new() };
        self.examine(&whole, vec![self.space.to_vec()])?;
        let (mut popped, mut next_climb, mut left) = (0_usize, 1, None);
        while let Some(Ranked { item: part, .. }) = self.heap.pop() {
            self.interrupt.tick()?;
            popped += 1;
            if popped == next_climb && self.found.is_none() {
                // Seldom at last: boxes alone prove that there is nothing.
                next_climb = 2 * next_climb + 2;
                self.climb(&part)?;
            }
            if let Some(point) = self.found.take() {
                return Ok(Verdict::At(point));
            }
            if self.count >= most {
                return self.undecided(Some(part), true);
            }
            let children = halved(&part);
            match children.len() {
                1 => left = Some(part),
                _ => self.examine(&part, children)?,
            }
        }
        if let Some(point) = self.found.take() {
            return Ok(Verdict::At(point));
        }
        match left {
            None => Ok(Verdict::Never),
            left => self.undecided(left, false),
        }
    }

    /// What is known in the end.
    fn undecided(&mut self, left: Option<Part>, is_spent: bool) -> Result<Verdict, Cancelled> {
        if let Some(part) = left {
            self.climb(&part)?;
        }
        if let Some(point) = self.found.take() {
            return Ok(Verdict::At(point));
        }
        let (distance, place) = self.best.take().unwrap_or_else(|| (f64::INFINITY, centre(self.space)));
        Ok(Verdict::Open(Near { place, distance, is_spent }))
    }

    /// Goes uphill from the middle of a box.
    fn climb(&mut self, part: &Part) -> Result<(), Cancelled> {
        let diagonal = part.sides.iter().map(|[lo, hi]| (hi - lo) * (hi - lo)).sum::<f64>().sqrt();
        if !diagonal.is_finite() {
            return Ok(());
        }
        let means = (&mut self.gradients, self.interrupt);
        let (point, stands) = climb(self.conditions, &centre(&part.sides), diagonal, self.space, means)?;
        if stands.met || self.touch(&point) {
            self.found = Some(point);
            return Ok(());
        }
        let distance = stands.distance();
        if self.best.as_ref().is_none_or(|(best, _)| distance < *best) {
            self.best = Some((distance, point));
        }
        Ok(())
    }

    /// Whether a point meets all conditions.
    fn meets(&mut self, point: &[f64]) -> bool {
        let columns: Vec<[f64; 1]> = point.iter().map(|&c| [c]).collect();
        let slices: Vec<&[f64]> = columns.iter().map(<[f64; 1]>::as_slice).collect();
        self.conditions.all.iter().all(|condition| {
            let mut value = [0.0];
            self.points.eval(&condition.value, &slices, &mut value);
            (value[0] >= 0.0) != condition.outside
        })
    }

    /// Whether rounding hides that the objects meet at a point: within some units in the last place of its coordinates no condition can be told
    /// to fail.
    fn touch(&mut self, point: &[f64]) -> bool {
        // Where space has no end rounding hides any gap, far enough away.
        let far = self.space.iter().flatten().fold(0.0_f64, |far, end| far.max(end.abs()));
        if point.iter().any(|c| c.abs() > if far.is_finite() { far } else { NEAR }) {
            return false;
        }
        let near = |c: f64| {
            let room = ULPS * f64::EPSILON * c.abs();
            [c - room, c + room]
        };
        let sides: Vec<[f64; 2]> = point.iter().map(|&c| near(c)).collect();
        self.conditions.all.iter().all(|condition| {
            let value = bounds(&mut self.boxes, &condition.value, &[&sides])[0];
            !condition.outside && value.hi >= 0.0
        })
    }

    /// Looks at the parts of a box; those that may hold a point are kept.
    fn examine(&mut self, of: &Part, sides: Vec<Vec<[f64; 2]>>) -> Result<(), Cancelled> {
        self.count += sides.len();
        let mut parts: Vec<Option<Part>> = sides
            .into_iter()
            .map(|sides| Some(Part { score: 0.0, sides, open: Vec::new(), along: Vec::new() }))
            .collect();
        for open in &of.open {
            self.bound(open.number, &open.program, &mut parts);
        }
        let mut parts: Vec<Part> = parts.into_iter().flatten().collect();
        // What lies so far away that intervals say nothing is left alone.
        parts.retain(|part| !part.sides.iter().any(|[lo, hi]| *lo >= FAR || *hi <= -FAR));
        if let Some(part) = parts.iter().find(|part| part.open.is_empty()) {
            let point = centre(&part.sides);
            self.found.get_or_insert(point);
            return Ok(());
        }
        let linear = self.linear(&parts);
        for (mut part, linear) in parts.into_iter().zip(linear) {
            let middle = centre(&part.sides);
            if !self.is_possible(&mut part, &linear, &middle) {
                continue;
            }
            self.rate(&mut part, &linear);
            if part.score > 0.0 && self.meets(&middle) {
                self.found.get_or_insert(middle);
                return Ok(());
            }
            self.heap.push(Ranked { rank: [part.score], number: self.count + self.heap.len(), item: part });
        }
        Ok(())
    }

    /// Bounds a condition over boxes: those where it fails everywhere go, where it is met everywhere it is not asked again.
    fn bound(&mut self, number: usize, program: &Arc<Program>, parts: &mut [Option<Part>]) {
        let lanes: Vec<usize> = (0..parts.len()).filter(|&i| parts[i].is_some()).collect();
        let all: Vec<&[[f64; 2]]> = parts.iter().flatten().map(|part| &part.sides[..]).collect();
        let values = bounds(&mut self.boxes, program, &all);
        let outside = self.conditions.all[number].outside;
        for (lane, (&i, value)) in lanes.iter().zip(values).enumerate() {
            let (none, every) = (value.is_empty() || value.is_negative(), value.is_positive());
            let (fails, holds) = if outside { (every, none) } else { (none, every) };
            if fails {
                parts[i] = None;
            } else if let (false, Some(part)) = (holds, &mut parts[i]) {
                let program = self.boxes.specialise(program, lane).map_or_else(|| Arc::clone(program), Arc::new);
                let is_smooth = !value.undefined && program.is_continuous();
                part.open.push(Open { number, program, is_smooth });
            }
        }
    }

    /// The linear forms of the open conditions over each finite box.
    fn linear(&mut self, parts: &[Part]) -> Vec<Vec<(usize, Linear)>> {
        let mut all: Vec<Vec<(usize, Linear)>> = parts.iter().map(|_| Vec::new()).collect();
        let finite = |part: &Part| part.sides.iter().flatten().all(|c| c.is_finite());
        for number in 0..self.conditions.all.len() {
            let asked = |part: &Part| part.open.iter().any(|open| open.number == number && open.is_smooth);
            let lanes: Vec<usize> = (0..parts.len()).filter(|&i| finite(&parts[i]) && asked(&parts[i])).collect();
            if lanes.is_empty() || (self.count < PLAIN && self.conditions.all[number].value.len() > LONG) {
                continue;
            }
            let Some(programs) = self.conditions.slopes(number) else { continue };
            let boxes: Vec<&[[f64; 2]]> = lanes.iter().map(|&i| &parts[i].sides[..]).collect();
            let slopes: Vec<Vec<Interval>> = programs
                .iter()
                .map(|program| match program {
                    Some(program) => bounds(&mut self.boxes, program, &boxes),
                    None => vec![Interval::point(0.0); boxes.len()],
                })
                .collect();
            let centres: Vec<Vec<[f64; 2]>> =
                boxes.iter().map(|sides| centre(sides).into_iter().map(|c| [c, c]).collect()).collect();
            let centres: Vec<&[[f64; 2]]> = centres.iter().map(Vec::as_slice).collect();
            let values = bounds(&mut self.boxes, &self.conditions.all[number].value, &centres);
            let outside = self.conditions.all[number].outside;
            let signed = |i: Interval| if outside { Unary::Neg.interval(i) } else { i };
            for (lane, &i) in lanes.iter().enumerate() {
                let slopes = slopes.iter().map(|axis| signed(axis[lane])).collect();
                let linear = Linear::new(signed(values[lane]), slopes, centres[lane], outside);
                if linear.is_usable() {
                    all[i].push((number, linear));
                }
            }
        }
        all
    }

    /// Whether the linear forms leave something of a box; it is made smaller where they say so.
    fn is_possible(&mut self, part: &mut Part, linear: &[(usize, Linear)], centre: &[f64]) -> bool {
        if linear.iter().any(|(_, form)| fails(form, &part.sides, centre)) {
            return false;
        }
        for (i, (_, a)) in linear.iter().enumerate() {
            if linear[..i].iter().any(|(_, b)| excludes(a, b, &part.sides, centre)) {
                return false;
            }
        }
        linear.iter().all(|(_, form)| contract(form, &mut part.sides, centre))
    }

    /// How promising a box is, and along which axes it is to be split.
    fn rate(&mut self, part: &mut Part, linear: &[(usize, Linear)]) {
        let axes = part.sides.len();
        let mut change = vec![0.0; axes];
        part.score = f64::INFINITY;
        for (_, form) in linear {
            let each: Vec<f64> = (0..axes).map(|axis| form.change(axis, part.sides[axis])).collect();
            let all: f64 = each.iter().sum::<f64>() + f64::MIN_POSITIVE;
            part.score = part.score.min((0.5 * form.value.lo + 0.5 * form.value.hi) / all);
            change.iter_mut().zip(each).for_each(|(sum, one)| *sum += one / all);
        }
        if linear.len() < part.open.len() {
            // Some condition has no slopes here: all sides count as they are long.
            for (change, (side, whole)) in change.iter_mut().zip(part.sides.iter().zip(self.space)) {
                *change += length(*side, *whole);
            }
            if linear.is_empty() {
                // Boxes of which nothing is known come first, the large ones foremost.
                part.score = change.iter().copied().fold(0.0, f64::max);
            }
        }
        // What has no end is brought to one first: else its other sides would be cut for nothing.
        let endless = |axis: &usize| !(part.sides[*axis][1] - part.sides[*axis][0]).is_finite();
        if (0..axes).any(|axis| endless(&axis)) {
            part.along = (0..axes).filter(endless).take(3).collect();
            return;
        }
        let mut order: Vec<usize> = (0..axes).filter(|&axis| is_divisible(part.sides[axis])).collect();
        order.sort_by(|&a, &b| change[b].total_cmp(&change[a]).then(a.cmp(&b)));
        let most = order.first().map_or(0.0, |&axis| change[axis]);
        part.along = order.into_iter().filter(|&axis| change[axis] > 0.3 * most || most == 0.0).take(3).collect();
    }
}

/// A side as a part of the whole; of an endless one as if it were short: x / (1 + |x|).
fn length([lo, hi]: [f64; 2], [from, to]: [f64; 2]) -> f64 {
    if (to - from).is_finite() { (hi - lo) / (to - from) } else { 0.5 * (squeezed(hi) - squeezed(lo)) }
}

fn is_divisible(side: [f64; 2]) -> bool {
    let at = middle(side);
    side[0] < at && at < side[1]
}

fn centre(sides: &[[f64; 2]]) -> Vec<f64> {
    let within = |[lo, hi]: [f64; 2]| if (hi - lo).is_finite() { lo + 0.5 * (hi - lo) } else { middle([lo, hi]) };
    sides.iter().map(|&side| within(side)).collect()
}

/// The box cut along its axes; itself if it cannot be.
fn halved(part: &Part) -> Vec<Vec<[f64; 2]>> {
    let mut parts = vec![part.sides.clone()];
    for &axis in &part.along {
        let at = middle(part.sides[axis]);
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
    parts
}

fn bounds(boxes: &mut Boxes, program: &Program, all: &[&[[f64; 2]]]) -> Vec<Interval> {
    let mut values = vec![Interval::EMPTY; all.len()];
    let columns: Vec<Vec<Interval>> = (0..program.inputs().len())
        .map(|axis| all.iter().map(|sides| Interval::new(sides[axis][0], sides[axis][1])).collect())
        .collect();
    let slices: Vec<&[Interval]> = columns.iter().map(Vec::as_slice).collect();
    boxes.eval(program, &slices, &mut values);
    values
}
