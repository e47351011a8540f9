//! Polygons about which questions are open, what is asked, and what may be the answer. Evaluates nothing.

use super::super::mesh::{cross, unit};
use super::fill::{Corner, Surfaces};
use super::solve::{Local, Scale};
use super::study::Site;

/// Points about one that may be on a crease.
pub(super) const AROUND: usize = 5;

/// What is asked about a polygon next.
pub(super) enum Stage {
    /// Where the pieces of its sides meet, two by two.
    Pairs,
    /// Where these pieces meet.
    Corner(Vec<usize>),
    Done,
}

/// A polygon, or a part of one, about which questions are open.
pub(super) struct Open {
    pub(super) facet: usize,
    pub(super) cell: [usize; 3],
    pub(super) corners: Vec<Corner>,
    /// The pieces, by their bits.
    pub(super) numbers: Vec<usize>,
    pub(super) surfaces: Surfaces,
    pub(super) stage: Stage,
    pub(super) unseen: usize,
    /// A place within the space from which to look for them in the plane across an axis.
    pub(super) aim: Option<(usize, [f64; 3])>,
}

/// A question: where these pieces meet near a place, in the plane across an axis if there is one.
pub(super) struct Question {
    pub(super) open: usize,
    pub(super) pieces: Vec<usize>,
    pub(super) axis: Option<usize>,
    pub(super) from: [f64; 3],
    /// The side that asks.
    pub(super) side: Option<[u32; 2]>,
}

/// A point where pieces meet.
pub(super) struct Candidate {
    pub(super) open: usize,
    pub(super) pieces: Vec<usize>,
    pub(super) at: [f64; 3],
    pub(super) locals: Vec<Local>,
}

impl Candidate {
    /// Whether it is on the boundary of the whole, which has this value there, not only on those of the pieces.
    pub(super) fn is_boundary(&self, value: f64, scale: &Scale) -> bool {
        Local { value, ..self.locals[0] }.distance() <= 4.0 * scale.near
    }

    /// The point itself; and points at its sides in the tangent planes of both pieces, if they are two.
    pub(super) fn around(&self, scale: &Scale) -> [[f64; 3]; AROUND] {
        let mut all = [self.at; AROUND];
        if let [first, second] = &self.locals[..] {
            let normals = [first.normal(), second.normal()];
            let along = cross(normals[0], normals[1]);
            let step = scale.cell.iter().fold(f64::INFINITY, |m: f64, &c| m.min(1e-3 * c)).max(30.0 * scale.near);
            for (k, normal) in normals.into_iter().enumerate() {
                let side = unit(cross(along, normal)).unwrap_or_default();
                for (sign, at) in [1.0, -1.0].into_iter().zip(&mut all[1 + 2 * k..]) {
                    *at = std::array::from_fn(|d| self.at[d] + sign * step * side[d]);
                }
            }
        }
        all
    }

    /// Whether the boundary is that of either piece on one side of the crease, by the values there.
    pub(super) fn is_crease(&self, values: &[f64]) -> bool {
        let is_on = |pair: &[f64]| {
            let [a, b] = [pair[0], pair[1]].map(|value| if value.is_nan() { f64::INFINITY } else { value.abs() });
            a.min(b) <= 0.3 * a.max(b)
        };
        self.locals.len() != 2 || is_on(&values[1..3]) && is_on(&values[3..5])
    }

    pub(super) fn site(&self, at: [f64; 3]) -> Site {
        Site { at, on: self.pieces.iter().copied().zip(self.locals.iter().map(Local::normal)).collect() }
    }
}

impl Open {
    /// Asks where one more piece meets the others.
    pub(super) fn look_further(&mut self, mut pieces: Vec<usize>, unseen: usize) {
        self.unseen += 1;
        pieces.push(unseen);
        pieces.sort_unstable();
        self.aim = None;
        self.stage = Stage::Corner(pieces);
    }

    pub(super) fn bit(&self, piece: usize) -> usize {
        self.numbers.iter().position(|&number| number == piece).unwrap_or(0)
    }

    /// The positions in the ring where sides begin whose ends have no surface in common.
    pub(super) fn crossed(&self) -> Vec<usize> {
        let n = self.corners.len();
        let pair = |i: usize| [&self.corners[i], &self.corners[(i + 1) % n]];
        (0..n).filter(|&i| self.surfaces.common(pair(i)) == 0).collect()
    }

    /// The middle of a side.
    pub(super) fn middle(&self, side: usize) -> [f64; 3] {
        let [a, b] = [self.corners[side].at, self.corners[(side + 1) % self.corners.len()].at];
        std::array::from_fn(|d| 0.5 * (a[d] + b[d]))
    }

    /// One piece of each corner of the ring.
    pub(super) fn piece(&self, corner: usize) -> usize {
        self.numbers[self.corners[corner].on.trailing_zeros() as usize % self.numbers.len()]
    }

    /// One piece of each surface that the ring needs, ascending.
    pub(super) fn surfaces_needed(&self) -> Vec<usize> {
        let mut taken = 0_u64;
        let wholes: Vec<u64> = self.corners.iter().map(|corner| self.surfaces.whole(corner.on)).collect();
        let first = |whole: u64| self.surfaces.of[whole.trailing_zeros() as usize];
        let mut needed = Vec::new();
        // Corners on one surface first: the others may do with what these need.
        for is_single in [true, false] {
            for &whole in &wholes {
                let surface = first(whole);
                if whole & taken == 0 && (whole == surface) == is_single {
                    taken |= surface;
                    needed.push(self.numbers[surface.trailing_zeros() as usize]);
                }
            }
        }
        needed.sort_unstable();
        needed
    }
}
