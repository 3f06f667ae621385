//! A solved run as the measures see it.

use std::{borrow::Cow, cell::OnceCell};

use dashpot_dae::{Signal, Trajectory};
use dashpot_network::{Assembly, ConnectionOutputs, NodeOutputs};

use crate::impact::Impact;

/// An assembly and a trajectory of it, with the signals that were asked for.
#[derive(Debug)]
pub struct Solution<'a> {
    assembly: &'a Assembly,
    trajectory: &'a Trajectory,
    signals: Vec<OnceCell<Signal>>,
    element_impacts: Vec<OnceCell<Impact>>,
    node_impacts: Vec<OnceCell<Impact>>,
    scene_impact: OnceCell<Impact>,
}

impl<'a> Solution<'a> {
    /// Looks at `trajectory`, which must be one of `assembly`.
    pub fn new(assembly: &'a Assembly, trajectory: &'a Trajectory) -> Self {
        let cells = |count: usize| (0..count).map(|_| OnceCell::new()).collect();
        Self {
            assembly,
            trajectory,
            signals: (0..assembly.system.outputs.len()).map(|_| OnceCell::new()).collect(),
            element_impacts: cells(assembly.connections.len()),
            node_impacts: cells(assembly.nodes.len()),
            scene_impact: OnceCell::new(),
        }
    }

    /// The network's equations.
    pub fn assembly(&self) -> &'a Assembly {
        self.assembly
    }

    /// The trajectory.
    pub fn trajectory(&self) -> &'a Trajectory {
        self.trajectory
    }

    /// End of the run \[s\].
    pub fn end(&self) -> f64 {
        self.trajectory.t_end
    }

    /// An output as a function of time.
    ///
    /// # Panics
    ///
    /// When the assembly has no such output.
    pub fn signal(&self, output: usize) -> &Signal {
        self.signals[output].get_or_init(|| self.trajectory.signal(&self.assembly.system, output))
    }

    /// The rate that belongs to a deformation: the output where there is one, else the derivative
    /// of the deformation, in which its jumps leave no trace.
    ///
    /// # Panics
    ///
    /// When the assembly has no such outputs.
    pub fn rate(&self, rate: Option<usize>, deformation: usize) -> Cow<'_, Signal> {
        match rate {
            Some(rate) => Cow::Borrowed(self.signal(rate)),
            None => Cow::Owned(self.signal(deformation).derivative()),
        }
    }

    /// The impact as the element number `element` feels it: that of its own force if it touches an
    /// impactor, else that of the scene.
    pub fn element_impact(&self, element: usize) -> Impact {
        *self.element_impacts[element].get_or_init(|| {
            let connection = &self.assembly.connections[element];
            match connection.force {
                Some(force) if self.touches_impactor(connection) => {
                    Impact::of_force(self.signal(force), self.end())
                }
                _ => self.scene_impact(),
            }
        })
    }

    /// The impact as the node number `node` feels it: that of the sum of the forces of the elements
    /// that touch it if it is an impactor, else that of the scene.
    pub fn node_impact(&self, node: usize) -> Impact {
        *self.node_impacts[node].get_or_init(|| {
            if !is_impactor(&self.assembly.nodes[node]) {
                return self.scene_impact();
            }
            let touching = |connection: &&ConnectionOutputs| {
                connection.between.iter().any(|end| end.index() == node)
            };
            let forces: Vec<&Signal> = self
                .assembly
                .connections
                .iter()
                .filter(touching)
                .filter_map(|connection| connection.force)
                .map(|force| self.signal(force))
                .collect();
            match forces.split_first() {
                None => Impact::unloaded(self.end()),
                Some((force, [])) => Impact::of_force(force, self.end()),
                Some((&first, rest)) => {
                    let sum = rest.iter().fold(first.clone(), |sum, force| sum.plus(force, 1.0));
                    Impact::of_force(&sum, self.end())
                }
            }
        })
    }

    /// The impact of the scene: from the first contact of any impactor until the last one is let
    /// go. Without an impactor it is the whole run.
    pub fn scene_impact(&self) -> Impact {
        *self.scene_impact.get_or_init(|| {
            let impactors = self.assembly.nodes.iter().enumerate();
            impactors
                .filter(|(_, node)| is_impactor(node))
                .map(|(at, _)| self.node_impact(at))
                .reduce(Impact::joined)
                .unwrap_or_else(|| Impact::without_impactor(self.end()))
        })
    }

    /// Whether the connection has an impactor at one of its ends.
    pub fn touches_impactor(&self, connection: &ConnectionOutputs) -> bool {
        connection.between.iter().any(|end| is_impactor(&self.assembly.nodes[end.index()]))
    }
}

/// Whether the node is a free mass that starts with a speed of its own.
pub fn is_impactor(node: &NodeOutputs) -> bool {
    node.free && node.mass > 0.0 && node.start_velocity.is_some()
}
