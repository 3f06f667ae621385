//! Against 120 digits: the tables are printed by `many_digits.py`, rounded to doubles.

#![expect(clippy::unreadable_literal, reason = "digits as the script prints them")]

use super::*;

/// A pole and its residue.
type Line = ([f64; 2], [f64; 2]);

/// Of doubles that come from twice the digits.
const DOUBLES: f64 = 2.0 * f64::EPSILON;

const BRIDGE: &[Line] = &[
    ([-0.020677228002109152, 0.0], [2.708987032596527e-06, 0.0]),
    ([-17.69230738460832, 0.0], [769.2307343541951, 0.0]),
    ([-3819.655276898439, 0.0], [0.0034804433410277336, 0.0]),
];

const LATTICE: &[Line] = &[
    ([-2.6316031403602196, 0.0], [26.313139089211766, 0.0]),
    ([-2.7778779843839767, 0.0], [1.168374413247707e-06, 0.0]),
    ([-3.1249999999902345, 0.0], [8.666432736010546e-16, 0.0]),
    ([-3036.365276860465, 0.0], [0.00017791423712860963, 0.0]),
    ([-2863332.2577237594, 0.0], [2.3124022256134053e-05, 0.0]),
];

const PAD: &[Line] = &[
    ([0.0, 0.0], [9.803914816392579e-10, 0.0]),
    ([-1.0199795863868549e-08, 0.0], [1.9567837141586724e-11, 0.0]),
    ([-0.00999301201391905, 0.0], [6.975987886113694e-10, 0.0]),
    ([-0.3333333000238362, 0.0], [3.328567796598512e-12, 0.0]),
    ([-9.995118037053512, 0.0], [4.7668213565300154e-07, 0.0]),
    ([-0.4011693452765415, -63.30774667903031], [-3.9842196651447333e-07, 0.003161719321806661]),
    ([-0.4011693452765415, 63.30774667903031], [-3.9842196651447333e-07, -0.003161719321806661]),
    ([-999.2025603054932, 0.0], [3.1846091070075615e-07, 0.0]),
    ([-99999.99999999999, 0.0], [1.5999984598538463e-22, 0.0]),
    ([-99999999.99999997, 0.0], [4.799999999995392e-25, 0.0]),
];

const MASSES: &[Line] = &[
    ([-0.01063807314056094, 0.0], [-5.106751456779274e-14, 0.0]),
    ([-2.158520338250538, 0.0], [0.00037266849009832433, 0.0]),
    ([-149.9743584558289, -278.5187657589567], [-0.00018112381732433944, 0.00020798921628938474]),
    ([-149.9743584558289, 278.5187657589567], [-0.00018112381732433944, -0.00020798921628938474]),
    ([-5750.794115986673, -1461.991423734257], [-5.211188447933695e-06, 0.3420149438987251]),
    ([-5750.794115986673, 1461.991423734257], [-5.211188447933695e-06, -0.3420149438987251]),
    ([-86947629.34064612, 0.0], [1.5214972894527939e-09, 0.0]),
];

const FREE: &[Line] = &[
    ([-0.014623642681777313, 0.0], [1.5000347046177462, 0.0]),
    ([-0.5866009774312281, 0.0], [-1.5121677313949744, 0.0]),
    ([-6.542410959393035, 0.0], [0.012133015579771912, 0.0]),
    ([-0.0008607816755514384, -483.0461384326835], [5.598728124726701e-09, 0.0017744434123061143]),
    ([-0.0008607816755514384, 483.0461384326835], [5.598728124726701e-09, -0.0017744434123061143]),
];

/// Constants of the lattice.
const SIZES: [f64; 13] = [1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1, 1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6];

fn assert_elements(found: &Massless, lines: &[Line]) {
    let elements = found.model.kelvin().unwrap().elements();
    assert_eq!(elements.len(), lines.len());
    // In rising order of the time, the table in rising order of the rate.
    for (element, (pole, residue)) in elements.iter().rev().zip(lines) {
        assert!(near(element.rate.high(), -pole[0], DOUBLES), "{element:?} {pole:?}");
        assert!(near(element.damping, 1.0 / residue[0], 2.0 * DOUBLES), "{element:?} {residue:?}");
    }
}

