//! The system of a network in which nothing switches, or of one combination of phases.

use std::collections::BTreeMap;

use dashpot_dae::System;

use super::bodies::Role;
use super::{
    balance::{self, Surroundings, UNBALANCED},
    bodies::{Bodies, joint_name},
    drives::{self, Drive},
    expand::Expansion,
    incidence::Incidence,
    laws,
    motion::{self, Motion},
    nonlinear_forces,
    outputs::Outputs,
    parts::Parts,
    rates, review,
    row::{Row, RowSum, Rows, Scalar},
    scales::{Drives, Force, Scales},
    structure::{Numbers, Structure},
    system::{self, Scaling},
    transfer::Transfer,
    unknowns::{self, Inputs, Places},
};
use crate::{
    elements::Law,
    error::{NetworkError, NetworkErrors},
    network::Network,
    outputs::{ConnectionOutputs, DriveOutputs, NodeOutputs, PrimitiveOutputs},
    warning::NetworkWarning,
};

/// A compiled network, with what leads from it to its other phases.
pub(super) struct Compiled {
    pub(super) system: System,
    pub(super) nodes: Vec<NodeOutputs>,
    pub(super) connections: Vec<ConnectionOutputs>,
    pub(super) primitives: Vec<PrimitiveOutputs>,
    pub(super) drives: Vec<DriveOutputs>,
    pub(super) warnings: Vec<NetworkWarning>,
    pub(super) transfer: Option<Transfer>,
    /// See [`Structure::kinks`].
    pub(super) kinks: Vec<f64>,
}

/// Why nothing tells where what is between masses begins.
pub(super) const DASHPOTS_IN_A_ROW: &str = "dashpots in a row lead from it elsewhere, and nothing tells how far each has given way: \
                                 give a mass to what is between them, with its own `position`";

/// The graph of a network, and the scales of what moves in it.
pub(super) struct Graph<'n> {
    pub(super) network: &'n Network,
    pub(super) expansion: &'n Expansion,
    pub(super) bodies: Bodies,
    pub(super) structure: Structure,
    pub(super) scales: Scales,
}

/// The system of the primitives as they stand in `expansion`; none of them switches.
pub(super) fn assemble(
    network: &Network,
    expansion: &Expansion,
    duration: f64,
) -> Result<Compiled, NetworkErrors> {
    let bodies = Bodies::of(network, expansion).map_err(NetworkErrors)?;
    let structure = Structure::of(network, expansion, &bodies, duration).map_err(NetworkErrors)?;
    let mut inputs = Inputs::default();
    let mut sizes = Drives::default();
    let motions = drives::motions(network, &bodies, duration, &mut inputs, &mut sizes);
    let drives = drives::drives(network, &bodies, &motions, duration, &mut inputs, &mut sizes);
    for primitive in expansion.primitives.iter().filter(|primitive| primitive.push != 0.0) {
        let ends = primitive.ends.map(|joint| bodies.of_joint[joint]);
        let largest = primitive.push.abs();
        let impulse = largest * duration;
        sizes.forces.extend(ends.map(|body| Force { body, largest, impulse }));
    }
    let displaced = bodies.all.iter().enumerate().filter(|own| own.1.position != 0.0);
    sizes.motions.extend(displaced.map(|(body, own)| (body, own.position.abs())));
    let scales = Scales::of(&bodies, &structure, &sizes, duration, expansion.switches)?;
    let graph = Graph { network, expansion, bodies, structure, scales };
    let mut loads = vec![RowSum::default(); graph.bodies.all.len()];
    for drive in &drives {
        if let Some(force) = &drive.force {
            loads[drive.body].add(1.0, force);
        }
    }
    let numbers = Numbers { slope: &|edge| edge.constant.into(), mass: &|_, mass| mass.into() };
    let (mut places, mut motion) = graph.equations(numbers, loads, &motions, &mut inputs);
    nonlinear_forces::complete(expansion, &motion, &mut places);
    rates::complete(expansion, graph.scales.time, &mut inputs, &mut places, &mut motion);
    if !expansion.switches {
        graph.start(&drives, &inputs, &mut places)?;
    }
    graph.complete(&drives, (&motion, &mut places, &mut inputs), duration)
}

