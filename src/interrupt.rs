//! The cancel token that every long loop asks, the progress that it reports, what its phases cost, and where it finds what earlier work
//! left behind. No signals here: the front ends set the token.

use std::fmt;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use crate::reuse::{Digest, Reuse};

/// The error of a computation that was asked to stop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cancelled;

/// A token shared by a front end and the work that it started. Clones share one state.
#[derive(Clone, Debug, Default)]
pub struct Interrupt {
    state: Arc<State>,
    reuse: Option<Reuse>,
}

#[derive(Debug, Default)]
struct State {
    cancelled: AtomicBool,
    done: AtomicU64,
    total: AtomicU64,
    costs: Mutex<Costs>,
}

/// What the work cost since the last reset.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Costs {
    /// Each phase by its name, in the order in which they were first met.
    pub phases: Vec<(&'static str, Duration)>,
    /// What was counted, by its name.
    pub counts: Vec<(&'static str, u64)>,
    /// What was taken from earlier work instead of being computed.
    pub kept: Kept,
}

/// How much of some work was done before.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Kept {
    /// Whole results by their kind, and how many of each.
    pub wholes: Vec<(&'static str, u64)>,
    /// Pieces of the sampled spaces in which something had to be decided: those that were kept, and all.
    pub pieces: [u64; 2],
    /// Points evaluated: those that kept results had taken, and all.
    pub points: [u64; 2],
    /// Boxes bounded, in the same way.
    pub boxes: [u64; 2],
    /// Star solids that one edit, or none, made of those of before.
    pub edits: u64,
}

impl Kept {
    /// Whether nothing was kept.
    #[must_use]
    pub fn is_nothing(&self) -> bool {
        self.wholes.is_empty() && self.pieces[0] == 0 && self.edits == 0
    }
}

/// `whole meshes: 1; 118 of 125 pieces of the space, 93 % of the points and 71 % of the boxes not evaluated again`
impl fmt::Display for Kept {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let part = |[kept, all]: [u64; 2]| if all == 0 { 0 } else { u128::from(kept) * 100 / u128::from(all) };
        let mut parts: Vec<String> = self.wholes.iter().map(|(kind, count)| format!("whole {kind}: {count}")).collect();
        if self.pieces[0] > 0 {
            let [kept, all] = self.pieces;
            let (points, boxes) = (part(self.points), part(self.boxes));
            parts.push(format!(
                "{kept} of {all} pieces of the space, {points} % of the points and {boxes} % of the boxes not evaluated again"
            ));
        }
        if self.edits > 0 {
            parts.push(format!("star solids changed by an edit: {}", self.edits));
        }
        f.write_str(&parts.join("; "))
    }
}

/// A phase of the work that goes on; its time counts when it is dropped.
#[derive(Debug)]
pub struct Phase<'a> {
    name: &'static str,
    begun: Instant,
    interrupt: &'a Interrupt,
}

impl Drop for Phase<'_> {
    fn drop(&mut self) {
        let time = self.begun.elapsed();
        let mut costs = self.interrupt.lock();
        match costs.phases.iter_mut().find(|(name, _)| *name == self.name) {
            Some((_, sum)) => *sum += time,
            None => costs.phases.push((self.name, time)),
        }
    }
}

impl Interrupt {
    /// Asks the work to stop at its next tick. Safe to call from a signal thread.
    pub fn cancel(&self) {
        self.state.cancelled.store(true, Ordering::Relaxed);
    }

    /// Makes the token ready for the next piece of work.
    pub fn reset(&self) {
        self.state.cancelled.store(false, Ordering::Relaxed);
        self.begin(0);
        *self.lock() = Costs::default();
    }

