//! Graphs of functions of one variable: value curves over an axis, the zero line, the part where f >= 0. Poles and jumps are never
//! joined, undefined parts stay empty.

use super::axes::{Axis, Look, PAPER, Plot, Surround};
use super::canvas::{Area, Canvas, Pen};
use super::image::Image;
use super::legend::Telling;
use crate::interrupt::{Cancelled, Interrupt};
use crate::surface::sampler::{Counters, Sampler};
use crate::vm::Shape;

/// Values of the function at several places: the second slice takes one value for each of the first; NaN where undefined.
pub type Function<'a> = dyn FnMut(&[f64], &mut [f64]) + 'a;

const CURVE: [u8; 4] = [31, 119, 180, 255];
const INSIDE: [u8; 4] = [31, 119, 180, 46];
const SEGMENT: [u8; 4] = [214, 69, 45, 255];
const ZERO: [u8; 4] = [90, 90, 90, 255];

/// Halvings after which two neighbours in single steps of double precision are reached from any start.
const HALVINGS: usize = 60;

/// What is known of a function over a range.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Curve {
    /// Points to be joined, run by run: a run ends at a jump, a pole, or where the function is undefined.
    pub runs: Vec<Vec<[f64; 2]>>,
    /// The parts of the axis where f >= 0; ends at the range's ends where it goes on.
    pub inside: Vec<[f64; 2]>,
    /// Whether the function grows beyond all bounds somewhere.
    pub pole: bool,
    /// Whether it is undefined somewhere.
    pub undefined: bool,
    /// The values worth showing: all samples, or the quiet ones where there is a pole. Both 0 if there is no value.
    pub values: [f64; 2],
}

/// Follows a function from `lo` to `hi` by `count` samples at equal distances. Jumps, poles, ends of definition and roots between
/// samples are found to the last digit by halving.
///
/// `lo` must be less than `hi`, both finite; else the curve is empty.
#[must_use]
pub fn follow(lo: f64, hi: f64, count: usize, f: &mut Function) -> Curve {
    if !(lo < hi && (hi - lo).is_finite()) {
        return Curve::default();
    }
    let count = count.max(2);
    let xs: Vec<f64> = (0..=count).map(|i| lo + (hi - lo) * (i as f64 / count as f64)).collect();
    let mut ys = vec![f64::NAN; xs.len()];
    f(&xs, &mut ys);
    let samples: Vec<[f64; 2]> = xs.into_iter().zip(ys).map(|(x, y)| [x, bounded(y)]).collect();
    let extent = extent(samples.iter().map(|p| p[1]));
    let changes = find_changes(&samples, extent, f);
    let mut curve = assemble(&samples, &changes);
    curve.pole |= changes.iter().any(|(_, change)| change.grows) || grows_at_extremes(&samples, f);
    curve.values = quiet(&samples, curve.pole);
    curve
}

/// The range of all samples, or of nine in ten about their middle where the rest rushes off to a pole. Points found between samples
/// do not count: a logarithm's last ones would leave no room for the others.
fn quiet(samples: &[[f64; 2]], pole: bool) -> [f64; 2] {
    let mut values: Vec<f64> = samples.iter().map(|p| p[1]).filter(|y| !y.is_nan()).collect();
    values.sort_by(f64::total_cmp);
    let Some(last) = values.len().checked_sub(1) else { return [0., 0.] };
    let at = |part: f64| values[(part * last as f64).round() as usize];
    if pole { [at(0.05), at(0.95)] } else { [at(0.), at(1.)] }
}

/// Follows a shape of one axis, as [`follow`] does a function; also tells what it cost.
///
/// # Errors
/// [`Cancelled`] soon after the interrupt was set.
///
/// # Panics
/// If the shape has another number of axes.
pub fn of(
    shape: &Shape,
    lo: f64,
    hi: f64,
    count: usize,
    interrupt: &Interrupt,
) -> Result<(Curve, Counters), Cancelled> {
    assert_eq!(shape.dimension, 1, "a graph has one axis");
    let mut sampler = Sampler::new(shape).heeding(interrupt);
    let curve = follow(lo, hi, count, &mut |xs, ys| {
        sampler.values(&shape.program, &[xs], ys);
    });
    interrupt.tick()?;
    Ok((curve, sampler.take_counters()))
}

/// Infinities are drawn as the largest numbers: beyond every plot, and still of their sign.
fn bounded(y: f64) -> f64 {
    y.clamp(-1e300, 1e300)
}

fn extent(values: impl Iterator<Item = f64>) -> f64 {
    let (lo, hi) =
        values.filter(|y| !y.is_nan()).fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), y| (lo.min(y), hi.max(y)));
    if hi > lo { hi - lo } else { 0. }
}

