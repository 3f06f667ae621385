//! Where things without mass are at the start, if a motion or a mass begins displaced: it has jumped there, and
//! they have followed at once.

use dashpot_dae::Waveform;

use super::{
    super::{
        assemble::DASHPOTS_IN_A_ROW,
        balance::{self, Surroundings, UNBALANCED},
        bodies::{Bodies, Body, Groups, Role, joint_name},
        expand::Expansion,
        structure::{Structure, jumps_at_start},
    },
    is_contact,
    start::THROUGH_CONTACT,
};
use crate::{
    Network, NetworkError, NetworkErrors, Support,
    elements::Law,
    phases::{Phase, PhaseLaw, Phases},
};

/// Overlaps of contacts, and ways, that are rounding, in parts of the places.
const NEAR: f64 = 1e-9;

/// What is rounding beside these places \[m\].
fn near(position: &[f64]) -> f64 {
    NEAR * position.iter().fold(0.0_f64, |most, own| most.max(own.abs()))
}

/// A start at which motions have jumped.
pub(super) struct Settling<'a> {
    network: &'a Network,
    expansion: &'a Expansion,
    parts: &'a [usize],
    apart: &'a Bodies,
    duration: f64,
    /// Numbers of the nodes that have jumped.
    jumped: Vec<usize>,
    /// The network with all masses held.
    held: Network,
    /// Places of all joints before \[m\].
    before: Vec<f64>,
    /// Those of what has mass, is held or moved, after the jump \[m\].
    after: &'a [f64],
}

/// Where everything is afterwards.
pub(super) struct Settled {
    /// Places of all joints \[m\].
    pub(super) position: Vec<f64>,
    /// The phases: contacts that the jump has closed are closed.
    pub(super) phases: Vec<Phase>,
}

impl<'a> Settling<'a> {
    /// The start at which joints are at `position`, those that follow a jump not yet; `None` where no motion
    /// and no mass begins displaced.
    pub(super) fn of(
        network: &'a Network,
        expansion: &'a Expansion,
        (parts, apart): (&'a [usize], &'a Bodies),
        duration: f64,
        position: &'a [f64],
    ) -> Option<Self> {
        let has_jumped = |node: &usize| match &network.nodes[*node].support {
            Support::Prescribed(motion) => jumps_at_start(network, motion, duration),
            _ => network.nodes[*node].position != 0.0,
        };
        let jumped: Vec<usize> = (0..network.nodes.len()).filter(has_jumped).collect();
        if jumped.is_empty() {
            return None;
        }
        let mut held = network.clone();
        held.effects.clear();
        held.loads.clear();
        for (at, node) in held.nodes.iter_mut().enumerate() {
            if node.support != Support::Free || node.mass > 0.0 {
                node.support = if position[at] == 0.0 {
                    Support::Fixed
                } else {
                    Support::Prescribed(Waveform::constant(position[at]))
                };
            }
            node.mass = 0.0;
        }
        let mut before = position.to_vec();
        for body in &apart.all {
            if body.joints.iter().any(|joint| jumped.contains(joint)) {
                body.joints.iter().for_each(|&joint| before[joint] = 0.0);
            }
        }
        let after = position;
        Some(Self { network, expansion, parts, apart, duration, jumped, held, before, after })
    }

    /// Where everything is after the jump. Masses have not moved and dashpots have not given way; springs
    /// are in balance, and contacts push or are open. `first` are the phases before.
    /// Errors: where dashpots would have to give way, and where what happens in the jump cannot be told.
    pub(super) fn settled(&self, first: &[Phase]) -> Result<Settled, NetworkErrors> {
        self.check_dashpots()?;
        let contacts: Vec<usize> =
            (0..self.parts.len()).filter(|&part| self.level(part).is_some()).collect();
        let mut phases: Vec<Phase> = first.to_vec();
        contacts.iter().for_each(|&part| phases[part] = self.contact(part, false));
        let mut position = self.balanced(&phases)?;
        // Of springs and contacts there is one balance: each round brings it nearer.
        for _ in 0..=2 * contacts.len() {
            let beyond = |part: &usize| (*part, self.beyond(*part, &position));
            let overlaps = contacts.iter().map(beyond).filter(|own| own.1 > near(&position));
            let Some((deepest, _)) = overlaps.max_by(|a, b| a.1.total_cmp(&b.1)) else {
                self.check_others(&position)?;
                return Ok(Settled { position, phases });
            };
            phases[deepest] = self.contact(deepest, true);
            position = self.balanced(&phases)?;
            for &part in contacts.iter().filter(|&&part| part != deepest) {
                let closed = phases[part];
                if closed.index != self.contact(part, true).index {
                    continue;
                }
                phases[part] = self.contact(part, false);
                let without = self.balanced(&phases)?;
                if self.beyond(part, &without) < 0.0 {
                    position = without;
                } else {
                    phases[part] = closed;
                }
            }
        }
        Err(self.through_contact())
    }

