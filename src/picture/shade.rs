//! The light: a key light from the upper left, a weak fill from the right, the sky above and the ground below, and a soft gleam. In
//! linear light; knows no geometry but a normal.

use super::camera::{Camera, Projection, View};
use super::palette::linear;
use super::rays::Hit;

/// Linear light, red, green, blue.
pub type Light = [f32; 3];

/// Lights that stand still relative to the camera, so that every view is lit well, unless the key light was given its place.
#[derive(Clone, Copy, Debug, Default)]
pub struct Lights {
    key: [f64; 3],
    fill: [f64; 3],
    halfway: [f64; 3],
    /// How bright the fill light is.
    strength: f32,
}

/// The light of the key light.
pub const KEY: Light = [0.86, 0.83, 0.78];
/// The light of the fill light at its full strength.
pub const FILL: Light = [0.13, 0.15, 0.19];
/// The light from straight above.
pub const SKY: Light = [0.33, 0.36, 0.41];
/// The light from straight below.
pub const GROUND: Light = [0.15, 0.135, 0.12];
/// How bright the gleam is.
pub const GLEAM: f32 = 0.16;
/// How narrow the gleam is: the power of the cosine between the normal and halfway from the light to the eye.
pub const GLEAM_EXPONENT: f64 = 36.0;
/// What a face that cuts the object is tinted with.
const CUT: [u8; 3] = [0xe9, 0xb8, 0x86];

impl Lights {
    /// Lights for a camera; `place` is where the key light stands, as azimuth and elevation of a [`View`], `fill` how bright the other is.
    #[must_use]
    pub fn new(camera: &Camera, place: Option<[f64; 2]>, fill: f32) -> Self {
        let towards = |right: f64, up: f64, back: f64| {
            unit(std::array::from_fn(|k| right * camera.right[k] + up * camera.up[k] - back * camera.forward[k]))
        };
        let key = match place {
            Some([azimuth, elevation]) => {
                let [.., forward] = View { azimuth, elevation, projection: Projection::Orthographic }.axes();
                forward.map(|v| -v)
            }
            None => towards(-0.52, 0.72, 0.62),
        };
        let eye = camera.forward.map(|v| -v);
        let halfway = unit(std::array::from_fn(|k| key[k] + eye[k]));
        Self { key, fill: towards(0.85, 0.1, 0.5), halfway, strength: fill }
    }

    /// The direction to the key light, a unit vector.
    #[must_use]
    pub fn key(&self) -> [f64; 3] {
        self.key
    }

    /// The direction to the fill light, a unit vector.
    #[must_use]
    pub fn fill(&self) -> [f64; 3] {
        self.fill
    }

    /// The light that leaves an object of the colour `body` (linear) at a hit that the key light reaches by `lit` (0 to 1; asked with the
    /// cosine of its angle where it shines on the boundary's front) and the light of the sky by `open`.
    #[must_use]
    pub fn shade(&self, hit: &Hit, body: Light, lit: impl FnOnce(f64) -> f32, open: f32) -> Light {
        let n = hit.normal;
        let (facing, fill) = (dot(n, self.key), dot(n, self.fill).max(0.0) as f32 * self.strength * open);
        let lit = if facing > 0.0 { lit(facing) } else { 0.0 };
        let key = lit * facing.max(0.0) as f32;
        let sky = (0.5 + 0.5 * n[2]) as f32;
        let gleam =
            if key > 0.0 { GLEAM * libm::pow(dot(n, self.halfway).max(0.0), GLEAM_EXPONENT) as f32 } else { 0.0 };
        std::array::from_fn(|k| {
            let around = (GROUND[k] + sky * (SKY[k] - GROUND[k])) * open;
            body[k] * (around + key * KEY[k] + fill * FILL[k]) + gleam
        })
    }
}

/// The colour of a face that cuts an object of that colour: warmer, by a share from 0 to 1.
#[must_use]
pub fn tinted(body: Light, share: f32) -> Light {
    let tint = CUT.map(linear);
    std::array::from_fn(|k| body[k] + share * (tint[k] - body[k]))
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn unit(v: [f64; 3]) -> [f64; 3] {
    let length = dot(v, v).sqrt();
    if length > 0.0 { v.map(|c| c / length) } else { v }
}
