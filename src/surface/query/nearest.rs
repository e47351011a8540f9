//! The point of an object that is nearest to another point. A point of the object is brought as near as it goes, by Newton's method on the smooth
//! pieces of the boundary that meet there; then branch and bound finds a nearer one, or proves that there is none.

use std::sync::Arc;

use super::climb::norm;
use super::{Conditions, Near, Verdict, decide};
use crate::field::{Coordinate, Graph, NodeId};
use crate::interrupt::{Cancelled, Interrupt};
use crate::limits::Limits;
use crate::vm::{CompileError, Gradients, Pieces, Points, Program};

/// Parts of the distance by which no point may be nearer, each to be proved before the next.
const PROOFS: [f64; 4] = [1e-2, 1e-4, 1e-7, 1e-10];
/// Times that a nearer point may be found; each takes at least the first of those parts off.
const ROUNDS: usize = 400;
/// Times that a point is brought farther along an axis, each by a point that lies so many sizes of the object ahead.
const CLIMBS: usize = 30;
const AHEAD: f64 = 100.0;
/// Steps of Newton's method.
const STEPS: usize = 40;
/// Pieces of a boundary that may meet at a point.
const MEET: usize = 6;

/// What is known of the nearest point.
#[derive(Clone, Debug, PartialEq)]
pub enum Nearest {
    /// The object is empty, as far as space goes.
    Nothing,
    /// The point.
    Found {
        /// Its coordinates.
        place: Vec<f64>,
        /// Its distance.
        distance: f64,
        /// No point of the object is nearer by more than that: it is proved.
        error: f64,
    },
    /// It was not found whether there is a point at all, or a nearer one.
    Open(Near),
}

/// Why there is no answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NearestError {
    /// The work was to stop.
    Cancelled,
    /// The object cannot be compiled.
    Compile(CompileError),
}

impl From<Cancelled> for NearestError {
    fn from(_: Cancelled) -> Self {
        Self::Cancelled
    }
}

impl From<CompileError> for NearestError {
    fn from(error: CompileError) -> Self {
        Self::Compile(error)
    }
}

/// The point of an object nearest to `to`, itself if it belongs to the object. Each search may look at so many boxes as the limits say.
///
/// # Errors
/// See [`NearestError`].
pub fn nearest(
    graph: &Graph,
    object: NodeId,
    (axes, to): (&[Coordinate], &[f64]),
    limits: &Limits,
    interrupt: &Interrupt,
) -> Result<Nearest, NearestError> {
    let mut all = Conditions::over(axes, limits);
    all.inside(graph, object)?;
    let mut polish = Polish::new(all.whole()?, to, interrupt);
    if polish.is_inside(to) {
        return Ok(Nearest::Found { place: to.to_vec(), distance: 0.0, error: 0.0 });
    }
    let endless = vec![[f64::NEG_INFINITY, f64::INFINITY]; axes.len()];
    let first = match decide(&mut all, &endless, limits.question_boxes, interrupt)? {
        Verdict::Never => return Ok(Nearest::Nothing),
        Verdict::Open(near) => return Ok(Nearest::Open(near)),
        Verdict::At(point) => point,
    };
    let mut place = polish.nearer(first);
    let (mut proof, mut proved) = (0, None);
    for _ in 0..ROUNDS {
        let distance = polish.distance(&place);
        let Some(&part) = PROOFS.get(proof) else { break };
        let radius = distance * (1.0 - part);
        let mut conditions = Conditions::over(axes, limits);
        conditions.inside(graph, object)?;
        conditions.within(radius, to)?;
        let space: Vec<[f64; 2]> = to.iter().map(|c| [c - radius, c + radius]).collect();
        match decide(&mut conditions, &space, limits.question_boxes, interrupt)? {
            Verdict::Never => {
                proved = Some(radius);
                proof += 1;
            }
            Verdict::At(point) => {
                let next = polish.nearer(point);
                // Within rounding there is always a nearer one.
                if polish.distance(&next) >= distance {
                    break;
                }
                place = next;
            }
            Verdict::Open(near) if proved.is_none() => return Ok(Nearest::Open(near)),
            Verdict::Open(_) => break,
        }
    }
    let distance = polish.distance(&place);
    let error = distance - proved.map_or(0.0, |proved: f64| proved.min(distance));
    Ok(Nearest::Found { place, distance, error })
}

