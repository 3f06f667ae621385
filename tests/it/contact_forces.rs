//! Contact forces of scenes of one form beside those of single runs.

use dashpot::{
    analysis::{
        Accuracy, Solve, SolveSettings,
        sweep::{ContactForces, ScenePoint},
    },
    network::{Network, Node, dashpot, effects::Separation, elements::CubicSpring, part, spring},
};

/// A head of the first number that strikes at the second on a pad of the others.
fn posed(own: &[f64], is_cubic: bool, opens: bool) -> ScenePoint {
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", own[0]).moving(own[1]));
    let ground = network.ground();
    if is_cubic {
        let law = part(CubicSpring { stiffness: own[2], cubic: 1e4 * own[3] });
        network.connect("pad", head, ground, law | dashpot(own[4]));
    } else {
        network.connect("pad", head, ground, spring(own[2]) | (spring(own[3]) + dashpot(own[4])));
    }
    if opens {
        network.add_effect(Separation {
            element: "pad".to_owned(),
            at: Some("head".to_owned()),
            restitution: 0.0,
        });
    }
    let mut settings = SolveSettings::lasting(0.05);
    settings.accuracy = Accuracy::of_all(1e-3);
    settings.estimate = false;
    settings.rtol = Some(1e-10);
    ScenePoint { network, settings }
}

#[test]
fn they_are_those_of_single_runs_before_and_behind_the_release() {
    let numbers = [4.0, 3.0, 60e3, 120e3, 300.0];
    let bounds = numbers.map(|own| [own / 10.0, own * 10.0]);
    for (is_cubic, opens) in [(false, true), (false, false), (true, true)] {
        let pose = |own: &[f64]| Ok(posed(own, is_cubic, opens));
        let forces = ContactForces::of(&pose, &numbers, &bounds).unwrap();
        for factors in [[1.0; 5], [1.3, 0.7, 2.0, 0.6, 1.7], [0.8, 1.1, 0.5, 2.3, 0.4]] {
            let own: Vec<f64> = numbers.iter().zip(factors).map(|(own, by)| own * by).collect();
            let point = posed(&own, is_cubic, opens);
            let run = point.network.solve_with(&point.settings).unwrap();
            let place = run.assembly.connection("pad").unwrap().force.unwrap();
            let solution = run.solution();
            let signal = solution.signal(place);
            let found = forces.at(&own).unwrap();
            assert!((found.mass - own[0]).abs() < 1e-12, "{}", found.mass);
            let (at, peak) = found.peak();
            assert!((peak / signal.absolute_maximum((0.0, 0.05)).value - 1.0).abs() < 1e-7);
            assert!((found.value(at) / peak - 1.0).abs() < 1e-9);
            for place in 0..=500 {
                let time = 1e-4 * f64::from(place);
                let off = (found.value(time) - signal.value(time)).abs();
                assert!(off < 1e-7 * peak, "{is_cubic} {opens} {factors:?} {time} {off}");
            }
            assert_eq!(found.value(-1e-9).to_bits(), 0.0_f64.to_bits());
        }
    }
}
