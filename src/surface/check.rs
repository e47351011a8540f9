//! The proof that a mesh is closed, oriented and 2-manifold: before it is written, never instead of making it so.
//!
//! Checked: every vertex is finite and the corners of every triangle differ, also after rounding to single precision as STL does; no two
//! vertices become one by that rounding; each directed edge is used once and its reverse once; the triangles about a vertex are one fan.
//! Not checked: whether triangles cut through each other.

use std::fmt;
use std::sync::atomic::{AtomicU32, Ordering};

use rayon::prelude::*;

use super::mesh::Mesh;

/// Triangles about a vertex that are few: it is quicker to look through them than to sort them.
const FEW: usize = 32;

/// What is wrong with a mesh, and where.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fault {
    /// A vertex has a coordinate that is not finite, or is too large for single precision.
    NotFinite(usize),
    /// A triangle names a vertex that does not exist.
    NoSuchVertex(usize),
    /// Two corners of a triangle are one, at this place.
    Degenerate(usize, [f64; 3]),
    /// Two vertices become one in single precision.
    Coincident(usize, usize, [f64; 3]),
    /// A directed edge is used by more than one triangle.
    Repeated([f64; 3], [f64; 3]),
    /// An edge has a triangle on one side only.
    Open([f64; 3], [f64; 3]),
    /// The triangles about a vertex are more than one fan.
    Fans([f64; 3]),
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let at = |[x, y, z]: [f64; 3]| format!("({x:.6}, {y:.6}, {z:.6})");
        match *self {
            Self::NotFinite(v) => write!(f, "vertex {v} is not finite in single precision"),
            Self::NoSuchVertex(t) => write!(f, "triangle {t} names a vertex that does not exist"),
            Self::Degenerate(t, p) => write!(f, "two corners of triangle {t} are one at {}", at(p)),
            Self::Coincident(a, b, p) => {
                write!(f, "vertices {a} and {b} are one in single precision at {}: cells are too small there", at(p))
            }
            Self::Repeated(a, b) => write!(f, "the edge from {} to {} is used twice", at(a), at(b)),
            Self::Open(a, b) => write!(f, "the edge from {} to {} has a triangle on one side only", at(a), at(b)),
            Self::Fans(p) => write!(f, "the triangles about {} are more than one fan", at(p)),
        }
    }
}

impl std::error::Error for Fault {}

/// What a checked mesh is like.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Topology {
    /// Vertices that triangles use.
    pub vertices: usize,
    /// Edges, each counted once.
    pub edges: usize,
    /// Triangles.
    pub triangles: usize,
    /// Euler characteristic: vertices - edges + triangles.
    pub euler: i64,
    /// Connected parts of the surface; a cavity is one too.
    pub components: usize,
    /// Handles of all components together.
    pub genus: i64,
}

/// Checks a mesh. The first fault by number of triangle or vertex is told.
///
/// # Errors
/// A [`Fault`] if the mesh is not closed, oriented and 2-manifold.
pub fn check(mesh: &Mesh) -> Result<Topology, Fault> {
    check_vertices(mesh)?;
    check_triangles(mesh)?;
    let corners = Corners::of(mesh);
    let fault = (0..mesh.positions.len()).into_par_iter().find_map_first(|v| corners.fault(mesh, v));
    if let Some(fault) = fault {
        return Err(fault);
    }
    let vertices = corners.start.windows(2).filter(|pair| pair[0] < pair[1]).count();
    let triangles = mesh.triangles.len();
    let edges = triangles * 3 / 2;
    let euler = vertices as i64 - edges as i64 + triangles as i64;
    let components = components(mesh, |v| corners.start[v] < corners.start[v + 1]);
    Ok(Topology { vertices, edges, triangles, euler, components, genus: components as i64 - euler / 2 })
}

/// Checks the vertices of a mesh, and the triangles about some of them: what is left to check where the rest is as it was.
///
/// # Errors
/// A [`Fault`] about one of those vertices.
pub(super) fn check_about(mesh: &Mesh, is_about: &[bool]) -> Result<(), Fault> {
    check_vertices(mesh)?;
    let is_near = |t: &&[u32; 3]| t.iter().any(|&v| is_about.get(v as usize).is_none_or(|about| *about));
    let near: Vec<[u32; 3]> = mesh.triangles.par_iter().filter(is_near).copied().collect();
    let (mut numbers, mut vertices) = (vec![u32::MAX; mesh.positions.len()], Vec::new());
    for &v in near.iter().flatten() {
        let number = numbers.get_mut(v as usize).ok_or(Fault::NoSuchVertex(0))?;
        if *number == u32::MAX {
            *number = vertices.len() as u32;
            vertices.push(v);
        }
    }
    let part = Mesh {
        positions: vertices.iter().map(|&v| mesh.positions[v as usize]).collect(),
        normals: Vec::new(),
        triangles: near.iter().map(|t| t.map(|v| numbers[v as usize])).collect(),
    };
    check_triangles(&part)?;
    let corners = Corners::of(&part);
    let about = vertices.par_iter().enumerate().filter(|(_, v)| is_about[**v as usize]);
    match about.find_map_first(|(v, _)| corners.fault(&part, v)) {
        Some(fault) => Err(fault),
        None => Ok(()),
    }
}

