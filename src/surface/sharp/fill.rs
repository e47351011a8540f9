//! Fills a polygon of a cell with triangles, each on one smooth surface. Whatever it is given, the triangles are one disc whose chords lie in no
//! face of the cell, so that the mesh stays as closed and as much of a manifold as it was. Evaluates nothing.

use super::super::mesh::{cross, dot, minus};

/// A corner of a polygon.
#[derive(Clone, Debug)]
pub(super) struct Corner {
    pub(super) vertex: u32,
    pub(super) at: [f64; 3],
    /// The faces of the cell in which it lies, a bit each.
    pub(super) faces: u8,
    /// The pieces on whose surfaces it lies, a bit each.
    pub(super) on: u64,
    /// The normal of each piece there.
    pub(super) normals: Vec<[f64; 3]>,
}

/// The surfaces of a polygon: pieces that go over into each other smoothly are one.
#[derive(Clone, Debug)]
pub(super) struct Surfaces {
    /// The pieces of the surface of each piece, a bit each.
    pub(super) of: Vec<u64>,
}

impl Surfaces {
    pub(super) fn new(pieces: usize) -> Self {
        Self { of: (0..pieces).map(|piece| 1 << piece).collect() }
    }

    /// Two pieces are one surface.
    pub(super) fn join(&mut self, a: usize, b: usize) {
        let both = self.of[a] | self.of[b];
        (0..self.of.len()).filter(|piece| both >> piece & 1 == 1).for_each(|piece| self.of[piece] = both);
    }

    /// All pieces of the surfaces of some pieces.
    pub(super) fn whole(&self, pieces: u64) -> u64 {
        (0..self.of.len()).filter(|piece| pieces >> piece & 1 == 1).fold(0, |all, piece| all | self.of[piece])
    }

    /// The pieces of the surfaces on which all corners lie.
    pub(super) fn common<'a>(&self, corners: impl IntoIterator<Item = &'a Corner>) -> u64 {
        corners.into_iter().fold(u64::MAX, |common, corner| common & self.whole(corner.on))
    }

    /// Whether a triangle lies on one surface, and whether it is turned against it.
    fn judge(&self, triangle: [&Corner; 3]) -> (bool, bool) {
        let common = self.common(triangle);
        if common == 0 {
            return (false, false);
        }
        let [a, b, c] = triangle.map(|corner| corner.at);
        let normal = cross(minus(b, a), minus(c, a));
        let surface = self.of[common.trailing_zeros() as usize];
        let out: f64 = triangle
            .iter()
            .map(|corner| {
                let piece = (corner.on & surface).trailing_zeros() as usize;
                corner.normals.get(piece).map_or(0.0, |n| dot(*n, normal))
            })
            .sum();
        let size = dot(minus(b, a), minus(b, a)) + dot(minus(c, a), minus(c, a));
        (true, out < -1e-9 * size)
    }
}

/// What a way to fill a polygon is worth: triangles on no one surface, triangles that are turned, lengths of chords.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
struct Cost(u32, u32, f64);

impl Cost {
    fn plus(self, other: Self) -> Self {
        Self(self.0 + other.0, self.1 + other.1, self.2 + other.2)
    }
}

/// Triangles by positions in the polygon.
#[derive(Clone, Debug)]
pub(super) struct Filling {
    pub(super) triangles: Vec<[usize; 3]>,
    /// Each triangle lies on one surface and none is turned.
    pub(super) is_sharp: bool,
}

/// The best way to fill a polygon without a new vertex, if there is one at all.
pub(super) fn cut(corners: &[Corner], surfaces: &Surfaces) -> Option<Filling> {
    let n = corners.len();
    let chord = |i: usize, j: usize| {
        if j - i == 1 || j - i == n - 1 {
            return Some(0.0);
        }
        let way = minus(corners[i].at, corners[j].at);
        (corners[i].faces & corners[j].faces == 0).then(|| dot(way, way))
    };
    // best[i][j]: the least cost of the part of the polygon from i to j, and the corner that makes the triangle on that side.
    let mut best = vec![vec![Some((Cost(0, 0, 0.0), 0)); n]; n];
    for span in 2..n {
        for i in 0..n - span {
            let j = i + span;
            let ways = (i + 1..j).filter_map(|k| {
                let (is_one, is_turned) = surfaces.judge([&corners[i], &corners[k], &corners[j]]);
                let own = Cost(u32::from(!is_one), u32::from(is_turned), chord(i, j)?);
                Some((best[i][k]?.0.plus(best[k][j]?.0).plus(own), k))
            });
            best[i][j] = ways.fold(None, |least: Option<(Cost, usize)>, way| match least {
                Some(old) if old.0 <= way.0 => Some(old),
                _ => Some(way),
            });
        }
    }
    let cost = best[0][n - 1]?.0;
    let (mut triangles, mut open) = (Vec::new(), vec![(0, n - 1)]);
    while let Some((i, j)) = open.pop() {
        if j - i < 2 {
            continue;
        }
        let (_, k) = best[i][j]?;
        triangles.push([i, k, j]);
        open.extend([(i, k), (k, j)]);
    }
    Some(Filling { triangles, is_sharp: cost.0 == 0 && cost.1 == 0 })
}
