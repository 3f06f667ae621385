//! Jumps: of motions, with the contacts that would jump with them; and of what follows from balances, where
//! phases would put it elsewhere.

use dashpot_dae::Derivatives;

use super::{
    GIVEN, Mode, PhasedNetwork, is_contact,
    judge::{Fault, Judge},
};
use crate::{
    Network, NetworkError, NetworkErrors, Support,
    compile::{bodies::Bodies, expand::Expansion, structure::jumps},
    phases::{Phase, PhaseLaw, Watched},
};

/// Refuses motions that jump where contacts jump with them: what a jump passes through cannot be told. Bodies with mass
/// stay where they are at that instant, so that contacts beyond them do not notice.
pub(super) fn through_contacts(
    network: &Network,
    expansion: &Expansion,
    (parts, apart): (&[usize], &Bodies),
    duration: f64,
) -> Result<(), NetworkErrors> {
    let contacts: Vec<[usize; 2]> = parts
        .iter()
        .map(|&at| &expansion.primitives[at])
        .filter(|own| own.origin.phases().is_some_and(is_contact))
        .map(|own| own.ends.map(|joint| apart.of_joint[joint]))
        .collect();
    let jumping = network.nodes.iter().enumerate().filter_map(|(at, node)| match &node.support {
        Support::Prescribed(motion) if !contacts.is_empty() => {
            let mut times = jumps(network, motion, duration);
            // Where it begins away from zero, the state begins there as well.
            let time = times.find(|&time| time > 0.0)?;
            let moved = moved_at_once(expansion, apart, apart.of_joint[at]);
            let is_moved = contacts.iter().flatten().any(|&end| moved[end]);
            is_moved.then(|| NetworkError::StepThroughContact { node: node.name.clone(), time })
        }
        _ => None,
    });
    let errors: Vec<NetworkError> = jumping.collect();
    if errors.is_empty() { Ok(()) } else { Err(NetworkErrors(errors)) }
}

/// When loads and motions jump that move what has no mass \[s\], where a part watches its rate, and that part: a rate does not
/// tell of a jump.
pub(super) fn unseen(
    network: &Network,
    expansion: &Expansion,
    (parts, apart): (&[usize], &Bodies),
    duration: f64,
) -> Vec<(f64, usize)> {
    let watching = parts.iter().filter(|at| expansion.primitives[**at].needs_rate());
    let ends = |at: usize| expansion.primitives[at].ends.map(|joint| apart.of_joint[joint]);
    let watching: Vec<(usize, [usize; 2])> = watching.map(|&at| (at, ends(at))).collect();
    let motions = network.nodes.iter().enumerate().filter_map(|(at, node)| match &node.support {
        Support::Prescribed(motion) => Some((apart.of_joint[at], motion)),
        _ => None,
    });
    let loads = network.loads.iter().map(|load| (apart.of_joint[load.node.index()], &load.force));
    let loads = loads.filter(|&(body, _)| apart.all[body].is_massless());
    let mut times = Vec::new();
    for (body, waveform) in motions.chain(loads).filter(|_| !watching.is_empty()) {
        let moved = moved_at_once(expansion, apart, body);
        let part = watching.iter().find(|own| own.1.into_iter().any(|end| moved[end]));
        let jumping = jumps(network, waveform, duration).filter(|own| *own < duration);
        times.extend(part.into_iter().flat_map(|own| jumping.clone().map(|time| (time, own.0))));
    }
    times.sort_by(|one, other| one.0.total_cmp(&other.0));
    times
}

/// The bodies whose place may jump with that of `body`: those without mass that it is joined to.
fn moved_at_once(expansion: &Expansion, apart: &Bodies, body: usize) -> Vec<bool> {
    let mut moved = vec![false; apart.all.len()];
    let mut neighbours = vec![Vec::new(); apart.all.len()];
    for primitive in &expansion.primitives {
        let [a, b] = primitive.ends.map(|joint| apart.of_joint[joint]);
        neighbours[a].push(b);
        neighbours[b].push(a);
    }
    moved[body] = true;
    let mut pending = vec![body];
    while let Some(own) = pending.pop() {
        for &next in &neighbours[own] {
            if !moved[next] && apart.all[next].is_massless() {
                moved[next] = true;
                pending.push(next);
            }
        }
    }
    moved
}

impl PhasedNetwork {
    /// The parts that would have to jump against their own force.
    ///
    /// A place without mass that springs hold follows from the force of the part behind it. Phases in
    /// which that force is another put it elsewhere at once; a slider that goes there against the way
    /// in which it slides would give energy. What jumps from outside moves a slider its own way.
    pub(super) fn jumped_back(
        &self,
        phases: &[Phase],
        judge: &Judge<'_>,
        mode: &Mode,
        motion: &Derivatives,
    ) -> Vec<Fault> {
        let (unknowns, inputs) = (&motion.values[0], &motion.inputs[0]);
        let old = |primitive: usize| judge.state.deformation[primitive];
        let new = |primitive: usize| mode.transfer.deformation(primitive, unknowns, inputs);
        let rounding = GIVEN * judge.size.0;
        // By how much a spring's force jumps, the size of its force, and what rounding does to it.
        let jump = |at: usize| {
            let force = |deformation: f64| self.spring_force(phases, at, deformation);
            let (before, after) = (force(old(at)), force(new(at)));
            let near = force(new(at) + rounding) - force(new(at) - rounding);
            ((after - before).abs(), before.abs().max(after.abs()), near.abs())
        };
        let jumps = |part: usize, force: f64| {
            // A force that has reached its level may be as far beyond as the judge lets it be.
            let is_fired = judge.on_level.iter().any(|own| own.1 == Watched::Force);
            let threshold = judge.criteria[part].threshold;
            let threshold = if is_fired { threshold.sqrt() } else { threshold };
            mode.transfer.balanced().iter().any(|&at| {
                let (jump, size, near) = jump(at);
                jump > threshold * size.max(force.abs()) + near
            })
        };
        let is_back = |part: &usize| match self.phases_of(self.parts[*part])?.law(phases[*part]) {
            PhaseLaw::Force(force) => {
                let at = self.parts[*part];
                let jump = (new(at) - old(at)) * force.signum();
                Some(jump < -rounding && jumps(*part, force))
            }
            _ => None,
        };
        (0..self.parts.len())
            .filter(|part| is_back(part) == Some(true))
            .map(|part| Fault { part, towards: None })
            .collect()
    }

    /// The force \[N\] of a spring, or of a law that is not linear, in these phases.
    fn spring_force(&self, phases: &[Phase], primitive: usize, deformation: f64) -> f64 {
        let part = self.parts.iter().position(|&at| at == primitive);
        let law = part.and_then(|part| Some(self.phases_of(primitive)?.law(phases[part])));
        match law {
            Some(PhaseLaw::Element(element)) => element.force(deformation, 0.0),
            _ => self.expansion.primitives[primitive].element.force(deformation, 0.0),
        }
    }
}
