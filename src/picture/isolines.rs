//! Lines of equal value through a field of samples, by marching squares. Draws nothing.
//!
//! A value equal to the level lies above it. Squares with an undefined corner have no line. A square whose opposite corners lie above
//! is decided by the mean of its corners, the same way for all levels, so that lines of different levels never cross.

use super::plot::Window;
use crate::interrupt::{Cancelled, Interrupt};
use crate::surface::sampler::{Counters, Sampler};
use crate::vm::Shape;
use rayon::prelude::*;
use rustc_hash::FxHashMap;

/// Samples of a function on a grid over a window: the first row lies along the lower edge, the ends of each row on the left and right
/// edges.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    /// The part of the plane.
    pub window: Window,
    /// Samples in a row.
    pub columns: usize,
    /// Rows.
    pub rows: usize,
    /// `columns * rows` values, NaN where undefined.
    pub values: Vec<f64>,
}

/// Values of the function at points of a row: the first two slices are their coordinates, the third takes one value for each.
pub type Function<'a> = dyn FnMut(&[f64], &[f64], &mut [f64]) + 'a;

/// A line of one level.
#[derive(Clone, Debug, PartialEq)]
pub struct Isoline {
    /// Points of the plane. A closed line does not repeat its first one.
    pub points: Vec<[f64; 2]>,
    /// Whether the last point is joined to the first; else both ends lie on the window's edge or beside undefined samples.
    pub closed: bool,
}

impl Field {
    /// Samples a function row by row.
    ///
    /// `columns` and `rows` are at least 2; fewer are taken as 2.
    #[must_use]
    pub fn sample(window: Window, columns: usize, rows: usize, f: &mut Function) -> Self {
        let mut field = Field::blank(window, columns, rows);
        let across: Vec<f64> = (0..field.columns).map(|i| field.place(i, 0)[0]).collect();
        let mut values = std::mem::take(&mut field.values);
        for (j, row) in values.chunks_exact_mut(field.columns).enumerate() {
            let up = vec![field.place(0, j)[1]; field.columns];
            f(&across, &up, row);
        }
        Field { values, ..field }
    }

    /// Samples a shape of two axes, rows in parallel; also tells what it cost.
    ///
    /// # Errors
    /// [`Cancelled`] soon after the interrupt was set.
    ///
    /// # Panics
    /// If the shape has another number of axes.
    pub fn of(
        shape: &Shape,
        window: Window,
        columns: usize,
        rows: usize,
        interrupt: &Interrupt,
    ) -> Result<(Self, Counters), Cancelled> {
        assert_eq!(shape.dimension, 2, "a field has two axes");
        let mut field = Field::blank(window, columns, rows);
        let across: Vec<f64> = (0..field.columns).map(|i| field.place(i, 0)[0]).collect();
        let mut values = std::mem::take(&mut field.values);
        let rows = values.par_chunks_exact_mut(field.columns).enumerate().map_init(
            || Sampler::new(shape).heeding(interrupt),
            |sampler, (j, row)| {
                interrupt.tick()?;
                let up = vec![field.place(0, j)[1]; row.len()];
                sampler.values(&shape.program, &[&across, &up], row);
                Ok(sampler.take_counters())
            },
        );
        let counts: Vec<Counters> = rows.collect::<Result<_, Cancelled>>()?;
        interrupt.tick()?;
        let mut counters = Counters::default();
        counts.into_iter().for_each(|row| counters.add(row));
        Ok((Field { values, ..field }, counters))
    }

    fn blank(window: Window, columns: usize, rows: usize) -> Self {
        let (columns, rows) = (columns.max(2), rows.max(2));
        Field { window, columns, rows, values: vec![f64::NAN; columns * rows] }
    }

    /// Where the sample in column `i` of row `j` lies.
    #[must_use]
    pub fn place(&self, i: usize, j: usize) -> [f64; 2] {
        let Window { lo, hi } = self.window;
        let part = |k: usize, of: usize| k as f64 / (of - 1) as f64;
        [lo[0] + (hi[0] - lo[0]) * part(i, self.columns), lo[1] + (hi[1] - lo[1]) * part(j, self.rows)]
    }

    /// The value at a point of the plane, linear between samples; NaN outside the window and beside undefined samples.
    #[must_use]
    pub fn value(&self, [x, y]: [f64; 2]) -> f64 {
        let Window { lo, hi } = self.window;
        let place = |v: f64, lo: f64, hi: f64, n: usize| {
            let at = (v - lo) / (hi - lo) * (n - 1) as f64;
            let low = (at.max(0.) as usize).min(n - 2);
            (low, at - low as f64)
        };
        if !(lo[0]..=hi[0]).contains(&x) || !(lo[1]..=hi[1]).contains(&y) {
            return f64::NAN;
        }
        let ((i, s), (j, t)) = (place(x, lo[0], hi[0], self.columns), place(y, lo[1], hi[1], self.rows));
        let at = |i: usize, j: usize| self.values[j * self.columns + i];
        let low = at(i, j) + s * (at(i + 1, j) - at(i, j));
        let high = at(i, j + 1) + s * (at(i + 1, j + 1) - at(i, j + 1));
        low + t * (high - low)
    }

    /// The smallest and the largest finite value, if there is one.
    #[must_use]
    pub fn range(&self) -> Option<[f64; 2]> {
        let finite = self.values.iter().copied().filter(|v| v.is_finite());
        let [lo, hi] = finite.fold([f64::INFINITY, f64::NEG_INFINITY], |[lo, hi], v| [lo.min(v), hi.max(v)]);
        (lo <= hi).then_some([lo, hi])
    }

