//! Where the rays of a camera meet an object: boxes of pixels x depth from front to back by intervals, then a bracketed root on each ray
//! of an undecided box. No sphere tracing, so the function need not be a distance. Knows no light and no colour.
//!
//! The modelling space caps the object: a ray that enters the space inside the object hits the face there. What is thinner than a
//! sample spacing along a ray is found where the function has a maximum between samples, as at silhouettes.

mod algebraic;
mod lanes;
mod search;

use std::hash::{Hash, Hasher};
use std::sync::Arc;

use crate::interrupt::{Cancelled, Interrupt};
use crate::reuse::Digest;
use crate::surface::boxes::{Block, Visitor, points};
use crate::surface::memory::Left;
use crate::surface::sampler::{Counters, Sampler};
use crate::vm::{Program, Shape};

pub use algebraic::cast_on;
pub use search::{Met, Seed, search_in, search_on};

use super::camera::Camera;
use super::frustum::{Frustum, Ray};
use super::raycast::Space;
use super::search::{BETWEEN, Bracket, COARSE, ENDS, SAMPLES, Segment, Summit, is_far, is_open};

/// Cells of a picture (its pixels, say) and the space that they look into.
#[derive(Clone, Copy, Debug)]
pub struct Scene {
    /// The camera.
    pub camera: Camera,
    /// The modelling space.
    pub space: Space,
    /// Cells along a row and along a column.
    pub rays: [usize; 2],
    /// Cells along each side of a tile of the smallest size; what is gathered is handed over in multiples of it.
    pub tile: usize,
}

impl Scene {
    /// The start and the change by depth of the ray through a place, in cells from the top left.
    #[must_use]
    pub fn through(&self, place: [f64; 2]) -> ([f64; 3], [f64; 3]) {
        let [u, v] = self.view(place);
        self.camera.ray(u, v)
    }

    /// The place in the camera's view, from -1 to 1.
    #[inline(always)]
    fn view(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let [columns, rows] = self.rays;
        [2.0 * (x / columns as f64) - 1.0, 1.0 - 2.0 * (y / rows as f64)]
    }

    /// What casting rays into it advances the progress by.
    #[must_use]
    pub fn steps(&self) -> u64 {
        points(&Frustum::new(*self))
    }
}

/// Which rays go through the cells.
#[derive(Clone, Copy, Debug)]
pub enum Pattern<'a> {
    /// One through the middle of each.
    Middles,
    /// One through each corner: one more in a row and in a column than cells.
    Corners,
    /// `n` x `n` through each of the cells that are marked, none through the others.
    Shares(usize, &'a [bool]),
}

/// Which rays are cast, and what is asked of them.
#[derive(Clone, Copy, Debug)]
pub struct Aim<'a> {
    /// The rays.
    pub pattern: Pattern<'a>,
    /// How exactly a depth is wanted, as a part of the range of depths.
    pub tolerance: f64,
    /// Whether normals are wanted; else they are those of a plane turned to the eye.
    pub normals: bool,
}

/// Where a ray meets the object.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Depth from the eye, along its direction of view.
    pub depth: f64,
    /// Unit normal, pointing out of the object.
    pub normal: [f64; 3],
    /// Whether it is a face of the modelling space that cuts the object.
    pub cap: bool,
}

/// The hits of a tile of cells.
#[derive(Clone, Copy, Debug)]
pub struct Tile<'a> {
    /// First column and row.
    pub from: [usize; 2],
    /// Columns and rows of cells.
    pub size: [usize; 2],
    /// One entry for each ray: row by row for middles and corners; for shares cell by cell, row by row in each. Empty if no ray of the tile
    /// hits anything.
    pub hits: &'a [Option<Hit>],
    /// The rays' places, in cells from the top left; empty if `hits` is.
    pub places: &'a [[f64; 2]],
}

/// What `finish` made of each tile, with the tile's first column and row and its size, in a fixed order; and what it cost.
pub type Tiles<T> = (Vec<([usize; 2], [usize; 2], T)>, Counters);

