//! The softer padding of the thesis that stiffens, or that bottoms out on a stop: by hand and by ours.

use std::f64::consts::FRAC_PI_2;

use dashpot::{
    analysis::sweep::ScenePoint,
    scene::{ReadOptions, read},
};

use super::{
    explicit::{Impact, Seen, follow},
    foam::GRAVITY,
};

const SCENES: [&str; 2] = [
    include_str!("../../scenes/thesis-stiffening.toml"),
    include_str!("../../scenes/thesis-stop.toml"),
];
const HEAD: f64 = 10.0;
const PANEL: f64 = 100.0;
const SPEED: f64 = 10.0;
/// Stiffness and damping of the mount.
const MOUNT: [f64; 2] = [5e7, 1e4];
/// Those in series, and those side by side, of the pad.
const MAXWELL: [f64; 2] = [2e7, 4_500.450_045];
const KELVIN: [f64; 2] = [14_688_601.65, 3_916.960_439];
/// Slope at rest and limit of what stiffens.
const STIFFENING: [f64; 2] = [3e5, 0.02];
/// Where the stop is met, its stiffness and its damping.
const STOP: [f64; 3] = [0.018, 2e8, 1e4];

/// The measures that both find, in this order.
pub(crate) const KEYS: [&str; 5] = [
    "padding.peak-deformation",
    "padding.contact-time",
    "padding.coefficient-of-restitution",
    "head.severity-index",
    "head.peak-acceleration",
];

/// What acts besides the pad.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Besides {
    Stiffening,
    /// The stop, before it is met, while it pushes, and behind that.
    Stop(u8),
}

/// Places and speeds of head and panel, deformations of the pad's dashpot and of its Kelvin element, and `∫ F^2.5 dt`.
type State = [f64; 7];

impl Besides {
    /// The scene of ours.
    pub(crate) fn scene(self) -> ScenePoint {
        let text = SCENES[usize::from(self != Self::Stiffening)];
        let scene = read(text, &ReadOptions::default()).expect("a scene").value;
        let settings = scene.settings("auto").expect("settings");
        ScenePoint { network: scene.network, settings }
    }

    /// The five measures, by hand.
    pub(crate) fn by_hand(mut self, rtol: f64) -> [f64; 5] {
        let start = [0.0, SPEED, 0.0, 0.0, 0.0, 0.0, 0.0];
        let sizes = [0.02, SPEED, 2e-3, 2.0, 0.02, 2e-3, f64::INFINITY];
        let Seen { peak, depth, contact, end } = follow(&mut self, start, sizes, rtol);
        let unit = (HEAD * GRAVITY).powf(2.5);
        [depth, contact, (end[3] - end[1]) / SPEED, end[6] / unit, peak / HEAD]
    }

    /// The force of the pad alone, and the rates of its dashpot and of its Kelvin element.
    fn pad(state: &State) -> [f64; 3] {
        let [x, _, y, _, dashpot, kelvin, ..] = state;
        let force = MAXWELL[0] * (x - y - dashpot - kelvin);
        [force, force / MAXWELL[1], (force - KELVIN[0] * kelvin) / KELVIN[1]]
    }

    /// What acts besides, and its slopes over deformation and rate.
    fn other(self, [depth, rate]: [f64; 2]) -> [f64; 3] {
        match self {
            Self::Stiffening => {
                let [slope, limit] = STIFFENING;
                let tangent = (FRAC_PI_2 * depth / limit).tan();
                [slope * limit / FRAC_PI_2 * tangent, slope * (1.0 + tangent * tangent), 0.0]
            }
            Self::Stop(1) => {
                let [gap, stiffness, damping] = STOP;
                [stiffness * (depth - gap) + damping * rate, stiffness, damping]
            }
            Self::Stop(_) => [0.0; 3],
        }
    }
}

impl Impact<7> for Besides {
    fn rates(&self, state: &State) -> State {
        let [_, v, y, w, ..] = state;
        let [pad, dashpot, kelvin] = Self::pad(state);
        let force = pad + self.other(self.depth(state))[0];
        let push = force.max(0.0);
        let mount = MOUNT[0] * y + MOUNT[1] * w;
        let panel = (force - mount) / PANEL;
        let power = push * push * push.sqrt();
        [*v, -force / HEAD, *w, panel, dashpot, kelvin, power]
    }

    fn force(&self, state: &State) -> f64 {
        Self::pad(state)[0] + self.other(self.depth(state))[0]
    }

    fn force_rate(&self, state: &State) -> f64 {
        let rates = self.rates(state);
        let [_, stiffness, damping] = self.other(self.depth(state));
        let rate = rates[0] - rates[2];
        MAXWELL[0] * (rate - rates[4] - rates[5])
            + stiffness * rate
            + damping * (rates[1] - rates[3])
    }

    fn depth(&self, [x, v, y, w, ..]: &State) -> [f64; 2] {
        [x - y, v - w]
    }

    fn lasts(&self, state: &State) -> f64 {
        match self {
            Self::Stop(0) => STOP[0] - self.depth(state)[0],
            Self::Stop(1) => self.other(self.depth(state))[0],
            _ => 1.0,
        }
    }

    fn switch(&mut self) {
        if let Self::Stop(phase) = self {
            *phase += 1;
        }
    }
}
