//! The light: a key light from the upper left, a weak fill from the right, the sky above and the ground below, and a soft gleam. In
//! linear light; knows no geometry but a normal.

use super::camera::Camera;
use super::palette::linear;
use super::rays::Hit;

/// Linear light, red, green, blue.
pub type Light = [f32; 3];

/// Lights that stand still relative to the camera, so that every view is lit well.
#[derive(Clone, Copy, Debug)]
pub struct Lights {
    key: [f64; 3],
    fill: [f64; 3],
    halfway: [f64; 3],
    solid: Light,
    cut: Light,
}

const KEY: Light = [0.86, 0.83, 0.78];
const FILL: Light = [0.13, 0.15, 0.19];
const SKY: Light = [0.33, 0.36, 0.41];
const GROUND: Light = [0.15, 0.135, 0.12];
const GLEAM: f32 = 0.16;
const GLEAM_EXPONENT: f64 = 36.0;
/// What a face of the modelling space that cuts the object is tinted with, and how much.
const CUT: [u8; 3] = [0xe9, 0xb8, 0x86];
const CUT_SHARE: f32 = 0.6;

impl Lights {
    /// Lights for a camera and a solid of that colour (sRGB).
    #[must_use]
    pub fn new(camera: &Camera, solid: [u8; 3]) -> Self {
        let towards = |right: f64, up: f64, back: f64| {
            unit(std::array::from_fn(|k| right * camera.right[k] + up * camera.up[k] - back * camera.forward[k]))
        };
        let key = towards(-0.52, 0.72, 0.62);
        let eye = camera.forward.map(|v| -v);
        let halfway = unit(std::array::from_fn(|k| key[k] + eye[k]));
        let solid = solid.map(linear);
        let tint = CUT.map(linear);
        let cut = std::array::from_fn(|k| solid[k] + CUT_SHARE * (tint[k] - solid[k]));
        Self { key, fill: towards(0.85, 0.1, 0.5), halfway, solid, cut }
    }

    /// The direction to the key light, a unit vector.
    #[must_use]
    pub fn key(&self) -> [f64; 3] {
        self.key
    }

    /// The light that leaves the object at a hit that the key light reaches by `lit` (0 to 1; asked with the cosine of its angle where
    /// it shines on the boundary's front).
    #[must_use]
    pub fn shade(&self, hit: &Hit, lit: impl FnOnce(f64) -> f32) -> Light {
        let n = hit.normal;
        let (facing, fill) = (dot(n, self.key), dot(n, self.fill).max(0.0) as f32);
        let lit = if facing > 0.0 { lit(facing) } else { 0.0 };
        let key = lit * facing.max(0.0) as f32;
        let sky = (0.5 + 0.5 * n[2]) as f32;
        let gleam =
            if key > 0.0 { GLEAM * libm::pow(dot(n, self.halfway).max(0.0), GLEAM_EXPONENT) as f32 } else { 0.0 };
        let body = if hit.cap { self.cut } else { self.solid };
        std::array::from_fn(|k| {
            let around = GROUND[k] + sky * (SKY[k] - GROUND[k]);
            body[k] * (around + key * KEY[k] + fill * FILL[k]) + gleam
        })
    }
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn unit(v: [f64; 3]) -> [f64; 3] {
    let length = dot(v, v).sqrt();
    if length > 0.0 { v.map(|c| c / length) } else { v }
}
