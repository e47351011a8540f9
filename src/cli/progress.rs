//! A progress bar on standard error for what takes longer than half a second. It only reads the counters of the work.

use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread::JoinHandle;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::interrupt::Interrupt;

/// How long a task may take before a bar appears.
const PATIENCE: Duration = Duration::from_millis(500);
/// How often the bar moves.
const BEAT: Duration = Duration::from_millis(100);

/// A bar that lives as long as the task; dropped, it leaves no trace on the terminal.
#[derive(Debug)]
pub struct Progress {
    watcher: Option<(Sender<()>, JoinHandle<()>)>,
}

impl Progress {
    /// Watches the counters of `interrupt` under the words `what`. Does nothing unless `visible`.
    #[must_use]
    pub fn watch(interrupt: &Interrupt, what: &str, visible: bool) -> Self {
        if !visible {
            return Self { watcher: None };
        }
        let (stop, stopped) = channel();
        let (interrupt, what) = (interrupt.clone(), what.to_owned());
        let thread = std::thread::spawn(move || {
            if stopped.recv_timeout(PATIENCE) != Err(RecvTimeoutError::Timeout) {
                return;
            }
            let bar = bar(&what);
            while stopped.recv_timeout(BEAT) == Err(RecvTimeoutError::Timeout) {
                follow(&bar, &interrupt);
            }
            bar.finish_and_clear();
        });
        Self { watcher: Some((stop, thread)) }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some((stop, thread)) = self.watcher.take() {
            drop(stop);
            // A watcher that panicked has drawn its last line; the work itself is not touched.
            let _ = thread.join();
        }
    }
}

fn bar(what: &str) -> ProgressBar {
    let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::stderr());
    bar.set_style(ProgressStyle::default_spinner());
    bar.set_message(what.to_owned());
    bar
}

fn follow(bar: &ProgressBar, interrupt: &Interrupt) {
    let (done, total) = interrupt.progress();
    if total == 0 {
        bar.tick();
        return;
    }
    if bar.length().is_none()
        && let Ok(style) = ProgressStyle::with_template("{msg} {wide_bar} {percent:>3} % {eta}")
    {
        bar.set_style(style);
    }
    bar.set_length(total);
    bar.set_position(done.min(total));
}
