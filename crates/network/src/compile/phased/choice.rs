//! Which phases hold after an instant.

use std::sync::Arc;

use dashpot_dae::{Derivatives, Output, SolveError, Switch, System, derivatives};

use super::{
    super::{
        bodies::{Bodies, Role},
        carry::State,
    },
    Mode, PhasedNetwork,
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
    /// the outer side of its level, that place is its level in this leg.
    pub(super) levels: Vec<f64>,
}

/// Derivatives that are looked at to see which way a quantity leaves its level.
const ORDERS: usize = 6;
/// By how much more than its scale rounding is thought to have grown, one attempt after the other.
const COARSER: [f64; 3] = [1.0, 64.0, 4096.0];
/// What turns back before it is so far from its level is not seen to leave it, in parts of the doubt.
const SEEN: f64 = 0.02;
/// Most combinations of phases that are tried at one instant.
const MOST_TRIED: usize = 4096;

impl PhasedNetwork {
    /// The phases that hold after `time`, at which the exits `fired` were reached in `phases`.
    ///
    /// Impacts come first. Of all combinations of phases in reach, that with the fewest changes from
    /// the natural one is taken in which every part stays where it is, or begins to move away from
    /// its exits: judged by the first derivative of what each exit watches that is not zero.
    pub(super) fn choose(
        &self,
        state: &mut State,
        time: f64,
        phases: &[Phase],
        fired: &[(usize, usize)],
        doubt: f64,
    ) -> Result<(Choice, Vec<Switch>), SolveError> {
        let touching = self.touching(state, phases, fired, doubt);
        let options: Vec<Vec<Phase>> = (0..self.parts.len())
            .map(|part| self.options(part, state, phases[part], fired, touching[part]))
            .collect();
        let reached: Vec<(usize, Exit)> = fired
            .iter()
            .filter_map(|&(part, exit)| {
                let own = self.phases_of(self.parts[part])?;
                Some((part, *own.exits(phases[part]).get(exit)?))
            })
            .collect();
        let on_level: Vec<(usize, Watched)> =
            reached.iter().map(|(part, exit)| (*part, exit.watched)).collect();
        let at_level: Vec<(usize, f64)> = reached
            .iter()
            .filter(|(_, exit)| exit.watched == Watched::Deformation)
            .map(|(part, exit)| (*part, exit.level))
            .collect();
        let mut refusal = None;
        let before = state.clone();
        // What would part by less than can be seen rests; only if nothing else holds may it part.
        // Rounding may have grown beyond its scale: then the next coarser judgement may tell.
        let ways = [(true, false), (false, false), (true, true), (false, true)];
        let attempts = COARSER.iter().flat_map(|factor| ways.map(|way| (factor * doubt, way)));
        for (doubt, (rebound, graze)) in attempts {
            state.clone_from(&before);
            let impacts = self.impacts(state, phases, &touching, doubt, rebound);
            let judge =
                Judge { time, state, doubt, on_level: &on_level, at_level: &at_level, graze };
            for choice in combinations(&options).take(MOST_TRIED) {
                let tried: Vec<Phase> =
                    choice.iter().zip(&options).map(|(&at, options)| options[at]).collect();
                match self.admit(&tried, &judge) {
                    Ok(Some(choice)) => {
                        let switches = self.switches(time, phases, &choice.phases, &impacts);
                        return Ok((choice, switches));
                    }
                    Ok(None) => {}
                    Err(reason) => refusal = refusal.or(Some(reason)),
                }
            }
        }
        let names: Vec<String> = (0..self.parts.len())
            .filter(|&part| options[part].len() > 1)
            .map(|part| format!("`{}`", self.expansion.primitives[self.parts[part]].name))
            .collect();
        let names =
            if names.is_empty() { "the parts that switch".to_owned() } else { names.join(", ") };
        let why = refusal.map_or(String::new(), |reason| format!("; {reason}"));
        let reason = format!("there are no phases that {names} could go on in{why}");
        Err(SolveError::Switching { time, reason })
    }

    /// The phases that a part may be in after the instant, the natural one first.
    fn options(
        &self,
        part: usize,
        state: &State,
        phase: Phase,
        fired: &[(usize, usize)],
        touching: bool,
    ) -> Vec<Phase> {
        let at = self.parts[part];
        let Some(own) = self.phases_of(at) else { return vec![phase] };
        let deformation = state.deformation[at];
        let next = |from: Phase, exit: &Exit| Phase {
            index: exit.to,
            memory: if exit.remembers { deformation } else { from.memory },
        };
        let mut options = Vec::new();
        let mut add = |phase: Phase| {
            let is_new = options.iter().all(|own: &Phase| own.index != phase.index);
            if is_new {
                options.push(phase);
            }
        };
        let exits = own.exits(phase);
        for (number, exit) in exits.iter().enumerate() {
            if fired.contains(&(part, number)) {
                add(next(phase, exit));
            }
        }
        add(phase);
        // A phase that was left may lead on at once, and one that was not may end with the others.
        let in_reach = |exit: &Exit| exit.watched != Watched::Deformation || touching;
        let mut at = 0;
        let mut reached: Vec<Phase> =
            exits.iter().filter(|exit| in_reach(exit)).map(|exit| next(phase, exit)).collect();
        while at < reached.len() && at < own.names().len() {
            let from = reached[at];
            add(from);
            for exit in own.exits(from) {
                let follows = next(from, &exit);
                let level = (deformation - exit.level).abs() <= 1e-9 * exit.level.abs();
                if (exit.watched != Watched::Deformation || level)
                    && reached.iter().all(|own| own.index != follows.index)
                {
                    reached.push(follows);
                }
            }
            at += 1;
        }
        options
    }

