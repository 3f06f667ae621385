//! A boxed instrument that falls on foam, with gravity, and is let go: by hand and by ours.
//!
//! By hand it is Dormand's and Prince's method of order 5 with a step that follows its error, its dense output,
//! and the peaks, the release and the quadratures of seven measures, for this scene alone.

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

impl Block {
    /// The force, and its slope over time.
    fn force(self, [y, v, ..]: &State) -> f64 {
        let strain = y / self.thickness;
        let stress = if strain < 0.0 {
            MODULUS * strain
        } else {
            let ratio = strain / (1.0 - strain);
            DENSIFICATION * ratio * ratio - PLATEAU * (-MODULUS * strain / PLATEAU).exp_m1()
        };
        AREA * stress + DAMPING * v
    }

    fn rates(self, state: &State) -> State {
        let (force, rate) = (self.force(state), state[1]);
        let push = force.max(0.0);
        [rate, GRAVITY - force / self.mass, force * rate, push * push * push.sqrt()]
    }
}

/// The stages of the method, and what its dense output takes of them besides.
const A: [&[f64]; 6] = [
    &[0.2],
    &[3.0 / 40.0, 9.0 / 40.0],
    &[44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0],
    &[19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0],
    &[9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0],
    &[35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0],
];
const ERROR: [f64; 7] = [
    71.0 / 57600.0,
    0.0,
    -71.0 / 16695.0,
    71.0 / 1920.0,
    -17253.0 / 339_200.0,
    22.0 / 525.0,
    -0.025,
];
const DENSE: [f64; 7] = [
    -12_715_105_075.0 / 11_282_082_432.0,
    0.0,
    87_487_479_700.0 / 32_700_410_799.0,
    -10_690_763_975.0 / 1_880_347_072.0,
    701_980_252_875.0 / 199_316_789_632.0,
    -1_453_857_185.0 / 822_651_844.0,
    69_997_945.0 / 29_380_423.0,
];

fn combined(from: &State, slopes: &[State], weights: &[f64], length: f64) -> State {
    let mut sum = [0.0; 4];
    for (slope, weight) in slopes.iter().zip(weights) {
        (0..4).for_each(|at| sum[at] += weight * slope[at]);
    }
    std::array::from_fn(|at| from[at] + length * sum[at])
}

/// A step and its dense output.
struct Step {
    length: f64,
    rows: [State; 5],
}

impl Step {
    fn of(from: &State, to: &State, slopes: &[State; 7], length: f64) -> Self {
        let change: State = std::array::from_fn(|at| to[at] - from[at]);
        let bend: State = std::array::from_fn(|at| length * slopes[0][at] - change[at]);
        let other: State = std::array::from_fn(|at| change[at] - length * slopes[6][at] - bend[at]);
        let last = combined(&[0.0; 4], slopes, &DENSE, length);
        Self { length, rows: [*from, change, bend, other, last] }
    }

    fn at(&self, x: f64) -> State {
        let y = 1.0 - x;
        let [a, b, c, d, e] = &self.rows;
        std::array::from_fn(|at| a[at] + x * (b[at] + y * (c[at] + x * (d[at] + y * e[at]))))
    }

    /// Where `f` passes zero in it, by false position.
    fn zero(&self, f: impl Fn(&State) -> f64) -> f64 {
        let (mut low, mut high) = (0.0, 1.0);
        let (mut at_low, mut at_high) = (f(&self.at(0.0)), f(&self.at(1.0)));
        for round in 0..40 {
            let x = low + (high - low) * at_low / (at_low - at_high);
            let value = f(&self.at(x));
            if value.abs() < 1e-12 * (at_low.abs() + at_high.abs()) || high - low < 1e-12 {
                return x;
            }
            if (value > 0.0) == (at_low > 0.0) {
                (low, at_low) = (x, value);
                at_high *= if round > 0 { 0.5 } else { 1.0 };
            } else {
                (high, at_high) = (x, value);
                at_low *= if round > 0 { 0.5 } else { 1.0 };
            }
        }
        0.5 * (low + high)
    }
}

impl Block {
    /// How fast the force changes.
    fn force_rate(self, state: &State) -> f64 {
        let strain = state[0] / self.thickness;
        let void = 1.0 - strain;
        let slope = MODULUS * (-MODULUS * strain / PLATEAU).exp()
            + 2.0 * DENSIFICATION * strain / (void * void * void);
        AREA / self.thickness * slope * state[1] + DAMPING * self.rates(state)[1]
    }

    /// The seven measures of a drop from a height \[m\], by hand.
    pub(crate) fn by_hand(self, height: f64, rtol: f64) -> [f64; 7] {
        let force = |own: &State| self.force(own);
        let force_rate = |own: &State| self.force_rate(own);
        let rates = |own: &State| self.rates(own);
        let speed = (2.0 * GRAVITY * height).sqrt();
        let mut state = [0.0, speed, 0.0, 0.0];
        let sizes = [0.03, speed, 0.5 * self.mass * speed * speed, 1e6];
        let (mut time, mut length) = (0.0, 1e-4);
        let (mut peak, mut depth) = (force(&state), 0.0_f64);
        let mut slopes = [[0.0; 4]; 7];
        slopes[0] = rates(&state);
        loop {
            let mut next = state;
            for (at, row) in A.iter().enumerate() {
                next = combined(&state, &slopes[..=at], row, length);
                slopes[at + 1] = rates(&next);
            }
            let off = combined(&[0.0; 4], &slopes, &ERROR, length);
            // The quadratures are as good as what they are of.
            let error = (0..2).map(|at| (off[at] / (rtol * sizes[at])).powi(2)).sum::<f64>();
            let error = (0.5 * error).sqrt();
            let factor = (0.9 * error.max(1e-10).powf(-0.2)).clamp(0.2, 5.0);
            if error > 1.0 {
                length *= factor.min(1.0);
                continue;
            }
            let step = Step::of(&state, &next, &slopes, length);
            peak = peak.max(force(&next));
            if force_rate(&state) > 0.0 && force_rate(&next) <= 0.0 {
                peak = peak.max(force(&step.at(step.zero(force_rate))));
            }
            if state[1] > 0.0 && next[1] <= 0.0 {
                depth = step.at(step.zero(|own| own[1]))[0];
            }
            if force(&next) <= 0.0 {
                let x = step.zero(force);
                let end = step.at(x);
                let contact = time + x * step.length;
                let impulse = self.mass * (speed - end[1] + GRAVITY * contact);
                let unit = (self.mass * GRAVITY).powf(2.5);
                return [peak, depth, contact, impulse, end[2], end[3] / unit, peak / self.mass];
            }
            time += length;
            length *= factor;
            state = next;
            slopes[0] = slopes[6];
        }
    }
}

/// The seven measures of the instrument's drop from a height \[m\], by hand.
pub(crate) fn by_hand(height: f64, rtol: f64) -> [f64; 7] {
    INSTRUMENT.by_hand(height, rtol)
}
