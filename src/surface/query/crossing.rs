//! Where two boundaries meet: curves of two solids, points of two plane figures. The second function's signs at the vertices of the first boundary
//! say where, and Newton's method puts each point on both. What is smaller than a cell may be missed.

use std::fmt;
use std::sync::Arc;

use rustc_hash::FxHashMap;

use super::Conditions;
use super::climb::norm;
use super::nearest::solved;
use crate::field::{Coordinate, Graph, NodeId};
use crate::interrupt::{Cancelled, Interrupt};
use crate::limits::Limits;
use crate::surface::contour::outlines;
use crate::surface::grid::Grid;
use crate::surface::marching::{SurfaceError, extract};
use crate::vm::{CompileError, Demand, Gradients, Points, Program, Shape};

/// Steps of Newton's method.
const STEPS: usize = 30;
/// How near a point must be brought to both boundaries, as a part of a cell.
const NEAR: f64 = 1e-9;
/// Points evaluated at a time.
const BATCH: usize = 4096;

/// Why there are no curves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CurveError {
    /// There is no boundary to begin with.
    Surface(SurfaceError),
    /// A function cannot be compiled.
    Compile(CompileError),
}

impl fmt::Display for CurveError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Surface(error) => error.fmt(f),
            Self::Compile(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for CurveError {}

impl From<SurfaceError> for CurveError {
    fn from(error: SurfaceError) -> Self {
        Self::Surface(error)
    }
}

impl From<Cancelled> for CurveError {
    fn from(cancelled: Cancelled) -> Self {
        Self::Surface(cancelled.into())
    }
}

impl From<CompileError> for CurveError {
    fn from(error: CompileError) -> Self {
        Self::Compile(error)
    }
}

/// The curves in which the boundaries of two solids meet within a grid, as polylines; the first point of a closed one is its last as well.
///
/// # Errors
/// See [`CurveError`].
pub fn curves(
    graph: &Graph,
    [a, b]: [NodeId; 2],
    (axes, grid): (&[Coordinate], &Grid),
    limits: &Limits,
    interrupt: &Interrupt,
) -> Result<Vec<Vec<Vec<f64>>>, CurveError> {
    let shape = Shape::new(Program::compile(graph, a, axes, Demand::Sign, limits)?, 3, Vec::new());
    let extraction = extract(&shape, grid, limits, interrupt)?;
    let mut pair = Pair::of(graph, [a, b], axes, grid, (limits, interrupt))?;
    let positions: Vec<Vec<f64>> = extraction.mesh.positions.iter().map(|p| p.to_vec()).collect();
    let values = pair.second(&positions)?;
    let mut links = Links::default();
    for &[p, q, r] in &extraction.mesh.triangles[..extraction.own] {
        let crossed = |&(a, b): &(u32, u32)| (values[a as usize] >= 0.0) != (values[b as usize] >= 0.0);
        let mut sides = [(p, q), (q, r), (r, p)].into_iter().filter(crossed);
        if let (Some(from), Some(to)) = (sides.next(), sides.next()) {
            links.join(from, to);
        }
    }
    let mut all = Vec::new();
    for (line, is_closed) in links.lines() {
        interrupt.tick()?;
        let on = |&(a, b): &(u32, u32)| {
            let [a, b] = [a as usize, b as usize];
            pair.on_both(&between((&positions[a], values[a]), (&positions[b], values[b])))
        };
        let mut points: Vec<Vec<f64>> = line.iter().filter_map(on).collect();
        points.dedup();
        if points.len() > 1 {
            if is_closed && points.first() != points.last() {
                points.push(points[0].clone());
            }
            all.push(points);
        }
    }
    Ok(all)
}

/// The points in which the outlines of two plane figures meet within a grid.
///
/// # Errors
/// See [`CurveError`].
pub fn crossings(
    graph: &Graph,
    [a, b]: [NodeId; 2],
    (axes, grid): (&[Coordinate], &Grid),
    limits: &Limits,
    interrupt: &Interrupt,
) -> Result<Vec<Vec<f64>>, CurveError> {
    let shape = Shape::new(Program::compile(graph, a, axes, Demand::Sign, limits)?, 2, Vec::new());
    let contour = outlines(&shape, grid, limits, interrupt)?;
    let mut pair = Pair::of(graph, [a, b], axes, grid, (limits, interrupt))?;
    let on_edge = |p: &[f64]| (0..2).any(|d| p[d] <= grid.lo[d] || p[d] >= grid.hi[d]);
    let mut all = Vec::new();
    for line in &contour.lines {
        let points: Vec<Vec<f64>> = line.iter().map(|p| p.to_vec()).collect();
        let values = pair.second(&points)?;
        for i in 0..points.len() {
            let next = (i + 1) % points.len();
            let closes = on_edge(&points[i]) && on_edge(&points[next]);
            if !closes && (values[i] >= 0.0) != (values[next] >= 0.0) {
                let middle = between((&points[i], values[i]), (&points[next], values[next]));
                all.extend(pair.on_both(&middle));
            }
        }
    }
    all.dedup();
    Ok(all)
}

/// Where a function that is linear between two points is 0.
fn between((p, at_p): (&[f64], f64), (q, at_q): (&[f64], f64)) -> Vec<f64> {
    let share = at_p / (at_p - at_q);
    let share = if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.5 };
    p.iter().zip(q).map(|(a, b)| a + share * (b - a)).collect()
}

