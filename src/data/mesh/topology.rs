//! Whether triangles close a solid: drops those without an area, closes what is nearly closed, turns what is turned round. Looks at how
//! triangles share edges; whether they cross each other is another question.

use rustc_hash::{FxHashMap, FxHashSet};

use super::super::obj::Surface;
use super::error::MeshError;
use super::vector::{V, sub};
use crate::interrupt::Interrupt;

/// Vertices nearer than this part of the mesh's size are one vertex, if that closes the mesh.
const NEAR: f64 = 1e-6;
/// Holes are filled whose size is at most this part of the mesh's.
const HOLE: f64 = 0.05;

/// What was mended.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Mended {
    /// Vertices that were joined with a near one.
    pub joined: usize,
    /// Small holes that were filled.
    pub filled: usize,
    /// Triangles that were turned round.
    pub turned: usize,
}

/// The triangles at an edge: how many run along it from the smaller vertex to the larger one, and how many the other way.
type Edges = FxHashMap<[u32; 2], [u32; 2]>;

fn sides([a, b, c]: [u32; 3]) -> [[u32; 2]; 3] {
    [[a, b], [b, c], [c, a]]
}

fn edges(triangles: &[[u32; 3]], interrupt: &Interrupt) -> Result<Edges, MeshError> {
    let mut all = Edges::default();
    for chunk in triangles.chunks(4096) {
        interrupt.tick()?;
        for &[a, b] in chunk.iter().flat_map(|t| sides(*t)).collect::<Vec<_>>().iter() {
            all.entry([a.min(b), a.max(b)]).or_default()[usize::from(a > b)] += 1;
        }
    }
    Ok(all)
}

fn odd(edges: &Edges) -> usize {
    edges.values().filter(|[a, b]| (a + b) % 2 == 1).count()
}

/// The same surface closed and with one side outward along each edge.
///
/// # Errors
/// [`MeshError::Empty`], [`MeshError::Open`], [`MeshError::OneSided`].
pub(super) fn closed(mut surface: Surface, interrupt: &Interrupt) -> Result<(Surface, Mended), MeshError> {
    let mut mended = Mended::default();
    clean(&mut surface.triangles);
    if surface.triangles.is_empty() {
        return Err(MeshError::Empty);
    }
    let mut known = edges(&surface.triangles, interrupt)?;
    if odd(&known) > 0 {
        let (near, joined) = joined(&surface);
        let better = edges(&near.triangles, interrupt)?;
        if joined > 0 && odd(&better) < odd(&known) && !near.triangles.is_empty() {
            (surface, known, mended.joined) = (near, better, joined);
        }
    }
    if odd(&known) > 0 {
        mended.filled = fill(&mut surface, &known);
        known = edges(&surface.triangles, interrupt)?;
    }
    if odd(&known) > 0 {
        return Err(open(&surface, &known));
    }
    if known.values().any(|[a, b]| a != b) {
        mended.turned = turn(&mut surface, interrupt)?;
    }
    Ok((surface, mended))
}

/// Drops triangles two of whose corners are one, and all but one of those that are there several times.
fn clean(triangles: &mut Vec<[u32; 3]>) {
    let mut seen = FxHashSet::default();
    triangles.retain(|&[a, b, c]| {
        let least = a.min(b).min(c);
        let turned = [[a, b, c], [b, c, a], [c, a, b]].into_iter().find(|t| t[0] == least);
        a != b && b != c && c != a && turned.is_some_and(|t| seen.insert(t))
    });
}

fn open(surface: &Surface, edges: &Edges) -> MeshError {
    let first = edges.iter().filter(|(_, [a, b])| (a + b) % 2 == 1).map(|(edge, _)| *edge).min();
    let at = first.unwrap_or_default().map(|v| surface.positions[v as usize]);
    MeshError::Open { open: odd(edges), edges: edges.len(), at }
}

/// The diagonal of the box about some points.
fn size<'a>(points: impl Iterator<Item = &'a V>) -> f64 {
    let (mut lo, mut hi) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for p in points {
        for k in 0..3 {
            lo[k] = lo[k].min(p[k]);
            hi[k] = hi[k].max(p[k]);
        }
    }
    let [x, y, z] = sub(hi, lo);
    x.hypot(y).hypot(z)
}

