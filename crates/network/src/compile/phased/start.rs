//! The state in which a run begins.

use super::{
    super::{
        bodies::{Bodies, Body, Groups, Role},
        expand::Expansion,
        structure::Structure,
        transfer::State,
    },
    is_contact, moving,
    settle::Settling,
    static_equilibrium::Loads,
};
use crate::{
    Network, NetworkError, NetworkErrors, Start, Support,
    error::Subject,
    network::start_velocity,
    parameters::InvalidParameter,
    phases::{Phase, PhaseLaw, Phases},
};

/// Overlap at the start that is rounding, in parts of the places.
const NEAR: f64 = 1e-9;

/// Why a mass cannot begin beyond a contact.
pub(super) const THROUGH_CONTACT: &str = "it is beyond a contact there, or within what remembers how it was deformed: begin at \
                                          touch, or give what it meets a spring";

/// The bodies of the network in its loosest state, in which no part that switches holds anything.
/// Errors: what is undetermined where nothing touches, for instance a massless pad that can part on both sides. Sliders
/// count as stuck there, since one that no force can move does not slide; but those that given motions move slide.
pub(super) fn bodies_apart(
    network: &Network,
    expansion: &Expansion,
    parts: &[usize],
    duration: f64,
) -> Result<Bodies, NetworkErrors> {
    let phases = |is_loose: fn(&dyn Phases) -> bool| -> Vec<Phase> {
        let phase = |&at: &usize| {
            let own = expansion.primitives[at].origin.phases();
            let index = own.and_then(|own| {
                let holds = |&index: &usize| {
                    matches!(own.law(Phase { index, memory: 0.0 }), PhaseLaw::Held(_))
                };
                let mut all = 0..own.names().len();
                if is_loose(own) { all.find(|index| !holds(index)) } else { all.find(holds) }
            });
            Phase { index: index.unwrap_or(0), memory: 0.0 }
        };
        parts.iter().map(phase).collect()
    };
    let loosest = expansion.in_phases(parts, &phases(|_| true));
    let apart = Bodies::of(network, &loosest).map_err(NetworkErrors)?;
    if let Ok(structure) = Structure::of(network, &loosest, &apart, duration) {
        static_friction(expansion, &apart, &structure)?;
    }
    let mut untouched = phases(is_contact);
    slip(network, expansion, parts, &apart, &mut untouched)?;
    let untouched = expansion.in_phases(parts, &untouched);
    let bodies = Bodies::of(network, &untouched).map_err(NetworkErrors)?;
    Structure::of(network, &untouched, &bodies, duration).map_err(NetworkErrors)?;
    Ok(apart)
}

/// Refuses static friction where the drop of the force to that of kinetic friction would move something at
/// once, and where sliders side by side would let go one by one.
fn static_friction(
    expansion: &Expansion,
    apart: &Bodies,
    structure: &Structure,
) -> Result<(), NetworkErrors> {
    let ratio = |at: usize| {
        let own = expansion.primitives[at].origin.phases();
        own.map_or(1.0, Phases::static_to_kinetic)
    };
    let refused = |at: usize| -> Option<NetworkError> {
        let primitive = &expansion.primitives[at];
        let follows = |&joint: &usize| structure.algebraic_cluster(apart.of_joint[joint]).is_some();
        let range = match &primitive.share {
            Some(share) if ratio(share.of).to_bits() != ratio(at).to_bits() => {
                "that of the sliders beside it"
            }
            _ if ratio(at) > 1.0 && primitive.ends.iter().any(follows) => {
                "1 where an end has neither a mass nor a dashpot beside the slider"
            }
            _ => return None,
        };
        let invalid = InvalidParameter::new("static-to-kinetic", range, ratio(at));
        let (element, path) = primitive.name.split_once('.').unwrap_or((&*primitive.name, ""));
        let path = path.split('.').map(str::to_owned).collect();
        let subject = Subject::Element { name: element.to_owned(), path };
        Some(NetworkError::Invalid { subject, invalid })
    };
    let errors: Vec<NetworkError> = (0..expansion.primitives.len()).filter_map(refused).collect();
    if errors.is_empty() { Ok(()) } else { Err(NetworkErrors(errors)) }
}

