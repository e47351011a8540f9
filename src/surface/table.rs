//! The table of marching cubes, computed: for each of the 256 cases of inside and outside corners, the triangles between crossed edges.
//!
//! One rule makes it consistent: an ambiguous face always separates its inside corners. The boundary of each case is a set of closed
//! polygons, and each polygon is cut into triangles without a chord in a face of the cube: such a chord could coincide with one of the
//! neighbouring cube and be used four times. So meshes are closed, oriented and 2-manifold by construction.

use std::sync::LazyLock;

/// An edge of the cube, `4 axis + offset`: the offset's bit 0 is the lower, bit 1 the higher of the two other axes.
pub type Edge = u8;

/// The triangles of each case. Bit c of a case stands for the corner at `(c & 1, c >> 1 & 1, c >> 2 & 1)`, set if it is inside.
/// Triangles turn counter-clockwise seen from outside the solid.
pub static CASES: LazyLock<[Vec<[Edge; 3]>; 256]> = LazyLock::new(|| std::array::from_fn(triangles));

/// Where an edge begins (its lower corner) and along which axis it runs.
#[must_use]
pub fn edge_start(edge: Edge) -> ([usize; 3], usize) {
    let (axis, offset) = (usize::from(edge / 4), usize::from(edge % 4));
    let (low, high) = other_axes(axis);
    let mut start = [0; 3];
    (start[low], start[high]) = (offset & 1, offset >> 1);
    (start, axis)
}

fn other_axes(axis: usize) -> (usize, usize) {
    [(1, 2), (0, 2), (0, 1)][axis]
}

fn corner(at: [usize; 3]) -> usize {
    at[0] | at[1] << 1 | at[2] << 2
}

/// The edge between two corners that differ along one axis.
fn edge_between(a: usize, b: usize) -> Edge {
    let axis = (a ^ b).trailing_zeros() as usize;
    let (low, high) = other_axes(axis);
    let start = a & b;
    (4 * axis + (start >> low & 1) + 2 * (start >> high & 1)) as Edge
}

/// The four corners of each face, counter-clockwise seen from outside the cube.
fn faces() -> [[usize; 4]; 6] {
    std::array::from_fn(|face| {
        let (axis, side) = (face / 2, face % 2);
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        let mut ring = [[0, 0], [1, 0], [1, 1], [0, 1]].map(|[a, b]| {
            let mut at = [0; 3];
            (at[axis], at[u], at[v]) = (side, a, b);
            corner(at)
        });
        if side == 0 {
            ring.reverse();
        }
        ring
    })
}

/// Bit f is set if the edge lies in face f.
fn faces_of_edges() -> [u8; 12] {
    let mut masks = [0; 12];
    for (f, ring) in faces().iter().enumerate() {
        for i in 0..4 {
            masks[usize::from(edge_between(ring[i], ring[(i + 1) % 4]))] |= 1 << f;
        }
    }
    masks
}

fn triangles(case: usize) -> Vec<[Edge; 3]> {
    let mut triangles = Vec::new();
    for polygon in polygons(case) {
        triangulate(&polygon, &mut triangles);
    }
    triangles
}

/// The closed polygons of a case. On each face every run of inside corners gives one segment, from the edge by which the ring of corners
/// enters the run to the edge by which it leaves; each crossed edge is entered on one of its two faces and left on the other.
fn polygons(case: usize) -> Vec<Vec<Edge>> {
    let inside = |c: usize| case >> c & 1 == 1;
    let mut next = [None; 12];
    for ring in faces() {
        for i in 0..4 {
            let (before, first) = (ring[i], ring[(i + 1) % 4]);
            if !inside(before) && inside(first) {
                let leaves = (1..4).find(|k| !inside(ring[(i + 1 + k) % 4])).unwrap_or(3);
                let exit = edge_between(ring[(i + leaves) % 4], ring[(i + 1 + leaves) % 4]);
                next[usize::from(edge_between(before, first))] = Some(exit);
            }
        }
    }
    let mut polygons = Vec::new();
    for start in 0..12 {
        let mut polygon = Vec::new();
        let mut at = start;
        while let Some(exit) = next[at].take() {
            polygon.push(at as Edge);
            at = usize::from(exit);
        }
        if !polygon.is_empty() {
            polygons.push(polygon);
        }
    }
    polygons
}

