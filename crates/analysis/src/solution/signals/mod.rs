//! The signals of a solution that are kept at hand, one for all outputs that are the same sum of unknowns and
//! inputs: the deformations of parts side by side, and their forces where they are equal.

use std::{
    borrow::Cow,
    cell::{Cell, OnceCell, RefCell},
    collections::HashMap,
    hash::{DefaultHasher, Hash, Hasher},
    sync::Arc,
};

use dashpot_dae::{Output, Outputs, Panel, Signal};

use super::Solution;

/// Memory \[B\] of signals at hand beyond which a look at one does not keep it, and all are dropped between
/// two measures.
const MOST_BYTES: usize = 32 << 20;

/// Signals by the number of their output.
#[derive(Debug)]
pub(super) struct Signals {
    cells: Vec<OnceCell<Arc<Signal>>>,
    /// Slopes of outputs, and rates of them that are told better, where any was asked for.
    derived: [OnceCell<Vec<OnceCell<Signal>>>; 2],
    /// The numbers of those at hand.
    filled: RefCell<Vec<usize>>,
    /// Memory that those at hand take \[B\].
    bytes: Cell<usize>,
    /// How many panels have been made.
    panels: Cell<u64>,
    /// Memory \[B\] that may be at hand.
    most: usize,
}

impl Signals {
    /// Room for those of so many outputs.
    pub(super) fn of(outputs: usize) -> Self {
        Self {
            cells: (0..outputs).map(|_| OnceCell::new()).collect(),
            derived: Default::default(),
            filled: RefCell::default(),
            bytes: Cell::new(0),
            panels: Cell::new(0),
            most: MOST_BYTES,
        }
    }

    fn count(&self, signal: &Signal) {
        self.panels.set(self.panels.get() + signal.panels.len() as u64);
    }
}

/// Memory that a signal takes \[B\].
fn bytes(signal: &Signal) -> usize {
    let coefficients: usize = signal.panels.iter().map(|panel| panel.coefficients.len()).sum();
    size_of::<Panel>() * signal.panels.len() + size_of::<f64>() * coefficients
}

impl Solution<'_> {
    /// How many panels the signals have had that were asked for.
    pub(crate) fn panels(&self) -> u64 {
        self.known.signals.panels.get()
    }

    /// An output as a function of time; one that was not [kept](Self::keeps) is not a number throughout.
    ///
    /// # Panics
    ///
    /// When the assembly has no such output.
    pub fn signal(&self, output: usize) -> &Signal {
        let signals = &self.known.signals;
        signals.cells[output].get_or_init(|| {
            let signal = self.same_as(output).unwrap_or_else(|| {
                let signal = Arc::new(self.found(output));
                signals.bytes.set(signals.bytes.get() + bytes(&signal));
                signals.count(&signal);
                signal
            });
            signals.filled.borrow_mut().push(output);
            signal
        })
    }

    /// The same for one look: where signals take much memory already, this one is not kept.
    pub(crate) fn glance(&self, output: usize) -> Cow<'_, Signal> {
        let signals = &self.known.signals;
        if signals.bytes.get() <= signals.most || signals.cells[output].get().is_some() {
            return Cow::Borrowed(self.signal(output));
        }
        let signal = self.found(output);
        signals.count(&signal);
        Cow::Owned(signal)
    }

    /// The slopes of an output, jumps left out.
    pub(super) fn slopes(&self, output: usize) -> Cow<'_, Signal> {
        self.derived(0, output, || self.glance(output).derivative())
    }

    /// The rate of an output as the trajectory tells it.
    pub(super) fn told_rate(&self, output: usize) -> Cow<'_, Signal> {
        self.derived(1, output, || self.trajectory.dense.rate(&self.assembly.system, output))
    }

    fn derived(
        &self,
        which: usize,
        output: usize,
        make: impl FnOnce() -> Signal,
    ) -> Cow<'_, Signal> {
        let signals = &self.known.signals;
        let cells = || signals.cells.iter().map(|_| OnceCell::new()).collect();
        let cell = &signals.derived[which].get_or_init(cells)[output];
        if signals.bytes.get() > signals.most && cell.get().is_none() {
            return Cow::Owned(make());
        }
        Cow::Borrowed(cell.get_or_init(|| {
            let signal = make();
            signals.bytes.set(signals.bytes.get() + bytes(&signal));
            signal
        }))
    }

    /// The signal of an output that is the same sum, where there is one at hand.
    fn same_as(&self, output: usize) -> Option<Arc<Signal>> {
        // Each interval of a run that switches has equations of its own.
        if self.assembly.switching.is_some() || !self.keeps(output) {
            return None;
        }
        let first = self.known.twins.first(&self.assembly.system.outputs, output);
        self.known.signals.cells[first].get().filter(|_| first != output).map(Arc::clone)
    }

    fn found(&self, output: usize) -> Signal {
        if !self.keeps(output) {
            self.missing.borrow_mut().insert(output);
        }
        self.made(output)
    }

    /// Drops the signals at hand where they take much memory; they are made anew where they are asked for.
    pub(crate) fn make_room(&mut self) {
        let signals = &mut self.known.signals;
        if signals.bytes.get() > signals.most {
            for at in signals.filled.get_mut().drain(..) {
                signals.cells[at].take();
            }
            signals.derived = Default::default();
            signals.bytes.set(0);
        }
    }
}

/// Outputs that have been asked for, by the hashes of their sums.
#[derive(Debug, Default)]
pub(super) struct Twins {
    asked: RefCell<HashMap<u64, Vec<usize>>>,
}

impl Twins {
    /// The output that stands for the one of this number: the first one with the same sum.
    pub(super) fn first(&self, outputs: &Outputs, at: usize) -> usize {
        let own = outputs.at(at);
        let mut asked = self.asked.borrow_mut();
        let alike = asked.entry(hash(&own)).or_default();
        let found = alike.iter().copied().find(|&other| is_same(&outputs.at(other), &own));
        found.unwrap_or_else(|| {
            alike.push(at);
            at
        })
    }
}

fn hash(output: &Output<'_>) -> u64 {
    let mut hasher = DefaultHasher::new();
    output.scale.to_bits().hash(&mut hasher);
    for form in [output.unknowns, output.inputs] {
        for (variable, coefficient) in form.terms() {
            (variable, coefficient.to_bits()).hash(&mut hasher);
        }
        form.terms().len().hash(&mut hasher);
    }
    hasher.finish()
}

fn is_same(one: &Output<'_>, other: &Output<'_>) -> bool {
    one.scale.to_bits() == other.scale.to_bits()
        && one.unknowns == other.unknowns
        && one.inputs == other.inputs
}

#[cfg(test)]
mod tests;
