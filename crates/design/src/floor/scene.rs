//! The floors of a scene: who is stopped there, within what travel, and on what.

use dashpot_analysis::{
    Bound, Choice, Limit, MeasureReport, RunError, RunReport, Solve, SolveSettings,
};
use dashpot_dae::{Panel, Signal};
use dashpot_network::{
    Assembly, Network, NetworkErrors, Node, NodeId, Start, Support,
    effects::Stop,
    first_nonlinear,
    parameters::{Value, WindowWish},
};
use thiserror::Error;

use super::{FARTHEST, Floor, Judged, Kernel, Stroke};

/// Why there is no floor.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum NoFloor {
    /// The network is at fault.
    #[error(transparent)]
    Network(#[from] NetworkErrors),
    /// Not one body strikes one pad.
    #[error(
        "a floor is told where one body strikes one element: here {bodies} bodies strike {elements}"
    )]
    NotOne {
        /// Bodies that begin with a speed.
        bodies: usize,
        /// Elements that touch them.
        elements: usize,
    },
    /// Nothing says how far it may come.
    #[error(
        "nothing bounds the travel of `{element}`: give it a `thickness`, a stop, or a limit on its peak-deformation"
    )]
    NoTravel {
        /// The element that is struck.
        element: String,
    },
    /// Something else acts.
    #[error("`{what}` acts on the scene besides the impact")]
    Driven {
        /// A load, or a node that is moved.
        what: String,
    },
    /// The pad is a body of its own.
    #[error("`{element}` has mass of its own")]
    WithMass {
        /// The element that is struck.
        element: String,
    },
    /// What the pad lies on is no linear network with a mass where it lies.
    #[error("what `{element}` lies on is not linear, or has no mass there: `{what}`")]
    Rest {
        /// The element that is struck.
        element: String,
        /// What is in the way.
        what: String,
    },
    /// The rest of the scene could not be solved.
    #[error(transparent)]
    Unsolved(#[from] RunError),
}

dashpot_units::words! {
    /// What bounds a travel.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum TravelOf, pub fn word(self) {
        /// The thickness of the pad.
        Thickness = "thickness",
        /// Its stop.
        Stop = "stop",
        /// A limit on its deformation.
        Limit = "limit",
    }
}

/// How far a pad may be pressed in.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Travel {
    /// \[m\].
    pub length: f64,
    /// What bounds it.
    pub of: TravelOf,
}

/// The stroke of a scene.
#[derive(Debug, Clone)]
pub struct Floors {
    /// The body, its speed and the travel.
    pub stroke: Stroke,
    /// The least of what bounds the travel.
    pub travel: Travel,
    /// The name of the body.
    pub body: String,
    /// The name of the pad.
    pub pad: String,
}

impl Floors {
    /// What no pad can beat of a measure that a run reports, with the whole travel or another one \[m\]; `None` where
    /// it is none of those that have a floor, or of another part of the run than the impact or all of it.
    ///
    /// Of an impact that a harder one follows may be more than the impact itself has come to.
    pub fn of(&self, measure: &MeasureReport, travel: Option<f64>) -> Option<Floor> {
        let judged = self.judged(measure)?;
        match travel {
            Some(travel) => self.stroke.within(travel).floor(judged),
            None => self.stroke.floor(judged),
        }
    }

    /// How far the pad was pressed in at most in a run \[m\].
    pub fn deepest(&self, run: &RunReport) -> Option<f64> {
        let pad = run.assembly.connection(&self.pad)?;
        let deepest = run.solution().signal(pad.deformation).maximum((0.0, run.trajectory.t_end));
        Some(deepest.value).filter(|own| *own > 0.0)
    }

