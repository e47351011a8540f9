//! The triangles about creases, which are flipped and drawn together until each lies on one surface and none is turned. A closed 2-manifold stays one.

use rustc_hash::FxHashMap;

use super::super::mesh::{Mesh, cross, dot, minus};
use super::atlas::Atlas;

/// Times that all triangles with a fault are looked at.
const PASSES: usize = 24;
/// What a triangle on no one surface costs, in squares of cells.
const OFF: f64 = 1e4;

/// A triangle of the net.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    pub(super) corners: [u32; 3],
    /// The triangle of the mesh that it is, unless it is new.
    pub(super) origin: Option<u32>,
    /// The polygon that it was made for.
    pub(super) facet: Option<u32>,
    /// What is wrong with it; 0 if nothing is.
    cost: f64,
    /// The surface on which it lies, as far as that is known.
    surface: Option<usize>,
    /// Whether nothing can be done about it, since its neighbour stays plain.
    pub(super) is_bevel: bool,
    is_alive: bool,
}

impl Piece {
    /// Whether it lies on no one surface.
    pub(super) fn is_off(&self) -> bool {
        self.surface.is_none()
    }
}

/// The triangles about creases.
pub(super) struct Net<'a> {
    mesh: &'a Mesh,
    /// Places of the new vertices, whose numbers follow those of the mesh.
    new: &'a [[f64; 3]],
    /// The surfaces of the new vertices.
    surfaces: &'a [Vec<usize>],
    atlas: &'a mut Atlas,
    /// Whether all triangles about a vertex of the mesh are here.
    complete: Vec<bool>,
    /// Whether a new vertex may be drawn into another.
    is_free: &'a [bool],
    pub(super) pieces: Vec<Piece>,
    /// The triangle on the left of each side.
    sides: FxHashMap<[u32; 2], u32>,
    /// The triangles about each new vertex, and some that are no more.
    stars: Vec<Vec<u32>>,
    /// The square of a cell.
    unit: f64,
    /// Vertices that are closer than this become one.
    close: f64,
}