/// Lets those sliders slide that would hold together what is given different motions, or what others hold together, the
/// way that their rate goes at the start. Errors: [`NetworkError::UndeterminedForce`] where the motions at both ends
/// begin alike: then a slider neither sticks nor slides, and its force follows from nothing.
fn slip(
    network: &Network,
    expansion: &Expansion,
    parts: &[usize],
    apart: &Bodies,
    phases: &mut [Phase],
) -> Result<(), NetworkErrors> {
    let support = |body: &Body| match body.role {
        Role::Fixed => Some(&Support::Fixed),
        Role::Prescribed(node) => Some(&network.nodes[node].support),
        _ => None,
    };
    let mut given: Vec<Option<&Support>> = apart.all.iter().map(support).collect();
    let mut joined = Groups::new(apart.all.len());
    let mut errors = Vec::new();
    // Contacts hold whatever there is; sliders give way.
    for slides in [false, true] {
        for (&at, phase) in parts.iter().zip(&mut *phases) {
            let primitive = &expansion.primitives[at];
            let Some(own) = primitive.origin.phases() else { continue };
            let is_held = matches!(own.law(*phase), PhaseLaw::Held(_));
            if !is_held || is_contact(own) == slides {
                continue;
            }
            let ends = primitive.ends.map(|joint| apart.of_joint[joint]);
            let [a, b] = ends.map(|end| given[joined.of(end)]);
            if slides && a.zip(b).is_some_and(|(a, b)| a != b) {
                let rate = given_rate(ends.map(|end| support(&apart.all[end])));
                match moving(own, *phase, rate.unwrap_or(0.0)) {
                    Some(index) if rate != Some(0.0) => phase.index = index,
                    _ => {
                        let element = primitive.name.to_string();
                        errors.push(NetworkError::UndeterminedForce { element });
                    }
                }
                continue;
            }
            if !joined.join(ends[0], ends[1]) && slides {
                // What is held already needs no second slider, whose force would follow from nothing.
                let rate = apart.all[ends[0]].velocity - apart.all[ends[1]].velocity;
                phase.index = moving(own, *phase, rate).unwrap_or(phase.index);
            }
            given[joined.of(ends[0])] = a.or(b);
        }
    }
    if errors.is_empty() { Ok(()) } else { Err(NetworkErrors(errors)) }
}

/// The first derivative from the rate on that is not zero at the start, of what is given at both
/// ends: it has the sign of the rate that follows.
fn given_rate(ends: [Option<&Support>; 2]) -> Option<f64> {
    let [Some(a), Some(b)] = ends else { return None };
    let derivative = |support: &Support, order: u32| match support {
        Support::Prescribed(motion) => motion.piece_at(0.0).derivative(order, 0.0),
        _ => 0.0,
    };
    let difference = |order: u32| derivative(a, order) - derivative(b, order);
    Some((1..=4).map(difference).find(|&own| own != 0.0).unwrap_or(0.0))
}

