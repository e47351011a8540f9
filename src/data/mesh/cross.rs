//! Triangles of a mesh that go through each other. Those that touch at a common corner or side do not count, nor do flat ones that overlap.

use robust::{Coord3D, orient3d};

use super::error::{MeshError, place};
use super::solid::Solid;
use super::tree::Node;
use super::triangle::Triangle;
use super::vector::V;
use crate::interrupt::Interrupt;

/// Pairs after which they are no longer counted.
const MANY: usize = 1_000;

/// How many pairs cross, and where one of them does; nothing if none.
pub(super) fn crossings(solid: &Solid, interrupt: &Interrupt) -> Result<Option<(usize, String)>, MeshError> {
    let (mut count, mut first) = (0, None);
    let nodes = &solid.tree.nodes;
    let mut waiting: Vec<usize> = Vec::new();
    for (number, own) in solid.triangles.iter().enumerate() {
        interrupt.tick()?;
        waiting.push(0);
        while let Some(at) = waiting.pop() {
            let node = &nodes[at];
            for k in (0..4).filter(|&k| meets(node, k, own)) {
                match node.child[k].kind() {
                    // Each pair once.
                    Ok((first_of, many)) => {
                        let range = first_of as usize..(first_of + many) as usize;
                        for other in range.filter(|&other| other > number) {
                            if let Some(at) = crossing(own, &solid.triangles[other]) {
                                count += 1;
                                first.get_or_insert(at);
                            }
                        }
                    }
                    Err(child) => waiting.push(child),
                }
            }
        }
        if count >= MANY {
            break;
        }
    }
    Ok(first.map(|at| (count, place(solid.place(at)))))
}

fn meets(node: &Node, k: usize, t: &Triangle) -> bool {
    (0..3).all(|axis| {
        let [a, b, c] = t.corners.map(|p| p[axis]);
        node.lo[axis][k] <= a.max(b).max(c) && node.hi[axis][k] >= a.min(b).min(c)
    })
}

/// Where a side of one triangle goes through the inside of the other, if one does.
fn crossing(s: &Triangle, t: &Triangle) -> Option<V> {
    [(s, t), (t, s)].into_iter().find_map(|(s, t)| {
        (0..3).find_map(|k| {
            let (a, b) = (s.corners[k], s.corners[(k + 1) % 3]);
            let part = pierces(a, b, &t.corners)?;
            Some(std::array::from_fn(|axis| a[axis] + part * (b[axis] - a[axis])))
        })
    })
}

fn side(a: V, b: V, c: V, d: V) -> f64 {
    let [a, b, c, d] = [a, b, c, d].map(|[x, y, z]| Coord3D { x, y, z });
    orient3d(a, b, c, d)
}

/// Which part of a segment lies before the inside of a triangle that it properly goes through.
fn pierces(a: V, b: V, [p, q, r]: &[V; 3]) -> Option<f64> {
    let (from, to) = (side(*p, *q, *r, a), side(*p, *q, *r, b));
    if !(from > 0.0 && to < 0.0 || from < 0.0 && to > 0.0) {
        return None;
    }
    let around = [side(a, b, *p, *q), side(a, b, *q, *r), side(a, b, *r, *p)];
    let through = around.iter().all(|s| *s > 0.0) || around.iter().all(|s| *s < 0.0);
    through.then(|| from / (from - to))
}
