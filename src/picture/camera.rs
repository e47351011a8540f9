//! Cameras: where the eye is and which point of the space a place of the picture and a depth mean. Z is up. Evaluates no function.

use std::f64::consts::{FRAC_PI_2, PI};

/// From where an object is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Where the eye stands, counted about the z axis from the direction of -y (the front) towards +x (the right), in radians.
    pub azimuth: f64,
    /// How far above the horizon the eye stands, in radians, at most a right angle.
    pub elevation: f64,
    /// How the space is projected.
    pub projection: Projection,
}

/// How the space is projected onto the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// All rays start in the eye; the angle that the longer side of the picture subtends, in radians, below pi.
    Perspective(f64),
    /// All rays are parallel.
    Orthographic,
    /// All rays start at this point and look at the middle of what is shown, as wide as that needs; azimuth and elevation count nothing.
    Eye([f64; 3]),
}

/// The usual angle of view: 28 degrees, as of a short telephoto lens.
pub const ANGLE: f64 = 28.0 * PI / 180.0;

impl Default for View {
    fn default() -> Self {
        Self { azimuth: 35.0 * PI / 180.0, elevation: 24.0 * PI / 180.0, projection: Projection::Perspective(ANGLE) }
    }
}

impl View {
    /// The views by their names: their azimuths and elevations in right angles. Those along an axis and `iso` are orthographic.
    pub const NAMES: [(&'static str, f64, f64); 7] = [
        ("iso", 0.5, 0.391_826_552_030_607_23),
        ("front", 0.0, 0.0),
        ("right", 1.0, 0.0),
        ("back", 2.0, 0.0),
        ("left", 3.0, 0.0),
        ("top", 0.0, 1.0),
        ("bottom", 0.0, -1.0),
    ];

    /// A view by its name in any case, `azimuth,elevation` in degrees (perspective), or the place of the eye, `x,y,z`.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        if let Some(&(_, azimuth, elevation)) = Self::NAMES.iter().find(|(known, ..)| known.eq_ignore_ascii_case(name))
        {
            let (azimuth, elevation) = (azimuth * FRAC_PI_2, elevation * FRAC_PI_2);
            return Some(Self { azimuth, elevation, projection: Projection::Orthographic });
        }
        if name.eq_ignore_ascii_case("default") || name.eq_ignore_ascii_case("perspective") {
            return Some(Self::default());
        }
        let number = |text: &str| text.trim().parse::<f64>().ok().filter(|v| v.is_finite());
        let numbers: Vec<f64> = name.split(',').map(number).collect::<Option<_>>()?;
        match numbers[..] {
            [azimuth, elevation] if elevation.abs() <= 90.0 => {
                Some(Self { azimuth: azimuth.to_radians(), elevation: elevation.to_radians(), ..Self::default() })
            }
            [x, y, z] => Some(Self { projection: Projection::Eye([x, y, z]), ..Self::default() }),
            _ => None,
        }
    }

    /// The same view of something about that middle, with an eye turned into angles.
    #[must_use]
    pub fn about(self, middle: [f64; 3]) -> Self {
        let Projection::Eye(eye) = self.projection else { return self };
        let out: [f64; 3] = std::array::from_fn(|k| eye[k] - middle[k]);
        let flat = libm::hypot(out[0], out[1]);
        let azimuth = if flat > 0.0 { libm::atan2(out[0], -out[1]) } else { 0.0 };
        Self { azimuth, elevation: libm::atan2(out[2], flat), ..self }
    }

    /// The same view with all rays parallel.
    #[must_use]
    pub fn level(self, middle: [f64; 3]) -> Self {
        Self { projection: Projection::Orthographic, ..self.about(middle) }
    }

    /// The same view with rays from one eye, unless they are already.
    #[must_use]
    pub fn central(self) -> Self {
        match self.projection {
            Projection::Orthographic => Self { projection: Projection::Perspective(ANGLE), ..self },
            _ => self,
        }
    }

    /// Unit vectors to the right, up, and away from the eye.
    #[must_use]
    pub fn axes(&self) -> [[f64; 3]; 3] {
        let (sa, ca) = turn(self.azimuth);
        let (se, ce) = turn(self.elevation);
        [[ca, sa, 0.0], [-sa * se, ca * se, ce], [-sa * ce, ca * ce, -se]]
    }
}

