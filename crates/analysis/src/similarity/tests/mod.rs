mod laboratory;
mod of_the_thesis;

use dashpot_dae::{Piece, Waveform};
use dashpot_network::{
    Network, Node, dashpot,
    effects::{Face, Gravity, GravityStart, Separation, Touch},
    elements::{Contact, CubicSpring, ELEMENTS, PowerDashpot, TableSpring},
    layers::{Layer, Layers, Resolution},
    parameters::{Dimension, Kind as _},
    part, spring,
};
use dashpot_numerics::Stream;
use dashpot_rheology::Tree;

use super::*;
use crate::{
    MeasureWish, Solve, SolveSettings,
    measures::{Clip3ms, Dri, Edi, Hic15, PeakForce, SeverityIndex},
};

/// The reference case of the thesis.
fn reference() -> Network {
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 10.0).moving(10.0));
    let panel = network.add_node(Node::mass("panel", 100.0));
    let padding =
        Tree::series([spring(2e7), dashpot(6e3), Tree::parallel([spring(2e7), dashpot(4e3)])]);
    network.connect("padding", head, panel, padding).thickness = Some(0.02);
    let mount = Tree::parallel([spring(5e7), dashpot(1e4)]);
    network.connect("mount", panel, network.ground(), mount);
    network
}

/// A scene with much of what there is.
fn mixed() -> Network {
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 4.0).dropped(1.5));
    let plate = network.add_node(Node::mass("plate", 2.0));
    let base = network.add_node(Node::prescribed(
        "base",
        Waveform::new(vec![Piece { sine: 1e-3, omega: 300.0, ..Piece::default() }]).unwrap(),
    ));
    let pad = Tree::parallel([part(CubicSpring::sample()), dashpot(50.0), spring(3e4)]);
    network.connect("pad", head, plate, pad).thickness = Some(0.03);
    let below = Tree::series([spring(9e5), part(TableSpring::sample())]);
    network.connect("below", plate, base, below).area = Some(0.01);
    let side = network.add_node(Node::mass("side", 0.3));
    network.connect("beside", plate, side, part(PowerDashpot::sample()));
    network.connect("gap", side, network.ground(), part(Contact::sample()));
    let layer = |name: &str| Layer {
        name: name.to_owned(),
        thickness: 0.01,
        area: 0.02,
        density: 120.0,
        model: spring(8e5),
    };
    let layers =
        Layers { all: vec![layer("felt"), layer("foam")], resolution: Resolution::Segments(4) };
    network.connect_layers("sheet", side, network.ground(), layers);
    network.add_effect(Gravity { acceleration: 9.81, start: GravityStart::Unloaded });
    let (element, at) = ("pad".to_owned(), Some("head".to_owned()));
    network.add_effect(Separation { element: element.clone(), at: at.clone(), restitution: 0.2 });
    network.add_effect(Face { element, mass: 0.1, at, touch: Touch::Moving });
    let push = Piece { start: 1e-3, slope: 2e4, ..Piece::default() };
    let pieces = vec![Piece { start: -1.0, ..Piece::default() }, push];
    network.add_load("push", plate, Waveform::new(pieces).unwrap());
    network
}

fn random_scale(stream: &mut Stream) -> Scale {
    let mut factor = || stream.between(1e-3, 1e3);
    Scale { mass: factor(), length: factor(), time: factor() }
}

fn close(found: f64, expected: f64, relative: f64) {
    assert!(
        (found - expected).abs() <= relative * expected.abs(),
        "{found} is not {expected} within {relative}"
    );
}

#[test]
fn references_are_mass_speed_and_thickness_and_formulas_say_so() {
    let groups = Groups::of(&reference()).unwrap();
    let symbols: Vec<&str> = groups.references.iter().map(|reference| reference.symbol).collect();
    assert_eq!(symbols, ["m", "V", "δ"]);
    let stiffness = groups.group("padding.1.spring").unwrap();
    assert_eq!(stiffness.formula, "padding.1.spring δ²/(m V²)");
    close(stiffness.value, 8.0, 1e-14);
    let damping = groups.group("padding.2.dashpot").unwrap();
    assert_eq!(damping.formula, "padding.2.dashpot δ/(m V)");
    close(damping.value, 6e3 * 0.02 / 100.0, 1e-14);
    assert_eq!(groups.groups.len(), 10 - 3);
}

