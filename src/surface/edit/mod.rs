//! Star solids of half-spaces while they are edited: what each vertex of a guide shape keeps so that an edit costs the same however
//! many half-spaces there are. \[A96\] 5.2, without its drift (`mathematics.md` 2, Editing). Makes no mesh and knows no language.
//!
//! The parts (convex polyhedra) lie in a few blocks. A vertex keeps the norm of each block with a running bound of its error, the part
//! that is being edited apart from all blocks, and the norm of all blocks. So the part being edited is joined to *all the others* without
//! any difference, and only when another part is taken up a difference is formed, in the block that it comes from; where the part was
//! most of its block, and little would be left of the difference, that one block is evaluated anew at that vertex. The more parts
//! there are the fewer such vertices. With an infinite blending parameter the same test is whether the part is the winner of its block.

mod vertex;

use rayon::prelude::*;

use crate::interrupt::{Cancelled, Interrupt};
use crate::number::star::{AXES, Exponent, Polyhedron, Row, StarSolid};
use vertex::{Change, Place, Vertex};

/// Blocks of parts; more of them make a new evaluation cheaper, and a vertex larger.
const BLOCKS: usize = 8;
/// Vertices of one task of a thread.
const TASK: usize = 1024;

/// One edit. Parts and half-spaces are numbered from 0.
#[derive(Clone, Debug, PartialEq)]
pub enum Edit {
    /// Another half-space in the place of one.
    Move {
        /// Its part.
        part: usize,
        /// Its number in the part.
        row: usize,
        /// The new half-space.
        to: Row,
    },
    /// One more half-space, behind the others of the part.
    Add {
        /// The part.
        part: usize,
        /// The half-space.
        row: Row,
    },
    /// One half-space less.
    Remove {
        /// Its part, which must keep another one.
        part: usize,
        /// Its number in the part; those behind move up.
        row: usize,
    },
    /// Another polyhedron in the place of one; also another blending parameter of it.
    Replace {
        /// Its number.
        part: usize,
        /// The new one.
        with: Polyhedron,
    },
    /// One more part, behind the others.
    AddPart(Polyhedron),
    /// One part less: the last part takes its number.
    RemovePart(usize),
}

/// Why an edit was not made; nothing has changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refused {
    /// There is no part or no half-space with that number.
    NoSuch,
    /// The solid or the part would lose its last one.
    Last,
    /// The user stopped it; the next edit evaluates everything anew.
    Cancelled,
}

impl From<Cancelled> for Refused {
    fn from(_: Cancelled) -> Self {
        Self::Cancelled
    }
}

/// A star solid with what its guide's vertices keep.
#[derive(Clone, Debug)]
pub struct Sculpture {
    solid: StarSolid,
    vertices: Vec<Vertex>,
    /// The block of each part.
    places: Vec<u8>,
    /// The parts of each block, and how many half-spaces they have.
    blocks: [Vec<u32>; BLOCKS],
    weights: [usize; BLOCKS],
    /// The part that is in no block.
    lifted: Option<usize>,
    /// An edit was stopped half-way.
    stale: bool,
    /// Half-spaces and parts evaluated anew since the beginning, over all vertices.
    evaluated: u64,
}

impl Sculpture {
    /// The solid seen from the vertices of a guide shape about the origin. Takes as long as the vertices times the half-spaces.
    ///
    /// # Errors
    /// If the user stops it.
    pub fn new(solid: StarSolid, guide: &[[f64; 3]], interrupt: &Interrupt) -> Result<Self, Cancelled> {
        let mut sculpture = Self {
            vertices: guide.iter().map(|v| Vertex::new(*v)).collect(),
            places: Vec::with_capacity(solid.parts.len()),
            blocks: Default::default(),
            weights: [0; BLOCKS],
            lifted: None,
            stale: false,
            evaluated: 0,
            solid,
        };
        for part in 0..sculpture.solid.parts.len() {
            sculpture.place(part);
        }
        sculpture.rebuild(interrupt)?;
        Ok(sculpture)
    }

    /// The solid as it is now.
    #[must_use]
    pub fn solid(&self) -> &StarSolid {
        &self.solid
    }

