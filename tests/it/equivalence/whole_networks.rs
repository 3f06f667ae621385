//! Networks with masses, compared by their responses at nodes.

use dashpot::network::{
    Network, Node, NodeId,
    driving_point::{Agreement, Receptance, Response},
    elements::Rigid,
    part,
};

use crate::thesis::{burgers, dashpot, impact, kelvin, spring};

/// Constants of the reference impact: K1, C1, K2, C2, K3, C3 and both masses.
const REFERENCE: [f64; 8] = [2e7, 4e3, 2e7, 6e3, 5e7, 1e4, 10.0, 100.0];

fn written_short(own: [f64; 8]) -> Network {
    let [k1, c1, k2, c2, k3, c3, head, panel] = own;
    impact(head, 10.0, burgers(k1, c1, k2, c2), [panel, k3, c3])
}

/// The same from the ground up, part by part, with springs and masses in pieces, a part that
/// reaches nothing, and no start speed.
fn written_long(own: [f64; 8]) -> Network {
    let [k1, c1, k2, c2, k3, c3, head_mass, panel_mass] = own;
    let mut network = Network::new();
    let loose = network.add_node(Node::massless("loose"));
    let [one, two, half] =
        ["one", "two", "half"].map(|name| network.add_node(Node::massless(name)));
    let panel = network.add_node(Node::mass("panel", 0.75 * panel_mass));
    let rest = network.add_node(Node::mass("rest", 0.25 * panel_mass));
    let head = network.add_node(Node::mass("head", head_mass));
    let ground = network.ground();
    let links: [(NodeId, NodeId, dashpot::network::Model); 11] = [
        (panel, ground, dashpot(c3)),
        (ground, rest, spring(0.5 * k3)),
        (panel, ground, spring(0.5 * k3)),
        (rest, panel, part(Rigid)),
        (two, rest, spring(k1)),
        (panel, two, dashpot(c1)),
        (two, one, dashpot(c2)),
        (one, half, spring(2.0 * k2)),
        (half, head, spring(2.0 * k2)),
        (half, loose, spring(3e6)),
        (half, loose, dashpot(2e3)),
    ];
    for (at, (from, to, model)) in links.into_iter().enumerate() {
        network.connect(format!("link-{at}"), from, to, model);
    }
    network
}

fn receptance(network: &Network, names: [&str; 2]) -> Receptance {
    let [a, b] = names.map(|name| network.node_named(name).unwrap_or(network.ground()));
    match network.driving_point(a, b).unwrap() {
        Response::Massive(found) => found,
        Response::Massless(found) => panic!("{found:?}"),
    }
}

const PLACES: [[&str; 2]; 3] = [["head", "ground"], ["head", "panel"], ["panel", "ground"]];

#[test]
fn a_network_written_in_another_way_is_the_same_at_every_node() {
    let [short, long] = [written_short(REFERENCE), written_long(REFERENCE)];
    for names in PLACES {
        let [a, b] = [&short, &long].map(|network| receptance(network, names));
        let found = a.agreement(&b);
        // Halves and doubles are exact, so both networks are the same to the last bit.
        assert!(matches!(found, Agreement::Same { difference } if difference < 1e-15), "{found:?}");
        assert!(matches!(b.agreement(&a), Agreement::Same { .. }));
    }
}

#[test]
fn a_billionth_of_any_constant_makes_another_network() {
    let short = written_short(REFERENCE);
    for changed in 0..REFERENCE.len() {
        let mut own = REFERENCE;
        own[changed] *= 1.0 + 1e-9;
        let long = written_long(own);
        for names in PLACES {
            let [a, b] = [&short, &long].map(|network| receptance(network, names));
            let Agreement::Different { omega, size, .. } = a.agreement(&b) else {
                panic!("constant {changed} at {names:?}");
            };
            assert!(size > 1e-12 && size < 1e-7, "constant {changed} at {names:?}: {size:e}");
            // Receptances are rounded to doubles, so their difference is known within 1e-15.
            let apart = |omega: f64| {
                let [[p, q], [r, s]] = [&a, &b].map(|own| own.at([0.0, omega]));
                (p - r).hypot(q - s) / p.hypot(q).max(r.hypot(s))
            };
            if omega > 0.0 && omega.is_finite() {
                let there = apart(omega);
                assert!((there - size).abs() < 1e-15, "{there:e} for {size:e} at {omega:e}");
            }
            for at in -300..=700 {
                let omega = 10f64.powf(f64::from(at) / 100.0);
                let there = apart(omega);
                assert!(
                    there < size * (1.0 + 1e-4) + 1e-15,
                    "constant {changed} at {names:?}: {there:e} at {omega:e}, not {size:e}"
                );
            }
        }
    }
}

#[test]
fn poles_of_the_reference_impact_are_those_of_the_thesis() {
    // For the printed groups, in units of 1/J: −23.555, −1.4715 ± 1.1679i, −0.15099 ± 1.3791i.
    let groups = crate::independent::Groups::printed(0.2);
    let found = receptance(&crate::thesis::from_groups(&groups), ["head", "ground"]);
    let poles: Vec<[f64; 2]> =
        found.poles().iter().map(|pole| pole.at).filter(|at| at[0] < 0.0).collect();
    let printed = [[-23.555, 0.0], [-1.4715, 1.1679], [-0.15099, 1.3791]];
    assert_eq!(poles.len(), 5, "{poles:?}");
    for [re, im] in poles {
        let is_near = |own: &[f64; 2]| (own[0] - re).hypot(own[1] - im.abs()) < 6e-4;
        assert!(printed.iter().any(is_near), "{re} {im}");
    }
    // Beside them, the response of a spring and dashpot alone has the free fall of the whole.
    let free = receptance(&two_free(), ["a", "b"]);
    let reduced = 2.0 * 3.0 / 5.0;
    for pole in free.poles() {
        // μ s² + c s + k = 0.
        let [re, im] = pole.at;
        let (square, twist) = (re * re - im * im, 2.0 * re * im);
        let (real, imaginary) = (reduced * square + 7.0 * re + 11.0, reduced * twist + 7.0 * im);
        assert!(real.hypot(imaginary) < 1e-13, "{:?}", pole.at);
    }
}

/// Two free masses, 2 kg and 3 kg, with a Kelvin–Voigt element of 11 N/m and 7 N s/m between them.
fn two_free() -> Network {
    let mut network = Network::new();
    let a = network.add_node(Node::mass("a", 2.0));
    let b = network.add_node(Node::mass("b", 3.0));
    network.connect("link", a, b, kelvin(11.0, 7.0));
    network
}
