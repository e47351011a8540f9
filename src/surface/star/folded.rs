//! Gauges that are folds of many operands (a sum, the least, the largest, a p-norm) and change from one mesh to the next: each vertex of a
//! guide keeps the fold, and an operand that is another one is taken out and put in alone, in a time that does not depend on how many
//! there are. Knows no half-spaces.
//!
//! A sum is kept in twice the digits, so that a term goes as it came and nothing drifts; of a p-norm it is the sum of the powers. The
//! least is kept with the runner-up, as \[A96\] 5.2 has it for an infinite blending parameter. Where the digits run out (the term that goes was
//! nearly all of the sum) or the runner-up is not known, all operands are evaluated anew at that vertex: the more operands, the fewer
//! vertices. An R-function of many operands is no fold: its value depends on the order, all operands behind the one that changes
//! would have to be put on again, so it is evaluated anew.

use std::sync::{Arc, Mutex, PoisonError};

use rayon::prelude::*;
use rustc_hash::FxHashMap;

use super::guide::Guide;
use crate::field::folded::How;
use crate::interrupt::{Cancelled, Interrupt};
use crate::number::functions::pow;
use crate::reuse::{Digest, Key};
use crate::vm::{Points, Program};

/// Vertices of one task of a thread.
const TASK: usize = 1024;
/// How much larger a term may have been than the sum is now: twice the digits of which a third are still right.
const DIGITS: f64 = 1e16;
/// The place of a runner-up that is not known: only that none is before its value.
const NOBODY: u32 = u32::MAX;

/// An operand of a fold, a function of the direction.
#[derive(Clone, Debug)]
pub struct Operand {
    /// Its program; the inputs are those of the gauge.
    pub program: Arc<Program>,
    /// Whether its sign is changed.
    pub minus: bool,
    /// What it computes.
    pub key: Key,
}

/// A gauge as a fold.
#[derive(Clone, Debug)]
pub struct Parts {
    /// How the operands are put together.
    pub how: How,
    /// The operands.
    pub operands: Vec<Operand>,
    /// The gauge as a function of the inputs and, behind them, the fold.
    pub around: Arc<Program>,
}

/// What one vertex keeps.
#[derive(Clone, Copy, Debug)]
struct Vertex {
    /// The sum and what is beyond its digits; or the least, and the runner-up.
    value: [f64; 2],
    /// The largest term that ever was in the sum, and what all terms are divided by.
    scale: [f64; 2],
    /// The operands of these two.
    who: [u32; 2],
}

/// A fold with what the vertices of a guide keep.
#[derive(Debug)]
struct Kept {
    how: How,
    fixed: Vec<f64>,
    /// The operands by number; nothing where one went.
    operands: Vec<Option<Operand>>,
    vertices: Vec<Vertex>,
}

/// A change of a fold: the operand of that number goes, or comes, or is another one.
struct Change {
    place: u32,
    old: Option<Operand>,
    new: Option<Operand>,
}

/// The values of the gauge at the vertices of a guide, by an edit of what is kept where that is enough; nothing where the fold has a value
/// that cannot be kept, or there is no room.
///
/// # Errors
/// [`Cancelled`] soon after the interrupt was set.
pub(super) fn values(
    parts: &Parts,
    fixed: &[f64],
    guide: &Guide,
    interrupt: &Interrupt,
) -> Result<Option<Vec<f64>>, Cancelled> {
    let Some(reuse) = interrupt.reuse() else { return Ok(None) };
    let bytes = guide.directions.len() * size_of::<Vertex>() + parts.operands.len() * size_of::<Operand>();
    if !reuse.has_room(bytes) {
        return Ok(None);
    }
    let mut digest = Digest::of("folds");
    guide.directions.iter().for_each(|direction| digest.numbers(direction));
    digest.shown(&parts.how);
    let key = digest.key();
    if let Some(kept) = reuse.find::<Mutex<Kept>>(key) {
        let mut kept = kept.lock().unwrap_or_else(PoisonError::into_inner);
        // Whatever happens meanwhile, a fold that is only half edited has no operands, so that it is not edited again.
        if let Some(changes) = kept.changes(parts, fixed) {
            let operands = std::mem::take(&mut kept.operands);
            if kept.edit(operands, changes, guide, interrupt)? {
                interrupt.kept_edit();
                return kept.around(parts, guide, interrupt).map(Some);
            }
        }
    }
    let Some(kept) = Kept::new(parts, fixed, guide, interrupt)? else { return Ok(None) };
    let values = kept.around(parts, guide, interrupt)?;
    reuse.keep(key, Arc::new(Mutex::new(kept)), bytes);
    Ok(Some(values))
}

