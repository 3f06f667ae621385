//! A boxed instrument that falls on foam, with gravity, and is let go: by hand and by ours.
//!
//! By hand it is the method of `explicit` for this scene alone.

use dashpot::{
    analysis::{SolveSettings, sweep::ScenePoint},
    network::{
        Network, Node,
        effects::{Gravity, GravityStart, Separation},
        elements::{Dashpot, Foam},
        part,
    },
    rheology::Tree,
};

use super::explicit::{Impact, Seen, follow};

const DAMPING: f64 = 40.0;
pub(crate) const GRAVITY: f64 = 9.80665;
pub(crate) const AREA: f64 = 0.0144;
const MODULUS: f64 = 1.2e6;
const PLATEAU: f64 = 1.2e5;
const DENSIFICATION: f64 = 3e4;

/// The measures that both find, in this order.
pub(crate) const KEYS: [&str; 7] = [
    "pad.peak-force",
    "pad.peak-deformation",
    "pad.contact-time",
    "pad.impulse",
    "pad.energy",
    "head.severity-index",
    "head.peak-acceleration",
];

/// The scene, dropped from a height \[m\].
pub(crate) fn scene(height: f64) -> ScenePoint {
    INSTRUMENT.scene(height)
}

/// A body of some mass \[kg\] over foam of some thickness \[m\].
#[derive(Debug, Clone, Copy)]
pub(crate) struct Block {
    pub(crate) mass: f64,
    pub(crate) thickness: f64,
}

/// The boxed instrument.
const INSTRUMENT: Block = Block { mass: 8.0, thickness: 0.05 };

impl Block {
    /// The drop from a height \[m\].
    pub(crate) fn scene(self, height: f64) -> ScenePoint {
        let Self { mass, thickness } = self;
        let mut network = Network::new();
        let head = network.add_node(Node::mass("head", mass).dropped(height));
        let foam = Foam {
            modulus: MODULUS,
            plateau: PLATEAU,
            densification: DENSIFICATION,
            exponent: 2.0,
            thickness,
            area: AREA,
        };
        let pad = Tree::parallel([part(foam), part(Dashpot { damping: DAMPING })]);
        let pad = network.connect("pad", head, network.ground(), pad);
        (pad.thickness, pad.area) = (Some(thickness), Some(AREA));
        network.add_effect(Gravity { acceleration: GRAVITY, start: GravityStart::Equilibrium });
        network.add_effect(Separation { element: "pad".to_owned(), at: None, restitution: 0.0 });
        ScenePoint { network, settings: SolveSettings::lasting(0.6) }
    }
}

/// Deformation, its rate, the work of the force, and `∫ F^2.5 dt`.
type State = [f64; 4];

impl Impact<4> for Block {
    fn rates(&self, state: &State) -> State {
        let (force, rate) = (self.force(state), state[1]);
        let push = force.max(0.0);
        [rate, GRAVITY - force / self.mass, force * rate, push * push * push.sqrt()]
    }

    fn force(&self, [y, v, ..]: &State) -> f64 {
        let strain = y / self.thickness;
        let stress = if strain < 0.0 {
            MODULUS * strain
        } else {
            let ratio = strain / (1.0 - strain);
            DENSIFICATION * ratio * ratio - PLATEAU * (-MODULUS * strain / PLATEAU).exp_m1()
        };
        AREA * stress + DAMPING * v
    }

    fn force_rate(&self, state: &State) -> f64 {
        let strain = state[0] / self.thickness;
        let void = 1.0 - strain;
        let slope = MODULUS * (-MODULUS * strain / PLATEAU).exp()
            + 2.0 * DENSIFICATION * strain / (void * void * void);
        AREA / self.thickness * slope * state[1] + DAMPING * self.rates(state)[1]
    }

    fn depth(&self, state: &State) -> [f64; 2] {
        [state[0], state[1]]
    }
}

impl Block {
    /// The seven measures of a drop from a height \[m\], by hand.
    pub(crate) fn by_hand(mut self, height: f64, rtol: f64) -> [f64; 7] {
        let speed = (2.0 * GRAVITY * height).sqrt();
        let sizes = [0.03, speed, f64::INFINITY, f64::INFINITY];
        let Seen { peak, depth, contact, end } =
            follow(&mut self, [0.0, speed, 0.0, 0.0], sizes, rtol);
        let impulse = self.mass * (speed - end[1] + GRAVITY * contact);
        let unit = (self.mass * GRAVITY).powf(2.5);
        [peak, depth, contact, impulse, end[2], end[3] / unit, peak / self.mass]
    }
}

/// The seven measures of the instrument's drop from a height \[m\], by hand.
pub(crate) fn by_hand(height: f64, rtol: f64) -> [f64; 7] {
    INSTRUMENT.by_hand(height, rtol)
}
