//! The tasks of earlier walks: what a visitor found of a box, kept under the program that is right inside it. An input that changes one part of
//! an object changes the programs of those boxes alone in which that part can matter; all others are found here, to the bit.

use std::any::Any;
use std::hash::Hash;
use std::sync::Arc;

use super::boxes::{Block, Lattice, Visitor};
use super::sampler::Counters;
use crate::interrupt::Interrupt;
use crate::reuse::{Digest, Key, Reuse};
use crate::vm::{Precision, Program, Shape};

/// What a visitor keeps of a task for the next time.
#[derive(Clone, Debug)]
pub struct Left {
    /// Its result.
    pub what: Arc<dyn Any + Send + Sync>,
    /// Bytes that it takes.
    pub bytes: usize,
}

/// A task that was done, and what it had cost.
struct Done {
    left: Left,
    counters: Counters,
}

/// Where a walk finds the tasks that were done before, and leaves its own.
pub(super) struct Memory<'a> {
    reuse: &'a Reuse,
    shape: &'a Shape,
    /// All that the results of all tasks depend on.
    common: Digest,
}

impl<'a> Memory<'a> {
    /// None where nothing is to be kept.
    pub(super) fn of<L: Lattice>(
        lattice: &L,
        (shape, room): (&'a Shape, f64),
        interrupt: &'a Interrupt,
    ) -> Option<Self> {
        let reuse = interrupt.reuse()?;
        let mut common = Digest::of("task");
        (shape.precision == Precision::Single, shape.dimension).hash(&mut common);
        common.number(room);
        lattice.tell(&mut common).then_some(Self { reuse, shape, common })
    }

    /// The name of a task's result. Each of its pieces has a program, or is known to be inside or outside.
    pub(super) fn key<'p, V: Visitor>(
        &self,
        visitor: &V,
        block: &Block,
        pieces: impl Iterator<Item = (&'p Block, Result<&'p Program, bool>)>,
    ) -> Key {
        let mut digest = self.common.clone();
        (block.from, block.to).hash(&mut digest);
        visitor.tell(&mut digest);
        for (block, what) in pieces {
            (block.from, block.to, what.err()).hash(&mut digest);
            if let Ok(program) = what {
                program.tell(&self.shape.fixed, &mut digest);
            }
        }
        digest.key()
    }

    /// Lets a visitor take what was kept of its task; what that had cost, if it did.
    pub(super) fn recall<V: Visitor>(&self, visitor: &mut V, key: Key) -> Option<Counters> {
        let done = self.reuse.find::<Done>(key)?;
        visitor.recall(&done.left).then(|| done.counters.clone())
    }

    /// Keeps what a visitor leaves of its task, if it leaves something.
    pub(super) fn keep<V: Visitor>(&self, visitor: &mut V, key: Key, counters: &Counters) {
        if let Some(left) = visitor.keep() {
            let bytes = left.bytes + size_of::<Done>();
            self.reuse.keep(key, Arc::new(Done { left, counters: counters.clone() }), bytes);
        }
    }
}

/// What of a walk was kept, and all: pieces in which something had to be decided, points, boxes.
#[derive(Debug, Default)]
pub(super) struct Tally(pub(super) [[u64; 2]; 3]);

impl Tally {
    pub(super) fn count(&mut self, cost: &Counters, was_kept: bool) {
        let piece = u64::from(cost.points > 0);
        for ([kept, all], more) in self.0.iter_mut().zip([piece, cost.points, cost.boxes]) {
            *kept += if was_kept { more } else { 0 };
            *all += more;
        }
    }
}
