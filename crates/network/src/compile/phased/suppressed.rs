//! Suppressed events: exits that are reached only by a method's error.

use dashpot_dae::derivatives;

use super::{super::transfer::State, PhasedNetwork, judge::seen};
use crate::phases::{Phase, Watched};

impl PhasedNetwork {
    /// Those of the exits that were reached at which what they watch is not seen to leave its level.
    ///
    /// A force that decays to nothing never releases, though the method's error may carry it across its
    /// level and back; the same holds for a rate. Whether a place is left is a matter of impacts, and where
    /// laws are not linear the first derivatives tell too little.
    pub(super) fn suppressed(
        &self,
        state: &State,
        time: f64,
        phases: &[Phase],
        fired: &[(usize, usize)],
        threshold: f64,
    ) -> Vec<(usize, usize)> {
        let Ok(mode) = self.mode(phases) else { return Vec::new() };
        let exit_of = |&(part, number): &(usize, usize)| mode.exits[part].get(number);
        let is_place = |own: &(usize, usize)| {
            exit_of(own).is_none_or(|own| own.watched == Watched::Deformation)
        };
        if fired.iter().all(is_place) || !mode.system.is_linear() {
            return Vec::new();
        }
        let unknowns = mode.transfer.unknowns(state);
        let Ok(motion) = derivatives(&mode.system_from(time), &unknowns, 2) else {
            return Vec::new();
        };
        let turns_back = |own: &(usize, usize)| {
            let guard = mode.of_guard.iter().position(|other| other == own);
            let Some((guard, exit)) = guard.zip(exit_of(own)) else { return false };
            let output = mode.system.outputs.at(mode.guards[guard].output);
            let inward = if exit.rising { -1.0 } else { 1.0 };
            let (value, size) = motion.output(output, 0);
            let [rate, bend] = [1, 2].map(|order| inward * motion.output(output, order).0);
            let farthest = inward * (value - exit.level)
                - if rate < 0.0 { rate * rate / (2.0 * bend.max(0.0)) } else { 0.0 };
            // What rests on the level, or goes on from it at no rate, is not decided here.
            let is_near =
                farthest >= -seen(threshold, size.max(output.scale.abs()) + exit.level.abs());
            is_near && (rate > 0.0 || bend > 0.0)
        };
        fired.iter().copied().filter(|own| !is_place(own) && turns_back(own)).collect()
    }
}