/// How far an object reaches along one of its axes, within a space that holds all of it: the coordinate, and what the object may reach beyond it at
/// most. `None` if it could not be decided. `from` is a point of the object.
///
/// # Errors
/// See [`NearestError`].
pub fn farthest(
    graph: &Graph,
    object: NodeId,
    (axes, space): (&[Coordinate], &[[f64; 2]]),
    (axis, up, from): (usize, bool, &[f64]),
    (limits, interrupt): (&Limits, &Interrupt),
) -> Result<Option<[f64; 2]>, NearestError> {
    let sign = if up { 1.0 } else { -1.0 };
    let size = space.iter().map(|[lo, hi]| hi - lo).fold(0.0, f64::max);
    let mut all = Conditions::over(axes, limits);
    all.inside(graph, object)?;
    let program = all.whole()?;
    // The farthest point is the nearest to one that lies far in that direction, and from there again.
    let climb = |mut place: Vec<f64>| {
        for _ in 0..CLIMBS {
            let mut to = place.clone();
            to[axis] += sign * AHEAD * size;
            let next = Polish::new(Arc::clone(&program), &to, interrupt).nearer(place.clone());
            if sign * next[axis] <= sign * place[axis] {
                break;
            }
            place = next;
        }
        place
    };
    let mut place = climb(from.to_vec());
    let (mut proof, mut proved) = (0, None);
    for _ in 0..ROUNDS {
        let Some(&part) = PROOFS.get(proof) else { break };
        let bound = place[axis] + sign * part * size;
        let mut conditions = Conditions::over(axes, limits);
        conditions.inside(graph, object)?;
        conditions.beyond((axis, up), bound)?;
        match decide(&mut conditions, space, limits.question_boxes, interrupt)? {
            Verdict::Never => {
                proved = Some(part * size);
                proof += 1;
            }
            Verdict::At(point) => {
                let next = climb(point);
                if sign * next[axis] <= sign * place[axis] {
                    break;
                }
                place = next;
            }
            Verdict::Open(_) => break,
        }
    }
    interrupt.tick()?;
    Ok(proved.map(|error| [place[axis], error]))
}

/// Brings points of an object nearer to a point outside.
struct Polish<'a> {
    program: Arc<Program>,
    to: &'a [f64],
    points: Points<f64>,
    gradients: Gradients,
    pieces: Pieces,
}

impl<'a> Polish<'a> {
    fn new(program: Arc<Program>, to: &'a [f64], interrupt: &Interrupt) -> Self {
        let (points, gradients) = (Points::heeding(interrupt), Gradients::heeding(interrupt));
        Self { program, to, points, gradients, pieces: Pieces::heeding(interrupt) }
    }

    fn distance(&self, point: &[f64]) -> f64 {
        norm(&point.iter().zip(self.to).map(|(a, b)| a - b).collect::<Vec<f64>>())
    }

    fn value(&mut self, point: &[f64]) -> f64 {
        let columns: Vec<[f64; 1]> = point.iter().map(|&c| [c]).collect();
        let slices: Vec<&[f64]> = columns.iter().map(<[f64; 1]>::as_slice).collect();
        let mut value = [0.0];
        self.points.eval(&self.program, &slices, &mut value);
        value[0]
    }

    fn is_inside(&mut self, point: &[f64]) -> bool {
        self.value(point) >= 0.0
    }

    /// A point of the object, at its boundary, that is as near as one gets from here.
    fn nearer(&mut self, from: Vec<f64>) -> Vec<f64> {
        let mut best = self.along(from);
        // The pieces of the boundary are looked for close by and in a wider neighbourhood: the nearest point may be on another.
        for part in [1e-9, 1e-6, 1e-3, 0.05, 0.3] {
            let radius = part * self.distance(&best);
            let pieces = self.around(&best, radius);
            for chosen in subsets(pieces.len(), best.len()) {
                let pieces: Vec<&Program> = chosen.iter().map(|&i| &pieces[i]).collect();
                let Some(point) = self.newton(&pieces, &best) else { continue };
                if self.distance(&point) < self.distance(&best) && self.is_at_boundary(&point) {
                    best = point;
                }
            }
        }
        best
    }