impl<'a> Net<'a> {
    pub(super) fn new(
        mesh: &'a Mesh,
        (new, surfaces, is_free): (&'a [[f64; 3]], &'a [Vec<usize>], &'a [bool]),
        atlas: &'a mut Atlas,
        (cell, near): (f64, f64),
    ) -> Self {
        Self {
            mesh,
            new,
            surfaces,
            atlas,
            complete: Vec::new(),
            is_free,
            pieces: Vec::new(),
            sides: FxHashMap::default(),
            stars: vec![Vec::new(); new.len()],
            unit: cell * cell,
            close: 3.0 * near,
        }
    }

    /// The number of a vertex among the new ones.
    fn new_number(&self, vertex: u32) -> Option<usize> {
        (vertex as usize).checked_sub(self.mesh.positions.len())
    }

    fn place(&self, vertex: u32) -> [f64; 3] {
        self.new_number(vertex).map_or_else(|| self.mesh.positions[vertex as usize], |new| self.new[new])
    }

    fn is_complete(&self, vertex: u32) -> bool {
        self.new_number(vertex)
            .map_or_else(|| self.complete.get(vertex as usize).is_some_and(|is| *is), |new| self.is_free[new])
    }

    /// Adds a triangle; what it costs counts for new ones only.
    pub(super) fn add(&mut self, corners: [u32; 3], origin: Option<u32>, facet: Option<u32>) {
        self.add_on(corners, origin, facet, &[]);
    }

    /// Adds a triangle of which all is well.
    pub(super) fn add_known(&mut self, corners: [u32; 3], facet: u32) {
        let (cost, surface, origin) = (0.0, None, None);
        self.put(Piece { corners, origin, facet: Some(facet), cost, surface, is_bevel: false, is_alive: true });
    }

    /// The same with surfaces on which it may lie beside those of its new vertices.
    fn add_on(&mut self, corners: [u32; 3], origin: Option<u32>, facet: Option<u32>, hints: &[Option<usize>]) {
        let (cost, surface) = if origin.is_some() { (0.0, None) } else { self.cost(corners, hints) };
        self.put(Piece { corners, origin, facet, cost, surface, is_bevel: false, is_alive: true });
    }

    fn put(&mut self, piece: Piece) {
        let number = self.pieces.len() as u32;
        let [a, b, c] = piece.corners;
        for side in [[a, b], [b, c], [c, a]] {
            self.sides.insert(side, number);
        }
        for corner in piece.corners {
            if let Some(new) = self.new_number(corner) {
                self.stars[new].push(number);
            }
        }
        self.pieces.push(piece);
    }

    fn remove(&mut self, number: u32) {
        let piece = &mut self.pieces[number as usize];
        piece.is_alive = false;
        let [a, b, c] = piece.corners;
        for side in [[a, b], [b, c], [c, a]] {
            if self.sides.get(&side) == Some(&number) {
                self.sides.remove(&side);
            }
        }
    }

    fn has_edge(&self, a: u32, b: u32) -> bool {
        self.sides.contains_key(&[a, b]) || self.sides.contains_key(&[b, a])
    }

    /// How much of a triangle is turned on the surface on which that is least, and that surface.
    fn cost(&mut self, corners: [u32; 3], hints: &[Option<usize>]) -> (f64, Option<usize>) {
        let places = corners.map(|corner| self.place(corner));
        let sides = [minus(places[1], places[0]), minus(places[2], places[0])];
        let normal = cross(sides[0], sides[1]);
        let size = dot(sides[0], sides[0]) + dot(sides[1], sides[1]);
        let all = self.surfaces;
        let own = corners.into_iter().find_map(|corner| self.new_number(corner)).map_or(&[][..], |new| &all[new][..]);
        let mut least = (OFF * self.unit, None);
        for surface in own.iter().copied().chain(hints.iter().flatten().copied()) {
            let mut out = 0.0;
            let is_on = (0..3).all(|k| match self.atlas.normal(corners[k], places[k], surface) {
                Some(own) => {
                    out += dot(own, normal) / 6.0;
                    true
                }
                None => false,
            });
            let cost = if out < -1e-9 * size { -out } else { 0.0 };
            if is_on && cost < least.0 {
                least = (cost, Some(surface));
                if cost == 0.0 {
                    break;
                }
            }
        }
        least
    }

    /// The triangle beyond the side from a to b, and its third corner.
    fn beyond(&self, a: u32, b: u32) -> Option<(u32, u32)> {
        let other = *self.sides.get(&[b, a])?;
        let third = self.pieces[other as usize].corners.into_iter().find(|&corner| corner != a && corner != b)?;
        Some((other, third))
    }

    /// Turns the sides between two fans into sides from one new vertex to the other.
    pub(super) fn cross_over(&mut self) {
        for number in 0..self.pieces.len() as u32 {
            let piece = self.pieces[number as usize];
            if !piece.is_alive || piece.origin.is_some() || piece.cost < OFF * self.unit {
                continue;
            }
            let [centre, a, b] = piece.corners;
            if self.new_number(centre).is_none() {
                continue;
            }
            let Some((other, beyond)) = self.beyond(a, b) else {
                self.pieces[number as usize].is_bevel = true;
                continue;
            };
            if self.new_number(beyond).is_none() || self.pieces[other as usize].origin.is_some() {
                self.pieces[number as usize].is_bevel = true;
            } else if !self.has_edge(centre, beyond) && centre != beyond {
                self.flip(number, other, [a, b, centre, beyond]);
            }
        }
    }

    /// Puts the other diagonal into two triangles: of a, b, c, and b, a, d.
    fn flip(&mut self, number: u32, other: u32, [a, b, c, d]: [u32; 4]) {
        let facet = self.pieces[number as usize].facet;
        let hints = [number, other].map(|of| self.pieces[of as usize].surface);
        self.remove(number);
        self.remove(other);
        for corners in [[c, a, d], [c, d, b]] {
            self.add_on(corners, None, facet, &hints);
        }
    }

    /// The polygons with triangles that are to be mended, or whose new vertex is as good as at another vertex.
    pub(super) fn ailing(&self) -> Vec<u32> {
        let is_ailing = |piece: &&Piece| {
            let is_short = |a: u32, b: u32| self.new_number(a).is_some() && self.is_close(a, b);
            let [a, b, c] = piece.corners;
            piece.is_alive
                && (piece.cost > 0.0 && !piece.is_bevel || is_short(a, b) || is_short(b, c) || is_short(a, c))
        };
        let mut all: Vec<u32> = self.pieces.iter().filter(is_ailing).filter_map(|piece| piece.facet).collect();
        all.sort_unstable();
        all.dedup();
        all
    }

    /// Flips sides and draws vertices together as long as that mends something; all triangles about vertices of the mesh that are
    /// `complete` must be here. The triangles that stay wrong.
    pub(super) fn mend(&mut self, complete: Vec<bool>) -> Vec<Piece> {
        self.complete = complete;
        self.draw_close();
        for _ in 0..PASSES {
            let wrong = self.wrong();
            let mut is_better = false;
            for &number in &wrong {
                if self.is_wrong(number) {
                    is_better |= self.improve(number);
                }
            }
            if !is_better {
                break;
            }
        }
        self.wrong().into_iter().map(|number| self.pieces[number as usize]).collect()
    }

    fn is_wrong(&self, number: u32) -> bool {
        let piece = &self.pieces[number as usize];
        piece.is_alive && piece.origin.is_none() && !piece.is_bevel && piece.cost > 0.0
    }

    fn wrong(&self) -> Vec<u32> {
        (0..self.pieces.len() as u32).filter(|&number| self.is_wrong(number)).collect()
    }

    /// The triangles that replace those of the mesh, and the ones of the mesh that are no more.
    pub(super) fn result(&self) -> (Vec<[u32; 3]>, Vec<u32>) {
        let new = self.pieces.iter().filter(|piece| piece.is_alive && piece.origin.is_none());
        let gone = self.pieces.iter().filter(|piece| !piece.is_alive).filter_map(|piece| piece.origin);
        (new.map(|piece| piece.corners).collect(), gone.collect())
    }

    /// Does whatever gains most of what can be done about a triangle. Whether anything can.
    fn improve(&mut self, number: u32) -> bool {
        let (flip, draw) = (self.best_flip(number), self.best_draw(number));
        let least = 1e-9 * self.unit;
        match (flip.filter(|flip| flip.0 > least), draw.filter(|draw| draw.0 > least)) {
            // A flip that gains as much leaves all vertices.
            (Some((gain, other, corners)), draw) if draw.is_none_or(|draw| draw.0 <= 1.001 * gain) => {
                self.flip(number, other, corners);
            }
            (_, Some((_, from, to))) => self.draw(from, to),
            _ => return false,
        }
        true
    }

    fn best_flip(&mut self, number: u32) -> Option<(f64, u32, [u32; 4])> {
        let piece = self.pieces[number as usize];
        let mut best: Option<(f64, u32, [u32; 4])> = None;
        for k in 0..3 {
            let [a, b, c] = std::array::from_fn(|i| piece.corners[(k + i) % 3]);
            let Some((other, d)) = self.beyond(a, b) else { continue };
            let is_known = self.is_complete(c) || self.is_complete(d);
            if c == d || !is_known || self.has_edge(c, d) {
                continue;
            }
            let before = piece.cost + self.pieces[other as usize].cost;
            let hints = [piece.surface, self.pieces[other as usize].surface];
            let gain = before - self.cost([c, a, d], &hints).0 - self.cost([c, d, b], &hints).0;
            if best.is_none_or(|(most, ..)| gain > most) {
                best = Some((gain, other, [a, b, c, d]));
            }
        }
        best
    }

    fn best_draw(&mut self, number: u32) -> Option<(f64, u32, u32)> {
        let mut best: Option<(f64, u32, u32)> = None;
        for from in self.pieces[number as usize].corners {
            for to in self.neighbours(from) {
                let Some(gain) = self.gain(from, to) else { continue };
                if best.is_none_or(|(most, ..)| gain > most) {
                    best = Some((gain, from, to));
                }
            }
        }
        best
    }

    /// The triangles about a new vertex.
    fn star(&self, vertex: u32) -> Vec<u32> {
        let Some(new) = self.new_number(vertex) else { return Vec::new() };
        let is_there = |number: &u32| {
            let piece = &self.pieces[*number as usize];
            piece.is_alive && piece.corners.contains(&vertex)
        };
        self.stars[new].iter().copied().filter(is_there).collect()
    }

    /// The vertices about a new vertex that may be drawn into one of them.
    fn neighbours(&self, vertex: u32) -> Vec<u32> {
        if !self.new_number(vertex).is_some_and(|new| self.is_free[new]) {
            return Vec::new();
        }
        let star = self.star(vertex);
        let mut all: Vec<u32> = star.iter().flat_map(|&number| self.pieces[number as usize].corners).collect();
        all.sort_unstable();
        all.dedup();
        all.retain(|&other| other != vertex);
        all
    }

    /// What is gained by drawing a new vertex into a neighbour; none where the mesh would not stay a 2-manifold.
    fn gain(&mut self, from: u32, to: u32) -> Option<f64> {
        if !self.is_complete(to) {
            return None;
        }
        let about = self.neighbours(from);
        let common = about.iter().filter(|&&other| other != to && self.has_edge(to, other)).count();
        let star = self.star(from);
        if common != 2 || star.len() < 4 {
            return None;
        }
        let (mut before, mut after) = (0.0, 0.0);
        for number in star {
            let piece = self.pieces[number as usize];
            before += piece.cost;
            if !piece.corners.contains(&to) {
                let moved = piece.corners.map(|corner| if corner == from { to } else { corner });
                after += self.cost(moved, &[piece.surface]).0;
            }
        }
        Some(before - after)
    }

    fn draw(&mut self, from: u32, to: u32) {
        let star = self.star(from);
        let old: Vec<Piece> = star.iter().map(|&number| self.pieces[number as usize]).collect();
        star.into_iter().for_each(|number| self.remove(number));
        for piece in old.into_iter().filter(|piece| !piece.corners.contains(&to)) {
            let moved = piece.corners.map(|corner| if corner == from { to } else { corner });
            self.add_on(moved, None, piece.facet, &[piece.surface]);
        }
    }

    /// Makes one vertex of a new one and another that is as good as there.
    fn draw_close(&mut self) {
        for new in 0..self.new.len() {
            let from = (self.mesh.positions.len() + new) as u32;
            let star = self.star(from);
            let about = star.iter().flat_map(|&number| self.pieces[number as usize].corners);
            let close: Vec<u32> = about.filter(|&to| to != from && self.is_close(from, to)).collect();
            for to in close {
                if self.gain(from, to).is_some_and(|gain| gain >= -1e-9 * self.unit) {
                    self.draw(from, to);
                    break;
                }
            }
        }
    }

    fn is_close(&self, a: u32, b: u32) -> bool {
        let way = minus(self.place(a), self.place(b));
        dot(way, way) <= self.close * self.close
    }
}
