//! Work that is shared among threads, in an order that does not show in the results.

use std::{
    ops::ControlFlow,
    sync::{
        Mutex, PoisonError,
        atomic::{AtomicBool, AtomicUsize, Ordering},
    },
    time::Duration,
};

/// Points that a thread takes at once: a group begins at a fixed number of the whole grid.
pub(super) const GROUP: usize = 64;
/// How often the watcher is told how far the work has come.
const PULSE: Duration = Duration::from_millis(20);

/// Tells how many points of how many are done; `Break` ends the sweep.
pub type Watch<'w> = dyn FnMut(usize, usize) -> ControlFlow<()> + 'w;

/// Does something for each group of so many of some `rows`, by so many threads, each with a `tool` of its own. False
/// where the watcher broke it off.
pub(crate) fn share<R: Send, T>(
    rows: &mut [R],
    (group, threads): (usize, usize),
    tool: &(dyn Fn() -> T + Sync),
    work: &(dyn Fn(&mut T, &mut [R]) + Sync),
    watch: &mut Watch<'_>,
) -> bool {
    let count = rows.len();
    let threads = threads.clamp(1, count.div_ceil(group).max(1));
    if threads == 1 {
        return alone(rows, group, &mut tool(), work, watch);
    }
    let queue = Mutex::new(rows.chunks_mut(group));
    let (done, running) = (AtomicUsize::new(0), AtomicUsize::new(threads));
    let is_over = AtomicBool::new(false);
    let watcher = std::thread::current();
    let labour = || {
        let mut own = tool();
        while !is_over.load(Ordering::Relaxed) {
            let chunk = queue.lock().unwrap_or_else(PoisonError::into_inner).next();
            let Some(chunk) = chunk else { break };
            let count = chunk.len();
            work(&mut own, chunk);
            done.fetch_add(count, Ordering::Relaxed);
        }
        if running.fetch_sub(1, Ordering::Release) == 1 {
            watcher.unpark();
        }
    };
    let labour_of = &labour;
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(labour_of);
        }
        while running.load(Ordering::Acquire) > 0 {
            std::thread::park_timeout(PULSE);
            if watch(done.load(Ordering::Relaxed), count).is_break() {
                is_over.store(true, Ordering::Relaxed);
            }
        }
    });
    !is_over.load(Ordering::Relaxed)
}

/// The same by the thread that asks for it.
fn alone<R, T>(
    rows: &mut [R],
    group: usize,
    tool: &mut T,
    work: &(dyn Fn(&mut T, &mut [R]) + Sync),
    watch: &mut Watch<'_>,
) -> bool {
    let (mut done, count) = (0, rows.len());
    for chunk in rows.chunks_mut(group) {
        done += chunk.len();
        work(tool, chunk);
        if watch(done, count).is_break() {
            return false;
        }
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_row_is_worked_on_once_by_any_number_of_threads() {
        for threads in [0, 1, 2, 7, 1000] {
            let mut rows: Vec<usize> = (0..1000).collect();
            let work =
                |one: &mut usize, rows: &mut [usize]| rows.iter_mut().for_each(|row| *row += *one);
            let whole = share(&mut rows, (GROUP, threads), &|| 1, &work, &mut |_, _| {
                ControlFlow::Continue(())
            });
            assert!(whole && rows.iter().enumerate().all(|(at, own)| *own == at + 1));
        }
    }

    #[test]
    fn the_watcher_may_break_it_off() {
        let mut rows = vec![0; 100_000];
        let work = |(): &mut (), rows: &mut [i32]| {
            rows.fill(1);
            std::thread::sleep(Duration::from_millis(3));
        };
        let whole = share(&mut rows, (GROUP, 2), &|| (), &work, &mut |_, _| ControlFlow::Break(()));
        assert!(!whole && rows.contains(&0));
    }
}