impl Kept {
    fn new(parts: &Parts, fixed: &[f64], guide: &Guide, interrupt: &Interrupt) -> Result<Option<Self>, Cancelled> {
        let nothing = Vertex { value: [0.0; 2], scale: [0.0; 2], who: [NOBODY; 2] };
        let mut kept = Self {
            how: parts.how,
            fixed: fixed.to_vec(),
            operands: parts.operands.iter().cloned().map(Some).collect(),
            vertices: vec![nothing; guide.directions.len()],
        };
        let all: Vec<usize> = (0..guide.directions.len()).collect();
        Ok(kept.anew(&all, guide, interrupt)?.then_some(kept))
    }

    /// What changes make these operands those; nothing if so many that all may as well be evaluated anew.
    fn changes(&self, parts: &Parts, fixed: &[f64]) -> Option<Vec<Change>> {
        if fixed != self.fixed || self.operands.is_empty() {
            return None;
        }
        let mut places: FxHashMap<(Key, bool), Vec<u32>> = FxHashMap::default();
        for (place, operand) in self.operands.iter().enumerate() {
            if let Some(operand) = operand {
                places.entry((operand.key, operand.minus)).or_default().push(place as u32);
            }
        }
        let found = |operand: &&Operand| places.get_mut(&(operand.key, operand.minus)).and_then(Vec::pop).is_none();
        let mut new: Vec<Operand> = parts.operands.iter().filter(found).cloned().collect();
        new.reverse();
        let mut old: Vec<u32> = places.into_values().flatten().collect();
        old.sort_unstable();
        if 3 * old.len().max(new.len()) > parts.operands.len() {
            return None;
        }
        let mut changes: Vec<Change> = old
            .into_iter()
            .map(|place| Change { place, old: self.operands[place as usize].clone(), new: new.pop() })
            .collect();
        let more = (self.operands.len() as u32..).zip(new.into_iter().rev());
        changes.extend(more.map(|(place, operand)| Change { place, old: None, new: Some(operand) }));
        Some(changes)
    }

    /// Makes the changes one after the other; whether they could be made.
    fn edit(
        &mut self,
        mut operands: Vec<Option<Operand>>,
        changes: Vec<Change>,
        guide: &Guide,
        interrupt: &Interrupt,
    ) -> Result<bool, Cancelled> {
        for change in changes {
            let (how, fixed) = (self.how, &self.fixed);
            let tasks = self.vertices.par_chunks_mut(TASK).zip(guide.directions.par_chunks(TASK)).enumerate();
            let open: Vec<Vec<usize>> = tasks
                .map_init(Points::<f64>::new, |points, (task, (vertices, directions))| {
                    interrupt.tick()?;
                    let mut of = |operand: &Option<Operand>| {
                        operand.as_ref().map(|operand| evaluated(operand, how, directions, fixed, points))
                    };
                    let (old, new) = (of(&change.old), of(&change.new));
                    let at = |of: &Option<Vec<f64>>, k: usize| of.as_ref().map(|of| of[k]);
                    let stays = |(k, vertex): (usize, &mut Vertex)| {
                        (!vertex.change(how, change.place, at(&old, k), at(&new, k))).then_some(task * TASK + k)
                    };
                    Ok(vertices.iter_mut().enumerate().filter_map(stays).collect())
                })
                .collect::<Result<_, Cancelled>>()?;
            match operands.get_mut(change.place as usize) {
                Some(place) => *place = change.new,
                None => operands.push(change.new),
            }
            let open = open.concat();
            if !open.is_empty() {
                self.operands = std::mem::take(&mut operands);
                let done = self.anew(&open, guide, interrupt);
                operands = std::mem::take(&mut self.operands);
                if !done? {
                    return Ok(false);
                }
            }
        }
        self.operands = operands;
        Ok(true)
    }