/// Cuts a polygon into triangles along chords that lie in no face; of all ways the one with the shortest chords (between the middles of
/// edges).
fn triangulate(polygon: &[Edge], out: &mut Vec<[Edge; 3]>) {
    let n = polygon.len();
    let masks = faces_of_edges();
    let chord = |i: usize, j: usize| {
        let (a, b) = (polygon[i], polygon[j]);
        if j - i == 1 || j - i == n - 1 {
            Some(0)
        } else if masks[usize::from(a)] & masks[usize::from(b)] != 0 {
            None
        } else {
            Some(squared_distance(a, b))
        }
    };
    // best[i][j]: least cost of the part of the polygon from i to j, and the vertex that makes the triangle on the side (i, j).
    let mut best = vec![vec![Some((0, 0)); n]; n];
    for span in 2..n {
        for i in 0..n - span {
            let j = i + span;
            best[i][j] = (i + 1..j).filter_map(|k| Some((best[i][k]?.0 + best[k][j]?.0 + chord(i, j)?, k))).min();
        }
    }
    let mut open = vec![(0, n - 1)];
    while let Some((i, j)) = open.pop() {
        if j - i < 2 {
            continue;
        }
        if let Some((_, k)) = best[i][j] {
            out.push([polygon[i], polygon[k], polygon[j]]);
            open.extend([(i, k), (k, j)]);
        }
    }
}

fn squared_distance(a: Edge, b: Edge) -> usize {
    let middle = |edge: Edge| {
        let (start, axis) = edge_start(edge);
        let mut twice = start.map(|c| 2 * c);
        twice[axis] += 1;
        twice
    };
    middle(a).iter().zip(middle(b)).map(|(p, q)| p.abs_diff(q).pow(2)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Directed edges of a case's triangles that lie in face `f`, as pairs of cube edges.
    fn border(case: usize, f: usize) -> Vec<(Edge, Edge)> {
        let masks = faces_of_edges();
        let in_face = |e: Edge| masks[usize::from(e)] >> f & 1 == 1;
        let sides = CASES[case].iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]);
        sides.filter(|&(a, b)| in_face(a) && in_face(b)).collect()
    }

    /// The edge of the neighbouring cube that is the same as `edge` of this one, across face `f`.
    fn across(edge: Edge, f: usize) -> Edge {
        let (mut start, axis) = edge_start(edge);
        start[f / 2] = 1 - f % 2;
        let mut end = start;
        end[axis] += 1;
        edge_between(corner(start), corner(end))
    }

    #[test]
    fn every_case_is_closed_but_for_its_faces() {
        for case in 0..256 {
            let mut sides: Vec<(Edge, Edge)> =
                CASES[case].iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]).collect();
            sides.sort_unstable();
            let count = sides.len();
            sides.dedup();
            assert_eq!(sides.len(), count, "case {case} uses a directed edge twice");
            let masks = faces_of_edges();
            for &(a, b) in &sides {
                let shared = (masks[usize::from(a)] & masks[usize::from(b)]).count_ones();
                let back = sides.binary_search(&(b, a)).is_ok();
                assert_eq!(shared, u32::from(!back), "case {case}: side {a}-{b} must be in one face or be paired");
            }
        }
    }

    #[test]
    fn crossed_edges_are_those_that_triangles_use() {
        for case in 0..256_usize {
            for edge in 0..12 {
                let (start, axis) = edge_start(edge);
                let low = corner(start);
                let crossed = (case >> low ^ case >> (low | 1 << axis)) & 1 == 1;
                assert_eq!(CASES[case].iter().flatten().any(|&e| e == edge), crossed, "case {case}, edge {edge}");
            }
        }
    }

    #[test]
    fn all_pairs_of_neighbours_agree_on_their_common_face() {
        for f in [1, 3, 5] {
            let axis = f / 2;
            let side = |case: usize, at: usize| -> Vec<usize> {
                (0..8).filter(|c| c >> axis & 1 == at).map(|c| case >> c & 1).collect()
            };
            for case in 0..256 {
                let mut ours: Vec<_> = border(case, f).iter().map(|&(a, b)| (across(b, f), across(a, f))).collect();
                ours.sort_unstable();
                for other in (0..256).filter(|&other| side(case, 1) == side(other, 0)) {
                    let mut theirs = border(other, f - 1);
                    theirs.sort_unstable();
                    assert_eq!(ours, theirs, "cases {case} and {other} across face {f}");
                }
            }
        }
    }

    #[test]
    fn one_inside_corner_faces_away_from_it() {
        assert_eq!(CASES[1].len(), 1);
        let [a, b, c] = CASES[1][0];
        let start = [a, b, c].iter().position(|&e| e == 0).expect("the edge along x");
        let turned: Vec<Edge> = (0..3).map(|i| [a, b, c][(start + i) % 3]).collect();
        assert_eq!(turned, [0, 4, 8], "x, y, z: the normal is (1, 1, 1)");
    }
}
