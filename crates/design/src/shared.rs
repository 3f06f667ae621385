//! Work that threads share.

use std::thread;

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
        parts.into_iter().flat_map(|own| own.join().unwrap_or_default()).collect()
    })
}