    /// Evaluates all operands at some vertices; whether their values can be kept.
    fn anew(&mut self, which: &[usize], guide: &Guide, interrupt: &Interrupt) -> Result<bool, Cancelled> {
        let (how, fixed, operands) = (self.how, &self.fixed, &self.operands);
        let made: Vec<Option<Vec<Vertex>>> = which
            .par_chunks(TASK)
            .map_init(Points::<f64>::new, |points, which| {
                let directions: Vec<[f64; 3]> = which.iter().map(|k| guide.directions[*k]).collect();
                let mut folds = vec![Fold::new(how); which.len()];
                // The first walk finds what p-norms are divided by, the second adds.
                for walk in 0..how.walks() {
                    for (place, operand) in operands.iter().enumerate() {
                        let Some(operand) = operand else { continue };
                        interrupt.tick()?;
                        let values = evaluated(operand, how, &directions, fixed, points);
                        folds.iter_mut().zip(values).for_each(|(fold, v)| fold.take(how, walk, place as u32, v));
                    }
                }
                Ok(folds.into_iter().map(|fold| fold.vertex(how)).collect())
            })
            .collect::<Result<_, Cancelled>>()?;
        for (which, made) in which.chunks(TASK).zip(made) {
            let Some(made) = made else { return Ok(false) };
            which.iter().zip(made).for_each(|(k, vertex)| self.vertices[*k] = vertex);
        }
        Ok(true)
    }

    /// The gauge from what is kept.
    fn around(&self, parts: &Parts, guide: &Guide, interrupt: &Interrupt) -> Result<Vec<f64>, Cancelled> {
        let tasks = self.vertices.par_chunks(TASK).zip(guide.directions.par_chunks(TASK));
        let values: Vec<Vec<f64>> = tasks
            .map_init(Points::<f64>::new, |points, (vertices, directions)| {
                interrupt.tick()?;
                let folds: Vec<f64> = vertices.iter().map(|vertex| vertex.fold(self.how)).collect();
                Ok(run(&parts.around, directions, &self.fixed, Some(&folds), points))
            })
            .collect::<Result<_, Cancelled>>()?;
        Ok(values.concat())
    }
}

impl How {
    fn walks(self) -> usize {
        if matches!(self, Self::Norm(_)) { 2 } else { 1 }
    }
}

/// The values of an operand as the fold takes them: the largest is the least of the opposites.
fn evaluated(
    operand: &Operand,
    how: How,
    directions: &[[f64; 3]],
    fixed: &[f64],
    points: &mut Points<f64>,
) -> Vec<f64> {
    let mut values = run(&operand.program, directions, fixed, None, points);
    if operand.minus != (how == How::Largest) {
        values.iter_mut().for_each(|v| *v = -*v);
    }
    values
}

fn run(
    program: &Program,
    directions: &[[f64; 3]],
    fixed: &[f64],
    whole: Option<&[f64]>,
    points: &mut Points<f64>,
) -> Vec<f64> {
    let mut columns: Vec<Vec<f64>> = (0..3).map(|d| directions.iter().map(|v| v[d]).collect()).collect();
    columns.extend(fixed.iter().map(|&value| vec![value; directions.len()]));
    let mut at: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
    at.extend(whole);
    let mut out = vec![0.0; directions.len()];
    points.eval(program, &at, &mut out);
    out
}

/// A fold in the making.
#[derive(Clone, Copy, Debug)]
struct Fold {
    vertex: Vertex,
    is_good: bool,
}