    /// How far the boundary is in the direction of each vertex, in lengths of it.
    pub fn reaches(&self) -> impl ExactSizeIterator<Item = f64> + '_ {
        self.vertices.iter().map(|vertex| vertex.reach)
    }

    /// The vertices of the guide.
    pub fn guide(&self) -> impl ExactSizeIterator<Item = [f64; 3]> + '_ {
        self.vertices.iter().map(|vertex| vertex.direction)
    }

    /// The bytes that each vertex takes.
    #[must_use]
    pub const fn bytes_per_vertex() -> usize {
        size_of::<Vertex>()
    }

    /// How many half-spaces were evaluated since the beginning, over all vertices.
    #[must_use]
    pub fn evaluated(&self) -> u64 {
        self.evaluated
    }

    /// Makes an edit.
    ///
    /// # Errors
    /// If there is nothing of that number, or nothing would be left, or the user stops it.
    pub fn edit(&mut self, edit: Edit, interrupt: &Interrupt) -> Result<(), Refused> {
        interrupt.tick()?;
        self.check(&edit)?;
        if self.stale {
            self.rebuild(interrupt)?;
        }
        let (part, change) = self.prepare(edit);
        self.stale = true;
        if let Err(cancelled) = self.pass(part, &change, interrupt) {
            if let Change::Appear(_) = change {
                self.unplace(part);
            }
            return Err(cancelled.into());
        }
        self.finish(part, &change);
        self.stale = false;
        Ok(())
    }

    fn check(&self, edit: &Edit) -> Result<(), Refused> {
        let rows = |part: usize| self.solid.parts.get(part).map(|p| p.rows.len()).ok_or(Refused::NoSuch);
        match *edit {
            Edit::Move { part, row, .. } if row >= rows(part)? => Err(Refused::NoSuch),
            Edit::Remove { part, row } if row >= rows(part)? => Err(Refused::NoSuch),
            Edit::Remove { part, .. } if rows(part)? == 1 => Err(Refused::Last),
            Edit::Replace { ref with, .. } | Edit::AddPart(ref with) if with.rows.is_empty() => Err(Refused::Last),
            Edit::Add { part, .. } | Edit::Replace { part, .. } | Edit::RemovePart(part) => {
                rows(part)?;
                let last = matches!(edit, Edit::RemovePart(_)) && self.solid.parts.len() == 1;
                if last { Err(Refused::Last) } else { Ok(()) }
            }
            _ => Ok(()),
        }
    }

    /// The part that is concerned and what happens to it; a new part is there already, with its old value 0 everywhere.
    fn prepare(&mut self, edit: Edit) -> (usize, Change) {
        match edit {
            Edit::Move { part, row, to } => {
                (part, Change::Swap { row, old: Some(self.solid.parts[part].rows[row]), new: Some(to) })
            }
            Edit::Add { part, row } => {
                (part, Change::Swap { row: self.solid.parts[part].rows.len(), old: None, new: Some(row) })
            }
            Edit::Remove { part, row } => {
                (part, Change::Swap { row, old: Some(self.solid.parts[part].rows[row]), new: None })
            }
            Edit::Replace { part, with } => (part, Change::Become(with)),
            Edit::AddPart(new) => {
                self.solid.parts.push(new.clone());
                self.place(self.solid.parts.len() - 1);
                (self.solid.parts.len() - 1, Change::Appear(new))
            }
            Edit::RemovePart(part) => (part, Change::Vanish),
        }
    }

    /// Puts a part into the lightest block.
    fn place(&mut self, part: usize) {
        let lightest = (0..BLOCKS).min_by_key(|b| self.weights[*b]).unwrap_or(0);
        self.weights[lightest] += self.solid.parts[part].rows.len();
        #[allow(clippy::cast_possible_truncation)]
        {
            self.blocks[lightest].push(part as u32);
            self.places.push(lightest as u8);
        }
    }

    /// One walk over the vertices: puts the lifted part back, lifts the other one and changes it.
    fn pass(&mut self, part: usize, change: &Change, interrupt: &Interrupt) -> Result<(), Cancelled> {
        let after = change.applied(&self.solid.parts[part]);
        let before = &self.solid.parts[part];
        let back = self.lifted.filter(|lifted| *lifted != part).map(|lifted| usize::from(self.places[lifted]));
        let stays = self.lifted == Some(part);
        let p_back = self.lifted.map_or(self.solid.p, |lifted| self.solid.parts[lifted].p);
        let block = usize::from(self.places[part]);
        let members = &self.blocks[block];
        let place = Place { solid: &self.solid, part, members, block };
        let evaluated = self.vertices.par_chunks_mut(TASK).map(|task| {
            let mut evaluated = 0;
            for vertex in task {
                if let Some(block) = back {
                    vertex.put_back(block, p_back, place.solid.p);
                }
                if !stays {
                    evaluated += if matches!(change, Change::Appear(_)) {
                        vertex.lift_nothing(place.solid.p)
                    } else {
                        vertex.lift(&place, before)
                    };
                }
                evaluated += vertex.change(before.p, change, after.as_ref(), place.solid.p);
            }
            interrupt.tick().map(|()| evaluated)
        });
        self.evaluated += evaluated.try_reduce(|| 0, |a, b| Ok(a + b))?;
        Ok(())
    }

    fn finish(&mut self, part: usize, change: &Change) {
        self.lifted = Some(part);
        let block = usize::from(self.places[part]);
        if let Some(after) = change.applied(&self.solid.parts[part]) {
            self.weights[block] = self.weights[block] + after.rows.len() - self.solid.parts[part].rows.len();
            self.solid.parts[part] = after;
            return;
        }
        self.lifted = None;
        self.unplace(part);
    }

    /// Forgets a part; the last one takes its number.
    fn unplace(&mut self, part: usize) {
        let (block, last) = (usize::from(self.places[part]), self.solid.parts.len() - 1);
        self.weights[block] -= self.solid.parts[part].rows.len();
        self.blocks[block].retain(|p| *p as usize != part);
        #[allow(clippy::cast_possible_truncation)]
        for p in &mut self.blocks[usize::from(self.places[last])] {
            *p = if *p as usize == last { part as u32 } else { *p };
        }
        self.solid.parts.swap_remove(part);
        self.places.swap_remove(part);
    }

    /// Evaluates everything anew, with another global blending parameter if one is given.
    ///
    /// # Errors
    /// If the user stops it; the next edit does it then.
    pub fn reset(&mut self, p: Exponent, interrupt: &Interrupt) -> Result<(), Cancelled> {
        self.solid.p = p;
        self.rebuild(interrupt)
    }

    fn rebuild(&mut self, interrupt: &Interrupt) -> Result<(), Cancelled> {
        self.stale = true;
        self.lifted = None;
        let (solid, blocks) = (&self.solid, &self.blocks);
        self.vertices.par_chunks_mut(16).try_for_each(|task| {
            task.iter_mut().for_each(|vertex| vertex.evaluate(solid, blocks));
            interrupt.tick()
        })?;
        self.evaluated += (self.solid.half_spaces() * self.vertices.len()) as u64;
        self.stale = false;
        Ok(())
    }
}

