//! Corners in outlines: where an outline goes over from one piece of the function to another, the point in which they meet is put between.
//! Moves none of its points.

use rayon::prelude::*;
use rustc_hash::FxHashMap;

use super::super::contour::{Contour, outlines};
use super::super::grid::Grid;
use super::super::marching::SurfaceError;
use super::super::sampler::{Counters, Sampler};
use super::patches::Cells;
use super::solve::{Local, Meeting, Scale, meet};
use super::study::trace;
use super::{Plain, Sharpened, leaf_of, survey};
use crate::interrupt::Interrupt;
use crate::limits::Limits;
use crate::vm::{Pieces, Precision, Program, Shape};

/// Surfaces between those of the ends of a side, one within the other.
const DEPTH: usize = 3;
/// How far from its side a corner may lie, in cells.
const REACH: f64 = 8.0;

/// Finds the outlines of a 2-D shape on a 2-D grid, with their corners if they are to be `sharp`. The same result for any number of threads.
///
/// # Errors
/// See [`SurfaceError`].
pub fn outlines_as(
    shape: &Shape,
    grid: &Grid,
    sharp: bool,
    limits: &Limits,
    interrupt: &Interrupt,
) -> Result<Contour, SurfaceError> {
    let mut contour = outlines(shape, grid, limits, interrupt)?;
    if sharp {
        let sharpened = sharpen(&mut contour, shape, grid, interrupt)?;
        contour.report.sharpened = Some(sharpened);
    }
    Ok(contour)
}

/// A side of an outline, by the numbers of the line and of the point where it begins.
type Side = (usize, usize);

/// What is found between the ends of a side.
struct Found {
    side: Side,
    corners: Vec<[f64; 2]>,
    /// Why they are not put there.
    failed: Option<Plain>,
}

fn sharpen(
    contour: &mut Contour,
    shape: &Shape,
    grid: &Grid,
    interrupt: &Interrupt,
) -> Result<Sharpened, SurfaceError> {
    let _phase = interrupt.phase("corners");
    let shape = &Shape { precision: Precision::Double, ..shape.clone() };
    if Pieces::is_smooth(&shape.program) {
        return Ok(Sharpened::default());
    }
    let cells = Cells::of(grid);
    let leaves = grid.leaves().iter().product();
    let (mut sides, mut wanted) = (vec![Vec::new(); leaves], vec![false; leaves]);
    for (number, line) in contour.lines.iter().enumerate() {
        for (i, (a, b)) in line.iter().zip(line.iter().cycle().skip(1)).enumerate() {
            let along = |d: usize| cells.along(d, 0.5 * (a[d] + b[d]));
            let leaf = leaf_of(grid, [along(0), along(1), 0]);
            sides[leaf].push((number, i));
            wanted[leaf] = true;
        }
    }
    let (works, counters) = survey(&wanted, shape, grid, interrupt)?;
    contour.report.counters.add(counters);
    let lines = &contour.lines;
    let corners = || Corners {
        grid,
        shape,
        scale: Scale::of(grid),
        sampler: Sampler::new(shape).heeding(interrupt),
        tracer: Pieces::heeding(interrupt),
    };
    let found: Vec<(Vec<Found>, Counters)> = works
        .par_iter()
        .map_init(corners, |corners, (leaf, program)| {
            interrupt.tick()?;
            let found = corners.of(program, lines, &sides[*leaf]);
            Ok((found, corners.sampler.take_counters()))
        })
        .collect::<Result<_, SurfaceError>>()?;
    let mut all = Vec::new();
    for (found, counters) in found {
        contour.report.counters.add(counters);
        all.extend(found);
    }
    let mut sharpened = Sharpened::default();
    let mut between: FxHashMap<Side, &Found> = FxHashMap::default();
    for found in &all {
        match found.failed {
            Some(reason) => sharpened.plain[reason as usize] += 1,
            None => {
                sharpened.cells += 1;
                sharpened.vertices += found.corners.len();
                between.insert(found.side, found);
            }
        }
    }
    let mut lines = Vec::with_capacity(contour.lines.len());
    for (number, line) in contour.lines.iter().enumerate() {
        let mut longer = Vec::with_capacity(line.len());
        for (i, &point) in line.iter().enumerate() {
            longer.push(point);
            longer.extend(between.get(&(number, i)).iter().flat_map(|found| &found.corners));
        }
        lines.push(longer);
    }
    let torn = torn(&lines, &all, 4.0 * Scale::of(grid).near);
    for found in all.iter().filter(|found| torn.contains(&found.side.0)) {
        match found.failed {
            Some(reason) => sharpened.plain[reason as usize] -= 1,
            None => {
                sharpened.cells -= 1;
                sharpened.vertices -= found.corners.len();
            }
        }
    }
    sharpened.torn = torn.len();
    let kept = lines.into_iter().enumerate().filter(|(number, _)| !torn.contains(number));
    contour.lines = kept.map(|(_, line)| line).collect();
    Ok(sharpened)
}