#[test]
fn scenes_without_impactor_have_references_too() {
    let mut network = Network::new();
    let mass = network.add_node(Node::mass("mass", 2.0));
    network.connect("pad", mass, network.ground(), spring(50.0));
    let groups = Groups::of(&network).unwrap();
    // Mass and stiffness: no length, so the rank is two, and no group is left.
    assert_eq!((groups.rank(), groups.groups.len()), (2, 0));
    close(groups.unit(Dimension::TIME).unwrap(), 0.2, 1e-15);
    assert_eq!(groups.unit(Dimension::LENGTH), None);
    let empty = Groups::of(&Network::new()).unwrap();
    assert_eq!((empty.rank(), empty.groups.len()), (0, 0));
}

#[test]
fn rescaled_networks_are_similar_and_all_others_are_not() {
    let mut stream = Stream::new(6);
    for network in [reference(), mixed()] {
        for _ in 0..50 {
            let scale = random_scale(&mut stream);
            let other = scaled(&network, &scale).unwrap();
            let found = Similarity::between(&network, &other, Similarity::WITHIN).unwrap();
            assert!(found.structure.is_empty(), "{:?}", found.structure);
            let worst = found.groups.iter().map(|group| group.apart).fold(0.0, f64::max);
            assert!(found.is_similar(), "{worst} at {scale:?}");
            for (found, own) in [
                (found.scale.mass, scale.mass),
                (found.scale.length, scale.length),
                (found.scale.time, scale.time),
            ] {
                close(found, own, 1e-13);
            }
        }
        // Each parameter alone, changed by a part in 10⁹.
        for quantity in Inventory::of(&network).unwrap().quantities {
            if quantity.value == 0.0 {
                continue;
            }
            let value = quantity.value * (1.0 + 1e-9);
            let Ok(other) = groups::with_value(&network, &quantity.name, value) else {
                continue;
            };
            let found = Similarity::between(&network, &other, Similarity::WITHIN).unwrap();
            assert!(!found.is_similar(), "{}", quantity.name);
        }
    }
}

#[test]
fn other_names_do_not_part_similar_scenes() {
    let mut other = Network::new();
    let ball = other.add_node(Node::mass("ball", 10.0).moving(10.0));
    let frame = other.add_node(Node::mass("frame", 100.0));
    let kelvin = Tree::parallel([spring(2e7), dashpot(4e3)]);
    let model = Tree::Series(vec![
        dashpot_rheology::Branch::new("first", spring(2e7)),
        dashpot_rheology::Branch::new("second", dashpot(6e3)),
        dashpot_rheology::Branch::new("third", kelvin),
    ]);
    other.connect("pad", ball, frame, model).thickness = Some(0.02);
    let mount = Tree::parallel([spring(5e7), dashpot(1e4)]);
    other.connect("feet", frame, other.ground(), mount);
    let found = Similarity::between(&reference(), &other, 0.0).unwrap();
    assert!(found.is_similar(), "{:?}", found.structure);
    let mut third = other.clone();
    third.set_model(1, Tree::series([spring(5e7), dashpot(1e4)]));
    let found = Similarity::between(&reference(), &third, 0.0).unwrap();
    assert!(found.structure.iter().any(|own| own.contains("mount.model")), "{:?}", found.structure);
}

#[test]
fn similar_scenes_have_equal_dimensionless_answers() {
    let mut stream = Stream::new(66);
    let network = reference();
    let measures = vec![
        MeasureWish::new("head", Hic15::default()),
        MeasureWish::new("head", Clip3ms::default()),
        MeasureWish::new("head", Edi::default()),
        MeasureWish::new("mount", PeakForce::default()),
    ];
    let settings =
        SolveSettings { measures, ..SolveSettings::lasting(0.02).by_name("exact").unwrap() };
    for _ in 0..8 {
        let scale = random_scale(&mut stream);
        let other = scaled(&network, &scale).unwrap();
        for own in measured(&network, &other, &scale, &settings).unwrap() {
            let [one, other] = own.values;
            assert_eq!(one.is_some(), other.is_some(), "{}", own.key);
            let apart = own.of_size.unwrap_or(0.0);
            assert!(apart <= 1e-12, "{}: {apart:e} at {scale:?}", own.key);
        }
    }
}