/// The bits of a coordinate in single precision; both zeros are one.
fn single(position: [f64; 3]) -> [u32; 3] {
    position.map(|c| (c as f32 + 0.0).to_bits())
}

fn check_vertices(mesh: &Mesh) -> Result<(), Fault> {
    let is_bad = |p: &[f64; 3]| p.iter().any(|&c| !(c as f32).is_finite());
    if let Some(v) = mesh.positions.par_iter().position_first(is_bad) {
        return Err(Fault::NotFinite(v));
    }
    if !has_twins(&mesh.positions) {
        return Ok(());
    }
    let mut rounded: Vec<([u32; 3], usize)> =
        mesh.positions.par_iter().enumerate().map(|(v, &p)| (single(p), v)).collect();
    rounded.par_sort_unstable();
    let twins = rounded.windows(2).filter(|pair| pair[0].0 == pair[1].0);
    match twins.map(|pair| (pair[0].1, pair[1].1)).min() {
        Some((a, b)) => Err(Fault::Coincident(a, b, mesh.positions[a])),
        None => Ok(()),
    }
}

/// Whether two vertices are one in single precision: each is put into a table at the place of its hash, or behind it. Which of two comes
/// first depends on the threads; whether there are two does not.
fn has_twins(positions: &[[f64; 3]]) -> bool {
    let size = (2 * positions.len()).next_power_of_two().max(2);
    let shift = 64 - size.trailing_zeros();
    let places: Vec<AtomicU32> = (0..size).into_par_iter().map(|_| AtomicU32::new(u32::MAX)).collect();
    positions.par_iter().enumerate().with_min_len(1024).any(|(v, &position)| {
        let bits = single(position);
        let mut at = (hash(bits) >> shift) as usize;
        loop {
            match places[at].compare_exchange(u32::MAX, v as u32, Ordering::Relaxed, Ordering::Relaxed) {
                Ok(_) => return false,
                Err(other) if single(positions[other as usize]) == bits => return true,
                Err(_) => at = (at + 1) % size,
            }
        }
    })
}

/// A number whose upper bits depend on all bits: multiplied by large odd constants.
fn hash([a, b, c]: [u32; 3]) -> u64 {
    let mixed = (u64::from(a) | u64::from(b) << 32).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    (mixed.rotate_left(29) ^ u64::from(c)).wrapping_mul(0xd6e8_feb8_6659_fd93)
}

fn check_triangles(mesh: &Mesh) -> Result<(), Fault> {
    let count = mesh.positions.len();
    if let Some(t) = mesh.triangles.par_iter().position_first(|t| t.iter().any(|&v| v as usize >= count)) {
        return Err(Fault::NoSuchVertex(t));
    }
    let is_degenerate = |&[a, b, c]: &[u32; 3]| a == b || b == c || c == a;
    match mesh.triangles.par_iter().position_first(is_degenerate) {
        Some(t) => Err(Fault::Degenerate(t, mesh.corners(mesh.triangles[t])[0])),
        None => Ok(()),
    }
}

/// For each vertex the triangles about it: the corner that follows it and the one before it.
struct Corners {
    start: Vec<usize>,
    sides: Vec<[u32; 2]>,
}

