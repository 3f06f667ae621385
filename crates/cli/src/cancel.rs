//! Ctrl-C: the first one asks long work to end with what it has, the second one ends the process.

use std::sync::{
    Arc, LazyLock,
    atomic::{AtomicBool, Ordering},
};

use signal_hook::{consts::SIGINT, flag};

use crate::host;

/// What shells say of a process that an interrupt ended.
const INTERRUPTED: i32 = 130;

static IS_ASKED: LazyLock<Arc<AtomicBool>> = LazyLock::new(Arc::default);

/// From now on an interrupt is noticed in place of ending the process. Where that cannot be, it ends it as before. A
/// program that calls has its own way.
pub(crate) fn notice_interrupts() {
    if host::is_called() {
        return;
    }
    // In this order: the one that ends the process looks at the flag before it is set.
    let ends = flag::register_conditional_shutdown(SIGINT, INTERRUPTED, Arc::clone(&IS_ASKED));
    if ends.is_ok() {
        let _ = flag::register(SIGINT, Arc::clone(&IS_ASKED));
    }
}

/// Whether there was one.
pub(crate) fn is_interrupted() -> bool {
    IS_ASKED.load(Ordering::Relaxed)
}