impl Fold {
    fn new(how: How) -> Self {
        let (value, scale) = match how {
            How::Sum => ([0.0; 2], [0.0, 1.0]),
            How::Norm(p) => ([0.0; 2], [0.0, if p > 0.0 { 0.0 } else { f64::INFINITY }]),
            How::Least | How::Largest => ([f64::INFINITY; 2], [0.0, 1.0]),
        };
        Self { vertex: Vertex { value, scale, who: [NOBODY; 2] }, is_good: true }
    }

    fn take(&mut self, how: How, walk: usize, place: u32, v: f64) {
        self.is_good &= !v.is_nan();
        let vertex = &mut self.vertex;
        match how {
            How::Norm(p) if walk == 0 => {
                let base = &mut vertex.scale[1];
                *base = if p > 0.0 { base.max(v.abs()) } else { base.min(v.abs()) };
            }
            How::Sum | How::Norm(_) => vertex.add(vertex.term(how, v)),
            How::Least | How::Largest => {
                let [first, second] = vertex.value;
                if v < first || vertex.who[0] == NOBODY {
                    (vertex.value, vertex.who) = ([v, first], [place, vertex.who[0]]);
                } else if v < second || vertex.who[1] == NOBODY {
                    (vertex.value[1], vertex.who[1]) = (v, place);
                }
            }
        }
    }

    fn vertex(self, how: How) -> Option<Vertex> {
        (self.is_good && self.vertex.is_good(how)).then_some(self.vertex)
    }
}

impl Vertex {
    /// What a value counts in a sum.
    fn term(&self, how: How, v: f64) -> f64 {
        if let How::Norm(p) = how { pow(v.abs() / self.scale[1], p) } else { v }
    }

    /// Adds a term in twice the digits.
    fn add(&mut self, term: f64) {
        let [hi, lo] = self.value;
        let sum = hi + term;
        let back = sum - hi;
        let lost = (hi - (sum - back)) + (term - back);
        let lo = lo + lost;
        let hi = sum + lo;
        self.value = [hi, lo - (hi - sum)];
        self.scale[0] = self.scale[0].max(term.abs());
    }

    /// Whether the digits of a sum are right.
    fn is_good(&self, how: How) -> bool {
        let [hi, _] = self.value;
        match how {
            How::Sum => hi.is_finite() && self.scale[0] <= DIGITS * hi.abs(),
            How::Norm(_) => (1e-200..1e200).contains(&hi) && self.scale[0] <= DIGITS * hi,
            How::Least | How::Largest => true,
        }
    }

    /// Changes the operand of that number; `false` where all are to be evaluated anew.
    fn change(&mut self, how: How, place: u32, old: Option<f64>, new: Option<f64>) -> bool {
        if new.is_some_and(f64::is_nan) {
            return false;
        }
        if let How::Sum | How::Norm(_) = how {
            old.into_iter().for_each(|v| self.add(-self.term(how, v)));
            new.into_iter().for_each(|v| self.add(self.term(how, v)));
            return self.is_good(how);
        }
        let new = new.unwrap_or(f64::INFINITY);
        let ([first, second], [winner, runner]) = (self.value, self.who);
        if winner == place {
            // It stays the winner, or leaves that to the runner-up, behind which nobody is known.
            if new > second {
                if runner == NOBODY {
                    return false;
                }
                (self.value, self.who) = ([second, second], [runner, NOBODY]);
            } else {
                self.value[0] = new;
            }
        } else if new < first {
            (self.value, self.who) = ([new, first], [place, winner]);
        } else if new < second || runner == place && new == second {
            (self.value[1], self.who[1]) = (new, place);
        } else if runner == place {
            self.who[1] = NOBODY;
        }
        true
    }

    /// The fold.
    fn fold(&self, how: How) -> f64 {
        match how {
            How::Sum => self.value[0] + self.value[1],
            How::Norm(p) => self.scale[1] * pow(self.value[0] + self.value[1], 1.0 / p),
            How::Least => self.value[0],
            How::Largest => -self.value[0],
        }
    }
}
