//! Where the rays of a camera meet an object: boxes of pixels x depth from front to back by intervals, then a bracketed root on each ray
//! of an undecided box. No sphere tracing, so the function need not be a distance. Knows no light and no colour.
//!
//! The modelling space caps the object: a ray that enters the space inside the object hits the face there. What is thinner than a
//! sample spacing along a ray is found where the function has a maximum between samples, as at silhouettes.

use crate::interrupt::{Cancelled, Interrupt};
use crate::number::Interval;
use crate::surface::boxes::{Block, Lattice, Visitor, walk};
use crate::surface::sampler::{Counters, Sampler};
use crate::vm::{Program, Shape};

use super::camera::Camera;
use super::raycast::Space;

/// Samples of a picture and the space that they look into.
#[derive(Clone, Copy, Debug)]
pub struct Scene {
    /// The camera.
    pub camera: Camera,
    /// The modelling space.
    pub space: Space,
    /// Rays along a row and along a column; ray (i, j) goes through the middle of its share of the picture, from the top left.
    pub rays: [usize; 2],
    /// Rays along each side of a tile of the smallest size; what is gathered is handed over in multiples of it.
    pub tile: usize,
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

/// The hits of a tile of rays, row by row.
#[derive(Clone, Copy, Debug)]
pub struct Tile<'a> {
    /// First column and row.
    pub from: [usize; 2],
    /// Columns and rows.
    pub size: [usize; 2],
    /// One entry for each ray; empty if no ray of the tile hits anything.
    pub hits: &'a [Option<Hit>],
}

/// What `finish` made of each tile, with the tile's first column and row and its size, in a fixed order; and what it cost.
pub type Tiles<T> = (Vec<([usize; 2], [usize; 2], T)>, Counters);

