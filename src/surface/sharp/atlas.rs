//! The smooth pieces of a whole function, each once, and which vertices lie on them. Changes no mesh.

use rustc_hash::FxHashMap;

use super::super::sampler::Sampler;
use super::solve::{Local, Meeting, Scale, meet};
use super::study::{Site, Study};
use crate::reuse::Digest;
use crate::vm::Program;

/// Pieces by number; those that go over into each other without a crease are one surface.
pub(super) struct Atlas {
    pieces: Vec<Program>,
    numbers: FxHashMap<u128, usize>,
    /// A piece of the same surface with a smaller number, or itself.
    parents: Vec<usize>,
    /// By surface, once all are known.
    members: FxHashMap<usize, Vec<usize>>,
    /// By vertex and surface: the normal if it lies on it.
    known: FxHashMap<(u32, usize), Option<[f64; 3]>>,
    sampler: Sampler,
    near: f64,
}

impl Atlas {
    pub(super) fn new(sampler: Sampler, near: f64) -> Self {
        let (pieces, numbers, parents, members) = Default::default();
        Self { pieces, numbers, parents, members, known: FxHashMap::default(), sampler, near }
    }

    /// Takes in the pieces of the leaves, and renumbers those of their new vertices.
    pub(super) fn gather(&mut self, studies: &mut [Study]) {
        let mut all = Vec::new();
        for study in &mut *studies {
            let pieces = std::mem::take(&mut study.pieces);
            let numbers: Vec<usize> = pieces.into_iter().map(|piece| self.number(piece)).collect();
            for &[a, b] in &study.smooth {
                self.join(numbers[a], numbers[b]);
            }
            all.push(numbers);
        }
        for piece in 0..self.pieces.len() {
            let surface = self.surface(piece);
            self.members.entry(surface).or_default().push(piece);
        }
        for (study, numbers) in studies.iter_mut().zip(&all) {
            for &(vertex, piece, normal) in &study.on {
                let surface = self.surface(numbers[piece]);
                // A vertex that is not on one piece of a surface may be on another.
                if normal.is_some() || self.members[&surface].len() == 1 {
                    let known = self.known.entry((vertex, surface)).or_insert(normal);
                    *known = known.or(normal);
                }
            }
            let sites = study.facets.iter_mut().flat_map(|facet| facet.sites());
            for on in sites.flat_map(|site| &mut site.on) {
                on.0 = self.surface(numbers[on.0]);
            }
        }
    }

    fn number(&mut self, piece: Program) -> usize {
        let mut digest = Digest::of("piece");
        piece.tell(&[], &mut digest);
        *self.numbers.entry(digest.key().bits()).or_insert_with(|| {
            self.parents.push(self.pieces.len());
            self.pieces.push(piece);
            self.pieces.len() - 1
        })
    }

    fn surface(&self, mut piece: usize) -> usize {
        while self.parents[piece] != piece {
            piece = self.parents[piece];
        }
        piece
    }

    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.surface(a), self.surface(b));
        self.parents[a.max(b)] = a.min(b);
    }

    /// Notes that a vertex lies on a surface.
    pub(super) fn note(&mut self, vertex: u32, surface: usize, normal: [f64; 3]) {
        self.known.insert((vertex, surface), Some(normal));
    }

    /// The point near a place where surfaces meet, with their normals.
    pub(super) fn corner(&mut self, surfaces: &[usize], from: [f64; 3], scale: &Scale) -> Option<Site> {
        let pieces: Vec<&Program> = surfaces.iter().map(|&surface| &self.pieces[surface]).collect();
        match meet(&pieces, &[from], None, scale, &mut self.sampler).pop() {
            Some(Meeting::At(at, locals)) => {
                Some(Site { at, on: surfaces.iter().copied().zip(locals.iter().map(Local::normal)).collect() })
            }
            _ => None,
        }
    }

    /// Forgets what is known of a vertex that is moved.
    pub(super) fn forget(&mut self, vertex: u32) {
        self.known.retain(|(known, _), _| *known != vertex);
    }

    /// The normal of a surface at a vertex that lies on it.
    pub(super) fn normal(&mut self, vertex: u32, at: [f64; 3], surface: usize) -> Option<[f64; 3]> {
        if let Some(known) = self.known.get(&(vertex, surface)) {
            return *known;
        }
        let members = self.members.get(&surface).map(Vec::as_slice).unwrap_or_default();
        let found = members.iter().find_map(|&piece| {
            let local = Local::of(&self.pieces[piece], at, &mut self.sampler);
            (local.distance() <= 1.5 * self.near).then(|| local.normal())
        });
        self.known.insert((vertex, surface), found);
        found
    }
}
