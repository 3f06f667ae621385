use dashpot_dae::{Piece, Silent, Waveform};
use dashpot_network::{
    Model, Network, Node,
    effects::{Face, Gravity, GravityStart, Separation, Touch},
    elements::{
        Contact, CubicSpring, Dashpot, ElementKind, ElementVisitor, PowerDashpot, Spring,
        TableSpring, visit_elements,
    },
    layers::{Layer, Layers, Resolution},
    parameters::Dimension,
    part,
};
use dashpot_rheology::Tree;

use super::*;
use crate::{
    MeasureWish, SolveSettings,
    measures::{Clip3ms, Dri, Edi, Hic15, PeakForce, SeverityIndex},
    solve,
};

fn spring(stiffness: f64) -> Model {
    part(Spring { stiffness })
}

fn dashpot(damping: f64) -> Model {
    part(Dashpot { damping })
}

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

/// Numbers that look random, between 0 and 1.
fn numbers(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        f64::from(u32::try_from(state >> 32).unwrap()) / f64::from(u32::MAX)
    }
}

fn random_scale(next: &mut impl FnMut() -> f64) -> Scale {
    let mut factor = || 10.0_f64.powf(6.0 * next() - 3.0);
    Scale { mass: factor(), length: factor(), time: factor() }
}

fn close(found: f64, expected: f64, relative: f64) {
    assert!(
        (found - expected).abs() <= relative * expected.abs(),
        "{found} is not {expected} within {relative}"
    );
}

#[test]
fn reference_has_the_groups_that_the_thesis_prints() {
    let impact = FourParameterImpact::of(&reference()).unwrap();
    let groups = impact.groups();
    close(groups.a, 80.0 / 3.0, 1e-14);
    close(groups.b, 200.0 / 3.0, 1e-14);
    close(groups.c, 8.0, 1e-14);
    close(groups.d, 80.0, 1e-14);
    close(groups.alpha, 0.2, 1e-14);
    close(groups.beta, 2.0, 1e-14);
    close(groups.gamma, 0.1, 1e-14);
    assert!((groups.gravity, groups.share) == (0.0, 1.0));
    close(impact.time(), 2e-3, 1e-15);
    let [p1, p2, p3, p4] = impact.ratios();
    close(groups.a, (1.0 + p1 + p2) * p3 / p1, 1e-15);
    close(groups.c, p3 / p4, 1e-15);
}

#[test]
fn gravity_and_a_mass_on_the_face_make_two_more_groups() {
    let mut network = reference();
    network.add_effect(Gravity { acceleration: 9.8, start: GravityStart::Equilibrium });
    let (element, at) = ("padding".to_owned(), Some("head".to_owned()));
    network.add_effect(Face { element, mass: 2.5, at, touch: Touch::Moving });
    let groups = FourParameterImpact::of(&network).unwrap().groups();
    close(groups.share, 0.8, 1e-15);
    close(groups.gravity, 0.8 * 9.8 * 0.02 / 100.0, 1e-14);
    // Twelve parameters of rank three: nine groups.
    let all = Groups::of(&network).unwrap();
    assert_eq!((all.groups.len() + all.references.len(), all.rank(), all.groups.len()), (12, 3, 9));
}

#[test]
fn any_model_that_is_a_burgers_model_from_outside_has_its_groups() {
    // Appendix A: two Maxwell elements side by side.
    let mut network = reference();
    let (k1, c1, k2, c2) = (2e7_f64, 4e3, 2e7, 6e3);
    let alpha = 0.5 * (k2 / c2 + k2 / c1 + k1 / c1);
    let beta = (alpha * alpha - k1 * k2 / (c1 * c2)).sqrt();
    let k3 = k2 * (k1 / c1 - alpha + beta) / (2.0 * beta);
    let k4 = k2 - k3;
    let branches = [(k3, k3 / (alpha - beta)), (k4, k4 / (alpha + beta))];
    let branches = branches.map(|(k, c)| Tree::series([spring(k), dashpot(c)]));
    network.set_model(0, Tree::parallel(branches));
    let groups = FourParameterImpact::of(&network).unwrap().groups();
    close(groups.a, 80.0 / 3.0, 1e-12);
    close(groups.d, 80.0, 1e-12);
}

#[test]
fn groups_lead_back_to_the_parameters_where_there_is_a_padding() {
    let impact = FourParameterImpact::of(&reference()).unwrap();
    let groups = impact.groups();
    let again = impact.with_groups(&groups).unwrap();
    for (found, own) in [
        (again.k1, 2e7),
        (again.c1, 4e3),
        (again.k2, 2e7),
        (again.c2, 6e3),
        (again.support_mass, 100.0),
        (again.support_stiffness, 5e7),
        (again.support_damping, 1e4),
    ] {
        close(found, own, 1e-12);
    }
    // The printed groups are truncated: they stand for K1 = 20.13 MN/m and C1 = 4027 N s/m.
    let printed = groups.with("a", 26.6).unwrap().with("b", 66.66).unwrap();
    let printed = impact.with_groups(&printed).unwrap();
    close(printed.k1, 20.13e6, 5e-4);
    close(printed.c1, 4027.0, 5e-4);
    let solved = FourParameterImpact::of(&printed.network()).unwrap().groups();
    close(solved.a, 26.6, 1e-12);
    close(solved.b, 66.66, 1e-12);
}

