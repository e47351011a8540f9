//! The cancel token that every long loop asks, the progress that it reports, and what its phases cost. No signals here: the front ends set the token.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// The error of a computation that was asked to stop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cancelled;

/// A token shared by a front end and the work that it started. Clones share one state.
#[derive(Clone, Debug, Default)]
pub struct Interrupt {
    state: Arc<State>,
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
