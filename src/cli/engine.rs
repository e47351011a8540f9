//! The thread that the work runs on, with a stack for deep programs, and what Ctrl-C does to it.

use std::io::Write;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::interrupt::Interrupt;

use super::status::Status;

/// Bytes of the stack of the work: a tree of `Limits::nesting` levels is walked recursively in several places. Memory
/// is only taken as it is touched.
const STACK: usize = 512 << 20;
/// Bytes of the stacks of the threads that share the work.
const WORKER_STACK: usize = 16 << 20;

/// The switch between a program that a second Ctrl-C ends at once, and a prompt that Ctrl-C never leaves.
#[derive(Clone, Debug, Default)]
pub struct Signals {
    /// Cancels the work.
    pub interrupt: Interrupt,
    prompt: Arc<AtomicBool>,
}

impl Signals {
    /// From now on Ctrl-C only cancels.
    pub fn at_prompt(&self) {
        self.prompt.store(true, Ordering::Relaxed);
    }

    fn listen(&self) {
        let signals = self.clone();
        // Where no handler can be set, Ctrl-C ends the program, which leaves nothing half written either.
        let _ = ctrlc::set_handler(move || {
            let again = signals.interrupt.is_cancelled();
            signals.interrupt.cancel();
            if again && !signals.prompt.load(Ordering::Relaxed) {
                std::process::exit(i32::from(Status::Cancelled.code()));
            }
        });
    }
}

/// Runs `work` on a thread of its own with `threads` helpers (by default one for each core), and gives its status.
pub fn run(threads: Option<usize>, work: impl FnOnce(&Signals) -> Status + Send + 'static) -> Status {
    let signals = Signals::default();
    signals.listen();
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.unwrap_or(0)).stack_size(WORKER_STACK);
    if let Err(error) = pool.build_global() {
        return cannot_start(&error.to_string());
    }
    let thread = std::thread::Builder::new().name("yont".into()).stack_size(STACK);
    match thread.spawn(move || work(&signals)) {
        // A panic has told its place already; there is no result to be told.
        Ok(handle) => handle.join().unwrap_or(Status::Failed),
        Err(error) => cannot_start(&error.to_string()),
    }
}

fn cannot_start(words: &str) -> Status {
    let _ = writeln!(std::io::stderr().lock(), "error: the system gives no thread: {words}");
    Status::Failed
}
