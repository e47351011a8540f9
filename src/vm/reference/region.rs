//! Regions as the walk evaluates them: one point or one box at a time, turn by turn, question by question.

use super::{Meaning, eval_all};
use crate::field::{Bound, Coordinate, Form, Guard, NodeId, Region};
use crate::limits::Limits;
use crate::number::extremum::ball::{self, Ball, GRADIENT, Plan};
use crate::number::extremum::section::{self, Section};
use crate::number::turns::Turns;
use crate::number::{Binary, Dual, Duals, Interval, Intervals, Reals};

/// Values of roots of a region's graph, the parameters being these.
fn roots<M: Meaning>(meaning: &mut M, region: &Region, roots: &[NodeId], parameters: &[M::Number]) -> Vec<M::Number> {
    let point: Vec<(Coordinate, M::Number)> = (1..).map(Coordinate).zip(parameters.iter().cloned()).collect();
    eval_all(meaning, region.graph(), roots, &point)
}

/// The outputs of a region for kinds of number that stand for one point. `value` is a number as a double, `moving` one that moves as so
/// many times another one does.
pub fn at_a_point<M: Meaning>(
    meaning: &mut M,
    region: &Region,
    arguments: &[M::Number],
    value: impl Fn(&M::Number) -> f64,
    moving: impl Fn(f64, &M::Number, f64) -> M::Number,
) -> Vec<M::Number> {
    let limits = Limits::default();
    let plain: Vec<f64> = arguments.iter().map(&value).collect();
    match region.form() {
        Form::Loop { next, .. } => {
            let mut parameters = arguments.to_vec();
            for turn in 0.. {
                let results = roots(meaning, region, &region.form().roots(), &parameters);
                let holds = value(&results[0]);
                if holds == 0.0 || holds.is_nan() {
                    break;
                }
                if turn == limits.point_turns {
                    return vec![meaning.constant(f64::NAN); next.len()];
                }
                parameters[..next.len()].clone_from_slice(&results[1..=next.len()]);
            }
            parameters.truncate(next.len());
            parameters
        }
        Form::Section { body, continuous, .. } => {
            let mut walk = Walk { region, still: plain[2..].to_vec(), centre: Vec::new(), continuous: *continuous };
            let at = section::highest(&mut walk, plain[0], plain[1], limits.section_pieces);
            let moves = match at {
                at if at == plain[1] => moving(at, &arguments[1], 1.0),
                at if at == plain[0] => moving(at, &arguments[0], 1.0),
                at => meaning.constant(at),
            };
            let mut parameters = vec![moves.clone()];
            parameters.extend_from_slice(&arguments[2..]);
            let highest = roots(meaning, region, &[*body], &parameters).remove(0);
            vec![if at.is_nan() { meaning.constant(f64::NAN) } else { highest }, moves]
        }
        Form::Ball { body, dimension } => {
            let r = plain[*dimension];
            let still = plain[dimension + 1..].to_vec();
            let centre = plain[..*dimension].iter().map(|c| Interval { lo: *c, hi: *c, undefined: false }).collect();
            let mut walk = Walk { region, still, centre, continuous: false };
            let steps = ball::highest(&mut walk, *dimension, r, &Plan::new(*dimension), false);
            let length = steps.iter().fold(0.0, |all, x| Binary::Hypot.real(all, *x));
            let rim = r > 0.0 && length >= r * (1.0 - 1e-9);
            let step = |meaning: &mut M, x: f64| match rim {
                true => moving(x, &arguments[*dimension], x / r),
                false => meaning.constant(x),
            };
            let moves: Vec<M::Number> = steps.iter().map(|x| step(meaning, *x)).collect();
            let mut parameters = Vec::new();
            for (at, step) in arguments.iter().zip(&moves) {
                parameters.push(meaning.binary(Binary::Add, at.clone(), step.clone()));
            }
            parameters.extend_from_slice(&arguments[dimension + 1..]);
            let highest = roots(meaning, region, &[*body], &parameters).remove(0);
            let highest = if steps[0].is_nan() { meaning.constant(f64::NAN) } else { highest };
            std::iter::once(highest).chain(moves).collect()
        }
    }
}

/// The ranges of the outputs of a region over a box.
pub fn over_a_box(region: &Region, arguments: &[Interval]) -> Vec<Interval> {
    match region.form() {
        Form::Loop { next, guards, .. } => repeated(region, next.len(), guards, arguments),
        Form::Section { continuous, .. } => {
            let mut walk = Boxes { region, still: &arguments[2..], centre: &[], continuous: *continuous };
            section::bounds(&mut walk, arguments[0], arguments[1]).to_vec()
        }
        Form::Ball { dimension, .. } => {
            let (centre, rest) = arguments.split_at(*dimension);
            let mut walk = Boxes { region, still: &rest[1..], centre, continuous: false };
            let (value, step) = ball::bounds(&mut walk, *dimension, rest[0], &Plan::new(*dimension));
            std::iter::once(value).chain(std::iter::repeat_n(step, *dimension)).collect()
        }
    }
}