    /// The last point of the object on the way to the point outside.
    fn along(&mut self, from: Vec<f64>) -> Vec<f64> {
        let at = |t: f64| from.iter().zip(self.to).map(|(a, b)| a + t * (b - a)).collect::<Vec<f64>>();
        let (mut inside, mut outside) = (0.0, 1.0);
        for _ in 0..60 {
            let middle = 0.5 * (inside + outside);
            let point = at(middle);
            let columns: Vec<[f64; 1]> = point.iter().map(|&c| [c]).collect();
            let slices: Vec<&[f64]> = columns.iter().map(<[f64; 1]>::as_slice).collect();
            let mut value = [0.0];
            self.points.eval(&self.program, &slices, &mut value);
            if value[0] >= 0.0 { inside = middle } else { outside = middle }
        }
        at(inside)
    }

    /// Whether a point belongs to the object, or would but for rounding.
    fn is_at_boundary(&mut self, point: &[f64]) -> bool {
        let value = self.value(point);
        if value >= 0.0 {
            return true;
        }
        let size = point.iter().chain(self.to).fold(0.0_f64, |most, c| most.max(c.abs()));
        let program = Arc::clone(&self.program);
        let (_, slope) = self.slope(&program, point);
        -value <= 1e-14 * size * norm(&slope)
    }

    /// The smooth pieces that the function is made of within a radius of a point.
    fn around(&mut self, point: &[f64], radius: f64) -> Vec<Program> {
        if !Pieces::has_branches(&self.program) {
            return vec![Program::clone(&self.program)];
        }
        let axes = point.len();
        let mut cloud = vec![point.to_vec()];
        for axis in 0..axes {
            for way in [-radius, radius] {
                let mut next = point.to_vec();
                next[axis] += way;
                cloud.push(next);
            }
        }
        // Corners of the cube, with unlike sides so that they lie in no plane of symmetry.
        for corner in 0..1_usize << axes.min(4) {
            let side =
                |axis: usize| radius * (0.6 + 0.07 * axis as f64) * if corner >> axis & 1 == 1 { 1.0 } else { -1.0 };
            cloud.push(point.iter().enumerate().map(|(axis, c)| c + if axis < 4 { side(axis) } else { 0.0 }).collect());
        }
        let columns: Vec<Vec<f64>> = (0..axes).map(|axis| cloud.iter().map(|p| p[axis]).collect()).collect();
        let slices: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
        let (mut pieces, mut which) = (Vec::new(), vec![0; cloud.len()]);
        self.pieces.at(&self.program, &slices, &mut pieces, &mut which);
        pieces.truncate(MEET);
        pieces
    }

    /// The value of a piece and its slopes.
    fn slope(&mut self, piece: &Program, point: &[f64]) -> (f64, Vec<f64>) {
        let columns: Vec<[f64; 1]> = point.iter().map(|&c| [c]).collect();
        let slices: Vec<&[f64]> = columns.iter().map(<[f64; 1]>::as_slice).collect();
        let by: Vec<usize> = (0..point.len()).collect();
        let (mut value, mut store) = ([0.0], vec![[0.0]; point.len()]);
        let mut slopes: Vec<&mut [f64]> = store.iter_mut().map(<[f64; 1]>::as_mut_slice).collect();
        self.gradients.eval(piece, &slices, &by, &mut value, &mut slopes);
        (value[0], store.into_iter().map(|[slope]| slope).collect())
    }

