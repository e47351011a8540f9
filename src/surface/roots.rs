//! The vertex on a crossed edge: a bracketed root search, many edges at a time, that needs no slope and always ends.
//!
//! The bracket goes by inside and outside alone, so it holds at creases, steps, poles and where the function is undefined on the outside.
//! Estimates are those of Anderson and Bjorck; they are projected around the bracket's middle as in the ITP method of Oliveira and
//! Takahashi (2020), so that no search takes more than a few steps longer than bisection.

use super::grid::LEAF;
use super::guess;
use super::sampler::Sampler;
use crate::vm::Program;

/// Accuracy of a root, as a part of its edge (as far as doubles resolve the coordinate).
const TOLERANCE: f64 = 1e-9;

/// Steps of bisection that reach [`TOLERANCE`], and how many more an estimate may cost.
const STEPS: i32 = 30 + 6;

/// The part of the step before it that a step is at most where the function is smooth and the root is near.
const SUDDEN: f64 = 1e-2;

/// Least distance of a vertex from the ends of its edge, as a part of the edge. Without it exact zeros at sample points would give
/// triangles without extent.
const MARGIN: f64 = 1e-6;

/// The same in single-precision units of the coordinate, so that vertices stay apart when STL rounds them.
const MARGIN_UNITS: f64 = 8.0;

/// The crossed edges of a brick: each between two neighbouring sample points, one inside (`>= 0`), the other outside (`< 0` or undefined).
#[derive(Debug, Default)]
pub struct Edges {
    /// The indices of the starts within the brick: x, y and z, four bits each, axis by axis of the edges.
    places: Vec<u16>,
    /// Edges along each axis and those before it.
    upto: [usize; 3],
    /// The coordinates of the starts.
    starts: [Vec<f64>; 3],
    /// The coordinates of the other ends along the axes of the edges.
    ends: Vec<f64>,
    /// The function's values at the sample points at -1, 0, 1 and 2, when t runs from 0 to 1 on the edge; not finite where unknown.
    values: [Vec<f64>; 4],
    /// How far apart a root and its estimate may be.
    tolerances: Vec<f64>,
    /// Least distances of a vertex from both ends.
    margins: Vec<f64>,
}

/// The values at the points of a brick.
#[derive(Clone, Copy)]
pub struct Samples<'a> {
    /// The numbers on each axis.
    pub axes: &'a [Vec<f64>; 3],
    /// The values, the first axis fastest.
    pub values: &'a [f64],
    /// Relative to their size, how well coordinates are told apart.
    pub epsilon: f64,
}

impl Edges {
    /// No edge.
    pub fn clear(&mut self) {
        self.places.clear();
        self.upto = [0; 3];
    }

    /// Adds an edge along an axis no smaller than those before, from the point with those indices in its brick.
    #[inline(always)]
    pub fn push(&mut self, axis: usize, [x, y, z]: [usize; 3]) {
        self.places.push((x | y << 4 | z << 8) as u16);
        self.upto[axis] = self.places.len();
    }

    /// Takes the coordinates and the values of all edges from those of the brick.
    pub fn load(&mut self, samples: Samples<'_>) {
        for axis in 1..3 {
            self.upto[axis] = self.upto[axis].max(self.upto[axis - 1]);
        }
        let count = self.places.len();
        let Self { starts, ends, values, tolerances, margins, .. } = self;
        let columns = starts.iter_mut().chain(values).chain([ends, tolerances, margins]);
        columns.for_each(|column| column.resize(count, 0.0));
        for axis in 0..3 {
            self.load_axis(samples, axis);
        }
    }

    fn load_axis(&mut self, Samples { axes, values, epsilon }: Samples<'_>, axis: usize) {
        let sides: [usize; 3] = std::array::from_fn(|d| axes[d].len());
        let stride = [1, sides[0], sides[0] * sides[1]];
        let step = stride[axis];
        let mut limits = [[0.0; 2]; LEAF];
        for (limits, ends) in limits.iter_mut().zip(axes[axis].windows(2)) {
            *limits = tolerance_and_margin(ends[0], ends[1], epsilon);
        }
        let from = if axis == 0 { 0 } else { self.upto[axis - 1] };
        for k in from..self.upto[axis] {
            let place = usize::from(self.places[k]);
            let at = [place & 15, place >> 4 & 15, place >> 8];
            for d in 0..3 {
                self.starts[d][k] = axes[d][at[d]];
            }
            let (here, along) = (at[0] + at[1] * stride[1] + at[2] * stride[2], at[axis]);
            self.ends[k] = axes[axis][along + 1];
            self.values[0][k] = if along > 0 { values[here - step] } else { f64::NAN };
            self.values[1][k] = values[here];
            self.values[2][k] = values[here + step];
            self.values[3][k] = if along + 2 < sides[axis] { values[here + 2 * step] } else { f64::NAN };
            [self.tolerances[k], self.margins[k]] = limits[along];
        }
    }

