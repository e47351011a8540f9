//! Puts what the leaves found into the mesh: fans about new vertices, joined across the faces of cells. Polygons with triangles that stay turned are
//! left out, and all is done again without them. Evaluates little, and never makes a closed 2-manifold anything else.

use rustc_hash::{FxHashMap, FxHashSet};

use super::super::check::{Fault, check};
use super::super::marching::{Extraction, SurfaceError};
use super::super::mesh::{Mesh, cross, minus, unit};
use super::atlas::Atlas;
use super::net::Net;
use super::patches::Patch;
use super::solve::Scale;
use super::study::{Facet, Fill, Site};
use super::{Plain, Sharpened, caps};
use crate::interrupt::Interrupt;

/// Times that polygons are left out before the mesh stays as plain as it was.
const ROUNDS: usize = 12;

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
    /// The polygon of each new vertex.
    facet_of: Vec<usize>,
    /// The numbers of the new vertices of a polygon: of its parts, then of its sides.
    numbers: Vec<(Vec<Option<u32>>, Vec<u32>)>,
    /// The polygon that each of these triangles of the mesh belongs to.
    taken: FxHashMap<u32, usize>,
    /// Whether all triangles about a vertex are its own, and near a polygon.
    complete: Vec<bool>,
    /// Triangles at the corners of polygons, the polygons' own among them.
    about: Vec<u32>,
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

impl<'a> Sewing<'a> {
    pub(super) fn new(
        extraction: &'a Extraction,
        patches: &[Patch],
        facets: Vec<Facet>,
        atlas: Atlas,
        scale: Scale,
    ) -> Self {
        let mesh = &extraction.mesh;
        let (new, surfaces, is_free, facet_of, numbers, about, complete) = Default::default();
        let taken = FxHashMap::default();
        let mut sewing = Self {
            mesh,
            own: extraction.own,
            facets,
            atlas,
            scale,
            new,
            surfaces,
            is_free,
            facet_of,
            numbers,
            taken,
            complete,
            about,
        };
        for number in 0..sewing.facets.len() {
            let Facet { parts, sides, patch, plain, .. } = sewing.facets[number].clone();
            let centre = |(_, fill): (Vec<u32>, Fill)| match fill {
                Fill::Fan(site) => Some(site),
                Fill::Cut(_) => None,
            };
            let centres = parts.into_iter().map(centre).collect::<Vec<_>>();
            let centres = centres.into_iter().map(|site| site.map(|site| sewing.give(&site, number, true))).collect();
            let sides = sides.iter().map(|(_, site)| sewing.give(site, number, false)).collect();
            sewing.numbers.push((centres, sides));
            for t in patches[patch].triangles.clone() {
                if plain.contains(&mesh.triangles[t]) {
                    sewing.taken.insert(t as u32, number);
                }
            }
        }
        sewing.look_about();
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
        self.facet_of.push(facet);
        site.on.iter().for_each(|&(surface, normal)| self.atlas.note(number, surface, normal));
        number
    }

    /// Finds the triangles at the corners of polygons.
    fn look_about(&mut self) {
        let mut complete = vec![false; self.mesh.positions.len()];
        let corners = self.facets.iter().flat_map(|facet| facet.plain.iter().flatten());
        corners.for_each(|&corner| complete[corner as usize] = true);
        let is_near = |t: &[u32; 3]| t.iter().any(|&corner| complete[corner as usize]);
        let own = self.mesh.triangles[..self.own].iter().enumerate();
        self.about = own.filter(|(_, t)| is_near(t)).map(|(t, _)| t as u32).collect();
        for &corner in self.mesh.triangles[self.own..].iter().flatten() {
            complete[corner as usize] = false;
        }
        self.complete = complete;
    }

    /// The mesh with its creases and how many of its triangles are the object's own, if it has creases and no fault.
    pub(super) fn sew(mut self, interrupt: &Interrupt) -> Result<(Option<(Mesh, usize)>, Sharpened), SurfaceError> {
        for round in 0..ROUNDS {
            interrupt.tick()?;
            let (triangles, gone, wrong) = self.net();
            if !wrong.is_empty() && round + 1 < ROUNDS {
                wrong.into_iter().for_each(|facet| self.facets[facet].failed = Some(Plain::Crowded));
                continue;
            }
            if triangles.is_empty() {
                break;
            }
            let (mesh, own, kept) = self.put_together(&triangles, &gone);
            match check(&mesh) {
                Ok(_) => {
                    let mut told = self.told();
                    told.vertices = kept.len();
                    return Ok((Some((mesh, own)), told));
                }
                Err(Fault::Coincident(a, b, _)) if round + 1 < ROUNDS => {
                    let known = self.mesh.positions.len();
                    for vertex in [a, b] {
                        if let Some(new) = vertex.checked_sub(known) {
                            self.facets[self.facet_of[kept[new]]].failed = Some(Plain::Crowded);
                        }
                    }
                }
                Err(_) => break,
            }
        }
        for facet in self.facets.iter_mut().filter(|facet| facet.failed.is_none()) {
            facet.failed = Some(Plain::Fault);
        }
        Ok((None, self.told()))
    }

    /// What became of the cells.
    fn told(&self) -> Sharpened {
        let mut told = Sharpened::default();
        for same in self.facets.chunk_by(|a, b| a.patch == b.patch) {
            match same.iter().find_map(|facet| facet.failed) {
                Some(reason) => told.plain[reason as usize] += 1,
                None => told.cells += 1,
            }
        }
        told
    }

