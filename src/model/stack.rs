//! A large stack for what recurses: brackets within calls within brackets. Work runs on a thread of its own and is waited for.

use std::sync::{Mutex, PoisonError};

/// Bytes of stack; only what is used is ever taken from the machine.
const STACK: usize = 256 << 20;

/// Runs `work` on a large stack; on the caller's if the system gives no thread.
pub fn with_large_stack<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    let waiting = Mutex::new(Some(work));
    let take = || waiting.lock().unwrap_or_else(PoisonError::into_inner).take().map(|work| work());
    let result = std::thread::scope(|scope| {
        let thread = std::thread::Builder::new().name("model".to_owned()).stack_size(STACK).spawn_scoped(scope, take);
        match thread.map(std::thread::ScopedJoinHandle::join) {
            Ok(Ok(result)) => result,
            Ok(Err(panic)) => std::panic::resume_unwind(panic),
            Err(_) => None,
        }
    });
    match result.or_else(take) {
        Some(result) => result,
        None => unreachable!("the work ran on the thread and gave a result, or runs here"),
    }
}
