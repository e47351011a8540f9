//! One thread's means to evaluate a shape at points of its space: fills in the inputs that do not move, and counts what was evaluated.

use crate::interrupt::Interrupt;
use crate::number::Interval;
use crate::vm::block::Points;
use crate::vm::gradient::Gradients;
use crate::vm::region::Counts;
use crate::vm::{Precision, Program, Shape};

/// What a computation cost, and where the function was undefined.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Counters {
    /// Points at which the function was evaluated, root search and gradients included.
    pub points: u64,
    /// Boxes over which it was bounded.
    pub boxes: u64,
    /// Points among [`Counters::points`] where it was undefined (NaN), which count as outside.
    pub undefined: u64,
    /// One of those: as many coordinates as the space has.
    pub example: Option<Vec<f64>>,
    /// What loops that run at each point and searches for highest values took.
    pub regions: Counts,
}

impl Counters {
    /// Adds what another part of the work cost; the example of the earlier part stays.
    pub fn add(&mut self, other: Self) {
        self.points += other.points;
        self.boxes += other.boxes;
        self.undefined += other.undefined;
        self.regions = self.regions.plus(other.regions);
        if self.example.is_none() {
            self.example = other.example;
        }
    }

    fn count(&mut self, at: &[&[f64]], values: &[f64]) {
        self.count_where(values, |i| at.iter().map(|axis| axis[i]).collect());
    }

    fn count_on_lattice(&mut self, axes: &[&[f64]], values: &[f64]) {
        self.count_where(values, |mut i| {
            let step = |axis: &&[f64]| {
                let number = axis[i % axis.len()];
                i /= axis.len();
                number
            };
            axes.iter().map(step).collect()
        });
    }

    fn count_where(&mut self, values: &[f64], point: impl FnOnce(usize) -> Vec<f64>) {
        self.points += values.len() as u64;
        let undefined = values.iter().filter(|v| v.is_nan()).count();
        if undefined > 0 {
            self.undefined += undefined as u64;
            if self.example.is_none() {
                self.example = values.iter().position(|v| v.is_nan()).map(point);
            }
        }
    }
}

/// Operations times points that are done before anything else is: some hundredths of a second.
const LONG: usize = 50_000_000;

/// Evaluates programs of one [`Shape`] (its own and those specialised from it) at points of the space. Allocates only while it warms up.
pub struct Sampler {
    dimension: usize,
    fixed: Vec<(f64, Vec<f64>)>,
    points: Points<f64>,
    single: Option<Box<Single>>,
    gradients: Gradients,
    counters: Counters,
    interrupt: Interrupt,
}

/// What single precision needs: the evaluator, and the points as singles.
#[derive(Default)]
struct Single {
    points: Points<f32>,
    columns: Vec<Vec<f32>>,
    values: Vec<f32>,
}

impl Single {
    fn values(&mut self, program: &Program, at: &[&[f64]], out: &mut [f64]) {
        self.with(at, out, |points, slices, values| points.eval(program, slices, values));
    }

    fn lattice(&mut self, program: &Program, axes: &[&[f64]], out: &mut [f64]) {
        self.with(axes, out, |points, slices, values| points.lattice(program, slices, values));
    }

    /// Hands on columns and values as singles.
    fn with(&mut self, at: &[&[f64]], out: &mut [f64], eval: impl FnOnce(&mut Points<f32>, &[&[f32]], &mut [f32])) {
        self.columns.resize_with(at.len(), Vec::new);
        for (column, axis) in self.columns.iter_mut().zip(at) {
            column.clear();
            column.extend(axis.iter().map(|&c| c as f32));
        }
        self.values.clear();
        self.values.resize(out.len(), 0.0);
        let mut slices = [&[][..]; 16];
        slices.iter_mut().zip(&self.columns).for_each(|(slice, column)| *slice = column);
        eval(&mut self.points, &slices[..at.len()], &mut self.values);
        out.iter_mut().zip(&self.values).for_each(|(out, &value)| *out = f64::from(value));
    }
}

/// Points handed to a program at once: so few operations in all that a request to stop is heard within some hundredths of a second.
fn at_once(program: &Program) -> usize {
    match program {
        slow if slow.has_searches() => 16,
        long if long.has_regions() || long.len() > 50_000 => 128,
        _ => 1024,
    }
}

impl Sampler {
    /// A sampler for the programs of `shape`.
    #[must_use]
    pub fn new(shape: &Shape) -> Self {
        Self {
            interrupt: Interrupt::default(),
            dimension: shape.dimension,
            fixed: shape.fixed.iter().map(|&value| (value, Vec::new())).collect(),
            points: Points::new(),
            single: (shape.precision == Precision::Single).then(Box::default),
            gradients: Gradients::new(),
            counters: Counters::default(),
        }
    }

    /// The same, but once the interrupt is set it evaluates no more: everything is undefined then, and whoever asked must look at the
    /// interrupt before the values are used.
    #[must_use]
    pub fn heeding(self, interrupt: &Interrupt) -> Self {
        let single = |_| Box::new(Single { points: Points::heeding(interrupt), ..Single::default() });
        Self {
            points: Points::heeding(interrupt),
            single: self.single.map(single),
            gradients: Gradients::heeding(interrupt),
            interrupt: interrupt.clone(),
            ..self
        }
    }