    /// The axes, and which edges run along each.
    fn ranges(&self) -> impl Iterator<Item = (usize, std::ops::Range<usize>)> + use<> {
        let [x, y, z] = self.upto;
        [0..x, x..y, y..z].into_iter().enumerate()
    }

    /// The coordinates of a place on each edge, by axis.
    pub fn columns(&self, along: &[f64], columns: &mut [Vec<f64>; 3]) {
        for (column, starts) in columns.iter_mut().zip(&self.starts) {
            column.clear();
            column.extend_from_slice(starts);
        }
        for (axis, range) in self.ranges() {
            columns[axis][range.clone()].copy_from_slice(&along[range]);
        }
    }
}

/// How far a root on an edge with these ends and its estimate may be apart, and how near a vertex may be to the ends, both as parts of the
/// edge.
fn tolerance_and_margin(lo: f64, hi: f64, epsilon: f64) -> [f64; 2] {
    let (largest, length) = (lo.abs().max(hi.abs()), hi - lo);
    let smallest = f64::from(f32::from_bits(1));
    let unit = (largest * f64::from(f32::EPSILON)).max(smallest);
    [(4.0 * epsilon * largest / length).max(TOLERANCE), (MARGIN_UNITS * unit / length).clamp(MARGIN, 0.25)]
}

/// The bracket of one edge; t runs from 0 at the start to 1 at the end.
#[derive(Clone, Copy, Debug)]
struct Search {
    edge: u32,
    inside: f64,
    outside: f64,
    f_inside: f64,
    f_outside: f64,
    tolerance: f64,
    at: f64,
    last: (f64, f64),
}

/// The coordinates of points to evaluate, by axis, and the values there.
#[derive(Debug, Default)]
struct Asked {
    columns: [Vec<f64>; 3],
    values: Vec<f64>,
}

/// Whom to ask for values: the sampler, the program, and how many coordinates its space has.
pub struct Source<'a> {
    /// Evaluates.
    pub sampler: &'a mut Sampler,
    /// What is evaluated.
    pub program: &'a Program,
    /// Coordinates of the space.
    pub dimension: usize,
}

/// Scratch of the search.
#[derive(Debug, Default)]
pub struct Roots {
    searches: Vec<Search>,
    chosen: Vec<u32>,
    /// Where each edge was evaluated first and second, the place that is taken, and that which polynomials propose for it.
    places: [Vec<f64>; 4],
    values: [Vec<f64>; 2],
    found: Vec<bool>,
    asked: Asked,
}

impl Roots {
    /// Finds the boundary on each edge and appends its coordinate along the edge's axis to `out`, in order.
    pub fn solve(&mut self, edges: &Edges, source: &mut Source<'_>, out: &mut Vec<f64>) {
        let count = edges.ends.len();
        self.places.iter_mut().chain(&mut self.values).for_each(|column| column.resize(count, f64::NAN));
        self.found.resize(count, false);
        self.guess(edges, source);
        if !self.chosen.is_empty() {
            self.search(edges, source);
        }
        let (places, margins) = (&self.places[2][..count], &edges.margins[..count]);
        for (axis, range) in edges.ranges() {
            let ends = edges.starts[axis][range.clone()].iter().zip(&edges.ends[range.clone()]);
            let places = places[range.clone()].iter().zip(&margins[range]);
            // A vertex keeps off both ends.
            let vertex = |(t, margin): (&f64, &f64)| t.clamp(*margin, 1.0 - *margin);
            out.extend(ends.zip(places.map(vertex)).map(|((&lo, &hi), t)| point(lo, hi, t)));
        }
    }

    /// Two values on each edge at most, where polynomials say that the boundary is: enough where the function is smooth.
    fn guess(&mut self, edges: &Edges, source: &mut Source<'_>) {
        let count = edges.ends.len();
        let ([one, two, taken, third], [value, last]) = (&mut self.places, &mut self.values);
        guess::first(&edges.values, one);
        value.copy_from_slice(self.asked.ask_all(edges, one, source));
        guess::second(&edges.values, [one, value], two, &mut self.found);
        let found = &self.found;
        self.chosen.clear();
        self.chosen.extend((0..count as u32).filter(|&i| !found[i as usize]));
        taken.copy_from_slice(two);
        if self.chosen.is_empty() {
            return;
        }
        last.fill(f64::NAN);
        let values = self.asked.ask(edges, &self.chosen, two, source);
        self.chosen.iter().zip(values).for_each(|(&i, &value)| last[i as usize] = value);
        guess::third(&edges.values, [one, value], [two, last], &edges.tolerances, third, &mut self.found);
        self.chosen.iter().for_each(|&i| taken[i as usize] = third[i as usize]);
        let found = &self.found;
        self.chosen.retain(|&i| !found[i as usize]);
    }

