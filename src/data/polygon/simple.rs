//! Whether the edges of polygons meet where they should not: exact signs, edges in the order of their left ends. Knows no formula.

use robust::{Coord, orient2d};

use super::{Corner, PolygonError};
use crate::interrupt::{Cancelled, Interrupt};

/// Two edges that meet: the vertices at their ends, and a point of both.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Meeting {
    /// The vertices of the first edge, counted from 1.
    pub first: [usize; 2],
    /// Those of the second.
    pub second: [usize; 2],
    /// A point of both.
    pub at: [f64; 2],
}

/// Positive where c lies to the left of the line from a to b; exact in its sign.
pub(super) fn turn(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    let coord = |p: [f64; 2]| Coord { x: p[0], y: p[1] };
    orient2d(coord(a), coord(b), coord(c))
}

/// An edge, and which of which polygon it is.
#[derive(Clone, Copy)]
struct Edge {
    ends: [[f64; 2]; 2],
    given: [usize; 2],
    polygon: usize,
    place: usize,
}

impl Edge {
    fn span(&self, axis: usize) -> (f64, f64) {
        let [a, b] = [self.ends[0][axis], self.ends[1][axis]];
        (a.min(b), a.max(b))
    }
}

/// The polygon must be simple.
pub(super) fn check(corners: &[Corner], interrupt: &Interrupt) -> Result<(), PolygonError> {
    let n = corners.len();
    let met = sweep(edges(corners, 0), interrupt, |a, b| {
        let neighbours = (a.place + 1) % n == b.place || (b.place + 1) % n == a.place;
        if neighbours { overlap(a, b, n) } else { meeting(a, b) }
    })?;
    match met {
        Some(Meeting { first, second, at }) => Err(PolygonError::Crossing { first, second, at }),
        None => Ok(()),
    }
}

/// A meeting of an edge of one polygon with one of another.
pub(super) fn between(one: &[Corner], other: &[Corner], interrupt: &Interrupt) -> Result<Option<Meeting>, Cancelled> {
    let mut all = edges(one, 0);
    all.extend(edges(other, 1));
    sweep(all, interrupt, |a, b| {
        let (a, b) = if a.polygon < b.polygon { (a, b) } else { (b, a) };
        if a.polygon == b.polygon { None } else { meeting(a, b) }
    })
}

fn edges(corners: &[Corner], polygon: usize) -> Vec<Edge> {
    let next = corners.iter().cycle().skip(1);
    let pairs = corners.iter().zip(next).enumerate();
    pairs.map(|(place, (a, b))| Edge { ends: [a.at, b.at], given: [a.given, b.given], polygon, place }).collect()
}

/// The first meeting that `test` finds among the edges whose boxes meet.
fn sweep(
    mut edges: Vec<Edge>,
    interrupt: &Interrupt,
    test: impl Fn(&Edge, &Edge) -> Option<Meeting>,
) -> Result<Option<Meeting>, Cancelled> {
    edges.sort_by(|a, b| a.span(0).0.total_cmp(&b.span(0).0));
    let mut active: Vec<Edge> = Vec::new();
    for edge in edges {
        interrupt.tick()?;
        let (left, _) = edge.span(0);
        active.retain(|other| other.span(0).1 >= left);
        let (low, high) = edge.span(1);
        for other in &active {
            let (other_low, other_high) = other.span(1);
            if other_low <= high
                && low <= other_high
                && let Some(met) = test(other, &edge)
            {
                return Ok(Some(met));
            }
        }
        active.push(edge);
    }
    Ok(None)
}

/// Where two edges meet, ends included.
fn meeting(a: &Edge, b: &Edge) -> Option<Meeting> {
    let sides = [turn(a.ends[0], a.ends[1], b.ends[0]), turn(a.ends[0], a.ends[1], b.ends[1])];
    let across = [turn(b.ends[0], b.ends[1], a.ends[0]), turn(b.ends[0], b.ends[1], a.ends[1])];
    let apart = |s: [f64; 2]| (s[0] > 0.0 && s[1] > 0.0) || (s[0] < 0.0 && s[1] < 0.0);
    if apart(sides) || apart(across) {
        return None;
    }
    if sides == [0.0, 0.0] && ![0, 1].into_iter().all(|axis| overlaps(a.span(axis), b.span(axis))) {
        return None;
    }
    let at = if sides == [0.0, 0.0] {
        // On one line: the end of one that lies within the other.
        let axis = usize::from((a.ends[0][0] - a.ends[1][0]).abs() < (a.ends[0][1] - a.ends[1][1]).abs());
        let (low, high) = a.span(axis);
        let within = |p: &&[f64; 2]| low <= p[axis] && p[axis] <= high;
        *b.ends.iter().find(within).unwrap_or(&a.ends[0])
    } else {
        let t = sides[0] / (sides[0] - sides[1]);
        std::array::from_fn(|i| b.ends[0][i] + t * (b.ends[1][i] - b.ends[0][i]))
    };
    Some(Meeting { first: a.given, second: b.given, at })
}

fn overlaps(a: (f64, f64), b: (f64, f64)) -> bool {
    a.0 <= b.1 && b.0 <= a.1
}

/// Neighbours share a corner; they meet elsewhere only if one goes back over the other.
fn overlap(a: &Edge, b: &Edge, n: usize) -> Option<Meeting> {
    let (before, after) = if (a.place + 1) % n == b.place { (a, b) } else { (b, a) };
    let [p, q] = before.ends;
    let r = after.ends[1];
    let back = (q[0] - p[0]) * (r[0] - q[0]) + (q[1] - p[1]) * (r[1] - q[1]) < 0.0;
    (back && turn(p, q, r) == 0.0).then_some(Meeting { first: before.given, second: after.given, at: q })
}