/// The lines that sampling tore off the tip of another, which has its tip again: a side where two pieces meet behind it, in a
/// corner of the other line, and no point outside that.
fn torn(lines: &[Vec<[f64; 2]>], all: &[Found], near: f64) -> Vec<usize> {
    let behind = all.iter().filter(|found| found.failed == Some(Plain::Crowded));
    let mut torn: Vec<usize> = Vec::new();
    for found in behind {
        let number = found.side.0;
        let is_same = |[a, b]: &[f64; 2]| found.corners.iter().any(|[c, d]| (a - c).hypot(b - d) <= near);
        let is_other = |other: &&Found| {
            let line = other.side.0;
            let is_whole = !all.iter().any(|of| of.side.0 == line && of.failed == Some(Plain::Crowded));
            other.failed.is_none() && line != number && is_whole && other.corners.iter().any(is_same)
        };
        let Some(other) = all.iter().find(is_other) else { continue };
        let line = &lines[number];
        let middle = [0, 1].map(|d| line.iter().map(|point| point[d]).sum::<f64>() / line.len() as f64);
        let within =
            |point: &[f64; 2]| holds(&lines[other.side.0], [0, 1].map(|d| 0.999 * point[d] + 0.001 * middle[d]));
        if !torn.contains(&number) && line.iter().all(within) {
            torn.push(number);
        }
    }
    torn
}

/// Whether a point lies within a closed line.
fn holds(line: &[[f64; 2]], [x, y]: [f64; 2]) -> bool {
    let sides = line.iter().zip(line.iter().cycle().skip(1));
    let crossed = sides.filter(|([a, b], [c, d])| (b > &y) != (d > &y) && x < (c - a) * (y - b) / (d - b) + a);
    crossed.count() % 2 == 1
}

/// A corner, and the normals of the pieces before and behind it.
struct Turn {
    at: [f64; 3],
    normals: [[f64; 3]; 2],
}

/// The parts of one thread.
struct Corners<'a> {
    grid: &'a Grid,
    shape: &'a Shape,
    scale: Scale,
    sampler: Sampler,
    tracer: Pieces,
}

