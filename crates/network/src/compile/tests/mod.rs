mod amplitudes;
mod chains;

use dashpot_dae::Waveform;
use dashpot_rheology::{Branch, MOST_LEVELS, Tree};

use crate::{
    Assembly, Model, Network, NetworkError, Node, dashpot,
    effects::{Gravity, GravityStart},
    elements::Rigid,
    part, spring,
};

fn burgers() -> Model {
    Tree::series([spring(2e7), dashpot(6e3), Tree::parallel([spring(2e7), dashpot(4e3)])])
}

fn reference(pad: Model) -> Network {
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 10.0).moving(10.0));
    let panel = network.add_node(Node::mass("panel", 100.0));
    network.connect("padding", head, panel, pad).thickness = Some(0.02);
    let mount = Tree::parallel([spring(5e7), dashpot(1e4)]);
    network.connect("mount", panel, network.ground(), mount);
    network
}

/// Value of an output at the start.
fn at_start(assembly: &Assembly, name: &str) -> f64 {
    let output = assembly.system.outputs.at(assembly.output(name).unwrap());
    let mut w = vec![0.0; assembly.system.inputs.len()];
    assembly.system.inputs_at(0.0, 0.0, &mut w);
    output.scale * (output.unknowns.at(&assembly.system.initial) + output.inputs.at(&w))
}

/// Rate of the unknown of the given name at the start, in SI.
fn rate_at_start(assembly: &Assembly, name: &str) -> f64 {
    let system = &assembly.system;
    let at = system.unknowns.iter().position(|unknown| unknown.name == name).unwrap();
    let mut w = vec![0.0; system.inputs.len()];
    system.inputs_at(0.0, 0.0, &mut w);
    let dot = |row: nalgebra_sparse::csr::CsrRow<'_, f64>, z: &[f64]| -> f64 {
        row.col_indices().iter().zip(row.values()).map(|(&c, v)| v * z[c]).sum()
    };
    let rate = dot(system.jacobian.row(at), &system.initial) + dot(system.input_matrix.row(at), &w);
    rate * system.unknowns[at].scale / system.time_scale
}

fn error(network: &Network) -> NetworkError {
    network.compile(1.0).unwrap_err().0.remove(0)
}

#[test]
fn the_reference_has_six_states_and_no_algebraic_unknown() {
    let assembly = reference(burgers()).compile(0.02).unwrap();
    assert_eq!((assembly.system.states(), assembly.system.algebraic()), (6, 0));
    assert!(assembly.warnings.is_empty());
    assert_eq!(assembly.primitives.len(), 6);
    assert_eq!(&*assembly.primitives[0].name, "padding.1");
    assert!(at_start(&assembly, "padding.force").abs() < 1e-12);
    assert!((at_start(&assembly, "head.velocity") - 10.0).abs() < 1e-14);
    assert!((at_start(&assembly, "padding.rate") - 10.0).abs() < 1e-14);
}

#[test]
fn order_counts_masses_twice_and_algebraic_components_not_at_all() {
    let mut network = Network::new();
    let mass = network.add_node(Node::mass("mass", 1.0).moving(1.0));
    let [a, b, c] = ["a", "b", "c"].map(|name| network.add_node(Node::massless(name)));
    network.connect("k1", mass, a, spring(1.0));
    network.connect("c1", a, b, dashpot(1.0));
    network.connect("k2", b, c, spring(1.0));
    network.connect("k3", c, network.ground(), spring(1.0));
    let assembly = network.compile(1.0).unwrap();
    assert_eq!(assembly.system.states(), 2 + 3 - 2);
}

#[test]
fn stiffnesses_twelve_decades_apart_keep_all_digits() {
    let mut network = Network::new();
    let mass = network.add_node(Node::mass("mass", 1.0).moving(1.0));
    let node = network.add_node(Node::massless("node"));
    network.connect("soft", node, network.ground(), spring(1.0));
    network.connect("stiff", mass, node, spring(1e12));
    let assembly = network.compile(1.0).unwrap();
    let system = &assembly.system;
    let [l, t] = [system.unknowns[0].scale, system.time_scale];
    let v = system.unknowns[1].scale;
    let squared = -system.jacobian.get_entry(1, 0).unwrap().into_value() * v / (l * t);
    assert!((squared - 1.0 / (1.0 + 1e-12)).abs() < 4.0 * f64::EPSILON, "{squared:.17}");
    for name in ["soft.force", "stiff.force"] {
        let output = system.outputs.at(assembly.output(name).unwrap());
        let stiffness = output.scale * output.unknowns.coefficient(0) / l;
        assert!((stiffness - 1.0 / (1.0 + 1e-12)).abs() < 4.0 * f64::EPSILON, "{name}");
    }
}