/// Casts a ray through the middle of each cell, as exactly as can be, and lets `finish` turn each tile into what is kept of it.
///
/// # Errors
/// [`Cancelled`] soon after the interrupt was set.
pub fn cast<T: Send>(
    shape: &Shape,
    scene: &Scene,
    finish: impl Fn(Tile<'_>) -> T + Sync,
    interrupt: &Interrupt,
) -> Result<Tiles<T>, Cancelled> {
    interrupt.begin(scene.steps());
    cast_on(shape, scene, Aim { pattern: Pattern::Middles, tolerance: 1e-11, normals: true }, finish, interrupt)
}

/// A height map: what the ray through the middle of each cell meets, row by row, with depths found to `tolerance` of the range of depths.
///
/// # Errors
/// [`Cancelled`] soon after the interrupt was set.
pub fn heights(
    shape: &Shape,
    scene: &Scene,
    tolerance: f64,
    interrupt: &Interrupt,
) -> Result<(Vec<Option<Hit>>, Counters), Cancelled> {
    interrupt.begin(scene.steps());
    let aim = Aim { pattern: Pattern::Middles, tolerance, normals: true };
    let (tiles, counters) = cast_on(shape, scene, aim, |tile| tile.hits.to_vec(), interrupt)?;
    let mut all = vec![None; scene.rays[0] * scene.rays[1]];
    for ([left, top], [columns, _], hits) in tiles {
        for (j, row) in hits.chunks_exact(columns.max(1)).enumerate() {
            all[(top + j) * scene.rays[0] + left..][..columns].copy_from_slice(row);
        }
    }
    Ok((all, counters))
}

/// Narrowing steps towards a maximum: each leaves 0.618 of the bracket, so its place is known to 1e-5 of a sample's spacing.
const GOLDEN_STEPS: usize = 24;

/// Steps of a root search; at least every third leaves half of the bracket or less.
const ROOT_STEPS: usize = 120;

/// Of the rays through a box that seems far outside, one of so many is looked at in its middle too.
const PROBE_STRIDE: usize = 7;

/// Scratch for points and values.
#[derive(Default)]
struct Columns {
    at: [Vec<f64>; 3],
    values: Vec<f64>,
}

impl Columns {
    fn clear(&mut self) {
        self.at.iter_mut().for_each(Vec::clear);
    }

    fn push(&mut self, point: [f64; 3]) {
        self.at.iter_mut().zip(point).for_each(|(column, v)| column.push(v));
    }

    fn evaluate(&mut self, program: &Program, sampler: &mut Sampler) {
        let [x, y, z] = &self.at;
        self.values.clear();
        self.values.resize(x.len(), 0.0);
        sampler.values(program, &[x, y, z], &mut self.values);
    }
}

/// What goes through one task: its rays, from front to back.
struct Caster<'a, T, F> {
    frustum: &'a Frustum,
    shape: &'a Shape,
    aim: Aim<'a>,
    finish: &'a F,
    from: [usize; 2],
    size: [usize; 2],
    places: Vec<[f64; 2]>,
    rays: Vec<Ray>,
    hits: Vec<Option<Hit>>,
    /// The last sample of each ray, depth and value: a box begins where the one before it ended.
    known: Vec<(f64, f64)>,
    /// The rays through each smallest tile, row by row.
    tiles: Vec<Vec<usize>>,
    /// Rays that were found inside without a bracket: their normals are still to be computed.
    bare: Vec<usize>,
    segments: Vec<Segment>,
    samples: Vec<[f64; SAMPLES]>,
    brackets: Vec<Bracket>,
    summits: Vec<Summit>,
    columns: Columns,
    result: Option<T>,
    /// Whether its hits are to be kept for the next time, and those.
    keeps: bool,
    kept: Option<Arc<Hits>>,
    /// What is known before.
    seed: Option<Seed<'a>>,
}

/// Where the rays of a task met the object.
struct Hits {
    places: Vec<[f64; 2]>,
    hits: Vec<Option<Hit>>,
}

