//! From network to system.
//!
//! Models are expanded into primitives between joints ([`expand`]), rigid links merge joints into
//! bodies ([`bodies`]), and the graph says which bodies have rates of their own and which follow
//! from balances ([`structure`]). Bodies are counted from each other along springs and dashpots
//! ([`tree`]). Balances are solved by star–mesh elimination ([`mesh`]), never by subtracting from a
//! diagonal, and rows have twice the digits of a double ([`form`]) until they are complete. They are
//! in SI; `system` rounds them and makes them dimensionless.

mod accelerometers;
mod balance;
mod beyond;
pub(crate) mod bodies;
mod constraint_forces;
mod dashpots;
pub(crate) mod expand;
mod incidence;
mod inner_pads;
mod laws;
mod mesh;
mod motion;
mod outputs;
pub(crate) mod parametric;
pub(crate) mod phased;
mod pushes;
mod rates;
mod review;
mod row;
mod scales;
mod segments;
mod sides;
pub(crate) mod size;
mod sliders;
mod speeds;
mod springs;
mod structure;
mod system;
mod transfer;
mod tree;
mod unknowns;
pub(crate) mod validate;

#[cfg(test)]
mod tests;

use std::{borrow::Cow, collections::BTreeMap};

use dashpot_dae::Waveform;

pub use self::beyond::{HeldTable, Unsaid};
use self::{
    bodies::{Bodies, Role, joint_name},
    expand::Expansion,
    incidence::Incidence,
    motion::Motion,
    outputs::Outputs,
    row::{Row, RowSum, Rows},
    scales::{Drives, Force, Scales},
    size::Size,
    structure::Structure,
    system::Scaling,
    transfer::Transfer,
    unknowns::{Inputs, Places},
};
use crate::{Assembly, Network, NetworkErrors, Source, Support, effects, layers};

/// What acts on a body from outside.
#[derive(Debug, Clone)]
struct Drive {
    name: String,
    source: Source,
    node: usize,
    body: usize,
    /// The force \[N\]; `None` where the motion is given.
    force: Option<Row>,
    /// Mass times acceleration \[N\] of a body with given motion.
    inertia: Row,
    /// Whether an accelerometer does not feel it.
    is_body_force: bool,
    /// When the given motion jumps \[s\].
    jumps: Vec<f64>,
}

/// Everything that has been found out, for those that report it.
struct Parts<'a> {
    expansion: &'a Expansion,
    bodies: &'a Bodies,
    structure: &'a Structure,
    motion: &'a Motion,
    places: &'a Places,
    drives: &'a [Drive],
    incidence: &'a Incidence,
    /// How far each joint is from the place of its body.
    offsets: &'a Rows,
    /// Own mass of each joint \[kg\].
    masses: &'a [f64],
}

/// A compiled network, with what leads from it to its other phases.
struct Compiled {
    assembly: Assembly,
    transfer: Option<Transfer>,
    /// See [`Structure::kinks`].
    kinks: Vec<f64>,
}

impl Network {
    /// Turns the network into a dimensionless, semi-explicit system of index 1 for a run of
    /// `duration` \[s\].
    ///
    /// # Errors
    ///
    /// All that is wrong with the network, by name: [`NetworkErrors`] of its names and numbers, or
    /// else of its topology.
    pub fn compile(&self, duration: f64) -> Result<Assembly, NetworkErrors> {
        let network = self.with_effects()?;
        let expansion = Expansion::of(&network);
        let faults = validate::faults(&network, &expansion);
        if !faults.is_empty() {
            return Err(NetworkErrors(faults));
        }
        let held = beyond::held(self, duration)?;
        let expansion = expansion.of_size(Size::of(&network, duration));
        let (parts, pads) = (expansion.phased(), network.pads.clone());
        let mut assembly = if parts.is_empty() {
            network.assemble(&expansion, duration)?.assembly
        } else {
            phased::compile(network.into_owned(), expansion, parts, duration)?
        };
        assembly.warnings.extend(layers::warnings(self, duration));
        assembly.held = held;
        assembly.pads = pads;
        Ok(assembly)
    }