impl Graph<'_> {
    /// The unknowns, and the rows that rule them, under `loads` on the bodies, but for the balances of laws that are not
    /// linear.
    pub(super) fn equations<T: Scalar>(
        &self,
        numbers: Numbers<'_, T>,
        mut loads: Vec<RowSum<T>>,
        motions: &BTreeMap<usize, Row<T>>,
        inputs: &mut Inputs,
    ) -> (Places<T>, Motion<T>) {
        let Self { network, expansion, bodies, structure, scales } = self;
        let mut places =
            unknowns::choose(network, expansion, bodies, structure, scales, motions, inputs);
        let nonlinear = nonlinear_forces::add(
            expansion,
            bodies,
            structure,
            scales,
            inputs,
            &mut places,
            &mut loads,
        );
        let given = motion::Given {
            numbers,
            primitives: &expansion.primitives,
            nonlinear: &nonlinear,
            bodies,
            structure,
            scales,
            names: &|body| joint_name(network, expansion, bodies.all[body].joints[0]),
        };
        let motion = motion::build(&given, loads, inputs, &mut places);
        (places, motion)
    }

    /// The dimensionless system and where everything is found in it.
    fn complete(
        self,
        drives: &[Drive],
        (motion, places, inputs): (&Motion, &mut Places, &mut Inputs),
        duration: f64,
    ) -> Result<Compiled, NetworkErrors> {
        let Self { network, expansion, ref bodies, mut structure, ref scales } = self;
        let mut offsets = Rows::default();
        for (joint, &offset) in bodies.offset.iter().enumerate().filter(|own| *own.1 != 0.0) {
            offsets.set(joint, &inputs.constant(offset));
        }
        let scaling = Scaling::of(places, inputs, scales, duration);
        let least_dashpots = laws::least_dashpots(expansion, bodies);
        let mut system = system::dimensionless(
            expansion,
            &least_dashpots,
            motion,
            places,
            inputs,
            &scaling,
            duration,
        )?;
        if !expansion.switches && !expansion.primitives.iter().any(|own| own.law == Law::Rigid) {
            // Only rigid links and other phases go by them: a ninth of what a large network holds here.
            *places = Places::default();
            (structure.springs, structure.dashpots) = Default::default();
        }
        let mass = |joint: usize| network.nodes.get(joint).map_or(0.0, |node| node.mass);
        let masses: Vec<f64> = (0..expansion.joints).map(mass).collect();
        let parts = Parts {
            expansion,
            bodies,
            structure: &structure,
            motion,
            places,
            drives,
            incidence: &Incidence::of(expansion, drives),
            offsets: &offsets,
            masses: &masses,
        };
        let Outputs { list, nodes, connections, primitives, drives, .. } =
            Outputs::of(network, &parts, &scaling)?;
        system.outputs = list;
        let warnings = review::warnings(network, &parts);
        let transfer = expansion.switches.then(|| Transfer::of(&parts, inputs, &system, duration));
        let kinks = structure.kinks;
        Ok(Compiled { system, nodes, connections, primitives, drives, warnings, transfer, kinks })
    }

    /// Sets the initial positions where masses begin displaced. What dashpots hold to one of them begins beside it.
    /// Errors: [`NetworkError::StartPosition`] where dashpots in a row lead from one place to another: which of them
    /// has given way does not follow from the places of the masses.
    fn displace(&self, places: &mut Places) -> Result<(), NetworkErrors> {
        let Self { network, bodies, structure, .. } = self;
        let mut position: Vec<f64> = bodies.all.iter().map(|body| body.position).collect();
        let Some(first) = network.nodes.iter().find(|node| node.position != 0.0) else {
            return Ok(());
        };
        for cluster in &structure.clusters {
            let mut anchors = cluster.anchors.iter().map(|&body| position[body]);
            let place = anchors.next().unwrap_or(0.0);
            if anchors.any(|other| (other - place).abs() > 0.0) {
                let displaced = cluster.anchors.iter().flat_map(|&body| &bodies.all[body].joints);
                let mut displaced = displaced.filter_map(|&joint| network.nodes.get(joint));
                let node =
                    displaced.find(|node| node.position != 0.0).unwrap_or(first).name.clone();
                return Err(NetworkError::StartPosition { node, reason: DASHPOTS_IN_A_ROW }.into());
            }
            cluster.bodies.iter().for_each(|&body| position[body] = place);
        }
        for body in 0..bodies.all.len() {
            if let Some(unknown) = places.unknown[body] {
                let base = places.parent[body].map_or(0.0, |parent| position[parent]);
                places.drafts[unknown].initial = position[body] - base;
            }
        }
        Ok(())
    }

    /// Sets the initial positions where parts begin in balance.
    fn start(
        &self,
        drives: &[Drive],
        inputs: &Inputs,
        places: &mut Places,
    ) -> Result<(), NetworkErrors> {
        let Self { network, expansion, bodies, structure, .. } = self;
        if !network.effects.iter().any(|effect| effect.starts_in_balance()) {
            return self.displace(places);
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
        let positions = balance::positions(
            network,
            expansion,
            bodies,
            structure,
            &weights,
            &Surroundings { given: &given, touches: &[], unbalanced: UNBALANCED },
        )
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
