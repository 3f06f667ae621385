use super::*;
use crate::driving_point::DrivingPointError;

/// Of doubles that come from twice the digits.
const DOUBLES: f64 = 4.0 * f64::EPSILON;

fn one_mass(model: Model) -> Receptance {
    let (network, nodes) = network(&[1.0], &[(1, 0, model)]);
    massive(&network, nodes[1], nodes[0])
}

fn assert_near(a: [f64; 2], b: [f64; 2], tolerance: f64) {
    let size = b[0].hypot(b[1]);
    assert!((a[0] - b[0]).hypot(a[1] - b[1]) <= tolerance * size, "{a:?} {b:?}");
}

#[test]
fn a_mass_on_a_kelvin_voigt_element_below_critical_damping() {
    let found = one_mass(kelvin(1.0, 0.5));
    let omega = 0.9375_f64.sqrt();
    let poles = found.poles();
    assert_eq!(poles.len(), 2);
    assert_near(poles[1].at, [-0.25, omega], DOUBLES);
    assert_near(poles[1].residues[0], [0.0, -0.5 / omega], DOUBLES);
    assert_near(poles[0].at, [-0.25, -omega], DOUBLES);
    assert!(found.error() < 1e-28 && found.hidden().is_empty());
}

#[test]
fn critical_damping_is_one_pole_of_order_two() {
    let poles = one_mass(kelvin(1.0, 2.0)).poles();
    assert_eq!(poles.len(), 1);
    assert_eq!(poles[0].order, 2);
    assert_near(poles[0].at, [-1.0, 0.0], DOUBLES);
    assert_near(poles[0].residues[0], [1.0, 0.0], DOUBLES);
    // 1/(s + 1)²: nothing else.
    assert!(poles[0].residues[1][0].abs() < 1e-25 && poles[0].spread[0][0].abs() < 1e-25);
}

#[test]
fn close_to_critical_damping_the_receptance_keeps_its_digits() {
    for exponent in [-15, -14, -12, -10, -8, -6, -4, -2] {
        for sign in [-1.0, 1.0] {
            let c = 2.0 + sign * 10_f64.powi(exponent);
            let found = one_mass(kelvin(1.0, c));
            for omega in [0.1, 1.0, 7.0] {
                // 1/(1 − ω² + iωc), where c enters as the same double.
                let (re, im) = (1.0 - omega * omega, omega * c);
                let square = re * re + im * im;
                assert_near(found.at([0.0, omega]), [re / square, -im / square], 2.0 * DOUBLES);
            }
        }
    }
}

#[test]
fn above_critical_damping_both_poles_are_real() {
    let poles = one_mass(kelvin(1.0, 1e8)).poles();
    assert_near(poles[0].at, [-1e-8 * (1.0 + 1e-16), 0.0], DOUBLES);
    assert_near(poles[1].at, [-1e8 * (1.0 - 1e-16), 0.0], DOUBLES);
    assert_near(poles[0].residues[0], [1e-8, 0.0], DOUBLES);
    assert_near(poles[1].residues[0], [-1e-8, 0.0], DOUBLES);
}

#[test]
fn an_undamped_mass_has_poles_on_the_axis() {
    // 1 N/m and 10¹² N/m in a row: ω² = 1/(1 + 10⁻¹²).
    let poles = one_mass(Tree::series([spring(1.0), spring(1e12)])).poles();
    let omega = 1.0 / (1.0 + 1e-12_f64).sqrt();
    assert_near(poles[1].at, [0.0, omega], DOUBLES);
    assert_near(poles[1].residues[0], [0.0, -0.5 / omega], DOUBLES);
}

#[test]
fn a_triple_pole_stays_together() {
    // 1 kg on a Zener element: H = (s + 3)/(s + 1)³ but for the rounding of 1/3, 8/3 and 8/9.
    let zener = Tree::parallel([spring(1.0 / 3.0), maxwell(8.0 / 3.0, 8.0 / 9.0)]);
    let found = one_mass(zener);
    let poles = found.poles();
    assert_eq!((poles.len(), poles[0].order), (1, 3));
    assert_near(poles[0].at, [-1.0, 0.0], DOUBLES);
    assert_near(poles[0].residues[0], [2.0, 0.0], 2.0 * DOUBLES);
    assert_near(poles[0].residues[1], [1.0, 0.0], 2.0 * DOUBLES);
    assert!(poles[0].spread.iter().all(|d| d[0].hypot(d[1]) < DOUBLES));
    assert!(found.error() < 1e-20);
}

