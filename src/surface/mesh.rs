//! Triangle meshes: vertices by number, with normals. Never promises more than its maker: see [`super::check()`].

use rayon::prelude::*;

/// A triangle mesh. Triangles turn counter-clockwise seen from outside.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// The vertices.
    pub positions: Vec<[f64; 3]>,
    /// A unit vector per vertex, pointing outside.
    pub normals: Vec<[f64; 3]>,
    /// Three vertices each.
    pub triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// Whether there is nothing in it.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.triangles.is_empty()
    }

    /// The corners of a triangle.
    ///
    /// # Panics
    /// If the triangle names a vertex that does not exist.
    #[must_use]
    pub fn corners(&self, triangle: [u32; 3]) -> [[f64; 3]; 3] {
        triangle.map(|v| self.positions[v as usize])
    }

    /// The smallest and the largest coordinates, if there are vertices.
    #[must_use]
    pub fn bounds(&self) -> Option<([f64; 3], [f64; 3])> {
        let first = *self.positions.first()?;
        Some(self.positions.iter().fold((first, first), |(lo, hi), p| {
            (std::array::from_fn(|d| lo[d].min(p[d])), std::array::from_fn(|d| hi[d].max(p[d])))
        }))
    }
}

/// An array of triples made of pieces, one for each part behind each other: how long each is, and what fills it. Threads fill them at once,
/// since the memory is new to the process and is mapped where it is first touched.
pub(super) fn pieces<P: Send, T: Copy + Default + Send>(
    parts: Vec<P>,
    length: impl Fn(&P) -> usize,
    fill: impl Fn(P, &mut [[T; 3]]) + Sync,
) -> Vec<[T; 3]> {
    let mut all = vec![[T::default(); 3]; parts.iter().map(&length).sum()];
    let mut rest = &mut all[..];
    let mut places = Vec::with_capacity(parts.len());
    for part in &parts {
        let (place, behind) = rest.split_at_mut(length(part));
        places.push(place);
        rest = behind;
    }
    places.into_par_iter().zip(parts).for_each(|(place, part)| fill(part, place));
    all
}

/// `a - b`.
#[must_use]
pub fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|d| a[d] - b[d])
}

/// The cross product.
#[must_use]
pub fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The dot product.
#[must_use]
pub fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The vector divided by its length, if it has one that is finite and not 0. Very long and very short ones too.
#[must_use]
pub fn unit(a: [f64; 3]) -> Option<[f64; 3]> {
    let largest = a.iter().fold(0.0_f64, |m, c| m.max(c.abs()));
    if largest == 0.0 || a.iter().any(|c| !c.is_finite()) {
        return None;
    }
    let scaled = a.map(|c| c / largest);
    let length = dot(scaled, scaled).sqrt();
    Some(scaled.map(|c| c / length))
}
