//! Searches for highest values, lane by lane: many questions of one search are answered by one run of a program over a block.

use super::super::block::Doubles;
use super::super::choice::Choices;
use super::super::gradient::Duals;
use super::super::interval::Ranges;
use super::super::kernels::{Kind, Store};
use super::{Body, Pointwise, RegionStore, copy, room};
use crate::interrupt::Interrupt;
use crate::number::extremum::ball::{self, Ball, GRADIENT, Plan};
use crate::number::extremum::section::{self, Section};
use crate::number::{Binary, Dual, Interval};

/// How near to its boundary, in parts of the radius, a place in a ball counts as on it.
const RIM: f64 = 1.0 - 1e-9;

/// What is said of a box once the search is to stop.
const UNKNOWN: Interval = Interval { undefined: true, ..Interval::WHOLE };

/// Evaluators for the questions of a search.
pub(crate) struct Probe {
    doubles: Store<Doubles>,
    duals: Store<Duals>,
    ranges: Store<Ranges>,
    choices: Choices,
}

impl Probe {
    fn heeding(interrupt: &Interrupt) -> Box<Self> {
        let (doubles, duals) = (Store::heeding(interrupt), Store::heeding(interrupt));
        Box::new(Self { doubles, duals, ranges: Store::heeding(interrupt), choices: Choices::default() })
    }

    /// Whether the answers mean nothing any more.
    fn is_cancelled(&self) -> bool {
        self.doubles.interrupt.is_cancelled()
    }

    fn run_ranges(&mut self, body: &Body, lanes: usize) {
        self.ranges.live = lanes;
        self.choices.begin(body.program.operations.len(), lanes);
        Ranges::run(&body.program, &mut self.ranges, lanes, &mut self.choices);
    }

    /// Sets an input of the ranges for all questions.
    fn fix_range(&mut self, input: usize, value: Interval) {
        let block = self.ranges.input(input);
        (0..Ranges::LANES).for_each(|i| Ranges::set(block, i, value));
    }
}

/// A section at one point.
struct At<'a> {
    body: &'a Body,
    both: &'a Body,
    continuous: bool,
    probe: &'a mut Probe,
}

impl Section for At<'_> {
    fn slopes(&mut self, at: &[f64], values: &mut [f64], slopes: &mut [f64]) {
        let store = &mut self.probe.duals;
        let block = store.input(0);
        for (i, t) in at.iter().enumerate() {
            Duals::set(block, i, Dual { value: *t, slope: [1.0, 0.0, 0.0] });
        }
        store.live = at.len();
        Duals::run(&self.body.program, store, at.len().next_multiple_of(8), &mut ());
        let result = store.result(&self.body.program);
        for i in 0..at.len() {
            let dual = Duals::get(result, i);
            (values[i], slopes[i]) = (dual.value, dual.slope[0]);
        }
    }

    fn ranges(&mut self, over: &[Interval], values: &mut [Interval], slopes: &mut [Interval]) {
        both_ranges(self.probe, self.both, over, values, slopes);
    }

    fn is_continuous(&self) -> bool {
        self.continuous
    }
}

/// A section over a box.
struct Over<'a> {
    both: &'a Body,
    continuous: bool,
    probe: &'a mut Probe,
}

impl Section for Over<'_> {
    fn slopes(&mut self, _: &[f64], values: &mut [f64], slopes: &mut [f64]) {
        values.fill(f64::NAN);
        slopes.fill(f64::NAN);
    }

    fn ranges(&mut self, over: &[Interval], values: &mut [Interval], slopes: &mut [Interval]) {
        both_ranges(self.probe, self.both, over, values, slopes);
    }

    fn is_continuous(&self) -> bool {
        self.continuous
    }
}

fn both_ranges(probe: &mut Probe, both: &Body, over: &[Interval], values: &mut [Interval], slopes: &mut [Interval]) {
    let block = probe.ranges.input(0);
    over.iter().enumerate().for_each(|(i, interval)| Ranges::set(block, i, *interval));
    probe.run_ranges(both, over.len());
    let (value, slope) = (probe.ranges.of(&both.program, both.roots[0]), probe.ranges.of(&both.program, both.roots[1]));
    for i in 0..over.len() {
        (values[i], slopes[i]) = (Ranges::get(value, i), Ranges::get(slope, i));
    }
}

