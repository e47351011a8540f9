//! Fills the polygons of crease cells anew: along the creases between the new vertices of their sides, and about a vertex within where
//! creases meet in a corner. Only says what is to change.

use rustc_hash::{FxHashMap, FxHashSet};

use super::fill::{Corner, Filling, Surfaces, cut, fan};
use super::patches::{Patch, Polygon, polygons};
use super::solve::{Local, corner};
use super::study::{Segment, Student, Study};
use super::{Plain, Splits};
use crate::vm::Program;

/// What becomes of the triangles of a patch.
pub(super) struct Woven {
    pub(super) patch: usize,
    /// Those that replace it, if any do. Vertices of [`Woven::centres`] count down from `u32::MAX`.
    pub(super) triangles: Option<Vec<[u32; 3]>>,
    /// New vertices within the cell.
    pub(super) centres: Vec<[f64; 3]>,
    /// Whether it is sharp now; none if no crease crosses it.
    pub(super) verdict: Option<Result<(), Plain>>,
}

/// What becomes of a polygon.
enum Fate {
    Untouched,
    Left(Plain),
    Filled(Filling, Vec<Corner>, Option<[f64; 3]>, Option<Plain>),
}

/// A polygon with all that is known of it.
struct Piecework<'a> {
    polygon: &'a Polygon,
    corners: Vec<Corner>,
    surfaces: Surfaces,
    /// The pieces, by their bits.
    pieces: Vec<&'a Program>,
    /// The pieces on which a corner was found to be.
    own: u64,
    has_new: bool,
    failed: Option<Plain>,
}