    /// The mode of these phases in this state, if no part is on its way out.
    fn admit(&self, phases: &[Phase], judge: &Judge<'_>) -> Result<Option<Choice>, String> {
        let Judge { state, doubt, .. } = *judge;
        for (part, (&at, &phase)) in self.parts.iter().zip(phases).enumerate() {
            let law = self.phases_of(at).map(|own| own.law(phase));
            if let Some(PhaseLaw::Held(level)) = law {
                if judge.at_level.contains(&(part, level)) {
                    continue;
                }
                let deformation = state.deformation[at];
                let size = self.own_length(state);
                let near = doubt.max(1e-9) * (size + level.abs()).max(deformation.abs());
                if (deformation - level).abs() > near {
                    return Ok(None);
                }
            }
        }
        let mode = self.mode(phases).map_err(|errors| errors.to_string())?;
        if !self.velocities_agree(&mode.bodies, state, doubt) {
            return Ok(None);
        }
        let unknowns = mode.carry.unknowns(state);
        let system = mode.system_from(judge.time);
        let motion =
            derivatives(&system, &unknowns, ORDERS + 1).map_err(|error| error.to_string())?;
        let holds =
            mode.of_guard.iter().zip(mode.of_guard_exits()).all(|(&(part, _), (output, exit))| {
                judge.stays(part, &motion, &mode.system.outputs[output], exit)
            });
        if !holds {
            return Ok(None);
        }
        let levels = mode.of_guard_exits().map(|(output, exit)| {
            let (value, _) = motion.output(&mode.system.outputs[output], 0);
            if exit.rising { value.max(exit.level) } else { value.min(exit.level) }
        });
        let levels = levels.collect();
        Ok(Some(Choice { mode, system, phases: phases.to_vec(), unknowns, levels }))
    }

    /// Whether masses that the phases join move together.
    fn velocities_agree(&self, bodies: &Bodies, state: &State, doubt: f64) -> bool {
        bodies.all.iter().all(|body| {
            let ruled = |&joint: &usize| {
                self.network
                    .nodes
                    .get(joint)
                    .is_some_and(|node| node.mass > 0.0 || node.support != crate::Support::Free)
            };
            if body.role == Role::Massless {
                return true;
            }
            let speeds: Vec<f64> = body
                .joints
                .iter()
                .filter(|joint| ruled(joint))
                .map(|&joint| state.velocity[joint])
                .collect();
            let size = speeds.iter().fold(self.own_speed(state), |most, own| most.max(own.abs()));
            let near = (doubt.max(1e-9) * size).max(doubt * self.speed);
            speeds.windows(2).all(|pair| (pair[0] - pair[1]).abs() <= near)
        })
    }

    /// A speed of the network's own \[m/s\]: the largest that it begins with, or has.
    pub(super) fn own_speed(&self, state: &State) -> f64 {
        let starts = self
            .network
            .nodes
            .iter()
            .map(|node| super::super::bodies::start_velocity(&self.network, node.start).abs());
        let now = state.velocity.iter().map(|own| own.abs());
        starts.chain(now).filter(|own| own.is_finite()).fold(0.0, f64::max)
    }

    /// A length of the network's own \[m\]: the farthest place of a joint, or that a motion leads to.
    pub(super) fn own_length(&self, state: &State) -> f64 {
        let motions = self.network.nodes.iter().filter_map(|node| match &node.support {
            crate::Support::Prescribed(motion) => Some(motion.bound(self.duration)),
            _ => None,
        });
        let places = state.position.iter().map(|own| own.abs());
        motions.chain(places).filter(|own| own.is_finite()).fold(0.0, f64::max)
    }