    fn judged(&self, measure: &MeasureReport) -> Option<Judged> {
        let is_whole =
            matches!(measure.window_wish, None | Some(WindowWish::Impact | WindowWish::Run));
        let number = |name: &str| {
            let all = &measure.parameters;
            all.iter().find(|own| own.0 == name).and_then(|own| match own.1 {
                Value::Number(number) => Some(number),
                _ => None,
            })
        };
        let judged = match (measure.kind, measure.target == self.body) {
            ("peak-force", false) if measure.target == self.pad => Judged::PeakForce,
            ("peak-acceleration", true) => Judged::PeakAcceleration,
            ("severity-index", true) => Judged::SeverityIndex { exponent: number("exponent")? },
            ("hic15", true) => Judged::Hic { cap: 0.015 },
            ("hic36", true) => Judged::Hic { cap: 0.036 },
            ("hic", true) => Judged::Hic { cap: number("cap")? },
            _ => return None,
        };
        is_whole.then_some(judged)
    }
}

/// Reads the stroke of a scene, with limits that bound the travel as well.
///
/// # Errors
///
/// [`NoFloor`] where the scene is none in which a floor is known.
pub fn floors(network: &Network, duration: f64, limits: &[Limit]) -> Result<Floors, NoFloor> {
    let assembly = network.compile(duration)?;
    let (at, body) = struck(network, &assembly)?;
    let connection = &network.connections()[at];
    let element = connection.name.clone();
    if connection.layers.is_some() {
        return Err(NoFloor::WithMass { element });
    }
    if let Some(load) = network.loads().first() {
        return Err(NoFloor::Driven { what: load.name.clone() });
    }
    let is_moved = |own: &&Node| matches!(own.support, Support::Prescribed(_));
    if let Some(own) = network.nodes().map(|own| own.1).find(is_moved) {
        return Err(NoFloor::Driven { what: own.name.clone() });
    }
    let travel = travel(network, at, limits)?;
    let own = &assembly.nodes[body.index()];
    let mass = mass_of(&assembly, own.body);
    let gravity = network.effects().iter().find_map(|effect| effect.gravity()).unwrap_or(0.0);
    // Of what is dropped that is the speed at touch, whether it falls or begins there.
    let speed = own.start_velocity.unwrap_or(0.0);
    let none = || NoFloor::NotOne { bodies: 1, elements: 1 };
    let mut stroke = Stroke::on_fixed(mass, speed.abs(), gravity.max(0.0), travel.length);
    let stroke = stroke.as_mut().ok_or_else(none)?;
    let other = connection.between[usize::from(connection.between[0] == body)];
    if assembly.nodes[other.index()].free {
        let horizon = FARTHEST * stroke.time_through();
        let rest = Rest { network, assembly: &assembly, pad: at, body: own.body, under: other };
        stroke.kernel = Kernel::Moving(rest.approach(mass, horizon * (1.0 + 1e-9))?);
    }
    Ok(Floors { stroke: stroke.clone(), travel, body: own.name.clone(), pad: element })
}

/// The one element that one body strikes.
fn struck(network: &Network, assembly: &Assembly) -> Result<(usize, NodeId), NoFloor> {
    let bodies: Vec<NodeId> = network
        .nodes()
        .filter(|own| assembly.nodes[own.0.index()].is_impactor())
        .map(|own| own.0)
        .collect();
    let of = |node: NodeId| assembly.nodes[node.index()].body;
    let touching: Vec<usize> = match &bodies[..] {
        [body] => {
            let touches = |own: &&(usize, [bool; 2])| own.1[0] != own.1[1];
            let ends =
                network.connections().iter().map(|own| own.between.map(|end| of(end) == of(*body)));
            let all: Vec<(usize, [bool; 2])> = ends.enumerate().collect();
            all.iter().filter(touches).map(|own| own.0).collect()
        }
        _ => Vec::new(),
    };
    match (&bodies[..], &touching[..]) {
        ([body], [pad]) if network.connections()[*pad].between.contains(body) => Ok((*pad, *body)),
        _ => Err(NoFloor::NotOne { bodies: bodies.len(), elements: touching.len() }),
    }
}

fn mass_of(assembly: &Assembly, body: usize) -> f64 {
    assembly.nodes.iter().filter(|own| own.body == body).map(|own| own.mass).sum()
}

