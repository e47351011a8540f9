//! The cancel token that every long loop asks, and the progress that it reports. No signals here: the front ends set the token.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

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