/// Searches the highest value of a section at the points of the first lanes.
pub(super) fn sections<K: Pointwise>(
    body: &Body,
    both: &Body,
    (continuous, budget): (bool, usize),
    store: &mut RegionStore<K>,
    lanes: usize,
) {
    room::<K>(&mut store.outputs, 2);
    let probe = store.probe.get_or_insert_with(|| Probe::heeding(&store.inner.interrupt));
    probe.duals.reserve(&body.program);
    probe.ranges.reserve(&both.program);
    for lane in 0..lanes {
        if probe.is_cancelled() {
            K::set(&mut store.outputs[1], lane, K::constant(f64::NAN));
            continue;
        }
        for input in 1..both.program.inputs().len() {
            let value = K::number(K::get(&store.given[input + 1], lane));
            probe.fix_range(input, Interval::point(value));
        }
        for input in 1..body.program.inputs().len() {
            let value = K::number(K::get(&store.given[input + 1], lane));
            let block = probe.duals.input(input);
            (0..Duals::LANES).for_each(|i| Duals::set(block, i, Dual::constant(value)));
        }
        let (lo, hi) = (K::get(&store.given[0], lane), K::get(&store.given[1], lane));
        let mut section = At { body, both, continuous, probe };
        let at = section::highest(&mut section, K::number(lo), K::number(hi), budget);
        let moves = if at == K::number(hi) {
            K::moving(at, hi, 1.0)
        } else if at == K::number(lo) {
            K::moving(at, lo, 1.0)
        } else {
            K::constant(at)
        };
        K::set(&mut store.outputs[1], lane, moves);
    }
    store.inner.reserve(&body.program);
    copy::<K>(&store.outputs[1], store.inner.input(0), lanes);
    for input in 1..body.program.inputs().len() {
        copy::<K>(&store.given[input + 1], store.inner.input(input), lanes);
    }
    finish(body, store, lanes);
}

/// The value where it is highest; undefined where there is no such place.
fn finish<K: Pointwise>(body: &Body, store: &mut RegionStore<K>, lanes: usize) {
    store.run(&body.program, lanes);
    let result = store.inner.of(&body.program, body.roots[0]);
    let (value, places) = store.outputs.split_at_mut(1);
    for lane in 0..lanes {
        let nowhere = K::number(K::get(&places[0], lane)).is_nan();
        let item = if nowhere { K::constant(f64::NAN) } else { K::get(result, lane) };
        K::set(&mut value[0], lane, item);
    }
}

/// Bounds the highest value of a section over the boxes of the first lanes.
pub(super) fn section_ranges(both: &Body, continuous: bool, store: &mut RegionStore<Ranges>, lanes: usize) {
    room::<Ranges>(&mut store.outputs, 2);
    let probe = store.probe.get_or_insert_with(|| Probe::heeding(&store.inner.interrupt));
    probe.ranges.reserve(&both.program);
    for lane in 0..lanes {
        if probe.is_cancelled() {
            store.outputs.iter_mut().for_each(|output| Ranges::set(output, lane, UNKNOWN));
            continue;
        }
        for input in 1..both.program.inputs().len() {
            probe.fix_range(input, Ranges::get(&store.given[input + 1], lane));
        }
        let (lo, hi) = (Ranges::get(&store.given[0], lane), Ranges::get(&store.given[1], lane));
        let bounds = section::bounds(&mut Over { both, continuous, probe }, lo, hi);
        for (output, range) in store.outputs.iter_mut().zip(bounds) {
            Ranges::set(output, lane, range);
        }
    }
}

/// A ball at one point or over a box of them.
struct About<'a> {
    body: &'a Body,
    probe: &'a mut Probe,
    /// The centre, by axis; at a point both bounds are the same.
    centre: Vec<Interval>,
}

impl Ball for About<'_> {
    fn values(&mut self, steps: &[Vec<f64>], values: &mut [f64]) {
        let store = &mut self.probe.doubles;
        for (axis, (steps, centre)) in steps.iter().zip(&self.centre).enumerate() {
            let block = store.input(axis);
            steps.iter().enumerate().for_each(|(i, step)| Doubles::set(block, i, centre.lo + step));
        }
        store.live = values.len();
        Doubles::run(&self.body.program, store, values.len().next_multiple_of(16), &mut ());
        let result = store.result(&self.body.program);
        values.iter_mut().enumerate().for_each(|(i, value)| *value = Doubles::get(result, i));
    }

    fn ranges(&mut self, steps: &[Vec<Interval>], values: &mut [Interval]) {
        for (axis, (steps, centre)) in steps.iter().zip(&self.centre).enumerate() {
            let block = self.probe.ranges.input(axis);
            let sum = |step: &Interval| Binary::Add.interval(*centre, *step);
            steps.iter().enumerate().for_each(|(i, step)| Ranges::set(block, i, sum(step)));
        }
        self.probe.run_ranges(self.body, values.len());
        let result = self.probe.ranges.result(&self.body.program);
        values.iter_mut().enumerate().for_each(|(i, value)| *value = Ranges::get(result, i));
    }

    fn gradient(&mut self, step: &[f64]) -> [f64; GRADIENT] {
        let store = &mut self.probe.duals;
        for (axis, (step, centre)) in step.iter().zip(&self.centre).enumerate() {
            let mut slope = [0.0; GRADIENT];
            slope[axis] = 1.0;
            Duals::set(store.input(axis), 0, Dual { value: centre.lo + step, slope });
        }
        store.live = 1;
        Duals::run(&self.body.program, store, 8, &mut ());
        Duals::get(store.result(&self.body.program), 0).slope
    }
}

