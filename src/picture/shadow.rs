//! Where the key light reaches: the depths at which its parallel rays meet the object first. Evaluates nothing after it is made.

use std::collections::BTreeMap;

use super::camera::Camera;
use super::extent::Extent;
use super::raycast::Space;
use super::rays::{Aim, Hit, Pattern, Scene, cast_on, search_in};
use super::screen::{Screen, TILE, Window};
use crate::interrupt::{Cancelled, Interrupt};
use crate::surface::sampler::Counters;
use crate::vm::Shape;

/// Depths of first hits, seen from the light.
#[derive(Clone, Debug)]
pub struct Shadows {
    camera: Camera,
    side: usize,
    depths: Vec<f32>,
    /// The distance of neighbouring rays.
    texel: f64,
}

/// A part of what the light sees: first column and row, columns and rows, depths.
pub(super) type Patch = ([usize; 2], [usize; 2], Vec<f32>);

/// Rays along each side of a group in which changes are gathered.
const GROUP: usize = 8;

/// Rays that have changed: the first and last column and row, and between which depths.
struct Changed {
    least: [usize; 2],
    most: [usize; 2],
    near: f64,
    far: f64,
}

impl Changed {
    fn join(&mut self, other: &Self) {
        (0..2).for_each(|k| self.least[k] = self.least[k].min(other.least[k]));
        (0..2).for_each(|k| self.most[k] = self.most[k].max(other.most[k]));
        (self.near, self.far) = (self.near.min(other.near), self.far.max(other.far));
    }
}

/// Rays around a point over which the edge of a shadow is softened.
const SOFT: f64 = 2.5;

impl Shadows {
    /// What the light sees, in `side` x `side` cells; `towards` points to it.
    #[must_use]
    pub fn scene(space: Space, towards: [f64; 3], side: usize) -> Scene {
        let camera = Camera::parallel(towards.map(|v| -v), &Extent::whole(space));
        Scene { camera, space, rays: [side, side], tile: 8 }
    }

    /// No light reaches anything yet: what it sees is still to be put in, part by part.
    #[must_use]
    pub(super) fn dark(space: Space, towards: [f64; 3], side: usize) -> Self {
        let camera = Self::scene(space, towards, side).camera;
        let texel = 2.0 * camera.base[0].max(camera.base[1]) / side as f64;
        Self { camera, side, depths: vec![f32::INFINITY; side * side], texel }
    }

    /// What the light sees.
    pub(super) fn screen(&self) -> Screen {
        Screen { camera: self.camera, size: [self.side; 2], piece: 2 * TILE }
    }

    /// The depths in a part of what the light sees, piece by piece, found by a search; they are still to be put in.
    pub(super) fn recast(
        &self,
        shape: &Shape,
        space: Space,
        window: Window,
        interrupt: &Interrupt,
    ) -> Result<Patch, Cancelled> {
        let scene = Scene { camera: self.camera, space, rays: [self.side; 2], tile: TILE };
        let aim = Aim { pattern: Pattern::Middles, tolerance: 0.05 / self.side as f64, normals: false };
        let depth = |hit: Option<Hit>| hit.map_or(f32::INFINITY, |hit| hit.depth as f32);
        let ((_, hits), _) = search_in(shape, &scene, window, aim, None, interrupt)?;
        let size = [0, 1].map(|k| window[1][k] - window[0][k]);
        Ok((window[0], size, hits.into_iter().map(depth).collect()))
    }

    /// Puts depths in. Gives for each group of rays of which some have changed the corners of a hull of all points of the space whose light
    /// that may change.
    pub(super) fn put(&mut self, (from, size, mut depths): Patch, space: Space) -> Vec<Vec<[f64; 3]>> {
        // A piece in which nothing is met says so by holding nothing.
        depths.resize(size[0] * size[1], f32::INFINITY);
        let (near, far) = self.camera.depths(space.lo, space.hi);
        let mut groups: BTreeMap<[usize; 2], Changed> = BTreeMap::new();
        for (k, &new) in depths.iter().enumerate() {
            let at = [from[0] + k % size[0], from[1] + k / size[0]];
            let old = std::mem::replace(&mut self.depths[at[1] * self.side + at[0]], new);
            if old.to_bits() != new.to_bits() {
                let [old, new] = [old, new].map(|depth| f64::from(depth).clamp(near, far));
                let here = Changed { least: at, most: at, near: old.min(new), far: old.max(new) };
                groups.entry(at.map(|v| v / GROUP)).and_modify(|all| all.join(&here)).or_insert(here);
            }
        }
        groups.into_values().map(|changed| self.hull(&changed)).collect()
    }

