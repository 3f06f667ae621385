//! Whether phases hold.

use std::sync::Arc;

use dashpot_dae::{Derivatives, Output, PredictedEvent, System, Waveform, derivatives};

use super::{
    super::{bodies::Groups, transfer::State},
    Mode, PhasedNetwork,
    impacts::ReboundSpeed,
    moving,
};
use crate::phases::{Exit, Phase, PhaseLaw, Watched};

/// Phases that hold, and the unknowns of their system.
pub(super) struct Choice {
    pub(super) mode: Arc<Mode>,
    /// The mode's system, with time counted from the instant.
    pub(super) system: Arc<System>,
    pub(super) phases: Vec<Phase>,
    pub(super) unknowns: Vec<f64>,
    /// The levels of the mode's guards: where rounding or the method's error has left a quantity on
    /// the outer side of its level, that place is its level in this interval.
    pub(super) levels: Vec<f64>,
    /// The exit that is reached next, if what has just parted comes back before it can be seen.
    pub(super) predicted: Option<PredictedEvent>,
    /// How many choices were tried, with this one.
    pub(super) tried: usize,
    /// Whether others would have held, had the threshold been much smaller.
    pub(super) hangs_on_threshold: bool,
}

/// A part that does not stay in the phase that is tried.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Fault {
    /// Number of the part.
    pub(super) part: usize,
    /// Number of the phase to which it leads, where one is known.
    pub(super) towards: Option<usize>,
}

/// Whether a part stays in its phase.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Admissible {
    Yes,
    /// As far as can be told.
    Undecided,
    No,
}

/// What is found of phases that are tried.
pub(super) enum Verdict {
    /// Every part stays. Some may do so only because nothing can be told: what they watch is on the
    /// outer side of its level, by less than its error, and moves neither way.
    Holds(Box<Choice>, Vec<Fault>),
    /// Some do not.
    Fails(Vec<Fault>),
    /// There is no such system.
    Refused(String),
}

/// By what it is judged whether phases hold.
pub(super) struct Judge<'a> {
    /// The instant \[s\].
    pub(super) time: f64,
    /// Whether it is a jump within which time stands still: what moves there does so by the jump.
    pub(super) is_jump: bool,
    pub(super) state: &'a State,
    /// The phases that end.
    pub(super) before: &'a [Phase],
    /// What is at its level by the event that ended the interval, and that level.
    pub(super) on_level: &'a [(usize, Watched, f64)],
    /// Parts whose deformation has reached a level \[m\] by that event.
    pub(super) at_level: &'a [(usize, f64)],
    /// What is at its level by that event, but turns back before it is seen to leave it.
    pub(super) suppressed: &'a [(usize, Watched, f64)],
    /// By what each part is judged.
    pub(super) criteria: &'a [Admissibility],
    /// Parts by which impacts have let bodies part, and these bodies.
    pub(super) parted: &'a [(usize, [usize; 2])],
    /// A length \[m\] and a speed \[m/s\] of the network's own.
    pub(super) size: (f64, f64),
}

/// By what it is judged whether a part may stay in its phase.
#[derive(Debug, Clone, Copy)]
pub(super) struct Admissibility {
    /// What is smaller than this part of its terms cannot be told from zero.
    pub(super) threshold: f64,
    /// Whether a way inwards counts that turns back before it can be told from the level.
    pub(super) graze: bool,
    /// Whether another phase is in reach.
    pub(super) may_change: bool,
    /// Whether no impact changes its speed. Then what is at its level, by the event that ended the interval, and leaves
    /// it inwards again by the speed with which it came, is there by the method's error: that speed is none.
    pub(super) is_smooth: bool,
    /// How an impact in the part has let its sides part, if one has.
    pub(super) rebound_speed: Option<ReboundSpeed>,
}

/// Derivatives that are looked at to see which way a quantity leaves its level.
const ORDERS: usize = 6;
/// What turns back before it is so far from its level is not seen to leave it, in parts of the threshold.
const SEEN: f64 = 0.02;
/// The same where it may be seen to be a force that something else leaves as it is.
const TOLD: f64 = 1e-3;
/// Parts of a length or a speed below which places and speeds that a phase joins are the same.
const SAME: f64 = 1e-9;

