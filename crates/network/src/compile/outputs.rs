//! What the assembled system can report, by name.

use std::{collections::BTreeMap, sync::Arc};

use super::{
    accelerometers::Accelerometers,
    constraint_forces::rigid_forces,
    drives::Drive,
    expand::{Primitive, Shape},
    motion::Motion,
    parts::Parts,
    row::{Combination, Row, RowSum, Scalar},
    system::Scaling,
};
use crate::{
    ConnectionOutputs, DriveOutputs, Network, NetworkError, Node, NodeOutputs, PrimitiveOutputs,
    Support, elements::Law, network::start_velocity,
};

/// Where the outputs of primitives stand, by the number of the primitive; those that take no part have none.
pub(super) type Listed = BTreeMap<usize, usize>;

/// All outputs, dimensionless, and where they are found.
#[derive(Debug)]
pub(super) struct Outputs<'s> {
    scaling: &'s Scaling,
    /// The last name.
    name: String,
    /// One of them that is out of scale.
    fault: Option<NetworkError>,
    pub(super) list: dashpot_dae::Outputs,
    pub(super) nodes: Vec<NodeOutputs>,
    pub(super) connections: Vec<ConnectionOutputs>,
    pub(super) primitives: Vec<PrimitiveOutputs>,
    pub(super) drives: Vec<DriveOutputs>,
}

impl<'s> Outputs<'s> {
    /// All outputs. In a network that switches they are the same ones in all phases, whether or not
    /// a part takes part in a phase; rates that some phases do not know are left out.
    pub(super) fn of(
        network: &Network,
        parts: &Parts<'_>,
        scaling: &'s Scaling,
    ) -> Result<Self, NetworkError> {
        let mut outputs = Self {
            scaling,
            name: String::new(),
            fault: None,
            list: dashpot_dae::Outputs::new(),
            nodes: Vec::with_capacity(network.nodes.len()),
            connections: Vec::with_capacity(network.connections.len()),
            primitives: Vec::with_capacity(parts.expansion.primitives.len()),
            drives: Vec::with_capacity(parts.drives.len()),
        };
        outputs.add_nodes(network, parts);
        outputs.add_connections(network, parts)?;
        outputs.add_drives(network, parts);
        outputs.list.shrink_to_fit();
        outputs.fault.take().map_or(Ok(outputs), Err)
    }

    /// Adds an output, whose row is in SI units.
    pub(super) fn add(
        &mut self,
        owner: &str,
        quantity: &str,
        unit: &'static str,
        row: &Row,
    ) -> usize {
        match self.scaling.scaled(row) {
            Ok((scale, [unknowns, inputs])) => {
                self.name.clear();
                self.name.extend([owner, ".", quantity]);
                self.list.push(&self.name, unit, scale, &unknowns, &inputs)
            }
            Err(fault) => {
                self.fault = Some(fault);
                0
            }
        }
    }

    fn add_nodes(&mut self, network: &Network, parts: &Parts<'_>) {
        let mut accelerometers = Accelerometers::default();
        for (at, node) in network.nodes.iter().enumerate() {
            let body = parts.bodies.of_joint[at];
            let name = &node.name;
            let place = parts.motion.position.row(body).plus(1.0, &parts.offsets.row(at));
            let position = self.add(name, "position", "m", &place);
            let is_known = !parts.expansion.switches || moves_by_itself(node);
            let velocity = parts
                .motion
                .velocity
                .get(body)
                .filter(|_| is_known)
                .map(|row| self.add(name, "velocity", "m/s", &row));
            let acceleration = accelerometers
                .row(network, parts, at)
                .map(|row| self.add(name, "acceleration", "m/s^2", &row));
            self.nodes.push(NodeOutputs {
                name: name.clone(),
                mass: node.mass,
                start_velocity: node.is_impactor().then(|| start_velocity(network, node.start)),
                fall: 0.0,
                body,
                free: node.support == Support::Free,
                position,
                velocity,
                acceleration,
            });
        }
    }

