//! Random networks against the balance of forces at real rates, where nothing cancels.

use dashpot_numerics::DoubleDouble;

use super::*;
use crate::driving_point::{
    circuit::{Circuit, Ends},
    complex::Complex,
    links::{Links, dot, pair},
};

/// The receptance at a real rate by star–mesh elimination of all but the two nodes: sums of
/// positive terms only.
fn receptance(network: &Network, a: NodeId, b: NodeId, s: f64) -> DoubleDouble {
    let circuit = Circuit::of(network, a, b).unwrap().unwrap();
    let mut order: Vec<usize> = (0..circuit.bodies).collect();
    order.sort_by_key(|&body| circuit.forces.contains(&Some(body)));
    let ends = |ends: Ends| {
        ends.map(|end| end.and_then(|body| order.iter().position(|&other| other == body)))
    };
    let mut links = Links::new(circuit.bodies);
    circuit.springs.iter().for_each(|link| links.add(ends(link.ends), link.constant));
    circuit.dashpots.iter().for_each(|link| links.add(ends(link.ends), link.constant * s));
    for (body, &mass) in circuit.masses.iter().enumerate() {
        links.add(ends([Some(body), None]), mass * s * s);
    }
    let mut forces = pair(circuit.bodies, ends(circuit.forces));
    links.factor().solve_lower(&mut forces);
    dot(&forces, &forces)
}

/// A random connected network of up to nine nodes over many decades.
fn scene(dice: &mut Stream, has_masses: bool, decades: f64) -> (Network, Vec<NodeId>) {
    let count = 2 + dice.below(8);
    let is_held = dice.share() < 0.6;
    let masses: Vec<f64> = (0..count)
        .map(|at| {
            let is_mass = has_masses && (at == count - 1 || dice.share() < 0.5);
            if is_mass { around(dice, decades) } else { 0.0 }
        })
        .collect();
    let element = |dice: &mut Stream| {
        let constant = around(dice, decades);
        match dice.below(4) {
            0 => spring(constant),
            1 => dashpot(constant),
            2 => kelvin(constant, around(dice, decades)),
            _ => maxwell(constant, around(dice, decades)),
        }
    };
    let first = usize::from(!is_held);
    let mut links = Vec::new();
    for node in first + 1..=count {
        let other = first + dice.below(node - first);
        links.push((node, other, element(dice)));
    }
    for _ in 0..count {
        let p = first + dice.below(count + 1 - first);
        let q = first + dice.below(count + 1 - first);
        if p != q {
            links.push((p, q, element(dice)));
        }
    }
    network(&masses, &links)
}

#[test]
fn receptances_with_masses_balance_the_forces() {
    let mut dice = Stream::new(5);
    let mut uncertain = 0;
    for round in 0..400 {
        let decades = [2.0, 6.0, 10.0, 14.0][round % 4];
        let (network, nodes) = scene(&mut dice, true, decades);
        let (a, b) = (nodes[1], nodes[2]);
        let Response::Massive(found) = network.driving_point(a, b).unwrap() else { continue };
        // Faint strengths beside strong ones are known less well, and the error says so.
        let known = [1e-12, 1e-12, 1e-6, 1e-3][round % 4];
        assert!(found.error() < known, "{round}: {:e}", found.error());
        uncertain += usize::from(found.error() > 5e-12);
        for exponent in -12..=12 {
            let s = 10_f64.powi(exponent);
            let at = Complex::new(s, 0.0);
            let expected = Complex::new(receptance(&network, a, b, s), 0.0);
            let change = (found.value(at) - expected).size();
            // Terms of both signs: their sizes carry the error. Strengths below the rounding of
            // the poles' shapes count as hidden.
            let sizes: f64 = found.terms.iter().map(|term| term.value(at).size()).sum();
            let bound = (10.0 * found.error() + 1e-18) * (sizes + found.compliance.high());
            assert!(change <= bound, "{round} at {s:e}: {change:e} of {bound:e}");
        }
    }
    assert!(uncertain < 16, "{uncertain}");
}

#[test]
fn massless_responses_balance_the_forces() {
    let mut dice = Stream::new(6);
    let mut doubtful = 0;
    for round in 0..400 {
        let decades = [2.0, 6.0, 10.0, 14.0][round % 4];
        let (network, nodes) = scene(&mut dice, false, decades);
        let (a, b) = (nodes[1], nodes[2]);
        let found = massless(&network, a, b);
        // Modes that add less than 10⁻²² to the compliance are known less well.
        doubtful += usize::from(found.error >= 1e-12);
        for exponent in -12..=12 {
            let s = 10_f64.powi(exponent);
            let expected = receptance(&network, a, b, s).high();
            // A sum of some ten positive terms in doubles.
            assert!(near(found.model.retardance(s), expected, 1e-14), "{round} at {s:e}");
        }
    }
    assert!(doubtful <= 400 / 16, "{doubtful}");
}
