//! One triangle: the nearest point of it, and how often a ray along x1 goes through it.

use robust::{Coord, Coord3D, orient2d, orient3d};

use super::vector::{V, along, cross, dot, sub};

/// Triangles whose height is a smaller part of their longest side count as their sides: their plane is not known.
const THIN: f64 = 1e-7;

/// A triangle with what its distances need.
#[derive(Clone, Copy, Debug)]
pub(super) struct Triangle {
    pub(super) corners: [V; 3],
    /// The unit normal, outward where the mesh is; zero where there is none.
    pub(super) normal: V,
    /// Across each side, outward and within the plane; any length.
    across: [V; 3],
    /// From each corner to the next.
    side: [V; 3],
    /// 1 over the squared length of each side; 0 for none.
    inverse: [f64; 3],
}

impl Triangle {
    pub(super) fn new(corners: [V; 3]) -> Self {
        let [a, b, c] = corners;
        let side = [sub(b, a), sub(c, b), sub(a, c)];
        let squares = side.map(|s| dot(s, s));
        // The cross product of the two shorter sides loses least.
        let longest = (0..3).fold(0, |best, k| if squares[k] > squares[best] { k } else { best });
        let area = cross(side[(longest + 1) % 3], side[(longest + 2) % 3]);
        let length = dot(area, area).sqrt();
        let flat = length > THIN * squares[longest];
        let normal = if flat { area.map(|n| n / length) } else { [0.0; 3] };
        let inverse = squares.map(|s| if s > 0.0 { 1.0 / s } else { 0.0 });
        Self { corners, normal, across: side.map(|s| cross(s, normal)), side, inverse }
    }

    /// The squared distance of a point, and what leads from the nearest point of the triangle to it.
    #[inline(always)]
    pub(super) fn nearest(&self, p: V) -> (f64, V) {
        let from = [sub(p, self.corners[0]), sub(p, self.corners[1]), sub(p, self.corners[2])];
        let beyond = [
            dot(self.across[0], from[0]) > 0.0,
            dot(self.across[1], from[1]) > 0.0,
            dot(self.across[2], from[2]) > 0.0,
        ];
        let any = self.is_thin();
        if !(beyond[0] | beyond[1] | beyond[2] | any) {
            let height = dot(self.normal, from[0]);
            return (height * height, along([0.0; 3], height, self.normal));
        }
        // The nearest point lies on a side that the point sees; of one without a plane, on any.
        let mut best = (f64::INFINITY, [0.0; 3]);
        for k in 0..3 {
            if beyond[k] | any {
                let t = (dot(self.side[k], from[k]) * self.inverse[k]).clamp(0.0, 1.0);
                let way = along(from[k], -t, self.side[k]);
                let square = dot(way, way);
                if square < best.0 {
                    best = (square, way);
                }
            }
        }
        best
    }

    /// Whether it has no plane to speak of.
    #[inline(always)]
    fn is_thin(&self) -> bool {
        self.normal[0] == 0.0 && self.normal[1] == 0.0 && self.normal[2] == 0.0
    }

    /// 1 if the ray from a point towards larger x1 leaves the solid here, -1 if it enters, 0 if it misses; with `back`, the ray towards
    /// smaller x1. A ray through a side goes through exactly one of the triangles on each of its two sides, so that the sum over a closed
    /// mesh is the number of times that the mesh goes round the point.
    pub(super) fn crossing(&self, p: V, back: bool) -> i32 {
        let wind = self.wind(p);
        if wind == 0 {
            return 0;
        }
        let [a, b, c, d] = [self.corners[0], self.corners[1], self.corners[2], p].map(|[x, y, z]| Coord3D { x, y, z });
        let ahead = orient3d(a, b, c, d) * f64::from(wind) > 0.0;
        match (ahead, back) {
            (true, false) | (false, true) => wind,
            _ => 0,
        }
    }

    /// How often the triangle, seen along x1, goes round the point: -1, 0 or 1.
    fn wind(&self, p: V) -> i32 {
        let flat = |v: V| Coord { x: v[1], y: v[2] };
        let mut wind = 0;
        for k in 0..3 {
            let (a, b) = (self.corners[k], self.corners[(k + 1) % 3]);
            let (above_a, above_b) = (a[2] > p[2], b[2] > p[2]);
            if above_a == above_b {
                continue;
            }
            // The same numbers in the same order for both triangles of a side.
            let (low, high, up) = if above_b { (a, b, 1) } else { (b, a, -1) };
            if orient2d(flat(low), flat(high), flat(p)) > 0.0 {
                wind += up;
            }
        }
        wind
    }
}