impl PhasedNetwork {
    /// What is to be said of these phases.
    pub(super) fn judge(&self, phases: &[Phase], judge: &Judge<'_>) -> Verdict {
        let faults = self.held_apart(phases, judge);
        if !faults.is_empty() {
            return Verdict::Fails(faults);
        }
        let mode = match self.mode(phases) {
            Ok(mode) => mode,
            Err(errors) => return Verdict::Refused(errors.to_string()),
        };
        let unknowns = mode.transfer.unknowns(judge.state);
        let mut system = mode.system_from(judge.time);
        if judge.is_jump {
            let mut still = System::clone(&system);
            let values = system.waveforms.iter().map(|own| Waveform::constant(own.value(0.0)));
            still.waveforms = values.collect();
            system = Arc::new(still);
        }
        let motion = match derivatives(&system, &unknowns, ORDERS + 1) {
            Ok(motion) => motion,
            Err(error) => return Verdict::Refused(error.to_string()),
        };
        let faults = self.jumped_back(phases, judge, &mode, &motion);
        if !faults.is_empty() {
            return Verdict::Fails(faults);
        }
        let (mut faults, mut doubtful): (Vec<Fault>, Vec<Fault>) = (Vec::new(), Vec::new());
        let guards = || mode.of_guard.iter().map(|own| own.0).zip(mode.of_guard_exits());
        let levels = judge.levels(&mode, &motion, phases);
        let returns = judge.predicted_returns(&mode, &system, &motion, &levels);
        for (at, (part, (output, exit))) in guards().enumerate() {
            let again = judge.is_again(part, phases[part], exit);
            let fault = Fault { part, towards: Some(exit.to) };
            let output = mode.system.outputs.at(output);
            let after =
                judge.stays_after_rebound(part, exit, output, returns[at], system.time_scale);
            let in_jump = || self.stays_in_jump(part, judge, (&mode, &motion), exit);
            let stays = after
                .or_else(in_jump)
                .unwrap_or_else(|| judge.stays(part, &motion, output, exit, again));
            match stays {
                Admissible::Yes => {}
                Admissible::Undecided => doubtful.push(fault),
                Admissible::No => faults.push(fault),
            }
        }
        faults.extend(self.less_deep(phases, judge, &mode, &motion));
        if !faults.is_empty() {
            faults.dedup_by_key(|fault| fault.part);
            return Verdict::Fails(faults);
        }
        let is_followed = guards().zip(&returns).any(|((part, (output, _)), own)| {
            let output = mode.system.outputs.at(output);
            own.is_some_and(|(_, height)| judge.is_followed(part, height, output))
        });
        let next = returns.into_iter().flatten().map(|event| event.0);
        let predicted = next.min_by(|a, b| a.length.total_cmp(&b.length)).filter(|_| is_followed);
        let phases = phases.to_vec();
        let choice = Choice {
            mode,
            system,
            phases,
            unknowns,
            levels,
            predicted,
            tried: 1,
            hangs_on_threshold: false,
        };
        Verdict::Holds(Box::new(choice), doubtful)
    }

    /// Whether a rate is on the inner side of its exit's level within a jump, where the jump tells.
    fn stays_in_jump(
        &self,
        part: usize,
        judge: &Judge<'_>,
        (mode, motion): (&Mode, &Derivatives),
        exit: &Exit,
    ) -> Option<Admissible> {
        let at = self.parts[part];
        let new = mode.transfer.deformation(at, &motion.values[0], &motion.inputs[0]);
        let moved = new - judge.state.deformation[at];
        let is_seen = moved.abs() > judge.criteria[part].threshold * judge.size.0.max(new.abs());
        let tells = judge.is_jump && exit.watched == Watched::Rate && is_seen;
        let stays = if (moved > 0.0) == exit.rising { Admissible::No } else { Admissible::Yes };
        tells.then_some(stays)
    }