impl<'a, T, F> Caster<'a, T, F> {
    fn new(
        frustum: &'a Frustum,
        (shape, aim): (&'a Shape, Aim<'a>),
        block: &Block,
        finish: &'a F,
        keeps: bool,
    ) -> Self {
        let [columns, rows, _] = block.counts();
        Self {
            frustum,
            shape,
            aim,
            finish,
            from: [block.from[0], block.from[1]],
            size: [columns, rows],
            places: Vec::new(),
            rays: Vec::new(),
            hits: Vec::new(),
            known: Vec::new(),
            tiles: Vec::new(),
            bare: Vec::new(),
            segments: Vec::new(),
            samples: Vec::new(),
            brackets: Vec::new(),
            summits: Vec::new(),
            columns: Columns::default(),
            result: None,
            keeps,
            kept: None,
            seed: None,
        }
    }

    /// Sets up the rays when the first of them is needed; a tile that is empty throughout never needs any.
    fn prepare(&mut self) {
        if !self.tiles.is_empty() {
            return;
        }
        let ([columns, rows], tile) = (self.size, self.frustum.scene.tile);
        let across = columns.div_ceil(tile);
        self.tiles.resize(across * rows.div_ceil(tile), Vec::new());
        self.place();
        for (ray, place) in self.places.iter().enumerate() {
            // A corner at the right or the lower edge belongs to the last cell before it.
            let cell = |k: usize| (place[k] as usize - self.from[k]).min(self.size[k] - 1);
            let at = cell(1) / tile * across + cell(0) / tile;
            if self.seed.is_none_or(|seed| seed.touched[at]) {
                self.tiles[at].push(ray);
            }
        }
        self.rays.extend(self.places.iter().map(|&place| self.frustum.ray(place)));
        self.hits.extend_from_slice(self.seed.map_or(&[], |seed| seed.hits));
        self.hits.resize(self.rays.len(), None);
        self.tiles.iter().flatten().for_each(|&ray| self.hits[ray] = None);
        self.known.resize(self.rays.len(), (f64::NAN, f64::NAN));
    }

    /// Lists the places of the rays.
    fn place(&mut self) {
        let ([left, top], [columns, rows]) = (self.from, self.size);
        let cells = |columns: usize, rows: usize| {
            (0..rows).flat_map(move |j| (0..columns).map(move |i| [(left + i) as f64, (top + j) as f64]))
        };
        match self.aim.pattern {
            Pattern::Middles => self.places.extend(cells(columns, rows).map(|place| place.map(|v| v + 0.5))),
            Pattern::Corners => self.places.extend(cells(columns + 1, rows + 1)),
            Pattern::Shares(fine, marked) => {
                let part = |s: usize| (s as f64 + 0.5) / fine as f64;
                for [x, y] in cells(columns, rows) {
                    if marked[y as usize * self.frustum.scene.rays[0] + x as usize] {
                        let shares = (0..fine * fine).map(|s| [x + part(s % fine), y + part(s / fine)]);
                        self.places.extend(shares);
                    }
                }
            }
        }
    }

