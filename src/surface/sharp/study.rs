//! What one leaf knows of creases: the smooth pieces that are live in it, which of them each vertex lies on, and where the sides between
//! vertices of different pieces cross the crease. Changes no mesh.

use rustc_hash::FxHashMap;

use super::super::grid::Grid;
use super::super::mesh::Mesh;
use super::super::sampler::Sampler;
use super::patches::{Patch, polygons};
use super::solve::{Local, Meeting, Scale, meet};
use super::{Plain, Work};
use crate::vm::{Pieces, Program, Shape};

/// Parts into which the way out is cut where a third surface is looked for.
const PARTS: usize = 64;
/// Steps that halve one of them.
const HALVINGS: usize = 48;
/// Operations of a program that is too long to be asked time and again.
const LONG: usize = 1 << 11;
/// Creases that may cross one side.
const DEPTH: usize = 2;

/// What was found between two vertices that lie on different pieces.
#[derive(Clone, Debug)]
pub(super) struct Segment {
    /// The two vertices, the smaller number first.
    pub(super) ends: [u32; 2],
    /// New vertices between them, in that order.
    pub(super) points: Vec<[f64; 3]>,
    /// Pieces that go over into each other without a crease.
    pub(super) smooth: Vec<[usize; 2]>,
    /// Pieces that are between those of the two vertices.
    pub(super) between: Vec<usize>,
    /// Why there is none.
    pub(super) failed: Option<Plain>,
}

/// What was found in a leaf.
pub(super) struct Study {
    /// The patches that hold more than one piece.
    pub(super) patches: Vec<usize>,
    /// The pieces.
    pub(super) pieces: Vec<Program>,
    /// The piece of each vertex.
    pub(super) piece_of: FxHashMap<u32, usize>,
    /// The sides that may cross a crease, each once.
    pub(super) segments: Vec<Segment>,
}

/// The parts of one thread that studies.
pub(super) struct Student<'a> {
    pub(super) mesh: &'a Mesh,
    pub(super) grid: &'a Grid,
    pub(super) scale: Scale,
    pub(super) shape: &'a Shape,
    pub(super) sampler: Sampler,
    pub(super) tracer: Pieces,
}