/// Casts all rays and lets `finish` turn each tile into what is kept of it.
///
/// # Errors
/// [`Cancelled`] soon after the interrupt was set.
pub fn cast<T: Send>(
    shape: &Shape,
    scene: &Scene,
    finish: impl Fn(Tile<'_>) -> T + Sync,
    interrupt: &Interrupt,
) -> Result<Tiles<T>, Cancelled> {
    let frustum = Frustum::new(*scene);
    let visitor = |block: &Block| Caster::new(&frustum, shape, block, &finish);
    let done = walk(&frustum, shape, visitor, interrupt)?;
    let tiles = done.visitors.into_iter().filter_map(|caster| Some((caster.from, caster.size, caster.result?)));
    Ok((tiles.collect(), done.counters))
}

/// Cells of depth in the smallest box.
const LEAF_DEPTH: usize = 4;

/// Samples along a ray in a smallest box, both ends included.
const SAMPLES: usize = 7;

/// Narrowing steps towards a maximum: each leaves 0.618 of the bracket, so its place is known to 1e-5 of a sample's spacing.
const GOLDEN_STEPS: usize = 24;

/// Steps of a root search; every third is a bisection.
const ROOT_STEPS: usize = 90;

/// The rays of a picture x cells of depth.
struct Frustum {
    scene: Scene,
    near: f64,
    far: f64,
    cells: usize,
    /// How far rounding may carry a computed point beyond the hull of computed corners.
    slack: f64,
}

impl Frustum {
    fn new(scene: Scene) -> Self {
        let Space { lo, hi } = scene.space;
        let (near, far) = scene.camera.depths(lo, hi);
        let middle = 0.5 * (near + far);
        let height = scene.camera.base[1] + scene.camera.growth[1] * middle;
        let footprint = 2.0 * height / scene.rays[1] as f64;
        // A cell is as deep as two rays are apart, so that the smallest boxes are about cubes.
        let cells = ((far - near) / (2.0 * footprint)).ceil().clamp(1.0, 16_384.0) as usize;
        let size =
            (0..3).map(|k| lo[k].abs().max(hi[k].abs()).max(scene.camera.eye[k].abs())).fold(far.abs(), f64::max);
        Self { scene, near, far, cells: cells.next_multiple_of(LEAF_DEPTH), slack: 1e-13 * size }
    }

    fn depth(&self, cell: usize) -> f64 {
        self.near + (self.far - self.near) * (cell as f64 / self.cells as f64)
    }

    fn ray(&self, i: usize, j: usize) -> Ray {
        let [columns, rows] = self.scene.rays;
        let u = 2.0 * ((i as f64 + 0.5) / columns as f64) - 1.0;
        let v = 1.0 - 2.0 * ((j as f64 + 0.5) / rows as f64);
        let (start, direction) = self.scene.camera.ray(u, v);
        Ray::new(start, direction, self.scene.space)
    }
}

impl Lattice for Frustum {
    fn counts(&self) -> [usize; 3] {
        [self.scene.rays[0], self.scene.rays[1], self.cells]
    }

    fn leaf(&self) -> [usize; 3] {
        [self.scene.tile, self.scene.tile, LEAF_DEPTH]
    }

    fn task(&self) -> [usize; 3] {
        [4 * self.scene.tile, 4 * self.scene.tile, self.cells]
    }

    fn bounds(&self, block: &Block, out: &mut [Interval]) {
        let Space { lo, hi } = self.scene.space;
        let (mut least, mut most) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for i in [block.from[0], block.to[0] - 1] {
            for j in [block.from[1], block.to[1] - 1] {
                let ray = self.ray(i, j);
                for depth in [self.depth(block.from[2]), self.depth(block.to[2])] {
                    for k in 0..3 {
                        let at = ray.start[k] + depth * ray.direction[k];
                        least[k] = least[k].min(at);
                        most[k] = most[k].max(at);
                    }
                }
            }
        }
        for (k, out) in out.iter_mut().enumerate() {
            *out =
                Interval::new((least[k] - self.slack).clamp(lo[k], hi[k]), (most[k] + self.slack).clamp(lo[k], hi[k]));
        }
    }
}

/// A ray and the depths between which it is in the space.
#[derive(Clone, Copy, Debug)]
struct Ray {
    start: [f64; 3],
    direction: [f64; 3],
    enter: f64,
    leave: f64,
    /// The axis of the face through which it enters.
    face: usize,
}

impl Ray {
    /// `enter > leave` if it misses the space.
    fn new(start: [f64; 3], direction: [f64; 3], space: Space) -> Self {
        let mut ray = Self { start, direction, enter: 0.0, leave: f64::INFINITY, face: 2 };
        for k in 0..3 {
            if direction[k] == 0.0 {
                if start[k] < space.lo[k] || start[k] > space.hi[k] {
                    ray.leave = f64::NEG_INFINITY;
                }
                continue;
            }
            let (a, b) = ((space.lo[k] - start[k]) / direction[k], (space.hi[k] - start[k]) / direction[k]);
            let (first, last) = if a <= b { (a, b) } else { (b, a) };
            if first > ray.enter {
                (ray.enter, ray.face) = (first, k);
            }
            ray.leave = ray.leave.min(last);
        }
        ray
    }

    fn point(&self, depth: f64, space: &Space) -> [f64; 3] {
        std::array::from_fn(|k| (self.start[k] + depth * self.direction[k]).clamp(space.lo[k], space.hi[k]))
    }

    fn cap(&self) -> Hit {
        let mut normal = [0.0; 3];
        normal[self.face] = if self.direction[self.face] > 0.0 { -1.0 } else { 1.0 };
        Hit { depth: self.enter, normal, cap: true }
    }

    /// A hit with the normal from a gradient; towards the eye where the gradient is of no use.
    fn hit(&self, depth: f64, gradient: [f64; 3]) -> Hit {
        let along: f64 = (0..3).map(|k| gradient[k] * self.direction[k]).sum();
        let (mut normal, sign) = if along < 0.0 { (gradient, 1.0) } else { (gradient, -1.0) };
        let largest = normal.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        if !(largest > 0.0 && largest.is_finite() && gradient.iter().all(|v| v.is_finite())) {
            normal = self.direction;
        }
        let largest = normal.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        let scaled = normal.map(|v| v / largest);
        let length = scaled.iter().map(|v| v * v).sum::<f64>().sqrt();
        Hit { depth, normal: scaled.map(|v| sign * v / length), cap: false }
    }
}

/// The part of a ray in a smallest box.
#[derive(Clone, Copy)]
struct Segment {
    ray: usize,
    from: f64,
    to: f64,
}

/// A stretch of a ray that begins outside and ends inside.
#[derive(Clone, Copy)]
struct Bracket {
    ray: usize,
    outside: (f64, f64),
    inside: (f64, f64),
    /// Which end moved last: 1 the inside one, -1 the outside one.
    moved: i8,
}

/// A stretch of a ray on which all samples are outside and the function may have a maximum inside.
#[derive(Clone, Copy)]
struct Summit {
    ray: usize,
    /// A place outside before the maximum, and its value.
    before: (f64, f64),
    lo: f64,
    hi: f64,
    /// The inner places of the golden section and their values.
    left: (f64, f64),
    right: (f64, f64),
}

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
    finish: &'a F,
    from: [usize; 2],
    size: [usize; 2],
    rays: Vec<Ray>,
    hits: Vec<Option<Hit>>,
    /// Rays that were found inside without a bracket: their normals are still to be computed.
    bare: Vec<usize>,
    segments: Vec<Segment>,
    brackets: Vec<Bracket>,
    summits: Vec<Summit>,
    columns: Columns,
    result: Option<T>,
}