/// Two functions whose zeros are wanted at once.
struct Pair<'a> {
    programs: [Arc<Program>; 2],
    gradients: Gradients,
    /// Length of a cell's diagonal.
    cell: f64,
    interrupt: &'a Interrupt,
}

impl<'a> Pair<'a> {
    fn of(
        graph: &Graph,
        objects: [NodeId; 2],
        axes: &[Coordinate],
        grid: &Grid,
        (limits, interrupt): (&Limits, &'a Interrupt),
    ) -> Result<Self, CompileError> {
        let program = |object: NodeId| {
            let mut conditions = Conditions::over(axes, limits);
            conditions.inside(graph, object)?;
            conditions.whole()
        };
        let programs = [program(objects[0])?, program(objects[1])?];
        let cell = norm(&grid.cell()[..axes.len()]);
        Ok(Self { programs, gradients: Gradients::heeding(interrupt), cell, interrupt })
    }

    /// The second function at points.
    fn second(&self, points: &[Vec<f64>]) -> Result<Vec<f64>, Cancelled> {
        let mut evaluator = Points::<f64>::heeding(self.interrupt);
        let mut values = vec![0.0; points.len()];
        for (points, values) in points.chunks(BATCH).zip(values.chunks_mut(BATCH)) {
            self.interrupt.tick()?;
            let axes = self.programs[1].inputs().len();
            let columns: Vec<Vec<f64>> = (0..axes).map(|axis| points.iter().map(|p| p[axis]).collect()).collect();
            let slices: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
            evaluator.eval(&self.programs[1], &slices, values);
        }
        Ok(values)
    }

    /// The nearest point on both boundaries, if one is not far.
    fn on_both(&mut self, from: &[f64]) -> Option<Vec<f64>> {
        let mut point = from.to_vec();
        let mut before = f64::INFINITY;
        for _ in 0..STEPS {
            let faces = [0, 1].map(|i| self.slope(i, &point));
            let off = faces.iter().map(|(value, slope)| (value / norm(slope)).abs()).fold(0.0, f64::max);
            // As near as rounding lets it come.
            if off <= NEAR * self.cell && off >= 0.5 * before {
                break;
            }
            before = off;
            if off == 0.0 {
                break;
            }
            let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
            let row = |(value, slope): &(f64, Vec<f64>)| vec![dot(slope, &faces[0].1), dot(slope, &faces[1].1), -value];
            let weights = solved(faces.iter().map(row).collect())?;
            for (axis, c) in point.iter_mut().enumerate() {
                *c += weights[0] * faces[0].1[axis] + weights[1] * faces[1].1[axis];
            }
            let moved: Vec<f64> = point.iter().zip(from).map(|(a, b)| a - b).collect();
            if norm(&moved) > 2.0 * self.cell || !norm(&moved).is_finite() {
                return None;
            }
        }
        (before <= NEAR * self.cell).then_some(point)
    }

    fn slope(&mut self, which: usize, point: &[f64]) -> (f64, Vec<f64>) {
        let columns: Vec<[f64; 1]> = point.iter().map(|&c| [c]).collect();
        let slices: Vec<&[f64]> = columns.iter().map(<[f64; 1]>::as_slice).collect();
        let by: Vec<usize> = (0..point.len()).collect();
        let (mut value, mut store) = ([0.0], vec![[0.0]; point.len()]);
        let mut slopes: Vec<&mut [f64]> = store.iter_mut().map(<[f64; 1]>::as_mut_slice).collect();
        self.gradients.eval(&self.programs[which], &slices, &by, &mut value, &mut slopes);
        (value[0], store.into_iter().map(|[slope]| slope).collect())
    }
}

/// An edge of a mesh, its smaller vertex first.
type Edge = (u32, u32);

/// Edges that follow each other on a curve.
#[derive(Default)]
struct Links {
    edges: Vec<Edge>,
    known: FxHashMap<Edge, usize>,
    /// The one or two neighbours of each edge.
    next: Vec<[Option<usize>; 2]>,
}

impl Links {
    fn place(&mut self, (a, b): Edge) -> usize {
        let edge = (a.min(b), a.max(b));
        *self.known.entry(edge).or_insert_with(|| {
            self.edges.push(edge);
            self.next.push([None; 2]);
            self.edges.len() - 1
        })
    }

    fn join(&mut self, from: Edge, to: Edge) {
        let (from, to) = (self.place(from), self.place(to));
        for (at, other) in [(from, to), (to, from)] {
            if let Some(free) = self.next[at].iter_mut().find(|slot| slot.is_none()) {
                *free = Some(other);
            }
        }
    }

    /// The chains of edges, and whether each is closed; those with ends first.
    fn lines(&self) -> Vec<(Vec<Edge>, bool)> {
        let mut seen = vec![false; self.edges.len()];
        let ends = (0..self.edges.len()).filter(|&i| self.next[i][1].is_none());
        let mut all = Vec::new();
        for first in ends.chain(0..self.edges.len()) {
            if seen[first] {
                continue;
            }
            let is_closed = self.next[first][1].is_some();
            let mut line = Vec::new();
            let mut at = Some(first);
            while let Some(i) = at {
                seen[i] = true;
                line.push(self.edges[i]);
                at = self.next[i].iter().flatten().copied().find(|&next| !seen[next]);
            }
            all.push((line, is_closed));
        }
        all
    }
}
