//! The highest value of a function in a closed ball of two or more dimensions, and bounds of it.
//!
//! A search from the best of many starts: from where it is, it looks along the gradient and in many directions, at two distances, and
//! goes on with the highest; where there is none it looks nearer by, until the gradient says that it is on top. What lies beyond the
//! ball is drawn to its boundary. Ranges over parts of the ball tell which starts cannot win.

use super::AT_ONCE;
use crate::number::{Binary, Interval};

/// What the search asks of a function of several variables, about the centre of the ball.
pub trait Ball {
    /// Values at these steps from the centre, one slice per variable, of at most 2 [`AT_ONCE`] numbers.
    fn values(&mut self, steps: &[Vec<f64>], values: &mut [f64]);
    /// Ranges of the values over these steps, one slice per variable, of at most [`AT_ONCE`] intervals.
    fn ranges(&mut self, steps: &[Vec<Interval>], values: &mut [Interval]);
    /// The gradient at a step from the centre, for as many variables as there are, at most [`GRADIENT`].
    fn gradient(&mut self, step: &[f64]) -> [f64; GRADIENT];
}

/// Variables at most for which the search asks for gradients.
pub const GRADIENT: usize = 3;

/// Starts from which the search goes on.
const CLIMBS: usize = 3;
/// Parts of the radius by which they lie apart, so that one hill is not climbed twice.
const APART: f64 = 0.9;
/// Looks of one climb at most.
const LOOKS: usize = 200;
/// Parts of the radius at which a climb ends.
const NEAREST: f64 = 1e-9;
/// Distances along the gradient to look at, in parts of the radius; the last one leads to where the boundary faces the gradient.
const STRIDES: [f64; 7] = [0.01, 0.05, 0.2, 0.5, 1.0, 3.0, 1e6];
/// Parts of the gradient that may be left along the boundary where a climb is on top; the value is known to the square of it.
const LEVEL: f64 = 1e-8;

/// Where to look in a ball of so many dimensions: made once, used for each ball.
#[derive(Clone, Debug)]
pub struct Plan {
    /// At most [`AT_ONCE`] unit vectors.
    directions: Vec<Vec<f64>>,
    /// The same, one column per variable.
    axes: Vec<Vec<f64>>,
    /// Cells of the unit ball, at most [`AT_ONCE`], one column per variable.
    cells: Vec<Vec<Interval>>,
}

impl Plan {
    /// The plan for balls of a dimension.
    #[must_use]
    pub fn new(dimension: usize) -> Self {
        let mut cut = 1_usize;
        while (cut + 1).saturating_pow(u32::try_from(dimension).unwrap_or(u32::MAX)) <= AT_ONCE {
            cut += 1;
        }
        let cells = pieces(&vec![Interval::new(-1.0, 1.0); dimension], cut);
        let cells: Vec<_> = cells.into_iter().filter(|cell| touches(cell, 1.0)).collect();
        let column = |axis: usize| cells.iter().map(|cell| cell[axis]).collect();
        let directions = directions(dimension);
        let axes = (0..dimension).map(|axis| directions.iter().map(|d| d[axis]).collect()).collect();
        Self { directions, axes, cells: (0..dimension).map(column).collect() }
    }
}

/// Directions to look in: at most [`AT_ONCE`] unit vectors, evenly spread in two and three dimensions.
fn directions(dimension: usize) -> Vec<Vec<f64>> {
    let mut all: Vec<Vec<f64>> = Vec::new();
    let unit = |v: Vec<f64>| {
        let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
        v.into_iter().map(|x| x / length).collect::<Vec<f64>>()
    };
    if dimension <= 3 {
        // The faces, edges and corners of a cube; in the plane also what lies between.
        let steps: &[f64] = if dimension == 2 { &[-2.0, -1.0, 0.0, 1.0, 2.0] } else { &[-1.0, 0.0, 1.0] };
        let count = steps.len().pow(u32::try_from(dimension).unwrap_or(3));
        for i in 0..count {
            let v: Vec<f64> = (0..dimension)
                .map(|k| steps[i / steps.len().pow(u32::try_from(k).unwrap_or(0)) % steps.len()])
                .collect();
            let rim = v.iter().any(|x| x.abs() == steps[steps.len() - 1]);
            if rim {
                all.push(unit(v));
            }
        }
        return all;
    }
    for k in 0..dimension {
        for sign in [1.0, -1.0] {
            all.push((0..dimension).map(|i| if i == k { sign } else { 0.0 }).collect());
        }
    }
    // The rest is scattered, the same every time, each with its opposite.
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    let mut next = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        #[allow(clippy::cast_precision_loss)]
        let value = (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0;
        value
    };
    while all.len() + 2 <= AT_ONCE - 2 {
        let v = unit((0..dimension).map(|_| next()).collect());
        all.push(v.iter().map(|x| -x).collect());
        all.push(v);
    }
    all
}

