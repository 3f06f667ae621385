//! The balance of each mass and each element, slice by slice.

use std::{borrow::Cow, collections::HashMap, ops::Range};

use dashpot_dae::Signal;
use dashpot_network::Assembly;

use super::Place;
use crate::{
    Solution,
    energy::{
        ledger::{does_work, steps},
        roles::EnergyRole,
    },
    impact::contacts,
};

/// Part of the run within which times of jumps are one.
const CLOSE: f64 = 1e-10;

/// What each body and each element misses \[J\] within some cells, and each body in momentum
/// \[N s\]. The cells are slices of time, with the instants between them.
pub(super) struct Parts<'a> {
    solution: &'a Solution<'a>,
    times: &'a [f64],
    cells: Range<usize>,
    totals: Vec<f64>,
    bodies: Vec<f64>,
    momenta: Vec<f64>,
    elements: Vec<f64>,
    /// The element to which a body within a pad belongs.
    within: HashMap<usize, usize>,
}

/// How many cells the rising `times` divide a run into.
pub(super) fn count(times: &[f64]) -> usize {
    (2 * times.len()).saturating_sub(3)
}

impl<'a> Parts<'a> {
    /// Makes up all balances over these of the cells that the rising `times` divide the run into.
    pub(super) fn balance(
        solution: &'a Solution<'a>,
        times: &'a [f64],
        cells: Range<usize>,
    ) -> Self {
        let assembly = solution.assembly();
        let mut parts = Self {
            solution,
            times,
            cells,
            totals: vec![0.0; count(times)],
            bodies: vec![0.0; contacts::count(assembly)],
            momenta: vec![0.0; contacts::count(assembly)],
            elements: vec![0.0; assembly.connections.len()],
            within: within(assembly),
        };
        for at in 0..assembly.connections.len() {
            parts.ends(at);
            parts.inside(at);
        }
        for drive in &assembly.drives {
            let node = &assembly.nodes[drive.node];
            let velocity = solution.rate(drive.velocity, node.position);
            parts.push(node.body, None, (1.0, solution.signal(drive.force)), &velocity);
        }
        for body in 0..parts.bodies.len() {
            parts.inertia(body);
        }
        parts.impacts();
        parts
    }

    /// What is missing in each cell \[J\].
    pub(super) fn totals(&self) -> &[f64] {
        &self.totals
    }

    /// The part that misses most in the way of `sign`, how much \[J\], and the momentum \[N s\]
    /// that it gains beyond the impulse of all forces if it is a mass.
    pub(super) fn largest(&self, sign: f64) -> Option<(Place, f64, Option<f64>)> {
        let most = |all: &[f64]| {
            let all = all.iter().copied().enumerate();
            all.max_by(|one, other| (sign * one.1).total_cmp(&(sign * other.1)))
        };
        let is_instant = self.cells.len() == 1 && self.cells.start % 2 == 1;
        let body = most(&self.bodies);
        match most(&self.elements) {
            Some((at, missing)) if body.is_none_or(|body| sign * missing > sign * body.1) => {
                let name = self.solution.assembly().connections[at].name.clone();
                let place = if is_instant { Place::Impact(name) } else { Place::Element(name) };
                Some((place, missing, None))
            }
            _ => {
                let (body, missing) = body?;
                let place = Place::Node(self.node_of(body)?.to_owned());
                Some((place, missing, Some(self.momenta[body])))
            }
        }
    }

    /// The heaviest node of a body.
    fn node_of(&self, body: usize) -> Option<&str> {
        let own = self.solution.assembly().nodes.iter().filter(|node| node.body == body);
        own.max_by(|one, other| one.mass.total_cmp(&other.mass)).map(|node| node.name.as_str())
    }