impl Corners {
    /// Each thread looks at all triangles and gathers those about its own range of vertices.
    fn of(mesh: &Mesh) -> Self {
        let (count, corners) = (mesh.positions.len(), mesh.triangles.len() * 3);
        let range = count.div_ceil(rayon::current_num_threads()).max(1);
        let mut start = vec![0; count + 1];
        start[1..].par_chunks_mut(range).enumerate().for_each(|(n, counts)| {
            for &v in mesh.triangles.iter().flatten() {
                if let Some(count) = counts.get_mut((v as usize).wrapping_sub(n * range)) {
                    *count += 1;
                }
            }
        });
        for i in 1..start.len() {
            start[i] += start[i - 1];
        }
        let mut sides = vec![[0; 2]; corners];
        let mut rest = &mut sides[..];
        let parts: Vec<&mut [[u32; 2]]> = (0..count)
            .step_by(range)
            .map(|from| {
                let own = start[count.min(from + range)] - start[from];
                rest.split_off_mut(..own).unwrap_or_default()
            })
            .collect();
        parts.into_par_iter().enumerate().for_each(|(n, sides)| {
            let from = n * range;
            let base = start[from];
            let mut free = start[from..count.min(from + range)].to_vec();
            for &[a, b, c] in &mesh.triangles {
                for [v, next, last] in [[a, b, c], [b, c, a], [c, a, b]] {
                    if let Some(free) = free.get_mut((v as usize).wrapping_sub(from)) {
                        sides[*free - base] = [next, last];
                        *free += 1;
                    }
                }
            }
        });
        Self { start, sides }
    }

    /// Whether a way from triangle to triangle about a vertex passes all of a few and ends where it began. Then all outgoing edges differ,
    /// or the way would never come to the second of two equal ones, and each has its reverse.
    fn is_fan(about: &[[u32; 2]]) -> bool {
        let mut at = 0;
        for turn in 1..=about.len() {
            let Some(next) = about.iter().position(|side| side[0] == about[at][1]) else { return false };
            at = next;
            if at == 0 {
                return turn == about.len();
            }
        }
        about.is_empty()
    }

    /// What is wrong about vertex v. Its outgoing edges must differ, its incoming ones be their reverses, and going round from triangle
    /// to triangle must pass all of them.
    fn fault(&self, mesh: &Mesh, v: usize) -> Option<Fault> {
        let about = &self.sides[self.start[v]..self.start[v + 1]];
        if about.len() <= FEW && Self::is_fan(about) {
            return None;
        }
        let (from, place) = (mesh.positions[v], |v: u32| mesh.positions[v as usize]);
        let mut outgoing = about.to_vec();
        outgoing.sort_unstable();
        let find = |other: u32| outgoing.partition_point(|side| side[0] < other);
        let is_there = |other: u32| outgoing.get(find(other)).is_some_and(|side| side[0] == other);
        if let Some(pair) = outgoing.windows(2).find(|pair| pair[0][0] == pair[1][0]) {
            return Some(Fault::Repeated(from, place(pair[0][0])));
        }
        if let Some(side) = about.iter().find(|side| !is_there(side[1])) {
            return Some(Fault::Open(place(side[1]), from));
        }
        let mut at = 0;
        for turn in 1..=outgoing.len() {
            at = find(outgoing[at][1]);
            if at == 0 {
                return (turn < outgoing.len()).then_some(Fault::Fans(from));
            }
        }
        (!outgoing.is_empty()).then_some(Fault::Repeated(from, from))
    }
}

/// Connected parts: sets of vertices joined by triangles. Sets are trees that hang from their smallest vertices; threads join them at once,
/// and how many there are does not depend on who came first.
fn components(mesh: &Mesh, is_used: impl Fn(usize) -> bool + Sync) -> usize {
    let count = mesh.positions.len();
    let parents: Vec<AtomicU32> = (0..count as u32).into_par_iter().map(AtomicU32::new).collect();
    mesh.triangles.par_iter().with_min_len(1024).for_each(|&[a, b, c]| {
        join(&parents, a, b);
        join(&parents, a, c);
    });
    (0..count).into_par_iter().filter(|&v| is_used(v) && parents[v].load(Ordering::Relaxed) as usize == v).count()
}

/// Makes one set of those of two vertices.
fn join(parents: &[AtomicU32], a: u32, b: u32) {
    let (mut p, mut q) = (root(parents, a), root(parents, b));
    while p != q {
        let (low, high) = (p.min(q), p.max(q));
        // Only a root gets a parent; if it is none any more, the way up goes on.
        if parents[high as usize].compare_exchange(high, low, Ordering::Relaxed, Ordering::Relaxed).is_ok() {
            return;
        }
        (p, q) = (root(parents, low), root(parents, high));
    }
}

/// The root of a vertex; halves the path to it.
fn root(parents: &[AtomicU32], mut v: u32) -> u32 {
    loop {
        let parent = parents[v as usize].load(Ordering::Relaxed);
        let above = parents[parent as usize].load(Ordering::Relaxed);
        if parent == above {
            return parent;
        }
        // A vertex further up is always right as a parent.
        parents[v as usize].store(above, Ordering::Relaxed);
        v = above;
    }
}