    /// The corners of what is behind some rays between two depths, and as far around it as a point looks for its light.
    fn hull(&self, &Changed { least, most, near, far }: &Changed) -> Vec<[f64; 3]> {
        // As `lit` moves a point and looks around it, and one more.
        let around = (2.0 * SOFT + 2.0) * self.texel;
        let corner = |n: usize| {
            let place = |axis: usize, k: usize| {
                let at = if k == 0 { least[axis] as f64 } else { most[axis] as f64 + 1.0 };
                (2.0 * at / self.side as f64 - 1.0) * self.camera.base[axis] + if k == 0 { -around } else { around }
            };
            let (x, y) = (place(0, n & 1), -place(1, n >> 1 & 1));
            let depth = if n & 4 == 0 { near } else { far + (SOFT + 2.5) * self.texel };
            let Camera { eye, right, up, forward, .. } = self.camera;
            std::array::from_fn(|k| eye[k] + x * right[k] + y * up[k] + depth * forward[k])
        };
        (0..8).map(corner).collect()
    }

    /// Casts `side` x `side` parallel rays from the light into the space, as a part of a task whose progress was begun already; `towards`
    /// points to the light. Also what that cost.
    ///
    /// # Errors
    /// [`Cancelled`] soon after the interrupt was set.
    pub fn cast(
        shape: &Shape,
        space: Space,
        towards: [f64; 3],
        side: usize,
        interrupt: &Interrupt,
    ) -> Result<(Self, Counters), Cancelled> {
        let scene = Self::scene(space, towards, side);
        let camera = scene.camera;
        // Nobody sees depths: a small part of the distance of two rays is enough.
        let aim = Aim { pattern: Pattern::Middles, tolerance: 0.05 / side as f64, normals: false };
        let depth = |hit: &Option<super::rays::Hit>| hit.map_or(f32::INFINITY, |hit| hit.depth as f32);
        let (tiles, counters) =
            cast_on(shape, &scene, aim, |tile| tile.hits.iter().map(depth).collect::<Vec<_>>(), interrupt)?;
        let mut depths = vec![f32::INFINITY; side * side];
        for (from, size, tile) in tiles {
            for (row, tile) in tile.chunks_exact(size[0]).enumerate() {
                depths[(from[1] + row) * side + from[0]..][..size[0]].copy_from_slice(tile);
            }
        }
        let texel = 2.0 * camera.base[0].max(camera.base[1]) / side as f64;
        Ok((Self { camera, side, depths, texel }, counters))
    }

    /// Adds what the same light sees of another object of the same space.
    pub fn join(&mut self, other: &Self) {
        self.depths.iter_mut().zip(&other.depths).for_each(|(depth, more)| *depth = depth.min(*more));
    }

    /// How much of the light reaches a point of the boundary with that normal, 0 to 1. `facing` is the cosine of the angle between the
    /// normal and the light; the point is moved off the boundary by more where the light grazes it, so that no face shades itself.
    #[must_use]
    pub fn lit(&self, point: [f64; 3], normal: [f64; 3], facing: f64) -> f32 {
        let off = self.texel * (SOFT + 1.0) * (1.0 - facing * facing).max(0.0).sqrt();
        let offset: [f64; 3] = std::array::from_fn(|k| point[k] + off * normal[k] - self.camera.eye[k]);
        let along = |axis: [f64; 3]| offset.iter().zip(axis).map(|(a, b)| a * b).sum::<f64>();
        let depth = (along(self.camera.forward) - 1.5 * self.texel) as f32;
        let place = |v: f64| 0.5 * (v + 1.0) * self.side as f64 - 0.5;
        let x = place(along(self.camera.right) / self.camera.base[0]);
        let y = place(-along(self.camera.up) / self.camera.base[1]);
        let (mut lit, mut all) = (0.0, 0.0);
        for j in self.around(y) {
            for i in self.around(x) {
                let weight = tent(x, i) * tent(y, j);
                all += weight;
                lit += if self.depths[j * self.side + i] >= depth { weight } else { 0.0 };
            }
        }
        if all > 0.0 { (lit / all) as f32 } else { 1.0 }
    }

    /// The rays near a place.
    fn around(&self, place: f64) -> std::ops::Range<usize> {
        let first = (place - SOFT).ceil().clamp(0.0, self.side as f64) as usize;
        let last = (place + SOFT).floor().clamp(-1.0, self.side as f64 - 1.0) + 1.0;
        first..last as usize
    }
}

fn tent(place: f64, index: usize) -> f64 {
    (1.0 - (place - index as f64).abs() / SOFT).max(0.0)
}