#[test]
fn gravity_from_equilibrium_starts_in_balance() {
    let mut network = reference(burgers());
    network.add_effect(Gravity { acceleration: 9.806_65, start: GravityStart::Equilibrium });
    let assembly = network.compile(0.02).unwrap();
    assert!(at_start(&assembly, "padding.force").abs() < 1e-12);
    let static_equilibrium = 100.0 * 9.806_65 / 5e7;
    assert!((at_start(&assembly, "panel.position") - static_equilibrium).abs() < 1e-18);
    assert!((at_start(&assembly, "head.position") - static_equilibrium).abs() < 1e-18);
    assert!(rate_at_start(&assembly, "velocity of panel").abs() < 1e-12);
    assert!((rate_at_start(&assembly, "velocity of head") - 9.806_65).abs() < 1e-12);
}

#[test]
fn weight_on_a_series_dashpot_has_no_balance() {
    let mut network = Network::new();
    let crate_ = network.add_node(Node::mass("crate", 10.0));
    network.connect("pad", crate_, network.ground(), burgers());
    network.add_effect(Gravity { acceleration: 9.8, start: GravityStart::Equilibrium });
    assert_eq!(error(&network), NetworkError::NoBalance { nodes: vec!["crate".into()] });
}

#[test]
fn undetermined_places_are_refused_by_name() {
    let mut network = Network::new();
    let [a, b] = ["a", "b"].map(|name| network.add_node(Node::massless(name)));
    network.connect("k", a, b, spring(1.0));
    assert_eq!(error(&network), NetworkError::Undetermined { nodes: vec!["a".into(), "b".into()] });

    let mut network = Network::new();
    network.add_node(Node::massless("lost"));
    assert_eq!(error(&network), NetworkError::IsolatedNode { node: "lost".into() });

    let mut network = Network::new();
    let a = network.add_node(Node::massless("a"));
    network.connect("nothing", a, network.ground(), spring(0.0));
    assert_eq!(error(&network), NetworkError::Undetermined { nodes: vec!["a".into()] });
}

#[test]
fn a_step_across_dashpots_only_is_refused_and_across_a_maxwell_branch_is_not() {
    let step = || Waveform::constant(1e-3);
    let mut network = Network::new();
    let base = network.add_node(Node::prescribed("base", step()));
    let mass = network.add_node(Node::mass("mass", 1.0));
    network.connect("pad", base, mass, Tree::parallel([spring(1.0), dashpot(1.0)]));
    assert!(matches!(error(&network), NetworkError::StepAcrossDashpots { .. }));

    let mut network = Network::new();
    let base = network.add_node(Node::prescribed("base", step()));
    network.connect("pad", base, network.ground(), Tree::series([dashpot(6.0), spring(2.0)]));
    let assembly = network.compile(1.0).unwrap();
    assert_eq!(assembly.system.states(), 1);
    assert!((at_start(&assembly, "pad.force") - 2e-3).abs() < 1e-18);
}

#[test]
fn contradictions_of_rigid_links_are_refused() {
    let mut network = Network::new();
    let a = network.add_node(Node::mass("a", 1.0).moving(1.0));
    let b = network.add_node(Node::mass("b", 1.0));
    network.connect("bar", a, b, part(Rigid));
    assert!(matches!(error(&network), NetworkError::ContradictingMotions { .. }));

    let mut network = Network::new();
    let base = network.add_node(Node::prescribed("base", Waveform::constant(0.0)));
    network.connect("bar", base, network.ground(), part(Rigid));
    assert!(matches!(error(&network), NetworkError::ContradictingMotions { .. }));
}

#[test]
fn a_rigid_link_reports_the_force_that_it_carries() {
    let mut network = Network::new();
    let a = network.add_node(Node::mass("a", 3.0).moving(1.0));
    let b = network.add_node(Node::mass("b", 1.0).moving(1.0));
    network.connect("bar", a, b, part(Rigid));
    network.connect("pad", b, network.ground(), dashpot(8.0));
    let assembly = network.compile(1.0).unwrap();
    assert_eq!(assembly.system.states(), 2);
    assert!((at_start(&assembly, "pad.force") - 8.0).abs() < 1e-14);
    assert!((at_start(&assembly, "bar.force") - 6.0).abs() < 1e-14);
    assert!((at_start(&assembly, "a.acceleration") + 2.0).abs() < 1e-14);
}

