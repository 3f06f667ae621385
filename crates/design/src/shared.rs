//! Work that threads share, and what a part of a sample stays within.

use std::{panic, thread};

/// Does the same to all of these by so many threads, in their order.
pub(crate) fn shared<T: Sync, U: Send>(
    threads: usize,
    all: &[T],
    one: &(dyn Fn(&T) -> U + Sync),
) -> Vec<U> {
    let each = all.len().div_ceil(threads.max(1)).max(1);
    if each >= all.len() {
        return all.iter().map(one).collect();
    }
    thread::scope(|scope| {
        let work = |part| scope.spawn(move || <[T]>::iter(part).map(one).collect::<Vec<_>>());
        let parts: Vec<_> = all.chunks(each).map(work).collect();
        // What is missing would stand as if it had never been asked for.
        let joined = |own: thread::ScopedJoinHandle<'_, Vec<U>>| {
            own.join().unwrap_or_else(|fault| panic::resume_unwind(fault))
        };
        parts.into_iter().flat_map(joined).collect()
    })
}

/// What this part of a sample stays within: of what its designs exceed, below zero where they keep everything.
pub(crate) fn exceeded(mut all: Vec<f64>, share: f64) -> f64 {
    all.sort_by(f64::total_cmp);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a position in the sample"
    )]
    // A product that rounding has left above a whole number is that number.
    let at = ((share * all.len() as f64 * (1.0 - 1e-12)).ceil() as usize).saturating_sub(1);
    all.get(at).copied().unwrap_or(f64::NAN)
}