#[test]
fn paddings_exist_within_the_ranges_and_not_beyond() {
    let impact = FourParameterImpact::of(&reference()).unwrap();
    let groups = impact.groups().with("a", 26.6).unwrap().with("b", 66.66).unwrap();
    let ranges = groups.ranges();
    let (from, to) = ranges.c.unwrap();
    close(from, 3.361, 2e-4);
    close(to, 28.562, 2e-5);
    let ends = [("a", Some((ranges.a.0, 1e3))), ("b", ranges.b), ("c", ranges.c), ("d", ranges.d)];
    for (name, range) in ends {
        let (from, to) = range.unwrap();
        for (value, exists) in [
            (from + 1e-6 * to, true),
            (to * (1.0 - 1e-6), true),
            (from * (1.0 - 1e-6), false),
            (to * (1.0 + 1e-6), name == "a"),
        ] {
            let found = impact.with_groups(&groups.with(name, value).unwrap());
            assert_eq!(found.is_ok(), exists, "{name} = {value}");
        }
    }
    let none = groups.with("a", 10.0).unwrap();
    assert!(none.ranges().c.is_none() && none.ranges().d.is_none());
    assert!(matches!(impact.with_groups(&none), Err(SimilarityError::NoPadding { .. })));
    assert!(groups.with("f", 1.0).is_err());
}

#[test]
fn other_forms_are_told_from_that_of_the_thesis() {
    let reason = |network: &Network| match FourParameterImpact::of(network) {
        Err(SimilarityError::OtherForm { reason }) => reason,
        other => panic!("{other:?}"),
    };
    assert!(reason(&mixed()).contains("load"));
    let mut network = reference();
    network.set_model(0, spring(1e6));
    assert!(reason(&network).contains("four-parameter"));
    let mut network = reference();
    network.set_model(1, Tree::series([spring(1e6), dashpot(1e3)]));
    assert!(reason(&network).contains("side by side"));
}