impl<'a, T, F> Caster<'a, T, F> {
    fn new(frustum: &'a Frustum, shape: &'a Shape, block: &Block, finish: &'a F) -> Self {
        let [columns, rows, _] = block.counts();
        Self {
            frustum,
            shape,
            finish,
            from: [block.from[0], block.from[1]],
            size: [columns, rows],
            rays: Vec::new(),
            hits: Vec::new(),
            bare: Vec::new(),
            segments: Vec::new(),
            brackets: Vec::new(),
            summits: Vec::new(),
            columns: Columns::default(),
            result: None,
        }
    }

    /// Sets up the rays when the first of them is needed; a tile that is empty throughout never needs any.
    fn prepare(&mut self) {
        if self.rays.is_empty() {
            let [columns, rows] = self.size;
            let places = (0..rows).flat_map(|j| (0..columns).map(move |i| (i, j)));
            let [first, top] = self.from;
            self.rays.extend(places.map(|(i, j)| self.frustum.ray(first + i, top + j)));
            self.hits.resize(self.rays.len(), None);
        }
    }

    /// The parts of the rays that are in `block` and still looking.
    fn gather(&mut self, block: &Block) {
        self.prepare();
        let (near, far) = (self.frustum.depth(block.from[2]), self.frustum.depth(block.to[2]));
        self.segments.clear();
        for j in block.from[1]..block.to[1] {
            for i in block.from[0]..block.to[0] {
                let ray = (j - self.from[1]) * self.size[0] + (i - self.from[0]);
                let Ray { enter, leave, .. } = self.rays[ray];
                let (from, to) = (near.max(enter), far.min(leave));
                if from < to && self.hits[ray].is_none() {
                    self.segments.push(Segment { ray, from, to });
                }
            }
        }
    }

    fn point(&self, ray: usize, depth: f64) -> [f64; 3] {
        self.rays[ray].point(depth, &self.frustum.scene.space)
    }