    /// The range of values worth showing: all, unless the hundredth part at either end, where poles may put any number, makes it more
    /// than three times as wide.
    #[must_use]
    pub fn quiet_range(&self) -> Option<[f64; 2]> {
        let [lowest, highest] = self.range()?;
        let mut values: Vec<f64> = self.values.iter().copied().filter(|v| v.is_finite()).collect();
        let last = values.len() - 1;
        let mut at = |part: f64| *values.select_nth_unstable_by((part * last as f64) as usize, f64::total_cmp).1;
        let (lo, hi) = (at(0.01), at(0.99));
        Some(if highest - lowest <= 3. * (hi - lo) { [lowest, highest] } else { [lo, hi] })
    }

    /// All lines of a level, in the order of the rows.
    #[must_use]
    pub fn lines(&self, level: f64) -> Vec<Isoline> {
        let mut tracer = Tracer::new(self, level);
        let mut lines = Vec::new();
        // Open lines first, from their ends: begun in the middle one would come out in two parts.
        for ends_only in [true, false] {
            for piece in 0..tracer.pieces.len() {
                let from = tracer.pieces[piece];
                let start = if tracer.is_end(from[0]) { from[0] } else { from[1] };
                if !tracer.used[piece] && (!ends_only || tracer.is_end(start)) {
                    lines.push(tracer.follow(piece, start));
                }
            }
        }
        lines
    }
}

/// An edge of the grid by number: twice the sample at its lower or left end, plus 1 if it goes up.
type Edge = usize;

/// A sample and how it compares with the level.
struct Tracer<'a> {
    field: &'a Field,
    level: f64,
    pieces: Vec<[Edge; 2]>,
    used: Vec<bool>,
    /// The one or two pieces that end on an edge.
    at: FxHashMap<Edge, [usize; 2]>,
}

/// No piece.
const NONE: usize = usize::MAX;

impl<'a> Tracer<'a> {
    fn new(field: &'a Field, level: f64) -> Self {
        let mut tracer = Tracer { field, level, pieces: Vec::new(), used: Vec::new(), at: FxHashMap::default() };
        for j in 0..field.rows - 1 {
            for i in 0..field.columns - 1 {
                tracer.square(i, j);
            }
        }
        for (number, piece) in tracer.pieces.iter().enumerate() {
            for &edge in piece {
                let pair = tracer.at.entry(edge).or_insert([NONE; 2]);
                pair[usize::from(pair[0] != NONE)] = number;
            }
        }
        tracer.used = vec![false; tracer.pieces.len()];
        tracer
    }

    /// Adds the pieces of the square above and right of sample (i, j).
    fn square(&mut self, i: usize, j: usize) {
        let columns = self.field.columns;
        let first = j * columns + i;
        // Counter-clockwise from the lower left; edge k leads from corner k to the next one.
        let corners = [first, first + 1, first + columns + 1, first + columns].map(|k| self.field.values[k]);
        if corners.iter().any(|v| v.is_nan()) {
            return;
        }
        let edges = [2 * first, 2 * (first + 1) + 1, 2 * (first + columns), 2 * first + 1];
        let above = corners.map(|v| v >= self.level);
        let crossed: Vec<usize> = (0..4).filter(|&k| above[k] != above[(k + 1) % 4]).collect();
        match crossed.as_slice() {
            [a, b] => self.pieces.push([edges[*a], edges[*b]]),
            [_, _, _, _] => {
                // Each corner that differs from the middle is cut off: corner k lies between edges k - 1 and k.
                let mean = 0.25 * corners.iter().map(|v| v.clamp(-1e300, 1e300)).sum::<f64>();
                let middle = mean >= self.level;
                for k in (0..4).filter(|&k| above[k] != middle) {
                    self.pieces.push([edges[(k + 3) % 4], edges[k]]);
                }
            }
            _ => {}
        }
    }

    /// Whether only one piece comes to this edge.
    fn is_end(&self, edge: Edge) -> bool {
        self.at.get(&edge).is_some_and(|pair| pair[1] == NONE)
    }

    /// The line that begins with a piece, at one of its edges.
    fn follow(&mut self, mut piece: usize, start: Edge) -> Isoline {
        let mut points = vec![self.crossing(start)];
        let mut edge = start;
        loop {
            self.used[piece] = true;
            let [a, b] = self.pieces[piece];
            edge = if a == edge { b } else { a };
            if edge == start {
                return Isoline { points, closed: true };
            }
            points.push(self.crossing(edge));
            let pair = self.at.get(&edge).copied().unwrap_or([NONE; 2]);
            match pair.into_iter().find(|&next| next != NONE && !self.used[next]) {
                Some(next) => piece = next,
                None => return Isoline { points, closed: false },
            }
        }
    }

    /// Where the level lies on an edge, linear between its ends.
    fn crossing(&self, edge: Edge) -> [f64; 2] {
        let columns = self.field.columns;
        let (first, upward) = (edge / 2, edge % 2 == 1);
        let second = if upward { first + columns } else { first + 1 };
        let [a, b] = [first, second].map(|k| self.field.values[k].clamp(-1e300, 1e300));
        let part = if a == b { 0.5 } else { ((self.level - a) / (b - a)).clamp(0., 1.) };
        let [from, to] = [first, second].map(|k| self.field.place(k % columns, k / columns));
        std::array::from_fn(|d| from[d] + part * (to[d] - from[d]))
    }
}
