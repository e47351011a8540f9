//! Puts what the leaves found into the mesh: fans about new vertices, joined across the faces of cells. Polygons with triangles that stay turned are
//! left out, and all is done again without them. Evaluates little, and never makes a closed 2-manifold anything else.

use rayon::prelude::*;
use rustc_hash::FxHashMap;

use super::super::check::{Fault, check_about};
use super::super::marching::{Extraction, SurfaceError};
use super::super::mesh::{Mesh, cross, minus, unit};
use super::atlas::Atlas;
use super::net::{Net, Piece};
use super::solve::Scale;
use super::study::{Facet, Fill, Site};
use super::torn::Parts;
use super::{Plain, Sharpened, caps};
use crate::interrupt::Interrupt;

/// Times that polygons are left out before the mesh stays as plain as it was.
const ROUNDS: usize = 16;

/// A mesh that gets creases.
pub(super) struct Sewing<'a> {
    mesh: &'a Mesh,
    own: usize,
    facets: Vec<Facet>,
    atlas: Atlas,
    scale: Scale,
    /// Places and surfaces of all new vertices, and whether they lie within a cell.
    new: Vec<[f64; 3]>,
    surfaces: Vec<Vec<usize>>,
    is_free: Vec<bool>,
    /// Whether one was moved to a corner that it shares with a neighbour.
    is_shared: Vec<bool>,
    /// The polygon of each new vertex.
    facet_of: Vec<usize>,
    /// The numbers of the new vertices of a polygon: of its parts, then of its sides.
    numbers: Vec<(Vec<Option<u32>>, Vec<u32>)>,
    /// Parts that may be torn off, once somebody asks.
    parts: Option<Parts>,
    /// Those that were, as far as is known, and those that were not.
    torn: Vec<u32>,
    kept: Vec<u32>,
}

/// New vertices on sides in faces of the space.
pub(super) struct Splits<'a> {
    of: FxHashMap<[u32; 2], u32>,
    mesh: &'a Mesh,
    new: &'a [[f64; 3]],
}

impl Splits<'_> {
    /// The new vertex between two others.
    pub(super) fn between(&self, a: u32, b: u32) -> Option<u32> {
        self.of.get(&[a.min(b), a.max(b)]).copied()
    }

    pub(super) fn is_empty(&self) -> bool {
        self.of.is_empty()
    }

    pub(super) fn is_new(&self, vertex: u32) -> bool {
        vertex as usize >= self.mesh.positions.len()
    }

    pub(super) fn place(&self, vertex: u32) -> [f64; 3] {
        match (vertex as usize).checked_sub(self.mesh.positions.len()) {
            Some(new) => self.new[new],
            None => self.mesh.positions[vertex as usize],
        }
    }
}

/// What became of a round.
struct Sewn {
    mesh: Mesh,
    own: usize,
    /// The new vertices that it has.
    kept: Vec<usize>,
    /// Whether a vertex is at a new triangle.
    touched: Vec<bool>,
}

impl<'a> Sewing<'a> {
    pub(super) fn new(extraction: &'a Extraction, facets: Vec<Facet>, atlas: Atlas, scale: Scale) -> Self {
        let mesh = &extraction.mesh;
        let (new, surfaces, is_free, is_shared, facet_of, numbers) = Default::default();
        let (parts, torn, kept) = Default::default();
        let own = extraction.own;
        let mut sewing = Self {
            mesh,
            own,
            facets,
            atlas,
            scale,
            new,
            surfaces,
            is_free,
            is_shared,
            facet_of,
            numbers,
            parts,
            torn,
            kept,
        };
        for number in 0..sewing.facets.len() {
            let facet = &mut sewing.facets[number];
            let (parts, sides) = (std::mem::take(&mut facet.parts), std::mem::take(&mut facet.sides));
            let centres = parts.iter().map(|(_, fill)| match fill {
                Fill::Fan(site) => Some(sewing.give(site, number, true)),
                Fill::Cut(_) => None,
            });
            let centres = centres.collect();
            let ends = sides.iter().map(|(_, site)| sewing.give(site, number, false)).collect();
            sewing.numbers.push((centres, ends));
            (sewing.facets[number].parts, sewing.facets[number].sides) = (parts, sides);
        }
        sewing
    }

