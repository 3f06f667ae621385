//! Modes of chains of masses in closed form.

use super::*;

/// Two equal masses one behind the other, on equal springs and dashpots from the ground.
fn chain(loss: f64) -> Network {
    let mut network = Network::new();
    let near = network.add_node(Node::mass("near", MASS));
    let far = network.add_node(Node::mass("far", MASS));
    let part = || Model::parallel([spring(STIFFNESS), dashpot(loss * STIFFNESS)]);
    network.connect("first", near, network.ground(), part());
    network.connect("second", far, near, part());
    network
}

#[test]
fn chain_of_two_masses_has_the_golden_ratio_for_its_shapes() {
    let golden = f64::midpoint(1.0, 5.0_f64.sqrt());
    // In proportion to the stiffness, so that the shapes stay those without damping.
    for loss in [0.0, 1e-5, 1e-3] {
        let modes = shaken(&chain(loss)).modes();
        let squares = [1.0 / (golden * golden), golden * golden];
        let ratios = [1.0 / golden, -1.0 / golden];
        assert_eq!(modes.len(), 2);
        for ((mode, square), ratio) in modes.iter().zip(squares).zip(ratios) {
            let omega = natural() * square.sqrt();
            let zeta = 0.5 * loss * omega;
            let frequency = omega * (1.0 - zeta * zeta).sqrt() / TAU;
            assert!((mode.frequency / frequency - 1.0).abs() < 1e-12, "{}", mode.frequency);
            assert!((mode.damping_ratio - zeta).abs() < 1e-12, "{}", mode.damping_ratio);
            let shape = mode.shape.as_ref().unwrap();
            let value = |name: &str| {
                let swing = shape.iter().find(|own| own.node == name).unwrap().swing;
                (C::from_polar(swing.amplitude, swing.phase), swing.error)
            };
            let ((near, one), (far, other)) = (value("near"), value("far"));
            // The largest is 1: the far mass in the first mode, the near one in the second.
            let found = if ratio > 0.0 { near / far } else { far / near };
            assert!((found - ratio).norm() < 1e-6, "{found} {ratio}");
            assert!((found - ratio).norm() <= 4.0 * (one + other) + 1e-9, "{found} {one} {other}");
        }
    }
}

#[test]
fn mode_that_the_drive_does_not_excite_has_no_shape() {
    let mut network = Network::new();
    let middle = network.add_node(Node::mass("middle", MASS));
    network.connect("base", middle, network.ground(), spring(STIFFNESS));
    for name in ["left", "right"] {
        let side = network.add_node(Node::mass(name, MASS));
        network.connect(format!("to-{name}"), side, middle, spring(STIFFNESS));
    }
    let modes = shaken(&network).modes();
    let told: Vec<bool> = modes.iter().map(|mode| mode.shape.is_some()).collect();
    // Both sides against each other, with the middle at rest: at ω² = k/m.
    assert_eq!(told, [true, false, true]);
    assert!((modes[1].frequency * TAU / natural() - 1.0).abs() < 1e-12);
}
