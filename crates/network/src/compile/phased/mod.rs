//! Networks whose laws switch: one system for each combination of phases.
//!
//! Each combination is compiled as a network of its own when it is first met, and kept. The
//! [state](super::transfer) leads from one to the next: deformations, places and velocities, not
//! unknowns.

mod choice;
mod faces;
mod groups;
mod idle;
mod impacts;
mod judge;
mod jumps;
mod rebound;
mod search;
mod settle;
mod start;
mod static_equilibrium;
mod suppressed;

use std::{
    collections::HashMap,
    fmt,
    sync::{Arc, Mutex},
};

use dashpot_dae::{
    Direction, Guard, IntervalEnd, ModeInterval, SolveError, Switch, Switching, System, derivatives,
};

pub use self::idle::IdleSlider;
use self::judge::Choice;
use super::{
    assemble::{Compiled, assemble},
    bodies::{Bodies, Role},
    expand::Expansion,
    transfer::{State, Transfer},
};
use crate::{
    Network, NetworkError, NetworkErrors, NetworkWarning, Support,
    elements::Law,
    phases::{Exit, Phase, PhaseLaw, Phases, Watched},
};

/// A network whose laws switch, ready to be run.
pub struct PhasedNetwork {
    network: Network,
    expansion: Expansion,
    /// The primitives that switch.
    parts: Vec<usize>,
    duration: f64,
    start: State,
    first: Vec<Phase>,
    /// The bodies where nothing that switches joins any.
    apart: Bodies,
    /// When places jump that parts watch by their rates alone \[s\].
    jumps: Vec<f64>,
    /// The scale of all speeds \[m/s\], by which their errors are judged.
    speed: f64,
    modes: Mutex<HashMap<Key, Arc<Mode>>>,
}

/// What tells combinations of phases apart: numbers of phases, and the bits of what they remember.
type Key = Vec<(usize, u64)>;

fn key(phases: &[Phase]) -> Key {
    phases.iter().map(|phase| (phase.index, phase.memory.to_bits())).collect()
}

/// One combination of phases.
pub(super) struct Mode {
    pub(super) system: Arc<System>,
    pub(super) transfer: Transfer,
    /// For each part that switches its ways out.
    pub(super) exits: Vec<Vec<Exit>>,
    guards: Vec<Guard>,
    /// Part and exit of each guard.
    of_guard: Vec<(usize, usize)>,
    /// When a motion has a kink that the mass which is held to it does not follow, or a place jumps \[s\].
    kinks: Vec<f64>,
}

/// A part that switches, as it is reported.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PhasedPart {
    /// Its path, for instance `padding.contact`.
    pub name: String,
    /// Its phases.
    pub phases: &'static [&'static str],
}

/// Compiles a network in which the primitives `parts` of `expansion` switch.
pub(super) fn compile(
    network: Network,
    expansion: Expansion,
    parts: Vec<usize>,
    duration: f64,
) -> Result<(Compiled, PhasedNetwork), NetworkErrors> {
    let apart = start::bodies_apart(&network, &expansion, &parts, duration).map_err(loose)?;
    jumps::through_contacts(&network, &expansion, (&parts, &apart), duration)?;
    let (start, first) = start::state(&network, &expansion, &parts, &apart, duration)?;
    let unseen = jumps::unseen(&network, &expansion, (&parts, &apart), duration);
    let mut phased = PhasedNetwork {
        jumps: unseen.iter().map(|own| own.0).collect(),
        network,
        expansion,
        parts,
        duration,
        start,
        first,
        apart,
        speed: 0.0,
        modes: Mutex::default(),
    };
    let mut compiled = phased.compiled(&phased.first)?;
    let speeds = compiled.nodes.iter().filter_map(|node| node.velocity);
    let speeds = speeds.map(|at| compiled.system.outputs.at(at).scale.abs());
    phased.speed = speeds.fold(0.0, f64::max);
    for (at, node) in compiled.nodes.iter_mut().enumerate() {
        let body = &phased.apart.all[phased.apart.of_joint[at]];
        node.fall = start::time_of_fall(&phased.network, &phased.expansion, body);
    }
    compiled.warnings.extend(unseen.first().map(|&(time, part)| {
        let element = phased.expansion.primitives[part].name.to_string();
        NetworkWarning::WithinJump { element, time }
    }));
    phased.join_bodies(&mut compiled);
    let first = phased.mode_of(&phased.first, &mut compiled);
    phased.keep(&phased.first, first);
    Ok((compiled, phased))
}

/// The same errors, with the reason why something is undetermined.
fn loose(errors: NetworkErrors) -> NetworkErrors {
    let loose = |error: NetworkError| match error {
        NetworkError::Undetermined { nodes } => NetworkError::Loose { nodes },
        other => other,
    };
    NetworkErrors(errors.0.into_iter().map(loose).collect())
}

impl PhasedNetwork {
    /// The parts that switch.
    pub fn parts(&self) -> Vec<PhasedPart> {
        let part = |&at: &usize| PhasedPart {
            name: self.expansion.primitives[at].name.to_string(),
            phases: self.phases_of(at).map_or(&[][..], Phases::names),
        };
        self.parts.iter().map(part).collect()
    }