    /// The bracketed search for all edges that are still chosen.
    fn search(&mut self, edges: &Edges, source: &mut Source<'_>) {
        self.searches.clear();
        for &edge in &self.chosen {
            let i = edge as usize;
            let mut search = Search::new(edge, [edges.values[1][i], edges.values[2][i]], edges.tolerances[i]);
            for (places, values) in self.places.iter().zip(&self.values) {
                search.narrow(places[i], values[i]);
            }
            self.searches.push(search);
        }
        let place = &mut self.places[2];
        for step in 0..=STEPS {
            if self.searches.is_empty() {
                break;
            }
            let reach = f64::from(STEPS - step).exp2();
            for search in &mut self.searches {
                place[search.edge as usize] = search.estimate(reach);
            }
            let mut values = self.asked.ask(edges, &self.chosen, place, source).iter();
            self.searches.retain_mut(|search| {
                let done = values.next().is_some_and(|&value| search.learn(value));
                place[search.edge as usize] = search.at;
                !done
            });
            self.chosen.clear();
            self.chosen.extend(self.searches.iter().map(|search| search.edge));
        }
    }
}

impl Asked {
    /// The values at a place on each edge.
    fn ask_all(&mut self, edges: &Edges, places: &[f64], source: &mut Source<'_>) -> &[f64] {
        for (column, starts) in self.columns.iter_mut().zip(&edges.starts) {
            column.clear();
            column.extend_from_slice(starts);
        }
        for (axis, range) in edges.ranges() {
            let ends = self.columns[axis][range.clone()].iter_mut().zip(&edges.ends[range.clone()]);
            ends.zip(&places[range]).for_each(|((lo, &hi), &t)| *lo = point(*lo, hi, t));
        }
        self.evaluate(source)
    }

    /// The values at the places on the chosen edges, whose numbers ascend.
    fn ask(&mut self, edges: &Edges, chosen: &[u32], places: &[f64], source: &mut Source<'_>) -> &[f64] {
        for (column, starts) in self.columns.iter_mut().zip(&edges.starts) {
            column.clear();
            column.extend(chosen.iter().map(|&i| starts[i as usize]));
        }
        let mut from = 0;
        for (axis, range) in edges.ranges() {
            let upto = chosen.partition_point(|&i| (i as usize) < range.end);
            for (lo, &i) in self.columns[axis][from..upto].iter_mut().zip(&chosen[from..upto]) {
                *lo = point(*lo, edges.ends[i as usize], places[i as usize]);
            }
            from = upto;
        }
        self.evaluate(source)
    }

    fn evaluate(&mut self, Source { sampler, program, dimension }: &mut Source<'_>) -> &[f64] {
        let [x, y, z] = &self.columns;
        self.values.resize(x.len(), 0.0);
        sampler.values(program, &[&x[..], y, z][..*dimension], &mut self.values);
        &self.values
    }
}

/// The coordinate at `t` between two ends, never beyond them.
#[inline(always)]
fn point(lo: f64, hi: f64, t: f64) -> f64 {
    (lo + t * (hi - lo)).clamp(lo, hi)
}

impl Search {
    fn new(edge: u32, [first, second]: [f64; 2], tolerance: f64) -> Self {
        let (inside, outside) = if first >= 0.0 { (0.0, 1.0) } else { (1.0, 0.0) };
        let (f_inside, f_outside) = if first >= 0.0 { (first, second) } else { (second, first) };
        Self { edge, inside, outside, f_inside, f_outside, tolerance, at: 0.5, last: (outside, f_outside) }
    }

    /// Takes a value that is known already.
    fn narrow(&mut self, t: f64, value: f64) {
        if value >= 0.0 {
            (self.inside, self.f_inside) = (t, value);
        } else {
            (self.outside, self.f_outside) = (t, value);
        }
        self.last = (t, value);
    }

    /// The next place to evaluate; `reach` times half the tolerance is how far from the middle it may be, half the bracket included.
    fn estimate(&mut self, reach: f64) -> f64 {
        let width = self.outside - self.inside;
        let middle = self.inside + 0.5 * width;
        let part = self.f_inside / (self.f_inside - self.f_outside);
        self.at = middle;
        if part.is_finite() {
            // Off the ends: an exact zero at the inside one says nothing new, but the place right beside it closes the bracket.
            let estimate = self.inside + width * part.clamp(1e-3, 1.0 - 1e-3);
            let reach = (0.5 * self.tolerance * reach - 0.5 * width.abs()).max(0.0);
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
        // On a smooth function the error behind this step is about the product of the last two.
        let is_near = shift.abs() <= self.tolerance
            || (shift.abs() <= SUDDEN * (t - t_last).abs() && (shift * (t - t_last)).abs() <= 0.25 * self.tolerance);
        if value != 0.0 && is_near && (better - self.inside) * (better - self.outside) <= 0.0 {
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