/// Places to be asked about: one column per variable.
struct Places {
    columns: Vec<Vec<f64>>,
    values: Vec<f64>,
}

impl Places {
    fn new(dimension: usize) -> Self {
        Self { columns: vec![Vec::new(); dimension], values: Vec::new() }
    }

    fn clear(&mut self) {
        self.columns.iter_mut().for_each(Vec::clear);
    }

    /// Adds the step `from + scale * direction` for each of the directions, which are given one column per variable.
    fn add<D: AsRef<[f64]>>(&mut self, from: &[f64], scale: f64, directions: &[D]) {
        for ((column, from), d) in self.columns.iter_mut().zip(from).zip(directions) {
            column.extend(d.as_ref().iter().map(|d| from + scale * d));
        }
    }

    /// Draws to the boundary what leads out of the ball.
    fn draw(&mut self, radius: f64) {
        let shrink = &mut self.values;
        shrink.clear();
        shrink.resize(self.columns.first().map_or(0, Vec::len), 0.0);
        for column in &self.columns {
            shrink.iter_mut().zip(column).for_each(|(sum, x)| *sum += x * x);
        }
        shrink.iter_mut().for_each(|s| *s = if *s > radius * radius { radius / s.sqrt() } else { 1.0 });
        for column in &mut self.columns {
            column.iter_mut().zip(&*shrink).for_each(|(x, s)| *x *= s);
        }
    }

    fn get(&self, i: usize) -> Vec<f64> {
        self.columns.iter().map(|column| column[i]).collect()
    }

    fn ask<B: Ball + ?Sized>(&mut self, ball: &mut B) {
        let count = self.columns.first().map_or(0, Vec::len);
        self.values.clear();
        self.values.resize(count, 0.0);
        if count <= 2 * AT_ONCE {
            ball.values(&self.columns, &mut self.values);
            return;
        }
        for start in (0..count).step_by(2 * AT_ONCE) {
            let end = count.min(start + 2 * AT_ONCE);
            let part: Vec<Vec<f64>> = self.columns.iter().map(|column| column[start..end].to_vec()).collect();
            ball.values(&part, &mut self.values[start..end]);
        }
    }
}

/// The steps from the centre to where the function is highest in the ball; NaN where the radius is undefined or infinite. If only the
/// `sign` of the highest value matters, any steps to a value of that sign.
pub fn highest<B: Ball + ?Sized>(ball: &mut B, dimension: usize, radius: f64, plan: &Plan, sign: bool) -> Vec<f64> {
    if !radius.is_finite() {
        return vec![f64::NAN; dimension];
    }
    let centre = vec![0.0; dimension];
    if radius <= 0.0 {
        return centre;
    }
    let mut starts = Places::new(dimension);
    starts.columns.iter_mut().for_each(|column| column.push(0.0));
    for scale in [radius, 0.5 * radius] {
        starts.add(&centre, scale, &plan.axes);
    }
    starts.ask(ball);
    let mut order: Vec<usize> = (0..starts.values.len()).filter(|i| !starts.values[*i].is_nan()).collect();
    order.sort_by(|&i, &j| starts.values[j].total_cmp(&starts.values[i]).then(i.cmp(&j)));
    let Some(&first) = order.first() else { return centre };
    let (mut best, mut top) = (starts.get(first), starts.values[first]);
    if sign && top > 0.0 {
        return best;
    }
    let cells = Cells::new(ball, radius, plan);
    if sign && !cells.reach(0.0) {
        return best;
    }
    let mut climbed: Vec<Vec<f64>> = Vec::new();
    let mut looks = Places::new(dimension);
    for &i in &order {
        let start = starts.get(i);
        let near = |other: &Vec<f64>| {
            other.iter().zip(&start).map(|(a, b)| (a - b) * (a - b)).sum::<f64>() < APART * APART * radius * radius
        };
        if climbed.iter().any(near) || (!climbed.is_empty() && !cells.reach_near(top, &start, 0.5 * APART * radius)) {
            continue;
        }
        let (at, value) = climb(ball, radius, &plan.axes, (start.clone(), starts.values[i]), &mut looks);
        if value > top {
            (best, top) = (at, value);
        }
        climbed.push(start);
        if climbed.len() == CLIMBS {
            break;
        }
    }
    best
}