    // A thread that panicked while it held the lock leaves whole numbers behind.
    fn lock(&self) -> MutexGuard<'_, Costs> {
        self.state.costs.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Begins a phase of the work. No result depends on its time.
    #[must_use]
    pub fn phase(&self, name: &'static str) -> Phase<'_> {
        Phase { name, begun: Instant::now(), interrupt: self }
    }

    /// Counts `more` of something: points, boxes.
    pub fn count(&self, name: &'static str, more: u64) {
        let mut costs = self.lock();
        match costs.counts.iter_mut().find(|(known, _)| *known == name) {
            Some((_, sum)) => *sum += more,
            None => costs.counts.push((name, more)),
        }
    }

    /// The same token for work that finds, and leaves, results there.
    #[must_use]
    pub fn keeping(self, reuse: Reuse) -> Self {
        Self { reuse: Some(reuse), ..self }
    }

    /// Where results of earlier work are.
    #[must_use]
    pub fn reuse(&self) -> Option<&Reuse> {
        self.reuse.as_ref()
    }

    /// A whole result of a kind: the one from earlier, if all that `tell` tells was the same then, or else what `make` makes, which is kept
    /// if there is room for its `bytes`.
    ///
    /// # Errors
    /// Those of `make`; [`Cancelled`] if the interrupt was set meanwhile.
    pub fn whole<T, E>(
        &self,
        kind: &'static str,
        tell: impl FnOnce(&mut Digest),
        bytes: impl FnOnce(&T) -> usize,
        make: impl FnOnce() -> Result<T, E>,
    ) -> Result<T, E>
    where
        T: Clone + Send + Sync + 'static,
        E: From<Cancelled>,
    {
        let Some(reuse) = &self.reuse else { return make() };
        let mut digest = Digest::of(kind);
        tell(&mut digest);
        let key = digest.key();
        if let Some(found) = reuse.find::<T>(key) {
            let mut costs = self.lock();
            match costs.kept.wholes.iter_mut().find(|(known, _)| *known == kind) {
                Some((_, count)) => *count += 1,
                None => costs.kept.wholes.push((kind, 1)),
            }
            return Ok((*found).clone());
        }
        let made = make()?;
        // Nothing that was evaluated after the interrupt was set may outlive it.
        self.tick()?;
        let bytes = bytes(&made);
        if reuse.has_room(bytes) {
            reuse.keep(key, Arc::new(made.clone()), bytes);
        }
        Ok(made)
    }

    /// Tells that a star solid came from that of before by an edit.
    pub fn kept_edit(&self) {
        self.lock().kept.edits += 1;
    }

    /// Tells how much of a walk through a space was taken from earlier work: pieces, points and boxes, kept ones and all.
    pub fn kept_pieces(&self, [pieces, points, boxes]: [[u64; 2]; 3]) {
        let mut costs = self.lock();
        let kept = &mut costs.kept;
        for (sum, more) in [(&mut kept.pieces, pieces), (&mut kept.points, points), (&mut kept.boxes, boxes)] {
            *sum = [sum[0] + more[0], sum[1] + more[1]];
        }
    }

    /// What the phases took and what was counted since the last reset.
    #[must_use]
    pub fn costs(&self) -> Costs {
        self.lock().clone()
    }

    /// Whether the work was asked to stop.
    #[must_use]
    pub fn is_cancelled(&self) -> bool {
        self.state.cancelled.load(Ordering::Relaxed)
    }

    /// Called inside every loop whose length a user decides.
    ///
    /// # Errors
    /// [`Cancelled`] once [`Interrupt::cancel`] was called.
    pub fn tick(&self) -> Result<(), Cancelled> {
        if self.is_cancelled() { Err(Cancelled) } else { Ok(()) }
    }

    /// Starts to count a task of `total` steps; 0 means unknown.
    pub fn begin(&self, total: u64) {
        self.state.done.store(0, Ordering::Relaxed);
        self.state.total.store(total, Ordering::Relaxed);
    }

    /// Reports `steps` more of the task as done.
    pub fn advance(&self, steps: u64) {
        self.state.done.fetch_add(steps, Ordering::Relaxed);
    }

    /// Steps done and steps in all (0: unknown), for a progress bar.
    #[must_use]
    pub fn progress(&self) -> (u64, u64) {
        (self.state.done.load(Ordering::Relaxed), self.state.total.load(Ordering::Relaxed))
    }
}