#[test]
fn measures_with_times_of_their_own_are_left_out() {
    let measures = vec![MeasureWish::new("head", Dri::default())];
    let settings = SolveSettings { measures, ..SolveSettings::lasting(0.02) };
    let scale = Scale { time: 2.0, ..Scale::ONE };
    let (similar, left_out) = similar_settings(&settings, &scale);
    assert_eq!(left_out, ["head.dri"]);
    assert!(similar.measures.is_empty());
    close(similar.duration, 0.04, 1e-15);
}

#[test]
fn near_similar_scenes_differ_as_predicted() {
    // A mass on a spring: the peak force goes with √K, the depth with 1/√K; energy does not change.
    let scene = |stiffness: f64| {
        let mut network = Network::new();
        let head = network.add_node(Node::mass("head", 2.0).moving(3.0));
        let pad = network.connect("pad", head, network.ground(), spring(stiffness));
        pad.thickness = Some(0.1);
        network
    };
    let (first, second) = (scene(1e4), scene(1.21e4));
    let found = Similarity::between(&first, &second, Similarity::WITHIN).unwrap();
    let different: Vec<&GroupPair> = found.different().collect();
    assert_eq!(different.len(), 1);
    assert_eq!(different[0].name, "pad.spring");
    close(different[0].apart, 0.21 / 1.21, 1e-12);
    let settings = SolveSettings::lasting(0.1).by_name("exact").unwrap();
    let pairs = measured(&first, &found.networks[1], &found.scale, &settings).unwrap();
    let ratio = |key: &str| {
        let own = pairs.iter().find(|pair| pair.key == key).unwrap();
        own.values[1].unwrap() / own.values[0].unwrap()
    };
    close(ratio("pad.peak-force"), 1.1, 1e-11);
    close(ratio("pad.peak-deformation"), 1.0 / 1.1, 1e-11);
    close(ratio("pad.contact-time"), 1.0 / 1.1, 1e-11);
    // ∫ a^2.5 dt of a half-sine: the height to 2.5, the length to 1.
    close(ratio("head.severity-index"), 1.1_f64.powf(1.5), 1e-10);
    let alone = alone(&first, &found, &settings).unwrap();
    assert_eq!(alone.len(), 1);
    let force = alone[0].measures.iter().find(|measure| measure.key == "pad.peak-force").unwrap();
    close(force.apart.unwrap(), 0.1 / 1.1, 1e-11);
}

#[test]
fn every_element_keeps_its_law_at_another_scale() {
    assert!(ELEMENTS.len() >= 15);
    for kind in ELEMENTS {
        let scale = Scale { mass: 3.0, length: 0.2, time: 7.0 };
        let mut network = Network::new();
        let node = network.add_node(Node::mass("mass", 1.0));
        network.connect("pad", node, network.ground(), Tree::Part(kind.example().unwrap()));
        let other = scaled(&network, &scale).unwrap();
        let laws = [&network, &other].map(|own| own.connections()[0].model.parts()[0].1.clone());
        let [length, rate, force] =
            [Dimension::LENGTH, Dimension::VELOCITY, Dimension::FORCE].map(|own| scale.of(own));
        for (y, v) in [(0.01, 0.5), (-0.003, 0.2), (0.02, -0.1), (0.004, 2.0)] {
            let one = laws[0].force(y, v) * force;
            let other = laws[1].force(y * length, v * rate);
            // `rate-spring` has a term of 1e-8 of its force with a speed of its own.
            assert!(
                (one - other).abs() <= 1e-8 * one.abs().max(1e-9 * force),
                "{} at {y}, {v}: {one} and {other}",
                kind.word
            );
        }
    }
}
