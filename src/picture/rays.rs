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
use super::search::{Bracket, SAMPLES, Segment, Summit};

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

impl Scene {
    /// The start and the change by depth of ray (i, j).
    #[must_use]
    pub fn ray(&self, i: usize, j: usize) -> ([f64; 3], [f64; 3]) {
        let [columns, rows] = self.rays;
        self.camera.ray(2.0 * ((i as f64 + 0.5) / columns as f64) - 1.0, 1.0 - 2.0 * ((j as f64 + 0.5) / rows as f64))
    }
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
        let (start, direction) = self.scene.ray(i, j);
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

    /// A hit with the normal from a gradient, turned to the eye; undefined (NaN) where the gradient is of no use.
    fn hit(&self, depth: f64, gradient: [f64; 3]) -> Hit {
        Hit { depth, normal: self.facing(gradient).unwrap_or([f64::NAN; 3]), cap: false }
    }

    /// The unit vector along `v` or against it, whichever is turned to the eye; `None` if `v` has no direction.
    fn facing(&self, v: [f64; 3]) -> Option<[f64; 3]> {
        let largest = v.iter().fold(0.0_f64, |m, c| m.max(c.abs()));
        if !(largest > 0.0 && largest.is_finite() && v.iter().all(|c| c.is_finite())) {
            return None;
        }
        let scaled = v.map(|c| c / largest);
        let along: f64 = (0..3).map(|k| scaled[k] * self.direction[k]).sum();
        let length = scaled.iter().map(|c| c * c).sum::<f64>().sqrt();
        Some(scaled.map(|c| if along > 0.0 { -c / length } else { c / length }))
    }
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
        let [columns, rows] = self.size;
        let (i, j) = (ray % columns, ray / columns);
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
        self.mend();
        let finish = self.finish;
        self.result = Some(finish(Tile { from: self.from, size: self.size, hits: &self.hits }));
        (self.rays, self.hits, self.columns) = (Vec::new(), Vec::new(), Columns::default());
    }
}
