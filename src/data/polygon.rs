//! A simple polygon as one formula in which each edge's half-plane stands once (Rvachev; Peterson; Pasko, Savchenko, Adzhiev and Sourin).
//! Makes the formula only; never evaluates it.

mod simple;

use std::fmt;

use crate::interrupt::{Cancelled, Interrupt};

/// Vertices nearer to the chord of their neighbours than this part of the polygon's size lie on it.
const ON_CHORD: f64 = 1e-12;

/// Vertices equally far from a chain's ends within this part of the polygon's size.
const TIE: f64 = 1e-10;

/// The formula of a polygon, in postfix order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Step {
    /// `a x + b y + c`: the signed distance to an edge's line, positive on the inner side; (a, b) has length 1.
    HalfPlane([f64; 3]),
    /// The intersection of the last two.
    Both,
    /// The union of the last two.
    Either,
}

/// Why there is no formula.
#[derive(Clone, Debug, PartialEq)]
pub enum PolygonError {
    /// Fewer than three vertices are left when repeated ones and those within straight edges are dropped.
    TooFew(usize),
    /// A vertex, counted from 1, is not finite.
    NotFinite(usize),
    /// Two edges, each named by the vertices at its ends, counted from 1, meet where they should not, near a point.
    Crossing {
        /// The vertices of the first.
        first: [usize; 2],
        /// Those of the second.
        second: [usize; 2],
        /// A point of both.
        at: [f64; 2],
    },
    /// The user stopped it.
    Cancelled,
}

impl From<Cancelled> for PolygonError {
    fn from(_: Cancelled) -> Self {
        Self::Cancelled
    }
}

impl fmt::Display for PolygonError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooFew(left) => {
                write!(
                    f,
                    "a polygon has 3 corners or more, and {left} differ here when those on straight edges are dropped"
                )
            }
            Self::NotFinite(vertex) => write!(f, "vertex {vertex} of the polygon is not finite"),
            Self::Crossing { first: [a, b], second: [c, d], at: [x, y] } => write!(
                f,
                "the polygon crosses or touches itself: its edge from vertex {a} to {b} meets that from vertex {c} to {d} at ({x:.6}, {y:.6})"
            ),
            Self::Cancelled => f.write_str("stopped"),
        }
    }
}

/// A simple polygon: counter-clockwise, without repeated vertices and without such on straight edges.
#[derive(Clone, Debug, PartialEq)]
pub struct Polygon {
    corners: Vec<Corner>,
    size: f64,
}

/// A vertex and its number in what was given, from 1.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Corner {
    at: [f64; 2],
    given: usize,
}

impl Polygon {
    /// The polygon of these vertices in either direction; the last may be the first again.
    ///
    /// # Errors
    /// If it is not simple, a coordinate is not finite, fewer than three corners are left, or the interrupt was set.
    pub fn new(vertices: &[[f64; 2]], interrupt: &Interrupt) -> Result<Self, PolygonError> {
        if let Some(bad) = vertices.iter().position(|v| !v.iter().all(|c| c.is_finite())) {
            return Err(PolygonError::NotFinite(bad + 1));
        }
        let size = extent(vertices);
        let all: Vec<Corner> = vertices.iter().enumerate().map(|(i, &at)| Corner { at, given: i + 1 }).collect();
        let mut corners = reduced(all, size);
        if corners.len() < 3 {
            return Err(PolygonError::TooFew(corners.len()));
        }
        simple::check(&corners, interrupt)?;
        if area(&corners) < 0.0 {
            corners.reverse();
        }
        Ok(Self { corners, size })
    }

    /// Its corners, counter-clockwise.
    #[must_use]
    pub fn corners(&self) -> Vec<[f64; 2]> {
        self.corners.iter().map(|corner| corner.at).collect()
    }

    /// Whether a point lies inside: exact, the boundary excepted.
    #[must_use]
    pub fn contains(&self, point: [f64; 2]) -> bool {
        let mut inside = false;
        for (a, b) in self.edges() {
            if (a[1] > point[1]) != (b[1] > point[1]) {
                let (low, high) = if a[1] < b[1] { (a, b) } else { (b, a) };
                inside ^= simple::turn(low, high, point) > 0.0;
            }
        }
        inside
    }

    /// Two edges, one of each polygon by the vertices at its ends, that meet, and where.
    ///
    /// # Errors
    /// [`PolygonError::Cancelled`] soon after the interrupt was set.
    pub fn meets(&self, other: &Self, interrupt: &Interrupt) -> Result<Option<simple::Meeting>, PolygonError> {
        Ok(simple::between(&self.corners, &other.corners, interrupt)?)
    }

    fn edges(&self) -> impl Iterator<Item = ([f64; 2], [f64; 2])> {
        let next = self.corners.iter().cycle().skip(1);
        self.corners.iter().zip(next).map(|(a, b)| (a.at, b.at))
    }

