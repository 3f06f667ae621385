//! Two masses between two walls, pushed at the first: where all is symmetric, the mode in which they swing
//! against each other does not show in the force on the walls.

use std::f64::consts::TAU;

use dashpot_dae::Waveform;
use dashpot_network::{
    Model, Network, Node,
    elements::{Dashpot, Spring},
    part,
};
use nalgebra::Complex;

use super::super::*;

type C = Complex<f64>;

/// Masses \[kg\], and stiffness and damping of the outer and the inner link.
#[derive(Clone, Copy)]
struct Pair {
    masses: [f64; 2],
    stiffness: [f64; 2],
    damping: [f64; 2],
}

impl Pair {
    fn even(mass: f64, stiffness: f64) -> Self {
        Self { masses: [mass; 2], stiffness: [stiffness; 2], damping: [0.0; 2] }
    }

    fn vibration(&self, drive: &str) -> Vibration {
        let mut network = Network::new();
        let [one, two] = [("one", 0), ("two", 1)]
            .map(|(name, at)| network.add_node(Node::mass(name, self.masses[at])));
        let ground = network.ground();
        for (name, between, at) in
            [("left", [ground, one], 0), ("middle", [one, two], 1), ("right", [two, ground], 0)]
        {
            let (stiffness, damping) = (self.stiffness[at], self.damping[at]);
            let model = Model::parallel([part(Spring { stiffness }), part(Dashpot { damping })]);
            network.connect(name, between[0], between[1], model);
        }
        network.add_load("push", one, Waveform::constant(1.0));
        Vibration::new(&network, 1.0, Some(drive)).unwrap()
    }

    /// Angular frequency of the mode in which both swing against each other, of a pair that is even.
    fn against(&self) -> f64 {
        ((self.stiffness[0] + 2.0 * self.stiffness[1]) / self.masses[0]).sqrt()
    }

    /// The force on the ground, over the force on the first mass, of a pair that is even.
    fn even_ratio(&self, omega: f64) -> C {
        let s = C::new(0.0, omega);
        let link = s * self.damping[0] + self.stiffness[0];
        link / (link + s * s * self.masses[0])
    }

    /// The two undamped angular frequencies.
    fn natural(&self) -> [f64; 2] {
        let [outer, inner] = self.stiffness;
        let [a, b] = self.masses.map(|mass| (outer + inner) / mass);
        let coupling = inner * inner / (self.masses[0] * self.masses[1]);
        let root = (0.25 * (a - b) * (a - b) + coupling).sqrt();
        [0.5 * (a + b) - root, 0.5 * (a + b) + root].map(f64::sqrt)
    }
}

/// Unit systems: mass and stiffness of the same pair in kg and N/m, and in others.
const UNITS: [(f64, f64); 6] =
    [(0.5, 200.0), (0.3, 70.1), (3e-7, 2e9), (7e5, 1.3e-4), (4.448e3, 1.751e2), (1e-12, 1e-12)];

fn settings(from: f64, to: f64, points: usize) -> SweepSettings {
    SweepSettings { from: Some(from / TAU), to: Some(to / TAU), points, ..SweepSettings::default() }
}

#[test]
fn a_mode_that_cancels_is_no_resonance_and_the_ratio_there_is_its_limit() {
    for (mass, stiffness) in UNITS {
        let pair = Pair::even(mass, stiffness);
        let vibration = pair.vibration("push");
        let sweep = vibration.sweep(&SweepSettings::default()).unwrap();
        let found = &sweep.transmissions[0].resonances;
        assert_eq!(found.len(), 1, "{found:?}");
        assert_eq!(found[0].swing, None);
        let exact = (stiffness / mass).sqrt() / TAU;
        assert!((found[0].frequency - exact).abs() <= found[0].frequency_error, "{found:?}");
        for share in [0.0, 1e-15, 1e-13, 1e-11, 1e-9, 1e-6, 1e-3, 0.1] {
            let omega = pair.against() * (1.0 + share);
            let sweep = vibration.sweep(&settings(omega / 1.1, omega, 2)).unwrap();
            let own = sweep.transmissions[0].swings[1].unwrap();
            let ratio = C::from_polar(own.amplitude, own.phase);
            let off = (ratio - pair.even_ratio(omega)).norm();
            assert!(off <= own.error && own.error < 1e-12, "{share}: {off:e} {own:?}");
        }
    }
}