impl Student<'_> {
    /// Studies a leaf; none where there is but one piece.
    pub(super) fn study(&mut self, work: &Work, patches: &[Patch]) -> Option<Study> {
        let mut vertices: Vec<u32> = Vec::new();
        for patch in &patches[work.patches.clone()] {
            vertices.extend(self.mesh.triangles[patch.triangles.clone()].iter().flatten());
        }
        vertices.sort_unstable();
        vertices.dedup();
        let places: Vec<[f64; 3]> = vertices.iter().map(|&v| self.mesh.positions[v as usize]).collect();
        let mut pieces = Vec::new();
        let which = self.trace(&work.program, &places, &mut pieces);
        if pieces.len() < 2 {
            return None;
        }
        let piece_of: FxHashMap<u32, usize> = vertices.into_iter().zip(which).collect();
        let mut study = Study { patches: Vec::new(), pieces, piece_of, segments: Vec::new() };
        let mut known = FxHashMap::default();
        for at in work.patches.clone() {
            let triangles = &self.mesh.triangles[patches[at].triangles.clone()];
            let first = study.piece_of[&triangles[0][0]];
            if triangles.iter().flatten().all(|v| study.piece_of[v] == first) {
                continue;
            }
            study.patches.push(at);
            for polygon in polygons(triangles) {
                let sides = polygon.corners.iter().zip(polygon.corners.iter().cycle().skip(1));
                for (&a, &b) in sides {
                    let ends = [a.min(b), a.max(b)];
                    if study.piece_of[&a] != study.piece_of[&b] && known.insert(ends, ()).is_none() {
                        let segment = self.segment(&work.program, ends, patches[at].cell, &mut study);
                        study.segments.extend(segment);
                    }
                }
            }
        }
        Some(study)
    }

    /// The piece of the program at each place.
    pub(super) fn trace(&mut self, program: &Program, places: &[[f64; 3]], pieces: &mut Vec<Program>) -> Vec<usize> {
        let mut columns: Vec<Vec<f64>> =
            (0..self.shape.dimension).map(|d| places.iter().map(|p| p[d]).collect()).collect();
        columns.extend(self.shape.fixed.iter().map(|&value| vec![value; places.len()]));
        let slices: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
        let mut which = vec![0; places.len()];
        self.tracer.at(program, &slices, pieces, &mut which);
        which
    }

    /// Looks for the crease between two vertices; none where one of them lies on both surfaces.
    fn segment(&mut self, program: &Program, ends: [u32; 2], cell: [usize; 3], study: &mut Study) -> Option<Segment> {
        let places = ends.map(|v| self.mesh.positions[v as usize]);
        let pieces = ends.map(|v| study.piece_of[&v]);
        let mut segment = Segment { ends, points: Vec::new(), smooth: Vec::new(), between: Vec::new(), failed: None };
        for k in 0..2 {
            let [own, other] =
                [pieces[k], pieces[1 - k]].map(|piece| Local::of(&study.pieces[piece], places[k], &mut self.sampler));
            if own.distance() > 10.0 * self.scale.near {
                segment.failed = Some(Plain::Step);
                return Some(segment);
            }
            if other.distance() <= self.scale.near {
                return None;
            }
        }
        let Some(square) = Square::of(self.grid, cell, places) else {
            segment.failed = Some(Plain::Apart);
            return Some(segment);
        };
        let ends = [(places[0], pieces[0]), (places[1], pieces[1])];
        if let Err(reason) = self.cross(program, ends, &square, &mut study.pieces, &mut segment, DEPTH) {
            segment.points.clear();
            segment.failed = Some(reason);
        }
        Some(segment)
    }

    /// The creases that the outline in a square crosses between two of its points, each with its piece.
    fn cross(
        &mut self,
        program: &Program,
        ends: [([f64; 3], usize); 2],
        square: &Square,
        pieces: &mut Vec<Program>,
        segment: &mut Segment,
        depth: usize,
    ) -> Result<(), Plain> {
        let pair = ends.map(|(_, piece)| &pieces[piece]);
        let reason = match meet(pair, ends.map(|(at, _)| at), square.axis, &self.scale, &mut self.sampler) {
            Meeting::Smooth => {
                segment.smooth.push(ends.map(|(_, piece)| piece));
                return Ok(());
            }
            Meeting::At(place) => match square.within(place, &self.scale) {
                Some(place) if self.is_boundary(pair[0], place) => {
                    segment.points.push(place);
                    return Ok(());
                }
                Some(_) => Plain::Hidden,
                None => Plain::Outside,
            },
            Meeting::Nowhere => Plain::Apart,
        };
        let third = (depth > 0).then(|| self.third(program, ends, square, pieces)).flatten();
        let third = third.ok_or(reason)?;
        segment.between.push(third.1);
        self.cross(program, [ends[0], third], square, pieces, segment, depth - 1)?;
        self.cross(program, [third, ends[1]], square, pieces, segment, depth - 1)
    }

    /// Whether a place is on the boundary of the whole, not only on that of a piece.
    pub(super) fn is_boundary(&mut self, piece: &Program, place: [f64; 3]) -> bool {
        let value = self.whole(place);
        let slope = Local::of(piece, place, &mut self.sampler).slope;
        Local { value, slope }.distance() <= 4.0 * self.scale.near
    }

    /// The value of the whole, which the program of a leaf is only within it.
    fn whole(&mut self, place: [f64; 3]) -> f64 {
        Local::value(&self.shape.program, place, &mut self.sampler)
    }

    /// A point of the outline between two others that lies on a third piece.
    fn third(
        &mut self,
        program: &Program,
        [(a, first), (b, second)]: [([f64; 3], usize); 2],
        square: &Square,
        pieces: &mut Vec<Program>,
    ) -> Option<([f64; 3], usize)> {
        let [u, v] = square.sides();
        let middle: [f64; 3] = std::array::from_fn(|d| 0.5 * (a[d] + b[d]));
        let length = (b[u] - a[u]).hypot(b[v] - a[v]);
        let (across_u, across_v) = ((b[v] - a[v]) / length, (a[u] - b[u]) / length);
        let point = |t: f64| {
            let mut at = middle;
            at[u] += t * across_u;
            at[v] += t * across_v;
            at
        };
        let reach = 1.5 * self.scale.cell;
        let is_long = self.shape.program.len() > LONG;
        let mut is_inside = |t: f64| {
            let value = match point(t) {
                within if square.holds(within) => Local::value(program, within, &mut self.sampler),
                _ if is_long => f64::NAN,
                beyond => self.whole(beyond),
            };
            value >= 0.0
        };
        let here = is_inside(0.0);
        let found =
            (1..=PARTS).flat_map(|k| [k as f64, -(k as f64)]).find(|k| is_inside(reach * k / PARTS as f64) != here)?;
        let (mut near, mut far) = ((found - found.signum()) * reach / PARTS as f64, found * reach / PARTS as f64);
        for _ in 0..HALVINGS {
            let half = 0.5 * (near + far);
            if is_inside(half) == here {
                near = half;
            } else {
                far = half;
            }
        }
        let place = point(0.5 * (near + far));
        let whole = &self.shape.program;
        let program = if square.holds(place) || !Pieces::has_branches(whole) { program } else { whole };
        let piece = self.trace(program, &[place], pieces)[0];
        let on = Local::of(&pieces[piece], place, &mut self.sampler).distance() <= self.scale.near;
        (on && piece != first && piece != second).then_some((place, piece))
    }
}

/// The square of a cell in which a side lies.
pub(super) struct Square {
    /// The axis across it.
    pub(super) axis: usize,
    lo: [f64; 3],
    hi: [f64; 3],
}

impl Square {
    /// The face of a cell that holds both places.
    fn of(grid: &Grid, cell: [usize; 3], [a, b]: [[f64; 3]; 2]) -> Option<Self> {
        let lo = grid.point(cell);
        let hi = grid.point(cell.map(|i| i + 1));
        let axis = if grid.dimension() == 2 {
            2
        } else {
            (0..3).find(|&d| a[d] == b[d] && (a[d] == lo[d] || a[d] == hi[d]))?
        };
        Some(Self { axis, lo, hi })
    }

    fn sides(&self) -> [usize; 2] {
        [(self.axis + 1) % 3, (self.axis + 2) % 3]
    }

    fn holds(&self, at: [f64; 3]) -> bool {
        self.sides().iter().all(|&d| at[d] >= self.lo[d] && at[d] <= self.hi[d])
    }

    /// The place, kept off the sides of the square; none if it lies too far beyond them.
    fn within(&self, mut place: [f64; 3], scale: &Scale) -> Option<[f64; 3]> {
        for d in self.sides() {
            place[d] = scale.kept_off(d, place[d], [self.lo[d], self.hi[d]])?;
        }
        Some(place)
    }
}