    /// The slices of time among the cells.
    fn slices(&self) -> impl Iterator<Item = (usize, (f64, f64))> + use<'a> {
        let cells = self.cells.clone();
        let all = self.times.windows(2).enumerate().map(|(at, pair)| (2 * at, (pair[0], pair[1])));
        let begin = cells.start.div_ceil(2);
        all.skip(begin).take_while(move |(cell, _)| cells.contains(cell))
    }

    /// The instants between slices among the cells.
    fn instants(&self) -> impl Iterator<Item = (usize, f64)> + use<'a> {
        let cells = self.cells.clone();
        let inner = self.times.get(1..self.times.len().saturating_sub(1)).unwrap_or_default();
        let all = inner.iter().enumerate().map(|(at, time)| (2 * at + 1, *time));
        all.skip(cells.start / 2).take_while(move |(cell, _)| cells.contains(cell))
    }

    /// The velocity of a body, where it does not follow from algebraic unknowns that are kept, else
    /// the derivative of its position.
    fn velocity(&self, body: usize) -> Cow<'a, Signal> {
        let nodes = &self.solution.assembly().nodes;
        let own = || nodes.iter().filter(|node| node.body == body);
        match own().find_map(|node| node.velocity) {
            Some(velocity) => Cow::Borrowed(self.solution.signal(velocity)),
            None => match own().next() {
                Some(node) => self.solution.rate(None, node.position),
                None => Cow::Owned(Signal::new(Vec::new(), None, 0.0)),
            },
        }
    }

    /// Adds the work and the impulse of a force on a body, the work of which an element does.
    fn push(
        &mut self,
        body: usize,
        by: Option<usize>,
        (sign, force): (f64, &Signal),
        velocity: &Signal,
    ) {
        for (cell, window) in self.slices() {
            let work = sign * force.integral_of_product(velocity, window);
            self.add_to_body(body, cell, work);
            if let Some(element) = by {
                self.add_to_element(element, cell, -work);
            }
            self.momenta[body] -= sign * force.integral(window);
        }
    }

    fn add_to_body(&mut self, body: usize, cell: usize, energy: f64) {
        if let Some(&element) = self.within.get(&body) {
            self.add_to_element(element, cell, energy);
        } else {
            self.bodies[body] += energy;
            self.totals[cell] += energy;
        }
    }

    fn add_to_element(&mut self, element: usize, cell: usize, energy: f64) {
        self.elements[element] += energy;
        self.totals[cell] += energy;
    }

    /// What the masses of a body take up.
    fn inertia(&mut self, body: usize) {
        let own = self.solution.assembly().nodes.iter().filter(|node| node.body == body);
        let mass: f64 = own.map(|node| node.mass).sum();
        if mass <= 0.0 {
            return;
        }
        let velocity = self.velocity(body);
        let slices = self
            .slices()
            .map(|(cell, (from, to))| (cell, velocity.value(from), velocity.left_value(to)));
        let instants = self
            .instants()
            .map(|(cell, time)| (cell, velocity.left_value(time), velocity.value(time)));
        for (cell, before, after) in slices.chain(instants) {
            let momentum = mass * (after - before);
            self.add_to_body(body, cell, -0.5 * momentum * (after + before));
            self.momenta[body] += momentum;
        }
    }

    /// The work done on an element at its ends.
    fn ends(&mut self, at: usize) {
        let (solution, assembly) = (self.solution, self.solution.assembly());
        let connection = &assembly.connections[at];
        let Some(force) = connection.force.filter(|_| !connection.is_rigid) else { return };
        let transmitted = solution.signal(connection.transmitted.unwrap_or(force));
        let [a, b] = contacts::between(assembly, connection);
        for (body, push) in [(a, (-1.0, solution.signal(force))), (b, (1.0, transmitted))] {
            let velocity = self.velocity(body);
            self.push(body, Some(at), push, &velocity);
        }
    }

    /// What the parts of an element store and dissipate.
    fn inside(&mut self, at: usize) {
        let (solution, assembly) = (self.solution, self.solution.assembly());
        let range = assembly.connections[at].primitives.clone();
        for primitive in assembly.primitives.get(range.clone()).unwrap_or_default() {
            let own = EnergyRole::of(primitive.element.as_ref());
            let deformation = solution.signal(primitive.deformation);
            if own.dissipates {
                if does_work(primitive) {
                    let rate = solution.rate(primitive.rate, primitive.deformation);
                    let force = solution.signal(primitive.force);
                    for (cell, window) in self.slices() {
                        let work = force.integral_of_product(&rate, window);
                        self.add_to_element(at, cell, -work);
                    }
                }
            } else if own.stores {
                let energy = |y: f64| primitive.element.stored(y);
                for (cell, (from, to)) in self.slices() {
                    let (from, to) = (deformation.value(from), deformation.left_value(to));
                    self.add_to_element(at, cell, energy(from) - energy(to));
                }
                for (cell, time) in self.instants() {
                    let (from, to) = (deformation.left_value(time), deformation.value(time));
                    self.add_to_element(at, cell, energy(from) - energy(to));
                }
            }
        }
        let close = CLOSE * solution.end();
        for (cell, time) in self.instants() {
            let work = steps(solution, range.clone(), (time - close, time + close));
            self.add_to_element(at, cell, work);
        }
    }

    /// What impulses do: their work on the bodies is that of moving supports less what is lost.
    fn impacts(&mut self) {
        let (solution, assembly) = (self.solution, self.solution.assembly());
        let owner = owners(assembly);
        for (cell, time) in self.instants() {
            let switches = solution.trajectory().switches.iter();
            let own = switches
                .filter(|switch| switch.impulse > 0.0 && switch.time.total_cmp(&time).is_eq());
            for switch in own {
                let Some(&at) = owner.get(switch.name.as_str()) else { continue };
                self.add_to_element(at, cell, switch.worked - switch.lost);
                let [a, b] = contacts::between(assembly, &assembly.connections[at]);
                if a == b {
                    continue;
                }
                for (body, impulse) in [(a, -switch.impulse), (b, switch.impulse)] {
                    self.momenta[body] -= impulse;
                    if assembly.nodes.iter().any(|node| node.body == body && !node.free) {
                        continue;
                    }
                    let velocity = self.velocity(body);
                    let mean = f64::midpoint(velocity.left_value(time), velocity.value(time));
                    self.add_to_body(body, cell, impulse * mean);
                    self.add_to_element(at, cell, -impulse * mean);
                }
            }
        }
    }
}

/// The element of each primitive, by the name of the primitive.
fn owners(assembly: &Assembly) -> HashMap<&str, usize> {
    let elements = assembly.connections.iter().enumerate();
    let primitives = elements.flat_map(|(at, own)| {
        let primitives = assembly.primitives.get(own.primitives.clone()).unwrap_or_default();
        primitives.iter().map(move |primitive| (&*primitive.name, at))
    });
    primitives.collect()
}

/// The bodies of the masses within pads, by the element that they belong to: no element ends there.
pub(in crate::energy::ledger) fn within(assembly: &Assembly) -> HashMap<usize, usize> {
    let layered = assembly.connections.iter().enumerate().filter(|(_, own)| own.has_layers);
    let layered: HashMap<&str, usize> = layered.map(|(at, own)| (own.name.as_str(), at)).collect();
    let nodes = assembly.nodes.iter().filter(|_| !layered.is_empty());
    nodes
        .filter_map(|node| {
            let (pad, number) = node.name.rsplit_once('.')?;
            number.parse::<usize>().ok()?;
            Some((node.body, *layered.get(pad)?))
        })
        .collect()
}