/// Two neighbouring points between which something happens, and what.
#[derive(Clone, Copy, Debug)]
struct Change {
    before: [f64; 2],
    after: [f64; 2],
    kind: Kind,
    grows: bool,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    /// One side is undefined.
    Defined,
    /// One side is inside.
    Inside,
    /// Both sides are defined and far from each other.
    Jump,
}

impl Kind {
    /// Whether a point between belongs to the left one rather than to the right one.
    fn left(self, change: &Change, middle: [f64; 2]) -> bool {
        match self {
            Kind::Defined => middle[1].is_nan() == change.before[1].is_nan(),
            Kind::Inside => (middle[1] >= 0.) == (change.before[1] >= 0.),
            Kind::Jump => (middle[1] - change.before[1]).abs() <= (change.after[1] - middle[1]).abs(),
        }
    }
}

/// Everything that happens between samples, with the number of the sample before, in the order of the axis.
fn find_changes(samples: &[[f64; 2]], extent: f64, f: &mut Function) -> Vec<(usize, Change)> {
    let mut found = Vec::new();
    for kind in [Kind::Defined, Kind::Jump] {
        let mut some: Vec<(usize, Change)> = samples
            .windows(2)
            .enumerate()
            .map(|(i, pair)| (i, Change { before: pair[0], after: pair[1], kind, grows: false }))
            .filter(|(_, change)| suspicious(change, extent))
            .collect();
        let start: Vec<f64> = some.iter().map(|(_, c)| (c.after[1] - c.before[1]).abs()).collect();
        halve(&mut some, f);
        for ((i, mut change), start) in some.into_iter().zip(start) {
            let gap = (change.after[1] - change.before[1]).abs();
            change.grows = kind == Kind::Jump && gap > 4. * start;
            // A steep but continuous function closes its gap when looked at closely; a jump does not.
            if kind == Kind::Defined || gap > 0.25 * start {
                found.push((i, change));
            }
        }
    }
    found.sort_by(|a, b| (a.0, a.1.before[0]).partial_cmp(&(b.0, b.1.before[0])).unwrap_or(std::cmp::Ordering::Equal));
    let mut roots = find_roots(samples, &found);
    halve(&mut roots, f);
    found.extend(roots);
    found.sort_by(|a, b| (a.0, a.1.before[0]).partial_cmp(&(b.0, b.1.before[0])).unwrap_or(std::cmp::Ordering::Equal));
    found
}

fn suspicious(change: &Change, extent: f64) -> bool {
    let [a, b] = [change.before[1], change.after[1]];
    match change.kind {
        Kind::Defined => a.is_nan() != b.is_nan(),
        _ => (b - a).abs() > 0.02 * extent,
    }
}

/// The parts between samples and changes whose ends differ in sign.
fn find_roots(samples: &[[f64; 2]], found: &[(usize, Change)]) -> Vec<(usize, Change)> {
    let mut roots = Vec::new();
    let mut rest = found;
    for (i, pair) in samples.windows(2).enumerate() {
        let here = rest.iter().take_while(|(at, _)| *at == i).count();
        let mut from = pair[0];
        let ends = rest[..here].iter().map(|(_, c)| (c.before, c.after)).chain([(pair[1], pair[1])]);
        for (to, next) in ends {
            let defined = !from[1].is_nan() && !to[1].is_nan();
            if defined && (from[1] >= 0.) != (to[1] >= 0.) {
                roots.push((i, Change { before: from, after: to, kind: Kind::Inside, grows: false }));
            }
            from = next;
        }
        rest = &rest[here..];
    }
    roots
}

/// Halves all at once, so that the function is asked for many places in one call.
fn halve(changes: &mut [(usize, Change)], f: &mut Function) {
    let mut values = vec![f64::NAN; changes.len()];
    for _ in 0..if changes.is_empty() { 0 } else { HALVINGS } {
        let middles: Vec<f64> = changes.iter().map(|(_, c)| c.before[0] + 0.5 * (c.after[0] - c.before[0])).collect();
        f(&middles, &mut values);
        for (((_, change), &x), &y) in changes.iter_mut().zip(&middles).zip(&values) {
            let middle = [x, bounded(y)];
            if x <= change.before[0] || x >= change.after[0] {
                continue; // No number lies between.
            }
            if change.kind == Kind::Jump && y.is_nan() {
                change.before = middle; // A hole of one point splits as well as a jump does.
            } else if change.kind.left(change, middle) {
                change.before = middle;
            } else {
                change.after = middle;
            }
        }
    }
}

