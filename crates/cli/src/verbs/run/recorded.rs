//! Signals of runs as a recorder sees them: on the clock of a record, at rest before the start.

use dashpot_analysis::{ContactReport, RunReport, Signals, Solution};
use dashpot_dae::Signal;
use dashpot_network::{Assembly, NodeOutputs};
use dashpot_plot::Of;

use super::{beside::Output, series::first_touch};

/// A signal of a run as it is recorded.
pub(in crate::verbs) struct Recorded {
    pub(in crate::verbs) signal: Signal,
    /// What is there before the start.
    rest: f64,
    /// When in the run the time of the record is 0 \[s\].
    pub(in crate::verbs) zero: f64,
    pub(in crate::verbs) end: f64,
}

impl Recorded {
    /// That of an output; `None` where the run does not keep it.
    pub(in crate::verbs) fn of(run: &RunReport, output: &Output) -> Option<Self> {
        Self::read(&run.solution(), &run.contacts, output)
    }

    /// The same of a solution alone.
    pub(in crate::verbs) fn of_signals(run: &Signals, output: &Output) -> Option<Self> {
        Self::read(&run.solution(), &run.contacts(), output)
    }

    fn read(solution: &Solution<'_>, contacts: &[ContactReport], output: &Output) -> Option<Self> {
        let (assembly, end) = (solution.assembly(), solution.end());
        let (place, sign) = output.place(assembly)?;
        if !solution.trajectory().keeps(&assembly.system, place) {
            return None;
        }
        let signal = solution.signal(place).scaled(sign);
        let rest = if is_untouched(assembly, output) { 0.0 } else { signal.value(0.0) };
        let zero = first_touch(contacts, end).unwrap_or(0.0);
        Some(Self { signal, rest, zero, end })
    }

    /// Its value at a time of the record \[s\].
    pub(in crate::verbs) fn value(&self, time: f64) -> f64 {
        let time = time + self.zero;
        if time < 0.0 { self.rest } else { self.signal.value(time.min(self.end)) }
    }
}

/// Whether nothing acts there before the start: where a mass that flies has yet to touch.
fn is_untouched(assembly: &Assembly, output: &Output) -> bool {
    match output.of {
        Of::Force => assembly.connection(output.name()).is_some_and(|own| {
            own.between.iter().any(|node| assembly.nodes[node.index()].is_impactor())
        }),
        Of::Acceleration => assembly.node(output.name()).is_some_and(NodeOutputs::is_impactor),
        _ => false,
    }
}
