//! Several rays at a time, number by number in rows, so that they are aimed and turned by vector instructions. What it computes are the
//! rays and the normals of the frustum, to the bit.

#[cfg(not(debug_assertions))]
use multiversion::multiversion;

use super::Scene;
use crate::picture::frustum::{facing, slab};
use crate::vm::along::{LANES, Row};

/// Rays and the depths between which they are in the space, as middles and halves; the half is negative where a ray misses the space, which
/// then has a middle of 0.
#[derive(Clone, Copy, Debug)]
pub struct Lanes {
    /// Where they start, axis by axis.
    pub start: [Row; 3],
    /// Their change by depth.
    pub direction: [Row; 3],
    /// The depth half-way through the space.
    pub middle: Row,
    /// Half of the way.
    pub half: Row,
}

impl Default for Lanes {
    fn default() -> Self {
        Self { start: [[0.0; LANES]; 3], direction: [[0.0; LANES]; 3], middle: [0.0; LANES], half: [-1.0; LANES] }
    }
}

impl Lanes {
    /// Where they are half-way, and what they change by until they leave; no change where they miss the space.
    #[inline]
    pub fn through(&self) -> ([Row; 3], [Row; 3]) {
        let (mut at, mut change) = (self.start, self.direction);
        for k in 0..3 {
            for i in 0..LANES {
                at[k][i] += self.middle[i] * self.direction[k][i];
                change[k][i] *= self.half[i].max(0.0);
            }
        }
        (at, change)
    }
}

/// Aims rays through places of the picture, in cells from the top left.
#[cfg_attr(not(debug_assertions), multiversion(targets("x86_64+avx512f+avx512bw+avx512dq+avx512vl", "x86_64+avx2")))]
pub fn aim(scene: &Scene, places: &[Row; 2], lanes: &mut Lanes) {
    let mut views = [[0.0; LANES]; 2];
    for i in 0..LANES {
        [views[0][i], views[1][i]] = scene.view([places[0][i], places[1][i]]);
    }
    let (mut enter, mut leave) = ([0.0; LANES], [f64::INFINITY; LANES]);
    for k in 0..3 {
        let (lo, hi) = (scene.space.lo[k], scene.space.hi[k]);
        for i in 0..LANES {
            let (start, direction) = scene.camera.ray_along(k, views[0][i], views[1][i]);
            (lanes.start[k][i], lanes.direction[k][i]) = (start, direction);
            let (first, last) = slab(start, direction, lo, hi);
            enter[i] = if first > enter[i] { first } else { enter[i] };
            leave[i] = if last < leave[i] { last } else { leave[i] };
        }
    }
    for i in 0..LANES {
        let meets = enter[i] < leave[i];
        lanes.middle[i] = if meets { 0.5 * (enter[i] + leave[i]) } else { 0.0 };
        lanes.half[i] = if meets { 0.5 * (leave[i] - enter[i]) } else { -1.0 };
    }
}

/// Turns gradients into unit normals that face the eye, undefined (NaN) where the gradient is of no use.
#[cfg_attr(not(debug_assertions), multiversion(targets("x86_64+avx512f+avx512bw+avx512dq+avx512vl", "x86_64+avx2")))]
pub fn normals(gradients: &mut [Row; 3], directions: &[Row; 3]) {
    for i in 0..LANES {
        let gradient = [gradients[0][i], gradients[1][i], gradients[2][i]];
        let unit = facing(gradient, [directions[0][i], directions[1][i], directions[2][i]]);
        (gradients[0][i], gradients[1][i], gradients[2][i]) = (unit[0], unit[1], unit[2]);
    }
}