/// Joins samples and changes to runs, and finds where the function is inside.
fn assemble(samples: &[[f64; 2]], changes: &[(usize, Change)]) -> Curve {
    let mut curve = Curve::default();
    let mut open = None;
    let mut run: Vec<[f64; 2]> = Vec::new();
    let mut rest = changes;
    for (i, &sample) in samples.iter().enumerate() {
        curve.take(sample, &mut run, &mut open);
        let here = rest.iter().take_while(|(at, _)| *at == i).count();
        for (_, change) in &rest[..here] {
            curve.take(change.before, &mut run, &mut open);
            if change.kind != Kind::Inside {
                curve.end(&mut run);
            }
            curve.take(change.after, &mut run, &mut open);
        }
        rest = &rest[here..];
    }
    curve.end(&mut run);
    curve.inside.extend(open);
    curve
}

impl Curve {
    /// Takes the next point of the axis.
    fn take(&mut self, point: [f64; 2], run: &mut Vec<[f64; 2]>, open: &mut Option<[f64; 2]>) {
        let [x, y] = point;
        if y >= 0. {
            open.get_or_insert([x, x])[1] = x;
        } else {
            self.inside.extend(open.take());
        }
        if y.is_nan() {
            self.undefined = true;
            self.end(run);
        } else if run.last() != Some(&point) {
            run.push(point);
        }
    }

    fn end(&mut self, run: &mut Vec<[f64; 2]>) {
        if !run.is_empty() {
            self.runs.push(std::mem::take(run));
        }
    }
}

/// Looks closely about the largest and the smallest sample: a pole without change of sign has no jump, but no largest value either.
fn grows_at_extremes(samples: &[[f64; 2]], f: &mut Function) -> bool {
    let extreme = |sign: f64| {
        let all = samples.iter().enumerate().filter(|(_, p)| !p[1].is_nan());
        all.max_by(|a, b| (sign * a.1[1]).total_cmp(&(sign * b.1[1]))).map(|(i, p)| (i, p[1]))
    };
    [1., -1.].into_iter().any(|sign| {
        let Some((i, first)) = extreme(sign) else { return false };
        let (mut lo, mut hi) = (samples[i.saturating_sub(1)][0], samples[(i + 1).min(samples.len() - 1)][0]);
        let mut best = first;
        let mut values = [f64::NAN; 9];
        for _ in 0..16 {
            let places: [f64; 9] = std::array::from_fn(|k| lo + (hi - lo) * (k as f64 / 8.));
            f(&places, &mut values);
            let top = (0..9)
                .filter(|&k| !values[k].is_nan())
                .max_by(|&a, &b| (sign * values[a]).total_cmp(&(sign * values[b])));
            let Some(top) = top else { return false };
            best = bounded(values[top]);
            (lo, hi) = (places[top.saturating_sub(1)], places[(top + 1).min(8)]);
        }
        sign * best > 1e3 * first.abs().max(1e-30)
    })
}

/// One function's graph in a picture.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Graph {
    /// Written above it.
    pub title: String,
    /// What the values are called.
    pub name: String,
    /// The curve.
    pub curve: Curve,
    /// The values that are shown; without them what the curve needs, and 0.
    pub range: Option<[f64; 2]>,
}

impl Graph {
    /// The range of values to show: what was asked for, or the curve's with 0 and a little room.
    #[must_use]
    pub fn value_range(&self) -> [f64; 2] {
        if let Some(range) = self.range {
            return range;
        }
        let [lo, hi] = self.curve.values;
        let (lo, hi) = (lo.min(0.), hi.max(0.));
        let room = if hi > lo { 0.06 * (hi - lo) } else { 1. };
        [lo - room, hi + room]
    }
}

/// Draws graphs above each other over one axis, as in \[P95\] Fig. 1. None if there is no graph or no memory for the picture.
#[must_use]
pub fn stack(graphs: &[Graph], x: &Axis, width: usize, height: usize) -> Option<Image> {
    let last = graphs.len().checked_sub(1)?;
    let mut canvas = Canvas::new(width, height, PAPER)?;
    let mut look = Look::of(width, height);
    look.text = look.text.min(height as f32 / graphs.len() as f32 / 17.).max(8.);
    // The lowest also carries the numbers; what they need is taken from all alike.
    let below = look.text * 3.2;
    let each = (height as f32 - below) / graphs.len() as f32;
    let ranges: Vec<Axis> = graphs
        .iter()
        .map(|graph| {
            let [lo, hi] = graph.value_range();
            Axis::new(graph.name.clone(), lo, hi)
        })
        .collect();
    let plots: Vec<(Plot, Surround)> = graphs
        .iter()
        .zip(ranges)
        .enumerate()
        .map(|(i, (graph, y))| {
            let surround = Surround { title: graph.title.clone(), bare: i < last, ..Surround::default() };
            let top = i as f32 * each;
            let bottom = top + each - look.text * 0.6 + if i == last { below } else { 0. };
            let room = Area { left: look.text * 0.4, top: top + look.text * 0.3, right: width as f32, bottom };
            (Plot::within(room, x.clone(), y, look, &surround), surround)
        })
        .collect();
    // One left edge for all, that of the widest numbers.
    let left = plots.iter().map(|(plot, _)| plot.area.left).fold(0., f32::max);
    for ((mut plot, surround), graph) in plots.into_iter().zip(graphs) {
        plot.area.left = left;
        draw(&mut canvas, &plot, &graph.curve);
        plot.frame(&mut canvas, &surround);
    }
    Some(canvas.image())
}