    /// The rays through `block` that have not hit yet, wherever they are in depth.
    fn looking<'c>(&'c self, block: &Block) -> impl Iterator<Item = usize> + 'c {
        let tile = self.frustum.scene.tile;
        let across = self.size[0].div_ceil(tile);
        let range = |k: usize| (block.from[k] - self.from[k]) / tile..(block.to[k] - self.from[k]).div_ceil(tile);
        let (columns, rows) = (range(0), range(1));
        let tiles = rows.flat_map(move |j| columns.clone().map(move |i| j * across + i));
        tiles.flat_map(|tile| &self.tiles[tile]).copied().filter(|&ray| self.hits[ray].is_none())
    }

    /// The part of a ray between two depths.
    fn segment(&self, ray: usize, [near, far]: [f64; 2]) -> Option<Segment> {
        let Ray { enter, leave, .. } = self.rays[ray];
        let (from, to) = (near.max(enter), far.min(leave));
        (from < to).then_some(Segment { ray, from, to })
    }

    fn depths(&self, block: &Block) -> [f64; 2] {
        [self.frustum.depth(block.from[2]), self.frustum.depth(block.to[2])]
    }

    /// The parts of the rays that are in `block` and still looking.
    fn gather(&mut self, block: &Block) {
        self.prepare();
        let depths = self.depths(block);
        let mut segments = std::mem::take(&mut self.segments);
        segments.clear();
        segments.extend(self.looking(block).filter_map(|ray| self.segment(ray, depths)));
        self.segments = segments;
    }

    fn point(&self, ray: usize, depth: f64) -> [f64; 3] {
        self.rays[ray].point(depth, &self.frustum.scene.space)
    }

    /// Evaluates the program at some of the samples of some segments, where they are not known yet.
    fn fill(&mut self, which: &[usize], steps: &[usize], program: &Program, sampler: &mut Sampler) {
        self.columns.clear();
        let mut asked = Vec::with_capacity(which.len() * steps.len());
        for &n in which {
            let segment = self.segments[n];
            for &step in steps {
                let known = self.known[segment.ray];
                if step == 0 && known.0 == segment.from {
                    self.samples[n][0] = known.1;
                } else {
                    let point = self.point(segment.ray, segment.at(step));
                    self.columns.push(point);
                    asked.push((n, step));
                }
            }
        }
        self.columns.evaluate(program, sampler);
        for ((n, step), &value) in asked.into_iter().zip(&self.columns.values) {
            self.samples[n][step] = value;
        }
    }

    /// Evaluates the program at samples of each segment and sorts the rays: a cap, a bracket, perhaps a summit, nothing. A few samples
    /// first; more only where the ray may pass close by.
    fn sample(&mut self, program: &Program, sampler: &mut Sampler) {
        self.samples.clear();
        self.samples.resize(self.segments.len(), [f64::NAN; SAMPLES]);
        self.brackets.clear();
        self.summits.clear();
        let all: Vec<usize> = (0..self.segments.len()).collect();
        self.fill(&all, &ENDS, program, sampler);
        if is_far(&self.samples, 0) {
            // A plate between the ends shows at neither of them: a few rays look into the middle too.
            let some: Vec<usize> = all.iter().copied().step_by(PROBE_STRIDE).collect();
            self.fill(&some, &COARSE[1..2], program, sampler);
            if is_far(&self.samples, PROBE_STRIDE) {
                self.remember();
                return;
            }
        }
        self.fill(&all, &COARSE[1..2], program, sampler);
        let open: Vec<usize> =
            all.into_iter().filter(|&n| !self.sort(n, &COARSE) && is_open(&self.samples[n])).collect();
        if !open.is_empty() {
            self.fill(&open, &BETWEEN, program, sampler);
            for n in open {
                if !self.sort(n, &[0, 1, 2, 3, 4, 5, 6]) {
                    self.summits.extend(self.segments[n].summit(&self.samples[n]));
                }
            }
        }
        self.remember();
    }

    /// Keeps the last samples of the segments.
    fn remember(&mut self) {
        for (segment, values) in self.segments.iter().zip(&self.samples) {
            self.known[segment.ray] = (segment.to, values[SAMPLES - 1]);
        }
    }

    /// Whether one of these samples of a segment is inside; it becomes a cap or a bracket then.
    fn sort(&mut self, n: usize, steps: &[usize]) -> bool {
        let (segment, values) = (self.segments[n], &self.samples[n]);
        let Some(first) = steps.iter().position(|&step| values[step] >= 0.0) else { return false };
        if first > 0 {
            self.brackets.push(segment.bracket(values, steps[first - 1], steps[first]));
        } else if segment.from <= self.rays[segment.ray].enter {
            self.hits[segment.ray] = Some(self.rays[segment.ray].cap());
        } else {
            self.brackets.push(segment.bracket(values, 0, 0));
        }
        true
    }

    /// Climbs to the maxima between samples; those that reach the inside become brackets.
    fn climb(&mut self, program: &Program, sampler: &mut Sampler) {
        for step in 0..GOLDEN_STEPS {
            if self.summits.is_empty() {
                return;
            }
            self.columns.clear();
            for summit in &self.summits {
                // The first step needs both inner places; later ones only the new one.
                for depth in if step == 0 { vec![summit.left.0, summit.right.0] } else { vec![summit.fresh().0] } {
                    let point = self.rays[summit.ray].point(depth, &self.frustum.scene.space);
                    self.columns.push(point);
                }
            }
            self.columns.evaluate(program, sampler);
            let values = self.columns.values.chunks_exact(if step == 0 { 2 } else { 1 });
            for (summit, values) in self.summits.iter_mut().zip(values) {
                summit.learn(values);
            }
            let found = self.summits.iter().filter_map(Summit::bracket);
            self.brackets.extend(found);
            self.summits.retain(|summit| summit.bracket().is_none());
            self.summits.iter_mut().for_each(Summit::narrow);
        }
    }

    /// Narrows the brackets, then takes the normals.
    fn solve(&mut self, program: &Program, sampler: &mut Sampler) {
        let tolerance = self.aim.tolerance * (self.frustum.far - self.frustum.near);
        let mut active: Vec<usize> = (0..self.brackets.len()).collect();
        for _ in 0..ROOT_STEPS {
            active.retain(|&b| self.brackets[b].width() > tolerance);
            if active.is_empty() {
                break;
            }
            self.columns.clear();
            let depths: Vec<f64> = active.iter().map(|&b| self.brackets[b].estimate(0.4 * tolerance)).collect();
            for (&b, &depth) in active.iter().zip(&depths) {
                let point = self.point(self.brackets[b].ray, depth);
                self.columns.push(point);
            }
            self.columns.evaluate(program, sampler);
            for ((&b, depth), &value) in active.iter().zip(depths).zip(&self.columns.values) {
                self.brackets[b].learn(depth, value);
            }
        }
        let found: Vec<_> = self.brackets.iter().map(|b| (b.ray, b.inside.0)).collect();
        self.normals(&found, program, sampler);
    }

    /// Where the gradient gave no normal (steps, nearest samples): that of the plane through neighbouring hits.
    fn mend(&mut self) {
        for ray in 0..self.hits.len() {
            if let Some(Hit { depth, normal, .. }) = self.hits[ray].filter(|hit| hit.normal[0].is_nan()) {
                let normal = self.plane(ray, depth).unwrap_or(normal);
                let towards = self.rays[ray].facing(normal).or_else(|| self.rays[ray].facing(self.rays[ray].direction));
                self.hits[ray] = Some(Hit { depth, normal: towards.unwrap_or([0.0, 0.0, 1.0]), cap: false });
            }
        }
    }

    /// The normal of the plane through a hit and, of its neighbours in the row and in the column, those nearest in depth.
    fn plane(&self, ray: usize, depth: f64) -> Option<[f64; 3]> {
        // The grid that the ray is in: that of the whole tile, or that of its cell.
        let [columns, rows] = match self.aim.pattern {
            Pattern::Middles => self.size,
            Pattern::Corners => self.size.map(|n| n + 1),
            Pattern::Shares(fine, _) => [fine; 2],
        };
        let (i, j) = (ray % columns, ray % (columns * rows) / columns);
        let here = self.point(ray, depth);
        let edge = |before: Option<usize>, after: Option<usize>| {
            let hits = [before, after].into_iter().flatten().filter_map(|ray| Some((ray, self.hits[ray]?.depth)));
            let (ray, depth) = hits.min_by(|a, b| (a.1 - depth).abs().total_cmp(&(b.1 - depth).abs()))?;
            let there = self.point(ray, depth);
            Some(std::array::from_fn::<f64, 3, _>(|k| there[k] - here[k]))
        };
        let u = edge((i > 0).then(|| ray - 1), (i + 1 < columns).then_some(ray + 1))?;
        let v = edge((j > 0).then(|| ray - columns), (j + 1 < rows).then_some(ray + columns))?;
        Some([u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]])
    }

    /// Turns depths on rays into hits, with the gradients of a program.
    fn normals(&mut self, found: &[(usize, f64)], program: &Program, sampler: &mut Sampler) {
        if !self.aim.normals {
            for &(ray, depth) in found {
                let direction = self.rays[ray].direction;
                self.hits[ray] = Some(self.rays[ray].hit(depth, direction));
            }
            return;
        }
        self.columns.clear();
        for &(ray, depth) in found {
            let point = self.point(ray, depth);
            self.columns.push(point);
        }
        let mut slopes: [Vec<f64>; 3] = std::array::from_fn(|_| vec![0.0; found.len()]);
        let [x, y, z] = &self.columns.at;
        self.columns.values.resize(found.len(), 0.0);
        let [sx, sy, sz] = &mut slopes;
        sampler.slopes(program, &[x, y, z], &mut self.columns.values[..found.len()], &mut [sx, sy, sz]);
        for (n, &(ray, depth)) in found.iter().enumerate() {
            self.hits[ray] = Some(self.rays[ray].hit(depth, [slopes[0][n], slopes[1][n], slopes[2][n]]));
        }
    }
}

