//! Where boxes of space are on a screen, and which pieces of it they reach into. Draws nothing.

use super::camera::Camera;
use super::raycast::Space;

/// Pixels along each side of the pieces that a picture is redrawn in.
pub const PIECE: usize = 32;

/// Pixels along each side of the smallest tile.
pub const TILE: usize = 8;

/// A part of a picture: its first column and row, and one past its last ones.
pub type Window = [[usize; 2]; 2];

/// The least and the largest column and row that something may take, in pixels from the top left, which may lie outside; `None` where the eye is
/// not before all of it, so that it may be anywhere.
pub type Reach = Option<[[f64; 2]; 2]>;

/// A camera and the pixels behind it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Screen {
    /// The camera.
    pub camera: Camera,
    /// Pixels in a row and in a column.
    pub size: [usize; 2],
    /// Pixels along each side of its pieces, a multiple of those of the smallest tile.
    pub piece: usize,
}

impl Screen {
    /// Where a box is.
    #[must_use]
    pub fn reach(&self, of: Space) -> Reach {
        self.hull(&super::extent::Extent::whole(of))
    }

    /// Where the convex hull of some points is.
    #[must_use]
    pub fn hull(&self, points: &[[f64; 3]]) -> Reach {
        let mut seen = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
        for &point in points {
            let at = self.camera.place(point)?;
            let size = self.size.map(|n| n as f64);
            let at = [0.5 * (at[0] + 1.0) * size[0], 0.5 * (1.0 - at[1]) * size[1]];
            (0..2).for_each(|k| seen[0][k] = seen[0][k].min(at[k]));
            (0..2).for_each(|k| seen[1][k] = seen[1][k].max(at[k]));
        }
        Some(seen)
    }

    /// Pieces in a row and in a column.
    #[must_use]
    pub fn pieces(&self) -> [usize; 2] {
        self.size.map(|n| n.div_ceil(self.piece))
    }

    /// The pieces of the screen that some things reach into, row by row; all of them if one of those may be anywhere.
    #[must_use]
    pub fn windows(&self, reaches: &[Reach]) -> Vec<Window> {
        let [columns, rows] = self.pieces();
        let mut marked = vec![reaches.contains(&None); columns * rows];
        for [from, to] in reaches.iter().flatten() {
            // A ray through the common corner of two pixels belongs to both.
            let ends = |k: usize, count: usize| {
                let piece = |v: f64| (v / self.piece as f64).floor().clamp(-1.0, count as f64) as isize;
                let [first, last] = [piece(from[k] - 1.5), piece(to[k] + 1.5)];
                first.max(0) as usize..(last + 1).clamp(0, count as isize) as usize
            };
            for row in ends(1, rows) {
                let of_row = &mut marked[row * columns..][..columns];
                ends(0, columns).for_each(|column| of_row[column] = true);
            }
        }
        let window = |piece: usize| {
            let from = [piece % columns * self.piece, piece / columns * self.piece];
            [from, [0, 1].map(|k| (from[k] + self.piece).min(self.size[k]))]
        };
        (0..marked.len()).filter(|&piece| marked[piece]).map(window).collect()
    }
}

/// Whether something that reaches there may be seen in a part.
#[must_use]
pub fn meets(reach: &Reach, [from, to]: Window) -> bool {
    let Some([least, most]) = reach else { return true };
    (0..2).all(|k| least[k] - 2.0 <= to[k] as f64 && from[k] as f64 <= most[k] + 2.0)
}