/// The state at the start and the phases that go with it, as far as places tell.
pub(super) fn state(
    network: &Network,
    expansion: &Expansion,
    parts: &[usize],
    apart: &Bodies,
    duration: f64,
) -> Result<(State, Vec<Phase>), NetworkErrors> {
    placed_alike(network, apart)?;
    let (mut position, velocity) = given(network, expansion, apart);
    let deformations = |position: &[f64]| -> Vec<f64> {
        let ends = expansion.primitives.iter().map(|primitive| primitive.ends);
        ends.map(|[a, b]| position[a] - position[b]).collect()
    };
    let mut deformation = deformations(&position);
    let phases = |deformation: &[f64]| -> Result<Vec<Phase>, NetworkErrors> {
        let first = |&at: &usize| match expansion.primitives[at].origin.phases() {
            Some(own) => own.first(deformation[at]),
            None => Phase { index: 0, memory: 0.0 },
        };
        let mut first: Vec<Phase> = parts.iter().map(first).collect();
        slip(network, expansion, parts, apart, &mut first)?;
        Ok(first)
    };
    let mut first = phases(&deformation)?;
    if let Some(own) = Settling::of(network, expansion, (parts, apart), duration, &position) {
        let settled = own.settled(&first)?;
        position = settled.position;
        first = settled.phases;
        deformation = deformations(&position);
    }
    if network.effects.iter().any(|effect| effect.starts_in_balance()) {
        let loads = Loads { network, expansion, parts, apart, duration };
        let unloaded = position.clone();
        for _ in 0..=parts.len() {
            position = loads.balanced(&first, &unloaded, &velocity)?;
            deformation = deformations(&position);
            if !close(expansion, parts, &mut first, &phases(&deformation)?) {
                break;
            }
            slip(network, expansion, parts, apart, &mut first)?;
        }
        let remembered = phases(&deformation)?;
        for ((own, remembered), &at) in first.iter_mut().zip(remembered).zip(parts) {
            let has_one_law =
                expansion.primitives[at].origin.phases().is_some_and(|own| own.at_rest().is_some());
            if own.index == remembered.index || has_one_law {
                *own = remembered;
            }
        }
    }
    overlaps(network, expansion, parts, apart, &deformation)?;
    Ok((State { deformation, position, velocity }, first))
}

/// The places and velocities with which joints begin, by what is given and where they fall from.
fn given(network: &Network, expansion: &Expansion, apart: &Bodies) -> (Vec<f64>, Vec<f64>) {
    let mut position = vec![0.0; expansion.joints];
    let mut velocity = vec![0.0; expansion.joints];
    for (at, node) in network.nodes.iter().enumerate() {
        if let Support::Prescribed(motion) = &node.support {
            position[at] = motion.value(0.0);
            velocity[at] = motion.piece_at(0.0).derivative(1, 0.0);
        }
    }
    for body in &apart.all {
        let given = body.joints.iter().copied().find(|&joint| {
            network.nodes.get(joint).is_some_and(|node| node.support != Support::Free)
        });
        let speed = body
            .joints
            .iter()
            .filter_map(|&joint| network.nodes.get(joint))
            .find(|node| node.mass > 0.0)
            .map_or(0.0, |node| start_velocity(network, node.start));
        let height = predicted(network, expansion, body.joints.as_slice());
        for &joint in &body.joints {
            if let Some(given) = given {
                position[joint] = position[given];
                velocity[joint] = velocity[given];
            } else {
                position[joint] = body.position - height.unwrap_or(0.0);
                velocity[joint] = if height.is_some() { 0.0 } else { speed };
            }
        }
    }
    (position, velocity)
}

/// The node of a body that begins at a position of its own.
fn displaced(network: &Network, body: &Body) -> Option<String> {
    let mut nodes = body.joints.iter().filter_map(|&joint| network.nodes.get(joint));
    nodes.find(|node| node.position != 0.0).map(|node| node.name.clone())
}

/// Refuses masses that are rigidly linked and begin at different positions.
fn placed_alike(network: &Network, apart: &Bodies) -> Result<(), NetworkErrors> {
    for body in &apart.all {
        let nodes = body.joints.iter().filter_map(|&joint| network.nodes.get(joint));
        let masses: Vec<_> = nodes.filter(|node| node.mass > 0.0).collect();
        let differs = |pair: &&[&crate::Node]| (pair[0].position - pair[1].position).abs() > 0.0;
        if let Some(pair) = masses.windows(2).find(differs) {
            let [first, second] = [pair[0], pair[1]].map(|node| node.name.clone());
            let difference = "their start positions differ";
            return Err(NetworkError::ContradictingMotions { first, second, difference }.into());
        }
    }
    Ok(())
}

/// Closes the contacts that balance brings together; whether there are any.
fn close(expansion: &Expansion, parts: &[usize], phases: &mut [Phase], reached: &[Phase]) -> bool {
    let mut changed = false;
    for (at, (phase, reached)) in phases.iter_mut().zip(reached).enumerate() {
        let own = expansion.primitives[parts[at]].origin.phases();
        if own.is_some_and(|own| is_contact(own) && phase.index < reached.index) {
            *phase = *reached;
            changed = true;
        }
    }
    changed
}

