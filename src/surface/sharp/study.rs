//! What one leaf knows of creases: the smooth pieces that are live in it, which of them each vertex lies on, and for each polygon that holds
//! several of them the point where they meet. Changes no mesh.

use rustc_hash::FxHashMap;

use super::super::boxes::Lattice;
use super::super::grid::{Grid, LEAF};
use super::super::mesh::Mesh;
use super::super::sampler::Sampler;
use super::fill::{Corner, Surfaces, cut};
use super::open::{AROUND, Candidate, Open, Question, Stage};
use super::patches::{Cells, by_cells, polygons};
use super::solve::{Local, Meeting, Scale, meet};
use super::{Plain, Work};
use crate::vm::{Pieces, Program, Shape};

/// Rounds of questions: pairs of surfaces, corners, corners with a surface that was not seen, and the same for the parts of a polygon.
const ROUNDS: usize = 16;
/// Surfaces that a corner may get when it turns out not to be on the boundary.
const UNSEEN: usize = 2;
/// Parts of the way from a corner to such a point.
const STEPS: usize = 8;
/// How far from the middle of its polygon a point may lie, in cells.
const REACH: f64 = 6.0;

/// A new vertex: where it lies, and on which pieces, with their normals.
#[derive(Clone, Debug)]
pub(super) struct Site {
    pub(super) at: [f64; 3],
    pub(super) on: Vec<(usize, [f64; 3])>,
}

/// How a part of a polygon is filled.
#[derive(Clone, Debug)]
pub(super) enum Fill {
    /// With triangles that lie on one surface each.
    Cut(Vec<[u32; 3]>),
    /// About a new vertex.
    Fan(Site),
}

/// A polygon of a cell in which surfaces meet.
#[derive(Clone, Debug)]
pub(super) struct Facet {
    pub(super) cell: [usize; 3],
    /// The triangles of the mesh that fill it as long as it is plain.
    pub(super) plain: Vec<usize>,
    /// The corners of its parts, and how they are filled.
    pub(super) parts: Vec<(Vec<u32>, Fill)>,
    /// New vertices on sides that lie in a face of the space: their ends, in the direction of the polygon.
    pub(super) sides: Vec<([u32; 2], Site)>,
    /// Why it stays plain.
    pub(super) failed: Option<Plain>,
}

impl Facet {
    /// All its new vertices.
    pub(super) fn sites(&mut self) -> impl Iterator<Item = &mut Site> {
        let centres = self.parts.iter_mut().filter_map(|(_, fill)| match fill {
            Fill::Fan(site) => Some(site),
            Fill::Cut(_) => None,
        });
        centres.chain(self.sides.iter_mut().map(|(_, site)| site))
    }
}

/// What was found in a leaf.
pub(super) struct Study {
    /// The pieces.
    pub(super) pieces: Vec<Program>,
    /// Pieces that go over into each other without a crease.
    pub(super) smooth: Vec<[usize; 2]>,
    /// Vertices and pieces, with the normals of those on which they lie.
    pub(super) on: Vec<(u32, usize, Option<[f64; 3]>)>,
    /// The polygons.
    pub(super) facets: Vec<Facet>,
}

/// The parts of one thread that studies.
pub(super) struct Student<'a> {
    pub(super) mesh: &'a Mesh,
    pub(super) grid: &'a Grid,
    pub(super) cells: &'a Cells,
    pub(super) scale: Scale,
    pub(super) shape: &'a Shape,
    pub(super) sampler: Sampler,
    pub(super) tracer: Pieces,
}

