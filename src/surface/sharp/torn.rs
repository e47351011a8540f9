//! Parts of a mesh that sampling tore off a tip thinner than its cells. Once the tip is whole again they lie within it. Evaluates nothing.

use rayon::prelude::*;
use rustc_hash::FxHashMap;

use super::super::mesh::{Mesh, cross, dot, minus};

/// Triangles that such a part has at most.
const MOST: usize = 600;

/// The parts of a mesh that may be torn off, by number.
pub(super) struct Parts {
    of_vertex: Vec<u32>,
    triangles: FxHashMap<u32, Vec<u32>>,
}

impl Parts {
    /// Small balls of the object's own triangles, and not the largest part.
    pub(super) fn of(mesh: &Mesh, own: usize) -> Self {
        let mut parents: Vec<u32> = (0..mesh.positions.len() as u32).collect();
        for &[a, b, c] in &mesh.triangles {
            for other in [b, c] {
                let (a, b) = (root(&mut parents, a), root(&mut parents, other));
                parents[a.max(b) as usize] = a.min(b);
            }
        }
        let mut counts: FxHashMap<u32, [usize; 2]> = FxHashMap::default();
        for v in 0..mesh.positions.len() as u32 {
            counts.entry(root(&mut parents, v)).or_default()[0] += 1;
        }
        for (t, [a, ..]) in mesh.triangles.iter().enumerate() {
            let count = counts.entry(root(&mut parents, *a)).or_default();
            count[1] += if t < own { 1 } else { MOST };
        }
        let largest = counts.values().map(|count| count[1]).max().unwrap_or(0);
        let is_part = |[vertices, triangles]: &[usize; 2]| {
            *triangles <= MOST && 4 * triangles <= largest && 2 * vertices == triangles + 4
        };
        counts.retain(|_, count| is_part(count));
        let mut triangles: FxHashMap<u32, Vec<u32>> = FxHashMap::default();
        for (t, [a, ..]) in mesh.triangles[..own].iter().enumerate() {
            let part = root(&mut parents, *a);
            if counts.contains_key(&part) {
                triangles.entry(part).or_default().push(t as u32);
            }
        }
        let of_vertex = (0..mesh.positions.len() as u32).map(|v| root(&mut parents, v)).collect();
        Self { of_vertex, triangles }
    }

    /// The part of a vertex, if that may be torn off.
    pub(super) fn part(&self, vertex: u32) -> Option<u32> {
        let part = self.of_vertex[vertex as usize];
        self.triangles.contains_key(&part).then_some(part)
    }

    /// The triangles of a part.
    pub(super) fn triangles(&self, part: u32) -> &[u32] {
        self.triangles.get(&part).map(Vec::as_slice).unwrap_or_default()
    }

    /// Whether all of a part of a mesh lies where another mesh has the same: solid in a solid part, hollow in a hollow one.
    pub(super) fn is_covered(&self, part: u32, mesh: &Mesh, other: &Mesh) -> bool {
        let triangles: Vec<[u32; 3]> = self.triangles(part).iter().map(|&t| mesh.triangles[t as usize]).collect();
        let mut vertices: Vec<u32> = triangles.iter().flatten().copied().collect();
        vertices.sort_unstable();
        vertices.dedup();
        let sum = vertices
            .iter()
            .map(|&v| mesh.positions[v as usize])
            .fold([0.0; 3], |sum: [f64; 3], place| std::array::from_fn(|d| sum[d] + place[d]));
        let middle = sum.map(|c| c / vertices.len() as f64);
        let volume: f64 = triangles
            .iter()
            .map(|&t| {
                let [a, b, c] = mesh.corners(t).map(|corner| minus(corner, middle));
                dot(a, cross(b, c))
            })
            .sum();
        let is_solid = volume > 0.0;
        vertices.par_iter().all(|&v| {
            let place = mesh.positions[v as usize];
            // Well within, since surfaces bend between vertices; and in no line with those.
            let shares = [0.5, 0.500_1, 0.500_2];
            let point = std::array::from_fn(|d| place[d] + shares[d] * (middle[d] - place[d]));
            (turns(other, point) > 0) == is_solid
        })
    }
}

fn root(parents: &mut [u32], mut v: u32) -> u32 {
    while parents[v as usize] != v {
        parents[v as usize] = parents[parents[v as usize] as usize];
        v = parents[v as usize];
    }
    v
}

/// How often a mesh is about a point: its triangles towards greater x1 there, those that one leaves by less those that one enters by.
fn turns(mesh: &Mesh, [x, y, z]: [f64; 3]) -> i32 {
    let crossed = |t: &[u32; 3]| {
        let [a, b, c] = mesh.corners(*t);
        if a[0].max(b[0]).max(c[0]) < x || (a[1] < y) == (b[1] < y) && (b[1] < y) == (c[1] < y) {
            return 0;
        }
        let side = |p: [f64; 3], q: [f64; 3]| (q[1] - p[1]) * (z - p[2]) - (q[2] - p[2]) * (y - p[1]);
        let [u, v, w] = [side(b, c), side(c, a), side(a, b)];
        let all = u + v + w;
        let is_within = u > 0.0 && v > 0.0 && w > 0.0 || u < 0.0 && v < 0.0 && w < 0.0;
        if !is_within || (u * a[0] + v * b[0] + w * c[0]) / all < x {
            return 0;
        }
        if all > 0.0 { 1 } else { -1 }
    };
    mesh.triangles.iter().map(crossed).sum()
}