/// Searches the highest value in a ball at the points of the first lanes.
pub(super) fn balls<K: Pointwise>(
    body: &Body,
    dimension: usize,
    (plan, sign): (&Plan, bool),
    store: &mut RegionStore<K>,
    lanes: usize,
) {
    room::<K>(&mut store.outputs, dimension + 1);
    store.inner.reserve(&body.program);
    let probe = store.probe.get_or_insert_with(|| Probe::heeding(&store.inner.interrupt));
    probe.doubles.reserve(&body.program);
    probe.duals.reserve(&body.program);
    probe.ranges.reserve(&body.program);
    // With derivatives the place itself is asked for.
    let sign = sign && K::STEADY;
    for lane in 0..lanes {
        if probe.is_cancelled() {
            let nowhere = K::constant(f64::NAN);
            store.outputs.iter_mut().for_each(|output| K::set(output, lane, nowhere));
            (0..dimension).for_each(|axis| K::set(store.inner.input(axis), lane, nowhere));
            continue;
        }
        let number = |input: usize| K::number(K::get(&store.given[input], lane));
        for input in dimension..body.program.inputs().len() {
            let value = number(input + 1);
            let block = probe.doubles.input(input);
            (0..Doubles::LANES).for_each(|i| Doubles::set(block, i, value));
            Duals::set(probe.duals.input(input), 0, Dual::constant(value));
            probe.fix_range(input, Interval::point(value));
        }
        let radius = K::get(&store.given[dimension], lane);
        let r = K::number(radius);
        let centre = (0..dimension).map(|axis| Interval { lo: number(axis), hi: number(axis), undefined: false });
        let mut about = About { body, probe, centre: centre.collect() };
        let steps = ball::highest(&mut about, dimension, r, plan, sign);
        let length = steps.iter().fold(0.0, |all, x| Binary::Hypot.real(all, *x));
        let rim = r > 0.0 && length >= r * RIM;
        for (axis, step) in steps.into_iter().enumerate() {
            let moves = if rim { K::moving(step, radius, step / r) } else { K::constant(step) };
            K::set(&mut store.outputs[axis + 1], lane, moves);
            let at = K::binary(Binary::Add, K::get(&store.given[axis], lane), moves);
            K::set(store.inner.input(axis), lane, at);
        }
    }
    for input in dimension..body.program.inputs().len() {
        copy::<K>(&store.given[input + 1], store.inner.input(input), lanes);
    }
    finish(body, store, lanes);
}

/// Bounds the highest value in a ball over the boxes of the first lanes.
pub(super) fn ball_ranges(body: &Body, dimension: usize, plan: &Plan, store: &mut RegionStore<Ranges>, lanes: usize) {
    room::<Ranges>(&mut store.outputs, dimension + 1);
    let probe = store.probe.get_or_insert_with(|| Probe::heeding(&store.inner.interrupt));
    probe.ranges.reserve(&body.program);
    for lane in 0..lanes {
        if probe.is_cancelled() {
            store.outputs.iter_mut().for_each(|output| Ranges::set(output, lane, UNKNOWN));
            continue;
        }
        for input in dimension..body.program.inputs().len() {
            probe.fix_range(input, Ranges::get(&store.given[input + 1], lane));
        }
        let centre = (0..dimension).map(|axis| Ranges::get(&store.given[axis], lane)).collect();
        let radius = Ranges::get(&store.given[dimension], lane);
        let (value, step) = ball::bounds(&mut About { body, probe, centre }, dimension, radius, plan);
        Ranges::set(&mut store.outputs[0], lane, value);
        store.outputs[1..=dimension].iter_mut().for_each(|output| Ranges::set(output, lane, step));
    }
}