/// Refuses contacts whose sides overlap at the start because a motion begins within what it meets.
fn overlaps(
    network: &Network,
    expansion: &Expansion,
    parts: &[usize],
    apart: &Bodies,
    deformation: &[f64],
) -> Result<(), NetworkErrors> {
    let overlap = |&at: &usize| -> Option<NetworkError> {
        let primitive = &expansion.primitives[at];
        let own = primitive.origin.phases().filter(|phase| is_contact(*phase))?;
        let level = (0..own.names().len()).find_map(|index| {
            match own.law(Phase { index, memory: 0.0 }) {
                PhaseLaw::Held(level) => Some(level),
                _ => None,
            }
        })?;
        let bodies = primitive.ends.map(|joint| &apart.all[apart.of_joint[joint]]);
        // What is massless gives way.
        let is_hard = bodies.iter().all(|body| !body.is_massless());
        let beyond = deformation[at] - level;
        if !is_hard || beyond <= NEAR * deformation[at].abs().max(level.abs()) {
            return None;
        }
        bodies.iter().find_map(|body| match body.role {
            Role::Prescribed(node) => Some(NetworkError::StepThroughContact {
                node: network.nodes[node].name.clone(),
                time: 0.0,
            }),
            _ => displaced(network, body)
                .map(|node| NetworkError::StartPosition { node, reason: THROUGH_CONTACT }),
        })
    };
    let errors: Vec<NetworkError> = parts.iter().filter_map(overlap).collect();
    if errors.is_empty() { Ok(()) } else { Err(NetworkErrors(errors)) }
}

impl Network {
    /// How long \[s\] what is dropped falls freely before it touches anything; 0 where all begins at
    /// touch, or the network cannot be compiled.
    pub fn time_of_fall(&self) -> f64 {
        let Ok(network) = self.with_effects() else { return 0.0 };
        let expansion = Expansion::of(&network);
        let Ok(bodies) = Bodies::of(&network, &expansion) else { return 0.0 };
        let falls = bodies.all.iter().map(|body| time_of_fall(&network, &expansion, body));
        falls.fold(0.0, f64::max)
    }
}

/// How long \[s\] a body falls freely before it touches anything; 0 where it begins at touch.
pub(super) fn time_of_fall(network: &Network, expansion: &Expansion, body: &Body) -> f64 {
    let pull = network.effects.iter().find_map(|effect| effect.gravity());
    let height = predicted(network, expansion, body.joints.as_slice());
    height.zip(pull).map_or(0.0, |(height, pull)| (2.0 * height / pull).sqrt())
}

/// The height \[m\] from which a body begins to fall freely: it is dropped, gravity pulls it towards
/// the support, and only what never pulls touches it, each of them between it and something that does not begin
/// with a speed. All others begin at touch, with the speed of the fall.
pub(super) fn predicted(network: &Network, expansion: &Expansion, joints: &[usize]) -> Option<f64> {
    let gravity = network.effects.iter().find_map(|effect| effect.gravity())?;
    let mut nodes = joints.iter().filter_map(|&joint| network.nodes.get(joint));
    let height = nodes.find_map(|node| match node.start {
        Start::Drop(height) => Some(height),
        _ => None,
    })?;
    let touching = expansion.primitives.iter().filter(|primitive| {
        !primitive.is_link && primitive.ends.iter().any(|joint| joints.contains(joint))
    });
    let mut contacts = touching.map(|touching| {
        let rests = network.nodes.get(touching.ends[1]).is_none_or(|below| !below.is_impactor());
        let parts =
            touching.origin.never_pulls() || touching.origin.phases().is_some_and(is_contact);
        joints.contains(&touching.ends[0]) && rests && parts
    });
    (gravity > 0.0 && contacts.all(|is_below| is_below)).then_some(height)
}
