//! Ctrl-C: it ends the process with a word on what is kept, and takes along what is not whole. Work that keeps what it
//! has ends by itself at the first one; the second one ends the process.

use std::{
    fs,
    path::{Path, PathBuf},
    process,
    sync::{
        Arc, LazyLock, Mutex, PoisonError,
        atomic::{AtomicBool, Ordering},
    },
    thread,
    time::Duration,
};

use signal_hook::{consts::SIGINT, flag};

use crate::{host, terminal::message};

/// What shells say of a process that an interrupt ended.
const INTERRUPTED: i32 = 130;
/// How often it is looked whether there was one.
const PULSE: Duration = Duration::from_millis(50);

static IS_ASKED: LazyLock<Arc<AtomicBool>> = LazyLock::new(Arc::default);
/// Whether work ends by itself.
static IS_NOTICED: AtomicBool = AtomicBool::new(false);
/// Files that are not whole, and folders that are there for them: those inside come last.
static UNFINISHED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// From now on an interrupt takes along what is not whole. Where that cannot be, it ends the process as before.
pub(crate) fn watch_interrupts() {
    // In this order: the one that ends the process looks at the flag before it is set.
    let ends = flag::register_conditional_shutdown(SIGINT, INTERRUPTED, Arc::clone(&IS_ASKED));
    if ends.is_err() || flag::register(SIGINT, Arc::clone(&IS_ASKED)).is_err() {
        return;
    }
    thread::spawn(|| {
        while !is_interrupted() || IS_NOTICED.load(Ordering::Relaxed) {
            thread::sleep(PULSE);
        }
        for path in unfinished().drain(..).rev() {
            // What is whole by now, and a folder with more in it, stay.
            let _ = fs::remove_file(&path).or_else(|_| fs::remove_dir(&path));
        }
        message("interrupted: nothing of this call is kept");
        process::exit(INTERRUPTED);
    });
}

/// From now on work ends by itself at an interrupt. A program that calls has its own way.
pub(crate) fn notice_interrupts() {
    IS_NOTICED.store(!host::is_called(), Ordering::Relaxed);
}

pub(crate) fn is_interrupted() -> bool {
    IS_ASKED.load(Ordering::Relaxed)
}

/// Says of a path that it is not whole yet.
pub(crate) fn begin(path: &Path) {
    unfinished().push(path.to_owned());
}

/// Says of a path that it is whole, or gone.
pub(crate) fn end(path: &Path) {
    unfinished().retain(|own| own != path);
}

fn unfinished() -> std::sync::MutexGuard<'static, Vec<PathBuf>> {
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}