    /// The formula, with as many half-planes as the polygon has corners, in postfix order. The signs of its value, with min for
    /// [`Step::Both`] and max for [`Step::Either`] or any R-functions, are those of the polygon; nothing inside is zero.
    ///
    /// # Errors
    /// [`PolygonError::Cancelled`] soon after the interrupt was set.
    pub fn formula(&self, interrupt: &Interrupt) -> Result<Vec<Step>, PolygonError> {
        let n = self.corners.len();
        let order = |a: &usize, b: &usize| {
            let (p, q) = (self.corners[*a].at, self.corners[*b].at);
            p[0].total_cmp(&q[0]).then(p[1].total_cmp(&q[1]))
        };
        let least = (0..n).min_by(order).unwrap_or(0);
        let most = (0..n).max_by(order).unwrap_or(0);
        let chain = |from: usize, to: usize| {
            let length = (to + n - from) % n;
            (0..=length).map(|i| self.corners[(from + i) % n].at).collect::<Vec<_>>()
        };
        let mut steps = Vec::with_capacity(2 * n);
        self.chain(&chain(least, most), &mut steps, interrupt)?;
        self.chain(&chain(most, least), &mut steps, interrupt)?;
        steps.push(Step::Both);
        Ok(steps)
    }

    fn chain(&self, chain: &[[f64; 2]], steps: &mut Vec<Step>, interrupt: &Interrupt) -> Result<(), PolygonError> {
        let mut tasks = vec![Task::Chain(0, chain.len() - 1)];
        while let Some(task) = tasks.pop() {
            interrupt.tick()?;
            match task {
                Task::Chain(first, last) if last == first + 1 => {
                    steps.push(Step::HalfPlane(half_plane(chain[first], chain[last])));
                }
                Task::Chain(first, last) => {
                    let at = first + split(&chain[first..=last], self.size);
                    let left = simple::turn(chain[at - 1], chain[at], chain[at + 1]) > 0.0;
                    tasks.push(Task::Join(if left { Step::Both } else { Step::Either }));
                    tasks.push(Task::Chain(at, last));
                    tasks.push(Task::Chain(first, at));
                }
                Task::Join(step) => steps.push(step),
            }
        }
        Ok(())
    }
}

/// What is left to do on a chain of vertices.
enum Task {
    Chain(usize, usize),
    Join(Step),
}

/// The inner vertex of a chain that lies farthest out: where the support line of the mean direction of its end edges touches it.
fn split(chain: &[[f64; 2]], size: f64) -> usize {
    let last = chain.len() - 1;
    let u = unit(difference(chain[0], chain[1]));
    let w = unit(difference(chain[last], chain[last - 1]));
    let mut out = [-(u[0] + w[0]), -(u[1] + w[1])];
    if out[0].hypot(out[1]) < 1e-9 {
        out = [-u[1], u[0]];
    }
    let out = unit(out);
    let along = [-out[1], out[0]];
    let measure = |by: [f64; 2], p: [f64; 2]| by[0] * (p[0] - chain[0][0]) + by[1] * (p[1] - chain[0][1]);
    let mut best = 1;
    for i in 2..last {
        let gain = measure(out, chain[i]) - measure(out, chain[best]);
        let further = measure(along, chain[i]) > measure(along, chain[best]);
        if gain > TIE * size || (gain >= -TIE * size && further) {
            best = i;
        }
    }
    best
}

fn difference(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

fn unit([x, y]: [f64; 2]) -> [f64; 2] {
    let length = x.hypot(y);
    [x / length, y / length]
}

/// The signed distance to the line from a to b, positive on its left.
fn half_plane(a: [f64; 2], b: [f64; 2]) -> [f64; 3] {
    let [dx, dy] = unit(difference(b, a));
    [-dy, dx, dy * a[0] - dx * a[1]]
}

fn extent(vertices: &[[f64; 2]]) -> f64 {
    let side = |axis: usize| {
        let lo = vertices.iter().map(|v| v[axis]).fold(f64::INFINITY, f64::min);
        let hi = vertices.iter().map(|v| v[axis]).fold(f64::NEG_INFINITY, f64::max);
        hi - lo
    };
    side(0).max(side(1)).max(0.0)
}

/// Without vertices that repeat the one before or lie on the chord of their neighbours, until none is left.
fn reduced(mut corners: Vec<Corner>, size: f64) -> Vec<Corner> {
    let near = ON_CHORD * size;
    loop {
        let before = corners.len();
        let mut kept: Vec<Corner> = Vec::with_capacity(before);
        for (i, corner) in corners.iter().enumerate() {
            let previous = kept.last().copied().unwrap_or(corners[before - 1]);
            let next = corners[(i + 1) % before];
            if before < 3 || !on_chord(previous.at, corner.at, next.at, near) {
                kept.push(*corner);
            }
        }
        if kept.len() == before {
            return kept;
        }
        corners = kept;
    }
}

/// Whether b adds nothing between a and c: it repeats one of them, or lies between them. A spike that returns does not.
fn on_chord(a: [f64; 2], b: [f64; 2], c: [f64; 2], near: f64) -> bool {
    let (ab, bc) = (difference(b, a), difference(c, b));
    if ab[0].hypot(ab[1]) <= near || bc[0].hypot(bc[1]) <= near {
        return true;
    }
    let ac = difference(c, a);
    let length = ac[0].hypot(ac[1]);
    let between = ab[0] * bc[0] + ab[1] * bc[1] > 0.0;
    between && (ab[0] * ac[1] - ab[1] * ac[0]).abs() <= near * length
}

/// Twice the signed area.
fn area(corners: &[Corner]) -> f64 {
    let origin = corners[0].at;
    let next = corners.iter().cycle().skip(1);
    let cross = |(a, b): (&Corner, &Corner)| {
        let (a, b) = (difference(a.at, origin), difference(b.at, origin));
        a[0] * b[1] - a[1] * b[0]
    };
    corners.iter().zip(next).map(cross).sum()
}
