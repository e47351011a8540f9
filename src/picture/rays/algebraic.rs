//! Rays that meet set expressions of polynomials: the roots on each ray, in place of a search among boxes. The hits are those of the search.

use rayon::prelude::*;

use super::{Aim, Caster, Frustum, Hits, Ray, Scene, Tile, Tiles, search_on};
use crate::interrupt::{Cancelled, Interrupt};
use crate::number::Interval;
use crate::surface::boxes::{Block, Lattice};
use crate::surface::sampler::{Counters, Sampler};
use crate::vm::along::{Along, LANES, Rows};
use crate::vm::interval::LANES as BOXES;
use crate::vm::{Boxes, Precision, Shape};

/// Boxes behind one another that a tile is looked at by.
const SLICES: usize = 4;

/// What a thread keeps.
#[derive(Default)]
struct Scratch {
    rows: Rows,
    boxes: Boxes,
}

/// Casts the rays that are wanted, as a part of a task whose progress was begun already: by roots where the object is a set expression of
/// polynomials, else by a search.
///
/// # Errors
/// [`Cancelled`] soon after the interrupt was set.
pub fn cast_on<T: Send>(
    shape: &Shape,
    scene: &Scene,
    aim: Aim<'_>,
    finish: impl Fn(Tile<'_>) -> T + Sync,
    interrupt: &Interrupt,
) -> Result<Tiles<T>, Cancelled> {
    match polynomials(shape) {
        Some(along) => cast((shape, &along), scene, aim, &finish, interrupt),
        None => search_on(shape, scene, aim, finish, interrupt),
    }
}

/// The shape as polynomials along rays, if it is such.
fn polynomials(shape: &Shape) -> Option<Along> {
    if shape.precision == Precision::Single || shape.dimension != 3 {
        return None;
    }
    Along::of(&shape.program, &shape.fixed)
}

/// Casts the rays by roots.
fn cast<T: Send, F: Fn(Tile<'_>) -> T + Sync>(
    (shape, along): (&Shape, &Along),
    scene: &Scene,
    aim: Aim<'_>,
    finish: &F,
    interrupt: &Interrupt,
) -> Result<Tiles<T>, Cancelled> {
    let frustum = Frustum::new(*scene);
    let [columns, rows, depth] = frustum.counts();
    let side = 4 * scene.tile;
    let from: Vec<[usize; 2]> =
        (0..rows).step_by(side).flat_map(|j| (0..columns).step_by(side).map(move |i| [i, j])).collect();
    let task = |(sampler, scratch): &mut (Sampler, Scratch), &[i, j]: &[usize; 2]| {
        interrupt.tick()?;
        let block = Block { from: [i, j, 0], to: [(i + side).min(columns), (j + side).min(rows), depth] };
        let mut caster = Caster::new(&frustum, (shape, aim), &block, finish, false);
        let points = caster.by_roots(along, sampler, scratch, &block);
        interrupt.advance(block.points());
        let mut counters = sampler.take_counters();
        counters.points += points;
        Ok((caster.from, caster.size, caster.result, counters))
    };
    let start = || (Sampler::new(shape).heeding(interrupt), Scratch::default());
    let done: Vec<_> = from.par_iter().map_init(start, task).collect::<Result<_, Cancelled>>()?;
    let mut counters = Counters::default();
    let mut tiles = Vec::with_capacity(done.len());
    for (from, size, result, cost) in done {
        counters.add(cost);
        tiles.extend(result.map(|result| (from, size, result)));
    }
    Ok((tiles, counters))
}

impl<T, F: Fn(Tile<'_>) -> T> Caster<'_, T, F> {
    /// The hits of all rays of the task, handed over; how many rays were looked along.
    fn by_roots(&mut self, along: &Along, sampler: &mut Sampler, scratch: &mut Scratch, block: &Block) -> u64 {
        let live = self.live(block, &mut scratch.boxes);
        let nothing = Hits { places: Vec::new(), hits: Vec::new() };
        if !live.contains(&true) {
            self.hand_over(&nothing);
            return 0;
        }
        self.prepare();
        let tiles = self.tiles.iter().zip(live).filter(|(_, live)| *live).flat_map(|(rays, _)| rays.iter().copied());
        let looking: Vec<usize> = tiles.filter(|&k| self.rays[k].enter < self.rays[k].leave).collect();
        let mut found = Vec::new();
        for rays in looking.chunks(LANES) {
            let mut first = [f64::NAN; LANES];
            along.first(&mut scratch.rows, rays.iter().map(|&ray| self.middle(ray)), &mut first);
            for (&ray, t) in rays.iter().zip(first) {
                let Ray { enter, leave, .. } = self.rays[ray];
                if t <= -1.0 {
                    self.hits[ray] = Some(self.rays[ray].cap());
                } else if t < 1.0 {
                    found.push((ray, 0.5 * (enter + leave) + t * (0.5 * (leave - enter))));
                }
            }
        }
        if !found.is_empty() {
            let program = self.shape.program.clone();
            self.normals(&found, &program, sampler);
        }
        self.mend();
        let is_empty = self.hits.iter().all(Option::is_none);
        let (places, hits) = (std::mem::take(&mut self.places), std::mem::take(&mut self.hits));
        self.hand_over(&if is_empty { nothing } else { Hits { places, hits } });
        looking.len() as u64
    }

    /// Which of the smallest tiles may see the object, row by row: for each, boxes behind one another over the whole depth.
    fn live(&self, block: &Block, boxes: &mut Boxes) -> Vec<bool> {
        let (tile, [.., to]) = (self.frustum.scene.tile, [block.from[2], block.to[2]]);
        let slice = to.div_ceil(SLICES).max(1);
        let starts = |k: usize| (block.from[k]..block.to[k]).step_by(tile);
        let tiles: Vec<[usize; 2]> = starts(1).flat_map(|j| starts(0).map(move |i| [i, j])).collect();
        let mut live = vec![false; tiles.len()];
        let inputs = self.shape.program.inputs().len();
        let mut ranges = vec![[Interval::point(0.0); BOXES]; inputs];
        ranges[3..].iter_mut().zip(&self.shape.fixed).for_each(|(range, &v)| *range = [Interval::point(v); BOXES]);
        for (tiles, live) in tiles.chunks(BOXES / SLICES).zip(live.chunks_mut(BOXES / SLICES)) {
            let mut count = 0;
            for &[i, j] in tiles {
                for depth in 0..SLICES {
                    let ends = [depth, depth + 1].map(|at| (at * slice).min(to));
                    let [right, below] = [(i + tile).min(block.to[0]), (j + tile).min(block.to[1])];
                    let part = Block { from: [i, j, ends[0]], to: [right, below, ends[1]] };
                    let mut bounds = [Interval::point(0.0); 3];
                    self.frustum.bounds(&part, &mut bounds);
                    ranges.iter_mut().zip(bounds).for_each(|(range, bounds)| range[count] = bounds);
                    count += 1;
                }
            }
            let slices: Vec<&[Interval]> = ranges.iter().map(|range| &range[..count]).collect();
            let mut out = [Interval::point(0.0); BOXES];
            boxes.eval(&self.shape.program, &slices, &mut out[..count]);
            let is_open = |value: &Interval| value.hi >= 0.0 || value.hi.is_nan();
            live.iter_mut().zip(out.chunks(SLICES)).for_each(|(live, slices)| *live = slices.iter().any(is_open));
        }
        live
    }

    /// The middle of a ray's part in the space, and half of that part.
    fn middle(&self, ray: usize) -> ([f64; 3], [f64; 3]) {
        let ray = &self.rays[ray];
        let (middle, half) = (0.5 * (ray.enter + ray.leave), 0.5 * (ray.leave - ray.enter));
        let start = std::array::from_fn(|k| ray.start[k] + middle * ray.direction[k]);
        (start, ray.direction.map(|d| half * d))
    }
}