impl Student<'_> {
    /// What becomes of the patches of a study.
    pub(super) fn weave(&mut self, study: &Study, patches: &[Patch], splits: &Splits) -> Vec<Woven> {
        let segments: FxHashMap<[u32; 2], &Segment> = study.segments.iter().map(|s| (s.ends, s)).collect();
        let mut all = Vec::with_capacity(study.patches.len());
        for &at in &study.patches {
            let cell = patches[at].cell;
            let mut fates = Vec::new();
            let polygons = polygons(&self.mesh.triangles[patches[at].triangles.clone()]);
            for polygon in &polygons {
                let work = self.piecework(study, &segments, polygon, cell, splits);
                fates.push(self.fate(work, cell));
            }
            all.push(woven(at, &polygons, fates));
        }
        all
    }

    /// What becomes of patches that no study has, but whose sides got new vertices by one of a neighbour.
    pub(super) fn strangers(&mut self, known: &[Woven], patches: &[Patch], splits: &Splits) -> Vec<Woven> {
        let known: FxHashSet<usize> = known.iter().map(|woven| woven.patch).collect();
        let mut all = Vec::new();
        for (at, patch) in patches.iter().enumerate() {
            let triangles = &self.mesh.triangles[patch.triangles.clone()];
            let is_marked = |t: &[u32; 3]| t.iter().filter(|&&v| splits.marked[v as usize]).count() > 1;
            if !triangles.iter().any(is_marked) || known.contains(&at) {
                continue;
            }
            let polygons = polygons(triangles);
            let fates = polygons
                .iter()
                .map(|polygon| {
                    let corners: Vec<Corner> = ring(polygon, splits)
                        .into_iter()
                        .map(|vertex| {
                            let normal = self.mesh.normals.get(vertex as usize).copied().unwrap_or_default();
                            Corner { on: 1, normals: vec![normal], ..self.corner(vertex, patch.cell, splits) }
                        })
                        .collect();
                    if corners.len() == polygon.corners.len() {
                        return Fate::Untouched;
                    }
                    let surfaces = Surfaces::new(1);
                    filled(corners, &surfaces, None)
                })
                .collect();
            all.push(Woven { verdict: None, ..woven(at, &polygons, fates) });
        }
        all
    }

    /// A corner whose pieces are not known yet.
    fn corner(&self, vertex: u32, cell: [usize; 3], splits: &Splits) -> Corner {
        let at = splits.place(self.mesh, vertex);
        let (lo, hi) = (self.grid.point(cell), self.grid.point(cell.map(|i| i + 1)));
        let face = |d: usize| u8::from(at[d] == lo[d]) << (2 * d) | u8::from(at[d] == hi[d]) << (2 * d + 1);
        Corner { vertex, at, faces: face(0) | face(1) | face(2), on: 0, normals: Vec::new() }
    }

    fn piecework<'a>(
        &mut self,
        study: &'a Study,
        segments: &FxHashMap<[u32; 2], &Segment>,
        polygon: &'a Polygon,
        cell: [usize; 3],
        splits: &Splits,
    ) -> Piecework<'a> {
        let sides = polygon.corners.iter().zip(polygon.corners.iter().cycle().skip(1));
        let sides: Vec<&Segment> = sides.filter_map(|(&a, &b)| segments.get(&[a.min(b), a.max(b)]).copied()).collect();
        let mut numbers: Vec<usize> = polygon.corners.iter().map(|v| study.piece_of[v]).collect();
        numbers.extend(sides.iter().flat_map(|side| &side.between));
        numbers.sort_unstable();
        numbers.dedup();
        numbers.truncate(64);
        let bit = |piece: usize| numbers.iter().position(|&number| number == piece).unwrap_or(0);
        let mut surfaces = Surfaces::new(numbers.len());
        sides.iter().flat_map(|side| &side.smooth).for_each(|&[a, b]| surfaces.join(bit(a), bit(b)));
        let pieces: Vec<&Program> = numbers.iter().map(|&number| &study.pieces[number]).collect();
        let mut own = sides.iter().flat_map(|side| &side.between).fold(0, |own, &piece| own | 1 << bit(piece));
        let mut corners = Vec::new();
        for vertex in ring(polygon, splits) {
            let mut corner = self.corner(vertex, cell, splits);
            // A new vertex may have been moved off the sides of its square.
            let near = if vertex < splits.first { self.scale.near } else { 4.0 * self.scale.near };
            self.place_on(&mut corner, &pieces, near);
            if let Some(&piece) = study.piece_of.get(&vertex) {
                corner.on |= 1 << bit(piece);
                own |= 1 << bit(piece);
            }
            corners.push(corner);
        }
        let has_new = corners.len() > polygon.corners.len();
        let failed = sides.iter().find_map(|side| side.failed);
        Piecework { polygon, corners, surfaces, pieces, own, has_new, failed }
    }

    /// Notes on which of the pieces a corner lies, and their normals there.
    fn place_on(&mut self, corner: &mut Corner, pieces: &[&Program], near: f64) {
        for (bit, piece) in pieces.iter().enumerate() {
            let local = Local::of(piece, corner.at, &mut self.sampler);
            corner.on |= u64::from(local.distance() <= near) << bit;
            corner.normals.push(local.normal());
        }
    }

    fn fate(&mut self, work: Piecework<'_>, cell: [usize; 3]) -> Fate {
        let Piecework { polygon, corners, surfaces, pieces, own, has_new, failed } = work;
        let is_one = |triangle: &[u32; 3]| {
            surfaces.common(corners.iter().filter(|corner| triangle.contains(&corner.vertex))) != 0
        };
        if !has_new && polygon.triangles.iter().all(is_one) {
            return Fate::Untouched;
        }
        let found = cut(&corners, &surfaces);
        if let Some(filling) = found.filter(|filling| filling.is_sharp) {
            return Fate::Filled(filling, corners, None, None);
        }
        if let Some(middle) = self.middle(&corners, &surfaces, &pieces, own, cell) {
            let filling = fan(&corners, &middle, &surfaces);
            if filling.is_sharp {
                return Fate::Filled(filling, corners, Some(middle.at), None);
            }
        }
        let reason = failed.unwrap_or(Plain::Crowded);
        if has_new { filled(corners, &surfaces, Some(reason)) } else { Fate::Left(reason) }
    }

    /// The point within the cell where all surfaces of a polygon meet, near where its sides cross them.
    fn middle(
        &mut self,
        corners: &[Corner],
        surfaces: &Surfaces,
        pieces: &[&Program],
        own: u64,
        cell: [usize; 3],
    ) -> Option<Corner> {
        let is_first =
            |piece: &usize| own >> piece & 1 == 1 && (surfaces.of[*piece] & own).trailing_zeros() as usize == *piece;
        let meeting: Vec<&Program> = (0..pieces.len()).filter(is_first).map(|piece| pieces[piece]).collect();
        let sum = |all: &mut dyn Iterator<Item = &Corner>| {
            all.fold(([0.0; 3], 0.0), |(sum, count), corner| {
                (std::array::from_fn(|d| sum[d] + corner.at[d]), count + 1.0)
            })
        };
        let is_on_crease = |corner: &&Corner| surfaces.of.iter().filter(|s| corner.on & **s != 0).count() > 1;
        let (mut place, mut count) = sum(&mut corners.iter().filter(is_on_crease));
        if count == 0.0 {
            (place, count) = sum(&mut corners.iter());
        }
        let found = corner(&meeting, place.map(|c| c / count), &self.scale, &mut self.sampler)?;
        let (lo, hi) = (self.grid.point(cell), self.grid.point(cell.map(|i| i + 1)));
        let mut at = found;
        for d in 0..3 {
            at[d] = self.scale.kept_off(d, found[d], [lo[d], hi[d]])?;
        }
        let mut middle = Corner { vertex: u32::MAX, at, faces: 0, on: 0, normals: Vec::new() };
        self.place_on(&mut middle, pieces, 4.0 * self.scale.near);
        self.is_boundary(meeting.first()?, found).then_some(middle)
    }
}

