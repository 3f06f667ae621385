use dashpot_dae::{Piece, Waveform};
use dashpot_network::{
    Node, dashpot,
    effects::{Face, Gravity, GravityStart, Separation, Touch},
    layers::{Layer, Layers, Resolution},
    spring,
};

use super::*;
use crate::{
    Solve, SolveSettings,
    measures::STANDARD_GRAVITY,
    similarity::{Similarity, alone, measured},
};

/// A head on a padding on a panel.
fn scene(padding: Model, mount: Model) -> Network {
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 10.0).moving(10.0));
    let panel = network.add_node(Node::mass("panel", 100.0));
    network.connect("padding", head, panel, padding).thickness = Some(0.02);
    network.connect("mount", panel, network.ground(), mount);
    network
}

fn burgers() -> Model {
    Tree::series([spring(2e7), dashpot(6e3), Tree::parallel([spring(2e7), dashpot(4e3)])])
}

fn mount() -> Model {
    Tree::Parallel(vec![Branch::new("spring", spring(5e7)), Branch::new("dashpot", dashpot(1e4))])
}

fn assert_similar(first: &Network, second: &Network, is_similar: bool) {
    for (first, second) in [(first, second), (second, first)] {
        let found = Similarity::between(first, second, Similarity::WITHIN).unwrap();
        let worst: Vec<_> = found.different().collect();
        assert_eq!(found.is_similar(), is_similar, "{:?} {worst:?}", found.structure);
    }
}

#[test]
fn the_order_of_branches_does_not_matter() {
    let turned = Tree::Parallel(vec![
        Branch::new("dashpot", dashpot(1e4)),
        Branch::new("spring", spring(5e7)),
    ]);
    let other =
        Tree::series([Tree::parallel([dashpot(4e3), spring(2e7)]), dashpot(6e3), spring(2e7)]);
    assert_similar(&scene(burgers(), mount()), &scene(other, turned), true);
    let two = |one: f64, other: f64| Tree::parallel([spring(one), spring(other), dashpot(1.0)]);
    assert_similar(&scene(burgers(), two(1e7, 4e7)), &scene(burgers(), two(4e7, 1e7)), true);
    assert_similar(&scene(burgers(), two(1e7, 4e7)), &scene(burgers(), two(4e7, 2e7)), false);
}

#[test]
fn a_four_parameter_padding_is_the_same_in_its_drawings() {
    // Appendix A: two Maxwell elements side by side are a Burgers model.
    let maxwell = |stiffness, damping| Tree::series([spring(stiffness), dashpot(damping)]);
    let own = |k: f64| scene(Tree::parallel([maxwell(k, 2e3), maxwell(2e7, 7e3)]), mount());
    let constants = FourParameterImpact::of(&own(1e7)).unwrap().padding;
    let other = scene(constants.model(), mount());
    assert_similar(&own(1e7), &other, true);
    assert_similar(&own(1e7 * (1.0 + 1e-8)), &other, false);
}

#[test]
fn effects_with_nothing_in_them_are_none() {
    let plain = scene(burgers(), mount());
    let mut other = plain.clone();
    other.add_effect(Gravity { acceleration: 0.0, start: GravityStart::Unloaded });
    let (element, at) = ("padding".to_owned(), Some("head".to_owned()));
    other.add_effect(Face { element, mass: 0.0, at, touch: Touch::Impact });
    assert_similar(&plain, &other, true);
}

#[test]
fn the_scene_from_the_other_side_is_the_same() {
    let mut network = scene(burgers(), mount());
    let side = network.add_node(Node::prescribed(
        "side",
        Waveform::new(vec![Piece { sine: 1e-4, omega: 300.0, ..Piece::default() }]).unwrap(),
    ));
    let panel = network.node_named("panel").unwrap();
    let layer = |name: &str, density: f64| Layer {
        name: name.to_owned(),
        thickness: 0.01,
        area: 0.02,
        density,
        model: spring(8e5),
    };
    let all = vec![layer("felt", 90.0), layer("foam", 40.0)];
    let layers = Layers { all, resolution: Resolution::Segments(4) };
    network.connect_layers("sheet", side, panel, layers);
    network.add_load("push", panel, Waveform::constant(30.0));
    network.add_effect(Gravity { acceleration: 9.81, start: GravityStart::Unloaded });
    let (element, at) = ("padding".to_owned(), Some("head".to_owned()));
    network.add_effect(Separation { element, at, restitution: 0.0 });
    let other = mirrored(&network);
    assert_similar(&network, &other, true);
    // It is the same to solve, too.
    let settings = SolveSettings::lasting(0.01).by_name("exact").unwrap();
    let [one, two] = [&network, &other].map(|own| own.solve_with(&settings).unwrap());
    for key in ["padding.peak-force", "padding.peak-deformation", "head.severity-index"] {
        let [one, two] = [&one, &two].map(|own| own.measure(key).unwrap().value.unwrap());
        assert!((one / two - 1.0).abs() < 1e-10, "{key}: {one} {two}");
    }
    let mut slower = other.clone();
    for node in slower.nodes_mut().iter_mut().filter(|node| node.is_impactor()) {
        node.start = Start::Velocity(-9.0);
    }
    assert_similar(&network, &slower, false);
}

#[test]
fn gravity_of_one_scene_alone_is_a_group_that_differs() {
    let plain = scene(burgers(), mount());
    let mut heavy = plain.clone();
    heavy.add_effect(Gravity { acceleration: 9.8, start: GravityStart::Equilibrium });
    for (first, second, values) in
        [(&plain, &heavy, [0.0, 9.8 * 2e-4]), (&heavy, &plain, [9.8 * 2e-4, 0.0])]
    {
        let found = Similarity::between(first, second, Similarity::WITHIN).unwrap();
        assert!(found.structure.is_empty(), "{:?}", found.structure);
        let pairs: Vec<_> = found.different().collect();
        assert_eq!(pairs.len(), 1, "{pairs:?}");
        assert_eq!(pairs[0].name, "gravity.value");
        let close = |at: usize| (pairs[0].values[at] - values[at]).abs() < 1e-15;
        assert!(close(0) && close(1), "{pairs:?}");
        // What that changes is what both scenes measure.
        let settings = SolveSettings::lasting(0.02).by_name("exact").unwrap();
        let [one, other] = &found.networks;
        let both = measured(one, other, &found.scale, &settings).unwrap();
        let force = both.iter().find(|own| own.key == "padding.contact-time").unwrap();
        assert!((force.apart.unwrap() - 0.0077).abs() < 5e-4, "{force:?}");
        let moved = alone(one, &found, &settings).unwrap();
        assert_eq!(moved.len(), 1);
    }
}

#[test]
fn a_fall_without_gravity_keeps_its_speed_beside_one_with_it() {
    let mut plain = Network::new();
    let head = plain.add_node(Node::mass("head", 2.0).dropped(1.0));
    plain.connect("pad", head, plain.ground(), spring(1e4)).thickness = Some(0.1);
    let mut other = plain.clone();
    other.add_effect(Gravity { acceleration: STANDARD_GRAVITY, start: GravityStart::Unloaded });
    let found = Similarity::between(&plain, &other, Similarity::WITHIN).unwrap();
    let names: Vec<&str> = found.different().map(|own| own.name.as_str()).collect();
    assert_eq!(names, ["gravity.value"]);
    assert!((found.scale.time - 1.0).abs() < 1e-14, "{:?}", found.scale);
}