fn travel(network: &Network, at: usize, limits: &[Limit]) -> Result<Travel, NoFloor> {
    let connection = &network.connections()[at];
    let thickness = connection.thickness;
    let stops = network.effects().iter().filter_map(|own| own.of_kind::<Stop>());
    let stop =
        stops.filter(|own| own.element == connection.name).find_map(|own| own.at.or(thickness));
    let key = format!("{}.peak-deformation", connection.name);
    let of_limits = limits.iter().filter(|own| own.key == key);
    let limit = of_limits.filter_map(|own| match own.bound {
        Bound::Max(most) => Some(most),
        Bound::Min(_) => None,
    });
    let all = [
        (thickness, TravelOf::Thickness),
        (stop, TravelOf::Stop),
        (limit.reduce(f64::min), TravelOf::Limit),
    ];
    let known = all.into_iter().filter_map(|(length, of)| Some(Travel { length: length?, of }));
    let least = known.reduce(|one, other| if other.length < one.length { other } else { one });
    least
        .filter(|own| own.length > 0.0)
        .ok_or_else(|| NoFloor::NoTravel { element: connection.name.clone() })
}

/// What a pad lies on: a scene without it and the body.
struct Rest<'r> {
    network: &'r Network,
    assembly: &'r Assembly,
    pad: usize,
    body: usize,
    under: NodeId,
}

impl Rest<'_> {
    /// How far the body, of a mass \[kg\], and what is under the pad approach each other after a unit impulse
    /// \[m/(N s)\], up to a time \[s\].
    fn approach(&self, mass: f64, horizon: f64) -> Result<Signal, NoFloor> {
        let line = Panel {
            start: 0.0,
            end: horizon,
            coefficients: [0.5 * horizon / mass, 0.5 * horizon / mass].into(),
        };
        let line = Signal::new(vec![line], None, 0.0);
        let (network, under) = self.kicked()?;
        let settings = SolveSettings {
            method: Choice::named("exact")?,
            estimate: false,
            ..SolveSettings::lasting(horizon)
        };
        let run = network.solve_with(&settings)?;
        let name = &network.node(under).name;
        let place = run.assembly.node(name).map(|own| own.position);
        let place = place.ok_or_else(|| self.in_the_way(name))?;
        Ok(line.plus(run.solution().signal(place), 1.0))
    }

    fn in_the_way(&self, what: &str) -> NoFloor {
        let element = self.network.connections()[self.pad].name.clone();
        NoFloor::Rest { element, what: what.to_owned() }
    }

    /// The rest alone, at rest but for what a unit impulse has made of the body under the pad.
    fn kicked(&self) -> Result<(Network, NodeId), NoFloor> {
        let of = |node: NodeId| &self.assembly.nodes[node.index()];
        let pad = &self.network.connections()[self.pad];
        let others = self.network.effects().iter().filter_map(|own| own.target());
        if let Some(target) = others.into_iter().find(|own| *own != pad.name) {
            return Err(self.in_the_way(target));
        }
        let mass = mass_of(self.assembly, of(self.under).body);
        if mass <= 0.0 {
            return Err(self.in_the_way(&of(self.under).name));
        }
        let mut network = Network::new();
        let mut ids = vec![network.ground()];
        for (id, node) in self.network.nodes().skip(1) {
            let is_kicked = of(id).body == of(self.under).body && node.mass > 0.0;
            let start = if is_kicked { Start::Velocity(mass.recip()) } else { Start::Rest };
            let own = Node { start, position: 0.0, ..node.clone() };
            // The body that is stopped stays behind, as nothing that moves.
            let own = if of(id).body == self.body { Node::fixed(node.name.clone()) } else { own };
            ids.push(network.add_node(own));
        }
        for (at, own) in self.network.connections().iter().enumerate() {
            let ends = own.between;
            if at == self.pad || ends.iter().any(|end| of(*end).body == self.body) {
                continue;
            }
            if own.layers.is_some() || first_nonlinear(&own.model).is_some() {
                return Err(self.in_the_way(&own.name));
            }
            network.connect(
                own.name.clone(),
                ids[ends[0].index()],
                ids[ends[1].index()],
                own.model.clone(),
            );
        }
        Ok((network, ids[self.under.index()]))
    }
}