#[test]
fn negative_constants_and_self_loops_are_refused_all_at_once() {
    let mut network = Network::new();
    let a = network.add_node(Node::mass("a", -1.0));
    let pad = Tree::Series(vec![
        Branch::new("spring", spring(-2.0)),
        Branch::new("c", dashpot(f64::NAN)),
    ]);
    network.connect("pad", a, a, pad);
    let errors = network.compile(1.0).unwrap_err().0;
    assert_eq!(errors.len(), 4);
    let text: Vec<String> = errors.iter().map(ToString::to_string).collect();
    assert!(
        text.contains(&"`spring` must be zero or positive, and finite, but it is -2".to_owned())
    );
}

#[test]
fn parts_of_constant_zero_vanish() {
    let mut pad = vec![burgers(), Tree::series([spring(0.0), dashpot(0.0), spring(0.0)])];
    pad.push(dashpot(0.0));
    let assembly = reference(Tree::parallel(pad)).compile(0.02).unwrap();
    assert_eq!(assembly.system.states(), 6);
    assert_eq!(assembly.primitives.len(), 6);
}

#[test]
fn a_reversed_element_is_warned_of() {
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 10.0).moving(10.0));
    network.connect("padding", network.ground(), head, burgers());
    let assembly = network.compile(0.02).unwrap();
    assert!(assembly.warnings[0].to_string().contains("looks reversed"));
    // Another way from the head to the ground makes that no nearer than what lies before it.
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 10.0).moving(10.0));
    let [shell, base] = ["shell", "base"].map(|name| network.add_node(Node::mass(name, 1.0)));
    let ground = network.ground();
    for (number, [from, to]) in
        [[head, ground], [head, shell], [shell, base], [base, ground]].into_iter().enumerate()
    {
        network.connect(format!("e{number}"), from, to, spring(1.0));
    }
    assert!(network.compile(0.02).unwrap().warnings.is_empty());
}

#[test]
fn large_massless_clusters_keep_their_velocities_as_algebraic_unknowns() {
    let mut network = Network::new();
    let mut last = network.ground();
    for at in 0..1000 {
        let node = network.add_node(Node::massless(format!("n{at}")));
        network.connect(format!("e{at}"), node, last, Tree::parallel([spring(1.0), dashpot(1.0)]));
        last = node;
    }
    network.add_load("pull", last, Waveform::constant(1.0));
    let assembly = network.compile(1.0).unwrap();
    assert_eq!((assembly.system.states(), assembly.system.algebraic()), (1000, 1000));
    assert!(assembly.system.jacobian.nnz() < 8000);
}

#[test]
fn amplitudes_too_small_to_be_squared_are_scaled() {
    let mut network = Network::new();
    let mass = network.add_node(Node::mass("mass", 1.0).moving(1e-300));
    network.connect("pad", mass, network.ground(), spring(1.0));
    let assembly = network.compile(1.0).unwrap();
    assert!((assembly.system.initial[1].abs() - 1.0).abs() < 1.0);
}

#[test]
fn a_phase_of_half_a_turn_is_no_jump() {
    use crate::waveforms::{Sine, WaveformKind};
    let shake = Sine { amplitude: 1.0, frequency: 2.0, phase: std::f64::consts::PI };
    let mut network = Network::new();
    let base = network.add_node(Node::prescribed("base", shake.waveform().unwrap()));
    let mass = network.add_node(Node::mass("mass", 1.0));
    network.connect("pad", base, mass, Tree::parallel([spring(1.0), dashpot(1.0)]));
    assert!(network.compile(1.0).is_ok());
}