fn assert_poles(found: &Receptance, lines: &[Line]) {
    let poles = found.poles();
    assert_eq!(poles.len(), lines.len(), "{poles:?}");
    for (pole, (at, residue)) in poles.iter().zip(lines) {
        for (a, b) in [(pole.at, at), (pole.residues[0], residue)] {
            let change = (a[0] - b[0]).hypot(a[1] - b[1]);
            assert!(change <= DOUBLES * b[0].hypot(b[1]), "{pole:?} {at:?} {residue:?}");
        }
    }
}

#[test]
fn a_bridge_over_many_decades() {
    let links = [
        (1, 2, spring(1.1e6)),
        (3, 0, spring(2.3e-2)),
        (2, 3, spring(7.7e3)),
        (1, 3, spring(4.1)),
        (2, 0, dashpot(1.3e-3)),
        (1, 3, dashpot(3.7e5)),
        (2, 3, dashpot(9.1e-6)),
        (1, 2, dashpot(2.9e2)),
    ];
    let (network, nodes) = network(&[0.0; 3], &links);
    let found = massless(&network, nodes[1], nodes[0]);
    assert!(found.error < 1e-20, "{:e}", found.error);
    assert_elements(&found, BRIDGE);
}

#[test]
fn a_lattice_of_three_by_three() {
    let mut links = Vec::new();
    for node in 1..=9_usize {
        for (other, fits) in [(node + 1, node % 3 > 0), (node + 3, node <= 6)] {
            if !fits {
                continue;
            }
            let size = SIZES[(7 * node + 3 * other) % 13];
            let is_spring = (node + other) % 4 > 0;
            links.push((node, other, if is_spring { spring(size) } else { dashpot(size) }));
            if (node * other) % 3 == 0 {
                links.push((node, other, dashpot((0.3 + 0.01 * node as f64) * size)));
            }
        }
    }
    let (network, nodes) = network(&[0.0; 9], &links);
    let found = massless(&network, nodes[1], nodes[9]);
    assert!(found.error < 1e-17, "{:e}", found.error);
    let constant = 1.0100979597041009;
    assert!(near(found.model.kelvin().unwrap().spring_compliance(), constant, DOUBLES));
    assert_elements(&found, LATTICE);
}

#[test]
fn a_mass_on_a_pad_of_eight_maxwell_elements() {
    let times = [1e-8, 1e-5, 1e-3, 0.1, 3.0, 1e2, 1e5, 1e8];
    let weights = [3.0, 1e-6, 2e3, 5.0, 1e-3, 7.0, 1e4, 0.2];
    let pad = Tree::parallel(weights.iter().zip(times).map(|(&k, time)| maxwell(k, k * time)));
    let (network, nodes) = network(&[2.5], &[(1, 0, pad)]);
    let found = massive(&network, nodes[1], nodes[0]);
    assert!(found.error() < 1e-13, "{:e}", found.error());
    assert_poles(&found, PAD);
}

#[test]
fn masses_in_a_bridge() {
    let links = [
        (1, 2, spring(1e9)),
        (2, 3, spring(3e4)),
        (1, 3, spring(2e2)),
        (4, 5, spring(6e5)),
        (3, 5, spring(1e-2)),
        (1, 4, spring(5e3)),
        (2, 3, dashpot(11.0)),
        (3, 4, dashpot(2e3)),
        (1, 5, dashpot(1e-4)),
        (2, 0, dashpot(0.5)),
    ];
    let (network, nodes) = network(&[1e-3, 0.0, 40.0, 0.0, 7.0], &links);
    let found = massive(&network, nodes[1], nodes[5]);
    assert!(found.error() < 1e-18, "{:e}", found.error());
    assert_poles(&found, MASSES);
}

#[test]
fn free_masses() {
    let links = [
        (1, 2, spring(5.0)),
        (3, 4, spring(1e5)),
        (1, 3, spring(1e-2)),
        (2, 3, dashpot(0.7)),
        (1, 4, dashpot(1e-3)),
    ];
    let (network, nodes) = network(&[2.0, 0.0, 3.0, 0.5], &links);
    let found = massive(&network, nodes[1], nodes[4]);
    assert!(found.error() < 1e-20, "{:e}", found.error());
    assert_poles(&found, FREE);
}