impl<T, F: Fn(Tile<'_>) -> T> Caster<'_, T, F> {
    /// Lets the hits become what is wanted of them.
    fn hand_over(&mut self, done: &Hits) {
        let tile = Tile { from: self.from, size: self.size, hits: &done.hits, places: &done.places };
        self.result = Some((self.finish)(tile));
    }
}

impl<T: Send, F: Fn(Tile<'_>) -> T + Sync> Visitor for Caster<'_, T, F> {
    fn wants(&mut self, block: &Block) -> bool {
        self.prepare();
        let depths = self.depths(block);
        self.looking(block).any(|ray| self.segment(ray, depths).is_some())
    }

    fn uniform(&mut self, block: &Block, inside: bool) {
        if !inside {
            return;
        }
        self.gather(block);
        for &Segment { ray, from, .. } in &self.segments {
            let hit = self.rays[ray].cap();
            if from > self.rays[ray].enter {
                self.bare.push(ray);
            }
            self.hits[ray] = Some(Hit { depth: from, ..hit });
        }
    }

    fn leaf(&mut self, block: &Block, program: &Program, sampler: &mut Sampler) {
        self.gather(block);
        self.sample(program, sampler);
        self.climb(program, sampler);
        self.solve(program, sampler);
    }

    fn finish(&mut self, sampler: &mut Sampler) {
        let bare: Vec<_> = self.bare.iter().filter_map(|&ray| Some((ray, self.hits[ray]?.depth))).collect();
        if !bare.is_empty() {
            let program = self.shape.program.clone();
            self.normals(&bare, &program, sampler);
        }
        self.mend();
        let done = Hits { places: std::mem::take(&mut self.places), hits: std::mem::take(&mut self.hits) };
        self.hand_over(&done);
        // Normals of bare rays are those of the whole program, which may change where the task's own does not.
        self.kept = (self.keeps && bare.is_empty()).then(|| Arc::new(done));
        // What is kept until all tasks are done is the result alone.
        (self.rays, self.known) = Default::default();
        (self.tiles, self.segments, self.samples, self.columns) = Default::default();
    }

    fn tell(&self, to: &mut Digest) {
        to.shown(&(self.aim.tolerance, self.aim.normals));
        match self.aim.pattern {
            Pattern::Middles => to.write_u8(0),
            Pattern::Corners => to.write_u8(1),
            Pattern::Shares(fine, marked) => {
                (2_u8, fine).hash(to);
                for row in self.from[1]..self.from[1] + self.size[1] {
                    let first = row * self.frustum.scene.rays[0] + self.from[0];
                    marked[first..first + self.size[0]].hash(to);
                }
            }
        }
    }

    fn keep(&mut self) -> Option<Left> {
        let hits = self.kept.take()?;
        let bytes = hits.places.capacity() * size_of::<[f64; 2]>() + hits.hits.capacity() * size_of::<Option<Hit>>();
        Some(Left { what: hits, bytes })
    }

    fn recall(&mut self, left: &Left) -> bool {
        let Ok(hits) = left.what.clone().downcast::<Hits>() else { return false };
        self.hand_over(&hits);
        true
    }
}