    /// Evaluates the program at samples of each segment and sorts the rays: a cap, a bracket, perhaps a summit, nothing.
    fn sample(&mut self, program: &Program, sampler: &mut Sampler) {
        self.columns.clear();
        for segment in &self.segments {
            for step in 0..SAMPLES {
                let point = self.rays[segment.ray].point(segment.at(step), &self.frustum.scene.space);
                self.columns.push(point);
            }
        }
        self.columns.evaluate(program, sampler);
        self.brackets.clear();
        self.summits.clear();
        let segments = std::mem::take(&mut self.segments);
        for (segment, values) in segments.iter().zip(self.columns.values.chunks_exact(SAMPLES)) {
            match values.iter().position(|&v| v >= 0.0) {
                Some(0) if segment.from <= self.rays[segment.ray].enter => {
                    self.hits[segment.ray] = Some(self.rays[segment.ray].cap());
                }
                Some(0) => self.brackets.push(segment.bracket(values, 0, 0)),
                Some(first) => self.brackets.push(segment.bracket(values, first - 1, first)),
                None => self.summits.extend(segment.summit(values)),
            }
        }
        self.segments = segments;
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
        let tolerance = 1e-11 * (self.frustum.far - self.frustum.near);
        let mut active: Vec<usize> = (0..self.brackets.len()).collect();
        for step in 0..ROOT_STEPS {
            active.retain(|&b| self.brackets[b].width() > tolerance);
            if active.is_empty() {
                break;
            }
            self.columns.clear();
            let depths: Vec<f64> = active.iter().map(|&b| self.brackets[b].estimate(step)).collect();
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

    /// Turns depths on rays into hits.
    fn normals(&mut self, found: &[(usize, f64)], program: &Program, sampler: &mut Sampler) {
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

impl<T: Send, F: Fn(Tile<'_>) -> T + Sync> Visitor for Caster<'_, T, F> {
    fn wants(&mut self, block: &Block) -> bool {
        self.gather(block);
        !self.segments.is_empty()
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
        let finish = self.finish;
        self.result = Some(finish(Tile { from: self.from, size: self.size, hits: &self.hits }));
        (self.rays, self.hits, self.columns) = (Vec::new(), Vec::new(), Columns::default());
    }
}

impl Segment {
    fn at(&self, step: usize) -> f64 {
        match step {
            0 => self.from,
            s if s == SAMPLES - 1 => self.to,
            s => self.from + (self.to - self.from) * (s as f64 / (SAMPLES - 1) as f64),
        }
    }

    fn bracket(&self, values: &[f64], outside: usize, inside: usize) -> Bracket {
        let place = |step: usize| (self.at(step), values[step]);
        Bracket { ray: self.ray, outside: place(outside), inside: place(inside), moved: 0 }
    }

    /// The stretch around the largest sample, if the slopes beside it let the function reach 0 there: where it is concave it stays
    /// below the lines through neighbouring samples.
    fn summit(&self, values: &[f64]) -> Option<Summit> {
        let top = (0..SAMPLES).filter(|&s| !values[s].is_nan()).max_by(|&a, &b| values[a].total_cmp(&values[b]))?;
        let (first, last) = (top.saturating_sub(1), (top + 1).min(SAMPLES - 1));
        let drop = (values[top] - values[first]).max(values[top] - values[last]);
        if values[top] + drop < 0.0 {
            return None;
        }
        let (lo, hi) = (self.at(first), self.at(last));
        let mut summit = Summit {
            ray: self.ray,
            before: (lo, values[first]),
            lo,
            hi,
            left: (hi - GOLDEN * (hi - lo), f64::NAN),
            right: (lo + GOLDEN * (hi - lo), f64::NAN),
        };
        summit.before.1 = if summit.before.1.is_nan() { f64::NEG_INFINITY } else { summit.before.1 };
        Some(summit)
    }
}

/// The golden section.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

impl Summit {
    /// The inner place whose value is not known yet.
    fn fresh(&self) -> (f64, f64) {
        if self.left.1.is_nan() { self.left } else { self.right }
    }

    /// Takes the values of the places that were asked for; an undefined one counts as far outside.
    fn learn(&mut self, values: &[f64]) {
        let mut values = values.iter().map(|&v| if v.is_nan() { f64::NEG_INFINITY } else { v });
        for place in [&mut self.left, &mut self.right] {
            if place.1.is_nan() {
                place.1 = values.next().unwrap_or(f64::NEG_INFINITY);
            }
        }
    }

    /// From outside to the first inner place that is inside.
    fn bracket(&self) -> Option<Bracket> {
        let inside = [self.left, self.right].into_iter().find(|place| place.1 >= 0.0)?;
        Some(Bracket { ray: self.ray, outside: self.before, inside, moved: 0 })
    }

    fn narrow(&mut self) {
        if self.left.1 >= self.right.1 {
            self.hi = self.right.0;
            self.right = self.left;
            self.left = (self.hi - GOLDEN * (self.hi - self.lo), f64::NAN);
        } else {
            self.lo = self.left.0;
            self.left = self.right;
            self.right = (self.lo + GOLDEN * (self.hi - self.lo), f64::NAN);
        }
    }
}

impl Bracket {
    fn width(&self) -> f64 {
        (self.inside.0 - self.outside.0).abs()
    }

    /// The next place: regula falsi, kept off the ends; every third one the middle.
    fn estimate(&self, step: usize) -> f64 {
        let part = self.outside.1 / (self.outside.1 - self.inside.1);
        let part = if step % 3 == 2 || !part.is_finite() { 0.5 } else { part.clamp(1e-4, 1.0 - 1e-4) };
        self.outside.0 + part * (self.inside.0 - self.outside.0)
    }

    /// Illinois: the end that stays twice loses half its weight.
    fn learn(&mut self, depth: f64, value: f64) {
        let now = if value >= 0.0 { 1 } else { -1 };
        if now == self.moved {
            let stays = if now > 0 { &mut self.outside } else { &mut self.inside };
            stays.1 *= 0.5;
        }
        if now > 0 {
            self.inside = (depth, value);
        } else {
            self.outside = (depth, value);
        }
        self.moved = now;
    }
}