    fn add_connections(
        &mut self,
        network: &Network,
        parts: &Parts<'_>,
    ) -> Result<(), NetworkError> {
        let constraint_forces = rigid_forces(network, parts);
        let primitives = &parts.expansion.primitives;
        let whole = |at: usize| match primitives[at].law {
            Law::Rigid => constraint_forces.get(&at).cloned(),
            _ => Some(parts.motion.force.row(at)),
        };
        let force = |at: usize| match primitives[at].share {
            Some(share) => whole(share.of).map(|row| row.times(share.part)),
            None => whole(at),
        };
        for (connection, shapes) in network.connections.iter().zip(&parts.expansion.shapes) {
            let first = self.primitives.len();
            let mut listed = Listed::new();
            for at in shapes.iter().filter_map(Shape::leaf) {
                let place = self.primitives.len();
                self.add_primitive(parts, &constraint_forces, at)?;
                if self.primitives.len() > place {
                    listed.insert(at, place);
                }
            }
            let deformation = |at: usize| Some(deformation(parts, at));
            let rate = |at: usize| {
                let is_known = !parts.motion.deformation.has(at);
                parts.motion.rate.get(at).or_else(|| is_known.then(Row::default))
            };
            let name = &connection.name;
            let ends = connection.between.map(|id| parts.bodies.of_joint[id.0]);
            let forces = composed(shapes, &force, &softest(primitives, parts.motion));
            let is_placed = |body: usize| parts.structure.algebraic_cluster(body).is_none();
            let [a, b] = ends;
            let position = if ends.iter().all(|&end| is_placed(end)) || parts.expansion.switches {
                let [p, q] = connection.between.map(|id| parts.offsets.row(id.0));
                let position = |body: usize| parts.motion.position.row(body);
                position(a).plus(-1.0, &position(b)).plus(1.0, &p).plus(-1.0, &q)
            } else {
                summed(shapes, &deformation).unwrap_or_default()
            };
            let velocity = match ends.map(|end| parts.motion.velocity.get(end)) {
                _ if parts.expansion.switches => None,
                [Some(va), Some(vb)] if ends.iter().all(|&end| is_placed(end)) => {
                    Some(va.plus(-1.0, &vb))
                }
                _ => summed(shapes, &rate),
            };
            // An element whose name says it all is its only part.
            let own = self.primitives[first..].iter().find(|own| *own.name == **name);
            let own = own.map(|own| (own.force, own.deformation));
            let force = match own {
                Some((force, _)) => Some(force),
                None => forces[0].clone().map(|row| self.add(name, "force", "N", &row)),
            };
            let deformation = match own {
                Some((_, deformation)) => deformation,
                None => self.add(name, "deformation", "m", &position),
            };
            let mut outputs = ConnectionOutputs {
                name: name.clone(),
                between: connection.between,
                thickness: connection.thickness,
                is_rigid: a == b,
                never_pulls: connection.never_pulls(0),
                force,
                transmitted: force,
                deformation,
                rate: velocity.map(|row| self.add(name, "rate", "m/s", &row)),
                primitives: first..self.primitives.len(),
                segments: Vec::new(),
                has_layers: connection.layers.is_some(),
                passage: connection.passage,
            };
            self.add_segments(parts, connection, (shapes, &forces, &listed), &mut outputs);
            self.connections.push(outputs);
        }
        Ok(())
    }

    /// A primitive that takes part; others have neither force nor energy.
    fn add_primitive(
        &mut self,
        parts: &Parts<'_>,
        constraint_forces: &BTreeMap<usize, Row>,
        at: usize,
    ) -> Result<(), NetworkError> {
        let own = &parts.expansion.primitives[at];
        // Of sliders side by side the first one stands for all.
        let at = own.share.map_or(at, |share| share.of);
        let turned = |row: Row| match own.share {
            Some(share) if share.sign() < 0.0 => row.times(-1.0),
            _ => row,
        };
        let primitive = &parts.expansion.primitives[at];
        let switches = parts.expansion.switches;
        let is_taking_part = parts.motion.force.has(at) && parts.motion.deformation.has(at);
        if !is_taking_part && (!switches || primitive.is_link) {
            return Ok(());
        }
        let name = &own.name;
        let force = match primitive.law {
            Law::Rigid => constraint_forces
                .get(&at)
                .cloned()
                .ok_or_else(|| NetworkError::UndeterminedForce { element: name.to_string() })?,
            _ => parts.motion.force.row(at),
        };
        let force = own.share.map_or_else(|| force.clone(), |share| force.times(share.part));
        let rate = if switches {
            let ends = primitive.ends.map(|joint| parts.bodies.of_joint[joint]);
            let is_still = ends[0] == ends[1] || !is_taking_part && !primitive.is_phased();
            let is_open = !is_taking_part && !is_still;
            let known = match ends.map(|end| parts.motion.velocity.get(end)) {
                _ if is_still => Some(Row::default()),
                _ if !is_open => parts.motion.rate.get(at),
                [Some(a), Some(b)] => Some(a.plus(-1.0, &b)),
                // Without force no work is done at whatever rate.
                _ => Some(Row::default()),
            };
            known.filter(|_| primitive.needs_rate())
        } else {
            parts.motion.rate.get(at)
        };
        if switches && primitive.needs_rate() && rate.is_none() {
            return Err(NetworkError::UndeterminedRate { element: name.to_string() });
        }
        let outputs = PrimitiveOutputs {
            name: Arc::clone(name),
            element: Arc::clone(&own.origin),
            force: self.add(name, "force", "N", &force),
            deformation: self.add(name, "deformation", "m", &turned(deformation(parts, at))),
            rate: rate.map(|row| self.add(name, "rate", "m/s", &turned(row))),
        };
        self.primitives.push(outputs);
        Ok(())
    }