    /// Numbers a new vertex.
    fn give(&mut self, site: &Site, facet: usize, is_free: bool) -> u32 {
        let number = (self.mesh.positions.len() + self.new.len()) as u32;
        self.new.push(site.at);
        let mut surfaces: Vec<usize> = site.on.iter().map(|(surface, _)| *surface).collect();
        surfaces.dedup();
        self.surfaces.push(surfaces);
        self.is_free.push(is_free);
        self.is_shared.push(false);
        self.facet_of.push(facet);
        site.on.iter().for_each(|&(surface, normal)| self.atlas.note(number, surface, normal));
        number
    }

    /// The mesh with its creases and how many of its triangles are the object's own, if it has creases and no fault.
    pub(super) fn sew(mut self, interrupt: &Interrupt) -> Result<(Option<(Mesh, usize)>, Sharpened), SurfaceError> {
        for round in 0..ROUNDS {
            interrupt.tick()?;
            let is_last = round + 1 == ROUNDS;
            let (triangles, gone, wrong) = self.net();
            if !wrong.is_empty() && !is_last {
                if !self.share_corners(&wrong) {
                    self.leave_out(&self.facets_of(&wrong));
                }
                continue;
            }
            if triangles.is_empty() {
                break;
            }
            let sewn = self.put_together(&triangles, &gone);
            match check_about(&sewn.mesh, &sewn.touched) {
                Ok(()) if self.keep_uncovered(&sewn.mesh) && !is_last => {}
                Ok(()) => {
                    let mut told = self.told();
                    told.vertices = sewn.kept.len();
                    return Ok((Some((sewn.mesh, sewn.own)), told));
                }
                Err(Fault::Coincident(a, b, _)) if !is_last => {
                    let known = self.mesh.positions.len();
                    let new = [a, b].into_iter().filter_map(|vertex| vertex.checked_sub(known));
                    let facets: Vec<usize> = new.map(|new| self.facet_of[sewn.kept[new]]).collect();
                    self.leave_out(&facets);
                }
                Err(_) => break,
            }
        }
        self.torn.clear();
        for facet in self.facets.iter_mut().filter(|facet| facet.failed.is_none()) {
            facet.failed = Some(Plain::Fault);
        }
        Ok((None, self.told()))
    }

    /// Whether a polygon gets what was found for it.
    fn is_sharp(&self, facet: usize) -> bool {
        self.facets[facet].failed.is_none() && !self.is_torn(facet)
    }

    fn is_torn(&self, facet: usize) -> bool {
        let Some(parts) = self.parts.as_ref().filter(|_| !self.torn.is_empty()) else { return false };
        let part = parts.part(self.mesh.triangles[self.facets[facet].plain[0]][0]);
        part.is_some_and(|part| self.torn.contains(&part))
    }

    /// The polygons of triangles and of their new vertices.
    fn facets_of(&self, wrong: &[Piece]) -> Vec<usize> {
        let known = self.mesh.positions.len();
        let mut all: Vec<usize> = wrong.iter().filter_map(|piece| piece.facet.map(|facet| facet as usize)).collect();
        let corners = wrong.iter().flat_map(|piece| piece.corners);
        all.extend(corners.filter_map(|v| (v as usize).checked_sub(known)).map(|new| self.facet_of[new]));
        all.sort_unstable();
        all.dedup();
        all
    }

    /// Where the new vertices of two polygons that share a side have no surface in common with an old one between them, a corner is so near the
    /// side that neither polygon holds all of its surfaces: both vertices go there, once. Whether there are any.
    fn share_corners(&mut self, wrong: &[Piece]) -> bool {
        let known = self.mesh.positions.len();
        let mut is_any = false;
        for piece in wrong.iter().filter(|piece| piece.is_off()) {
            let new: Vec<usize> = piece.corners.iter().filter_map(|&v| (v as usize).checked_sub(known)).collect();
            let &[a, b] = &new[..] else { continue };
            let mut surfaces = [&self.surfaces[a][..], &self.surfaces[b]].concat();
            surfaces.sort_unstable();
            surfaces.dedup();
            if self.is_shared[a] || self.is_shared[b] || surfaces.len() > 4 {
                continue;
            }
            let from = std::array::from_fn(|d| 0.5 * (self.new[a][d] + self.new[b][d]));
            let Some(site) = self.atlas.corner(&surfaces, from, &self.scale) else { continue };
            if self.scale.cells(from, site.at).iter().any(|way| way.abs() > 1.0) {
                continue;
            }
            for new in [a, b] {
                self.is_shared[new] = true;
                self.new[new] = site.at;
                self.surfaces[new].clone_from(&surfaces);
                let vertex = (known + new) as u32;
                self.atlas.forget(vertex);
                site.on.iter().for_each(|&(surface, normal)| self.atlas.note(vertex, surface, normal));
            }
            is_any = true;
        }
        is_any
    }

