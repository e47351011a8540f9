//! The vertex on a crossed edge: a bracketed root search, many edges at a time, that needs no slope and always ends.
//!
//! The bracket goes by inside and outside alone, so it holds at creases, steps, poles and where the function is undefined on the outside.
//! Estimates are those of Anderson and Bjorck; they are projected around the bracket's middle as in the ITP method of Oliveira and
//! Takahashi (2020), so that no search takes more than a few steps longer than bisection.

use super::sampler::Sampler;
use crate::vm::Program;

/// Accuracy of a root, as a part of its edge (as far as doubles resolve the coordinate).
const TOLERANCE: f64 = 1e-9;

/// Steps of bisection that reach [`TOLERANCE`], and how many more an estimate may cost.
const STEPS: i32 = 30 + 6;

/// Least distance of a vertex from the ends of its edge, as a part of the edge. Without it exact zeros at sample points would give
/// triangles without extent.
const MARGIN: f64 = 1e-6;

/// The same in single-precision units of the coordinate, so that vertices stay apart when STL rounds them.
const MARGIN_UNITS: f64 = 8.0;

/// An edge between two neighbouring sample points, one inside and one outside.
#[derive(Clone, Copy, Debug)]
pub struct Crossing {
    /// The sample point with the smaller coordinate.
    pub start: [f64; 3],
    /// The axis along which the edge runs.
    pub axis: usize,
    /// The coordinate of its other end along that axis.
    pub end: f64,
    /// The function's values at both ends; one is inside (`>= 0`), the other outside (`< 0` or undefined).
    pub values: [f64; 2],
}

/// The bracket of one edge; t runs from 0 at the start to 1 at the end.
#[derive(Clone, Copy, Debug)]
struct Search {
    inside: f64,
    outside: f64,
    f_inside: f64,
    f_outside: f64,
    tolerance: f64,
    at: f64,
    last: (f64, f64),
}

/// Scratch of the search.
#[derive(Debug, Default)]
pub struct Roots {
    searches: Vec<Search>,
    active: Vec<usize>,
    columns: [Vec<f64>; 3],
    values: Vec<f64>,
}

impl Roots {
    /// Finds the boundary on each edge and appends it to `out`, in order. The program's space has `dimension` coordinates.
    pub fn solve(
        &mut self,
        crossings: &[Crossing],
        dimension: usize,
        program: &Program,
        sampler: &mut Sampler,
        out: &mut Vec<[f64; 3]>,
    ) {
        self.searches.clear();
        let epsilon = sampler.epsilon();
        self.searches.extend(crossings.iter().map(|crossing| Search::new(crossing, epsilon)));
        self.active.clear();
        self.active.extend(0..crossings.len());
        for step in 0..=STEPS {
            if self.active.is_empty() {
                break;
            }
            self.columns.iter_mut().for_each(Vec::clear);
            for &i in &self.active {
                let t = self.searches[i].estimate(step);
                let at = crossings[i].point(t);
                self.columns.iter_mut().zip(at).for_each(|(column, c)| column.push(c));
            }
            self.values.clear();
            self.values.resize(self.active.len(), 0.0);
            let [x, y, z] = &self.columns;
            sampler.values(program, &[&x[..], y, z][..dimension], &mut self.values);
            let (searches, mut values) = (&mut self.searches, self.values.iter());
            self.active.retain(|&i| values.next().is_some_and(|&value| !searches[i].learn(value)));
        }
        out.extend(crossings.iter().zip(&self.searches).map(|(crossing, search)| crossing.vertex(search.at)));
    }
}

impl Crossing {
    /// The point at `t`, never beyond the ends.
    fn point(&self, t: f64) -> [f64; 3] {
        let mut at = self.start;
        at[self.axis] = (at[self.axis] + t * (self.end - at[self.axis])).clamp(at[self.axis], self.end);
        at
    }

    /// The point at `t`, kept off both ends.
    fn vertex(&self, t: f64) -> [f64; 3] {
        let (lo, hi) = (self.start[self.axis], self.end);
        let smallest = f64::from(f32::from_bits(1));
        let unit = (lo.abs().max(hi.abs()) * f64::from(f32::EPSILON)).max(smallest);
        let margin = (MARGIN_UNITS * unit / (hi - lo)).clamp(MARGIN, 0.25);
        self.point(t.clamp(margin, 1.0 - margin))
    }
}

impl Search {
    fn new(crossing: &Crossing, epsilon: f64) -> Self {
        let [first, second] = crossing.values;
        let (lo, hi) = (crossing.start[crossing.axis], crossing.end);
        let resolved = 4.0 * epsilon * lo.abs().max(hi.abs()) / (hi - lo);
        let (inside, outside) = if first >= 0.0 { (0.0, 1.0) } else { (1.0, 0.0) };
        let (f_inside, f_outside) = if first >= 0.0 { (first, second) } else { (second, first) };
        let tolerance = resolved.max(TOLERANCE);
        Self { inside, outside, f_inside, f_outside, tolerance, at: 0.5, last: (outside, f_outside) }
    }

    /// The next place to evaluate.
    fn estimate(&mut self, step: i32) -> f64 {
        let width = self.outside - self.inside;
        let middle = self.inside + 0.5 * width;
        let part = self.f_inside / (self.f_inside - self.f_outside);
        self.at = middle;
        if part.is_finite() {
            // Off the ends: an exact zero at the inside one says nothing new, but the place right beside it closes the bracket.
            let estimate = self.inside + width * part.clamp(1e-3, 1.0 - 1e-3);
            let reach = (0.5 * self.tolerance * f64::from(STEPS - step).exp2() - 0.5 * width.abs()).max(0.0);
            self.at = estimate.clamp(middle - reach, middle + reach);
        }
        self.at
    }

    /// Takes the value at the last estimate; true when the root is known (it then is `at`).
    fn learn(&mut self, value: f64) -> bool {
        let (t, (t_last, f_last)) = (self.at, self.last);
        self.last = (t, value);
        if value >= 0.0 {
            // Anderson and Bjorck: the side that stays loses weight, as much as the other has gained.
            if f_last >= 0.0 {
                self.f_outside *= weight(value, self.f_inside);
            }
            (self.inside, self.f_inside) = (t, value);
        } else {
            if f_last < 0.0 {
                self.f_inside *= weight(value, self.f_outside);
            }
            (self.outside, self.f_outside) = (t, value);
        }
        if (self.outside - self.inside).abs() <= self.tolerance {
            self.at = 0.5 * (self.inside + self.outside);
            return true;
        }
        // The line through the last two points; a value of exactly 0 may be part of a plateau that goes on, so it proves nothing.
        let shift = value * (t - t_last) / (value - f_last);
        let better = t - shift;
        if value != 0.0 && shift.abs() <= self.tolerance && (better - self.inside) * (better - self.outside) <= 0.0 {
            self.at = better;
            return true;
        }
        false
    }
}

fn weight(value: f64, replaced: f64) -> f64 {
    let weight = 1.0 - value / replaced;
    if weight > 0.0 { weight } else { 0.5 }
}