/// The corners of a polygon with the new vertices of its sides.
fn ring(polygon: &Polygon, splits: &Splits) -> Vec<u32> {
    let mut all = Vec::with_capacity(polygon.corners.len());
    for (&a, &b) in polygon.corners.iter().zip(polygon.corners.iter().cycle().skip(1)) {
        all.push(a);
        all.extend(splits.between(a, b));
    }
    all
}

/// A polygon that must be filled, sharp or not.
fn filled(corners: Vec<Corner>, surfaces: &Surfaces, reason: Option<Plain>) -> Fate {
    if let Some(filling) = cut(&corners, surfaces) {
        return Fate::Filled(filling, corners, None, reason);
    }
    let count = corners.len() as f64;
    let at = std::array::from_fn(|d| corners.iter().map(|corner| corner.at[d]).sum::<f64>() / count);
    let middle = Corner { vertex: u32::MAX, at, faces: 0, on: u64::MAX, normals: Vec::new() };
    Fate::Filled(fan(&corners, &middle, surfaces), corners, Some(at), reason)
}

fn woven(patch: usize, polygons: &[Polygon], fates: Vec<Fate>) -> Woven {
    let (mut triangles, mut centres, mut verdict) = (Vec::new(), Vec::new(), None);
    let mut is_new = false;
    for (fate, polygon) in fates.into_iter().zip(polygons) {
        let told = match fate {
            Fate::Untouched => {
                triangles.extend_from_slice(&polygon.triangles);
                None
            }
            Fate::Left(reason) => {
                triangles.extend_from_slice(&polygon.triangles);
                Some(Err(reason))
            }
            Fate::Filled(filling, corners, centre, reason) => {
                is_new = true;
                let number = u32::MAX - centres.len() as u32;
                centres.extend(centre);
                let vertex = |i: usize| corners.get(i).map_or(number, |corner| corner.vertex);
                triangles.extend(filling.triangles.into_iter().map(|t| t.map(vertex)));
                Some(reason.map_or(Ok(()), Err))
            }
        };
        verdict = match (verdict, told) {
            (Some(Err(reason)), _) => Some(Err(reason)),
            (old, None) => old,
            (_, new) => new,
        };
    }
    Woven { patch, triangles: is_new.then_some(triangles), centres, verdict }
}