    /// Leaves out polygons; or, if some are on small parts that may have been torn off, all of those parts.
    fn leave_out(&mut self, facets: &[usize]) {
        let parts = self.parts.get_or_insert_with(|| Parts::of(self.mesh, self.own));
        let part = |&facet: &usize| parts.part(self.mesh.triangles[self.facets[facet].plain[0]][0]);
        let mut torn: Vec<u32> = facets.iter().filter_map(part).filter(|part| !self.kept.contains(part)).collect();
        torn.sort_unstable();
        torn.dedup();
        if torn.is_empty() {
            facets.iter().for_each(|&facet| self.facets[facet].failed = Some(Plain::Crowded));
        }
        self.torn.extend(torn);
    }

    /// Puts back the parts that were not torn off, since no tip is where they are. Whether there are any.
    fn keep_uncovered(&mut self, mesh: &Mesh) -> bool {
        let Some(parts) = self.parts.as_ref().filter(|_| !self.torn.is_empty()) else { return false };
        let (covered, uncovered): (Vec<u32>, Vec<u32>) =
            self.torn.iter().partition(|part| parts.is_covered(**part, self.mesh, mesh));
        self.torn = covered;
        let is_back = !uncovered.is_empty();
        self.kept.extend(uncovered);
        is_back
    }

    /// What became of the cells.
    fn told(&self) -> Sharpened {
        let mut told = Sharpened { torn: self.torn.len(), ..Sharpened::default() };
        let numbers: Vec<usize> = (0..self.facets.len()).filter(|&facet| !self.is_torn(facet)).collect();
        for same in numbers.chunk_by(|&a, &b| self.facets[a].cell == self.facets[b].cell) {
            match same.iter().find_map(|&facet| self.facets[facet].failed) {
                Some(reason) => told.plain[reason as usize] += 1,
                None => told.cells += 1,
            }
        }
        told
    }

    /// The sides in faces of the space that have new vertices now.
    fn splits(&self) -> FxHashMap<[u32; 2], u32> {
        let sharp = (0..self.facets.len()).filter(|&facet| self.is_sharp(facet));
        let fans = sharp.filter(|&n| self.facets[n].parts.iter().any(|(_, fill)| matches!(fill, Fill::Fan(_))));
        fans.flat_map(|n| {
            let sides = self.facets[n].sides.iter().map(|([a, b], _)| [*a.min(b), *a.max(b)]);
            sides.zip(self.numbers[n].1.iter().copied())
        })
        .collect()
    }

    /// The new triangles, the triangles of the mesh that they replace, and those that are turned or on no surface.
    fn net(&mut self) -> (Vec<[u32; 3]>, Vec<u32>, Vec<Piece>) {
        let sharp: Vec<bool> = (0..self.facets.len()).map(|facet| self.is_sharp(facet)).collect();
        let mut gone: Vec<u32> = Vec::new();
        for (facet, _) in self.facets.iter().zip(&sharp).filter(|(_, is_sharp)| **is_sharp) {
            gone.extend(facet.plain.iter().map(|&t| t as u32));
        }
        if let Some(parts) = &self.parts {
            self.torn.iter().for_each(|&part| gone.extend(parts.triangles(part)));
        }
        let cell = self.scale.cell.into_iter().fold(0.0, f64::max);
        let new = (&self.new[..], &self.surfaces[..], &self.is_free[..]);
        let mut net = Net::new(self.mesh, new, &mut self.atlas, (cell, self.scale.near));
        for (number, facet) in self.facets.iter().enumerate().filter(|(number, _)| sharp[*number]) {
            let (centres, sides) = &self.numbers[number];
            for ((ring, fill), centre) in facet.parts.iter().zip(centres) {
                match (fill, centre) {
                    (Fill::Fan(_), &Some(centre)) => {
                        for (&a, &b) in ring.iter().zip(ring.iter().cycle().skip(1)) {
                            let split = facet.sides.iter().position(|(side, _)| *side == [a, b]);
                            let mut from = a;
                            for to in split.map(|side| sides[side]).into_iter().chain([b]) {
                                net.add([centre, from, to], None, Some(number as u32));
                                from = to;
                            }
                        }
                    }
                    (Fill::Cut(triangles), _) => triangles.iter().for_each(|&t| net.add_known(t, number as u32)),
                    _ => {}
                }
            }
        }
        net.cross_over();
        let ailing = net.ailing();
        let mut wrong = Vec::new();
        if !ailing.is_empty() {
            let (about, complete) = look_about(self.mesh, self.own, &self.facets, &ailing, &gone);
            about.into_iter().for_each(|t| net.add(self.mesh.triangles[t as usize], Some(t), None));
            wrong = net.mend(complete);
        }
        let (triangles, replaced) = net.result();
        gone.extend(replaced);
        (triangles, gone, wrong)
    }