/// Sine and cosine, exact at right angles, so that views along the axes are.
fn turn(angle: f64) -> (f64, f64) {
    let exact = |v: f64| if v.abs() < 1e-15 { 0.0 } else { v };
    (exact(libm::sin(angle)), exact(libm::cos(angle)))
}

/// A camera that is set up for a picture of some width to height.
///
/// The point at depth `d` behind the place (u, v), both -1..=1 from left to right and from bottom to top, is
/// `eye + forward d + right (u half_width(d)) + up (v half_height(d))`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// The eye, or the middle of the picture's plane for parallel rays.
    pub eye: [f64; 3],
    /// To the right, a unit vector.
    pub right: [f64; 3],
    /// Up, a unit vector.
    pub up: [f64; 3],
    /// Away from the eye, a unit vector.
    pub forward: [f64; 3],
    /// Half the width and height of what is seen at depth 0.
    pub base: [f64; 2],
    /// How they grow by depth: 0 for parallel rays.
    pub growth: [f64; 2],
}

/// How much of the picture stays free on each side.
const MARGIN: f64 = 0.06;

impl Camera {
    /// The camera of that view which sees all of the points (at least one), as large as it can be with a small margin. `aspect` is
    /// width by height.
    #[must_use]
    pub fn framing(view: &View, points: &[[f64; 3]], aspect: f64) -> Self {
        let (lo, hi) = extent(points);
        let view = view.about(std::array::from_fn(|k| 0.5 * (lo[k] + hi[k])));
        Self::along(view.axes(), view.projection, points, aspect)
    }

    /// A camera of parallel rays in that direction (not 0) which sees all of the points in a square picture.
    #[must_use]
    pub fn parallel(forward: [f64; 3], points: &[[f64; 3]]) -> Self {
        let forward = unit(forward);
        let side = if forward[2].abs() < 0.9 { [0.0, 0.0, 1.0] } else { [0.0, 1.0, 0.0] };
        let right = unit(cross(forward, side));
        Self::along([right, cross(right, forward), forward], Projection::Orthographic, points, 1.0)
    }

    fn along(axes: [[f64; 3]; 3], projection: Projection, points: &[[f64; 3]], aspect: f64) -> Self {
        let corners: Vec<[f64; 3]> = points.iter().map(|&point| axes.map(|axis| dot(axis, point))).collect();
        let framed = match projection {
            Projection::Orthographic => level(&corners, aspect),
            Projection::Perspective(angle) => central(&corners, aspect, angle),
            Projection::Eye(eye) => from(axes.map(|axis| dot(axis, eye)), &corners, aspect),
        };
        let [right, up, forward] = axes;
        let eye = std::array::from_fn(|k| (0..3).map(|axis| framed.eye[axis] * axes[axis][k]).sum());
        Self { eye, right, up, forward, base: framed.base, growth: framed.growth }
    }

    /// The first point and the change by depth of the ray through (u, v).
    #[must_use]
    pub fn ray(&self, u: f64, v: f64) -> ([f64; 3], [f64; 3]) {
        let along: [(f64, f64); 3] = std::array::from_fn(|k| self.ray_along(k, u, v));
        (along.map(|(start, _)| start), along.map(|(_, direction)| direction))
    }

    /// The same along one axis.
    #[inline(always)]
    pub(super) fn ray_along(&self, axis: usize, u: f64, v: f64) -> (f64, f64) {
        let at = |[width, height]: [f64; 2]| u * width * self.right[axis] + v * height * self.up[axis];
        (self.eye[axis] + at(self.base), self.forward[axis] + at(self.growth))
    }

    /// Where a point is on the picture, as (u, v) of [`Camera::ray`]; `None` if the eye is not before it.
    #[must_use]
    pub fn place(&self, point: [f64; 3]) -> Option<[f64; 2]> {
        let away: [f64; 3] = std::array::from_fn(|k| point[k] - self.eye[k]);
        let depth = dot(away, self.forward);
        let half = |axis: usize| self.base[axis] + depth * self.growth[axis];
        let at = [dot(away, self.right) / half(0), dot(away, self.up) / half(1)];
        (depth > 0.0 && at.iter().all(|v| v.is_finite())).then_some(at)
    }