    /// Deformation \[m\] at which a part closes, if it is a contact with a side that can follow at once.
    fn level(&self, part: usize) -> Option<f64> {
        let primitive = &self.expansion.primitives[self.parts[part]];
        let own = primitive.origin.phases().filter(|phase| is_contact(*phase))?;
        let follows = primitive.ends.iter().any(|&joint| self.is_light(joint));
        let mut phases = (0..own.names().len()).map(|index| Phase { index, memory: 0.0 });
        let level = phases.find_map(|phase| match own.law(phase) {
            PhaseLaw::Held(level) => Some(level),
            _ => None,
        });
        level.filter(|_| follows)
    }

    /// The phase of a contact that is closed, or open.
    fn contact(&self, part: usize, is_closed: bool) -> Phase {
        let own = self.expansion.primitives[self.parts[part]].origin.phases();
        let index = own.and_then(|own| {
            (0..own.names().len()).find(|&index| {
                let law = own.law(Phase { index, memory: 0.0 });
                matches!(law, PhaseLaw::Held(_)) == is_closed
            })
        });
        Phase { index: index.unwrap_or(0), memory: 0.0 }
    }

    /// By how much a contact is pressed beyond its level \[m\].
    fn beyond(&self, part: usize, position: &[f64]) -> f64 {
        let [a, b] = self.expansion.primitives[self.parts[part]].ends;
        position[a] - position[b] - self.level(part).unwrap_or(0.0)
    }

    /// Places of all joints with contacts in these phases. Sliders hold nothing here.
    fn balanced(&self, phases: &[Phase]) -> Result<Vec<f64>, NetworkErrors> {
        let mut expansion = self.expansion.at_rest(self.parts, phases);
        for primitive in &mut expansion.primitives {
            let [a, b] = primitive.ends;
            let is_slider = primitive.law == Law::Rigid
                && primitive.origin.phases().is_some_and(|own| !is_contact(own));
            let is_between_masses = !self.is_light(a) && !self.is_light(b) && !primitive.is_link;
            if is_slider || is_between_masses {
                primitive.law = Law::Spring(0.0);
            } else if primitive.slopes()[1] > 0.0 {
                primitive.held = self.before[a] - self.before[b];
                primitive.law = Law::Rigid;
            }
        }
        let bodies = Bodies::of(&self.held, &expansion).map_err(|found| self.refused(&found))?;
        let structure = Structure::of(&self.held, &expansion, &bodies, self.duration);
        let structure = structure.map_err(|found| self.refused(&found))?;
        let given = |body: &Body| match body.role {
            Role::Prescribed(node) => self.after[node] - bodies.offset[node],
            Role::Fixed => 0.0,
            _ => self.before[body.joints[0]] - bodies.offset[body.joints[0]],
        };
        let given: Vec<f64> = bodies.all.iter().map(given).collect();
        let weights = vec![0.0; bodies.all.len()];
        let places = balance::positions(
            &self.held,
            &expansion,
            &bodies,
            &structure,
            &weights,
            &Surroundings { given: &given, touches: &[], unbalanced: UNBALANCED },
        );
        let places = places.map_err(|found| self.refused(&found))?;
        let place = |joint: usize| places[bodies.of_joint[joint]] + bodies.offset[joint];
        Ok((0..self.expansion.joints).map(place).collect())
    }

