//! A solved run as the measures see it.

use std::{
    borrow::Cow,
    cell::{OnceCell, RefCell},
    collections::BTreeSet,
};

use dashpot_dae::{Signal, Trajectory};
use dashpot_network::{Assembly, ConnectionOutputs, NodeId, parameters::WindowWish};

use crate::{
    Note,
    impact::{
        contacts::{self, Members},
        face::{self, FaceContact, Struck, Through},
        impulses::{self, VelocityJump},
        interval::{Impact, NO_PULL, Span, first_felt, first_way},
    },
};

mod forces;
mod grazing;
mod signals;

use forces::{only_at_rest, resting_from_switches};
use grazing::ForceOf;
pub(crate) use grazing::{UndecidedReleases, releases_in_ripples, undecided_ends};
use signals::{Signals, Twins};

/// Errors of stepping methods in parts of their relative tolerance and of the largest value: they
/// are 100 to 700, of whatever method, at tolerances from 1e-4 to 1e-10.
const ERRORS_PER_TOLERANCE: f64 = 1e3;
/// Part of the largest force beyond which a pull is one at any tolerance; finer solutions tell where it was an error.
const LARGEST_THRESHOLD: f64 = 1e-2;

/// The part of the largest force below which a pull may be an error of a method of this relative
/// tolerance; 0 for a method that has none.
pub fn threshold_at(rtol: Option<f64>) -> f64 {
    rtol.map_or(0.0, |rtol| (ERRORS_PER_TOLERANCE * rtol).min(LARGEST_THRESHOLD))
}

/// An assembly and a trajectory of it, with the signals that were asked for.
#[derive(Debug)]
pub struct Solution<'a> {
    assembly: &'a Assembly,
    trajectory: &'a Trajectory,
    known: Known,
    missing: RefCell<BTreeSet<usize>>,
    has_impactor: Vec<bool>,
    threshold: f64,
    ends: UndecidedReleases,
}

/// What has been found in a solution so far.
#[derive(Debug)]
pub(crate) struct Known {
    signals: Signals,
    twins: Twins,
    element_impacts: Vec<OnceCell<Box<Impact>>>,
    body_impacts: Vec<OnceCell<Box<Impact>>>,
    jumps: OnceCell<Vec<Vec<VelocityJump>>>,
    faces: OnceCell<Vec<(usize, FaceContact)>>,
    members: OnceCell<Members>,
    scene_impact: OnceCell<Impact>,
}

impl Known {
    fn nothing(assembly: &Assembly) -> Self {
        // In large networks few of them are ever filled.
        let cells = |count: usize| (0..count).map(|_| OnceCell::new()).collect();
        Self {
            signals: Signals::of(assembly.system.outputs.len()),
            twins: Twins::default(),
            element_impacts: cells(assembly.connections.len()),
            body_impacts: cells(contacts::count(assembly)),
            jumps: OnceCell::new(),
            faces: OnceCell::new(),
            members: OnceCell::new(),
            scene_impact: OnceCell::new(),
        }
    }
}

impl<'a> Solution<'a> {
    /// Looks at `trajectory`, which must be one of `assembly`.
    pub fn new(assembly: &'a Assembly, trajectory: &'a Trajectory) -> Self {
        Self {
            assembly,
            trajectory,
            known: Known::nothing(assembly),
            missing: RefCell::default(),
            has_impactor: contacts::with_impactor(assembly),
            threshold: 0.0,
            ends: UndecidedReleases::new(),
        }
    }

    /// The same solution of which so much is known already, as it was found with the same doubt.
    #[must_use]
    pub(crate) fn knowing(self, known: Known) -> Self {
        Self { known, ..self }
    }

    /// What has been found in it, to be looked at again.
    pub(crate) fn known(self) -> Known {
        self.known
    }

    /// The same solution of whose contact forces pulls below the part `threshold` of the largest
    /// magnitude count as errors of the method; see [`threshold_at`].
    #[must_use]
    pub fn doubting(self, threshold: f64) -> Self {
        Self { threshold, ..self }
    }

