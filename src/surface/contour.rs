//! Outlines of 2-D shapes: closed polylines by marching squares, with the rules of the cubes. Computes no third coordinate.
//!
//! Ambiguous squares separate their inside corners; the modelling space closes what it cuts.

use super::boxes::Lattice;
use super::brick::{Bricks, Leaf};
use super::cap::{Plane, runs, side_vertex};
use super::grid::{Grid, LEAF};
use super::marching::{Report, SurfaceError};
use super::sampler::{Counters, Sampler};
use crate::interrupt::Interrupt;
use crate::limits::Limits;
use crate::reuse::Digest;
use crate::vm::Shape;

/// The outlines of a 2-D shape.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Contour {
    /// Closed polylines (the last point is joined to the first), the inside on the left: outer ones counter-clockwise, holes clockwise.
    pub lines: Vec<Vec<[f64; 2]>>,
    /// What there is to say about it: what it cost, where it was cut.
    pub report: Report,
}

impl Contour {
    /// The area inside.
    #[must_use]
    pub fn area(&self) -> f64 {
        0.5 * self.sides().map(|([a, b], [c, d])| a * d - b * c).sum::<f64>()
    }

    /// The length of all outlines, also along the edges of the modelling space.
    #[must_use]
    pub fn perimeter(&self) -> f64 {
        self.sides().map(|([a, b], [c, d])| (c - a).hypot(d - b)).sum()
    }

    /// Number of outer outlines less holes: the Euler characteristic of the area.
    #[must_use]
    pub fn euler(&self) -> i64 {
        let turns = |line: &Vec<[f64; 2]>| if signed_area(line) > 0.0 { 1 } else { -1 };
        self.lines.iter().map(turns).sum()
    }

    fn sides(&self) -> impl Iterator<Item = ([f64; 2], [f64; 2])> {
        self.lines.iter().flat_map(|line| line.iter().copied().zip(line.iter().copied().cycle().skip(1)))
    }
}

/// Positive where the line turns counter-clockwise.
fn signed_area(line: &[[f64; 2]]) -> f64 {
    let sides = line.iter().zip(line.iter().cycle().skip(1));
    // Relative to one of its points, so that small lines far from the origin keep their sign.
    let [x, y] = line.first().copied().unwrap_or_default();
    0.5 * sides.map(|([a, b], [c, d])| (a - x) * (d - y) - (b - y) * (c - x)).sum::<f64>()
}

/// Finds the outlines of a 2-D shape on a 2-D grid. Runs on the current rayon pool; the same result for any number of threads.
///
/// # Errors
/// See [`SurfaceError`].
pub fn outlines(shape: &Shape, grid: &Grid, limits: &Limits, interrupt: &Interrupt) -> Result<Contour, SurfaceError> {
    let tell = |to: &mut Digest| {
        shape.tell(to);
        to.shown(&(grid, limits.memory_bytes));
    };
    let bytes = |of: &Contour| of.lines.iter().map(|line| line.len() * size_of::<[f64; 2]>()).sum();
    interrupt.whole("figures", tell, bytes, || outline(shape, grid, limits, interrupt))
}

fn outline(shape: &Shape, grid: &Grid, limits: &Limits, interrupt: &Interrupt) -> Result<Contour, SurfaceError> {
    if shape.dimension != 2 || grid.dimension() != 2 {
        return Err(SurfaceError::Dimension(shape.dimension, 2));
    }
    let mut bricks = Bricks::survey_bare(shape, grid, limits, interrupt)?;
    let mut report = Report {
        counters: std::mem::take(&mut bricks.counters),
        samples: grid.counts().iter().map(|&n| n as u64).product(),
        full: bricks.is_full(),
        details: std::mem::take(&mut bricks.details),
        ..Report::default()
    };
    let mut tracing = Tracing::new(&bricks);
    tracing.all_squares(interrupt)?;
    report.cut = cut(shape, &bricks, &mut report.counters, interrupt);
    let lines = tracing.lines();
    Ok(Contour { lines, report })
}

/// The sides of the space beyond which the figure goes on: with a sample point where the function is above zero.
fn cut(shape: &Shape, bricks: &Bricks, counters: &mut Counters, interrupt: &Interrupt) -> [[bool; 2]; 3] {
    let cells = bricks.grid.cells;
    let mut sampler = Sampler::new(shape).heeding(interrupt);
    let mut is_cut = |axis: usize, index: usize| {
        let inside = (0..=cells[1 - axis]).map(|along| if axis == 0 { [index, along, 0] } else { [along, index, 0] });
        let inside = inside.filter(|&at| bricks.is_inside(at)).map(|at| bricks.grid.point(at));
        let (x, y): (Vec<f64>, Vec<f64>) = inside.map(|[x, y, _]| (x, y)).unzip();
        let mut values = vec![0.0; x.len()];
        sampler.values(&shape.program, &[&x, &y], &mut values);
        values.iter().any(|&value| value > 0.0)
    };
    let cut = [0, 1].map(|axis| [is_cut(axis, 0), is_cut(axis, cells[axis])]);
    counters.add(sampler.take_counters());
    [cut[0], cut[1], [false; 2]]
}

