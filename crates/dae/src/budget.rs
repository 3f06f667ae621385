//! How much work a run may be.

use std::sync::{
    Arc,
    atomic::{AtomicBool, AtomicU64, Ordering::Relaxed},
};

/// What a step, a panel or a term costs besides what it costs for each unknown.
const OVERHEAD: u64 = 16;
/// Unknowns beyond which a step counts no more: a large network is known to take long.
const MOST_UNKNOWNS: usize = 1000;
/// Entries of a row that a factorisation meets at most: matrices of more unknowns are sparse.
const DENSE: usize = 30;
/// What it costs to read the signals of a step.
const READ: u64 = 200;
/// What a panel costs that follows a driving function within a step.
const PANEL: u64 = 500;
/// What it costs to look for a guard's level in a step, and in a panel, which has a higher degree.
const WATCHED_STEP: u64 = 16;
const WATCHED_PANEL: u64 = 200;
/// What a choice of phases costs that is tried, with the equations that follow from it.
const CHOICE: u64 = 4000;

/// Work that runs may be, and that they have been so far: counted, never timed, so that a run that ends
/// by it repeats to the bit.
///
/// A unit is what one unknown costs in one step, 20 to 60 ns. A step costs 16 units and one for each
/// unknown, up to 1000, and so do a rejected one and a panel of `exact` for its modes; an accepted one 200 more, as it
/// is read; a linear system about as much as a step, a factorisation more for each entry; modes cost twice the cube of
/// their number; a panel that follows a driving function within a step 500; each guard 16 in a step and 200 in a
/// panel; each choice of phases that is tried 4000. Copies share one account.
#[derive(Debug, Clone, Default)]
pub struct Budget {
    account: Option<Arc<Account>>,
}

/// Work of steps besides themselves.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Besides {
    pub(crate) rejected: usize,
    pub(crate) factorizations: usize,
    /// Linear systems solved.
    pub(crate) solutions: usize,
}

#[derive(Debug)]
struct Account {
    limit: u64,
    done: AtomicU64,
    is_over: AtomicBool,
    /// What all of it is a part of.
    whole: Budget,
}

impl Budget {
    /// So many units.
    pub fn of(limit: u64) -> Self {
        Self::default().part(limit)
    }

    /// A part of it: its work counts for the whole, too, and it ends where that does.
    #[must_use]
    pub fn part(&self, limit: u64) -> Self {
        let whole = self.clone();
        let account = Account { limit, done: 0.into(), is_over: false.into(), whole };
        Self { account: Some(Arc::new(account)) }
    }

    /// The work so far; 0 where nothing is counted.
    pub fn done(&self) -> u64 {
        self.account.as_ref().map_or(0, |account| account.done.load(Relaxed))
    }

    /// Whether no work is left.
    pub fn is_spent(&self) -> bool {
        self.charge(0)
    }

    /// Counts work and returns whether none is left.
    pub fn charge(&self, units: u64) -> bool {
        self.account.as_ref().is_some_and(|account| {
            if account.is_over() {
                return false;
            }
            // What one part of it asks for beyond the limit counts as that, so that no sum overflows.
            let units = units.min(account.limit.saturating_add(1));
            let done = account.done.fetch_add(units, Relaxed).saturating_add(units);
            account.whole.charge(units) || done > account.limit
        })
    }

    /// Ends the account: the run is over, and to look at its solution counts no more.
    pub fn close(&self) {
        if let Some(account) = &self.account {
            account.is_over.store(true, Relaxed);
        }
    }

    /// The work of a step of so many unknowns.
    pub fn of_step(unknowns: usize) -> u64 {
        OVERHEAD + unknowns.min(MOST_UNKNOWNS) as u64
    }

    /// Counts an accepted step, which is to be read.
    pub(crate) fn charge_accepted(&self, unknowns: usize) -> bool {
        self.charge(Self::of_step(unknowns) + READ)
    }

    /// Counts a step of so many unknowns, or a panel of so many modes.
    pub(crate) fn charge_step(&self, unknowns: usize) -> bool {
        self.charge(Self::of_step(unknowns))
    }

    /// Counts what steps of so many unknowns took besides themselves.
    pub(crate) fn charge_besides(&self, work: Besides, unknowns: usize) {
        let size = unknowns.min(MOST_UNKNOWNS);
        let solution = Self::of_step(unknowns);
        let factorization = OVERHEAD + (size * (4 + size.min(DENSE)) / 4) as u64;
        let rejected = work.rejected as u64 * solution;
        let solved = work.solutions as u64 * solution;
        self.charge(rejected + solved + work.factorizations as u64 * factorization);
    }

    /// Counts the decomposition of a dense matrix of this size.
    pub(crate) fn charge_decomposition(&self, size: usize) -> bool {
        let size = size as u64;
        self.charge(OVERHEAD + 2 * size * size * size)
    }

    /// Counts panels that follow driving functions within a step.
    pub(crate) fn charge_panels(&self, panels: usize) -> bool {
        self.charge((panels as u64).saturating_mul(PANEL))
    }

    /// Counts so many guards in a step.
    pub(crate) fn charge_watched_step(&self, guards: usize) -> bool {
        self.charge(WATCHED_STEP * guards as u64)
    }

    /// Counts so many panels, each for its guard.
    pub(crate) fn charge_watched_panels(&self, panels: usize) -> bool {
        self.charge(WATCHED_PANEL * panels as u64)
    }

    /// Counts so many choices of phases.
    pub(crate) fn charge_choices(&self, tried: usize) -> bool {
        self.charge(CHOICE * tried as u64)
    }
}

impl Account {
    fn is_over(&self) -> bool {
        self.is_over.load(Relaxed)
            || self.whole.account.as_ref().is_some_and(|account| account.is_over())
    }
}

/// Two are equal that allow as much.
impl PartialEq for Budget {
    fn eq(&self, other: &Self) -> bool {
        let limit = |own: &Self| own.account.as_ref().map(|account| account.limit);
        limit(self) == limit(other)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn part_counts_for_the_whole_and_ends_with_it() {
        let whole = Budget::of(100);
        let part = whole.part(30);
        assert!(!part.charge(30) && part.charge(1));
        assert!(part.is_spent() && !whole.is_spent());
        let other = whole.part(1000);
        assert!(!other.charge(69) && other.charge(1));
        assert!(whole.is_spent());
        assert_eq!((part.done(), other.done(), whole.done()), (31, 70, 101));
    }

    #[test]
    fn without_a_limit_nothing_is_counted() {
        let budget = Budget::default();
        assert!(!budget.charge(u64::MAX) && !budget.is_spent());
        assert_eq!(budget.done(), 0);
    }
}