fn repeated(region: &Region, count: usize, guards: &[Guard], arguments: &[Interval]) -> Vec<Interval> {
    let mut turns = Turns::default();
    turns.begin(count);
    let mut parameters = arguments.to_vec();
    for turn in 0.. {
        let results = roots(&mut Intervals, region, &region.form().roots(), &parameters);
        let parts = guards.iter().zip(&results[count + 1..]).map(|(g, holds)| (*holds, g.bound.map(Bound::within)));
        if !turns.goes_on(results[0], parts, |i| parameters[i]) {
            break;
        }
        let mut next = results[1..=count].to_vec();
        if turns.joins() {
            next.iter_mut().zip(&parameters).for_each(|(next, old)| *next = Turns::joined(*old, *next));
        }
        if turn == Limits::default().point_turns || (turns.joins() && next == parameters[..count]) {
            turns.give_up();
            break;
        }
        parameters[..count].copy_from_slice(&next);
    }
    turns.result
}

/// A region whose parameters that do not move have these values.
struct Walk<'a> {
    region: &'a Region,
    still: Vec<f64>,
    centre: Vec<Interval>,
    continuous: bool,
}

impl Walk<'_> {
    fn boxes<'b>(&'b self, still: &'b [Interval]) -> Boxes<'b> {
        Boxes { region: self.region, still, centre: &self.centre, continuous: self.continuous }
    }

    fn points(&self) -> Vec<Interval> {
        self.still.iter().map(|v| Interval::point(*v)).collect()
    }
}

impl Section for Walk<'_> {
    fn slopes(&mut self, at: &[f64], values: &mut [f64], slopes: &mut [f64]) {
        for (i, t) in at.iter().enumerate() {
            let mut parameters = vec![Dual::<1>::variable(*t, 0)];
            parameters.extend(self.still.iter().map(|v| Dual::constant(*v)));
            let body = self.region.form().roots()[0];
            let dual = roots(&mut Duals::<1>, self.region, &[body], &parameters)[0];
            (values[i], slopes[i]) = (dual.value, dual.slope[0]);
        }
    }

    fn ranges(&mut self, over: &[Interval], values: &mut [Interval], slopes: &mut [Interval]) {
        let still = self.points();
        Section::ranges(&mut self.boxes(&still), over, values, slopes);
    }

    fn is_continuous(&self) -> bool {
        self.continuous
    }
}

impl Ball for Walk<'_> {
    fn values(&mut self, steps: &[Vec<f64>], values: &mut [f64]) {
        for (i, value) in values.iter_mut().enumerate() {
            let mut parameters: Vec<f64> = self.centre.iter().zip(steps).map(|(c, s)| c.lo + s[i]).collect();
            parameters.extend(&self.still);
            *value = roots(&mut Reals, self.region, &self.region.form().roots(), &parameters)[0];
        }
    }

    fn ranges(&mut self, steps: &[Vec<Interval>], values: &mut [Interval]) {
        let still = self.points();
        Ball::ranges(&mut self.boxes(&still), steps, values);
    }

    fn gradient(&mut self, step: &[f64]) -> [f64; GRADIENT] {
        let at = self.centre.iter().zip(step).enumerate();
        let mut parameters: Vec<_> = at.map(|(axis, (c, s))| Dual::<GRADIENT>::variable(c.lo + s, axis)).collect();
        parameters.extend(self.still.iter().map(|v| Dual::constant(*v)));
        roots(&mut Duals::<GRADIENT>, self.region, &self.region.form().roots(), &parameters)[0].slope
    }
}

/// The same over a box.
struct Boxes<'a> {
    region: &'a Region,
    still: &'a [Interval],
    centre: &'a [Interval],
    continuous: bool,
}

impl Section for Boxes<'_> {
    fn slopes(&mut self, _: &[f64], values: &mut [f64], slopes: &mut [f64]) {
        values.fill(f64::NAN);
        slopes.fill(f64::NAN);
    }

    fn ranges(&mut self, over: &[Interval], values: &mut [Interval], slopes: &mut [Interval]) {
        for (i, over) in over.iter().enumerate() {
            let parameters: Vec<Interval> = std::iter::once(over).chain(self.still).copied().collect();
            let results = roots(&mut Intervals, self.region, &self.region.form().roots(), &parameters);
            (values[i], slopes[i]) = (results[0], results[1]);
        }
    }

    fn is_continuous(&self) -> bool {
        self.continuous
    }
}

impl Ball for Boxes<'_> {
    fn values(&mut self, _: &[Vec<f64>], values: &mut [f64]) {
        values.fill(f64::NAN);
    }

    fn ranges(&mut self, steps: &[Vec<Interval>], values: &mut [Interval]) {
        for (i, value) in values.iter_mut().enumerate() {
            let moved = self.centre.iter().zip(steps).map(|(c, s)| Binary::Add.interval(*c, s[i]));
            let parameters: Vec<Interval> = moved.chain(self.still.iter().copied()).collect();
            *value = roots(&mut Intervals, self.region, &self.region.form().roots(), &parameters)[0];
        }
    }

    fn gradient(&mut self, _: &[f64]) -> [f64; GRADIENT] {
        [f64::NAN; GRADIENT]
    }
}
