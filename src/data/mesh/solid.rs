//! The function itself: value, gradient, bounds.

use super::super::fingerprint::Fingerprint;
use super::super::obj::Surface;
use super::error::MeshError;
use super::topology::{self, Mended};
use super::tree::{Bounds, Tree, WAITING};
use super::triangle::Triangle;
use super::vector::{V, cross, dot, sub};
use crate::interrupt::Interrupt;
use crate::number::{Interval, Leaf};

/// Bytes for each triangle, while the solid is made.
pub(super) const BYTES: usize = size_of::<Triangle>() + 400;

/// What a distance may err, as a part of the largest coordinate.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// Points farther away than this, in sizes of the mesh, see it as a point at the origin.
const FAR: f64 = 1e100;

/// A closed mesh as a function. Its own lengths are in units of a power of 2 near the largest coordinate, so that nothing overflows.
#[derive(Debug)]
pub struct Solid {
    name: String,
    fingerprint: u128,
    /// What a coordinate is multiplied with.
    scale: f64,
    pub(super) tree: Tree,
    pub(super) triangles: Vec<Triangle>,
    bounds: Bounds,
    /// No value inside is larger.
    depth: f64,
}

/// What is known of a point.
#[derive(Clone, Copy)]
struct Found {
    /// The distance.
    far: f64,
    /// The triangle, and what leads from its nearest point to the point.
    triangle: u32,
    way: V,
}

/// The nearest triangle so far.
struct Best {
    square: f64,
    triangle: u32,
    way: V,
    /// Boxes farther away hold nothing nearer, even if all that is computed errs: so the result does not depend on what was looked at first.
    limit: f64,
    err: f64,
}

impl Best {
    fn new(err: f64) -> Self {
        Self { square: f64::INFINITY, triangle: u32::MAX, way: [0.0; 3], limit: f64::INFINITY, err }
    }

    #[inline(always)]
    fn take(&mut self, triangles: &[Triangle], t: u32, p: V) {
        let (square, way) = triangles[t as usize].nearest(p);
        if square < self.square || square == self.square && t < self.triangle {
            let reach = square.sqrt() + self.err;
            (self.square, self.triangle, self.way, self.limit) = (square, t, way, reach * reach);
        }
    }
}

/// What the point before knows, for one that is near it.
#[derive(Clone, Copy)]
struct Before {
    at: V,
    found: Found,
    inside: bool,
}

impl Solid {
    pub(super) fn new(name: &str, mut surface: Surface, interrupt: &Interrupt) -> Result<(Self, Mended), MeshError> {
        let largest = surface.positions.iter().flatten().fold(0.0, |m: f64, c| m.max(c.abs()));
        if largest == 0.0 {
            return Err(MeshError::Empty);
        }
        let scale = 2.0_f64.powi(-(largest.log2().floor() as i32).clamp(-1000, 1000));
        surface.positions.iter_mut().flatten().for_each(|c| *c *= scale);
        let (surface, mended) = topology::closed(surface, interrupt).map_err(|error| unscaled(error, scale))?;
        let corners = |t: &[u32; 3]| t.map(|v| surface.positions[v as usize]);
        let places: Vec<[V; 3]> = surface.triangles.iter().map(corners).collect();
        let volume: f64 = places.iter().map(|[a, b, c]| dot(*a, cross(*b, *c))).sum();
        if volume == 0.0 {
            return Err(MeshError::NoInside);
        }
        let (tree, order) = Tree::new(&places, interrupt)?;
        let outward = |[a, b, c]: [V; 3]| if volume > 0.0 { [a, b, c] } else { [a, c, b] };
        let triangles: Vec<Triangle> = order.iter().map(|&t| Triangle::new(outward(places[t as usize]))).collect();
        let mut bounds = Bounds::NONE;
        places.iter().flatten().for_each(|p| bounds.add(*p));
        let sides = [0, 1, 2].map(|k| bounds.hi[k] - bounds.lo[k]);
        let depth = 0.5 * sides[0].min(sides[1]).min(sides[2]) * (1.0 + ROUNDING) + ROUNDING;
        let mut hash = Fingerprint::new(0x6d65_7368);
        hash.add(scale.to_bits());
        triangles.iter().flat_map(|t| t.corners.iter().flatten()).for_each(|c| hash.add(c.to_bits()));
        let solid = Self { name: name.to_owned(), fingerprint: hash.value(), scale, tree, triangles, bounds, depth };
        Ok((solid, mended))
    }