    /// The part of the largest magnitude of a contact force below which a pull counts as an error of the method.
    pub(crate) fn doubt(&self) -> f64 {
        self.threshold
    }

    /// The network's equations.
    pub fn assembly(&self) -> &'a Assembly {
        self.assembly
    }

    /// The trajectory.
    pub fn trajectory(&self) -> &'a Trajectory {
        self.trajectory
    }

    /// Both.
    pub(crate) fn run(&self) -> (&'a Assembly, &'a Trajectory) {
        (self.assembly, self.trajectory)
    }

    /// End of the run \[s\].
    pub fn end(&self) -> f64 {
        self.trajectory.t_end
    }

    /// An output as the trajectory tells it.
    fn made(&self, output: usize) -> Signal {
        let signal = self.trajectory.signal(&self.assembly.system, output);
        // Laws that are not linear may give no force at all by themselves.
        let is_linear = self.assembly.system.is_linear();
        if is_linear { only_at_rest(signal, &self.trajectory.switches) } else { signal }
    }

    /// Whether the run has kept the output of this number. Runs of large networks keep those that
    /// belong to impactors, to what these touch, and to what a measure was asked of.
    pub fn keeps(&self, output: usize) -> bool {
        self.trajectory.keeps(&self.assembly.system, output)
    }

    /// The outputs that were asked for and had not been kept.
    pub(crate) fn missing(&self) -> BTreeSet<usize> {
        self.missing.borrow().clone()
    }

    /// The rate that belongs to a deformation: the output where there is one, else the derivative
    /// of the deformation, in which its jumps leave no trace.
    ///
    /// # Panics
    ///
    /// When the assembly has no such outputs.
    pub fn rate(&self, rate: Option<usize>, deformation: usize) -> Cow<'_, Signal> {
        match rate {
            Some(rate) => self.glance(rate),
            None => self.slopes(deformation),
        }
    }

    /// The deformation rate of an element \[m/s\]: the output where there is one, else the difference
    /// of the velocities of its ends where both have one, else the derivative of the deformation.
    pub(crate) fn rate_of(&self, connection: &ConnectionOutputs) -> Cow<'_, Signal> {
        let [a, b] = connection.between.map(|end| self.assembly.nodes[end.index()].velocity);
        match (connection.rate, a, b) {
            (None, Some(a), Some(b)) => Cow::Owned(self.glance(a).plus(&self.glance(b), -1.0)),
            _ => self.rate_with_bound(connection),
        }
    }

    /// The rate of a deformation as by [`rate`](Self::rate), but with a bound of its error where the method has
    /// one of rates that are no outputs.
    fn rate_with_bound(&self, connection: &ConnectionOutputs) -> Cow<'_, Signal> {
        if connection.rate.is_none() && self.trajectory.dense.has_rates() {
            return self.told_rate(connection.deformation);
        }
        self.rate(connection.rate, connection.deformation)
    }

    /// Whether the rate of an element is an output, or the difference of two.
    pub(crate) fn has_rate(&self, connection: &ConnectionOutputs) -> bool {
        let is_moving = |end: NodeId| self.assembly.nodes[end.index()].velocity.is_some();
        connection.rate.is_some() || connection.between.iter().all(|&end| is_moving(end))
    }

    /// The speed at which the ends of an element approach each other \[m/s\], as that of the bodies
    /// that they belong to, where those have velocities: a massless face has that of what it
    /// touches while it does. Else the rate of the deformation.
    pub(crate) fn approach(&self, connection: &ConnectionOutputs) -> Cow<'_, Signal> {
        let [a, b] = connection.between.map(|end| self.velocity_of_body(end.index()));
        match (connection.rate, a, b) {
            (None, Some(a), Some(b)) => Cow::Owned(self.glance(a).plus(&self.glance(b), -1.0)),
            _ => self.rate_with_bound(connection),
        }
    }

    /// The [approach](Self::approach) of the ends of an element just before `time` \[m/s\], where it follows from the deformation
    /// and the equations tell it better than that.
    pub(crate) fn told_approach(&self, connection: &ConnectionOutputs, time: f64) -> Option<f64> {
        let dense = &self.trajectory.dense;
        let ends = connection.between.map(|end| self.velocity_of_body(end.index()));
        if connection.rate.is_some() || ends.iter().all(Option::is_some) || dense.has_rates() {
            return None;
        }
        dense.values(&self.assembly.system, connection.deformation, 1, &[time])?.pop()
    }

    /// The speed at which two nodes approach each other \[m/s\], as that of their bodies; `None` where
    /// one of those has no velocity.
    pub(crate) fn approach_of(&self, [a, b]: [usize; 2]) -> Option<Signal> {
        let (a, b) = (self.velocity_of_body(a)?, self.velocity_of_body(b)?);
        Some(self.glance(a).plus(&self.glance(b), -1.0))
    }

    /// The speed at which the ends of an element approach each other just before `time` \[m/s\]:
    /// before the run that of the start speeds.
    pub(crate) fn approach_before(&self, connection: &ConnectionOutputs, time: f64) -> f64 {
        if time > 0.0 {
            return self.approach(connection).left_value(time);
        }
        self.start_approach(connection.between.map(NodeId::index))
    }

    /// The speed at which two nodes approach each other before the run \[m/s\].
    pub(crate) fn start_approach(&self, ends: [usize; 2]) -> f64 {
        let [a, b] = ends.map(|end| {
            let of_body = || self.members().nodes(self.assembly, self.assembly.nodes[end].body);
            match of_body().find(|node| !node.free) {
                Some(held) => {
                    held.velocity.map_or(0.0, |velocity| self.signal(velocity).value(0.0))
                }
                None => of_body().find_map(|node| node.start_velocity).unwrap_or(0.0),
            }
        });
        a - b
    }

    fn velocity_of_body(&self, node: usize) -> Option<usize> {
        let own = &self.assembly.nodes[node];
        let of_body = || self.members().nodes(self.assembly, own.body);
        own.velocity.or_else(|| of_body().find_map(|own| own.velocity))
    }

    fn members(&self) -> &Members {
        self.known.members.get_or_init(|| Members::of(self.assembly))
    }

    /// The impact as the element number `element` feels it: that of its own force if it touches an
    /// impactor, that of its face and its force if one strikes it there, that of the body if it is a
    /// rigid link within one, else that of the scene.
    pub fn element_impact(&self, element: usize) -> Impact {
        **self.known.element_impacts[element].get_or_init(|| {
            let connection = &self.assembly.connections[element];
            let through = self.struck_face(element);
            if let Some(through) = through.and_then(|face| self.impact_through(element, face)) {
                return Box::new(through.whole);
            }
            Box::new(match connection.force {
                Some(force) if self.touches_impactor(connection) => {
                    let (jumps, threshold) =
                        (self.element_jumps(element), self.threshold_of(connection));
                    let impact =
                        Impact::of_contact(self.signal(force), jumps, self.end(), threshold);
                    self.ended(impact, self.signal(force), ForceOf::Element(element))
                }
                _ if connection.is_rigid => self.node_impact(connection.between[0].index()),
                _ => self.scene_impact(),
            })
        })
    }

    /// The impact as the node number `node` feels it: that of its body, the nodes that rigid links
    /// join to it, if an impactor belongs to it; else that of the scene.
    ///
    /// What counts is the sum of the forces that the elements put on the body, and of a padding with a face that it
    /// strikes all that belongs to the impact of that. Whichever way it first goes is the way it pushes: against the
    /// speed of a body that strikes, along with that of a body that is struck from behind.
    pub fn node_impact(&self, node: usize) -> Impact {
        let body = self.assembly.nodes[node].body;
        if self.has_impactor[body] { self.body_impact(body) } else { self.scene_impact() }
    }

    /// The impact as the body number `body` feels it, to which an impactor belongs.
    fn body_impact(&self, body: usize) -> Impact {
        **self.known.body_impacts[body].get_or_init(|| {
            let own = match self.push_on(body) {
                Some(force) => {
                    let threshold = self.threshold_of_body(body);
                    let jumps = self.body_jumps(body);
                    let impact = Impact::of_contact(&force, &jumps, self.end(), threshold);
                    self.ended(impact, &force, ForceOf::Body(body))
                }
                None => Impact::unloaded(self.end()),
            };
            let longer = self.longer_impacts(Some(body)).into_iter();
            Box::new(longer.fold(own, |impact, longer| impact.joined(longer.touch)))
        })
    }

    /// The part of the run that a measure of the element number `element` looks at.
    ///
    /// # Errors
    ///
    /// Why there is none.
    pub fn element_span(&self, element: usize, wish: WindowWish) -> Result<Span, Note> {
        self.element_impact(element).span(wish, self.end())
    }

    /// The part of the run that a measure of the node number `node` looks at.
    ///
    /// # Errors
    ///
    /// Why there is none.
    pub fn node_span(&self, node: usize, wish: WindowWish) -> Result<Span, Note> {
        self.node_impact(node).span(wish, self.end())
    }

    /// The force of the element number `element` \[N\], positive in compression.
    ///
    /// # Errors
    ///
    /// [`Note::NoForce`] of a rigid link in a loop of rigid links.
    pub fn element_force(&self, element: usize) -> Result<&Signal, Note> {
        let force = self.assembly.connections[element].force.ok_or(Note::NoForce)?;
        Ok(self.signal(force))
    }

    /// What an accelerometer on the node number `node` reads \[m/s²\].
    ///
    /// # Errors
    ///
    /// [`Note::Massless`] of a node that has no mass, or is held fixed.
    pub fn node_acceleration(&self, node: usize) -> Result<&Signal, Note> {
        let acceleration = self.assembly.nodes[node].acceleration.ok_or(Note::Massless)?;
        Ok(self.signal(acceleration))
    }

    /// Whether the element number `element` has a contact in it.
    pub(crate) fn has_contact(&self, element: usize) -> bool {
        contacts::has_contact(self.assembly, &self.assembly.connections[element])
    }

    /// The velocity jumps at which masses meet in the element number `element`, in order of time.
    pub fn element_jumps(&self, element: usize) -> &[VelocityJump] {
        self.all_jumps().get(element).map_or(&[], Vec::as_slice)
    }

    /// The velocity jumps of the node number `node`, in order of time.
    pub fn node_jumps(&self, node: usize) -> Vec<VelocityJump> {
        self.body_jumps(self.assembly.nodes[node].body)
    }

    fn body_jumps(&self, body: usize) -> Vec<VelocityJump> {
        impulses::on_body(self.assembly, self.all_jumps(), body)
    }

    fn all_jumps(&self) -> &[Vec<VelocityJump>] {
        self.known.jumps.get_or_init(|| impulses::by_connection(self.assembly, self.trajectory))
    }

    /// How the element number `element` is struck through its face, where an impactor does so.
    pub(crate) fn struck_face(&self, element: usize) -> Option<FaceContact> {
        let faces = self.struck_faces();
        let at = faces.binary_search_by_key(&element, |own| own.0).ok()?;
        Some(faces[at].1)
    }

    /// The elements that an impactor strikes through their faces, in order.
    fn struck_faces(&self) -> &[(usize, FaceContact)] {
        self.known.faces.get_or_init(|| {
            let connections = &self.assembly.connections;
            let struck = |element: usize| {
                let face = face::face_contact(self.assembly, element)?;
                let is_through_it = self.touches_impactor(&connections[face.connection])
                    && !self.touches_impactor(&connections[element]);
                is_through_it.then_some((element, face))
            };
            (0..connections.len()).filter_map(struck).collect()
        })
    }

    fn impact_through(&self, element: usize, face: FaceContact) -> Option<Through> {
        let connections = &self.assembly.connections;
        let struck = Struck {
            touch: self.signal(connections[face.connection].force?),
            jumps: self.element_jumps(face.connection),
            padding: self.signal(connections[element].force?),
            run_end: self.end(),
        };
        Some(struck.impact())
    }

    /// The impacts, longer than the first contact of a face, of the elements that are struck through
    /// their faces by `body`, or by any.
    fn longer_impacts(&self, body: Option<usize>) -> Vec<Through> {
        let found = self.struck_faces().iter().filter_map(|&(element, face)| {
            let is_meant = body.is_none_or(|body| {
                let ends =
                    contacts::between(self.assembly, &self.assembly.connections[face.connection]);
                ends.contains(&body)
            });
            self.impact_through(element, face).filter(|own| is_meant && own.is_more)
        });
        found.collect()
    }

    /// Bound of the error of the velocity of a node \[m/s\], where it has one.
    pub fn velocity_error(&self, node: usize) -> Option<f64> {
        self.glance(self.assembly.nodes[node].velocity?).error
    }

    /// The mass of the body that a node belongs to \[kg\].
    pub fn body_mass(&self, node: usize) -> f64 {
        self.members().mass(self.assembly.nodes[node].body)
    }

    /// The force on a body with the sign with which what acts on it begins; `None` if nothing touches it.
    fn push_on(&self, body: usize) -> Option<Signal> {
        let force = resting_from_switches(self.force_on(body)?, &self.trajectory.switches);
        let pushes = first_pushes(&force, &self.body_jumps(body));
        Some(if pushes { force } else { force.scaled(-1.0) })
    }

    /// The sum of the forces \[N\] that the elements put on a body; `None` if nothing touches it.
    fn force_on(&self, body: usize) -> Option<Signal> {
        let pushing = self
            .members()
            .connections(self.assembly, body)
            .filter(|connection| connection.1 != 0.0);
        let forces = pushing.filter_map(|(own, sign)| Some((self.glance(own.force?), sign)));
        forces.fold(None, |sum: Option<Signal>, (force, sign)| {
            Some(sum.map_or_else(|| force.scaled(sign), |sum| sum.plus(&force, sign)))
        })
    }

    /// The impact of the force of a connection of this trajectory.
    pub(crate) fn impact_of(&self, connection: &ConnectionOutputs, force: &Signal) -> Impact {
        Impact::of_force(force, self.end(), self.threshold_of(connection))
    }

    /// The part of its largest magnitude below which a pull of a connection counts as none.
    fn threshold_of(&self, connection: &ConnectionOutputs) -> f64 {
        if connection.never_pulls { NO_PULL } else { self.threshold }
    }

    /// The same for the force on a body, which never pulls if all that it meets lies on one side of it and does not.
    fn threshold_of_body(&self, body: usize) -> f64 {
        let mut touching = self.members().connections(self.assembly, body);
        let mut side = 0.0;
        let is_one_sided = touching.all(|(own, sign)| {
            let is_same = sign * side >= 0.0;
            side = if sign == 0.0 { side } else { sign };
            sign == 0.0 || own.never_pulls && is_same
        });
        if is_one_sided { NO_PULL } else { self.threshold }
    }

    /// The impact of the scene: from the first contact of any impactor until the last one is let
    /// go, and what they have struck through a face is unloaded. Without an impactor it is the whole run.
    pub fn scene_impact(&self) -> Impact {
        *self.known.scene_impact.get_or_init(|| {
            let impactors = self.assembly.nodes.iter().enumerate();
            let of_impactors = impactors
                .filter(|(_, node)| node.is_impactor())
                .map(|(at, _)| self.node_impact(at))
                .reduce(Impact::joined);
            let Some(of_impactors) = of_impactors else {
                return Impact::without_impactor(self.end());
            };
            let longer = self.longer_impacts(None).into_iter();
            longer.fold(of_impactors, |impact, longer| impact.joined(longer.whole))
        })
    }

    /// Whether the connection can deform and has an impactor, or what is rigidly linked to one, at one of its ends.
    pub fn touches_impactor(&self, connection: &ConnectionOutputs) -> bool {
        contacts::is_touching(self.assembly, connection, &self.has_impactor)
    }
}

/// Whether the first force or impulse is positive; so is none.
fn first_pushes(force: &Signal, jumps: &[VelocityJump]) -> bool {
    match first_felt(jumps, force).filter(|jump| Impact::begins_with(jump, force)) {
        Some(jump) => jump.impulse > 0.0,
        None => first_way(force) != Some(false),
    }
}
