//! What an impact has parted, and what is known of when it comes back.

use dashpot_dae::{Derivatives, Guard, Output, PredictedEvent, System};

use super::{
    Mode,
    impacts::ReboundSpeed,
    judge::{Admissibility, Admissible, Judge},
};
use crate::phases::{Exit, Watched};

/// What comes back without having been farther from its level, in parts of its scale and of the root of the threshold,
/// is not left to a method: that it follows places to its tolerance says little about when so low a rebound ends.
const LOW: f64 = 0.1;
/// Shortest rebound in parts of the time of the run.
const SHORT: f64 = 4.0 * f64::EPSILON;

impl Judge<'_> {
    /// For each guard of a mode how it is reached, and how far what it watches is from it before, if that is
    /// soon. Only asked for where an impact has let something part.
    pub(super) fn predicted_returns(
        &self,
        mode: &Mode,
        system: &System,
        motion: &Derivatives,
        levels: &[f64],
    ) -> Vec<Option<(PredictedEvent, f64)>> {
        let none = || vec![None; levels.len()];
        if self.criteria.iter().all(|own| own.rebound_speed.is_none()) {
            return none();
        }
        let predicted = |(at, (guard, &level)): (usize, (&Guard, &f64))| {
            let (part, exit) = mode.of_guard[at];
            let Admissibility { threshold, rebound_speed, .. } = self.criteria[part];
            let is_place = mode.exits[part][exit].watched == Watched::Deformation;
            // What has just parted is where it parted, whatever that is rounded to.
            let here = motion.output(mode.system.outputs.at(guard.output), 0).0;
            let level = if rebound_speed.is_some() { here } else { level };
            let guard = Guard { level, ..guard.clone() };
            PredictedEvent::of(system, motion, (at, &guard), threshold).filter(|_| is_place)
        };
        mode.guards.iter().zip(levels).enumerate().map(predicted).collect()
    }

    /// Whether a part whose sides an impact has parted stays in its phase, where it is told by when they come back.
    pub(super) fn stays_after_rebound(
        &self,
        part: usize,
        exit: &Exit,
        output: Output<'_>,
        predicted: Option<(PredictedEvent, f64)>,
        time_scale: f64,
    ) -> Option<Admissible> {
        let is_place = exit.watched == Watched::Deformation;
        let rebound_speed = self.criteria[part].rebound_speed.filter(|_| is_place)?;
        match predicted {
            // Time does not tell it from none.
            Some((own, _)) if own.length * time_scale <= SHORT * self.time => Some(Admissible::No),
            Some((_, height)) if self.is_followed(part, height, output) => Some(Admissible::Yes),
            None if rebound_speed == ReboundSpeed::BelowThreshold => Some(Admissible::No),
            _ => None,
        }
    }

    /// Whether a part's sides have just parted, and come back from so near that they are followed without a method.
    pub(super) fn is_followed(&self, part: usize, height: f64, output: Output<'_>) -> bool {
        let Admissibility { threshold, rebound_speed, .. } = self.criteria[part];
        rebound_speed.is_some_and(|rebound_speed| rebound_speed != ReboundSpeed::Integrated)
            && height <= LOW * threshold.sqrt() * output.scale.abs()
    }
}