    /// The number of triangles.
    #[must_use]
    pub fn triangles(&self) -> usize {
        self.triangles.len()
    }

    /// A place of the mesh as the file has it.
    pub(super) fn place(&self, p: V) -> V {
        p.map(|c| c / self.scale)
    }

    /// The nearest triangle of all, the first one where several are equally near. `hint` is one that may be near.
    fn nearest(&self, p: V, hint: Option<u32>) -> Found {
        let mut best = Best::new(ROUNDING * (1.0 + p[0].abs().max(p[1].abs()).max(p[2].abs())));
        if let Some(t) = hint {
            best.take(&self.triangles, t, p);
        }
        let mut waiting = [(0.0, 0usize); WAITING];
        let mut count = 1;
        while count > 0 {
            count -= 1;
            let (away, number) = waiting[count];
            if away > best.limit {
                continue;
            }
            let node = &self.tree.nodes[number];
            let squares = distances(node, p);
            let order = order(&squares);
            for k in order {
                if squares[k] > best.limit {
                    continue;
                }
                match node.child[k].kind() {
                    Ok((first, many)) => (first..first + many).for_each(|t| best.take(&self.triangles, t, p)),
                    Err(child) => {
                        waiting[count] = (squares[k], child);
                        count += 1;
                    }
                }
            }
        }
        Found { far: best.square.sqrt(), triangle: best.triangle, way: best.way }
    }

    /// Whether the mesh goes round the point.
    fn contains(&self, p: V) -> bool {
        if (0..3).any(|k| p[k] < self.bounds.lo[k] || p[k] > self.bounds.hi[k]) {
            return false;
        }
        let back = p[0] < 0.5 * (self.bounds.lo[0] + self.bounds.hi[0]);
        let mut times = 0;
        let mut waiting = [0usize; WAITING];
        let mut count = 1;
        while count > 0 {
            count -= 1;
            let node = &self.tree.nodes[waiting[count]];
            for k in 0..4 {
                let ahead = if back { node.lo[0][k] <= p[0] } else { node.hi[0][k] >= p[0] };
                let y = (node.lo[1][k] <= p[1]) & (node.hi[1][k] >= p[1]);
                let z = (node.lo[2][k] <= p[2]) & (node.hi[2][k] >= p[2]);
                if !(ahead & y & z) {
                    continue;
                }
                match node.child[k].kind() {
                    Ok((first, many)) => {
                        let triangles = &self.triangles[first as usize..(first + many) as usize];
                        times += triangles.iter().map(|t| t.crossing(p, back)).sum::<i32>();
                    }
                    Err(child) => {
                        waiting[count] = child;
                        count += 1;
                    }
                }
            }
        }
        times != 0
    }

    /// All that is known of a point of the scaled space.
    fn find(&self, p: V, before: Option<&Before>) -> Before {
        let found = self.nearest(p, before.map(|b| b.found.triangle));
        let err = ROUNDING * (1.0 + p[0].abs().max(p[1].abs()).max(p[2].abs()));
        let same = before.filter(|b| {
            let step = sub(p, b.at);
            dot(step, step).sqrt() + 4.0 * err < b.found.far
        });
        let inside = match same {
            Some(before) => before.inside,
            None => self.contains(p),
        };
        Before { at: p, found, inside }
    }

    /// The point in the scaled space, unless it is not a number or out of reach.
    fn scaled(&self, at: &[f64]) -> Option<V> {
        let p = [at[0] * self.scale, at[1] * self.scale, at[2] * self.scale];
        p.iter().all(|c| c.abs() < FAR).then_some(p)
    }

    fn signed(&self, known: &Before) -> f64 {
        let value = known.found.far / self.scale;
        if known.inside { value } else { -value }
    }
}

/// The value of points that see the mesh as a point.
fn beyond(at: &[f64]) -> f64 {
    if at.iter().any(|c| c.is_nan()) { f64::NAN } else { -at[0].hypot(at[1]).hypot(at[2]) }
}

/// The squared distances of a point to the boxes of a node.
#[inline(always)]
fn distances(node: &super::tree::Node, p: V) -> [f64; 4] {
    let mut squares = [0.0; 4];
    for ((lo, hi), p) in node.lo.iter().zip(&node.hi).zip(p) {
        for ((lo, hi), square) in lo.iter().zip(hi).zip(&mut squares) {
            let (below, above) = (lo - p, p - hi);
            let side = if below > above { below } else { above };
            let side = if side > 0.0 { side } else { 0.0 };
            *square += side * side;
        }
    }
    squares
}

