//! From world coordinates to indices of the grid, for points and for boxes. Knows no samples.

use super::volume::Placement;
use crate::number::Interval;

/// The inverse of a [`Placement`]: fractional indices from world coordinates.
#[derive(Clone, Debug, PartialEq)]
pub struct Locator {
    origin: [f64; 3],
    dimension: usize,
    kind: Kind,
}

#[derive(Clone, Debug, PartialEq)]
enum Kind {
    /// Each axis of the grid runs along one axis of the world: (that axis, step). One subtraction and one division per index, so
    /// that samples are met exactly.
    Aligned([(usize, f64); 3]),
    /// The inverse matrix: row k gives index k.
    Oblique([[f64; 3]; 3]),
}

impl Locator {
    /// `None` if the directions do not span the space of the first `dimension` coordinates.
    #[must_use]
    pub fn new(placement: &Placement, dimension: usize) -> Option<Self> {
        let kind = match aligned(&placement.directions, dimension) {
            Some(axes) => Kind::Aligned(axes),
            None => Kind::Oblique(inverse(&placement.directions, dimension)?),
        };
        Some(Self { origin: placement.origin, dimension, kind })
    }

    /// Fractional indices of a point of the world; 0 beyond the dimension.
    #[inline]
    #[must_use]
    pub fn index(&self, at: &[f64]) -> [f64; 3] {
        let mut index = [0.0; 3];
        match &self.kind {
            Kind::Aligned(axes) => {
                for (index, &(world, step)) in index.iter_mut().zip(axes).take(self.dimension) {
                    *index = (at[world] - self.origin[world]) / step;
                }
            }
            Kind::Oblique(rows) => {
                for (index, row) in index.iter_mut().zip(rows).take(self.dimension) {
                    *index = (0..self.dimension).fold(0.0, |sum, k| sum + row[k] * (at[k] - self.origin[k]));
                }
            }
        }
        index
    }

    /// Bounds of every index that [`Locator::index`] computes for points of the box. They hold the computed numbers, since each
    /// operation is the same and rounding to nearest is monotone.
    #[must_use]
    pub fn indices(&self, over: &[Interval]) -> [(f64, f64); 3] {
        let mut index = [(0.0, 0.0); 3];
        match &self.kind {
            Kind::Aligned(axes) => {
                for (index, &(world, step)) in index.iter_mut().zip(axes).take(self.dimension) {
                    *index = scaled(over[world], self.origin[world], |d| d / step);
                }
            }
            Kind::Oblique(rows) => {
                for (index, row) in index.iter_mut().zip(rows).take(self.dimension) {
                    *index = (0..self.dimension).fold((0.0, 0.0), |sum, k| {
                        let term = scaled(over[k], self.origin[k], |d| row[k] * d);
                        (sum.0 + term.0, sum.1 + term.1)
                    });
                }
            }
        }
        index
    }

    /// Turns derivatives by the indices into derivatives by the world's coordinates.
    pub fn slope(&self, by_index: [f64; 3], slope: &mut [f64]) {
        slope.fill(0.0);
        match &self.kind {
            Kind::Aligned(axes) => {
                for (d, &(world, step)) in by_index.iter().zip(axes).take(self.dimension) {
                    slope[world] = d / step;
                }
            }
            Kind::Oblique(rows) => {
                for (d, row) in by_index.iter().zip(rows).take(self.dimension) {
                    slope.iter_mut().zip(row).for_each(|(slope, r)| *slope += d * r);
                }
            }
        }
    }
}

/// The ordered images of both ends of `over - origin` under a monotone function.
fn scaled(over: Interval, origin: f64, f: impl Fn(f64) -> f64) -> (f64, f64) {
    let (a, b) = (f(over.lo - origin), f(over.hi - origin));
    if a <= b { (a, b) } else { (b, a) }
}

/// The world's axis and the step of each axis of the grid, if each direction has just one coordinate that is not zero, each another.
fn aligned(directions: &[[f64; 3]; 3], dimension: usize) -> Option<[(usize, f64); 3]> {
    let mut axes = [(0, 1.0); 3];
    let mut taken = [false; 3];
    for (axis, direction) in axes.iter_mut().zip(directions).take(dimension) {
        let mut steps = (0..dimension).filter(|&k| direction[k] != 0.0);
        let world = steps.next()?;
        if steps.next().is_some() || taken[world] {
            return None;
        }
        taken[world] = true;
        *axis = (world, direction[world]);
    }
    Some(axes)
}

/// Inverse of the matrix whose columns are the directions, by Gauss-Jordan elimination with pivoting.
fn inverse(directions: &[[f64; 3]; 3], dimension: usize) -> Option<[[f64; 3]; 3]> {
    let mut matrix: [[f64; 3]; 3] = std::array::from_fn(|row| std::array::from_fn(|column| directions[column][row]));
    let mut result: [[f64; 3]; 3] = std::array::from_fn(|row| std::array::from_fn(|column| f64::from(row == column)));
    let size = matrix.iter().flatten().fold(0.0_f64, |size, v| size.max(v.abs()));
    for column in 0..dimension {
        let pivot = (column..dimension).max_by(|&a, &b| matrix[a][column].abs().total_cmp(&matrix[b][column].abs()))?;
        if matrix[pivot][column].abs() <= 1e-12 * size {
            return None;
        }
        matrix.swap(column, pivot);
        result.swap(column, pivot);
        let p = matrix[column][column];
        matrix[column].iter_mut().chain(&mut result[column]).for_each(|v| *v /= p);
        let (pivot_row, pivot_result) = (matrix[column], result[column]);
        for row in (0..dimension).filter(|&row| row != column) {
            let factor = matrix[row][column];
            for k in 0..3 {
                matrix[row][k] -= factor * pivot_row[k];
                result[row][k] -= factor * pivot_result[k];
            }
        }
    }
    Some(result)
}