impl Student<'_> {
    /// Studies a leaf; none where there is but one piece.
    pub(super) fn study(&mut self, work: &Work<'_>) -> Option<Study> {
        let mut vertices: Vec<u32> = Vec::new();
        for (_, range) in work.triangles {
            vertices.extend(self.mesh.triangles[range.clone()].iter().flatten());
        }
        vertices.sort_unstable();
        vertices.dedup();
        let places: Vec<[f64; 3]> = vertices.iter().map(|&v| self.mesh.positions[v as usize]).collect();
        let mut pieces = Vec::new();
        let which = trace(&mut self.tracer, self.shape, &work.program, &places, &mut pieces);
        if pieces.len() < 2 {
            return None;
        }
        let piece_of: FxHashMap<u32, usize> = vertices.into_iter().zip(which).collect();
        let mut study = Study { pieces, smooth: Vec::new(), on: Vec::new(), facets: Vec::new() };
        let mut rings = Vec::new();
        for (cell, triangles) in by_cells(self.mesh, work.triangles, self.cells) {
            let corners = || triangles.iter().flat_map(|&t| self.mesh.triangles[t]);
            let first = corners().next().map(|v| piece_of[&v]);
            if corners().all(|v| Some(piece_of[&v]) == first) {
                continue;
            }
            for polygon in polygons(self.mesh, &triangles) {
                let first = piece_of[&polygon.corners[0]];
                if polygon.corners.iter().any(|v| piece_of[v] != first) {
                    rings.push((cell, polygon.corners));
                    let (plain, parts, sides) = (polygon.triangles, Vec::new(), Vec::new());
                    study.facets.push(Facet { cell, plain, parts, sides, failed: None });
                }
            }
        }
        let mut opens = self.open(&rings, &piece_of, &mut study);
        for _ in 0..ROUNDS {
            if opens.iter().all(|open| matches!(open.stage, Stage::Done)) {
                break;
            }
            let questions = self.questions(&opens);
            let answers = self.answers(&questions, &study.pieces);
            self.hear(work, &mut opens, questions, answers, &mut study);
        }
        for open in opens.iter().filter(|open| !matches!(open.stage, Stage::Done)) {
            study.facets[open.facet].failed = Some(Plain::Crowded);
        }
        study.facets.retain(|facet| facet.failed.is_some() || !facet.parts.is_empty());
        Some(study)
    }

    /// The polygons with what is known of their corners.
    fn open(
        &mut self,
        rings: &[([usize; 3], Vec<u32>)],
        piece_of: &FxHashMap<u32, usize>,
        study: &mut Study,
    ) -> Vec<Open> {
        let mut wanted: Vec<(usize, u32)> = Vec::new();
        let numbers = |ring: &[u32]| {
            let mut numbers: Vec<usize> = ring.iter().map(|v| piece_of[v]).collect();
            numbers.sort_unstable();
            numbers.dedup();
            numbers.truncate(60);
            numbers
        };
        for (_, ring) in rings {
            let numbers = numbers(ring);
            ring.iter().for_each(|&v| wanted.extend(numbers.iter().map(|&piece| (piece, v))));
        }
        wanted.sort_unstable();
        wanted.dedup();
        let mut known: FxHashMap<(usize, u32), Local> = FxHashMap::default();
        for same in wanted.chunk_by(|a, b| a.0 == b.0) {
            let at: Vec<[f64; 3]> = same.iter().map(|(_, v)| self.mesh.positions[*v as usize]).collect();
            let locals = Local::all(&study.pieces[same[0].0], &at, &mut self.sampler);
            known.extend(same.iter().copied().zip(locals));
        }
        for &(piece, v) in &wanted {
            let local = known[&(piece, v)];
            let is_on = piece_of[&v] == piece || local.distance() <= self.scale.near;
            study.on.push((v, piece, is_on.then(|| local.normal())));
        }
        let mut opens = Vec::new();
        for (facet, (cell, ring)) in rings.iter().enumerate() {
            let numbers = numbers(ring);
            let surfaces = Surfaces::new(numbers.len());
            let corners = ring.iter().map(|&vertex| {
                let locals: Vec<Local> = numbers.iter().map(|&piece| known[&(piece, vertex)]).collect();
                let is_on = |(bit, local): (usize, &Local)| {
                    let on = numbers[bit] == piece_of[&vertex] || local.distance() <= self.scale.near;
                    u64::from(on) << bit
                };
                let on = locals.iter().enumerate().map(is_on).fold(0, |on, bit| on | bit);
                let at = self.mesh.positions[vertex as usize];
                Corner {
                    vertex,
                    at,
                    faces: self.faces(*cell, at),
                    on,
                    normals: locals.iter().map(Local::normal).collect(),
                }
            });
            let corners: Vec<Corner> = corners.collect();
            let is_step = ring.iter().any(|&v| {
                let own = known[&(piece_of[&v], v)];
                own.distance().is_nan() || own.distance() > 10.0 * self.scale.near
            });
            let mut open =
                Open { facet, cell: *cell, corners, numbers, surfaces, stage: Stage::Pairs, unseen: 0, aim: None };
            if is_step {
                study.facets[facet].failed = Some(Plain::Step);
                open.stage = Stage::Done;
            } else {
                settle(&mut open, self.mesh, study);
            }
            opens.push(open);
        }
        opens
    }

    /// The faces of a cell in which a place lies, a bit each.
    fn faces(&self, cell: [usize; 3], at: [f64; 3]) -> u8 {
        let (lo, hi) = (self.grid.point(cell), self.grid.point(cell.map(|i| i + 1)));
        let face = |d: usize| u8::from(at[d] == lo[d]) << (2 * d) | u8::from(at[d] == hi[d]) << (2 * d + 1);
        face(0) | face(1) | face(2)
    }

    /// The axis across the face of the space in which both ends of a side lie.
    fn face_of_space(&self, a: [f64; 3], b: [f64; 3]) -> Option<usize> {
        (0..self.grid.dimension()).find(|&d| a[d] == b[d] && (a[d] == self.grid.lo[d] || a[d] == self.grid.hi[d]))
    }

    fn questions(&self, opens: &[Open]) -> Vec<Question> {
        let mut questions = Vec::new();
        let asking = opens.iter().enumerate().filter(|(_, open)| !matches!(open.stage, Stage::Done));
        for (number, open) in asking {
            let crossed = open.crossed();
            let n = open.corners.len();
            let mean = |sides: &[usize]| -> [f64; 3] {
                let sum = sides
                    .iter()
                    .map(|&side| open.middle(side))
                    .fold([0.0; 3], |sum, middle| std::array::from_fn(|d| sum[d] + middle[d]));
                sum.map(|c| c / sides.len().max(1) as f64)
            };
            match &open.stage {
                Stage::Done => {}
                Stage::Pairs => {
                    let mut pairs: Vec<([usize; 2], usize)> = Vec::new();
                    for &side in &crossed {
                        let [a, b] = [open.piece(side), open.piece((side + 1) % n)];
                        pairs.push(([a.min(b), a.max(b)], side));
                        let [from, to] = [&open.corners[side], &open.corners[(side + 1) % n]];
                        if let Some(axis) = self.face_of_space(from.at, to.at) {
                            questions.push(Question {
                                open: number,
                                pieces: vec![a.min(b), a.max(b)],
                                axis: Some(axis),
                                from: open.middle(side),
                                side: Some([from.vertex, to.vertex]),
                            });
                        }
                    }
                    pairs.sort_unstable();
                    for same in pairs.chunk_by(|a, b| a.0 == b.0) {
                        let sides: Vec<usize> = same.iter().map(|(_, side)| *side).collect();
                        let pieces = same[0].0.to_vec();
                        questions.push(Question { open: number, pieces, axis: None, from: mean(&sides), side: None });
                    }
                }
                Stage::Corner(pieces) => questions.push(Question {
                    open: number,
                    pieces: pieces.clone(),
                    axis: open.aim.map(|(axis, _)| axis),
                    from: open.aim.map_or_else(|| mean(&crossed), |(_, from)| from),
                    side: None,
                }),
            }
        }
        questions
    }

    /// Where they meet; questions about the same pieces at once.
    fn answers(&mut self, questions: &[Question], pieces: &[Program]) -> Vec<Meeting> {
        let mut order: Vec<usize> = (0..questions.len()).collect();
        order.sort_by(|&a, &b| {
            let key = |i: usize| (&questions[i].pieces, questions[i].axis, i);
            key(a).cmp(&key(b))
        });
        let mut answers = vec![Meeting::Nowhere; questions.len()];
        let is_same = |&a: &usize, &b: &usize| {
            questions[a].pieces == questions[b].pieces && questions[a].axis == questions[b].axis
        };
        for same in order.chunk_by(is_same) {
            let of: Vec<&Program> = questions[same[0]].pieces.iter().map(|&piece| &pieces[piece]).collect();
            let from: Vec<[f64; 3]> = same.iter().map(|&i| questions[i].from).collect();
            let found = meet(&of, &from, questions[same[0]].axis, &self.scale, &mut self.sampler);
            same.iter().zip(found).for_each(|(&i, meeting)| answers[i] = meeting);
        }
        answers
    }

    /// What follows from the answers.
    fn hear(
        &mut self,
        work: &Work<'_>,
        opens: &mut Vec<Open>,
        questions: Vec<Question>,
        answers: Vec<Meeting>,
        study: &mut Study,
    ) {
        let asked = opens.len();
        let mut said: Vec<Vec<Candidate>> = (0..asked).map(|_| Vec::new()).collect();
        for (question, answer) in questions.into_iter().zip(answers) {
            let open = &mut opens[question.open];
            match answer {
                Meeting::Smooth => {
                    let [a, b] = [question.pieces[0], question.pieces[1]];
                    open.surfaces.join(open.bit(a), open.bit(b));
                    study.smooth.push([a, b]);
                }
                Meeting::At(at, locals) => {
                    let candidate = Candidate { open: question.open, pieces: question.pieces.clone(), at, locals };
                    match question.side {
                        Some(_) => self.note_side(&question, candidate, open.cell, &mut study.facets[open.facet]),
                        None => said[question.open].push(candidate),
                    }
                }
                Meeting::Nowhere => {}
            }
        }
        let mut candidates = Vec::new();
        for (number, mut mine) in said.into_iter().enumerate() {
            match opens[number].stage {
                Stage::Done => {}
                Stage::Corner(_) => match mine.pop() {
                    Some(candidate) => candidates.push(candidate),
                    None => fail(&mut opens[number], study, Plain::Apart),
                },
                Stage::Pairs => {
                    if settle(&mut opens[number], self.mesh, study) {
                        continue;
                    }
                    if let Some(parts) = self.parted(&opens[number], &study.pieces) {
                        opens[number].stage = Stage::Done;
                        opens.extend(parts);
                        continue;
                    }
                    let needed = opens[number].surfaces_needed();
                    match mine.into_iter().find(|candidate| candidate.pieces == needed) {
                        Some(candidate) => candidates.push(candidate),
                        None if needed.len() < 2 => fail(&mut opens[number], study, Plain::Crowded),
                        None if needed.len() == 2 => fail(&mut opens[number], study, Plain::Apart),
                        None => opens[number].stage = Stage::Corner(needed),
                    }
                }
            }
        }
        for open in &mut opens[asked..] {
            settle(open, self.mesh, study);
        }
        self.judge(work, opens, candidates, study);
    }

    /// A new vertex in a face of the space, if it is on the boundary there.
    fn note_side(&mut self, question: &Question, candidate: Candidate, cell: [usize; 3], facet: &mut Facet) {
        let (Some(axis), Some(side)) = (question.axis, question.side) else { return };
        let (lo, hi) = (self.grid.point(cell), self.grid.point(cell.map(|i| i + 1)));
        let far = self.scale.cells(question.from, candidate.at).iter().any(|way| way.abs() > 2.0);
        let mut at = candidate.at;
        for d in (0..3).filter(|&d| d != axis) {
            match self.scale.kept_off(d, at[d], [lo[d], hi[d]]) {
                Some(kept) => at[d] = kept,
                None => return,
            }
        }
        let value = Local::values(&self.shape.program, &[at], &mut self.sampler)[0];
        if !far && candidate.is_boundary(value, &self.scale) {
            facet.sides.push((side, candidate.site(at)));
        }
    }

    /// Keeps the points that are on the boundary of the whole, and asks again with the surface that hides the others.
    fn judge(&mut self, work: &Work<'_>, opens: &mut [Open], candidates: Vec<Candidate>, study: &mut Study) {
        let is_near = |candidate: &Candidate| self.is_in_leaf(opens[candidate.open].cell, candidate.at);
        let (within, beyond): (Vec<Candidate>, Vec<Candidate>) = candidates.into_iter().partition(is_near);
        let shape = self.shape;
        for (program, candidates) in [(&work.program, within), (&*shape.program, beyond)] {
            let places: Vec<[f64; 3]> = candidates.iter().flat_map(|candidate| candidate.around(&self.scale)).collect();
            let values = Local::values(program, &places, &mut self.sampler);
            for (candidate, values) in candidates.into_iter().zip(values.chunks(AROUND)) {
                let value = values[0];
                let open = &mut opens[candidate.open];
                let middle = open.middle(open.crossed().first().copied().unwrap_or(0));
                let far = self.scale.cells(middle, candidate.at).iter().any(|way| way.abs() > REACH);
                if far {
                    fail(open, study, Plain::Outside);
                } else if let Some(aim) = self.scale.beyond(candidate.at, self.grid.dimension()) {
                    // Where a crease leaves the space its last point is just within.
                    if candidate.pieces.len() > 2 || open.aim.is_some() {
                        fail(open, study, Plain::Outside);
                        continue;
                    }
                    open.aim = Some(aim);
                    open.stage = Stage::Corner(candidate.pieces);
                } else if candidate.is_boundary(value, &self.scale) {
                    // One of the surfaces may end before it gets there.
                    let ends = open.unseen < UNSEEN && !candidate.is_crease(values);
                    let open = &opens[candidate.open];
                    let unseen = if ends { self.ends_at(program, open, &candidate, &mut study.pieces) } else { None };
                    let open = &mut opens[candidate.open];
                    if let Some(unseen) = unseen {
                        open.look_further(candidate.pieces, unseen);
                        continue;
                    }
                    let ring = open.corners.iter().map(|corner| corner.vertex).collect();
                    study.facets[open.facet].parts.push((ring, Fill::Fan(candidate.site(candidate.at))));
                    open.stage = Stage::Done;
                } else if value.is_nan() || open.unseen == UNSEEN || !Pieces::has_branches(program) {
                    fail(open, study, Plain::Hidden);
                } else {
                    let unseen = trace(&mut self.tracer, shape, program, &[candidate.at], &mut study.pieces)[0];
                    if candidate.pieces.contains(&unseen) {
                        fail(open, study, Plain::Hidden);
                    } else {
                        open.look_further(candidate.pieces, unseen);
                    }
                }
            }
        }
    }

    /// The piece that takes over where one goes from the corners of a polygon to a point on their pieces, if there is one.
    fn ends_at(
        &mut self,
        program: &Program,
        open: &Open,
        candidate: &Candidate,
        pieces: &mut Vec<Program>,
    ) -> Option<usize> {
        let way = |corner: &Corner| {
            let from = corner.at;
            (1..STEPS).map(move |k| {
                let share = k as f64 / STEPS as f64;
                std::array::from_fn(|d| from[d] + share * (candidate.at[d] - from[d]))
            })
        };
        let places: Vec<[f64; 3]> = open.corners.iter().flat_map(way).collect();
        let found = trace(&mut self.tracer, self.shape, program, &places, pieces);
        found.into_iter().find(|piece| !candidate.pieces.contains(piece))
    }

    /// Whether the program of the leaf of a cell is right at a place.
    fn is_in_leaf(&self, cell: [usize; 3], place: [f64; 3]) -> bool {
        let counts = self.grid.counts();
        (0..self.grid.dimension()).all(|d| {
            let first = cell[d] / LEAF * LEAF;
            let last = (first + LEAF).min(counts[d] - 1);
            place[d] >= self.grid.coordinate(d, first) && place[d] <= self.grid.coordinate(d, last)
        })
    }

    /// Two parts of a polygon that the same surface enters twice: cut where the chord lies on the boundary.
    fn parted(&mut self, open: &Open, pieces: &[Program]) -> Option<[Open; 2]> {
        let n = open.corners.len();
        let crossed = open.crossed();
        // Runs of corners on one surface begin behind the crossed sides.
        let run = |corner: usize| crossed.iter().filter(|&&side| side < corner).count() % crossed.len().max(1);
        let mut best: Option<(f64, f64, usize, usize)> = None;
        for i in 0..n {
            for j in i + 2..n {
                let [a, b] = [&open.corners[i], &open.corners[j]];
                let common = open.surfaces.common([a, b]);
                if run(i) == run(j) || a.faces & b.faces != 0 || common == 0 {
                    continue;
                }
                let middle: [f64; 3] = std::array::from_fn(|d| 0.5 * (a.at[d] + b.at[d]));
                let value = Local::values(&self.shape.program, &[middle], &mut self.sampler)[0];
                let piece = &pieces[open.numbers[common.trailing_zeros() as usize]];
                let local = Local { value, ..Local::of(piece, middle, &mut self.sampler) };
                let off = (local.distance() - self.scale.near).max(0.0);
                let length = self.scale.cells(a.at, b.at).iter().map(|c| c * c).sum::<f64>();
                let is_better = best.is_none_or(|(least, shortest, ..)| (off, length) < (least, shortest));
                if off <= 0.1 * self.scale.cell.iter().fold(f64::INFINITY, |m: f64, &c| m.min(c)) && is_better {
                    best = Some((off, length, i, j));
                }
            }
        }
        let (_, _, i, j) = best?;
        let part = |corners: Vec<Corner>| Open {
            facet: open.facet,
            cell: open.cell,
            corners,
            numbers: open.numbers.clone(),
            surfaces: open.surfaces.clone(),
            stage: Stage::Pairs,
            unseen: 0,
            aim: None,
        };
        let rest = open.corners[j..].iter().chain(&open.corners[..=i]).cloned().collect();
        Some([part(open.corners[i..=j].to_vec()), part(rest)])
    }
}