#[test]
fn light_damping_does_not_bring_a_cancelled_mode_back() {
    for (mass, stiffness) in UNITS {
        for part in [1e-15, 1e-13, 1e-11, 1e-8, 1e-4, 1e-2] {
            let size = part * (mass * stiffness).sqrt();
            let pair = Pair { damping: [size, 3.0 * size], ..Pair::even(mass, stiffness) };
            let omega = pair.against();
            let sweep = pair.vibration("push").sweep(&settings(omega / 1.1, omega, 2)).unwrap();
            let own = &sweep.transmissions[0];
            assert_eq!(own.resonances, [], "{part}");
            let swing = own.swings[1].unwrap();
            let ratio = C::from_polar(swing.amplitude, swing.phase);
            let off = (ratio - pair.even_ratio(omega)).norm();
            assert!(off <= swing.error && swing.error < 1e-6, "{part}: {off:e} {swing:?}");
        }
    }
}

#[test]
fn a_mode_that_nearly_cancels_is_one_resonance() {
    for (mass, stiffness) in UNITS {
        for part in [0.1, 1e-3, 1e-6, 1e-8, 1e-10, 1e-11] {
            let even = Pair::even(mass, stiffness);
            let pair = Pair { masses: [mass, mass * (1.0 + part)], ..even };
            let sweep = pair.vibration("push").sweep(&SweepSettings::default()).unwrap();
            let found = &sweep.transmissions[0].resonances;
            assert_eq!(found.len(), 2, "{part}: {found:?}");
            for (own, exact) in found.iter().zip(pair.natural()) {
                let off = (own.frequency - exact / TAU).abs();
                let rounding = 2.0 * f64::EPSILON * own.frequency;
                assert!(off <= own.frequency_error + rounding, "{part}: {off:e} {own:?}");
                assert!(own.frequency_error < 1e-12 * own.frequency, "{part}: {own:?}");
                assert_eq!(own.swing, None);
            }
        }
    }
}

#[test]
fn a_mode_that_may_cancel_is_listed_once_at_most() {
    for (mass, stiffness) in UNITS {
        for exponent in 20..=64 {
            let part = 10_f64.powf(-0.25 * f64::from(exponent));
            let even = Pair::even(mass, stiffness);
            let pair = Pair { masses: [mass * (1.0 + part), mass], ..even };
            let sweep = pair.vibration("push").sweep(&SweepSettings::default()).unwrap();
            let found = &sweep.transmissions[0].resonances;
            // Behind the pole and its zero there may be a low hill, which has a height.
            let undamped = found.iter().filter(|own| own.swing.is_none()).count();
            assert!(undamped <= 2 && found.len() <= 3, "{part}: {found:?}");
        }
    }
}

#[test]
fn the_steady_state_where_a_mode_cancels_is_its_limit() {
    let pair = Pair::even(0.5, 200.0);
    let frequency = pair.against() / TAU;
    let steady = pair.vibration("ground").steady(frequency, 2.0).unwrap();
    for node in steady.nodes.iter().filter(|node| node.name != "ground") {
        let own = node.displacement;
        assert!((own.amplitude - 1.0).abs() <= own.error && own.error < 1e-12, "{node:?}");
    }
    // Shaken at one mass, both move without limit, whatever the ground feels.
    let pushed = pair.vibration("push").steady(frequency, 2.0);
    assert!(matches!(pushed, Err(VibrationError::Unbounded { .. })));
}