    fn switches(
        &self,
        time: f64,
        before: &[Phase],
        after: &[Phase],
        impacts: &[super::impacts::Impact],
    ) -> Vec<Switch> {
        let name = |part: usize| self.expansion.primitives[self.parts[part]].name.clone();
        let mut switches = Vec::new();
        for (part, (old, new)) in before.iter().zip(after).enumerate() {
            let impact = impacts.iter().find(|impact| impact.part == part);
            if old.index == new.index && impact.is_none() {
                continue;
            }
            let words = self.phases_of(self.parts[part]).map_or(&[][..], |own| own.names());
            let is_same = old.index == new.index;
            switches.push(Switch {
                time,
                part,
                name: name(part),
                phase: new.index,
                what: if is_same { "impact" } else { words.get(new.index).copied().unwrap_or("") },
                memory: new.memory,
                impulse: impact.map_or(0.0, |impact| impact.impulse),
                lost: impact.map_or(0.0, |impact| impact.lost),
                worked: impact.map_or(0.0, |impact| impact.worked),
            });
        }
        switches
    }
}

impl Mode {
    /// The system with time counted from `time` \[s\].
    fn system_from(&self, time: f64) -> Arc<System> {
        let moves = |own: &dashpot_dae::Waveform| {
            own.pieces().len() > 1 || !own.pieces().iter().all(|piece| piece.is_constant(0))
        };
        if time == 0.0 || !self.system.waveforms.iter().any(moves) {
            return Arc::clone(&self.system);
        }
        let mut system = System::clone(&self.system);
        let start = time / system.time_scale;
        system.waveforms = system.waveforms.iter().map(|own| own.since(start)).collect();
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

/// By what it is judged whether phases hold.
struct Judge<'a> {
    /// The instant \[s\].
    time: f64,
    state: &'a State,
    /// What is smaller than this part of its terms cannot be told from zero.
    doubt: f64,
    /// What is at its level by the event that ended the leg.
    on_level: &'a [(usize, Watched)],
    /// Parts whose deformation has reached a level \[m\] by that event.
    at_level: &'a [(usize, f64)],
    /// Whether a way inwards counts that turns back before it can be told from the level.
    graze: bool,
}

impl Judge<'_> {
    /// Whether a quantity is on the inner side of its exit's level, or on it and not on its way out.
    fn stays(&self, part: usize, motion: &Derivatives, output: &Output, exit: &Exit) -> bool {
        let inward = if exit.rising { -1.0 } else { 1.0 };
        let (value, size) = motion.output(output, 0);
        let gap = inward * (value - exit.level);
        let noise = self.doubt * (size.max(output.scale.abs()) + exit.level.abs());
        if gap.abs() > noise && !self.on_level.contains(&(part, exit.watched)) {
            return gap > 0.0;
        }
        let is_still =
            exit.watched == Watched::Deformation && self.on_level.contains(&(part, Watched::Rate));
        let derivative = |order: usize| {
            if order == 1 && is_still {
                return 0.0;
            }
            let (value, own) = motion.output(output, order);
            // The state is rounded, and its rounding grows from one derivative to the next.
            let before = motion.output(output, order - 1).1;
            let size = own.max((before * motion.output(output, order + 1).1).sqrt());
            if value.abs() > self.doubt * size { inward * value } else { 0.0 }
        };
        let Some(order) = (1..=ORDERS).find(|&order| derivative(order) != 0.0) else { return true };
        let first = derivative(order);
        if first < 0.0 || self.graze || order > 1 || derivative(2) >= 0.0 {
            return first > 0.0;
        }
        let seen = SEEN * self.doubt * (size + exit.level.abs());
        first * first > 2.0 * seen * -derivative(2)
    }
}

/// All combinations of one option each, those nearest to the first options first.
fn combinations(options: &[Vec<Phase>]) -> impl Iterator<Item = Vec<usize>> {
    let counts: Vec<usize> = options.iter().map(Vec::len).collect();
    let open: Vec<usize> = (0..counts.len()).filter(|&part| counts[part] > 1).collect();
    let parts = counts.len();
    (0..=open.len()).flat_map(move |changes| {
        let (open, counts) = (open.clone(), counts.clone());
        subsets(open.len(), changes).into_iter().flat_map(move |subset| {
            let chosen: Vec<usize> = subset.iter().map(|&at| open[at]).collect();
            let mut all = vec![vec![0; parts]];
            for part in chosen {
                all = all
                    .into_iter()
                    .flat_map(|base| {
                        (1..counts[part]).map(move |option| {
                            let mut next = base.clone();
                            next[part] = option;
                            next
                        })
                    })
                    .collect();
            }
            all
        })
    })
}

/// All subsets of this size of `0..count`, at most as many as are tried.
fn subsets(count: usize, size: usize) -> Vec<Vec<usize>> {
    let mut found = Vec::new();
    let mut chosen: Vec<usize> = (0..size).collect();
    if size > count {
        return found;
    }
    loop {
        found.push(chosen.clone());
        if found.len() >= MOST_TRIED {
            return found;
        }
        let Some(at) = (0..size).rev().find(|&at| chosen[at] < count - size + at) else {
            return found;
        };
        chosen[at] += 1;
        for later in at + 1..size {
            chosen[later] = chosen[later - 1] + 1;
        }
    }
}