    /// The sides in faces of the space that have new vertices now.
    fn splits(&self) -> FxHashMap<[u32; 2], u32> {
        let sharp = self.facets.iter().zip(&self.numbers).filter(|(facet, _)| facet.failed.is_none());
        let fans = sharp.filter(|(facet, _)| facet.parts.iter().any(|(_, fill)| matches!(fill, Fill::Fan(_))));
        fans.flat_map(|(facet, (_, numbers))| {
            let sides = facet.sides.iter().map(|([a, b], _)| [*a.min(b), *a.max(b)]);
            sides.zip(numbers.iter().copied())
        })
        .collect()
    }

    /// The new triangles, the triangles of the mesh that they replace, and the polygons with a triangle that is turned or on no surface.
    fn net(&mut self) -> (Vec<[u32; 3]>, FxHashSet<u32>, Vec<usize>) {
        let cell = self.scale.cell.into_iter().fold(0.0, f64::max);
        let new = (&self.new[..], &self.surfaces[..], &self.is_free[..]);
        let mut net = Net::new(self.mesh, new, &self.complete, &mut self.atlas, (cell, self.scale.near));
        let is_sharp = |facet: &Facet| facet.failed.is_none();
        for &t in &self.about {
            if !self.taken.get(&t).is_some_and(|&facet| is_sharp(&self.facets[facet])) {
                net.add(self.mesh.triangles[t as usize], Some(t), None);
            }
        }
        for (number, facet) in self.facets.iter().enumerate().filter(|(_, facet)| is_sharp(facet)) {
            let (centres, sides) = &self.numbers[number];
            for ((ring, fill), centre) in facet.parts.iter().zip(centres) {
                match (fill, centre) {
                    (Fill::Fan(_), &Some(centre)) => {
                        for (&a, &b) in ring.iter().zip(ring.iter().cycle().skip(1)) {
                            let split = facet.sides.iter().position(|(side, _)| *side == [a, b]);
                            let way: &[u32] = &match split {
                                Some(side) => vec![a, sides[side], b],
                                None => vec![a, b],
                            };
                            way.windows(2).for_each(|w| net.add([centre, w[0], w[1]], None, Some(number as u32)));
                        }
                    }
                    (Fill::Cut(triangles), _) => {
                        triangles.iter().for_each(|&t| net.add_known(t, number as u32));
                    }
                    _ => {}
                }
            }
        }
        net.cross_over();
        let mut wrong = Vec::new();
        let known = self.mesh.positions.len();
        for piece in net.mend() {
            wrong.extend(piece.facet.map(|facet| facet as usize));
            let new = piece.corners.iter().filter_map(|&corner| (corner as usize).checked_sub(known));
            wrong.extend(new.map(|new| self.facet_of[new]));
        }
        wrong.sort_unstable();
        wrong.dedup();
        let (triangles, gone) = net.result();
        let mut gone: FxHashSet<u32> = gone.into_iter().collect();
        gone.extend(self.taken.iter().filter(|(_, facet)| is_sharp(&self.facets[**facet])).map(|(t, _)| *t));
        (triangles, gone, wrong)
    }

    /// The mesh with new triangles in the place of others; and which of the new vertices it has.
    fn put_together(&self, triangles: &[[u32; 3]], gone: &FxHashSet<u32>) -> (Mesh, usize, Vec<usize>) {
        let known = self.mesh.positions.len();
        let mut is_used = vec![false; self.new.len()];
        let all = triangles.iter().flatten();
        all.filter_map(|&v| (v as usize).checked_sub(known)).for_each(|new| is_used[new] = true);
        let kept: Vec<usize> = (0..self.new.len()).filter(|&new| is_used[new]).collect();
        let mut renumbered = vec![0; self.new.len()];
        kept.iter().enumerate().for_each(|(number, &new)| renumbered[new] = (known + number) as u32);
        let mut mesh = Mesh { positions: self.mesh.positions.clone(), ..Mesh::default() };
        mesh.normals.clone_from(&self.mesh.normals);
        mesh.positions.extend(kept.iter().map(|&new| self.new[new]));
        mesh.triangles.reserve(self.mesh.triangles.len() + triangles.len());
        let own = self.mesh.triangles[..self.own].iter().enumerate();
        mesh.triangles.extend(own.filter(|(t, _)| !gone.contains(&(*t as u32))).map(|(_, triangle)| *triangle));
        mesh.triangles.extend_from_slice(triangles);
        let own = mesh.triangles.len();
        let splits = Splits { of: self.splits(), mesh: self.mesh, new: &self.new };
        caps::split(self.mesh, self.own, &splits, &mut mesh.triangles);
        for vertex in mesh.triangles.iter_mut().flatten() {
            if let Some(new) = (*vertex as usize).checked_sub(known) {
                *vertex = renumbered[new];
            }
        }
        give_normals(&mut mesh, known);
        (mesh, own, kept)
    }
}

/// Normals of the new vertices: those of the triangles about them, weighted by area.
fn give_normals(mesh: &mut Mesh, known: usize) {
    let mut sums = vec![[0.0; 3]; mesh.positions.len() - known];
    for &triangle in &mesh.triangles {
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