    /// The parts that an event leaves less deep than they were, in a phase that only goes deeper.
    fn less_deep<'a>(
        &'a self,
        phases: &'a [Phase],
        judge: &'a Judge<'_>,
        mode: &'a Mode,
        motion: &'a Derivatives,
    ) -> impl Iterator<Item = Fault> + 'a {
        let guards = mode.guards.iter().zip(&mode.of_guard);
        guards.filter_map(move |(guard, &(part, _))| {
            let at = self.parts[part];
            let towards = self.phases_of(at)?.less_deep(phases[part])?;
            let output = mode.system.outputs.at(guard.rate_of?);
            let (value, size) = motion.output(output, 0);
            let noise = judge.criteria[part].threshold * size.max(output.scale.abs());
            let Phase { memory, .. } = phases[part];
            let is_less = value < judge.state.deformation[at].max(memory) - noise;
            let is_fault = is_less && !judge.at_level.contains(&(part, memory));
            is_fault.then_some(Fault { part, towards: Some(towards) })
        })
    }

    /// The parts that would have to hold what is elsewhere, or what moves apart.
    pub(super) fn held_apart(&self, phases: &[Phase], judge: &Judge<'_>) -> Vec<Fault> {
        let (length, speed) = judge.size;
        let held: Vec<(usize, f64)> = (0..self.parts.len())
            .filter_map(|part| match self.phases_of(self.parts[part])?.law(phases[part]) {
                PhaseLaw::Held(level) => Some((part, level)),
                _ => None,
            })
            .collect();
        let mut faults: Vec<Fault> = Vec::new();
        let mut joined = Groups::new(self.apart.all.len());
        for &(part, level) in &held {
            let at = self.parts[part];
            let deformation = judge.state.deformation[at];
            let near = judge.criteria[part].threshold.max(SAME)
                * (length + level.abs()).max(deformation.abs());
            let is_elsewhere =
                (deformation - level).abs() > near && !judge.at_level.contains(&(part, level));
            if is_elsewhere {
                faults.push(Fault { part, towards: None });
            }
            let [a, b] = self.sides(at);
            joined.join(a, b);
        }
        // What an impact has parted is not held, however slowly it goes; where something massless is
        // between, one of its sides is free.
        let is_held = |part: usize| held.iter().any(|own| own.0 == part);
        for &(part, [a, b]) in judge.parted.iter().filter(|own| is_held(own.0)) {
            if joined.of(a) == joined.of(b) {
                faults.push(Fault { part, towards: None });
            }
        }
        // Slowest and fastest of the bodies that the phases make one.
        let mut span = vec![(f64::INFINITY, f64::NEG_INFINITY); self.apart.all.len()];
        for body in (0..self.apart.all.len()).filter(|&body| !self.apart.all[body].is_massless()) {
            let (own, of) = (self.velocity(judge.state, body), joined.of(body));
            span[of] = (span[of].0.min(own), span[of].1.max(own));
        }
        let (mut direct, mut through) = (Vec::new(), Vec::new());
        for &(part, _) in &held {
            let at = self.parts[part];
            let sides = self.sides(at);
            let whole = joined.of(sides[0]);
            let (slowest, fastest) = span[whole];
            let threshold = judge.criteria[part].threshold;
            let near = (threshold.max(SAME) * speed).max(threshold * self.speed);
            if fastest - slowest <= near {
                continue;
            }
            if sides.iter().any(|&side| self.apart.all[side].is_massless()) {
                through.push((whole, Fault { part, towards: None }));
                continue;
            }
            let rate = self.velocity(judge.state, sides[0]) - self.velocity(judge.state, sides[1]);
            if rate.abs() > near {
                let own = self.phases_of(at);
                let towards = own.and_then(|own| moving(own, phases[part], rate));
                direct.push((whole, Fault { part, towards }));
            }
        }
        // What has a massless side is to blame only where nothing else is.
        through.retain(|(whole, _)| direct.iter().all(|(other, _)| other != whole));
        faults.extend(direct.into_iter().chain(through).map(|(_, fault)| fault));
        faults.sort_unstable_by_key(|fault| fault.part);
        faults.dedup_by_key(|fault| fault.part);
        faults
    }
}

/// How far from its level what has terms of this size must come to be seen off it.
pub(super) fn seen(threshold: f64, size: f64) -> f64 {
    SEEN * threshold * size
}

impl Mode {
    /// The system with time counted from `time` \[s\].
    pub(super) fn system_from(&self, time: f64) -> Arc<System> {
        let moves = |own: &Waveform| {
            own.pieces().len() > 1 || !own.pieces().iter().all(|piece| piece.is_constant(0))
        };
        if time == 0.0 || !self.system.waveforms.iter().any(moves) {
            return Arc::clone(&self.system);
        }
        let mut system = System::clone(&self.system);
        let start = time / system.time_scale;
        system.waveforms = system.waveforms.iter().map(|waveform| waveform.since(start)).collect();
        Arc::new(system)
    }