    /// Refuses jumps that reach what remembers or slides: where that ends follows from the way there.
    fn check_others(&self, position: &[f64]) -> Result<(), NetworkErrors> {
        let near = near(position);
        let is_deformed = |&&at: &&usize| {
            let primitive = &self.expansion.primitives[at];
            let [a, b] = primitive.ends;
            let way = position[a] - position[b] - (self.before[a] - self.before[b]);
            // Between what is given, the deformation is given, too, and places between sliders matter to nothing.
            let follows = self.is_light(a) || self.is_light(b);
            let is_slider = primitive.origin.phases().and_then(Phases::capacity).is_some();
            let matters = follows && (!is_slider || self.reaches_mass(a) || self.reaches_mass(b));
            matters && !primitive.origin.phases().is_none_or(is_contact) && way.abs() > near
        };
        match self.parts.iter().find(is_deformed) {
            None => Ok(()),
            Some(_) => Err(self.through_contact()),
        }
    }

    /// Whether a joint follows jumps at once.
    fn is_light(&self, joint: usize) -> bool {
        self.apart.all[self.apart.of_joint[joint]].is_massless()
    }

    /// Whether a joint is of a mass, or joined to one by what moves freely.
    fn reaches_mass(&self, joint: usize) -> bool {
        let bodies = &self.apart.all;
        let is_free = |body: usize| matches!(bodies[body].role, Role::Mass(_) | Role::Massless);
        let mut groups = Groups::new(bodies.len());
        for primitive in &self.expansion.primitives {
            let [a, b] = primitive.ends.map(|joint| self.apart.of_joint[joint]);
            if is_free(a) && is_free(b) {
                groups.join(a, b);
            }
        }
        let own = groups.of(self.apart.of_joint[joint]);
        let is_mass = |&at: &usize| matches!(bodies[at].role, Role::Mass(_));
        (0..bodies.len()).filter(is_mass).any(|at| groups.of(at) == own)
    }

    /// Whether a joint is moved by forces, at once or as a mass.
    fn is_moved(&self, joint: usize) -> bool {
        let role = self.apart.all[self.apart.of_joint[joint]].role;
        !matches!(role, Role::Fixed | Role::Prescribed(_))
    }

    /// Refuses jumps of motions across a dashpot alone; a mass begins where it is, and has not come there.
    fn check_dashpots(&self) -> Result<(), NetworkErrors> {
        let is_mass =
            |joint: usize| matches!(self.apart.all[self.apart.of_joint[joint]].role, Role::Mass(_));
        let way = |joint: usize| {
            if is_mass(joint) { 0.0 } else { self.after[joint] - self.before[joint] }
        };
        for primitive in
            self.expansion.primitives.iter().filter(|primitive| primitive.slopes()[1] > 0.0)
        {
            let [a, b] = primitive.ends;
            let is_moved = [a, b].into_iter().any(|joint| self.is_moved(joint));
            if is_moved && !self.is_light(a) && !self.is_light(b) && way(a) - way(b) != 0.0 {
                let (node, other) = if way(a) == 0.0 { (b, a) } else { (a, b) };
                let [node, other] =
                    [node, other].map(|at| joint_name(self.network, self.expansion, at));
                return Err(NetworkError::StepAcrossDashpots { node, other, time: 0.0 }.into());
            }
        }
        Ok(())
    }

    /// What is to be said where masses and motions would be joined.
    fn refused(&self, found: &[NetworkError]) -> NetworkErrors {
        let name = |node: usize| &self.network.nodes[node].name;
        let contradiction = found.iter().find_map(|error| match error {
            NetworkError::ContradictingMotions { first, second, .. } => {
                let jumped = self.jumped.iter().map(|&node| name(node));
                let own = jumped.clone().find(|own| *own == first || *own == second);
                let own = own.or_else(|| jumped.clone().next())?;
                Some((own.clone(), if own == first { second.clone() } else { first.clone() }))
            }
            _ => None,
        });
        match contradiction {
            Some((node, _)) if self.is_placed(&node) => {
                NetworkError::StartPosition { node, reason: DASHPOTS_IN_A_ROW }.into()
            }
            Some((node, other)) => {
                NetworkError::StepAcrossDashpots { node, other, time: 0.0 }.into()
            }
            None => self.through_contact(),
        }
    }

    fn through_contact(&self) -> NetworkErrors {
        let node = self.network.nodes[self.jumped[0]].name.clone();
        if self.is_placed(&node) {
            return NetworkError::StartPosition { node, reason: THROUGH_CONTACT }.into();
        }
        NetworkError::StepThroughContact { node, time: 0.0 }.into()
    }

    /// Whether the node of this name is a mass with a position of its own.
    fn is_placed(&self, name: &str) -> bool {
        self.network.nodes.iter().any(|node| node.name == name && node.position != 0.0)
    }
}