    /// The point where all pieces are 0 and the way to the point outside is a sum of their slopes, by Newton's method; second derivatives are
    /// differences of slopes, which costs some steps and no digits.
    fn newton(&mut self, pieces: &[&Program], from: &[f64]) -> Option<Vec<f64>> {
        let (n, k) = (from.len(), pieces.len());
        let mut point = from.to_vec();
        let reach = self.distance(from);
        let mut weights: Option<Vec<f64>> = None;
        let mut before = f64::INFINITY;
        for _ in 0..STEPS {
            let faces: Vec<(f64, Vec<f64>)> = pieces.iter().map(|piece| self.slope(piece, &point)).collect();
            let off: Vec<f64> = point.iter().zip(self.to).map(|(a, b)| a - b).collect();
            let lambda = match weights.take() {
                Some(known) => known,
                None => fitted(&faces, &off)?,
            };
            let mut system = vec![vec![0.0; n + k + 1]; n + k];
            for axis in 0..n {
                system[axis][axis] = 1.0;
                let pulled: f64 = faces.iter().zip(&lambda).map(|((_, slope), w)| w * slope[axis]).sum();
                system[axis][n + k] = pulled - off[axis];
            }
            for (j, (value, slope)) in faces.iter().enumerate() {
                for axis in 0..n {
                    system[axis][n + j] = -slope[axis];
                    system[n + j][axis] = slope[axis];
                }
                system[n + j][n + k] = -value;
            }
            self.curve(pieces, &lambda, (&point, 1e-5 * reach), &mut system);
            let step = solved(system)?;
            point.iter_mut().zip(&step).for_each(|(c, d)| *c += d);
            weights = Some(lambda.iter().zip(&step[n..]).map(|(w, d)| w + d).collect());
            let length = norm(&step[..n]);
            if !length.is_finite() || length > 4.0 * reach {
                return None;
            }
            // Until rounding makes steps no shorter.
            if length <= 1e-15 * (reach + norm(&point)) || (length < 1e-9 * reach && length >= 0.5 * before) {
                return Some(point);
            }
            before = length;
        }
        None
    }

    /// Takes the weighted second derivatives off a system.
    fn curve(&mut self, pieces: &[&Program], weights: &[f64], (point, step): (&[f64], f64), system: &mut [Vec<f64>]) {
        for (piece, weight) in pieces.iter().zip(weights) {
            for axis in 0..point.len() {
                let mut ends = [-step, step].map(|by| {
                    let mut end = point.to_vec();
                    end[axis] += by;
                    self.slope(piece, &end).1
                });
                let [low, high] = &mut ends;
                for (row, (a, b)) in system.iter_mut().zip(low.iter().zip(high.iter())) {
                    let second = (b - a) / (2.0 * step);
                    row[axis] -= if second.is_finite() { weight * second } else { 0.0 };
                }
            }
        }
    }
}

/// The weights with which slopes add up best to a direction: least squares.
fn fitted(faces: &[(f64, Vec<f64>)], off: &[f64]) -> Option<Vec<f64>> {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let row = |(_, a): &(f64, Vec<f64>)| {
        let mut row: Vec<f64> = faces.iter().map(|(_, b)| dot(a, b)).collect();
        row.push(dot(a, off));
        row
    };
    solved(faces.iter().map(row).collect())
}

/// The solution of a linear system, whose right side is the last column; by elimination with pivots.
pub(super) fn solved(mut rows: Vec<Vec<f64>>) -> Option<Vec<f64>> {
    let n = rows.len();
    for at in 0..n {
        let pivot = (at..n).max_by(|&a, &b| rows[a][at].abs().total_cmp(&rows[b][at].abs()))?;
        rows.swap(at, pivot);
        let lead = rows[at][at];
        if lead == 0.0 || !lead.is_finite() {
            return None;
        }
        for below in at + 1..n {
            let factor = rows[below][at] / lead;
            let (upper, lower) = rows.split_at_mut(below);
            lower[0][at..].iter_mut().zip(&upper[at][at..]).for_each(|(c, u)| *c -= factor * u);
        }
    }
    let mut solution = vec![0.0; n];
    for at in (0..n).rev() {
        let known: f64 = (at + 1..n).map(|k| rows[at][k] * solution[k]).sum();
        solution[at] = (rows[at][n] - known) / rows[at][at];
    }
    solution.iter().all(|c| c.is_finite()).then_some(solution)
}

/// All choices of some of so many pieces, no more than `most` at a time; single ones first.
fn subsets(count: usize, most: usize) -> Vec<Vec<usize>> {
    let mut all: Vec<Vec<usize>> = (1..1_usize << count.min(MEET))
        .map(|bits| (0..count).filter(|i| bits >> i & 1 == 1).collect::<Vec<usize>>())
        .filter(|chosen| chosen.len() <= most)
        .collect();
    all.sort_by_key(Vec::len);
    all
}