/// Ranges over the cells of a ball.
struct Cells {
    columns: Vec<Vec<Interval>>,
    values: [Interval; AT_ONCE],
    count: usize,
}

impl Cells {
    fn new<B: Ball + ?Sized>(ball: &mut B, radius: f64, plan: &Plan) -> Self {
        // Drawing to the boundary may leave the ball by rounding.
        let reach = radius * (1.0 + 1e-15);
        let scaled = |side: &Interval| Interval::new(side.lo * reach, side.hi * reach);
        let columns: Vec<Vec<Interval>> = plan.cells.iter().map(|column| column.iter().map(scaled).collect()).collect();
        let count = columns.first().map_or(0, Vec::len);
        let mut values = [Interval::EMPTY; AT_ONCE];
        ball.ranges(&columns, &mut values[..count]);
        Self { columns, values, count }
    }

    /// Whether a value may be at least `least`.
    fn reach(&self, least: f64) -> bool {
        self.values[..self.count].iter().any(|value| !value.is_empty() && value.hi >= least)
    }

    /// Whether a value may be above `least` within a distance of a place, or of a cell that is.
    fn reach_near(&self, least: f64, place: &[f64], distance: f64) -> bool {
        (0..self.count).filter(|i| !self.values[*i].is_empty() && self.values[*i].hi > least).any(|i| {
            let off = |(column, x): (&Vec<Interval>, &f64)| (column[i].lo - x).max(x - column[i].hi).max(0.0);
            let square: f64 = self.columns.iter().zip(place).map(off).map(|off| off * off).sum();
            square <= distance * distance
        })
    }
}

fn climb<B: Ball + ?Sized>(
    ball: &mut B,
    radius: f64,
    axes: &[Vec<f64>],
    (mut at, mut value): (Vec<f64>, f64),
    looks: &mut Places,
) -> (Vec<f64>, f64) {
    let mut reach = 0.25 * radius;
    let sloped = at.len() <= GRADIENT;
    let mut slope = None;
    let count = axes.first().map_or(0, Vec::len);
    for _ in 0..LOOKS {
        if sloped && slope.is_none() {
            slope = Some(Slope::new(ball.gradient(&at), at.len()));
        }
        looks.clear();
        for scale in [reach, 0.3 * reach] {
            looks.add(&at, scale, axes);
        }
        if let Some(Slope { ahead: Some(ahead), .. }) = &slope {
            let ahead: [[f64; 1]; GRADIENT] = std::array::from_fn(|axis| [ahead.get(axis).copied().unwrap_or(0.0)]);
            STRIDES.iter().for_each(|stride| looks.add(&at, stride * radius, &ahead));
        }
        looks.draw(radius);
        looks.ask(ball);
        let mut found = None;
        for (i, v) in looks.values.iter().enumerate() {
            if *v > value {
                value = *v;
                found = Some(i);
            }
        }
        match found {
            Some(i) => {
                at = looks.get(i);
                slope = None;
                if i >= count && i < 2 * count {
                    reach *= 0.6;
                }
            }
            None if slope.as_ref().is_some_and(|slope| slope.is_level(&at, value, radius)) => break,
            None => reach *= 0.1,
        }
        if reach < NEAREST * radius {
            break;
        }
    }
    (at, value)
}

/// The gradient at a place.
struct Slope {
    length: f64,
    /// The unit vector along it.
    ahead: Option<Vec<f64>>,
}

impl Slope {
    fn new(gradient: [f64; GRADIENT], dimension: usize) -> Self {
        let gradient = &gradient[..dimension];
        let length = gradient.iter().map(|g| g * g).sum::<f64>().sqrt();
        let known = length.is_finite() && length > 0.0;
        Self { length, ahead: known.then(|| gradient.iter().map(|g| g / length).collect()) }
    }

    /// Whether nothing is to be gained by it: it leads out of the ball, or vanishes.
    fn is_level(&self, at: &[f64], value: f64, radius: f64) -> bool {
        let Some(ahead) = &self.ahead else { return self.length == 0.0 };
        if self.length * radius <= LEVEL * value.abs() {
            return true;
        }
        let from = at.iter().map(|x| x * x).sum::<f64>().sqrt();
        let outward: f64 = ahead.iter().zip(at).map(|(a, x)| a * x / from).sum();
        let along: f64 = ahead.iter().zip(at).map(|(a, x)| (a - outward * x / from).powi(2)).sum();
        from >= radius * (1.0 - LEVEL) && outward > 0.0 && along <= LEVEL * LEVEL
    }
}

