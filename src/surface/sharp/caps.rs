//! The caps of a mesh where their sides get new vertices. Evaluates nothing.

use super::super::mesh::{Mesh, cross, minus, unit};
use super::fill::{Corner, Surfaces, cut};
use super::sew::Splits;

/// Appends the triangles of the caps, those behind the first `own` of the mesh, with the new vertices of their sides.
pub(super) fn split(mesh: &Mesh, own: usize, splits: &Splits<'_>, out: &mut Vec<[u32; 3]>) {
    if splits.is_empty() {
        out.extend_from_slice(&mesh.triangles[own..]);
        return;
    }
    let first = out.len();
    for &triangle in &mesh.triangles[own..] {
        let side = (0..3).find_map(|k| {
            let [a, b, c] = [triangle[k], triangle[(k + 1) % 3], triangle[(k + 2) % 3]];
            splits.between(a, b).map(|new| (a, b, c, new))
        });
        let Some((a, b, c, new)) = side else {
            out.push(triangle);
            continue;
        };
        // The fan to which the triangle belongs: all of it is cut anew, since the new corner may reach into it.
        let mut ring = vec![a, new];
        let mut fan = Vec::new();
        let mut last = c;
        while let Some(&[start, before, end]) = out[first..].last()
            && start == b
            && end == last
            && !splits.is_new(before)
        {
            fan.push(last);
            last = before;
            out.pop();
        }
        ring.extend([b, last]);
        ring.extend(fan.into_iter().rev());
        fill(splits, &ring, out);
    }
}

fn fill(splits: &Splits<'_>, ring: &[u32], out: &mut Vec<[u32; 3]>) {
    let places: Vec<[f64; 3]> = ring.iter().map(|&v| splits.place(v)).collect();
    let sum = places.windows(2).fold([0.0; 3], |sum, pair| {
        let part = cross(minus(pair[0], places[0]), minus(pair[1], places[0]));
        std::array::from_fn(|d| sum[d] + part[d])
    });
    let normals = vec![unit(sum).unwrap_or_default()];
    let corner = |(&vertex, &at): (&u32, &[f64; 3])| Corner { vertex, at, faces: 0, on: 1, normals: normals.clone() };
    let corners: Vec<Corner> = ring.iter().zip(&places).map(corner).collect();
    if let Some(filling) = cut(&corners, &Surfaces::new(1)) {
        out.extend(filling.triangles.iter().map(|t| t.map(|i| corners[i].vertex)));
    }
}