    /// Each exit with the output that it watches.
    fn of_guard_exits(&self) -> impl Iterator<Item = (usize, &Exit)> {
        self.guards
            .iter()
            .zip(&self.of_guard)
            .map(|(guard, &(part, exit))| (guard.output, &self.exits[part][exit]))
    }
}

impl Judge<'_> {
    /// The levels of the guards of a mode.
    fn levels(&self, mode: &Mode, motion: &Derivatives, phases: &[Phase]) -> Vec<f64> {
        let guards = mode.of_guard.iter().zip(mode.of_guard_exits());
        let level = |(&(part, _), (output, exit)): (&(usize, usize), (usize, &Exit))| {
            let output = mode.system.outputs.at(output);
            let (value, size) = motion.output(output, 0);
            let outward = if exit.rising { 1.0 } else { -1.0 };
            let beyond = (outward * (value - exit.level)).max(0.0);
            let threshold = self.criteria[part].threshold;
            let further = if self.is_again(part, phases[part], exit) {
                beyond + threshold * (size + exit.level.abs())
            } else if self.is_suppressed(part, phases[part], exit) {
                seen(threshold, size.max(output.scale.abs()) + exit.level.abs())
            } else {
                0.0
            };
            exit.level + outward * (beyond + further)
        };
        guards.map(level).collect()
    }

    /// Whether an exit was reached by a force or a rate at which a part stays in its phase all the same.
    fn is_suppressed(&self, part: usize, phase: Phase, exit: &Exit) -> bool {
        phase.index == self.before[part].index
            && self.suppressed.contains(&(part, exit.watched, exit.level))
    }

    /// Whether an exit was reached at which a part stays in its phase all the same.
    fn is_again(&self, part: usize, phase: Phase, exit: &Exit) -> bool {
        self.criteria[part].is_smooth
            && phase.index == self.before[part].index
            && exit.watched == Watched::Deformation
            && self.on_level.contains(&(part, exit.watched, exit.level))
    }

    /// Whether a quantity is on the inner side of its exit's level, or on it and not on its way out.
    fn stays(
        &self,
        part: usize,
        motion: &Derivatives,
        output: Output<'_>,
        exit: &Exit,
        again: bool,
    ) -> Admissible {
        let told = |stays: bool| if stays { Admissible::Yes } else { Admissible::No };
        let Admissibility { threshold, graze, may_change, .. } = self.criteria[part];
        let inward = if exit.rising { -1.0 } else { 1.0 };
        let (value, size) = motion.output(output, 0);
        let gap = inward * (value - exit.level);
        let noise = threshold * (size.max(output.scale.abs()) + exit.level.abs());
        // The method's error may leave it a little off the level that it has reached; what is farther
        // off has jumped there.
        let fired = self.on_level.contains(&(part, exit.watched, exit.level));
        let is_reached = fired && gap.abs() <= threshold.sqrt() * (size + exit.level.abs());
        if gap.abs() > noise && !is_reached {
            return told(gap > 0.0);
        }
        // A force that is small when something else happens pushes on: it may take its time to end.
        let pushes_on = exit.watched == Watched::Force && !fired && gap > TOLD * noise;
        if gap > 0.0 && (!may_change || pushes_on) {
            // It has not been reached yet, however near it is.
            return Admissible::Yes;
        }
        let is_still = exit.watched == Watched::Deformation
            && self.on_level.contains(&(part, Watched::Rate, 0.0));
        let derivative = |order: usize| {
            let (value, own) = motion.output(output, order);
            // The state is rounded, and its rounding grows from one derivative to the next.
            let before = motion.output(output, order - 1).1;
            let size = own.max((before * motion.output(output, order + 1).1).sqrt());
            // It has come to rest, unless a load has jumped at that instant.
            let rests = order == 1 && is_still && value.abs() <= threshold.sqrt() * own;
            let is_none = rests
                || value.abs() <= threshold * size
                || (order == 1 && again && inward * value > 0.0);
            if is_none { 0.0 } else { inward * value }
        };
        let Some(order) = (1..=ORDERS).find(|&order| derivative(order) != 0.0) else {
            return if gap < 0.0 { Admissible::Undecided } else { Admissible::Yes };
        };
        let first = derivative(order);
        if first < 0.0 || graze || order > 1 || derivative(2) >= 0.0 {
            return told(
                first > 0.0 || self.suppressed.contains(&(part, exit.watched, exit.level)),
            );
        }
        told(first * first > 2.0 * seen(threshold, size + exit.level.abs()) * -derivative(2))
    }
}
