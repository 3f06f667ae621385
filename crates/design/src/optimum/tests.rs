use std::f64::consts::SQRT_2;

use dashpot_analysis::{
    Bound, Limit, SolveSettings,
    sweep::{PoseAt, ScenePoint},
};
use dashpot_network::{Model, Network, Node, dashpot, spring};

use super::*;

const SPEED: f64 = 5.0;
const TRAVEL: f64 = 0.03;
/// `v0²/D` \[m/s²\].
const UNIT: f64 = SPEED * SPEED / TRAVEL;

/// 1 kg on a pad that may come in by so much.
fn scene(model: Model, key: &str) -> ScenePoint {
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 1.0).moving(SPEED));
    network.connect("pad", head, network.ground(), model);
    let mut settings = SolveSettings::lasting(0.2);
    settings.limits = vec![Limit::new("pad.peak-deformation", Bound::Max(TRAVEL))];
    if key != "head.peak-acceleration" {
        settings.limits.push(Limit::new(key, Bound::Max(1e9)));
    }
    ScenePoint { network, settings }
}

/// A frequency \[1/s\] and a damping ratio.
fn variables(start: [f64; 2]) -> [Variable; 2] {
    let [frequency, damping] = start;
    [
        Variable { low: 20.0, high: 2000.0, start: frequency },
        Variable { low: 0.02, high: 3.0, start: damping },
    ]
}

fn best(model: &(dyn Fn(&[f64]) -> Model + Sync), key: &str) -> Design {
    let pose = |values: &[f64]| Ok(scene(model(values), key));
    let aim = Aim::Measure(key.to_owned());
    let pose: &PoseAt<'_> = &pose;
    design(&variables([200.0, 0.5]), &aim, &[pose], Effort::default()).unwrap()
}

fn kelvin(values: &[f64]) -> Model {
    let &[omega, ratio] = values else { unreachable!() };
    spring(omega * omega) | dashpot(2.0 * ratio * omega)
}

#[test]
fn the_best_kelvin_pad_is_4_percent_above_the_floor() {
    let own = best(&kelvin, "head.peak-acceleration");
    assert!(own.is_feasible && own.search.agree == own.search.starts, "{:?}", own.search);
    assert!((own.aim / UNIT - 0.5206).abs() < 5e-5, "{}", own.aim / UNIT);
    assert!((own.values[1] - 0.404).abs() < 5e-4, "{:?}", own.values);
    // Only the travel holds it, and 1 % more of that takes 1 % off.
    let travel = &own.kept[0];
    assert!(travel.is_active);
    let price = travel.price.unwrap() * TRAVEL / own.aim;
    assert!((price + 1.0).abs() < 1e-3, "{price}");
}

#[test]
fn the_best_maxwell_pad_is_two_thirds_off() {
    // c/√(k m) = 0.714.
    let maxwell = |values: &[f64]| -> Model {
        let &[omega, ratio] = values else { unreachable!() };
        spring(omega * omega) + dashpot(ratio * omega)
    };
    let own = best(&maxwell, "head.peak-acceleration");
    assert!((own.aim / UNIT - 0.688).abs() < 5e-4, "{}", own.aim / UNIT);
    assert!((own.values[1] - 0.714).abs() < 2e-3, "{:?}", own.values);
}

#[test]
fn what_contradicts_is_told_with_the_least_excess() {
    // On a spring peak · D ≥ v0² whatever its stiffness, so both are exceeded by √2.
    let pose = |values: &[f64]| {
        let mut point = scene(spring(values[0]), "head.peak-acceleration");
        let most = Bound::Max(0.5 * UNIT);
        point.settings.limits.push(Limit::new("head.peak-acceleration", most));
        Ok(point)
    };
    let variable = Variable { low: 1e2, high: 1e7, start: 1e3 };
    let own = design(&[variable], &Aim::Number(0), &[&pose], Effort::default()).unwrap();
    assert!(!own.is_feasible && own.search.feasible == 0);
    for kept in &own.kept {
        assert!((kept.margin + SQRT_2 - 1.0).abs() < 1e-4, "{:?}", own.kept);
    }
}

#[test]
fn the_worst_of_several_tests_counts() {
    // √2 times the speed on the same travel: twice the stiffness.
    let at = |speed: f64| {
        move |values: &[f64]| {
            let mut point = scene(spring(values[0]), "head.peak-acceleration");
            let head = point.network.node_named("head").unwrap();
            point.network.set_start(head, dashpot_network::Start::Velocity(speed));
            Ok(point)
        }
    };
    let (slow, fast) = (at(SPEED), at(SPEED * SQRT_2));
    let variable = Variable { low: 1e2, high: 1e7, start: 1e3 };
    let tests: [&PoseAt<'_>; 2] = [&slow, &fast];
    for aim in [Aim::Number(0), Aim::Measure("head.peak-acceleration".to_owned())] {
        let own = design(&[variable], &aim, &tests, Effort::default()).unwrap();
        let right = 2.0 * SPEED * SPEED / (TRAVEL * TRAVEL);
        assert!(own.is_feasible && (own.values[0] / right - 1.0).abs() < 1e-4, "{own:?}");
        assert_eq!(own.kept.iter().map(|own| own.is_active).collect::<Vec<_>>(), [false, true]);
    }
}
