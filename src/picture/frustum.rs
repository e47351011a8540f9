//! The space as a camera sees it: cells of the picture x cells of depth, and single rays. Evaluates nothing.

use crate::number::Interval;
use crate::reuse::Digest;
use crate::surface::boxes::{Block, Lattice};

use super::raycast::Space;
use super::rays::{Hit, Scene};

/// Cells of depth in the smallest box.
const LEAF_DEPTH: usize = 4;

/// The rays of a picture x cells of depth.
pub(super) struct Frustum {
    pub(super) scene: Scene,
    pub(super) near: f64,
    pub(super) far: f64,
    cells: usize,
    /// How far rounding may carry a computed point beyond the hull of computed corners.
    slack: f64,
    /// The first and one past the last column and row of rays that are cast.
    window: [[usize; 2]; 2],
    /// Whether what is found is kept elsewhere.
    forgets: bool,
}

impl Frustum {
    pub(super) fn new(scene: Scene) -> Self {
        let Space { lo, hi } = scene.space;
        let (near, far) = scene.camera.depths(lo, hi);
        let middle = 0.5 * (near + far);
        let height = scene.camera.base[1] + scene.camera.growth[1] * middle;
        let footprint = 2.0 * height / scene.rays[1] as f64;
        // A cell is as deep as two rays are apart, so that the smallest boxes are about cubes.
        let cells = ((far - near) / (2.0 * footprint)).ceil().clamp(1.0, 16_384.0) as usize;
        let size =
            (0..3).map(|k| lo[k].abs().max(hi[k].abs()).max(scene.camera.eye[k].abs())).fold(far.abs(), f64::max);
        let window = [[0; 2], scene.rays];
        Self {
            scene,
            near,
            far,
            cells: cells.next_multiple_of(LEAF_DEPTH),
            slack: 1e-13 * size,
            window,
            forgets: false,
        }
    }

    /// The same for a part of the picture: its first column and row, and one past its last ones; it begins at multiples of four tiles.
    pub(super) fn within(self, window: [[usize; 2]; 2]) -> Self {
        Self { window, forgets: true, ..self }
    }

    pub(super) fn depth(&self, cell: usize) -> f64 {
        self.near + (self.far - self.near) * (cell as f64 / self.cells as f64)
    }

    /// The ray through a place of the picture, in cells from the top left.
    pub(super) fn ray(&self, place: [f64; 2]) -> Ray {
        let (start, direction) = self.scene.through(place);
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

    /// A ray seen whole is as good as the whole space, unless it runs along an axis.
    fn part(&self) -> [usize; 3] {
        [4 * self.scene.tile, 4 * self.scene.tile, 4 * LEAF_DEPTH]
    }

    fn window(&self) -> Block {
        let [[left, top], [right, bottom]] = self.window;
        Block { from: [left, top, 0], to: [right, bottom, self.cells] }
    }

    fn tell(&self, to: &mut Digest) -> bool {
        to.shown(&self.scene);
        !self.forgets
    }

    fn bounds(&self, block: &Block, out: &mut [Interval]) {
        let Space { lo, hi } = self.scene.space;
        let (mut least, mut most) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for i in [block.from[0], block.to[0]] {
            for j in [block.from[1], block.to[1]] {
                let ray = self.ray([i as f64, j as f64]);
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
pub(super) struct Ray {
    pub(super) start: [f64; 3],
    pub(super) direction: [f64; 3],
    pub(super) enter: f64,
    pub(super) leave: f64,
    /// The axis of the face through which it enters.
    face: usize,
}

impl Ray {
    /// `enter > leave` if it misses the space.
    fn new(start: [f64; 3], direction: [f64; 3], space: Space) -> Self {
        let mut ray = Self { start, direction, enter: 0.0, leave: f64::INFINITY, face: 2 };
        for k in 0..3 {
            let (first, last) = slab(start[k], direction[k], space.lo[k], space.hi[k]);
            if first > ray.enter {
                (ray.enter, ray.face) = (first, k);
            }
            ray.leave = ray.leave.min(last);
        }
        ray
    }

    pub(super) fn point(&self, depth: f64, space: &Space) -> [f64; 3] {
        std::array::from_fn(|k| (self.start[k] + depth * self.direction[k]).clamp(space.lo[k], space.hi[k]))
    }

    pub(super) fn cap(&self) -> Hit {
        let mut normal = [0.0; 3];
        normal[self.face] = if self.direction[self.face] > 0.0 { -1.0 } else { 1.0 };
        Hit { depth: self.enter, normal, cap: true }
    }

    /// A hit with the normal from a gradient, turned to the eye; undefined (NaN) where the gradient is of no use.
    pub(super) fn hit(&self, depth: f64, gradient: [f64; 3]) -> Hit {
        Hit { depth, normal: self.facing(gradient).unwrap_or([f64::NAN; 3]), cap: false }
    }

    /// The unit vector along `v` or against it, whichever is turned to the eye; `None` if `v` has no direction.
    pub(super) fn facing(&self, v: [f64; 3]) -> Option<[f64; 3]> {
        Some(facing(v, self.direction)).filter(|unit| !unit[0].is_nan())
    }
}

/// The depths between which a ray lies in the range of one axis.
#[inline(always)]
pub(super) fn slab(start: f64, direction: f64, lo: f64, hi: f64) -> (f64, f64) {
    let (a, b) = ((lo - start) / direction, (hi - start) / direction);
    let (first, last) = if a <= b { (a, b) } else { (b, a) };
    let is_out = (start < lo) | (start > hi);
    let always = if is_out { f64::NEG_INFINITY } else { f64::INFINITY };
    if direction == 0.0 { (f64::NEG_INFINITY, always) } else { (first, last) }
}

/// The unit vector along `v` or against it, whichever is turned against the direction; undefined (NaN) if `v` has no direction.
#[inline(always)]
pub(super) fn facing(v: [f64; 3], direction: [f64; 3]) -> [f64; 3] {
    let size = v.map(f64::abs);
    let larger = |a: f64, b: f64| if a > b { a } else { b };
    let largest = larger(larger(size[0], size[1]), size[2]);
    let is_finite = (size[0] < f64::INFINITY) & (size[1] < f64::INFINITY) & (size[2] < f64::INFINITY);
    let scaled = v.map(|c| c / largest);
    let along = scaled[0] * direction[0] + scaled[1] * direction[1] + scaled[2] * direction[2];
    let length = (scaled[0] * scaled[0] + scaled[1] * scaled[1] + scaled[2] * scaled[2]).sqrt();
    let length = if along > 0.0 { -length } else { length };
    scaled.map(|c| if is_finite & (largest > 0.0) { c / length } else { f64::NAN })
}
