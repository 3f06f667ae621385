//! Solutions of which signals alone are asked for.

use dashpot_dae::Silent;
use dashpot_network::effects::Separation;

use super::*;

#[test]
fn signals_alone_are_those_of_the_run() {
    let mut struck = reference(1e4);
    struck.add_effect(Separation { element: "padding".to_owned(), at: None, restitution: 0.0 });
    for method in ["exact", "bdf", "dop853"] {
        let settings = SolveSettings {
            estimate: false,
            rtol: (method != "exact").then_some(1e-8),
            ..SolveSettings::lasting(0.02).by_name(method).unwrap()
        };
        let run = struck.solve_with(&settings).unwrap();
        let outputs = 0..run.assembly.system.outputs.len();
        let alone = solve_signals(&run.assembly, &settings, outputs.clone(), &mut Silent).unwrap();
        assert_eq!(alone.trajectory.method, method);
        assert_eq!(alone.rtol, run.solver.rtol);
        assert_eq!(alone.contacts(), run.contacts);
        let (alone, run) = (alone.solution(), run.solution());
        for (output, at) in outputs.flat_map(|own| (0..=50).map(move |at| (own, at))) {
            let time = 0.02 * f64::from(at) / 50.0;
            let [one, other] = [&alone, &run].map(|own| own.signal(output).value(time));
            assert_eq!(one.to_bits(), other.to_bits(), "{method}, {output}: {one} {other}");
        }
    }
}

#[test]
fn what_loses_its_energy_is_for_whoever_states_a_result_to_refuse() {
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 10.0).moving(10.0));
    let pad = Model::parallel([spring(1e6), dashpot(0.632)]);
    network.connect("pad", head, network.ground(), pad);
    let settings = SolveSettings {
        rtol: Some(1e-3),
        estimate: false,
        ..SolveSettings::lasting(5.0).by_name("bdf").unwrap()
    };
    let assembly = Arc::new(network.compile(settings.duration).unwrap());
    let judged = solve_assembly(&assembly, &[], &settings, &mut Silent);
    assert!(matches!(judged, Err(RunError::EnergyLost { .. })), "{judged:?}");
    assert!(solve_signals(&assembly, &settings, [], &mut Silent).is_ok());
}