    /// The nearest and farthest depth of the box.
    #[must_use]
    pub fn depths(&self, lo: [f64; 3], hi: [f64; 3]) -> (f64, f64) {
        let depth = |corner: [f64; 3]| (0..3).map(|k| (corner[k] - self.eye[k]) * self.forward[k]).sum::<f64>();
        let all = corners(lo, hi).map(depth);
        let near = all.iter().fold(f64::INFINITY, |a, &b| a.min(b));
        (near.max(0.0), all.iter().fold(0.0, |a, &b| f64::max(a, b)))
    }
}

/// A camera in its own axes.
struct Framed {
    eye: [f64; 3],
    base: [f64; 2],
    growth: [f64; 2],
}

/// Parallel rays: the picture's plane lies before all corners.
fn level(corners: &[[f64; 3]], aspect: f64) -> Framed {
    let (lo, hi) = extent(corners);
    let height = (0.5 * (hi[1] - lo[1])).max(0.5 * (hi[0] - lo[0]) / aspect) / (1.0 - MARGIN);
    let height = if height > 0.0 { height } else { 1.0 };
    let eye = [0.5 * (lo[0] + hi[0]), 0.5 * (lo[1] + hi[1]), lo[2] - (hi[2] - lo[2]).max(height)];
    Framed { eye, base: [height * aspect, height], growth: [0.0; 2] }
}

/// The eye as near as it can be: a corner must lie within the slanted planes at the sides of the picture, so for each side the
/// corner that presses most decides; the axis that needs more distance wins, and the other is centred.
fn central(corners: &[[f64; 3]], aspect: f64, angle: f64) -> Framed {
    let longer = libm::tan(0.5 * angle);
    let growth = if aspect >= 1.0 { [longer, longer / aspect] } else { [longer * aspect, longer] };
    let press = |axis: usize, sign: f64| {
        let slope = growth[axis] * (1.0 - MARGIN);
        corners.iter().fold(f64::NEG_INFINITY, |most, c| most.max(sign * c[axis] - slope * c[2]))
    };
    let sides = [[press(0, 1.0), press(0, -1.0)], [press(1, 1.0), press(1, -1.0)]];
    let distance = |axis: usize| -(sides[axis][0] + sides[axis][1]) / (2.0 * growth[axis] * (1.0 - MARGIN));
    let (lo, hi) = extent(corners);
    // A box without extent still needs an eye before it.
    let least = lo[2] - 1e-3 * (hi[2] - lo[2]).max(hi[0] - lo[0]).max(hi[1] - lo[1]);
    let eye =
        [0.5 * (sides[0][0] - sides[0][1]), 0.5 * (sides[1][0] - sides[1][1]), distance(0).min(distance(1)).min(least)];
    Framed { eye, base: [0.0; 2], growth }
}

/// The eye where it stands: the picture is as wide as the corners need, and at most [`WIDEST`].
fn from(eye: [f64; 3], corners: &[[f64; 3]], aspect: f64) -> Framed {
    let widest = libm::tan(0.5 * WIDEST);
    let slope = |axis: usize| {
        let of = |c: &[f64; 3]| {
            let depth = c[2] - eye[2];
            if depth > 0.0 { (c[axis] - eye[axis]).abs() / depth } else { f64::INFINITY }
        };
        corners.iter().map(of).fold(0.0, f64::max) / (1.0 - MARGIN)
    };
    let height = slope(1).max(slope(0) / aspect).min(widest / aspect.max(1.0)).max(1e-6);
    Framed { eye, base: [0.0; 2], growth: [height * aspect, height] }
}

/// The widest angle of view of an eye that stands near or within an object.
const WIDEST: f64 = 100.0 * PI / 180.0;

fn extent(points: &[[f64; 3]]) -> ([f64; 3], [f64; 3]) {
    let first = points.first().copied().unwrap_or_default();
    let fold = |k: usize, f: fn(f64, f64) -> f64| points.iter().map(|p| p[k]).fold(first[k], f);
    (std::array::from_fn(|k| fold(k, f64::min)), std::array::from_fn(|k| fold(k, f64::max)))
}

fn corners(lo: [f64; 3], hi: [f64; 3]) -> [[f64; 3]; 8] {
    std::array::from_fn(|corner| std::array::from_fn(|k| if corner >> k & 1 == 1 { hi[k] } else { lo[k] }))
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn unit(v: [f64; 3]) -> [f64; 3] {
    let length = dot(v, v).sqrt();
    v.map(|c| c / length)
}