    /// The law of the part that is the number `part` in a phase: the energy that it stores \[J\] at
    /// a deformation \[m\].
    pub fn stored(&self, part: usize, phase: Phase, deformation: f64) -> f64 {
        let own = self.parts.get(part).and_then(|&at| self.phases_of(at));
        match own.map(|own| own.law(phase)) {
            Some(PhaseLaw::Element(element)) => element.stored(deformation),
            _ => 0.0,
        }
    }

    /// Number of the part of this path.
    pub fn part_named(&self, name: &str) -> Option<usize> {
        self.parts.iter().position(|&at| *self.expansion.primitives[at].name == *name)
    }

    /// Whether what switches has a linear law in each of its phases.
    pub fn has_linear_phases(&self) -> bool {
        let is_linear = |law: PhaseLaw| match law {
            PhaseLaw::Element(own) => !matches!(own.law(), Law::Nonlinear { .. }),
            _ => true,
        };
        let mut all = self.parts.iter().filter_map(|&at| self.phases_of(at));
        all.all(|own| {
            let phases = 0..own.names().len();
            phases.map(|index| own.law(Phase { index, memory: 0.0 })).all(is_linear)
        })
    }

    /// The phases in which parts begin, as far as the network alone tells.
    pub fn first_phases(&self) -> &[Phase] {
        &self.first
    }

    fn phases_of(&self, primitive: usize) -> Option<&dyn Phases> {
        self.expansion.primitives[primitive].origin.phases()
    }

    fn compiled(&self, phases: &[Phase]) -> Result<Compiled, NetworkErrors> {
        let expansion = self.expansion.in_phases(&self.parts, phases);
        assemble(&self.network, &expansion, self.duration)
    }

    /// The mode of these phases; compiled when it is first asked for.
    fn mode(&self, phases: &[Phase]) -> Result<Arc<Mode>, NetworkErrors> {
        if let Ok(modes) = self.modes.lock()
            && let Some(mode) = modes.get(&key(phases))
        {
            return Ok(Arc::clone(mode));
        }
        let mode = self.mode_of(phases, &mut self.compiled(phases)?);
        Ok(self.keep(phases, mode))
    }

    fn keep(&self, phases: &[Phase], mode: Mode) -> Arc<Mode> {
        let mode = Arc::new(mode);
        if let Ok(mut modes) = self.modes.lock() {
            // What slides to and fro remembers another place each time.
            if modes.len() >= MOST_KEPT {
                modes.clear();
            }
            modes.insert(key(phases), Arc::clone(&mode));
        }
        mode
    }

    fn mode_of(&self, phases: &[Phase], compiled: &mut Compiled) -> Mode {
        let mut kinks = std::mem::take(&mut compiled.kinks);
        kinks.extend(&self.jumps);
        kinks.sort_by(f64::total_cmp);
        let (mut guards, mut of_guard) = (Vec::new(), Vec::new());
        let exits: Vec<Vec<Exit>> = self
            .parts
            .iter()
            .zip(phases)
            .map(|(&at, &phase)| self.phases_of(at).map_or_else(Vec::new, |own| own.exits(phase)))
            .collect();
        for (part, exits) in exits.iter().enumerate() {
            let name = &self.expansion.primitives[self.parts[part]].name;
            let Some(outputs) =
                compiled.primitives.iter().find(|primitive| primitive.name == *name)
            else {
                continue;
            };
            for (at, exit) in exits.iter().enumerate() {
                let output = match exit.watched {
                    Watched::Deformation => Some(outputs.deformation),
                    Watched::Rate => outputs.rate,
                    Watched::Force => Some(outputs.force),
                };
                let Some(output) = output else { continue };
                guards.push(Guard {
                    name: name.to_string(),
                    output,
                    level: exit.level,
                    direction: if exit.rising { Direction::Rising } else { Direction::Falling },
                    stops: true,
                    begins: Some(!exit.rising),
                    rate_of: (exit.watched == Watched::Rate).then_some(outputs.deformation),
                });
                of_guard.push((part, at));
            }
        }
        let transfer = compiled.transfer.take().unwrap_or_default();
        Mode { system: Arc::new(compiled.system.clone()), transfer, exits, guards, of_guard, kinks }
    }

    /// The phases that hold after `time`. Where places jump then, that comes first, as if time stood still: what goes on from
    /// there has the depth that it was pressed to by the jump.
    fn through(
        &self,
        state: &mut State,
        time: f64,
        (phases, fired): (&[Phase], &[(usize, usize)]),
        threshold: f64,
    ) -> Result<(Choice, Vec<Switch>), SolveError> {
        if !self.jumps.contains(&time) {
            return self.choose(state, (time, false), phases, fired, threshold);
        }
        let (jumped, mut switches) = self.choose(state, (time, true), phases, fired, threshold)?;
        let solved = derivatives(&jumped.system, &jumped.unknowns, 0)?;
        *state = jumped.mode.transfer.read(&solved.values[0], &solved.inputs[0], &self.start);
        self.go_on(state, time);
        let (choice, more) = self.choose(state, (time, false), &jumped.phases, &[], threshold)?;
        switches.extend(more);
        let hangs_on_threshold = choice.hangs_on_threshold || jumped.hangs_on_threshold;
        let tried = choice.tried + jumped.tried;
        Ok((Choice { tried, hangs_on_threshold, ..choice }, switches))
    }

