//! The dense part of the sparse elimination: Cholesky's method on the first rows of a small symmetric matrix, and what is left for the rest.
//! The order of all sums is fixed, and nothing is fused: the same bits with every instruction set.

#[cfg(not(debug_assertions))]
use multiversion::multiversion;

/// Columns that are eliminated at a time.
const PANEL: usize = 32;
/// Rows and columns of a tile of the update.
const ROWS: usize = 6;
const COLUMNS: usize = 8;

/// A lower triangle by rows, `n` numbers each.
#[derive(Debug)]
pub(super) struct Front {
    pub(super) n: usize,
    pub(super) rows: Vec<f64>,
}

impl Front {
    pub(super) fn new(n: usize) -> Self {
        Self { n, rows: vec![0.0; n * n] }
    }

    /// Adds to an element; the larger index is the row.
    #[inline]
    pub(super) fn add(&mut self, i: usize, j: usize, value: f64) {
        self.rows[i.max(j) * self.n + i.min(j)] += value;
    }

    /// Eliminates the first `count` rows; false if the matrix is not positive definite there.
    pub(super) fn eliminate(&mut self, count: usize) -> bool {
        let mut packed = Vec::new();
        for from in (0..count).step_by(PANEL) {
            let to = (from + PANEL).min(count);
            if !self.panel(from, to) {
                return false;
            }
            if to < self.n {
                self.update(from, to, &mut packed);
            }
        }
        true
    }

    /// Cholesky's method on columns `from..to`, which all columns before have left.
    fn panel(&mut self, from: usize, to: usize) -> bool {
        let n = self.n;
        for i in from..n {
            let (above, row) = self.rows.split_at_mut(i * n);
            for j in from..to.min(i) {
                let other = &above[j * n..j * n + j + 1];
                let done: f64 = (from..j).fold(0.0, |sum, p| sum + row[p] * other[p]);
                row[j] = (row[j] - done) / other[j];
            }
            if i < to {
                let done: f64 = (from..i).fold(0.0, |sum, p| sum + row[p] * row[p]);
                let square = row[i] - done;
                if !(square > 0.0 && square.is_finite()) {
                    return false;
                }
                row[i] = square.sqrt();
            }
        }
        true
    }

    /// Takes what columns `from..to` do to all behind them.
    fn update(&mut self, from: usize, to: usize, packed: &mut Vec<f64>) {
        let (n, wide) = (self.n, to - from);
        // Tiles of columns, transposed: for each, `wide` lines of COLUMNS numbers.
        let tiles = (n - to).div_ceil(COLUMNS);
        packed.clear();
        packed.resize(tiles * wide * COLUMNS, 0.0);
        for j in to..n {
            let (tile, k) = ((j - to) / COLUMNS, (j - to) % COLUMNS);
            for p in 0..wide {
                packed[(tile * wide + p) * COLUMNS + k] = self.rows[j * n + from + p];
            }
        }
        tiled(&mut self.rows, n, [from, to], packed);
    }
}

#[cfg_attr(not(debug_assertions), multiversion(targets("x86_64+avx512f+avx512vl", "x86_64+avx2")))]
fn tiled(rows: &mut [f64], n: usize, [from, to]: [usize; 2], packed: &[f64]) {
    let wide = to - from;
    for first in (to..n).step_by(ROWS) {
        let count = ROWS.min(n - first);
        let last = first + count - 1;
        let mut left = [[0.0; ROWS]; PANEL];
        for r in 0..count {
            for p in 0..wide {
                left[p][r] = rows[(first + r) * n + from + p];
            }
        }
        for tile in 0..=(last - to) / COLUMNS {
            let lines = packed[tile * wide * COLUMNS..(tile + 1) * wide * COLUMNS].as_chunks::<COLUMNS>().0;
            let mut sums = [[0.0; COLUMNS]; ROWS];
            for (line, left) in lines.iter().zip(&left) {
                for r in 0..ROWS {
                    for k in 0..COLUMNS {
                        sums[r][k] += left[r] * line[k];
                    }
                }
            }
            let start = to + tile * COLUMNS;
            for (r, sums) in sums.iter().enumerate().take(count) {
                let end = (first + r + 1).min(start + COLUMNS);
                if start < end {
                    let row = &mut rows[(first + r) * n + start..(first + r) * n + end];
                    row.iter_mut().zip(sums).for_each(|(a, s)| *a -= s);
                }
            }
        }
    }
}
