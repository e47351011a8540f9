//! Rays that meet set expressions of polynomials: the roots on each ray, in place of a search among boxes. The hits are those of the search.

use rayon::prelude::*;

use super::lanes::{Lanes, aim, normals};
use super::{Aim, Caster, Frustum, Hit, Hits, Scene, Space, Tile, Tiles, search_on};
use crate::interrupt::{Cancelled, Interrupt};
use crate::number::Interval;
use crate::surface::boxes::{Block, Lattice};
use crate::surface::sampler::{Counters, Sampler};
use crate::vm::along::{Along, LANES, Rows};
use crate::vm::interval::LANES as BOXES;
use crate::vm::{Boxes, Precision, Program, Shape};

/// Boxes behind one another that a tile is looked at by.
const SLICES: usize = 4;

/// What a thread keeps.
#[derive(Default)]
struct Scratch {
    rows: Rows,
    boxes: Boxes,
    lanes: Lanes,
    looking: Vec<usize>,
    found: Found,
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
        if !live.contains(&true) {
            self.hand_over(&Hits { places: Vec::new(), hits: Vec::new() });
            return 0;
        }
        self.place();
        self.hits.resize(self.places.len(), None);
        self.look_towards(&live, &mut scratch.looking);
        scratch.found.clear();
        for rays in scratch.looking.chunks(LANES) {
            let mut places = [[0.0; LANES]; 2];
            for lane in 0..LANES {
                let place = self.places[rays[lane.min(rays.len() - 1)]];
                (places[0][lane], places[1][lane]) = (place[0], place[1]);
            }
            aim(&self.frustum.scene, &places, &mut scratch.lanes);
            let (start, change) = scratch.lanes.through();
            let mut first = [f64::NAN; LANES];
            along.first(&mut scratch.rows, &start, &change, &mut first);
            for (lane, &ray) in rays.iter().enumerate().filter(|&(lane, _)| scratch.lanes.half[lane] > 0.0) {
                if first[lane] <= -1.0 {
                    self.hits[ray] = Some(self.frustum.ray(self.places[ray]).cap());
                } else if first[lane] < 1.0 {
                    scratch.found.push(ray, lane, first[lane], &scratch.lanes, &self.frustum.scene.space);
                }
            }
        }
        let slopes = scratch.found.slopes(&self.shape.program, sampler, self.aim.normals);
        if self.note(&scratch.found, &slopes) {
            self.rays.extend(self.places.iter().map(|&place| self.frustum.ray(place)));
            self.mend();
        }
        let is_empty = self.hits.iter().all(Option::is_none);
        let (places, hits) = (std::mem::take(&mut self.places), std::mem::take(&mut self.hits));
        self.hand_over(&if is_empty { Hits { places: Vec::new(), hits: Vec::new() } } else { Hits { places, hits } });
        scratch.looking.len() as u64
    }

    /// Lists the rays through live tiles, tile by tile of a row.
    fn look_towards(&self, live: &[bool], looking: &mut Vec<usize>) {
        let tile = self.frustum.scene.tile;
        let across = self.size[0].div_ceil(tile);
        // A corner at the right or the lower edge belongs to the last cell before it.
        let tiles = |k: usize| (0..=self.size[k]).map(|cell| cell.min(self.size[k] - 1) / tile).collect::<Vec<_>>();
        let (columns, rows) = (tiles(0), tiles(1));
        let is_live = |&ray: &usize| {
            let cell = |k: usize| self.places[ray][k] as usize - self.from[k];
            live[rows[cell(1)] * across + columns[cell(0)]]
        };
        looking.clear();
        looking.extend((0..self.places.len()).filter(is_live));
    }

    /// Makes hits of what was found; whether some of their normals are undefined.
    fn note(&mut self, found: &Found, slopes: &[Vec<f64>; 3]) -> bool {
        let mut lacks = false;
        for (chunk, rays) in found.rays.chunks(LANES).enumerate() {
            let range = chunk * LANES..chunk * LANES + rays.len();
            let (mut gradients, mut directions) = ([[0.0; LANES]; 3], [[0.0; LANES]; 3]);
            for k in 0..3 {
                gradients[k][..rays.len()].copy_from_slice(&slopes[k][range.clone()]);
                directions[k][..rays.len()].copy_from_slice(&found.directions[k][range.clone()]);
            }
            normals(&mut gradients, &directions);
            for (lane, &ray) in rays.iter().enumerate() {
                let normal = [gradients[0][lane], gradients[1][lane], gradients[2][lane]];
                lacks |= normal[0].is_nan();
                self.hits[ray] = Some(Hit { depth: found.depths[range.start + lane], normal, cap: false });
            }
        }
        lacks
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
}

/// The hits of a task before they have normals.
#[derive(Default)]
struct Found {
    rays: Vec<usize>,
    depths: Vec<f64>,
    points: [Vec<f64>; 3],
    directions: [Vec<f64>; 3],
}

impl Found {
    fn clear(&mut self) {
        self.rays.clear();
        self.depths.clear();
        self.points.iter_mut().chain(&mut self.directions).for_each(Vec::clear);
    }

    /// Adds a ray that hits at a part of its way through the space, from -1 to 1.
    fn push(&mut self, ray: usize, lane: usize, part: f64, lanes: &Lanes, space: &Space) {
        let depth = lanes.middle[lane] + part * lanes.half[lane];
        self.rays.push(ray);
        self.depths.push(depth);
        for k in 0..3 {
            let (start, direction) = (lanes.start[k][lane], lanes.direction[k][lane]);
            self.points[k].push((start + depth * direction).clamp(space.lo[k], space.hi[k]));
            self.directions[k].push(direction);
        }
    }

    /// The gradients of a program where the rays hit, or, if none are wanted, the rays' directions.
    fn slopes(&self, program: &Program, sampler: &mut Sampler, wanted: bool) -> [Vec<f64>; 3] {
        if !wanted {
            return self.directions.clone();
        }
        let count = self.rays.len();
        let (mut values, mut slopes) = (vec![0.0; count], [0; 3].map(|_| vec![0.0; count]));
        if count > 0 {
            let ([x, y, z], [sx, sy, sz]) = (&self.points, &mut slopes);
            sampler.slopes(program, &[x, y, z], &mut values, &mut [sx, sy, sz]);
        }
        slopes
    }
}