    /// The network with the nodes and elements that its effects and layers put into it, as it is
    /// compiled.
    ///
    /// # Errors
    ///
    /// What keeps an effect or a layer from having a place in the network.
    pub fn with_effects(&self) -> Result<Cow<'_, Self>, NetworkErrors> {
        if !effects::rewrites(self) {
            return Ok(Cow::Borrowed(self));
        }
        let mut network = self.clone();
        effects::rewrite(&mut network)?;
        Ok(Cow::Owned(network))
    }

    /// The system of the primitives as they stand in `expansion`; none of them switches.
    fn assemble(&self, expansion: &Expansion, duration: f64) -> Result<Compiled, NetworkErrors> {
        let bodies = Bodies::of(self, expansion).map_err(NetworkErrors)?;
        let structure = Structure::of(self, expansion, &bodies, duration).map_err(NetworkErrors)?;

        let mut inputs = Inputs::default();
        let mut sizes = Drives::default();
        let motions = self.motions(&bodies, duration, &mut inputs, &mut sizes);
        let drives = self.drives(&bodies, &motions, duration, &mut inputs, &mut sizes);
        for primitive in expansion.primitives.iter().filter(|primitive| primitive.push != 0.0) {
            let ends = primitive.ends.map(|joint| bodies.of_joint[joint]);
            let largest = primitive.push.abs();
            let impulse = largest * duration;
            sizes.forces.extend(ends.map(|body| Force { body, largest, impulse }));
        }
        let scales = Scales::of(&bodies, &structure, &sizes, duration, expansion.switches)?;

        let mut loads = vec![RowSum::default(); bodies.all.len()];
        for drive in &drives {
            if let Some(force) = &drive.force {
                loads[drive.body].add(1.0, force);
            }
        }
        let mut places =
            unknowns::choose(self, expansion, &bodies, &structure, &scales, &motions, &mut inputs);
        let pushes = pushes::add(
            expansion,
            &bodies,
            &structure,
            &scales,
            &mut inputs,
            &mut places,
            &mut loads,
        );
        let mut motion = motion::build(
            &motion::Given {
                primitives: &expansion.primitives,
                pushes: &pushes,
                bodies: &bodies,
                structure: &structure,
                scales: &scales,
                names: &|body| joint_name(self, expansion, bodies.all[body].joints[0]),
            },
            loads,
            &mut inputs,
            &mut places,
        );
        drop(pushes);
        pushes::complete(expansion, &motion, &mut places);
        rates::complete(expansion, scales.time, &mut inputs, &mut places, &mut motion);
        if !expansion.switches {
            self.start(expansion, &bodies, &structure, &drives, &inputs, &mut places)?;
        }

        let mut offsets = Rows::default();
        for (joint, &offset) in bodies.offset.iter().enumerate().filter(|own| *own.1 != 0.0) {
            offsets.set(joint, &inputs.constant(offset));
        }
        let scaling = Scaling::of(&places, &inputs, &scales, duration);
        let mut system = system::dimensionless(
            expansion,
            &laws::least_dashpots(expansion, &bodies),
            &motion,
            &mut places,
            &inputs,
            &scaling,
            duration,
        )?;
        let masses: Vec<f64> = (0..expansion.joints)
            .map(|joint| self.nodes.get(joint).map_or(0.0, |node| node.mass))
            .collect();
        let parts = Parts {
            expansion,
            bodies: &bodies,
            structure: &structure,
            motion: &motion,
            places: &places,
            drives: &drives,
            incidence: &Incidence::of(expansion, &drives),
            offsets: &offsets,
            masses: &masses,
        };
        let Outputs { list, nodes, connections, primitives, drives: driven, .. } =
            Outputs::of(self, &parts, &scaling)?;
        system.outputs = list;
        let warnings = review::warnings(self, &parts);
        let transfer = expansion.switches.then(|| Transfer::of(&parts, &inputs, &system, duration));
        let assembly = Assembly {
            system,
            nodes,
            connections,
            primitives,
            drives: driven,
            pads: Vec::new(),
            warnings,
            held: Vec::new(),
            switching: None,
        };
        Ok(Compiled { assembly, transfer, kinks: structure.kinks })
    }

    /// The given displacements of bodies as rows.
    fn motions(
        &self,
        bodies: &Bodies,
        duration: f64,
        inputs: &mut Inputs,
        sizes: &mut Drives,
    ) -> BTreeMap<usize, Row> {
        let mut motions = BTreeMap::new();
        for (at, body) in bodies.all.iter().enumerate() {
            let Role::Prescribed(node) = body.role else { continue };
            if let Support::Prescribed(motion) = &self.nodes[node].support {
                sizes.motions.push((at, motion.bound(duration)));
                let waveform = inputs.waveform(motion.clone());
                motions.insert(at, inputs.row(waveform, 0));
            }
        }
        motions
    }

    /// Loads, body forces and given motions, in this order.
    fn drives(
        &self,
        bodies: &Bodies,
        motions: &BTreeMap<usize, Row>,
        duration: f64,
        inputs: &mut Inputs,
        sizes: &mut Drives,
    ) -> Vec<Drive> {
        let mut drives = Vec::new();
        let mut force = |name: String, node: usize, force: Waveform, source: Source| {
            let body = bodies.of_joint[node];
            let (largest, impulse) = (force.bound(duration), force.area_bound(duration));
            sizes.forces.push(Force { body, largest, impulse });
            let waveform = inputs.waveform(force);
            let force = Some(inputs.row(waveform, 0));
            drives.push(Drive {
                name,
                source,
                node,
                body,
                force,
                inertia: Row::default(),
                is_body_force: matches!(source, Source::Effect(_)),
                jumps: Vec::new(),
            });
        };
        for load in &self.loads {
            force(load.name.clone(), load.node.0, load.force.clone(), Source::Load);
        }
        for effect in &self.effects {
            for (node, weight) in effect.body_forces(self) {
                if weight.bound(duration) > 0.0 {
                    let name = format!("{} on {}", effect.kind(), self.nodes[node.0].name);
                    force(name, node.0, weight, Source::Effect(effect.kind()));
                }
            }
        }
        for (at, body) in bodies.all.iter().enumerate() {
            let Role::Prescribed(node) = body.role else { continue };
            if let Support::Prescribed(motion) = &self.nodes[node].support {
                let mass = body.whole_mass;
                let inertia = match motions.get(&at) {
                    Some(row) if mass > 0.0 => {
                        let velocity = inputs.rate(row);
                        inputs.rate(&velocity).times(mass)
                    }
                    _ => Row::default(),
                };
                drives.push(Drive {
                    inertia,
                    name: format!("motion of {}", self.nodes[node].name),
                    source: Source::Motion,
                    node,
                    body: at,
                    force: None,
                    is_body_force: false,
                    jumps: structure::jumps(self, motion, duration),
                });
            }
        }
        drives
    }

    /// Sets the initial positions where parts begin in balance.
    fn start(
        &self,
        expansion: &Expansion,
        bodies: &Bodies,
        structure: &Structure,
        drives: &[Drive],
        inputs: &Inputs,
        places: &mut Places,
    ) -> Result<(), NetworkErrors> {
        if !self.effects.iter().any(|effect| effect.starts_in_balance()) {
            return Ok(());
        }
        let at_start: Vec<f64> = inputs
            .entries
            .iter()
            .map(|input| {
                inputs.waveforms[input.waveform].piece_at(0.0).derivative(input.derivative, 0.0)
            })
            .collect();
        let mut weights = vec![0.0; bodies.all.len()];
        for drive in drives.iter().filter(|drive| drive.is_body_force) {
            let body = &bodies.all[drive.body];
            if let Some(force) = drive.force.as_ref().filter(|_| !body.is_impactor) {
                weights[drive.body] += force.inputs.at(&at_start);
            }
        }
        let given: Vec<f64> = bodies
            .all
            .iter()
            .enumerate()
            .map(|(at, body)| match body.role {
                Role::Prescribed(_) => places.position.row(at).inputs.at(&at_start),
                _ => 0.0,
            })
            .collect();
        let positions =
            balance::positions(self, expansion, bodies, structure, &weights, &given, &[])
                .map_err(NetworkErrors)?;
        for body in 0..bodies.all.len() {
            if let Some(unknown) = places.unknown[body] {
                let base = places.parent[body].map_or(0.0, |parent| positions[parent]);
                places.drafts[unknown].initial = positions[body] - base;
            }
        }
        Ok(())
    }
}