/// The piece of a program at each place.
pub(super) fn trace(
    tracer: &mut Pieces,
    shape: &Shape,
    program: &Program,
    places: &[[f64; 3]],
    pieces: &mut Vec<Program>,
) -> Vec<usize> {
    let mut columns: Vec<Vec<f64>> = (0..shape.dimension).map(|d| places.iter().map(|p| p[d]).collect()).collect();
    columns.extend(shape.fixed.iter().map(|&value| vec![value; places.len()]));
    let slices: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
    let mut which = vec![0; places.len()];
    tracer.at(program, &slices, pieces, &mut which);
    which
}

fn fail(open: &mut Open, study: &mut Study, reason: Plain) {
    open.stage = Stage::Done;
    study.facets[open.facet].failed = Some(reason);
}

/// Whether a polygon needs no new vertex.
fn settle(open: &mut Open, mesh: &Mesh, study: &mut Study) -> bool {
    if !open.crossed().is_empty() {
        return false;
    }
    let facet = &mut study.facets[open.facet];
    let is_whole = facet.plain.len() + 2 == open.corners.len();
    let is_one = |&t: &usize| {
        let triangle = mesh.triangles[t];
        open.surfaces.common(open.corners.iter().filter(|corner| triangle.contains(&corner.vertex))) != 0
    };
    if is_whole && facet.plain.iter().all(is_one) {
        open.stage = Stage::Done;
        return true;
    }
    let Some(filling) = cut(&open.corners, &open.surfaces).filter(|filling| filling.is_sharp) else { return false };
    let triangles = filling.triangles.iter().map(|t| t.map(|i| open.corners[i].vertex)).collect();
    let ring = open.corners.iter().map(|corner| corner.vertex).collect();
    facet.parts.push((ring, Fill::Cut(triangles)));
    open.stage = Stage::Done;
    true
}