/// Draws several curves over each other in one plot, each in its own colour: a group of sections. None if there is no curve or no
/// memory for the picture.
#[must_use]
pub fn group(
    curves: &[Curve],
    telling: &Telling,
    graph: &Graph,
    x: &Axis,
    [width, height]: [usize; 2],
) -> Option<Image> {
    let all = curves.iter().map(|curve| curve.values);
    let values = all.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])])?;
    let [lo, hi] = Graph { curve: Curve { values, ..Curve::default() }, ..graph.clone() }.value_range();
    let mut canvas = Canvas::new(width, height, PAPER)?;
    let look = Look::of(width, height);
    let surround = Surround { title: graph.title.clone(), ..Surround::default() };
    let right = width as f32 - telling.width(height as f32, look);
    let room = Area { left: look.text * 0.4, top: 0., right, bottom: height as f32 };
    let plot = Plot::within(room, x.clone(), Axis::new(graph.name.clone(), lo, hi), look, &surround);
    plot.grid(&mut canvas);
    canvas.clip(Some(plot.area));
    zero_line(&mut canvas, &plot);
    for (curve, &colour) in curves.iter().zip(&telling.colours) {
        runs(&mut canvas, &plot, curve, colour);
    }
    canvas.clip(None);
    plot.frame(&mut canvas, &surround);
    telling.draw(&mut canvas, plot.area, look);
    Some(canvas.image())
}

/// Grid, zero line, curve, and the part where f >= 0, inside the plot's area.
fn draw(canvas: &mut Canvas, plot: &Plot, curve: &Curve) {
    let look = plot.look;
    plot.grid(canvas);
    canvas.clip(Some(plot.area));
    let zero = plot.at(plot.x.lo, 0.)[1];
    for run in &curve.runs {
        for part in run.chunk_by(|a, b| (a[1] >= 0.) == (b[1] >= 0.)).filter(|part| part[0][1] >= 0.) {
            let mut points: Vec<[f32; 2]> = part.iter().map(|p| plot.at(p[0], p[1])).collect();
            let (first, last) = (points[0][0], points[points.len() - 1][0]);
            points.extend([[last, zero], [first, zero]]);
            canvas.fill(&points, INSIDE);
        }
    }
    zero_line(canvas, plot);
    runs(canvas, plot, curve, CURVE);
    for &[from, to] in &curve.inside {
        let ends = [plot.at(from, 0.), plot.at(to, 0.)];
        canvas.line(&ends, false, &Pen::solid(SEGMENT, look.thick * 1.5));
        // A dot marks a boundary; where the part goes on beyond the plot there is none.
        for (place, end) in [from, to].into_iter().zip(ends) {
            if place > plot.x.lo && place < plot.x.hi {
                canvas.dot(end, look.thick * 1.7, SEGMENT);
            }
        }
    }
    canvas.clip(None);
}

fn zero_line(canvas: &mut Canvas, plot: &Plot) {
    let row = plot.at(plot.x.lo, 0.)[1];
    let dash = Some([plot.look.text * 0.45, plot.look.text * 0.3]);
    let pen = Pen { colour: ZERO, width: plot.look.thin, dash };
    canvas.ruled([plot.area.left, row], [plot.area.right, row], &pen);
}

/// The runs of a curve; one of a single point is a dot.
fn runs(canvas: &mut Canvas, plot: &Plot, curve: &Curve, colour: [u8; 4]) {
    for run in &curve.runs {
        let points: Vec<[f32; 2]> = run.iter().map(|p| plot.at(p[0], p[1])).collect();
        match points.as_slice() {
            [point] => canvas.dot(*point, plot.look.thick * 0.8, colour),
            _ => canvas.line(&points, false, &Pen::solid(colour, plot.look.thick)),
        }
    }
}