/// The farthest child first.
#[inline(always)]
fn order(squares: &[f64; 4]) -> [usize; 4] {
    let mut order = [0, 1, 2, 3];
    for (a, b) in [(0, 1), (2, 3), (0, 2), (1, 3), (1, 2)] {
        if squares[order[a]] < squares[order[b]] {
            order.swap(a, b);
        }
    }
    order
}

fn unscaled(error: MeshError, scale: f64) -> MeshError {
    let back = |at: [V; 2]| at.map(|p| p.map(|c| c / scale));
    match error {
        MeshError::Open { open, edges, at } => MeshError::Open { open, edges, at: back(at) },
        MeshError::OneSided { at } => MeshError::OneSided { at: back(at) },
        other => other,
    }
}

impl Leaf for Solid {
    fn fingerprint(&self) -> u128 {
        self.fingerprint
    }

    fn name(&self) -> &str {
        &self.name
    }

    fn arity(&self) -> usize {
        3
    }

    fn value(&self, at: &[f64]) -> f64 {
        match self.scaled(at) {
            Some(p) => self.signed(&self.find(p, None)),
            None => beyond(at),
        }
    }

    fn values(&self, at: &[&[f64]], out: &mut [f64]) {
        let mut before: Option<Before> = None;
        for (i, out) in out.iter_mut().enumerate() {
            let own = [at[0][i], at[1][i], at[2][i]];
            let Some(p) = self.scaled(&own) else {
                *out = beyond(&own);
                continue;
            };
            let known = self.find(p, before.as_ref());
            *out = self.signed(&known);
            before = Some(known);
        }
    }

    fn gradient(&self, at: &[f64], slope: &mut [f64]) -> f64 {
        let Some(p) = self.scaled(at) else {
            let value = beyond(at);
            slope.iter_mut().zip(at).for_each(|(s, c)| *s = if value.is_finite() { c / value } else { f64::NAN });
            return value;
        };
        let known = self.find(p, None);
        let triangle = &self.triangles[known.found.triangle as usize];
        // The value rises towards the mesh outside and away from it inside. On it the normal tells.
        let err = ROUNDING * (1.0 + p[0].abs().max(p[1].abs()).max(p[2].abs()));
        let by = if known.inside { 1.0 } else { -1.0 };
        for ((s, way), normal) in slope.iter_mut().zip(known.found.way).zip(triangle.normal) {
            *s = if known.found.far > err { by * way / known.found.far } else { -normal };
        }
        self.signed(&known)
    }

    fn bounds(&self, over: &[Interval]) -> Interval {
        if over.iter().any(|i| i.is_empty()) {
            return Interval::EMPTY;
        }
        let undefined = over.iter().any(|i| i.undefined);
        let range: [(f64, f64); 3] = std::array::from_fn(|k| (over[k].lo * self.scale, over[k].hi * self.scale));
        let largest = range.iter().fold(0.0, |m: f64, (a, b)| m.max(a.abs()).max(b.abs()));
        let (mut lo, mut hi) = (f64::NEG_INFINITY, self.depth);
        // Nothing is nearer than the box about the mesh.
        let gap: V = std::array::from_fn(|k| {
            (self.bounds.lo[k] - range[k].1).max(range[k].0 - self.bounds.hi[k]).clamp(0.0, FAR)
        });
        let away = dot(gap, gap).sqrt();
        if away > 0.0 {
            hi = -(away * (1.0 - ROUNDING) - ROUNDING).max(0.0);
        }
        if largest < FAR {
            let middle = range.map(|(a, b)| 0.5 * a + 0.5 * b);
            let half = [0, 1, 2].map(|k| (range[k].1 - middle[k]).max(middle[k] - range[k].0));
            let room = ROUNDING * (1.0 + largest);
            let reach = dot(half, half).sqrt() * (1.0 + ROUNDING) + room;
            let known = self.find(middle, None);
            let value = if known.inside { known.found.far } else { -known.found.far };
            lo = value - reach;
            hi = hi.min(value + reach);
        }
        Interval { lo: lo / self.scale, hi: hi / self.scale, undefined }
    }

    fn work(&self) -> usize {
        1_000
    }

    /// The distance never changes faster than the point moves.
    fn slope_bounds(&self, _axis: usize, over: &[Interval]) -> Interval {
        let undefined = over.iter().any(|i| i.undefined || i.lo.is_infinite() || i.hi.is_infinite());
        let most = 1.0 + ROUNDING;
        Interval { lo: -most, hi: most, undefined }
    }
}