#[test]
fn the_drive_of_a_mass_with_given_motion_pays_for_its_inertia_and_weight() {
    use crate::waveforms::{Sine, WaveformKind};
    let (mass, way, hertz, g) = (4.0, 0.01, 2.0, 9.8);
    let shake = Sine { amplitude: way, frequency: hertz, phase: 0.5 }.waveform().unwrap();
    let mut network = Network::new();
    let base = network.add_node(Node { mass, ..Node::prescribed("base", shake) });
    network.connect("pad", base, network.ground(), spring(50.0));
    network.add_effect(Gravity { acceleration: g, start: GravityStart::Equilibrium });
    let assembly = network.compile(1.0).unwrap();
    let omega = std::f64::consts::TAU * hertz;
    let place = way * f64::sin(0.5);
    let expected = -mass * omega * omega * place + 50.0 * place - mass * g;
    let found = at_start(&assembly, "motion of base.force");
    assert!((found - expected).abs() < 1e-12 * expected.abs(), "{found} is not {expected}");
}

#[test]
fn jumps_and_kinks_in_the_motion_of_a_mass_are_refused() {
    use crate::waveforms::{Ramp, WaveformKind};
    for (motion, fault) in [
        (Waveform::constant(0.1), "jumps"),
        (Ramp { height: 1.0, rise: 0.2, start: 0.1 }.waveform().unwrap(), "has a kink"),
    ] {
        let mut network = Network::new();
        let base = network.add_node(Node { mass: 2.0, ..Node::prescribed("base", motion.clone()) });
        network.connect("pad", base, network.ground(), spring(50.0));
        assert!(error(&network).to_string().contains(fault));
        // The face of a pad that the motion moves says that it is the face.
        let mut network = Network::new();
        let base = network.add_node(Node::prescribed("base", motion.clone()));
        network.connect("pad", base, network.ground(), spring(50.0));
        let (element, touch) = ("pad".to_owned(), crate::effects::Touch::Impact);
        network.add_effect(crate::effects::Face { element, mass: 0.1, at: None, touch });
        let told = error(&network).to_string();
        assert!(told.contains("and `pad.face`, which moves with it, has mass"), "{told}");
        let mut network = Network::new();
        let base = network.add_node(Node::prescribed("base", motion));
        network.connect("pad", base, network.ground(), spring(50.0));
        assert!(network.compile(1.0).is_ok());
    }
}

#[test]
fn a_shifted_base_is_no_jump_where_the_start_is_in_balance() {
    let mut network = Network::new();
    let base = network.add_node(Node::prescribed("base", Waveform::constant(0.01)));
    let mass = network.add_node(Node::mass("mass", 1.0));
    network.connect("pad", mass, base, Tree::parallel([spring(100.0), dashpot(1.0)]));
    assert!(matches!(error(&network), NetworkError::StepAcrossDashpots { .. }));
    network.add_effect(Gravity { acceleration: 10.0, start: GravityStart::Equilibrium });
    let assembly = network.compile(1.0).unwrap();
    assert!((at_start(&assembly, "mass.position") - 0.11).abs() < 1e-15);
}

#[test]
fn an_impactor_that_moves_the_other_way_turns_the_order_around() {
    for (velocity, ends, warned) in
        [(-2.0, false, false), (-2.0, true, true), (2.0, false, true), (2.0, true, false)]
    {
        let mut network = Network::new();
        let head = network.add_node(Node::mass("head", 1.0).moving(velocity));
        let ground = network.ground();
        let [a, b] = if ends { [head, ground] } else { [ground, head] };
        network.connect("pad", a, b, spring(10.0));
        assert_eq!(network.compile(1.0).unwrap().warnings.len(), usize::from(warned));
    }
}

#[test]
fn a_rigid_link_is_not_said_to_carry_no_force() {
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 1.0).moving(2.0));
    let plate = network.add_node(Node::massless("plate"));
    network.connect("link", head, plate, part(Rigid));
    network.connect("pad", plate, network.ground(), spring(10.0));
    let assembly = network.compile(1.0).unwrap();
    assert!(assembly.warnings.is_empty());
    assert_eq!(assembly.nodes[1].body, assembly.nodes[2].body);
    assert!(assembly.connections[0].is_rigid && !assembly.connections[1].is_rigid);
}

#[test]
fn models_nest_to_the_limit_and_are_refused_beyond() {
    let nested = |levels: usize| {
        let more = |model, _| Tree::series([spring(1e6), model]);
        reference((0..levels).fold(spring(1e6), more))
    };
    assert!(nested(MOST_LEVELS).compile(0.01).is_ok());
    let refused = error(&nested(MOST_LEVELS + 1));
    assert_eq!(refused, NetworkError::TooDeep { element: "padding".to_owned() });
    assert_eq!(refused.to_string(), "the model of `padding` nests more than 128 levels deep");
}