/// The surface with near vertices made one, and how many went.
fn joined(surface: &Surface) -> (Surface, usize) {
    let near = NEAR * size(surface.positions.iter());
    if !(near > 0.0 && near.is_finite()) {
        return (surface.clone(), 0);
    }
    // Vertices by cubes of the distance: a near one lies in a cube that touches.
    let cube = |p: V| p.map(|c| (c / near).floor());
    let key = |c: V| c.map(|c| (c + 0.0).to_bits());
    let mut cubes: FxHashMap<[u64; 3], Vec<u32>> = FxHashMap::default();
    let mut to: Vec<u32> = Vec::with_capacity(surface.positions.len());
    let mut gone = 0;
    for (number, &p) in (0u32..).zip(&surface.positions) {
        let own = cube(p);
        let around = (0..27)
            .map(|n| [n % 3, n / 3 % 3, n / 9])
            .map(|[i, j, k]| key([own[0] + f64::from(i - 1), own[1] + f64::from(j - 1), own[2] + f64::from(k - 1)]));
        let close = |&&q: &&u32| size([p, surface.positions[q as usize]].iter()) <= near;
        let found = around.filter_map(|key| cubes.get(&key)?.iter().find(close)).min().copied();
        if found.is_none() {
            cubes.entry(key(own)).or_default().push(number);
        }
        gone += usize::from(found.is_some());
        to.push(found.unwrap_or(number));
    }
    let mut triangles: Vec<[u32; 3]> = surface.triangles.iter().map(|t| t.map(|v| to[v as usize])).collect();
    clean(&mut triangles);
    (Surface { positions: surface.positions.clone(), triangles }, gone)
}

/// Closes the small holes whose edges make simple rings; how many.
fn fill(surface: &mut Surface, edges: &Edges) -> usize {
    // The new triangle runs along an edge the other way.
    let mut next: FxHashMap<u32, u32> = FxHashMap::default();
    let mut starts: Vec<u32> = Vec::new();
    let mut double: FxHashSet<u32> = FxHashSet::default();
    for (&[a, b], &[up, down]) in edges {
        let (from, to) = match (up, down) {
            (1, 0) => (b, a),
            (0, 1) => (a, b),
            _ => continue,
        };
        if next.insert(from, to).is_some() {
            double.insert(from);
        }
        starts.push(from);
    }
    starts.sort_unstable();
    let most = HOLE * size(surface.positions.iter());
    let (mut filled, mut seen) = (0, FxHashSet::default());
    for start in starts {
        let mut ring = vec![start];
        let mut at = start;
        while seen.insert(at) && !double.contains(&at) {
            let Some(&to) = next.get(&at) else { break };
            at = to;
            if at == start {
                break;
            }
            ring.push(at);
        }
        let whole = at == start && ring.len() >= 3;
        if whole && size(ring.iter().map(|&v| &surface.positions[v as usize])) <= most {
            super::super::ears::cut(&surface.positions, &ring, &mut surface.triangles);
            filled += 1;
        }
    }
    filled
}

/// Turns triangles until both run along each edge in opposite directions; how many were turned.
fn turn(surface: &mut Surface, interrupt: &Interrupt) -> Result<usize, MeshError> {
    let mut at_edge: FxHashMap<[u32; 2], Vec<u32>> = FxHashMap::default();
    for (number, &t) in (0u32..).zip(&surface.triangles) {
        for [a, b] in sides(t) {
            at_edge.entry([a.min(b), a.max(b)]).or_default().push(number);
        }
    }
    let runs_up = |t: [u32; 3], edge: [u32; 2]| sides(t).contains(&edge);
    let mut fate: Vec<Option<bool>> = vec![None; surface.triangles.len()];
    let mut turned = 0;
    for first in 0..surface.triangles.len() {
        if fate[first].is_some() {
            continue;
        }
        fate[first] = Some(false);
        let mut part = vec![first];
        let mut next = 0;
        while let Some(&t) = part.get(next) {
            next += 1;
            interrupt.tick()?;
            for [a, b] in sides(surface.triangles[t]) {
                let edge = [a.min(b), a.max(b)];
                // Where more than two meet, nothing says which belong together.
                let [p, q] = at_edge[&edge][..] else { continue };
                let other = if p as usize == t { q } else { p } as usize;
                let same = runs_up(surface.triangles[t], edge) == runs_up(surface.triangles[other], edge);
                let wanted = fate[t].map(|turned| turned != same);
                if fate[other].is_none() {
                    fate[other] = wanted;
                    part.push(other);
                }
            }
        }
        // The smaller half of a part is what was wrong.
        let count = part.iter().filter(|&&t| fate[t] == Some(true)).count();
        let swap = 2 * count > part.len();
        part.iter().for_each(|&t| fate[t] = fate[t].map(|turned| turned != swap));
        turned += if swap { part.len() - count } else { count };
    }
    for (t, fate) in surface.triangles.iter_mut().zip(&fate) {
        if *fate == Some(true) {
            t.swap(1, 2);
        }
    }
    let known = edges(&surface.triangles, interrupt)?;
    let wrong = known.iter().filter(|(_, [a, b])| a != b).map(|(edge, _)| *edge).min();
    match wrong {
        Some(edge) => Err(MeshError::OneSided { at: edge.map(|v| surface.positions[v as usize]) }),
        None => Ok(turned),
    }
}