    /// Coordinates of the space.
    #[must_use]
    pub fn dimension(&self) -> usize {
        self.dimension
    }

    /// How well coordinates are told apart, relative to their size.
    #[must_use]
    pub fn epsilon(&self) -> f64 {
        if self.single.is_some() { f64::from(f32::EPSILON) } else { f64::EPSILON }
    }

    /// The values at points: one slice of equal length per coordinate of the space, and `out` as long.
    ///
    /// # Panics
    /// If the lengths differ.
    pub fn values(&mut self, program: &Program, at: &[&[f64]], out: &mut [f64]) {
        let step = at_once(program);
        for (i, out) in out.chunks_mut(step).enumerate() {
            let (at, count) = part(at, i * step, out.len());
            if self.interrupt.is_cancelled() {
                out.fill(f64::NAN);
                continue;
            }
            let mut slices = [&[][..]; 16];
            let slices = inputs(&mut self.fixed, &at[..self.dimension], count, &mut slices);
            match &mut self.single {
                Some(single) => single.values(program, slices, out),
                None => self.points.eval(program, slices, out),
            }
            self.counters.count(&at[..self.dimension], out);
        }
    }

    /// The values on a lattice: the numbers on each axis of the space, and `out` as long as their product, the first axis fastest. The
    /// same bits as [`Sampler::values`] at its points, in less time.
    ///
    /// # Panics
    /// If the lengths differ.
    pub fn lattice(&mut self, program: &Program, axes: &[&[f64]], out: &mut [f64]) {
        let axes = &axes[..self.dimension];
        if program.has_regions() || program.len().saturating_mul(out.len()) > LONG {
            self.expanded(program, axes, out);
        } else if self.interrupt.is_cancelled() {
            out.fill(f64::NAN);
        } else {
            let mut slices = [&[][..]; 16];
            let slices = inputs(&mut self.fixed, axes, 1, &mut slices);
            // The axes keep their own lengths; only what is fixed is one number long.
            match &mut self.single {
                Some(single) => single.lattice(program, slices, out),
                None => self.points.lattice(program, slices, out),
            }
            self.counters.count_on_lattice(axes, out);
        }
    }

    /// The same by way of all points, where a request to stop must be heard in between.
    fn expanded(&mut self, program: &Program, axes: &[&[f64]], out: &mut [f64]) {
        let columns: Vec<Vec<f64>> = (0..axes.len())
            .map(|axis| {
                let run: usize = axes[..axis].iter().map(|axis| axis.len()).product();
                (0..out.len()).map(|i| axes[axis][i / run % axes[axis].len()]).collect()
            })
            .collect();
        let columns: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
        self.values(program, &columns, out);
    }

    /// The values and, by each coordinate of the space, the slopes at points.
    ///
    /// # Panics
    /// If the lengths differ.
    pub fn slopes(&mut self, program: &Program, at: &[&[f64]], out: &mut [f64], slopes: &mut [&mut [f64]]) {
        let step = at_once(program);
        for (i, out) in out.chunks_mut(step).enumerate() {
            let (at, count) = part(at, i * step, out.len());
            if self.interrupt.is_cancelled() {
                out.fill(f64::NAN);
                continue;
            }
            let mut slices = [&[][..]; 16];
            let slices = inputs(&mut self.fixed, &at[..self.dimension], count, &mut slices);
            let mut rest = slopes.iter_mut().map(|slope| &mut slope[i * step..i * step + count]);
            let mut parts: [&mut [f64]; 3] = std::array::from_fn(|_| rest.next().unwrap_or_default());
            let by = &[0, 1, 2][..self.dimension];
            self.gradients.eval(program, slices, by, out, &mut parts[..self.dimension]);
            self.counters.count(&at[..self.dimension], out);
        }
    }

    /// What was counted since the last call.
    pub fn take_counters(&mut self) -> Counters {
        let regions = self.points.take_counts().plus(self.gradients.take_counts());
        Counters { regions, ..std::mem::take(&mut self.counters) }
    }
}

/// The coordinates of `count` points from `start` on, and that count; at most three coordinates.
fn part<'a>(at: &[&'a [f64]], start: usize, count: usize) -> ([&'a [f64]; 3], usize) {
    let mut slices = at.iter().map(|axis| &axis[start..start + count]);
    (std::array::from_fn(|_| slices.next().unwrap_or_default()), count)
}

/// The slices of all inputs of a program: the moving ones from `at`, the fixed ones as constant columns of length `count`.
fn inputs<'s, 'a: 's>(
    fixed: &'a mut [(f64, Vec<f64>)],
    at: &[&'a [f64]],
    count: usize,
    slices: &'s mut [&'a [f64]; 16],
) -> &'s [&'a [f64]] {
    let total = at.len() + fixed.len();
    slices[..at.len()].copy_from_slice(at);
    for (slice, (value, column)) in slices[at.len()..].iter_mut().zip(fixed) {
        if column.len() < count {
            column.resize(count, *value);
        }
        *slice = &column[..count];
    }
    &slices[..total]
}

/// The interval from the smaller to the larger of two coordinates that bound a box of sample points.
#[must_use]
pub fn span(a: f64, b: f64) -> Interval {
    Interval::new(a.min(b), a.max(b))
}