    /// The drives, with the forces that hold those whose motion is given.
    fn add_drives(&mut self, network: &Network, parts: &Parts<'_>) {
        for drive in parts.drives {
            let velocity = parts.motion.velocity.get(drive.body);
            let switches = parts.expansion.switches;
            let is_known = !switches || moves_by_itself(&network.nodes[drive.node]);
            if velocity.is_none() && !switches {
                continue;
            }
            let velocity = velocity.filter(|_| is_known);
            let force = drive.force.clone().unwrap_or_else(|| held_force(parts, drive));
            if force.is_zero() && !switches {
                continue;
            }
            let name = drive.name.clone();
            let outputs = DriveOutputs {
                node: drive.node,
                source: drive.source,
                force: self.add(&name, "force", "N", &force),
                velocity: velocity.map(|row| self.add(&name, "velocity", "m/s", &row)),
                jumps: drive.jumps.clone(),
                name,
            };
            self.drives.push(outputs);
        }
    }
}

/// Whether a node has a velocity of its own in all phases of a network.
fn moves_by_itself(node: &Node) -> bool {
    node.mass > 0.0 || node.support != Support::Free
}

/// The deformation of a primitive; zero where it takes no part.
fn deformation(parts: &Parts<'_>, at: usize) -> Row {
    match parts.motion.deformation.get(at) {
        Some(deformation) => deformation,
        None if !parts.expansion.switches => Row::default(),
        None => {
            let [a, b] = parts.expansion.primitives[at].ends;
            let [p, q] = [a, b].map(|joint| parts.bodies.of_joint[joint]);
            let position = |body: usize| parts.motion.position.row(body);
            let [offset, other] = [a, b].map(|joint| parts.offsets.row(joint));
            position(p).plus(-1.0, &position(q)).plus(1.0, &offset).plus(-1.0, &other)
        }
    }
}

/// The force that keeps a body on its prescribed way: what accelerates it less what acts on it.
fn held_force(parts: &Parts<'_>, drive: &Drive) -> Row {
    let mut sum = RowSum::from(&drive.inertia);
    sum.add(-1.0, &parts.contact_force(drive.body));
    for other in
        parts.incidence.drives(parts.drives, drive.body).filter(|drive| drive.is_body_force)
    {
        if let Some(weight) = &other.force {
            sum.add(-1.0, weight);
        }
    }
    sum.total()
}

/// Combines the rows of the parts from the leaves to the root, one for each shape: in parallel they
/// are added, in series the one that `prefer` ranks lowest stands for all.
pub(super) fn composed<T: Scalar>(
    shapes: &[Shape],
    row: &impl Fn(usize) -> Option<Row<T>>,
    prefer: &impl Fn(usize) -> f64,
) -> Vec<Option<Row<T>>> {
    let mut found: Vec<(Option<Row<T>>, f64)> = vec![(None, f64::INFINITY); shapes.len()];
    for (at, shape) in shapes.iter().enumerate().rev() {
        found[at] = match shape {
            Shape::Leaf(primitive) => (row(*primitive), prefer(*primitive)),
            Shape::Series(children) => children
                .clone()
                .map(|child| (found[child].0.clone(), found[child].1))
                .min_by(|a, b| a.0.is_none().cmp(&b.0.is_none()).then(a.1.total_cmp(&b.1)))
                .unwrap_or((None, f64::INFINITY)),
            // The force on the impactor's side.
            Shape::Row(children) => {
                children.clone().next().map_or((None, f64::INFINITY), |child| found[child].clone())
            }
            Shape::Parallel(children) => {
                let rows: Option<Vec<&Row<T>>> =
                    children.clone().map(|child| found[child].0.as_ref()).collect();
                let rank = children.clone().map(|child| found[child].1).fold(0.0, f64::max);
                (rows.map(|rows| total(&rows)), rank)
            }
        };
    }
    found.into_iter().map(|(row, _)| row).collect()
}

/// Sums the rows of parts in series; in parallel the first one stands for all.
fn summed(shapes: &[Shape], row: &impl Fn(usize) -> Option<Row>) -> Option<Row> {
    let mut found: Vec<Option<Row>> = vec![None; shapes.len()];
    for (at, shape) in shapes.iter().enumerate().rev() {
        found[at] = match shape {
            Shape::Leaf(primitive) => row(*primitive),
            Shape::Series(children) | Shape::Row(children) => children
                .clone()
                .map(|child| found[child].as_ref())
                .collect::<Option<Vec<&Row>>>()
                .map(|rows| total(&rows)),
            Shape::Parallel(children) => {
                children.clone().next().and_then(|child| found[child].clone())
            }
        };
    }
    found.swap_remove(0)
}

pub(super) fn total<T: Scalar>(rows: &[&Row<T>]) -> Row<T> {
    let mut sum = RowSum::default();
    rows.iter().for_each(|row| sum.add(1.0, row));
    sum.total()
}

/// Rank of a primitive whose force is to stand for a series: what takes no part first (then the
/// force is zero), springs by stiffness, dashpots behind them, rigid links last.
pub(super) fn softest<T: Scalar>(
    primitives: &[Primitive],
    motion: &Motion<T>,
) -> impl Fn(usize) -> f64 {
    move |at: usize| match primitives[at].law {
        Law::Rigid => f64::INFINITY,
        _ if !motion.force.has(at) => -1.0,
        Law::Spring(stiffness) => stiffness,
        Law::Nonlinear { stiffness, .. } if stiffness > 0.0 => stiffness,
        _ => f64::MAX,
    }
}