#[test]
fn two_free_masses_drift_and_swing() {
    let (m1, m2, k, c) = (1.0, 3.0, 2.0, 0.25);
    let (network, nodes) = network(&[m1, m2], &[(1, 2, kelvin(k, c))]);
    // Between them: the reduced mass.
    let reduced = m1 * m2 / (m1 + m2);
    let damping = c / (2.0 * reduced);
    let omega = (k / reduced - damping * damping).sqrt();
    let between = massive(&network, nodes[1], nodes[2]);
    assert_eq!(between.poles().len(), 2);
    assert_near(between.poles()[1].at, [-damping, omega], DOUBLES);
    assert_near(between.poles()[1].residues[0], [0.0, -0.5 / (omega * reduced)], DOUBLES);
    // The pole at zero is counted: the motion of the whole does not show.
    assert!(between.hidden()[0].rate[0].abs() < f64::MIN_POSITIVE);
    assert_eq!(between.hidden()[0].count, 2);
    // Against the ground: 1/(s² Σm), and a part of the swing.
    let alone = massive(&network, nodes[1], nodes[0]);
    let poles = alone.poles();
    assert_eq!((poles[0].order, poles[0].at), (2, [0.0, 0.0]));
    assert_near(poles[0].residues[0], [1.0 / (m1 + m2), 0.0], DOUBLES);
    assert!(poles[0].residues[1][0].abs() < 1e-30);
    let share = m2 / (m1 + m2);
    assert_near(
        poles[2].residues[0],
        [0.0, -0.5 * share * share / (omega * reduced)],
        2.0 * DOUBLES,
    );
}

#[test]
fn masses_tied_by_a_dashpot_creep_towards_each_other() {
    // y = F/(μ s²) (μ s/(μ s + c)) between them: 1/c (1/s − 1/(s + c/μ)).
    let (network, nodes) = network(&[1.0, 3.0], &[(1, 2, dashpot(1.5))]);
    let found = massive(&network, nodes[1], nodes[2]);
    let poles = found.poles();
    assert_near(poles[0].residues[0], [1.0 / 1.5, 0.0], DOUBLES);
    assert_near(poles[1].at, [-2.0, 0.0], DOUBLES);
    assert_near(poles[1].residues[0], [-1.0 / 1.5, 0.0], DOUBLES);
}

#[test]
fn a_twin_hides_one_of_two_equal_poles() {
    // Two equal oscillators on one mass: one of their motions is against each other.
    let links = [(1, 0, spring(1.0)), (1, 2, kelvin(2.0, 0.1)), (1, 3, kelvin(2.0, 0.1))];
    let (network, nodes) = network(&[1.0, 0.5, 0.5], &links);
    let found = massive(&network, nodes[1], nodes[0]);
    assert_eq!(found.poles().len(), 4);
    assert_eq!(found.hidden().iter().map(|hidden| hidden.count).sum::<usize>(), 2);
    // The twin alone, held: s² m + s c + k = 0.
    let omega = (4.0_f64 - 0.01).sqrt();
    assert!(found.hidden().iter().any(|hidden| near(hidden.rate[1], omega, DOUBLES)));
}

#[test]
fn equal_oscillators_that_both_show_are_one_pole() {
    let links = [(1, 2, spring(2.0)), (1, 0, spring(0.5)), (2, 0, spring(0.5))];
    let (coupled, nodes) = network(&[1.0, 1.0], &links);
    // Seen between them only the swing against each other shows: ω² = k + 2 k₁₂.
    let found = massive(&coupled, nodes[1], nodes[2]);
    assert_eq!(found.poles().len(), 2);
    assert!(near(found.poles()[1].at[1], 4.5_f64.sqrt(), DOUBLES));
    // Without the coupling: two equal poles, of which one combination shows.
    let (apart, nodes) = network(&[1.0, 1.0], &links[1..]);
    let found = massive(&apart, nodes[1], nodes[2]);
    assert_eq!(found.poles().len(), 2);
    assert_eq!(found.poles()[1].order, 1);
    assert_near(found.poles()[1].residues[0], [0.0, -0.5 / 0.5_f64.sqrt() * 2.0], DOUBLES);
    assert_eq!(found.hidden().iter().map(|hidden| hidden.count).sum::<usize>(), 2);
}

#[test]
fn the_terms_add_up_to_the_balance_of_forces() {
    let mut dice = Stream::new(3);
    for _ in 0..20 {
        let (m, k, c) = (around(&mut dice, 4.0), around(&mut dice, 8.0), around(&mut dice, 8.0));
        let (k1, c1) = (around(&mut dice, 8.0), around(&mut dice, 8.0));
        let pad = Tree::parallel([spring(k), maxwell(k1, c1)]);
        let links = [(1, 0, pad), (1, 2, spring(3.0 * k)), (2, 0, dashpot(c))];
        let (network, nodes) = network(&[m, 0.0], &links);
        let found = massive(&network, nodes[1], nodes[0]);
        for s in [1e-3, 1.0, 1e3] {
            let row = |a: f64, b: f64| a * b / (a + b);
            let stiffness = m * s * s + k + row(k1, c1 * s) + row(3.0 * k, c * s);
            assert_near(found.stiffness([s, 0.0]), [stiffness, 0.0], 2.0 * DOUBLES);
        }
    }
}

#[test]
fn a_network_beyond_the_limit_is_refused() {
    let links: Vec<_> = (0..150).map(|at| (at, at + 1, spring(1.0))).collect();
    let (network, nodes) = network(&[1.0; 150], &links);
    let error = network.driving_point(nodes[1], nodes[0]).unwrap_err();
    assert!(matches!(error, DrivingPointError::TooLarge { bodies: 150, .. }));
}