    /// The mesh with new triangles in the place of others.
    fn put_together(&self, triangles: &[[u32; 3]], gone: &[u32]) -> Sewn {
        let known = self.mesh.positions.len();
        let mut is_used = vec![false; self.new.len()];
        let all = triangles.iter().flatten();
        all.filter_map(|&v| (v as usize).checked_sub(known)).for_each(|new| is_used[new] = true);
        let kept: Vec<usize> = (0..self.new.len()).filter(|&new| is_used[new]).collect();
        let mut renumbered = vec![0; self.new.len()];
        kept.iter().enumerate().for_each(|(number, &new)| renumbered[new] = (known + number) as u32);
        let number = |v: u32| (v as usize).checked_sub(known).map_or(v, |new| renumbered[new]);
        let mut mesh = Mesh {
            positions: self.mesh.positions.clone(),
            normals: self.mesh.normals.clone(),
            triangles: self.mesh.triangles[..self.own].to_vec(),
        };
        mesh.positions.extend(kept.iter().map(|&new| self.new[new]));
        gone.iter().for_each(|&t| mesh.triangles[t as usize] = [u32::MAX; 3]);
        mesh.triangles.retain(|t| t[0] != u32::MAX);
        let first = mesh.triangles.len();
        mesh.triangles.extend(triangles.iter().map(|t| t.map(number)));
        let own = mesh.triangles.len();
        let splits = Splits { of: self.splits(), mesh: self.mesh, new: &self.new };
        caps::split(self.mesh, self.own, &splits, &mut mesh.triangles);
        mesh.triangles[own..].iter_mut().flatten().for_each(|v| *v = number(*v));
        let mut touched = vec![false; mesh.positions.len()];
        let from = if splits.is_empty() { first..own } else { first..mesh.triangles.len() };
        mesh.triangles[from.clone()].iter().flatten().for_each(|&v| touched[v as usize] = true);
        give_normals(&mut mesh, known, from);
        Sewn { mesh, own, kept, touched }
    }
}

/// The triangles about polygons that are to be mended, but for those that are gone; and for each vertex whether all about it are among
/// them or are the net's already.
fn look_about(mesh: &Mesh, own: usize, facets: &[Facet], ailing: &[u32], gone: &[u32]) -> (Vec<u32>, Vec<bool>) {
    let mut complete = vec![false; mesh.positions.len()];
    let corners = |facet: &Facet| facet.plain.iter().flat_map(|&t| mesh.triangles[t]).collect::<Vec<u32>>();
    for &facet in ailing {
        corners(&facets[facet as usize]).into_iter().for_each(|v| complete[v as usize] = true);
    }
    // Their neighbours too.
    let about: Vec<Vec<u32>> =
        facets.par_iter().map(corners).filter(|all| all.iter().any(|&v| complete[v as usize])).collect();
    about.into_iter().flatten().for_each(|v| complete[v as usize] = true);
    let mut is_gone = vec![false; own];
    gone.iter().for_each(|&t| is_gone[t as usize] = true);
    let is_near = |(t, corners): &(usize, &[u32; 3])| !is_gone[*t] && corners.iter().any(|&v| complete[v as usize]);
    let near = mesh.triangles[..own].par_iter().enumerate().filter(is_near).map(|(t, _)| t as u32).collect();
    for &corner in mesh.triangles[own..].iter().flatten() {
        complete[corner as usize] = false;
    }
    (near, complete)
}

/// Normals of the new vertices: those of the triangles about them, weighted by area.
fn give_normals(mesh: &mut Mesh, known: usize, triangles: std::ops::Range<usize>) {
    let mut sums = vec![[0.0; 3]; mesh.positions.len() - known];
    for &triangle in &mesh.triangles[triangles] {
        if triangle.iter().all(|&v| (v as usize) < known) {
            continue;
        }
        let [a, b, c] = mesh.corners(triangle);
        let normal = cross(minus(b, a), minus(c, a));
        for vertex in triangle.map(|v| v as usize).into_iter().filter(|&v| v >= known) {
            (0..3).for_each(|d| sums[vertex - known][d] += normal[d]);
        }
    }
    mesh.normals.extend(sums.into_iter().map(|sum| unit(sum).unwrap_or([0.0, 0.0, 1.0])));
}