/// Over a box of centres: the range of the highest value, and of the steps to it.
pub fn bounds<B: Ball + ?Sized>(ball: &mut B, dimension: usize, radius: Interval, plan: &Plan) -> (Interval, Interval) {
    if radius.is_empty() {
        return (Interval::EMPTY, Interval::EMPTY);
    }
    if !radius.hi.is_finite() || !radius.lo.is_finite() {
        return (Interval::WHOLE.or_undefined(true), Interval::WHOLE.or_undefined(true));
    }
    let outer = radius.hi.max(0.0);
    // Drawing to the boundary may leave the ball by rounding.
    let reach = outer * (1.0 + 1e-15);
    let step = Interval::new(-reach, reach).or_undefined(radius.undefined);
    let radius_or_none = radius.clip(0.0, f64::INFINITY);
    let radius_or_none = if radius_or_none.is_empty() { Interval::point(0.0) } else { radius_or_none };
    // Below: it is no less than at each start of the search.
    let rows: Vec<&Vec<f64>> = plan.directions.iter().take(AT_ONCE - 1).collect();
    let starts: Vec<Vec<Interval>> = (0..dimension)
        .map(|k| {
            let moved = rows.iter().map(|d| Binary::Mul.interval(radius_or_none, Interval::point(d[k])));
            moved.chain([Interval::point(0.0)]).map(|i| i.or_undefined(false)).collect()
        })
        .collect();
    let mut values = [Interval::EMPTY; AT_ONCE];
    let count = rows.len() + 1;
    ball.ranges(&starts, &mut values[..count]);
    let defined = values[..count].iter().filter(|v| !v.undefined);
    let floor = defined.clone().map(|v| v.lo).fold(f64::NEG_INFINITY, f64::max);
    let undefined = defined.count() == 0;
    // Above: no more than over all cells that touch the ball; those that reach the floor are cut again.
    let mut cells: Vec<Vec<Interval>> = vec![vec![step; dimension]];
    let (mut top, mut low) = (f64::NEG_INFINITY, f64::INFINITY);
    for _ in 0..6 {
        let mut cut = 1;
        while cells.len() * (cut + 1_usize).saturating_pow(u32::try_from(dimension).unwrap_or(u32::MAX)) <= AT_ONCE {
            cut += 1;
        }
        if cut == 1 && top > f64::NEG_INFINITY {
            break;
        }
        cells = cells.iter().flat_map(|cell| pieces(cell, cut)).filter(|cell| touches(cell, reach)).collect();
        cells.truncate(AT_ONCE);
        let steps: Vec<Vec<Interval>> = (0..dimension).map(|k| cells.iter().map(|c| c[k]).collect()).collect();
        let count = cells.len();
        ball.ranges(&steps, &mut values[..count]);
        (top, low) = (f64::NEG_INFINITY, f64::INFINITY);
        let mut keep = vec![false; count];
        for (value, keep) in values[..count].iter().zip(&mut keep) {
            if !value.is_empty() && value.hi >= floor {
                top = top.max(value.hi);
                low = low.min(value.lo);
                *keep = true;
            }
        }
        let mut keep = keep.into_iter();
        cells.retain(|_| keep.next() == Some(true));
        if cells.is_empty() {
            break;
        }
    }
    if low > top && floor == f64::NEG_INFINITY {
        return (Interval::EMPTY, step);
    }
    let bottom = if undefined { low } else { floor.max(low) };
    (Interval::new(bottom, top.max(bottom)).or_undefined(undefined || radius.undefined), step)
}

/// A cell cut into `cut` parts along each axis.
fn pieces(cell: &[Interval], cut: usize) -> Vec<Vec<Interval>> {
    let mut all: Vec<Vec<Interval>> = vec![Vec::new()];
    for side in cell {
        #[allow(clippy::cast_precision_loss)]
        let at = |i: usize| if i == cut { side.hi } else { side.lo + (side.hi - side.lo) * (i as f64 / cut as f64) };
        all = all
            .into_iter()
            .flat_map(|first| {
                (0..cut).map(move |i| {
                    let mut cell = first.clone();
                    cell.push(Interval::new(at(i), at(i + 1)));
                    cell
                })
            })
            .collect();
    }
    all
}

/// Whether a cell has a place within the radius of the centre.
fn touches(cell: &[Interval], radius: f64) -> bool {
    let square: f64 = cell.iter().map(|side| side.smallest() * side.smallest()).sum();
    square <= radius * radius * (1.0 + 1e-12)
}