#[test]
fn references_are_mass_speed_and_thickness_and_formulas_say_so() {
    let groups = Groups::of(&reference()).unwrap();
    let symbols: Vec<&str> = groups.references.iter().map(|own| own.symbol).collect();
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
    let mut next = numbers(6);
    for network in [reference(), mixed()] {
        for _ in 0..50 {
            let scale = random_scale(&mut next);
            let other = scaled(&network, &scale).unwrap();
            let found = Similarity::between(&network, &other, Similarity::WITHIN).unwrap();
            assert!(found.structure.is_empty(), "{:?}", found.structure);
            let worst = found.groups.iter().map(|own| own.apart).fold(0.0, f64::max);
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
            let Ok(other) = inventory::with_value(&network, &quantity.name, value) else {
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
    let mut next = numbers(66);
    let network = reference();
    let measures = vec![
        MeasureWish::new("head", Hic15::default()),
        MeasureWish::new("head", Clip3ms::default()),
        MeasureWish::new("head", Edi::default()),
        MeasureWish::new("mount", PeakForce::default()),
    ];
    let settings = SolveSettings { measures, ..SolveSettings::lasting(0.02).by("exact") };
    for _ in 0..8 {
        let scale = random_scale(&mut next);
        let other = scaled(&network, &scale).unwrap();
        for own in measured(&network, &other, &scale, &settings).unwrap() {
            let [one, other] = own.values;
            assert_eq!(one.is_some(), other.is_some(), "{}", own.key);
            let apart = own.apart.unwrap_or(0.0);
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
    let settings = SolveSettings::lasting(0.1).by("exact");
    let pairs = measured(&first, &found.second, &found.scale, &settings).unwrap();
    let ratio = |key: &str| {
        let own = pairs.iter().find(|own| own.key == key).unwrap();
        own.values[1].unwrap() / own.values[0].unwrap()
    };
    close(ratio("pad.peak-force"), 1.1, 1e-11);
    close(ratio("pad.peak-deformation"), 1.0 / 1.1, 1e-11);
    close(ratio("pad.contact-time"), 1.0 / 1.1, 1e-11);
    // ∫ a^2.5 dt of a half-sine: the height to 2.5, the length to 1.
    close(ratio("head.severity-index"), 1.1_f64.powf(1.5), 1e-10);
    let alone = alone(&first, &found, &settings).unwrap();
    assert_eq!(alone.len(), 1);
    let force = alone[0].measures.iter().find(|own| own.key == "pad.peak-force").unwrap();
    close(force.apart.unwrap(), 0.1 / 1.1, 1e-11);
}

#[test]
fn laboratory_tests_are_similar_and_their_measures_map_back() {
    let real = reference();
    let wish = |name: &str, value| Wish { name: name.to_owned(), value };
    let wishes = [wish("mass", 1.0), wish("speed", 2.0), wish("thickness", 0.005)];
    let found = Laboratory::design(&real, &wishes).unwrap();
    close(found.scale.mass, 0.1, 1e-15);
    close(found.scale.length, 0.25, 1e-15);
    close(found.scale.time, 1.25, 1e-15);
    assert!(Similarity::between(&real, &found.network, 1e-14).unwrap().is_similar());
    let settings = SolveSettings::lasting(0.02).by("exact");
    let (similar, _) = similar_settings(&settings, &found.scale);
    let one = solve(&real, &settings, &mut Silent).unwrap();
    let other = solve(&found.network, &similar, &mut Silent).unwrap();
    let force = |report: &crate::RunReport| report.measure("padding.peak-force").unwrap().value;
    // Forces go with m V²/δ.
    close(force(&other).unwrap() / force(&one).unwrap(), 0.1 * 0.04 / 0.25, 1e-12);
    let severity = |report: &crate::RunReport| report.measure("head.severity-index").unwrap().value;
    let factor = (0.25_f64 / 1.25 / 1.25).powf(2.5) * 1.25;
    close(severity(&other).unwrap() / severity(&one).unwrap(), factor, 1e-12);
    close(found.scale.of_measure(&SeverityIndex::default()), factor, 1e-14);
}

#[test]
fn wishes_of_a_laboratory_may_be_few_but_not_contradictory() {
    let real = reference();
    let wish = |name: &str, value| Wish { name: name.to_owned(), value };
    let found = Laboratory::design(&real, &[wish("panel.mass", 10.0)]).unwrap();
    let kept: Vec<&str> = found.kept.iter().map(|own| own.name.as_str()).collect();
    assert_eq!(kept, ["head.velocity", "padding.thickness"]);
    close(found.scale.mass, 0.1, 1e-15);
    let both = [wish("mass", 1.0), wish("panel.mass", 20.0)];
    assert!(matches!(
        Laboratory::design(&real, &both),
        Err(SimilarityError::Contradiction { follows, .. }) if (follows - 10.0).abs() < 1e-12
    ));
    assert!(Laboratory::design(&real, &[wish("mass", 1.0), wish("panel.mass", 10.0)]).is_ok());
    assert!(matches!(
        Laboratory::design(&real, &[wish("speed", -2.0)]),
        Err(SimilarityError::NoFactor { .. })
    ));
    assert!(matches!(
        Laboratory::design(&real, &[wish("size", 1.0)]),
        Err(SimilarityError::UnknownQuantity { .. })
    ));
}

#[test]
fn gravity_that_cannot_be_scaled_is_told() {
    let mut real = reference();
    real.add_effect(Gravity { acceleration: 9.8, start: GravityStart::Equilibrium });
    let wish = |name: &str, value| Wish { name: name.to_owned(), value };
    let wishes = [wish("speed", 5.0), wish("thickness", 0.02)];
    let found = Laboratory::design(&real, &wishes).unwrap();
    let [own, needed] = found.gravity.unwrap();
    close(own, 9.8, 1e-15);
    close(needed, 9.8 / 4.0, 1e-14);
    let under = found.under_real_gravity().unwrap();
    let different = Similarity::between(&real, &under, 1e-12).unwrap();
    let names: Vec<&str> = different.different().map(|own| own.name.as_str()).collect();
    assert_eq!(names, ["gravity.value"]);
}

#[test]
fn every_element_keeps_its_law_at_another_scale() {
    struct Check(usize);
    impl ElementVisitor for Check {
        fn visit<E: ElementKind>(&mut self) {
            let scale = Scale { mass: 3.0, length: 0.2, time: 7.0 };
            let mut network = Network::new();
            let node = network.add_node(Node::mass("mass", 1.0));
            network.connect("pad", node, network.ground(), part(E::sample()));
            let other = scaled(&network, &scale).unwrap();
            let laws =
                [&network, &other].map(|own| own.connections()[0].model.parts()[0].1.clone());
            let [length, rate, force] =
                [Dimension::LENGTH, Dimension::VELOCITY, Dimension::FORCE].map(|own| scale.of(own));
            for (y, v) in [(0.01, 0.5), (-0.003, 0.2), (0.02, -0.1), (0.004, 2.0)] {
                let one = laws[0].force(y, v) * force;
                let other = laws[1].force(y * length, v * rate);
                // `rate-spring` has a term of 1e-8 of its force with a speed of its own.
                assert!(
                    (one - other).abs() <= 1e-8 * one.abs().max(1e-9 * force),
                    "{} at {y}, {v}: {one} and {other}",
                    E::KIND
                );
            }
            self.0 += 1;
        }
    }
    let mut check = Check(0);
    visit_elements(&mut check);
    assert!(check.0 >= 15);
}
