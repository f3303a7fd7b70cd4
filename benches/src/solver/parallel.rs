//! A parallel map over all cores with deterministic output order.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

/// Returns `f(0)`, …, `f(count − 1)`, in that order.
pub fn map<T: Send>(count: usize, f: impl Fn(usize) -> T + Sync) -> Vec<T> {
    /// Number of items that a worker takes at once: large enough to hide the cost of the atomic counter, small enough
    /// to balance the load.
    const AT_ONCE: usize = 16;
    let next = AtomicUsize::new(0);
    let worker = || {
        let mut done = Vec::new();
        loop {
            let from = next.fetch_add(AT_ONCE, Ordering::Relaxed);
            if from >= count {
                return done;
            }
            for i in from..count.min(from + AT_ONCE) {
                done.push((i, f(i)));
            }
        }
    };
    let cores = thread::available_parallelism().map_or(1, usize::from);
    let mut all: Vec<(usize, T)> = thread::scope(|scope| {
        let workers: Vec<_> = (0..cores).map(|_| scope.spawn(worker)).collect();
        workers.into_iter().flat_map(|worker| worker.join().expect("a worker does not panic")).collect()
    });
    all.sort_unstable_by_key(|(i, _)| *i);
    all.into_iter().map(|(_, value)| value).collect()
}