/// No next vertex.
const NONE: u32 = u32::MAX;

/// Every vertex of an outline has one that follows it.
struct Tracing<'a> {
    bricks: &'a Bricks,
    next: Vec<u32>,
    points: Vec<[f64; 2]>,
}

impl<'a> Tracing<'a> {
    /// Vertices are first those on crossed edges, then the sample points on the border of the space, going round.
    fn new(bricks: &'a Bricks) -> Self {
        let mut points: Vec<[f64; 2]> = bricks.positions.iter().map(|p| [p[0], p[1]]).collect();
        let [w, h, _] = bricks.grid.cells;
        let bottom = (0..w).map(|i| [i, 0]);
        let right = (0..h).map(|j| [w, j]);
        let top = (1..=w).rev().map(|i| [i, h]);
        let left = (1..=h).rev().map(|j| [0, j]);
        let ring = bottom.chain(right).chain(top).chain(left);
        points.extend(ring.map(|[i, j]| [bricks.grid.coordinate(0, i), bricks.grid.coordinate(1, j)]));
        Self { bricks, next: vec![NONE; points.len()], points }
    }

    /// The vertex at a sample point on the border.
    fn border(&self, [i, j, _]: [usize; 3]) -> usize {
        let [w, h, _] = self.bricks.grid.cells;
        let round = if j == 0 && i < w {
            i
        } else if i == w && j < h {
            w + j
        } else if j == h && i > 0 {
            w + h + (w - i)
        } else {
            2 * w + h + (h - j)
        };
        self.bricks.positions.len() + round
    }

    fn all_squares(&mut self, interrupt: &Interrupt) -> Result<(), SurfaceError> {
        let (grid, leaves) = (self.bricks.grid, self.bricks.grid.leaves());
        for v in 0..leaves[1] {
            interrupt.tick()?;
            for u in 0..leaves[0] {
                let is_border = u == 0 || v == 0 || (u + 2) >= leaves[0] || (v + 2) >= leaves[1];
                let is_needed = match self.bricks.leaf([u, v, 0]) {
                    Leaf::Outside => false,
                    Leaf::Inside => is_border,
                    Leaf::Mixed(_) => true,
                };
                if !is_needed {
                    continue;
                }
                for j in v * LEAF..((v + 1) * LEAF).min(grid.cells[1]) {
                    for i in u * LEAF..((u + 1) * LEAF).min(grid.cells[0]) {
                        self.square(i, j)?;
                    }
                }
            }
        }
        Ok(())
    }

    fn square(&mut self, i: usize, j: usize) -> Result<(), SurfaceError> {
        let ring = Plane::flat().ring(i, j);
        let inside = ring.map(|corner| self.bricks.is_inside(corner));
        let [w, h, _] = self.bricks.grid.cells;
        let is_border = [j == 0, i + 1 == w, j + 1 == h, i == 0];
        if inside != [true; 4] {
            for (first, length) in runs(inside) {
                let last = first + length - 1;
                let enters = side_vertex(self.bricks, ring[(first + 3) % 4], ring[first])?;
                let leaves = side_vertex(self.bricks, ring[last % 4], ring[(last + 1) % 4])?;
                self.next[leaves as usize] = enters;
            }
        }
        for side in (0..4).filter(|&side| is_border[side]) {
            let (a, b) = (side, (side + 1) % 4);
            match (inside[a], inside[b]) {
                (true, true) => self.join(self.border(ring[a]), self.border(ring[b])),
                (true, false) => self.join(self.border(ring[a]), side_vertex(self.bricks, ring[a], ring[b])? as usize),
                (false, true) => self.join(side_vertex(self.bricks, ring[a], ring[b])? as usize, self.border(ring[b])),
                (false, false) => {}
            }
        }
        Ok(())
    }

    fn join(&mut self, from: usize, to: usize) {
        self.next[from] = to as u32;
    }

    /// Follows the vertices round, from the one with the smallest number.
    fn lines(mut self) -> Vec<Vec<[f64; 2]>> {
        let mut lines = Vec::new();
        for start in 0..self.next.len() {
            let (mut line, mut at) = (Vec::new(), start);
            while self.next[at] != NONE {
                line.push(self.points[at]);
                at = std::mem::replace(&mut self.next[at], NONE) as usize;
            }
            if !line.is_empty() {
                lines.push(line);
            }
        }
        lines
    }
}