/// The edit that makes one solid of another, if one is enough.
#[must_use]
pub fn difference(from: &StarSolid, to: &StarSolid) -> Option<Edit> {
    if (from.arity, from.p) != (to.arity, to.p) {
        return None;
    }
    let (a, b) = (&from.parts, &to.parts);
    let same = a.iter().zip(b).take_while(|(a, b)| a == b).count();
    if b.len() == a.len() + 1 && same == a.len() {
        return Some(Edit::AddPart(b[same].clone()));
    }
    if a.len() == b.len() + 1 {
        // The last part takes the number of the one that goes.
        let mut rest = a.clone();
        rest.swap_remove(same.min(b.len()));
        return (rest == *b).then(|| Edit::RemovePart(same.min(b.len())));
    }
    if a.len() != b.len() || same == a.len() || a[same + 1..] != b[same + 1..] {
        return None;
    }
    Some(inside(same, &a[same], &b[same]))
}

/// The edit that makes one polyhedron of another.
fn inside(part: usize, a: &Polyhedron, b: &Polyhedron) -> Edit {
    let replace = || Edit::Replace { part, with: b.clone() };
    if a.p != b.p {
        return replace();
    }
    let same = a.rows.iter().zip(&b.rows).take_while(|(a, b)| a == b).count();
    let rest = |rows: &[Row], skip: usize| rows.get(same + skip..).map(<[Row]>::to_vec).unwrap_or_default();
    if a.rows.len() == b.rows.len() && rest(&a.rows, 1) == rest(&b.rows, 1) {
        Edit::Move { part, row: same, to: b.rows[same] }
    } else if b.rows.len() == a.rows.len() + 1 && same == a.rows.len() {
        Edit::Add { part, row: b.rows[same] }
    } else if a.rows.len() == b.rows.len() + 1 && rest(&a.rows, 1) == rest(&b.rows, 0) {
        Edit::Remove { part, row: same }
    } else {
        replace()
    }
}

/// The direction of a vertex as a point of the solid's room.
fn point(direction: &[f64; 3]) -> Row {
    let mut at = [0.0; AXES];
    at[..3].copy_from_slice(direction);
    at
}
