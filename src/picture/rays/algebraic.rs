//! Rays that meet set expressions of polynomials: the roots on each ray, in place of a search among boxes. The hits are those of the search.

use rayon::prelude::*;

use super::{Aim, Caster, Frustum, Hit, Hits, Scene, Tile, Tiles, search_on};
use crate::interrupt::{Cancelled, Interrupt};
use crate::surface::boxes::{Block, Lattice};
use crate::surface::sampler::{Counters, Sampler};
use crate::vm::along::{Along, LANES, Scratch};
use crate::vm::{Precision, Shape};

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
        let points = caster.by_roots(along, sampler, scratch);
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
    fn by_roots(&mut self, along: &Along, sampler: &mut Sampler, scratch: &mut Scratch) -> u64 {
        self.prepare();
        let looking: Vec<usize> = (0..self.rays.len()).filter(|&k| self.rays[k].enter < self.rays[k].leave).collect();
        let mut found = Vec::new();
        for rays in looking.chunks(LANES) {
            let ends: Vec<([f64; 3], [f64; 3])> = rays.iter().map(|&ray| self.middle(ray)).collect();
            let mut first = [None; LANES];
            along.first(scratch, &ends, &mut first[..rays.len()]);
            for (&ray, first) in rays.iter().zip(first) {
                match first {
                    Some(t) if t <= -1.0 => self.hits[ray] = Some(self.rays[ray].cap()),
                    Some(t) => {
                        let (enter, leave) = (self.rays[ray].enter, self.rays[ray].leave);
                        found.push((ray, 0.5 * (enter + leave) + t * (0.5 * (leave - enter))));
                    }
                    None => {}
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
        let nothing = Hits { places: Vec::new(), hits: Vec::<Option<Hit>>::new() };
        self.hand_over(&if is_empty { nothing } else { Hits { places, hits } });
        looking.len() as u64
    }

    /// The middle of a ray's part in the space, and half of that part.
    fn middle(&self, ray: usize) -> ([f64; 3], [f64; 3]) {
        let ray = &self.rays[ray];
        let (middle, half) = (0.5 * (ray.enter + ray.leave), 0.5 * (ray.leave - ray.enter));
        let start = std::array::from_fn(|k| ray.start[k] + middle * ray.direction[k]);
        (start, ray.direction.map(|d| half * d))
    }
}