    /// The interval that begins at `time` with these phases.
    fn interval(time: f64, choice: Choice, switches: Vec<Switch>) -> ModeInterval {
        let Choice { mode, system, phases, unknowns, levels, predicted, tried, hangs_on_threshold } =
            choice;
        let mut system = System::clone(&system);
        system.initial = unknowns;
        let until = mode.kinks.get(mode.kinks.partition_point(|&kink| kink <= time)).copied();
        if let Some(until) = until {
            let end = until / system.time_scale - time / system.time_scale;
            system.waveforms =
                system.waveforms.iter().map(|waveform| waveform.until(end)).collect();
        }
        ModeInterval {
            system: Arc::new(system),
            phases: phases.iter().map(|phase| (phase.index, phase.memory)).collect(),
            guards: mode
                .guards
                .iter()
                .zip(levels)
                .map(|(guard, level)| Guard { level, ..guard.clone() })
                .collect(),
            switches,
            predicted,
            until,
            tried,
            hangs_on_threshold,
        }
    }

    /// Gives what moves as it is told the velocity that it has from `time` on.
    fn go_on(&self, state: &mut State, time: f64) {
        for body in &self.apart.all {
            let Role::Prescribed(node) = body.role else { continue };
            if let Support::Prescribed(motion) = &self.network.nodes[node].support {
                let velocity = motion.piece_at(time).derivative(1, time);
                body.joints.iter().for_each(|&joint| state.velocity[joint] = velocity);
            }
        }
    }

    fn failure(time: f64, errors: &NetworkErrors) -> SolveError {
        SolveError::Switching { time, reason: errors.to_string() }
    }
}

/// Rounding of a state that is given, in parts of its terms.
const GIVEN: f64 = 1e3 * f64::EPSILON;
const MOST_KEPT: usize = 4096;

/// Whether a part begins to hold where its deformation reaches a level, and pushes without limit then.
pub(super) fn is_contact(phases: &dyn Phases) -> bool {
    (0..phases.names().len()).any(|index| {
        let phase = Phase { index, memory: 0.0 };
        matches!(phases.law(phase), PhaseLaw::Held(_))
            && phases.exits(phase).iter().all(|exit| !exit.rising)
    })
}

/// The first phase of a part in which it holds nothing and can move at this rate \[m/s\], or is about to.
fn moving(phases: &dyn Phases, phase: Phase, rate: f64) -> Option<usize> {
    (0..phases.names().len()).find(|&index| {
        let phase = Phase { index, ..phase };
        let goes_on =
            |exit: &Exit| exit.watched != Watched::Rate || (rate < exit.level) == exit.rising;
        !matches!(phases.law(phase), PhaseLaw::Held(_)) && phases.exits(phase).iter().all(goes_on)
    })
}

impl fmt::Debug for PhasedNetwork {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter
            .debug_struct("PhasedNetwork")
            .field("parts", &self.parts())
            .finish_non_exhaustive()
    }
}

impl Switching for PhasedNetwork {
    fn first(&self, threshold: f64) -> Result<ModeInterval, SolveError> {
        let choose = |threshold: f64| {
            let mut state = self.start.clone();
            self.through(&mut state, 0.0, (&self.first, &[]), threshold)
        };
        // The start has no error of the method. What parts at once by an impact is followed as at any other instant.
        let (choice, switches) = match choose(threshold.min(GIVEN)) {
            Ok(known) if known.1.iter().all(|own| own.impulse == 0.0) => known,
            _ => choose(threshold)?,
        };
        // Phases that hold from the start are no switchings.
        let switches = switches.into_iter().filter(|switch| switch.impulse > 0.0).collect();
        Ok(Self::interval(0.0, choice, switches))
    }

    fn next(&self, end: &IntervalEnd<'_>) -> Result<ModeInterval, SolveError> {
        let phases: Vec<Phase> =
            end.interval.phases.iter().map(|&(index, memory)| Phase { index, memory }).collect();
        let mode = self.mode(&phases).map_err(|errors| Self::failure(end.time, &errors))?;
        let mut inputs = vec![0.0; end.interval.system.inputs.len()];
        end.interval.system.inputs_at(end.length, end.length, &mut inputs);
        let mut state = mode.transfer.read(end.state, &inputs, &self.start);
        if end.interval.until == Some(end.time) {
            self.go_on(&mut state, end.time);
        }
        let fired: Vec<(usize, usize)> =
            end.fired.iter().filter_map(|&guard| mode.of_guard.get(guard).copied()).collect();
        let (choice, switches) =
            self.through(&mut state, end.time, (&phases, &fired), end.threshold)?;
        Ok(Self::interval(end.time, choice, switches))
    }
}

#[cfg(test)]
mod tests;