impl Corners<'_> {
    /// What is found on the sides in one leaf; nothing of those that cross no crease.
    fn of(&mut self, program: &Program, lines: &[Vec<[f64; 2]>], sides: &[Side]) -> Vec<Found> {
        let place = |line: usize, i: usize| {
            let [x, y] = lines[line][i % lines[line].len()];
            [x, y, 0.0]
        };
        let places: Vec<[f64; 3]> = sides.iter().flat_map(|&(line, i)| [place(line, i), place(line, i + 1)]).collect();
        let mut pieces = Vec::new();
        let which = trace(&mut self.tracer, self.shape, program, &places, &mut pieces);
        let mut found = Vec::new();
        for (k, &side) in sides.iter().enumerate() {
            let ends = [(places[2 * k], which[2 * k]), (places[2 * k + 1], which[2 * k + 1])];
            if ends[0].1 == ends[1].1 || !self.is_between(ends, &pieces) {
                continue;
            }
            let mut turns = Vec::new();
            match self.cross(ends, &mut pieces, &mut turns, DEPTH) {
                Ok(()) if turns.is_empty() => continue,
                told => {
                    let corners = turns.iter().map(|turn| [turn.at[0], turn.at[1]]).collect();
                    let is_back = !self.is_ahead(ends[0].0, ends[1].0, &turns);
                    let failed = told.err().or(is_back.then_some(Plain::Crowded));
                    found.push(Found { side, corners, failed });
                }
            }
        }
        found
    }

    /// Whether both ends are on the outlines of their own pieces, and neither is on the other's.
    fn is_between(&mut self, ends: [([f64; 3], usize); 2], pieces: &[Program]) -> bool {
        (0..2).all(|k| {
            let [own, other] = [ends[k].1, ends[1 - k].1];
            let mut far = |piece: usize| Local::of(&pieces[piece], ends[k].0, &mut self.sampler).distance();
            far(own) <= 10.0 * self.scale.near && far(other) > self.scale.near
        })
    }

    /// The corners between two points of an outline, each with its piece.
    fn cross(
        &mut self,
        ends: [([f64; 3], usize); 2],
        pieces: &mut Vec<Program>,
        turns: &mut Vec<Turn>,
        depth: usize,
    ) -> Result<(), Plain> {
        let [(a, first), (b, second)] = ends;
        let middle: [f64; 3] = std::array::from_fn(|d| 0.5 * (a[d] + b[d]));
        let pair = [&pieces[first], &pieces[second]];
        let (at, locals) = match meet(&pair, &[middle], None, &self.scale, &mut self.sampler).pop() {
            Some(Meeting::Smooth) => return Ok(()),
            Some(Meeting::At(at, locals)) => (at, locals),
            _ => return Err(Plain::Apart),
        };
        let is_far = self.scale.cells(middle, at).iter().any(|way| way.abs() > REACH);
        if is_far || self.scale.beyond(at, self.grid.dimension()).is_some() {
            return Err(Plain::Outside);
        }
        let value = Local::values(&self.shape.program, &[at], &mut self.sampler)[0];
        if (Local { value, ..locals[0] }).distance() > 4.0 * self.scale.near {
            // Another piece comes between the two.
            if depth == 0 || value.is_nan() || !Pieces::has_branches(&self.shape.program) {
                return Err(Plain::Hidden);
            }
            let program = self.shape.program.clone();
            let third = trace(&mut self.tracer, self.shape, &program, &[at], pieces)[0];
            if third == first || third == second {
                return Err(Plain::Hidden);
            }
            self.cross([(a, first), (at, third)], pieces, turns, depth - 1)?;
            return self.cross([(at, third), (b, second)], pieces, turns, depth - 1);
        }
        turns.push(Turn { at, normals: [locals[0].normal(), locals[1].normal()] });
        Ok(())
    }

    /// Whether the way between two points by way of corners never goes back: the inside is on its left.
    fn is_ahead(&self, from: [f64; 3], to: [f64; 3], turns: &[Turn]) -> bool {
        let goes = |from: [f64; 3], to: [f64; 3], [x, y, _]: [f64; 3]| {
            x * (to[1] - from[1]) - y * (to[0] - from[0]) > -self.scale.near
        };
        let starts = [from].into_iter().chain(turns.iter().map(|turn| turn.at));
        starts.zip(turns).all(|(start, turn)| goes(start, turn.at, turn.normals[0]))
            && turns.last().is_some_and(|last| goes(last.at, to, last.normals[1]))
    }
}
