use super::*;
use crate::driving_point::Agreement;

fn on_pad(pad: Model) -> Receptance {
    let (network, nodes) = network(&[1.0], &[(1, 0, pad)]);
    massive(&network, nodes[1], nodes[0])
}

fn assert_same(a: &Receptance, b: &Receptance) {
    let agreement = a.agreement(b);
    assert!(matches!(agreement, Agreement::Same { .. }), "{agreement:?}");
}

fn worst(a: &Receptance, b: &Receptance) -> (f64, f64) {
    match a.agreement(b) {
        Agreement::Different { omega, size, .. } => (omega, size),
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_network_agrees_with_itself_in_another_order() {
    let links = [
        (1, 2, kelvin(3.0, 0.1)),
        (2, 3, maxwell(5e4, 2.0)),
        (1, 3, spring(0.2)),
        (3, 0, kelvin(1e3, 7.0)),
        (2, 0, dashpot(0.3)),
    ];
    let (straight, nodes) = network(&[2.0, 0.0, 0.7], &links);
    let straight = massive(&straight, nodes[1], nodes[2]);
    let renamed = [0, 3, 1, 2];
    let links: Vec<_> =
        links.iter().rev().map(|(p, q, m)| (renamed[*q], renamed[*p], m.clone())).collect();
    let (other, nodes) = network(&[0.0, 0.7, 2.0], &links);
    assert_same(&straight, &massive(&other, nodes[3], nodes[1]));
}

#[test]
fn a_pad_and_its_canonical_forms_agree_under_a_mass() {
    use crate::{linear_model, model_of};
    use dashpot_rheology::Canonical;

    let pad = Tree::series([
        spring(2e3),
        kelvin(5e2, 3.0),
        Tree::parallel([spring(1e3), maxwell(4e2, 9.0)]),
    ]);
    let model = linear_model(&pad);
    let original = on_pad(pad);
    for form in [Canonical::Maxwell, Canonical::Kelvin] {
        assert_same(&original, &on_pad(model_of(&model.tree(form).unwrap())));
    }
}

#[test]
fn rounding_at_critical_damping_is_no_difference() {
    let exact = on_pad(kelvin(1.0, 2.0));
    assert_same(&exact, &on_pad(kelvin(1.0, 2.0 + 4.0 * f64::EPSILON)));
    assert_same(&exact, &on_pad(kelvin(1.0 - f64::EPSILON, 2.0)));
    let zener =
        |k: f64| on_pad(Tree::parallel([spring(k / 3.0), maxwell(8.0 * k / 3.0, 8.0 / 9.0)]));
    assert_same(&zener(1.0), &zener(1.0 + f64::EPSILON));
}

#[test]
fn the_worst_frequency_of_a_change_of_damping_is_the_resonance() {
    // |ΔH|/|H| = ω Δc |H|, for ζ = 0.05 largest near the peak: Δc/c.
    let change = 1e-9;
    let (omega, size) = worst(&on_pad(kelvin(1.0, 0.1)), &on_pad(kelvin(1.0, 0.1 + 0.1 * change)));
    assert!(near(omega, 1.0, 1e-3), "{omega}");
    assert!(near(size, change, 1e-3), "{size}");
}

#[test]
fn a_change_of_stiffness_below_the_poles_shows_at_rest() {
    // Overdamped: H(0) = 1/k, and faster motion does not feel the spring.
    let (omega, size) = worst(&on_pad(kelvin(1.0, 50.0)), &on_pad(kelvin(1.0 + 1e-8, 50.0)));
    assert!(omega < 1e-2, "{omega}");
    assert!(near(size, 1e-8, 1e-3), "{size}");
}

#[test]
fn a_change_of_mass_shows_at_high_rates() {
    let (first, nodes) = network(&[1.0], &[(1, 0, kelvin(1.0, 50.0))]);
    let (second, _) = network(&[1.0 + 1e-8], &[(1, 0, kelvin(1.0, 50.0))]);
    let (omega, size) =
        worst(&massive(&first, nodes[1], nodes[0]), &massive(&second, nodes[1], nodes[0]));
    assert!(omega > 1e3, "{omega}");
    assert!(near(size, 1e-8, 1e-3), "{size}");
}

#[test]
fn a_mode_that_shows_in_one_only_is_a_difference() {
    let plain = on_pad(kelvin(1.0, 0.5));
    let richer = on_pad(Tree::parallel([kelvin(1.0, 0.5), maxwell(1e-9, 1e-9)]));
    let (_, size) = worst(&plain, &richer);
    assert!(size > 1e-10 && size < 1e-8, "{size}");
}
